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

/// Stations begin <= j < end of a line.
struct StationRange {
  int begin = 0, end = 0;
  bool operator==(const StationRange&) const = default;
};
/// Station ranges of one line, in order; they begin with multiples of kStationGroup and end with such or with the line,
/// so that loops over them make the same packs as those over whole lines.
using StationRanges = std::vector<StationRange>;
inline constexpr int kStationGroup = 8;
/// Ranges of stations, by block and section node.
using LineStations = std::vector<std::vector<StationRanges>>;

/// The lines at ties that one of several processes keeps (fem/line_reach.hpp).
struct TiedPart {
  LineStations values;  ///< where it carries slaves
  LineStations forces;  ///< where it collects forces: wherever those of `values` come from
  /// N m, Ties::moment_pieces of all lines, given but at the stations in `planes`, by block, whose forces it has.
  /// Empty: it has those on all slaves.
  std::vector<double> moments;
  std::vector<std::vector<int>> planes;
};

/// A field of a body and how far the body is turned; homogeneous: increments, which the offsets leave out.
struct TiedField {
  const Ties& ties;
  Field& values;
  Rotation<double> turn{};
  bool homogeneous = false;
  TiedPart* part = nullptr;  ///< none: whole lines
};
/// Ties::apply on several bodies in one parallel loop.
void spread_ties(std::span<const TiedField> fields);
/// Ties::apply_transpose likewise; returns the sum of the moments [N m].
double collect_ties(std::span<const TiedField> fields);

class Ties {
 public:
  Ties(const SweptBody& body, const BodyLayout& layout);

  /// u_s = T u + (R(psi) - 1) delta: the displacements of all slaves from their masters.
  void apply(Field& u, double psi) const;
  /// u_s = T u, without the offsets: increments and search directions.
  void apply_homogeneous(Field& u) const;
  /// f += T^T f_s, f_s = 0: what stands at the slaves (forces, masses) goes to their masters. For forces on a body
  /// turned by psi it returns what the offsets hand to the rotation itself, sum f_s . d(R delta)/dpsi [N m]: without it
  /// the work of the forces on the slaves is not that of those at the masters.
  double apply_transpose(Field& f, double psi = 0) const;

  struct Line;
  /// Torque of the forces on a line of slaves of a revolved body through the offsets [N m], of single
  /// tiles (body/tiling.hpp): piece 2 t of the first station of tile t, piece 2 t + 1 of those within; the last piece
  /// is that of an open block's end. Summed in this order, they are the moment of the line.
  int moment_pieces(const Line& line) const;
  /// Scatter at the stations within the tiles first <= t < end, and on the planes between them: those that only these
  /// tiles give forces. pieces: of this line.
  void find_moment_pieces(const Line& line, const TiedField& field, int first, int end, double* pieces) const;
  /// Index of a line's first piece in the list of all; for the line after the last, the size of that list.
  std::ptrdiff_t first_piece(std::size_t line) const { return first_piece_[line]; }

  bool is_slave(int block, int node) const { return slave_[block][node]; }

  // -- what it is made of, for those who apply it elsewhere (device/body_tables.hpp)
  struct Line {
    int slave_block, slave_node, master_block, node0, node1;
    double weight1;
    int interpolation;     ///< index into interpolations()
    std::ptrdiff_t delta;  ///< start in the offsets
  };
  /// Interpolation from the stations of one block to those of another.
  struct Interpolation {
    int slave_block, master_block;
    std::vector<int> left, right;
    std::vector<double> weight;  ///< of right
    /// The transpose: master station i gets share[k] times the slaves' values at station from[k], k = slot * stations +
    /// i; shares of nothing fill all stations up to `slots`.
    int slots = 0;
    std::vector<int> from;
    std::vector<double> share;
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
  void add_line(const SweptBody& body, const Tie& tie);
  void add_levels();

  friend void spread_ties(std::span<const TiedField> fields);
  friend double collect_ties(std::span<const TiedField> fields);
  void spread_line(const Line& line, int component, const TiedField& field) const;
  template <class Visit>
  void each_range(const LineStations* kept, SectionNode line, Visit&& visit) const;
  // Forces on a line of slaves as its masters' stations get them, in the room of a loop over all lines; and what a
  // master gets of them.
  void gather(int line, const TiedField& field, double* room) const;
  void add_gathered(const Level& level, const Master& master, int component, const TiedField& field,
                    const double* room) const;
  double piece(const Line& line, const TiedField& field, StationRange at) const;
  double moment(int line, const TiedField& field) const;
  void clear(const Line& line, const TiedField& field) const;

  BodyLayout layout_;
  SweepKind kind_;
  std::vector<Line> lines_;               // masters' own ties come before
  std::vector<std::ptrdiff_t> gathered_;  // by line: start in the room of gather(); then its size
  std::vector<std::ptrdiff_t> first_piece_;
  std::vector<Level> levels_;
  std::vector<Interpolation> interpolations_;
  std::vector<double> delta_x_, delta_z_;
  std::vector<std::vector<bool>> slave_;
};

}  // namespace railstrata
