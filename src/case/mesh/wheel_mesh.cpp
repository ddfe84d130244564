#include "mesh/bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/faults.hpp"
#include "mesh/contact_band.hpp"
#include "mesh/grading.hpp"
#include "mesh/layer_stacks.hpp"
#include "mesh/offset_frame.hpp"

namespace railstrata {

namespace {

constexpr double kFineAngle = std::numbers::pi / 4;  // steepest place of the fine columns
constexpr double kFineAngleOfSection = 80 * std::numbers::pi / 180;
constexpr double kTreadAngle = std::numbers::pi / 6;  // steepest place of columns along the normals
constexpr double kFlangeChord = 8e-3;                 // a third of a radian on the flange tip's arcs
constexpr double kFarOfLargest = 1.5;  // far stations of the ring: only its smooth deformation is carried there

/// Where the section's left corner stands: the flange's crest, the profile's end without a flange.
double left_corner(const Profile& profile, double tread_end) {
  constexpr double kStep = 0.25e-3, kFlange = 1e-3;
  double crest = profile.s_min();
  for (double s = profile.s_min(); s < tread_end - 2 * kFlange; s += kStep)
    if (profile.at(s).position.z < profile.at(crest).position.z) crest = s;
  return profile.at(profile.s_min()).position.z - profile.at(crest).position.z > kFlange ? crest : profile.s_min();
}

std::vector<Vec2> surface_points(const Profile& profile, double from, double to, double size) {
  const int n = intervals_for(to - from, size, 1);
  std::vector<Vec2> out;
  for (int i = 0; i <= n; ++i) out.push_back(offset_point(profile, from + (to - from) * i / n, 0));
  return out;
}

/// From the profile's point at s along the profile to its end and on towards the axle to height z, in equal parts.
std::vector<Vec2> side_points(const Profile& profile, double s, double end, double z, std::size_t count) {
  constexpr int kPieces = 100;
  std::vector<Vec2> line;
  for (int i = 0; i <= kPieces; ++i) line.push_back(offset_point(profile, s + (end - s) * i / kPieces, 0));
  line.push_back({line.back().y, z});
  return resampled(line, static_cast<int>(count) - 1);
}

OffsetFrameSpec rim_frame(const Profile& profile, const WheelMeshSpec& spec, const MeshSizes& sizes) {
  OffsetFrameSpec frame;
  frame.name = "rim";
  frame.carrier = "rim";
  const double end = std::max({5e-3, sizes.element, 0.5 * sizes.fine_depth}),
               chord = std::min(kFlangeChord, 0.75 * sizes.largest);
  const auto within = [&](double angle) {
    const std::pair range = running_range(profile, angle);
    return std::pair{std::max(range.first, profile.s_min() + end), std::min(range.second, profile.s_max() - end)};
  };
  frame.fine_range = within(sizes.to_sides ? kFineAngleOfSection : kFineAngle);
  frame.tread_range = within(kTreadAngle);
  frame.band_limit =
      std::min(0.4 * spec.section.rim_thickness,
               0.85 * smallest_convex_radius(profile, frame.tread_range.first, frame.tread_range.second));
  frame.floor = spec.section.rim_thickness;

  const std::pair tread = frame.tread_range;
  const double corner = left_corner(profile, tread.first);
  frame.fine_range.first = std::max(frame.fine_range.first, corner + end);
  frame.left_top = [&profile, corner, chord](double s) {
    std::vector<Vec2> points = surface_points(profile, corner, s, chord);
    points.pop_back();
    return points;
  };
  frame.right_top = [&profile, chord](double s) {
    std::vector<Vec2> points = surface_points(profile, s, profile.s_max(), chord);
    points.erase(points.begin());
    return points;
  };
  const double flange = running_range(profile, kFineAngle).first;
  const auto side = [&profile, flange](double s, double profile_end, double tread_end) {
    return [&profile, flange, s, profile_end, tread_end](const std::vector<double>& depth, double band_end) {
      const double below = depth.back(), end_z = profile.at(profile_end).position.z;
      const double z = band_end < flange ? std::max(end_z, offset_point(profile, band_end, below).z)
                                         : std::max(end_z + 0.75 * below, offset_point(profile, tread_end, below).z);
      return side_points(profile, s, profile_end, z, depth.size());
    };
  };
  frame.left_side = side(corner, profile.s_min(), tread.first);
  frame.right_side = side(profile.s_max(), profile.s_max(), tread.second);
  return frame;
}

struct WebSection {
  Section section;
  NodeLine top, bore;
};

/// Plate and hub in the profile frame (z towards the axle), the plate between the lateral positions y0 and y1.
WebSection web_section(double y0, double y1, double top_z, double hub_z, double bore_z, double hub_width,
                       const MeshSizes& sizes) {
  WebSection out;
  Section& section = out.section;
  const auto node = [&](double y, double z) { return add_nodes(section, {{y, z}}).front(); };
  const bool hub = hub_width > y1 - y0 && hub_z < bore_z;
  const double plate_end = hub ? hub_z : bore_z, size = 1.5 * sizes.largest;
  const int columns = intervals_for(y1 - y0, hub ? 0.7 * sizes.largest : size, 2),
            rows = intervals_for(plate_end - top_z, size, 2);
  const int a = node(y0, top_z), b = node(y1, top_z), c = node(y1, plate_end), d = node(y0, plate_end);
  out.top = add_straight(section, a, b, columns);
  const NodeLine bottom = add_straight(section, d, c, columns);
  add_patch(section, out.top, bottom, add_straight(section, a, d, rows), add_straight(section, b, c, rows));
  out.bore = bottom;
  if (!hub) return out;

  const int depth = intervals_for(bore_z - hub_z, sizes.largest, 2),
            overhang = intervals_for(0.5 * (hub_width - y1 + y0), size, 2);
  const double middle = 0.5 * (y0 + y1);
  const int l0 = node(middle - 0.5 * hub_width, hub_z), l1 = node(middle - 0.5 * hub_width, bore_z),
            r0 = node(middle + 0.5 * hub_width, hub_z), r1 = node(middle + 0.5 * hub_width, bore_z),
            m0 = node(y0, bore_z), m1 = node(y1, bore_z);
  const NodeLine under_left = add_straight(section, d, m0, depth), under_right = add_straight(section, c, m1, depth);
  const NodeLine bore_left = add_straight(section, l1, m0, overhang),
                 bore_middle = add_straight(section, m0, m1, columns),
                 bore_right = add_straight(section, m1, r1, overhang);
  add_patch(section, bottom, bore_middle, under_left, under_right);
  add_patch(section, add_straight(section, l0, d, overhang), bore_left, add_straight(section, l0, l1, depth),
            under_left);
  add_patch(section, add_straight(section, c, r0, overhang), bore_right, under_right,
            add_straight(section, r0, r1, depth));
  out.bore = joined(joined(bore_left, bore_middle), bore_right);
  return out;
}

Stations uniform_ring(double begin, double radius, double arc) {
  const int n = 8 * intervals_for(2 * std::numbers::pi * radius, 8 * arc, 4);
  Stations out{{}, true};
  for (int j = 0; j < n; ++j) out.at.push_back(begin + 2 * std::numbers::pi * j / n);
  return out;
}

void check_radii(double wheel_radius, const WheelMeshSpec& spec) {
  const double inner = wheel_radius - spec.section.rim_thickness;
  const double below = spec.shape == WheelShape::wheel ? spec.section.hub_radius : spec.section.bore_radius;
  if (spec.section.bore_radius <= 0 || below < spec.section.bore_radius || inner <= below)
    throw CaseError(fmt::format("wheel radii out of order: rim inside {:g} mm, hub {:g} mm, bore {:g} mm", 1e3 * inner,
                                1e3 * spec.section.hub_radius, 1e3 * spec.section.bore_radius),
                    "keep wheel_radius - rim_thickness > hub_radius > bore_radius > 0");
}

}  // namespace

SweptBody mesh_wheel(const Profile& profile, double wheel_radius, Vec3 axle, const WheelMeshSpec& spec,
                     const MeshSizes& sizes) {
  check_radii(wheel_radius, spec);
  SweptBody body;
  body.name = "wheel";
  body.kind = SweepKind::revolve;
  body.origin = axle;
  body.materials = material_names(spec.layers);
  body.material_layer = material_layers(spec.layers);

  const double left = profile.at(profile.s_min()).position.y, right = profile.at(profile.s_max()).position.y;
  const bool disc = spec.shape == WheelShape::disc;
  const double y0 = disc ? left : spec.section.web_offset - 0.5 * spec.section.web_thickness,
               y1 = disc ? right : spec.section.web_offset + 0.5 * spec.section.web_thickness;
  if (y0 < left || y1 > right)
    throw CaseError("the wheel's web is wider than its rim", "reduce web_thickness or web_offset");

  const double rolling_radius = wheel_radius - profile.at(spec.contact_s).position.z;
  const double far = std::min(kFarOfLargest * sizes.largest,
                              std::max(kLargestAspect * sizes.element, sizes.coarse_ratio * sizes.element));
  const StationPair ring = ring_stations(spec.theta_begin, spec.theta_end, sizes.element / rolling_radius,
                                         sizes.coarse_ratio, far / rolling_radius, spec.planes);
  const std::vector<LayerMesh> slabs = slabs_of(spec.layers);
  OffsetFrameSpec frame = rim_frame(profile, spec, sizes);
  if (!disc) frame.floor_breaks = {y0, y1};
  const FrameNodes rim = add_offset_frame(body, profile, spec.contact_s, slabs, sizes, frame, {ring.fine, true},
                                          {ring.coarse, true}, ring);

  WebSection web = web_section(y0, y1, spec.section.rim_thickness, wheel_radius - spec.section.hub_radius,
                               wheel_radius - spec.section.bore_radius, disc ? 0 : spec.section.hub_width, sizes);
  const int web_block = static_cast<int>(body.blocks.size());
  body.blocks.push_back({"web", web.section,
                         uniform_ring(spec.theta_begin, wheel_radius - spec.section.rim_thickness, 2 * sizes.largest)});
  NodeLine carried;
  for (int node : rim.floor) {
    const double y = body.blocks[rim.block].section.nodes[node].y;
    if (y > y0 - 1e-9 && y < y1 + 1e-9) carried.push_back(node);
  }
  tie_to_line(body, rim.block, carried, web_block, web.top);
  for (int node : web.bore) body.prescribed.push_back({web_block, node});

  for (Block& block : body.blocks)
    for (Vec2& p : block.section.nodes) p.z -= wheel_radius;
  set_stacks(body, spec.layers, rolling_radius);
  return body;
}

}  // namespace railstrata
