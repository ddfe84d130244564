#pragma once
// The traversal of a body's elements. It alone knows tiles, chains, packs and scratch memory.
//
// A tile goes through its quadrilaterals one by one (SweepPlan): displacements of a node are gathered when the first
// quadrilateral touches it, forces are scattered after the last, and stay in scratch rows between. A tile's node is
// complete while it is in cache; what happens to it then is the caller's policy:
//   StoreForces   all forces go to f
//   FuseUpdate    they are handed over at once, so that the update of the node uses what is in cache
//
// Elements that may yield (Body::plastic) have their eigenstress in the history, as the last pass over them left it
// (body/plastic_pass.hpp); the traversal takes it off.
//
// The history is read and left alone; a pass over the elements that may yield advances it.
#include <vector>

#include "body/body_state.hpp"
#include "core/callable_ref.hpp"

namespace railstrata {

/// Sum over the body [J].
struct StrainEnergy {
  double strain = 0, hourglass = 0;
};

struct StoreForces {};

struct FuseUpdate {
  /// Complete internal forces on a node at the stations begin <= j < tile.end: rows[i * kTile + j - tile.first]; begin
  /// is the tile's first station or the next. May change the displacements there. Returns true if it has used them up;
  /// otherwise they are stored in f.
  using Rows = CallableRef<bool(const Tile& tile, int begin, int node, const double* rows)>;
  /// Called some time before: adds the lines of memory, from the tile's first station, that the update will want.
  using Lines = CallableRef<void(const Tile& tile, int node, Prefetch& lines)>;
  Rows update;
  Lines expect;
};

namespace traversal {
template <class Real>
struct TileWork;
template <class Real>
struct QuadRows;
}  // namespace traversal

/// Workspace of the evaluations on one body; one for each thread of control.
class Traversal {
 public:
  explicit Traversal(const Body& body);

  const Body& body() const { return *body_; }

  /// f = internal forces at displacement u (model frame, u = x - X); psi: rigid rotation of the body about its
  /// axle, positive when rolling forward. Ghosts of u are refreshed; padding of f is not defined. In double precision.
  /// some: of these chains alone; border planes lack what other chains leave there, until an end() of all. Null: all.
  void internal_force(Field& u, double psi, Field& f, const PlasticHistory& history,
                      const std::vector<Chain>* some = nullptr);
  /// f = K u, K the stiffness of the undeformed body.
  void linear_force(Field& u, Field& f, const std::vector<Chain>* some = nullptr);
  /// Strain energy at the displacements u [J].
  StrainEnergy energy(Field& u, double psi, const PlasticHistory& history);

  // -- a step in pieces: begin, every chain once (in parallel if wanted), end
  // ------------------------------------------
  void begin(Field& u, double psi);
  /// Runs in the precision of the body's options.
  template <class Policy>
  void chain_forces(const Chain& chain, const Field& u, Field& f, const PlasticHistory& history, const Policy& policy);
  /// Forces on the border planes of all chains, and on the last station of an open block. some: on these section nodes
  /// of each block alone.
  void end(const std::vector<Chain>& chains, Field& f, const std::vector<std::vector<int>>* some = nullptr);

  /// Forces that the chains leave on the first plane of a tile and behind its last element, [node][component], tile
  /// after tile within a block: for tiles that another rank or device has evaluated; to be put here before end().
  double* front_forces(int tile) { return &border_first_[body_->tiling.border[tile]]; }
  double* rear_forces(int tile) { return &border_end_[body_->tiling.border[tile]]; }

 private:
  struct CarriedFrame {
    Field cosine, sine;  // of the element centres, turned back by psi: R of the element class
  };
  template <Evaluation how>
  void forces(Field& u, double psi, Field& f, const PlasticHistory& history, const std::vector<Chain>* some);
  template <class Real, Evaluation how, class Policy>
  void run_chain(const Chain& chain, const Field& u, Field& f, const PlasticHistory& history, const Policy& policy);
  template <class Real, Evaluation how, SweepKind kind, class Policy>
  void run_tile(int tile, bool follows, const Field& u, Field& f, const PlasticHistory& history, const Policy& policy);
  template <SweepKind kind, class Real, class Policy>
  void complete_nodes(int tile, bool follows, const traversal::TileWork<Real>& work, int quad,
                      const traversal::QuadRows<Real>& rows, Field& f, const Policy& policy);
  StrainEnergy tile_energy(const Tile& tile, const Field& u) const;

  const Body* body_;
  Rotation<double> turn_;
  std::vector<CarriedFrame> frames_;  // per block
  Field border_first_, border_end_;   // forces of a tile on its border planes, [node][component]
  std::vector<Chain> all_chains_;     // of evaluations of the whole body
  std::vector<StrainEnergy> tile_energy_;
};

/// 0 at nodes that are not free.
void clear_held(const Body& body, Field& f);
/// f = K u on the free nodes, 0 elsewhere; slaves follow their masters, in u too.
void free_stiffness(Traversal& elements, Field& u, Field& f);

}  // namespace railstrata
