#include "mesh/bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/faults.hpp"
#include "geometry/rail_outline.hpp"
#include "mesh/contact_band.hpp"
#include "mesh/grading.hpp"
#include "mesh/layer_stacks.hpp"
#include "mesh/offset_frame.hpp"
#include "mesh/rail_sections.hpp"
#include "mesh/split_interface.hpp"

namespace railstrata {

namespace {

constexpr double kCornerAngle = std::numbers::pi / 4;
constexpr double kFlankDepth = 22e-3;      // of the band's ends below the crown
constexpr double kLowFlankDepth = 30e-3;   // of a section's where the fine columns go down the flank
constexpr double kFlankBesideFine = 4e-3;  // m, at least
constexpr double kBandOfRadius =
    0.85;  // deepest band / smallest head radius: the columns of the corner keep a seventh of their width
constexpr double kArcPerColumn = 0.46;  // rad, of the smallest radius

/// Columns of the band beside the fine ones on one side, as distances from the fine columns' edge.
struct SideColumns {
  std::vector<double> distance;
  std::size_t corner = 0;
};

SideColumns side_columns(double to_corner, double to_end, double h, double largest, const std::vector<double>& edges) {
  const auto size = [&](double d) { return std::min(largest, kColumnStart * h + kColumnSlope * d); };
  for (double e : edges)
    if (std::abs(e - to_corner) < 0.6 * size(to_corner)) to_corner = e;
  SideColumns out;
  std::vector<double> upper{0.0};
  if (to_corner > 0.5 * h)
    upper = graded_points(0, to_corner, size);
  else
    to_corner = 0;
  std::vector<double> lower = graded_points(to_corner, to_end, size);
  while (lower.size() < 3) lower.insert(lower.begin() + 1, 0.5 * (lower[0] + lower[1]));
  for (double e : edges) {
    if (e > 0.5 * h && e < to_corner) snap_interior(upper, e);
    if (e > to_corner && e < to_end) snap_interior(lower, e);
  }
  out.distance = upper;
  out.corner = upper.size() - 1;
  out.distance.insert(out.distance.end(), lower.begin() + 1, lower.end());
  return out;
}

/// Arc length at which the flank is so deep below the crown, or the profile's end.
double flank_end(const Profile& profile, double from, double last, double depth) {
  double shallow = from, deep = last;
  if (profile.at(deep).position.z > -depth) return deep;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (shallow + deep);
    (profile.at(middle).position.z > -depth ? shallow : deep) = middle;
  }
  return deep;
}

/// Ends of the band on the flanks; lower where fine columns of a section ask for it.
std::pair<double, double> flank_ends(const Profile& profile, std::pair<double, double> corners, double contact_s,
                                     const MeshSizes& sizes) {
  const auto ends = [&](double depth) {
    return std::pair{flank_end(profile, corners.first, profile.s_min(), depth),
                     flank_end(profile, corners.second, profile.s_max(), depth)};
  };
  std::pair<double, double> out = ends(kFlankDepth);
  const std::pair low = ends(kLowFlankDepth);
  const double beside = 0.5 * sizes.fine_width + kFlankBesideFine;
  if (sizes.to_sides && contact_s - beside < out.first) out.first = low.first;
  if (sizes.to_sides && contact_s + beside > out.second) out.second = low.second;
  return out;
}

struct RailBand {
  std::pair<double, double> corners;      // arc lengths
  std::vector<double> left, fine, right;  // arc lengths, each increasing
  SideColumns left_side, right_side;
  BandRows rows, side_rows;
  double element = 0;  // size of the elements under the band
};

RailBand rail_band(const Profile& profile, const RailMeshSpec& spec, const MeshSizes& sizes) {
  RailBand band;
  const double h = sizes.element;
  const std::pair corners = band.corners = running_range(profile, kCornerAngle);
  const auto [begin, end] = flank_ends(profile, corners, spec.contact_s, sizes);
  const std::pair sides{begin + kFlankBesideFine, end - kFlankBesideFine};
  band.fine = fine_columns(spec.contact_s, h, sizes.fine_width, sizes.to_sides ? sides : corners, "rail");
  const double radius = smallest_convex_radius(profile, begin, end);
  band.rows = band_rows(spec.layers, h, sizes.fine_depth, kBandOfRadius * radius, "head");
  const double depth = band.rows.depth.back();
  band.side_rows = merged_rows(band.rows, side_row_height(sizes, depth));
  band.element = under_band_size(sizes, depth);

  const double low = band.fine.front(), high = band.fine.back();
  const double largest = std::max(h, std::min(0.5 * sizes.largest, kArcPerColumn * radius));
  std::vector<double> left_edges, right_edges;
  for (double s : layer_edges(profile, spec.layers, "head", profile.y_max() - profile.y_min())) {
    left_edges.push_back(low - s);
    right_edges.push_back(s - high);
  }
  band.left_side = side_columns(low - corners.first, low - begin, h, largest, left_edges);
  band.right_side = side_columns(corners.second - high, end - high, h, largest, right_edges);
  for (double d : band.left_side.distance) band.left.push_back(low - d);
  std::reverse(band.left.begin(), band.left.end());
  for (double d : band.right_side.distance) band.right.push_back(high + d);
  return band;
}

/// The columns between the places where the head's parts meet: flank, top, fine, top, flank. A corner that fine columns
/// pass is at the nearest of them, and a top beside them then is one column.
std::array<std::vector<double>, 5> columns_of_parts(const RailBand& band) {
  std::vector<double> all = band.left;
  all.insert(all.end(), band.fine.begin() + 1, band.fine.end());
  all.insert(all.end(), band.right.begin() + 1, band.right.end());
  const std::size_t first = band.left.size() - 1, last = first + band.fine.size() - 1;
  const auto nearest = [&](double s) {
    const auto nearer = [&](double a, double b) { return std::abs(a - s) < std::abs(b - s); };
    return first + (std::min_element(band.fine.begin(), band.fine.end(), nearer) - band.fine.begin());
  };
  const std::size_t left = band.corners.first > band.fine.front() ? nearest(band.corners.first)
                                                                  : first - band.left_side.corner,
                    right = band.corners.second < band.fine.back() ? nearest(band.corners.second)
                                                                   : last + band.right_side.corner,
                    from = std::max(left, first), to = std::min(right, last);
  const auto part = [&](std::size_t a, std::size_t b) {
    return std::vector<double>(all.begin() + a, all.begin() + b + 1);
  };
  return {part(0, left), part(left, from), part(from, to), part(to, right), part(right, all.size() - 1)};
}

HeadBoundary head_boundary(const Profile& profile, const RailBand& band) {
  const double depth = band.rows.depth.back();
  const auto [left_flank, left_top, fine, right_top, right_flank] = columns_of_parts(band);
  const auto wanted = [&](const std::vector<double>& s) { return intervals_at_depth(profile, s, depth, band.element); };
  const std::size_t flank =
      std::min({std::max<std::size_t>(2, wanted(right_flank)), left_flank.size() - 1, right_flank.size() - 1});

  std::vector<double> s{band.left.front()};
  const auto append = [&](const std::vector<double>& part, std::size_t intervals) {
    const std::vector<double> chosen = column_subset(profile, part, depth, intervals);
    s.insert(s.end(), chosen.begin() + 1, chosen.end());
  };
  append(left_flank, flank);
  if (left_top.size() > 1) append(left_top, wanted(left_top));
  append(fine, wanted(fine));
  if (right_top.size() > 1) append(right_top, wanted(right_top));
  append(right_flank, flank);

  HeadBoundary out;
  for (double at : s) out.under_band.push_back(offset_point(profile, at, depth));
  out.left_corner = flank;
  out.right_corner = s.size() - 1 - flank;
  out.left_flank = profile.at(band.left.front()).position;
  out.right_flank = profile.at(band.right.back()).position;
  if (out.under_band[out.right_corner].z - out.under_band.back().z < 2e-3 ||
      out.under_band[out.left_corner].z - out.under_band.front().z < 2e-3)
    throw CaseError(fmt::format("the rail profile '{}' does not reach far enough down its flanks", profile.name()),
                    "give a profile down to 20 mm below the crown, or use rail_shape = \"block\"");
  return out;
}

struct BandBlock {
  Block block;
  std::vector<NodeLine> rows;
};

BandBlock band_block(const char* name, const Profile& profile, const std::vector<double>& s, const BandRows& rows,
                     const std::vector<LayerMesh>& layers, const std::vector<Vec2>& seat,
                     const std::vector<double>& stations) {
  BandBlock out{{name, {}, {stations, false}}, {}};
  out.rows = add_band(out.block.section, profile, s, rows, layers);
  seat_on_line(out.block.section, out.rows, seat);
  return out;
}

enum RailBlock { kCap, kLeftShell, kRightShell, kHead, kFoot };

void tie_rail(SweptBody& body, const BandBlock& cap, const BandBlock& left, const BandBlock& right,
              const HeadSection& head, const FootSection& foot) {
  NodeLine cap_left = column_of(cap.rows, 0), cap_right = column_of(cap.rows, cap.rows[0].size() - 1);
  cap_left.pop_back();
  cap_right.pop_back();
  tie_to_line(body, kCap, cap_left, kLeftShell, column_of(left.rows, left.rows[0].size() - 1));
  tie_to_line(body, kCap, cap_right, kRightShell, column_of(right.rows, 0));
  tie_to_line(body, kCap, cap.rows.back(), kHead, head.under_band);

  NodeLine left_end = column_of(left.rows, 0), right_end = column_of(right.rows, right.rows[0].size() - 1);
  left_end.pop_back();
  right_end.pop_back();
  tie_to_line(body, kLeftShell, left_end, kHead, head.left_face);
  tie_to_line(body, kLeftShell, left.rows.back(), kHead, head.under_band);
  tie_to_line(body, kRightShell, right_end, kHead, head.right_face);
  tie_to_line(body, kRightShell, right.rows.back(), kHead, head.under_band);

  tie_to_line(body, kHead, head.web_line, kFoot, foot.web_line);
}

void fill_rail(SweptBody& body, const Profile& profile, const RailMeshSpec& spec, const MeshSizes& sizes,
               const StationPair& stations) {
  const RailBand band = rail_band(profile, spec, sizes);
  const HeadBoundary boundary = head_boundary(profile, band);
  const LowerOutline lower = lower_outline(rail_outline(profile, spec.section));
  HeadSection head = head_section(boundary, lower, band.element);
  FootSection foot = foot_section(lower, sizes.largest);
  BandBlock cap = band_block("cap", profile, band.fine, band.rows, spec.layers, boundary.under_band, stations.fine);
  BandBlock left =
      band_block("gauge shell", profile, band.left, band.side_rows, spec.layers, boundary.under_band, stations.coarse);
  BandBlock right =
      band_block("field shell", profile, band.right, band.side_rows, spec.layers, boundary.under_band, stations.coarse);

  body.contact = {kCap,
                  static_cast<int>(band.fine.size()) - 1,
                  band.rows.count(),
                  band.fine,
                  band.rows.depth,
                  stations.fine_begin,
                  stations.fine_end};
  body.blocks = {cap.block,
                 left.block,
                 right.block,
                 {"head", head.section, {stations.coarse, false}},
                 {"foot", foot.section, {thinned(stations.coarse, sizes.largest), false}}};
  tie_rail(body, cap, left, right, head, foot);
  for (int node : foot.base) body.prescribed.push_back({kFoot, node});
}

void fill_block(SweptBody& body, const Profile& profile, const RailMeshSpec& spec, const MeshSizes& sizes,
                const StationPair& stations) {
  const double half = 0.5 * spec.block_width;
  if (half > std::min(-profile.y_min(), profile.y_max()))
    throw CaseError(fmt::format("rail block wider than the rail's profile: {:g} mm", 1e3 * spec.block_width),
                    "reduce block_width");
  const double low = profile.s_at_y(-half), high = profile.s_at_y(half);
  const double end = sizes.to_sides ? sizes.element : std::max(4e-3, sizes.element);
  MeshSizes own = sizes;
  double contact_s = spec.contact_s;
  if (sizes.to_sides) {  // as many columns as there is room for, also beside the contact
    own.fine_width = std::min(own.fine_width, own.element * std::floor((high - low - 2 * end) / own.element + 1e-9));
    contact_s = std::clamp(contact_s, low + end + 0.5 * own.fine_width, high - end - 0.5 * own.fine_width);
  }

  OffsetFrameSpec frame;
  frame.name = "block";
  frame.carrier = "block";
  frame.width = spec.block_width;
  frame.fine_range = {low + end, high - end};
  frame.tread_range = frame.fine_range;
  frame.band_limit = std::min(0.4 * spec.block_height, kBandOfRadius * smallest_convex_radius(profile, low, high));
  frame.floor = -spec.block_height;
  frame.layered_ends = true;
  const auto side = [&](double s, double y) {
    return [&profile, s, y](const std::vector<double>& depth, double) {
      const ProfilePoint p = profile.at(s);
      std::vector<Vec2> line;
      for (double d : depth) line.push_back({y, p.position.z - d / p.outward.z});
      return line;
    };
  };
  frame.left_top = [&](double) { return std::vector<Vec2>{profile.at(low).position}; };
  frame.right_top = [&](double) { return std::vector<Vec2>{profile.at(high).position}; };
  frame.left_side = side(low, -half);
  frame.right_side = side(high, half);
  const FrameNodes nodes = add_offset_frame(body, profile, contact_s, spec.layers, own, frame, {stations.fine, false},
                                            {stations.coarse, false}, stations);
  for (int node : nodes.floor) body.prescribed.push_back({nodes.block, node});
}

}  // namespace

SweptBody mesh_rail(const Profile& profile, const TrackGeometry& track, const RailMeshSpec& spec,
                    const MeshSizes& sizes) {
  SweptBody body;
  body.name = "rail";
  body.kind = SweepKind::extrude;
  body.materials = material_names(spec.layers);
  body.material_layer = material_layers(spec.layers);
  const StationPair stations = extruded_stations(spec.x_begin, spec.x_end, sizes.element, sizes.coarse_ratio,
                                                 spec.end_length, far_spacing(sizes), spec.planes);
  RailMeshSpec whole = spec;
  whole.layers = slabs_of(spec.layers);
  if (spec.shape == RailShape::rail)
    fill_rail(body, profile, whole, sizes, stations);
  else
    fill_block(body, profile, whole, sizes, stations);
  set_stacks(body, spec.layers, 1.0);
  split_interfaces(body, spec.layers);
  for (Block& block : body.blocks)
    for (Vec2& p : block.section.nodes) p = rail_to_model(track, p);
  return body;
}

}  // namespace railstrata
