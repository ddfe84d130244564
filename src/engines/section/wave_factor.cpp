#include "section/wave_factor.hpp"

#include "core/faults.hpp"

namespace railstrata {

namespace {

/// to -= share * from, rows of so many numbers.
void take(double share, const double* __restrict from, double* __restrict to, Eigen::Index count) {
  for (Eigen::Index c = 0; c < count; ++c) to[c] -= share * from[c];
}

using Lower = Eigen::SparseMatrix<double>;

}  // namespace

WaveFactor::WaveFactor(const Eigen::SparseMatrix<double>& stiffness) : factor_(stiffness) {
  if (factor_.info() != Eigen::Success) throw NumericalError("a section's stiffness has no factor");
}

WaveFactor::Rows WaveFactor::half(const Rows& loads) const {
  Rows x = factor_.permutationP() * loads;
  const Lower& lower = factor_.matrixL().nestedExpression();
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    Lower::InnerIterator entry(lower, i);
    x.row(i) /= entry.value();
    for (++entry; entry; ++entry) take(entry.value(), &x(i, 0), &x(entry.row(), 0), x.cols());
  }
  return x;
}

WaveFactor::Rows WaveFactor::solve(const Rows& loads) const {
  Rows x = half(loads);
  const Lower& lower = factor_.matrixL().nestedExpression();
  for (Eigen::Index i = x.rows() - 1; i >= 0; --i) {
    Lower::InnerIterator entry(lower, i);
    const double diagonal = entry.value();
    for (++entry; entry; ++entry) take(entry.value(), &x(entry.row(), 0), &x(i, 0), x.cols());
    x.row(i) /= diagonal;
  }
  return factor_.permutationPinv() * x;
}

}  // namespace railstrata
