#pragma once
// The free degrees of freedom of a body as dense algebra.
#include <Eigen/Dense>

#include "body/body.hpp"
#include "body/traversal.hpp"

namespace railstrata::fem_checks {

inline std::vector<std::ptrdiff_t> free_indices(const Body& body) {
  std::vector<std::ptrdiff_t> out;
  for (const NodeLine& l : body.lines)
    for (int j = 0; j < l.count; ++j) out.push_back(l.first + j);
  return out;
}

/// Column by column: the forces K u, with the ties, of a unit displacement; `change(u, f)` may make others of them.
template <class Change>
Eigen::MatrixXd free_matrix(const Body& body, Change&& change) {
  const std::vector<std::ptrdiff_t> index = free_indices(body);
  const auto n = static_cast<Eigen::Index>(index.size());
  Eigen::MatrixXd out(n, n);
  Field u = body.layout.field(), f = u;
  Traversal elements(body);
  for (Eigen::Index c = 0; c < n; ++c) {
    std::fill(u.begin(), u.end(), 0.0);
    u[index[c]] = 1;
    body.ties.apply_homogeneous(u);
    elements.linear_force(u, f);
    body.ties.apply_transpose(f);
    change(u, f);
    for (Eigen::Index r = 0; r < n; ++r) out(r, c) = f[index[r]];
  }
  return out;
}
inline Eigen::MatrixXd stiffness_matrix(const Body& body) {
  return free_matrix(body, [](const Field&, const Field&) {});
}

}  // namespace railstrata::fem_checks
