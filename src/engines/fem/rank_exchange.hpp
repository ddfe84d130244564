#pragma once
// Data that the ranks of one run exchange (core/ranks.hpp).
//
// Every rank has both bodies whole in its memory. Each evaluates the elements of its own tiles (body/tile_cut.hpp) and
// updates the nodes within them whose forces come from elements alone: that is nearly all of the work. Lines of nodes
// at ties, on the running surface and with added mass are updated by the ranks that look at them, where they look
// (fem/line_reach.hpp); border planes, contact and axle by every rank for itself, from the same numbers in the same
// order. So a step has one exchange of
//
//   forces on both sides of the border planes between stretches; on lines where another rank collects them; on the bore
//
//   moments that the offsets of ties hand to the wheel's rotation
//
// after which all ranks go on alike; where sums over the nodes are wanted a second, of some numbers a tile. What a rank
// does not know is the inside of the others' tiles; complete() brings it where it is asked for: energies, samples,
// checkpoints, looks at all elements that may yield.
#include <array>
#include <vector>

#include "fem/line_reach.hpp"
#include "fem/node_update.hpp"
#include "fem/part_exchange.hpp"

namespace railstrata {

class RankExchange {
 public:
  /// `bodies`: already cut, and at the start.
  RankExchange(const Ranks& ranks, const Model& model, RollingBodies& bodies);

  /// To be called before a step: receives what the step will read of other ranks' tiles, and sets which part of
  /// the bodies' lines this rank has (RollingBody::part).
  void prepare(RollingBodies& bodies, BodyStates& states, const StepScope& scope, const AxlePose& pose);
  /// Two numbers of the step that all ranks must have to the last bit; they go with its forces.
  void mark(double first, double second) { mark_ = {first, second}; }
  /// After a rank's own chains: forces on border planes and lines, as one rank alone would have them. Throws
  /// EnvironmentError when a rank computes other bits.
  void share_forces(RollingBodies& bodies, BodyStates& states, const std::array<double, 2>& drift,
                    const StepScope& scope);
  /// Sums over the nodes of all tiles to every rank (UpdateSchedule::tile_sums).
  void share_sums(RollingBodies& bodies);
  /// Displacements, velocities and history of all tiles to every rank.
  void complete(const RollingBodies& bodies, BodyStates& states);

 private:
  void place_windows(RollingBodies& bodies, const AxlePose& pose);
  bool left_windows(const AxlePose& pose) const;
  double* moment_pieces(const Stretch& s, const Ties& ties, int line);
  void own_moments(const RollingBodies& bodies, BodyStates& states, const std::array<double, 2>& drift);

  Ranks ranks_;
  PartExchange exchange_;
  std::vector<Stretch> stretches_;
  std::array<std::vector<Chain>, 2> borders_;  // by body: the stretches as chains
  std::array<NodesOfBlocks, 2> lines_;         // by body and block: nodes of which others read forces
  std::array<NodesOfBlocks, 2> bore_;          // likewise: all stations of them
  std::array<NodesOfBlocks, 2> slaves_;        // likewise: lines of ties (Ties::lines) that have moments
  std::array<NodesOfBlocks, 2> inner_nodes_;   // likewise: those that the owner alone updates
  AxlePose placed_;                            // of the axle when windows were placed
  std::array<TiedPart, 2> parts_;              // of this rank
  std::vector<SentRanges> sent_;               // by stretch
  std::vector<Chain> own_chains_;
  std::array<double, 2> mark_{};
  std::vector<double> marks_;  // of all ranks
  ContactWindow window_;
  bool all_known_ = true;  // u, v and history of all tiles
};

}  // namespace railstrata
