#include "mesh/offset_frame.hpp"

#include <algorithm>
#include <cmath>

namespace railstrata {

namespace {

std::vector<double> tread_columns(double edge, double end, const MeshSizes& sizes,
                                  const std::vector<double>& layer_ends) {
  const double sign = end < edge ? -1 : 1;
  double length = std::abs(end - edge);
  const auto size = [&](double d) { return std::min(sizes.largest, kColumnStart * sizes.element + kColumnSlope * d); };
  for (double s : layer_ends) {
    const double d = sign * (s - edge);
    if (d > 0.5 * sizes.element && d < length && length - d < 0.6 * size(length)) length = d;
  }
  if (length < 0.5 * sizes.element) return {edge};
  std::vector<double> distance = graded_points(0, length, size);
  for (double s : layer_ends) {
    const double d = sign * (s - edge);
    if (d > 0.5 * sizes.element && d < length) snap_interior(distance, d);
  }
  std::vector<double> out;
  for (double d : distance) out.push_back(edge + sign * d);
  std::sort(out.begin(), out.end());
  return out;
}

void set_materials(Section& section, std::size_t first_quad, const BandRows& rows,
                   const std::vector<LayerMesh>& layers) {
  const std::size_t columns = (section.quads.size() - first_quad) / rows.count();
  for (std::size_t q = first_quad; q < section.quads.size(); ++q) {
    double y = 0;
    for (int node : section.quads[q]) y += 0.25 * section.nodes[node].y;
    section.quad_material[q] = material_at(rows, static_cast<int>((q - first_quad) / columns), y, layers);
  }
}

/// Fractions of the floor's nodes: proportional to those of the line above, with nodes at the breaks.
std::vector<double> floor_positions(const Section& section, const NodeLine& above, const std::vector<double>& breaks) {
  std::vector<double> y;
  const double n = static_cast<double>(above.size() - 1), y0 = section.nodes[above.front()].y,
               y1 = section.nodes[above.back()].y;
  for (std::size_t i = 0; i < above.size(); ++i)
    y.push_back(0.6 * section.nodes[above[i]].y + 0.4 * (y0 + (y1 - y0) * static_cast<double>(i) / n));
  for (double b : breaks) {
    const auto at = std::min_element(y.begin() + 1, y.end() - 1,
                                     [&](double p, double q) { return std::abs(p - b) < std::abs(q - b); });
    *at = b;
  }
  return y;
}

/// Lengths along the polyline of the columns' points at a depth.
std::vector<double> walked_at_depth(const Profile& profile, const std::vector<double>& s, double depth) {
  std::vector<double> out{0.0};
  for (std::size_t i = 1; i < s.size(); ++i)
    out.push_back(out.back() + norm(offset_point(profile, s[i], depth) - offset_point(profile, s[i - 1], depth)));
  return out;
}

struct Side {
  std::vector<NodeLine> tread;  ///< node rows of the tread columns
  NodeLine end_bottom;          ///< bottom row beyond the tread, left to right
  int corner_bottom = 0;
};

Side add_side(Section& section, const Profile& profile, const std::vector<double>& tread_s, const BandRows& rows,
              const std::vector<LayerMesh>& layers, const std::vector<Vec2>& top, const std::vector<Vec2>& boundary,
              bool left, bool layered) {
  Side out;
  out.tread = add_band(section, profile, tread_s, rows, layers);
  const std::size_t inner_column = left ? 0 : tread_s.size() - 1;
  const NodeLine inner = column_of(out.tread, inner_column), outer = add_nodes(section, boundary);
  NodeLine surface = add_nodes(
      section, left ? std::vector<Vec2>(top.begin() + 1, top.end()) : std::vector<Vec2>(top.begin(), top.end() - 1));
  if (left) {
    surface.insert(surface.begin(), outer.front());
    surface.push_back(inner.front());
    out.end_bottom = add_straight(section, outer.back(), inner.back(), static_cast<int>(surface.size()) - 1);
  } else {
    surface.insert(surface.begin(), inner.front());
    surface.push_back(outer.front());
    out.end_bottom = add_straight(section, inner.back(), outer.back(), static_cast<int>(surface.size()) - 1);
  }
  const std::size_t first_quad = section.quads.size();
  add_patch(section, surface, out.end_bottom, left ? outer : inner, left ? inner : outer);
  if (layered) set_materials(section, first_quad, rows, layers);
  out.corner_bottom = outer.back();
  return out;
}

}  // namespace

double far_spacing(const MeshSizes& sizes) {
  return std::max(sizes.coarse_ratio * sizes.element, std::min(sizes.largest, kLargestAspect * sizes.element));
}

double under_band_size(const MeshSizes& sizes, double depth) {
  return std::max(sizes.element,
                  std::min(0.5 * sizes.largest, std::max(sizes.coarse_ratio * sizes.element, depth / 3)));
}

double side_row_height(const MeshSizes& sizes, double depth) {
  return std::max(sizes.element, std::min(sizes.coarse_ratio * sizes.element, depth / 2.5));
}

std::size_t intervals_at_depth(const Profile& profile, const std::vector<double>& s, double depth, double size) {
  return static_cast<std::size_t>(intervals_for(walked_at_depth(profile, s, depth).back(), size, 1));
}

std::vector<double> column_subset(const Profile& profile, const std::vector<double>& s, double depth,
                                  std::size_t intervals) {
  const std::vector<double> walked = walked_at_depth(profile, s, depth);
  const std::size_t last = s.size() - 1;
  intervals = std::min(intervals, last);
  std::vector<double> out{s.front()};
  for (std::size_t k = 1, i = 1; k < intervals; ++k, ++i) {
    const double wanted = walked.back() * static_cast<double>(k) / static_cast<double>(intervals);
    while (i < last - (intervals - k) && std::abs(walked[i + 1] - wanted) < std::abs(walked[i] - wanted)) ++i;
    out.push_back(s[i]);
  }
  out.push_back(s.back());
  return out;
}

FrameNodes add_offset_frame(SweptBody& body, const Profile& profile, double contact_s,
                            const std::vector<LayerMesh>& layers, const MeshSizes& sizes, const OffsetFrameSpec& spec,
                            Stations cap_stations, Stations frame_stations, const StationPair& range) {
  const std::vector<double> fine =
      fine_columns(contact_s, sizes.element, sizes.fine_width, spec.fine_range, body.name.c_str());
  const BandRows rows = band_rows(layers, sizes.element, sizes.fine_depth, spec.band_limit, spec.carrier.c_str());
  const double depth = rows.depth.back(), element = under_band_size(sizes, depth);
  const BandRows side_rows = merged_rows(rows, side_row_height(sizes, depth));
  const std::vector<double> edges = layer_edges(profile, layers, spec.carrier.c_str(), spec.width);

  Section frame;
  const auto left_s = tread_columns(fine.front(), std::min(fine.front(), spec.tread_range.first), sizes, edges);
  const auto right_s = tread_columns(fine.back(), std::max(fine.back(), spec.tread_range.second), sizes, edges);
  const auto depths = [&](double s) { return depths_at(side_rows, profile.at(s).position.y, layers); };
  const Side left = add_side(frame, profile, left_s, side_rows, layers, spec.left_top(left_s.front()),
                             spec.left_side(depths(left_s.front()), left_s.front()), true, spec.layered_ends);
  const Side right = add_side(frame, profile, right_s, side_rows, layers, spec.right_top(right_s.back()),
                              spec.right_side(depths(right_s.back()), right_s.back()), false, spec.layered_ends);

  std::vector<Vec2> middle;
  const std::vector<double> middle_s =
      column_subset(profile, fine, depth, intervals_at_depth(profile, fine, depth, element));
  for (std::size_t i = 1; i + 1 < middle_s.size(); ++i) middle.push_back(offset_point(profile, middle_s[i], depth));
  NodeLine seat = add_nodes(frame, middle);
  seat.insert(seat.begin(), left.tread.back().back());
  seat.push_back(right.tread.back().front());

  const NodeLine band_bottom =
      joined(joined(joined(joined(left.end_bottom, left.tread.back()), seat), right.tread.back()), right.end_bottom);
  std::vector<Vec2> floor_points;
  for (double y : floor_positions(frame, band_bottom, spec.floor_breaks)) floor_points.push_back({y, spec.floor});
  const NodeLine floor = add_nodes(frame, floor_points);
  const double below = std::abs(spec.floor - frame.nodes[seat[seat.size() / 2]].z);
  std::vector<double> fractions =
      graded_points(0, below, [&](double d) { return std::min(1.5 * sizes.largest, element + 0.33 * d); });
  for (double& f : fractions) f /= below;
  fractions = {fractions.begin() + 1, fractions.end() - 1};
  const NodeLine west = add_straight(frame, band_bottom.front(), floor.front(), fractions),
                 east = add_straight(frame, band_bottom.back(), floor.back(), fractions);
  add_patch(frame, band_bottom, floor, west, east);

  Block cap{"cap", {}, std::move(cap_stations)};
  const std::vector<NodeLine> cap_rows = add_band(cap.section, profile, fine, rows, layers);
  std::vector<Vec2> seat_points;
  for (int node : seat) seat_points.push_back(frame.nodes[node]);
  seat_on_line(cap.section, cap_rows, seat_points);

  const int cap_block = static_cast<int>(body.blocks.size()), frame_block = cap_block + 1;
  body.blocks.push_back(std::move(cap));
  body.blocks.push_back({spec.name, std::move(frame), std::move(frame_stations)});
  body.contact = {cap_block,     static_cast<int>(fine.size()) - 1, rows.count(), fine, rows.depth, range.fine_begin,
                  range.fine_end};
  tie_to_line(body, cap_block, column_of(cap_rows, 0), frame_block, column_of(left.tread, left_s.size() - 1));
  tie_to_line(body, cap_block, column_of(cap_rows, fine.size() - 1), frame_block, column_of(right.tread, 0));
  tie_to_line(body, cap_block, NodeLine(cap_rows.back().begin() + 1, cap_rows.back().end() - 1), frame_block, seat);
  return {frame_block, floor};
}

}  // namespace railstrata
