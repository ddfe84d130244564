#pragma once
// Grading along a line: where the nodes between two points stand when the wanted size varies. All lengths in one unit
// of the caller's choice.
#include <functional>
#include <vector>

namespace railstrata {

/// Points from a to b (both included, a < b) whose spacing follows size(x): the integral of dx / size(x) is divided
/// evenly. At least one interval.
std::vector<double> graded_points(double a, double b, const std::function<double(double)>& size);

/// Spacings that fill `length`: first * ratio, first * ratio^2, … up to `largest`, then equal ones. Few distinct
/// values, so that few element classes arise.
std::vector<double> growing_spacings(double length, double first, double ratio, double largest);

/// Moves the interior point nearest to `value` onto it and stretches the two sides linearly; the ends stay. False
/// (nothing moved) when an end is nearest.
bool snap_interior(std::vector<double>& points, double value);

/// Stations of the blocks of a body: the fine ones of the contact band, the coarse ones of the rest (a subset), and the
/// range of fine spacing reached.
struct StationPair {
  std::vector<double> fine, coarse;
  double fine_begin = 0, fine_end = 0;
};
inline constexpr double kStationGrowth = 1.3;

/// Spacing `step` on [begin, end], the end moved outward to a whole number of coarse steps (ratio * step); outside,
/// over end_length on both sides, growing spacings. Stations of both kinds stand at the planes that lie within the
/// range; from one to the next the spacing is even and as near to `step` as that allows.
StationPair extruded_stations(double begin, double end, double step, int ratio, double end_length, double largest,
                              const std::vector<double>& planes = {});
/// The same closed round a ring of 2 pi; the first station is `begin`, the last one lies below begin + 2 pi. A range
/// that leaves less than four coarse steps of the ring, or is longer than it, makes the whole ring fine: equal
/// spacings, a whole number of coarse ones, fine_end = fine_begin + 2 pi, and no stations at planes.
StationPair ring_stations(double begin, double end, double step, int ratio, double largest,
                          const std::vector<double>& planes = {});
/// A subset of the stations, ends kept, with spacings up to `largest`.
std::vector<double> thinned(const std::vector<double>& stations, double largest);

}  // namespace railstrata
