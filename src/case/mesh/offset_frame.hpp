#pragma once
// The U-shaped section around and below the fine cap: wheel rim, disc and rail block. Surface rows beside the cap, then
// rows down to a flat floor.
#include <functional>
#include <limits>
#include <string>

#include "mesh/contact_band.hpp"
#include "mesh/grading.hpp"

namespace railstrata {

inline constexpr double kColumnStart = 1.2;  ///< first column beside the fine ones / h
inline constexpr double kColumnSlope =
    0.33;  ///< growth of the column size per distance: neighbours differ by a factor of at most 1.4
inline constexpr double kLargestAspect = 20;  ///< of the far elements, longest edge / h

/// Station spacing far from the contact.
double far_spacing(const MeshSizes& sizes);
/// Element size under a band of the given depth: what the stress needs there, at least coarse_ratio * h, at most half
/// the largest.
double under_band_size(const MeshSizes& sizes, double depth);
/// Largest height of the rows beside the cap.
double side_row_height(const MeshSizes& sizes, double depth);
/// intervals + 1 of the columns (all of them if there are fewer), the first and last kept, about evenly spaced at the
/// given depth.
std::vector<double> column_subset(const Profile& profile, const std::vector<double>& s, double depth,
                                  std::size_t intervals);
/// Number of intervals of about `size` in the polyline of the columns' points at a depth, at least one.
std::size_t intervals_at_depth(const Profile& profile, const std::vector<double>& s, double depth, double size);

/// The differences between the bodies, in the profile frame (z may run either way).
struct OffsetFrameSpec {
  std::string name, carrier;                               ///< of the block, in messages
  double width = std::numeric_limits<double>::infinity();  ///< where it is narrower than the profile
  std::pair<double, double> fine_range;                    ///< arc lengths the fine columns keep within
  std::pair<double, double> tread_range;                   ///< arc lengths with columns along the normals
  double band_limit = 0;                                   ///< deepest band
  double floor = 0;                                        ///< z of the flat inner boundary
  bool layered_ends = false;                               ///< do layers continue beyond the tread range?
  /// Surface beyond the tread columns, which end at s: from the section's left corner to s / from s to the right
  /// corner, s itself excluded.
  std::function<std::vector<Vec2>(double s)> left_top, right_top;
  /// The section's sides beside the rows of the band, which ends at s, from its corners down: one point per row.
  std::function<std::vector<Vec2>(const std::vector<double>&depth, double s)> left_side, right_side;
  std::vector<double> floor_breaks;  ///< y at which the floor must have a node
};

struct FrameNodes {
  int block = 0;
  NodeLine floor;
};

/// Appends the cap (contact band) and the frame to the body, tied, and fills body.contact.
FrameNodes add_offset_frame(SweptBody& body, const Profile& profile, double contact_s,
                            const std::vector<LayerMesh>& layers, const MeshSizes& sizes, const OffsetFrameSpec& spec,
                            Stations cap_stations, Stations frame_stations, const StationPair& range);

}  // namespace railstrata
