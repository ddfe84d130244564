#pragma once
// The pads below a rail: which nodes of its base each of them holds, and their forces at rest.
//
// Pads are springs and dashpots at the nodes of the foot's base, spread evenly over a pad's length and the foot's width
// with the shape functions of the stations, so that a pad's resultant lies where the pad does:
//   f_i = share_i (k (u_i - z) + c (v_i - w)),   m dw/dt = sum f_i - k_b z - c_b w
// vertically, with z and w of the sleeper; sideways and along the rail share_i pad_shear (k u_i + c v_i) to the ground.
// Sleepers count from their own equilibrium. fem/track_step.hpp has the step.
#include <vector>

#include "body/body.hpp"
#include "fem/axle_law.hpp"
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
/// Mean by mass of the sections around x.
std::vector<NodeShare> section_mean(const Body& rail, double x, double length);
/// Of the vertical component.
double mean_height(const std::vector<NodeShare>& of, const Field& values);

struct RailPads {
  SleeperTrack track;
  std::vector<double> x;                      ///< m, of the sleepers
  std::vector<std::vector<NodeShare>> nodes;  ///< of each of their pads
  bool none() const { return x.empty(); }
  /// Of a sleeper over the foot above it, at rest.
  double follows() const { return track.pad_stiffness / (track.pad_stiffness + track.ballast_stiffness); }
};
/// On the nodes SweptBody::on_pads of this body; none where there are none. Throws CaseError for a rail on which no
/// sleeper has room.
RailPads rail_pads(const Body& rail, const SleeperTrack& track);

/// Central differences with dashpots of the half step before are stable up to omega² dt² + 2 c dt/m = 4, `safety` of
/// which is the omega dt of the rail alone. Throws CaseError beyond.
void require_stable(const RailPads& pads, const Body& rail, double dt, double safety);

/// f += forces of the pads on sleepers that stand still; negative: on the rail, like internal forces.
void press_on_sleepers(const RailPads& pads, const Field& u, Field& f);
/// f += what the pads lose of them because the sleepers sink until they are in equilibrium.
void let_sleepers_sink(const RailPads& pads, const Field& u, Field& f);
/// In equilibrium below a foot at u, with the velocity that follows the foot's v.
std::vector<MassGroup> sleepers_below(const RailPads& pads, const Field& u, const Field& v);
/// The number of the sleeper nearest to x.
std::size_t sleeper_near(const RailPads& pads, double x);

}  // namespace railstrata
