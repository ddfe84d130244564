#pragma once
// A meshed elastic body ready for computing: reference data of its elements, masses, internal forces, energies and
// stresses.
//
// Work is split into tiles of stations. A tile goes through its quadrilaterals one by one (mesh/sweep_order.hpp) and
// keeps the forces of the nodes that are not complete yet in a few rows of scratch memory; a finished row is handed
// over at once, so that it can be used while it is in cache. Tiles may be chained: one waits for the other and
// completes the node plane between them; forces on the planes between two chains are added up afterwards. No races, and
// sums that do not depend on the number of threads.
#include <array>
#include <memory>
#include <vector>

#include "core/array.hpp"
#include "core/callable_ref.hpp"
#include "core/parallel.hpp"
#include "element/swept_hex.hpp"
#include "mesh/layout.hpp"

namespace railstrata {

/// Of the element's arithmetic in tile_forces; nodal values are kept in double precision. `single` wants displacements
/// that are small against the body: relative to a frame that moves with it.
enum class Precision { double_precision, single_precision };

struct SolidOptions {
  ElementKind element = ElementKind::full;
  double hourglass_coefficient = 0.05;
  Precision precision = Precision::double_precision;
};

/// Sum over the body [J].
struct StrainEnergy {
  double strain = 0, hourglass = 0;
};

class Solid {
 public:
  Solid(const SweptBody& body, const std::vector<Elastic>& materials, const SolidOptions& options);

  const SweptBody& body() const { return body_; }
  const BodyLayout& layout() const { return layout_; }
  const std::vector<Elastic>& materials() const { return materials_; }

  /// Lumped nodal masses, the same number for the three components of a node; zero in padding.
  const Field& mass() const { return mass_; }
  double total_mass() const;

  /// f = internal forces at displacement u (model frame, u = x - X); psi: rigid rotation of the body about its axle,
  /// positive when rolling forward. Ghosts of u are refreshed; padding of f is not defined. Always in double precision.
  void internal_force(Field& u, double psi, Field& f) const;
  /// f = K u, K the stiffness of the undeformed body.
  void linear_force(Field& u, Field& f) const;
  StrainEnergy energy(Field& u, double psi) const;
  /// Adds the diagonal of K to d (cleared first).
  void stiffness_diagonal(Field& d) const;

  // -- internal forces in pieces: begin_forces, every chain once (in parallel if wanted), end_forces
  // -------------------------------------------------------
  static constexpr int kTile = 64;  ///< elements along the sweep; a multiple of every pack width
  struct Tile {
    int block, first, end;  ///< owns the stations first <= j < end
  };
  /// Tiles first_tile <= t < end_tile of one block, one after the other: only the first one's first station is a border
  /// plane, complete after end_forces.
  struct Chain {
    int first_tile, end_tile;
  };
  /// At least so many chains if there are as many tiles, in the memory of `reuse`. The forces are the same to the bit
  /// however the tiles are chained.
  std::vector<Chain> chains(int at_least, std::vector<Chain> reuse = {}) const;
  int border_plane(const Chain& c) const { return tiles_[c.first_tile].first; }
  int block(const Chain& c) const { return tiles_[c.first_tile].block; }

  /// Complete internal forces on a node at the stations begin <= j < tile.end: rows[i * kTile + j - tile.first]; begin
  /// is the tile's first station or the next. May change the displacements there. Returns true if it has used them up;
  /// otherwise they are stored in f.
  using TakeRows = CallableRef<bool(const Tile& tile, int begin, int node, const double* rows)>;
  /// Told of a node some time before its rows are handed over: adds the lines of memory, from the tile's first station,
  /// that will be wanted then.
  using ExpectRows = CallableRef<void(const Tile& tile, int node, Prefetch& lines)>;

