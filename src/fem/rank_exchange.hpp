#pragma once
// What the ranks of one run give to one another (core/ranks.hpp).
//
// Every rank has both bodies whole in its memory. Each evaluates the elements of its own tiles (body/tile_cut.hpp) and
// updates the nodes within them whose forces come from elements alone: that is nearly all of the work. Everything else
// is done by every rank for itself, from the same numbers in the same order: border planes, ties, contact, mass
// scaling, running surface, axle. So a step has one exchange,
//
//   forces   on both sides of the border planes between stretches (between all tiles where sums over nodes are wanted);
//            on all lines that the rest of the step reads: running surface, ties, bore, nodes with added mass or local
//            steps; sums of the nodes that were updated on the way
//
// after which all ranks go on alike. What a rank does not know is the inside of the others' tiles. complete() brings it
// where it is asked for: energies, samples, checkpoints, looks at all elements that may yield.
#include <array>
#include <vector>

#include "fem/node_update.hpp"
#include "fem/part_exchange.hpp"

namespace railstrata {

class RankExchange {
 public:
  /// `bodies`: already cut.
  RankExchange(const Ranks& ranks, const RollingBodies& bodies);

  /// To be called before a step: brings what it will read of other ranks' tiles.
  void prepare(const RollingBodies& bodies, BodyStates& states, const StepScope& scope);
  /// Two numbers of the step that all ranks must have to the last bit; they go with its forces.
  void mark(double first, double second) { mark_ = {first, second}; }
  /// After a rank's own chains: forces on border planes and lines, as one rank alone would have them. Throws
  /// EnvironmentError when a rank computes other bits.
  void share_forces(RollingBodies& bodies, BodyStates& states, const StepScope& scope);
  /// Displacements, velocities and history of all tiles to every rank.
  void complete(const RollingBodies& bodies, BodyStates& states);

  /// Bytes that a rank receives in a step, the most of all ranks: of the usual steps, and of those with sums.
  std::array<double, 2> step_bytes() const;

 private:
  enum Kind { plain, measured, whole, kKinds };  // steps: fused, fused with sums, energies
  static Kind kind_of(const StepScope& scope);
  template <class Visit>
  void each_force(int rank, Kind kind, RollingBodies& bodies, BodyStates& states, Visit&& visit);
  template <class Visit>
  void each_value(int rank, const RollingBodies& bodies, BodyStates& states, Field BodyState::*field,
                  Visit&& visit) const;
  template <class Visit>
  void each_slot(int rank, const RollingBodies& bodies, BodyStates& states, Visit&& visit) const;
  void count_forces(const RollingBodies& bodies);

  Ranks ranks_;
  PartExchange exchange_;
  std::vector<Stretch> stretches_;
  std::array<std::vector<Chain>, 2> borders_;                 // by body: the stretches as chains
  std::array<std::vector<std::vector<int>>, 2> lines_;        // by body and block: nodes whose forces all ranks read
  std::array<std::vector<std::vector<int>>, 2> inner_nodes_;  // likewise: those that the owner alone updates
  std::vector<Chain> own_chains_;
  std::array<double, 2> mark_{};
  std::vector<double> marks_;  // of all ranks
  std::array<std::vector<std::ptrdiff_t>, kKinds> counts_;
  bool planes_known_ = true, all_known_ = true;  // u and v on all planes between tiles; everywhere, with the history
};

}  // namespace railstrata
