#pragma once
// Solutions of A x = b for several right sides b, one after the other, in one Krylov space: directions that one right
// side has searched serve all after it. Generalised conjugate residuals, which reach what GMRES reaches for one right
// side [SaadSchultz1986], with the images of all directions kept.
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "bem/gmres.hpp"

namespace railstrata {

/// Keeps the directions z_k and the orthonormal w_i of A z_k = sum over i <= k of R_ik w_i. Of one operator.
class RecycledKrylov {
 public:
  /// Until |b - A x| <= relative |b|, or without an end: as far as the directions get. apply(in, out) is A,
  /// precondition(in, out) an approximate inverse.
  template <class Apply, class Precondition>
  void solve(Apply&& apply, Precondition&& precondition, const Plane& b, Plane& x, double relative) {
    constexpr std::size_t kMost = 400;  // directions
    left_ = b;
    const double goal = relative * std::sqrt(dot(b, b));
    std::vector<double> parts(columns_.size(), 0.0);
    double square = columns_.empty() ? dot(left_, left_) : orthogonalize(images_.basis, columns_.size(), left_, parts);
    while (std::sqrt(square) > goal && columns_.size() < kMost) {
      const std::size_t k = columns_.size();
      directions_.emplace_back(b.size());
      precondition(left_, directions_[k]);
      images_.w.resize(b.size());
      apply(directions_[k], images_.w);
      columns_.push_back(k == 0 ? first_column() : extend_basis(images_, k - 1));
      parts.push_back(dot(images_.basis[k], left_));
      add_scaled(left_, -parts[k], images_.basis[k]);
      square = dot(left_, left_);
    }
    x.assign(b.size(), 0.0);
    for (std::size_t k = parts.size(); k-- > 0;) {
      const double share = parts[k] / columns_[k][k];
      for (std::size_t i = 0; i < k; ++i) parts[i] -= share * columns_[k][i];
      add_scaled(x, share, directions_[k]);
    }
  }

  std::size_t directions() const { return columns_.size(); }

 private:
  std::vector<double> first_column() {
    const double length = std::sqrt(dot(images_.w, images_.w));
    Plane& first = images_.vector(0, images_.w.size());
    for_cells(first.size(), [&](std::size_t i) { first[i] = images_.w[i] / length; });
    return {length};
  }

  std::vector<Plane> directions_;
  std::vector<std::vector<double>> columns_;  // of R
  GmresSpace images_;
  Plane left_;
};

}  // namespace railstrata
