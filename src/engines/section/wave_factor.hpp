#pragma once
// A section's stiffness at one wave number, factored.
#include <Eigen/SparseCholesky>

namespace railstrata {

/// K = P^T L L^T P. Loads and displacements stand in rows, by free node and direction, since each entry of L works on
/// whole rows.
class WaveFactor {
 public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// Lower triangle. Throws NumericalError where it is not positive definite.
  explicit WaveFactor(const Eigen::SparseMatrix<double>& stiffness);
  /// L^-1 P F: F^T K^-1 F is its square.
  Rows half(const Rows& loads) const;
  /// K^-1 F.
  Rows solve(const Rows& loads) const;

 private:
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace railstrata
