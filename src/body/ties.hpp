#pragma once
// Hanging nodes: lines of slave nodes carried by lines of master nodes (mesh/swept.hpp, Tie), as a linear constraint T.
//
//   x_s = sum_m w_m x_m + R(psi) delta,   delta = X_s - sum_m w_m X_m
// The offset delta (the sagitta of an arc between two stations) turns with the body, so a rigid motion of any size
// strains nothing. Forces and masses on a slave go to its masters with the same weights: the transpose of T.
#include <span>
#include <vector>

#include "core/array.hpp"
#include "core/rotation.hpp"
#include "mesh/layout.hpp"

namespace railstrata {

class Ties;

/// A field of a body and how far the body is turned; homogeneous: increments, which the offsets leave out.
struct TiedField {
  const Ties& ties;
  Field& values;
  Rotation<double> turn{};
  bool homogeneous = false;
};
/// Ties::apply on several bodies in one parallel loop.
void spread_ties(std::span<const TiedField> fields);
/// Ties::apply_transpose_turned likewise; returns the sum of the moments [N m].
double collect_ties(std::span<const TiedField> fields);

class Ties {
 public:
  Ties(const SweptBody& body, const BodyLayout& layout);

  /// u_s = T u + (R(psi) - 1) delta: the displacements of all slaves from their masters.
  void apply(Field& u, double psi) const;
  /// u_s = T u, without the offsets: increments and search directions.
  void apply_homogeneous(Field& u) const;
  /// f += T^T f_s, f_s = 0: what stands at the slaves (forces, masses) goes to their masters.
  void apply_transpose(Field& f) const;
  /// The same for forces on a body turned by psi. Returns what the offsets hand to the rotation itself,
  /// sum f_s . d(R delta)/dpsi [N m]: without it the work of the forces on the slaves is not that of those at the
  /// masters.
  double apply_transpose_turned(Field& f, double psi) const;

  bool is_slave(int block, int node) const { return slave_[block][node]; }

  // -- what it is made of, for those who apply it elsewhere (device/body_tables.hpp)
  struct Line {
    int slave_block, slave_node, master_block, node0, node1;
    double weight1;
    int interpolation;     ///< index into interpolations()
    std::ptrdiff_t delta;  ///< start in the offsets
  };
  /// From the stations of one block to those of another.
  struct Interpolation {
    int slave_block, master_block;
    std::vector<int> left, right;
    std::vector<double> weight;  ///< of right
    // the transpose: master station i gets the slaves' values share[k] * at station from[k],
    // first[i] <= k < first[i + 1]
    std::vector<int> first, from;
    std::vector<double> share;
    // the same, padded with shares of nothing to `slots` numbers a station: slot_share[slot * stations + i]
    int slots = 0;
    std::vector<int> slot_from;
    std::vector<double> slot_share;
  };
  /// Lines none of which carries another, and what each of their masters gets of them, the last line first. Masters
  /// that are tied themselves are slaves of a lower level.
  struct Share {
    int line;
    double weight;
  };
  struct Master {
    int block, node;
    int first_share, shares;
  };
  struct Level {
    std::vector<int> lines;
    std::vector<Master> masters;
    std::vector<Share> shares;
  };
  const std::vector<Level>& levels() const { return levels_; }
  const std::vector<Line>& lines() const { return lines_; }
  const std::vector<Interpolation>& interpolations() const { return interpolations_; }
  const std::vector<double>& delta_x() const { return delta_x_; }
  const std::vector<double>& delta_z() const { return delta_z_; }

 private:
  static Interpolation interpolation(const SweptBody& body, int slave_block, int master_block);
  static void transpose(int master_stations, Interpolation& in);
  int interpolation_index(const SweptBody& body, int slave_block, int master_block);
  void add_line(const SweptBody& body, const Tie& tie);
  void add_levels();
  void add_masters(Level& level) const;

  friend void spread_ties(std::span<const TiedField> fields);
  friend double collect_ties(std::span<const TiedField> fields);
  void spread_line(const Line& line, int component, const TiedField& field) const;
  void gather(const Level& level, const Master& master, int component, Field& f) const;
  double take_moment(const Line& line, const TiedField& field) const;

  BodyLayout layout_;
  SweepKind kind_;
  std::vector<Line> lines_;  // masters' own ties come before
  std::vector<Level> levels_;
  std::vector<Interpolation> interpolations_;
  std::vector<double> delta_x_, delta_z_;
  std::vector<std::vector<bool>> slave_;
};

}  // namespace railstrata
