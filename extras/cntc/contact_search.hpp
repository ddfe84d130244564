#pragma once
// Where a rigid wheel overlaps a rail or a roller, by CONTACT's rules for the reference point of a patch.
// [eve70a/CONTACT, user guide, wheel-rail contact search]
//
// All in the system of the track (marker.hpp), m. Seen from above the wheel's lowest points over x are a line over y,
// z_w(y); where its gap z_r - z_w is negative lies a region. Weights are those of the gap squared, parabolic along x,
// (-gap)^(5/2) dy, and the region's centre is the mean of x and y, its angle that of the rail's inclination.
#include <optional>
#include <vector>

#include "cntc/curved_row.hpp"
#include "cntc/marker.hpp"
#include "cntc/outline.hpp"

namespace railstrata::cntc {

/// Two bodies where they stand. The wheel turns about the axis z = -radius of its own system, the roller about z =
/// +roller_radius of its; 0: a rail.
struct RigidPair {
  const Outline* rail = nullptr;
  const Outline* wheel = nullptr;
  Marker rail_at, wheel_at;  ///< of the profiles in the track
  double wheel_radius = 0, roller_radius = 0;
};

struct Box {
  double x[2], y[2], z[2];  ///< z: of the rail at the ends of y
};

struct Overlap {
  Box extent;
  double x = 0, y = 0, angle = 0;  ///< weighted
  double weight = 0;
  bool at_end = false;     ///< reaches to where one of the bodies ends
  std::vector<Box> parts;  ///< regions that act on each other in part; one: the whole
};

struct SearchSteps {
  double dx = 0, ds = 0;                                  ///< elements
  double angle = 0, separate = 0, combine = 0, turn = 0;  ///< A_SEP, D_SEP, D_COMB, D_TURN
};

struct Search {
  std::vector<Overlap> overlaps;  ///< from the field side to the middle of the track
  double least_gap = 0;           ///< < 0: they overlap; how far the wheel may come down (z) until it touches
};

/// Throws Refused where the wheel does not stand over the rail.
Search search_overlaps(const RigidPair& pair, const SearchSteps& steps);

/// By how much two parts of an overlap act on each other, 0 to 1.
double interaction(const Box& a, const Box& b, const SearchSteps& steps);

/// Elements of a patch in the plane of its reference system (n down, into the rail), centred on multiples of their
/// sides from an origin, in whose coordinates the reference lies at origin_x, origin_s.
struct PatchPlane {
  Marker reference;
  double angle = 0;
  int mx = 0, my = 0;
  double x = 0, s = 0, dx = 0, ds = 0;  ///< of the first element's centre from the reference; sides
  double origin_x = 0, origin_s = 0;
  double rail_arc = 0;            ///< m, of the reference along the rail's profile
  double reach[2]{};              ///< m, from there to the ends of the overlap
  std::vector<CurvedRow> rows{};  ///< of a patch on a curved surface; empty: a plane

  /// Of a row of elements from the reference, in the plane and along the rows.
  double across(int j) const { return rows.empty() ? along_row(j) : rows[static_cast<std::size_t>(j)].s; }
  double along_row(int j) const { return s + j * ds; }
};
/// Where elements have to be those of the case before (T = 1 and 2): along the rail, x of the track's origin, and from
/// the middle of the rail's profile.
using Lattice = std::optional<double>;
PatchPlane plane_of(const Overlap& overlap, const RigidPair& pair, const SearchSteps& steps, int most_elements,
                    Lattice lattice);

/// The rigid distance of wheel and rail along n (of a curved patch: along its rows' normals), in the order of the
/// elements (x fastest), less its minimum.
struct Distance {
  std::vector<double> gap;              ///< m
  double approach = 0;                  ///< minus the minimum
  std::vector<double> rail, wheel;      ///< m, along n from the plane
  std::vector<unsigned char> has_both;  ///< neither of the bodies has ended
};
Distance rigid_distance(const RigidPair& pair, const PatchPlane& plane);

}  // namespace railstrata::cntc
