#include "steady/anderson.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>

#include "core/parallel.hpp"

namespace railstrata {

namespace {

double dot(const Field& a, const Field& b) {
  assert(a.size() == b.size());
  return ordered_sum(static_cast<std::ptrdiff_t>(a.size()), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    double sum = 0;
    for (std::ptrdiff_t n = begin; n < end; ++n) sum += a[n] * b[n];
    return sum;
  });
}

}  // namespace

void Anderson::clear() {
  dy_.clear();
  df_.clear();
  gram_.clear();
  last_y_.clear();
  last_f_.clear();
}

std::vector<double> Anderson::weights(const Field& residual) const {
  constexpr double kRoundOff = 1e-12;  // of the trace: columns that are nearly the same do not blow up
  const auto n = static_cast<Eigen::Index>(df_.size());
  Eigen::MatrixXd gram(n, n);
  Eigen::VectorXd right(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    right[i] = dot(df_[i], residual);
    for (Eigen::Index j = 0; j <= i; ++j) gram(i, j) = gram(j, i) = gram_[i][j];
  }
  gram.diagonal().array() += kRoundOff * gram.trace();
  const Eigen::VectorXd solution = gram.ldlt().solve(right);
  return {solution.data(), solution.data() + n};
}

void Anderson::keep(const Field& y, const Field& residual) {
  if (static_cast<int>(dy_.size()) == depth_) {  // the oldest gives its memory to the newest
    std::rotate(dy_.begin(), dy_.begin() + 1, dy_.end());
    std::rotate(df_.begin(), df_.begin() + 1, df_.end());
    gram_.erase(gram_.begin());
    for (std::vector<double>& row : gram_) row.erase(row.begin());
  } else {
    dy_.emplace_back(y.size());
    df_.emplace_back(y.size());
  }
  Field &dy = dy_.back(), &df = df_.back();
  for_each(static_cast<std::ptrdiff_t>(y.size()), [&](std::ptrdiff_t n) {
    dy[n] = y[n] - last_y_[n];
    df[n] = residual[n] - last_f_[n];
  });
  gram_.emplace_back();
  for (const Field& other : df_) gram_.back().push_back(dot(df, other));
}

// y <- y + f - (dY + dF) w,   w = argmin |f - dF w|,   f = g(y) - y   [WalkerNi2011]; dY, dF: differences of the last
// points and residuals, w by the normal equations dF^T dF w = dF^T f.
void Anderson::step(Field& y, Field& residual) {
  assert(y.size() == residual.size() && (last_y_.empty() || last_y_.size() == y.size()));
  if (!last_y_.empty()) keep(y, residual);
  last_y_ = y;
  last_f_ = residual;
  const std::vector<double> w = weights(residual);
  for_each(static_cast<std::ptrdiff_t>(y.size()), [&](std::ptrdiff_t n) {
    double next = y[n] + residual[n];
    for (std::size_t k = 0; k < w.size(); ++k) next -= w[k] * (dy_[k][n] + df_[k][n]);
    y[n] = next;
  });
}

}  // namespace railstrata