  void begin_forces(Field& u, double psi) const;
  void chain_forces(const Chain& chain, const Field& u, Field& f, const TakeRows& take, const ExpectRows& expect) const;
  /// Forces on the border planes of all chains, and on the last station of an open block.
  void end_forces(const std::vector<Chain>& chains, Field& f) const;

  /// Cauchy stress at the centre of an element, model frame [Pa].
  Sym3 stress(const Field& u, int block, int quad, int station) const;
  /// Displacement gradient du_i/dX_j at the centre, X in the element's own frame, u in the model frame: columns along
  /// the sweep, lateral, up.
  std::array<Vec3, 3> displacement_gradient(const Field& u, int block, int quad, int station) const;
  /// Position of a node in the undeformed body, model frame.
  Vec3 reference_position(int block, int node, int station) const;

  /// The smallest stable step of the free elements and where it is.
  struct StepBound {
    double step = 0;
    int block = 0, quad = 0, station = 0;
  };
  StepBound element_step_bound() const;

 private:
  template <class Real>
  using Line = std::vector<Real, CacheLineAllocator<Real>>;
  /// What the element law reads: by quadrilateral, by hourglass class and quadrilateral, by station (padded with
  /// zeros).
  template <class Real>
  struct KernelData {
    std::vector<QuadReferenceOf<Real>> quads;
    std::vector<std::array<Real, kHourglassEntries>> hourglass;  // [class * quads + quad]; zero for the padding
    Line<Real> inv_sigma, inv_c, v1, v2, v3, sigma, c;
    template <class T, class Load>
    StationScale<T> scale(int element, Load&& read) const;
  };
  /// Elements along the sweep have their own spacing and share the hourglass stiffness of their group: where the mesh
  /// is graded that of its shortest element (a stiffer one would shorten the stable step).
  struct SpacingClass {
    double spacing;
    int hourglass;
    friend bool operator==(const SpacingClass&, const SpacingClass&) = default;
  };
  struct BlockData {
    KernelData<double> kernel;
    KernelData<float> single;          // empty in double precision
    std::vector<int> hourglass_class;  // per group of elements
    std::vector<SpacingClass> classes;
    std::vector<int> element_class;  // per element, index into classes
    Field theta, cos_q, sin_q, cos_r,
        sin_r;               // of the element centres; Q and R of the element law (element/swept_hex.hpp)
    std::vector<int> order;  // in which a tile goes through the quadrilaterals
    // scratch rows: a node has its own from the first quadrilateral that touches it to the last
    std::vector<int> slot;                         // per node
    std::vector<std::array<char, 4>> fresh, done;  // per quadrilateral: corners touched for the first, the last time
    int slots = 0;
  };

  template <bool linear>
  void forces(Field& u, double psi, Field& f) const;
  template <class Real, bool linear>
  void run_chain(const Chain& chain, const Field& u, Field& f, const TakeRows* take, const ExpectRows* expect) const;
  template <class Real, bool linear, SweepKind kind>
  void run_tile(int tile, bool follows, const Field& u, Field& f, const TakeRows* take, const ExpectRows* expect) const;
  template <class Real>
  KernelData<Real> const& kernel(const BlockData& d) const;
  void plan_scratch(int block, BlockData& d) const;
  void refresh_ghosts(Field& u) const;
  void turn_frames(double psi) const;
  std::array<Vec2, 4> corners(int block, int quad) const;

  SweptBody body_;
  BodyLayout layout_;
  std::vector<Elastic> materials_;
  Precision precision_;
  mutable std::vector<BlockData> data_;
  mutable BodyTurn<double> turn_;
  std::vector<Tile> tiles_;
  std::vector<int> first_tile_;              // per block, and one past the end
  std::vector<std::ptrdiff_t> border_;       // per tile, start in the border buffers
  mutable Field border_first_, border_end_;  // forces of a tile on its border planes, [node][component]
  mutable std::vector<Chain> all_chains_;    // of forces()
  mutable std::vector<StrainEnergy> tile_energy_;
  Field mass_;
};

}  // namespace railstrata
