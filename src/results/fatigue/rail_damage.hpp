#pragma once
// Damage of the rail by the passages of a load collective, summed by position across it.
//
// A position is the arc length s along the rail's profile: cells of one length. A streamline's strip lies between the
// points of the profile nearest to its two edges, and its area (depth times width) is spread over it: the sum over the
// cells times their length is the sum over the streamlines times their width, whatever the curvature.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "fatigue/streamlines.hpp"
#include "geometry/placement.hpp"

namespace railstrata {

/// m, beyond which the wear of one profile says nothing of the rail's: the contact has long moved.
inline constexpr double kMostWearOfOneProfile = 1e-3;

/// Wear of rail or wheel by position.
struct ProfileWear {
  double cell = 0;                         ///< m, length of a cell along the profile
  std::vector<double> s, y, z;             ///< m, middles of the cells; y, z in the profile's own frame
  std::vector<double> usfd, archard, kth;  ///< m, of the wheel m per m rolled; NaN where rolled over without the data
                                           ///< they need
  /// The wear depth by one of the laws.
  const std::vector<double>& depth(WearLaw law) const;
};

struct RailDamage : ProfileWear {
  std::vector<double> passages;         ///< of wheels whose patch covers the cell
  std::vector<double> friction_energy;  ///< J/m²
  std::vector<double> rcf_damage;       ///< sum of the damage function of the patches over the cell
};

/// No wear yet. The profile is cut into cells of at most `cell` [m].
ProfileWear unworn(const Profile& profile, double cell);
/// No damage yet, on such cells.
RailDamage undamaged(const Profile& rail, double cell);

/// Arc lengths on a profile.
struct Strip {
  double from = 0, to = 0;
};

/// Calls with every cell that the strip touches and the length within it [m].
template <class Use>
void for_cells(const ProfileWear& damage, const Strip& strip, const Use& use) {
  const double begin = damage.s.front() - 0.5 * damage.cell;
  const auto last = static_cast<std::ptrdiff_t>(damage.s.size()) - 1;
  const auto cell_at = [&](double s) {
    return std::clamp(static_cast<std::ptrdiff_t>(std::floor((s - begin) / damage.cell)), std::ptrdiff_t{0}, last);
  };
  for (std::ptrdiff_t i = cell_at(strip.from); i <= cell_at(strip.to); ++i) {
    const double from = begin + static_cast<double>(i) * damage.cell;
    const double length = std::min(strip.to, from + damage.cell) - std::max(strip.from, from);
    if (length > 0) use(static_cast<std::size_t>(i), length);
  }
}

/// Damage by one patch in one passage, and its position.
struct PatchDamage {
  RigidContact contact;
  std::vector<StreamlineRow> rows;
  double rcf_damage = 0;  ///< over the whole width of the patch
};

/// Adds so many passages of a patch.
void add_passages(RailDamage& damage, const Profile& rail, const TrackGeometry& track, const PatchDamage& patch,
                  double passages);

/// Shares of wheels that run so far aside of their mean place, by a normal distribution cut at three deviations; one
/// without a deviation. At most `step` [m] apart. The shares add up to one.
struct AsideShare {
  double offset = 0, share = 1;  ///< m
};
std::vector<AsideShare> aside_shares(double deviation, double step);

/// Spreads values of cells of one length so; what would lie beyond the profile stays in its last cell, the sum stays.
void spread_aside(std::vector<double>& cells, double cell, double deviation);
/// All that the damage has.
void spread_aside(RailDamage& damage, double deviation);

/// m²: the sum over the cells of a depth [m]; of the wheel m² per m rolled.
double worn_area(const ProfileWear& damage, const std::vector<double>& depth);

/// The wear depth of every cell [m]: neighbouring cells that wheels have rolled over exchange a quarter of their
/// difference, at least once, until a peak of one cell has a standard deviation of 1 mm; the area stays.
std::vector<double> smoothed_wear(const RailDamage& damage, WearLaw law);

/// Arc length of the profile's point nearest to a point, both in the profile's own frame, from a guess near it.
double nearest_on(const Profile& profile, Vec2 point, double guess);
/// The same of a point of the model frame.
double nearest_on_rail(const Profile& rail, const TrackGeometry& track, Vec2 point, double guess);

}  // namespace railstrata
