#include "mesh/rail_sections.hpp"

#include <algorithm>
#include <cmath>

#include "core/faults.hpp"

namespace railstrata {

namespace {

Vec2 mirror(Vec2 p) { return {-p.y, p.z}; }

std::vector<Vec2> mirrored(std::vector<Vec2> points) {
  for (Vec2& p : points) p = mirror(p);
  return points;
}

/// Points strictly between the ends of a resampled polyline.
std::vector<Vec2> inner_points(const std::vector<Vec2>& polyline, int intervals) {
  const std::vector<Vec2> all = resampled(polyline, intervals);
  return {all.begin() + 1, all.end() - 1};
}

NodeLine line_along(Section& section, int from, const std::vector<Vec2>& polyline, int to, int intervals) {
  NodeLine line = add_nodes(section, inner_points(polyline, intervals));
  line.insert(line.begin(), from);
  line.push_back(to);
  return line;
}

}  // namespace

LowerOutline lower_outline(const RailOutline& outline) {
  std::vector<Vec2> line{{outline.flank_y, outline.flank_z}};
  for (const auto* part : {&outline.underside, &outline.web, &outline.foot_top})
    for (Vec2 p : *part)
      if (norm(p - line.back()) > 1e-9) line.push_back(p);

  const auto steep = [&](std::size_t i) {
    return std::abs(line[i + 1].z - line[i].z) > std::abs(line[i + 1].y - line[i].y);
  };
  const auto narrowest = static_cast<std::size_t>(
      std::min_element(line.begin(), line.end(), [](Vec2 a, Vec2 b) { return a.y < b.y; }) - line.begin());
  std::size_t corner = 0, web_begin = narrowest, web_end = narrowest, toe = line.size() - 1;
  while (web_begin > 0 && steep(web_begin - 1)) --web_begin;
  while (web_end + 1 < line.size() && steep(web_end)) ++web_end;
  while (corner < web_begin && steep(corner)) ++corner;
  while (toe > web_end && steep(toe - 1)) --toe;
  if (corner >= web_begin || web_begin >= web_end || web_end >= toe)
    throw CaseError("the rail's outline has no head, web and foot",
                    "use a rail profile that reaches down the flanks, or rail_shape = \"block\"");

  const auto part = [&](std::size_t a, std::size_t b) {
    return std::vector<Vec2>(line.begin() + a, line.begin() + b + 1);
  };
  LowerOutline out{part(corner, web_begin), part(web_begin, web_end), part(web_end, toe), part(toe, line.size() - 1)};
  if (norm(out.toe.back() - Vec2{out.toe.back().y, outline.base_z}) > 1e-9)
    out.toe.push_back({out.toe.back().y, outline.base_z});
  return out;
}

HeadSection head_section(const HeadBoundary& boundary, const LowerOutline& lower, double element) {
  HeadSection out;
  Section& section = out.section;
  out.under_band = add_nodes(section, boundary.under_band);
  const NodeLine& under = out.under_band;
  const std::size_t a = boundary.left_corner, b = boundary.right_corner;
  const Vec2 end_left = boundary.under_band.front(), end_right = boundary.under_band.back(), fillet = lower.web.front();

  // The columns that will reach the web are those of the core's middle.
  const double split = 1.12 * fillet.y;
  const int columns = static_cast<int>(b - a);
  int outer_left = 0, outer_right = 0;
  for (std::size_t i = a; i < b; ++i) {
    const double y = 0.5 * (boundary.under_band[i].y + boundary.under_band[i + 1].y);
    if (y < -split) ++outer_left;
    if (y > split) ++outer_right;
  }
  outer_left = std::max(outer_left, 1);
  outer_right = std::max(outer_right, 1);
  const int middle = columns - outer_left - outer_right;
  if (middle < 1)
    throw CaseError("the mesh of the rail's head has no columns left for the web", "reduce the mesh's largest element");

  const double width = end_right.y - end_left.y, left_f = (-split - end_left.y) / width,
               right_f = (split - end_left.y) / width;
  std::vector<double> fractions;
  for (int i = 1; i < columns; ++i) {
    if (i <= outer_left)
      fractions.push_back(left_f * i / outer_left);
    else if (i < outer_left + middle)
      fractions.push_back(left_f + (right_f - left_f) * (i - outer_left) / middle);
    else
      fractions.push_back(right_f + (1 - right_f) * (i - outer_left - middle) / outer_right);
  }
  const NodeLine level = add_straight(section, under.front(), under.back(), fractions);
  add_patch(section, level, NodeLine(under.begin() + a, under.begin() + b + 1),
            NodeLine(under.begin(), under.begin() + a + 1), reversed(NodeLine(under.begin() + b, under.end())));

  const int face = intervals_for(norm(boundary.left_flank - end_left), element, 2);
  const auto node = [&](Vec2 p) { return add_nodes(section, {p}).front(); };
  const int left_flank = node(boundary.left_flank), right_flank = node(boundary.right_flank);
  out.left_face = add_straight(section, left_flank, under.front(), face);
  out.right_face = add_straight(section, right_flank, under.back(), face);

  const int left_corner = node(mirror(lower.underside.front())), right_corner = node(lower.underside.front());
  const int left_fillet = node(mirror(fillet)), right_fillet = node(fillet);
  const NodeLine left_under =
      line_along(section, left_corner, mirrored(lower.underside), left_fillet, face + outer_left);
  const NodeLine right_under = line_along(section, right_corner, lower.underside, right_fillet, face + outer_right);
  out.web_line = add_straight(section, left_fillet, right_fillet, middle);

  const int rows = intervals_for(end_left.z - fillet.z, 1.6 * element, 3);
  const NodeLine west = add_straight(section, left_corner, left_flank, rows),
                 east = add_straight(section, right_corner, right_flank, rows);
  add_patch(section, joined(joined(left_under, out.web_line), reversed(right_under)),
            joined(joined(out.left_face, level), reversed(out.right_face)), west, east);
  return out;
}

FootSection foot_section(const LowerOutline& lower, double largest) {
  FootSection out;
  Section& section = out.section;
  const Vec2 top = lower.web.front(), fillet = lower.web.back(), toe_top = lower.toe.front(),
             toe_bottom = lower.toe.back();
  const int columns = intervals_for(2 * top.y, 0.6 * largest, 2),
            web_rows = intervals_for(polyline_length(lower.web), largest, 3);
  const int side_columns = intervals_for(toe_bottom.y - fillet.y, largest, 2),
            foot_rows = intervals_for(fillet.z - toe_bottom.z, 0.75 * largest, 2);

  const auto node = [&](Vec2 p) { return add_nodes(section, {p}).front(); };
  const int top_left = node(mirror(top)), top_right = node(top), fillet_left = node(mirror(fillet)),
            fillet_right = node(fillet);
  out.web_line = add_straight(section, top_left, top_right, columns);
  const NodeLine web_bottom = add_straight(section, fillet_left, fillet_right, columns);
  add_patch(section, web_bottom, out.web_line,
            reversed(line_along(section, top_left, mirrored(lower.web), fillet_left, web_rows)),
            reversed(line_along(section, top_right, lower.web, fillet_right, web_rows)));

  const double base_y = 1.25 * fillet.y, base_z = toe_bottom.z;
  const int base_left = node({-base_y, base_z}), base_right = node({base_y, base_z});
  const NodeLine base_middle = add_straight(section, base_left, base_right, columns);
  const NodeLine inner_left = add_straight(section, base_left, fillet_left, foot_rows),
                 inner_right = add_straight(section, base_right, fillet_right, foot_rows);
  add_patch(section, base_middle, web_bottom, inner_left, inner_right);

  const int toe_left = node(mirror(toe_top)), toe_right = node(toe_top), corner_left = node(mirror(toe_bottom)),
            corner_right = node(toe_bottom);
  const NodeLine side_left = reversed(line_along(section, toe_left, mirrored(lower.toe), corner_left, foot_rows));
  const NodeLine side_right = reversed(line_along(section, toe_right, lower.toe, corner_right, foot_rows));
  const NodeLine surface_left =
      reversed(line_along(section, fillet_left, mirrored(lower.foot_top), toe_left, side_columns));
  const NodeLine surface_right = line_along(section, fillet_right, lower.foot_top, toe_right, side_columns);
  const NodeLine bottom_left = add_straight(section, corner_left, base_left, side_columns),
                 bottom_right = add_straight(section, base_right, corner_right, side_columns);
  add_patch(section, bottom_left, surface_left, side_left, inner_left);
  add_patch(section, bottom_right, surface_right, inner_right, side_right);
  out.base = joined(joined(bottom_left, base_middle), bottom_right);
  return out;
}

}  // namespace railstrata
