#pragma once
// Hanging nodes: lines of slave nodes carried by lines of master nodes (mesh/swept.hpp, Tie).
//
//   x_s = sum_m w_m x_m + R(psi) delta,   delta = X_s - sum_m w_m X_m
// The offset delta (the sagitta of an arc between two stations) turns with the body, so a rigid motion of any size
// strains nothing. Forces and masses on a slave go to its masters with the same weights.
#include <array>

#include "core/array.hpp"
#include "mesh/layout.hpp"

namespace railstrata {

class Ties {
 public:
  Ties(const SweptBody& body, const BodyLayout& layout);

  /// Sets the displacements of all slaves from their masters. homogeneous: without the offsets (increments, search
  /// directions).
  void spread(Field& u, double psi, bool homogeneous = false) const;
  /// Adds what stands at the slaves (forces, masses) to their masters and clears it at the slaves.
  void collect(Field& f) const;
  /// The same for forces on a body turned by psi. Returns what the offsets hand to the rotation itself, sum f_s . d(R
  /// delta)/dpsi [N m]: without it the work of the forces on the slaves is not that of the collected ones.
  double collect_turning(Field& f, double psi) const;

  /// One component (0, 1, 2) of spread and collect_turning, for callers that run them in parallel.
  void spread_component(Field& u, int component, double cos_psi, double sin_psi, bool homogeneous) const;
  double collect_component(Field& f, int component, double cos_psi, double sin_psi) const;

  bool is_slave(int block, int node) const { return slave_[block][node]; }

 private:
  struct Line {
    int slave_block, slave_node, master_block, node0, node1;
    double weight1;
    int interpolation;         // index into interpolations_
    std::ptrdiff_t delta = 0;  // start in delta arrays
  };
  struct Interpolation {  // from the stations of one block to those of another
    int slave_block, master_block;
    std::vector<int> left, right;
    std::vector<double> weight;  // of right
    // the transposed: master station i gets the slaves' values share[k] * at station from[k], first[i] <= k < first[i +
    // 1]
    std::vector<int> first, from;
    std::vector<double> share;
  };
  BodyLayout layout_;
  SweepKind kind_;
  std::vector<Line> lines_;  // masters' own ties come before
  std::vector<Interpolation> interpolations_;
  std::vector<double> delta_x_, delta_y_, delta_z_;
  std::vector<std::vector<bool>> slave_;
  mutable std::array<std::vector<double>, 3> carried_;  // of a line's masters, per component
};

}  // namespace railstrata
