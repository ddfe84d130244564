#pragma once
// A meshed elastic body ready for computing: reference data of its elements, masses, internal forces, energies and stresses.
//
// Work is split into tiles of stations; a tile adds up its own elements in the order of the quadrilaterals and hands the forces on its last node plane to its
// neighbour through a spill buffer, so there are no races and the sums do not depend on the number of threads.
#include <array>
#include <vector>

#include "core/array.hpp"
#include "core/parallel.hpp"
#include "element/swept_hex.hpp"
#include "mesh/layout.hpp"

namespace railstrata {

struct SolidOptions {
  ElementKind element = ElementKind::full;
  double hourglass_coefficient = 0.05;
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

  /// f = internal forces at displacement u (model frame, u = x - X); psi: rigid rotation of the body about its axle, positive when rolling forward.
  /// Ghosts of u are refreshed; padding of f is not defined.
  void internal_force(Field& u, double psi, Field& f) const;
  /// f = K u, K the stiffness of the undeformed body.
  void linear_force(Field& u, Field& f) const;
  StrainEnergy energy(Field& u, double psi) const;
  /// Adds the diagonal of K to d (cleared first).
  void stiffness_diagonal(Field& d) const;

  /// Cauchy stress at the centre of an element, model frame [Pa].
  Sym3 stress(const Field& u, int block, int quad, int station) const;
  /// Displacement gradient du_i/dX_j at the centre, X in the element's own frame, u in the model frame: columns along the sweep, lateral, up.
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
  struct BlockData {
    std::vector<QuadReference> quads;
    std::vector<int> spacing_class;              // per element along the sweep, padded; the last class is the padding's
    std::vector<double> spacings;                // per class
    std::vector<HourglassStiffness> hourglass;   // [class][quad]; zero for the padding
    Field inv_sigma, inv_c, v1, v2, v3, sigma, c, theta, cos_q, sin_q;  // per element along the sweep, padded with zeros
  };
  struct Tile {
    int block, first, last;  // elements along the sweep
    std::ptrdiff_t spill;    // start in the spill buffer
  };
  StationScale<Pack> station_scale(const BlockData& data, int element, double psi) const;
  template <bool linear>
  void forces(Field& u, double psi, Field& f) const;
  template <bool linear>
  void tile_forces(const Tile& tile, const Field& u, const Field& cos_r, const Field& sin_r, Field& f) const;
  void refresh_ghosts(Field& u) const;
  void turned_frames(double psi, Field& cos_r, Field& sin_r) const;
  std::array<Vec2, 4> corners(int block, int quad) const;

  SweptBody body_;
  BodyLayout layout_;
  std::vector<Elastic> materials_;
  std::vector<BlockData> data_;
  std::vector<Tile> tiles_;
  std::vector<int> first_tile_;  // per block, and one past the end
  std::vector<std::ptrdiff_t> frame_offset_;  // per block, start in the arrays of turned frames
  std::ptrdiff_t frame_size_ = 0;
  mutable Field spill_, cos_r_, sin_r_;
  Field mass_;
};

}  // namespace railstrata
