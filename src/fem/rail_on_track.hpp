#pragma once
// The rail on pads and rigid sleepers, and what a blow of a hammer on its head does to it.
//
// Pads are springs and dashpots at the nodes of the foot's base, spread evenly over a pad's length and the foot's width
// with the shape functions of the stations, so that a pad's resultant lies where the pad does:
//   f_i = share_i (k (u_i - z) + c (v_i - w)),   m dw/dt = sum f_i - k_b z - c_b w
// vertically, with z and w of the sleeper; sideways and along the rail share_i pad_shear (k u_i + c v_i) to the ground.
// Displacements count from the equilibrium under the weights. Central differences as in fem/stepper.hpp; dashpots of
// pads and ballast take the velocity of the half step before, those at the ends the mean of both.
#include <functional>
#include <vector>

#include "body/body.hpp"
#include "track/sleeper_track.hpp"

namespace railstrata {

/// A share of a force or a mean at a node: index of its component x and the stride to y.
struct NodeShare {
  std::ptrdiff_t index;
  int stride;
  double share;
};
/// Even over `length` [m] along the sweep around x and over the width of these nodes; sum 1. Throws CaseError beyond
/// the ends of the rail.
std::vector<NodeShare> spread_along(const Body& body, std::vector<SectionNode> nodes, double x, double length);

struct RailPads {
  SleeperTrack track;
  std::vector<double> x;                      ///< m, of the sleepers
  std::vector<std::vector<NodeShare>> nodes;  ///< of each of their pads
};
/// base: nodes of the foot's base, free in this body.
RailPads rail_pads(const Body& rail, const std::vector<SectionNode>& base, const SleeperTrack& track);

struct HammerBlow {
  double x = 0;         ///< m, on the running surface
  double duration = 0;  ///< s, of a force (1 - cos(2 pi t/duration))/2 of 1 N at most
  double time = 0;      ///< s, followed
  double safety = 0.9;  ///< of the stable step
};

/// Sums over the blow, J.
struct BlowEnergy {
  double supplied = 0;                     ///< by the hammer
  double pads = 0, ballast = 0, ends = 0;  ///< dissipated
  double kept = 0;                         ///< kinetic and elastic, at the end
  double closure() const { return kept + pads + ballast + ends - supplied; }
};

struct BlowResponse {
  double dt = 0;                             ///< s
  std::vector<double> force, section, head;  ///< by step: N; m, mean of the section by mass, and where the force acts
  BlowEnergy energy;
};

/// progress: share done; may be empty. Throws CaseError where the pads ask for a shorter step.
BlowResponse strike(const Body& rail, const RailPads& pads, const HammerBlow& blow,
                    const std::function<void(double)>& progress = {});

}  // namespace railstrata
