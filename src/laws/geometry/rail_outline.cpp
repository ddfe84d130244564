#include "geometry/rail_outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/faults.hpp"
#include "core/rotation.hpp"

namespace railstrata {
namespace {

constexpr double kSagitta = 2e-6;  // m
constexpr double kDegree = std::numbers::pi / 180;

// CN60 below its flank, right half, in metres and z up, from the drawing's radii and lines (data/profiles/README.md).
constexpr Vec2 mm(double y, double z) { return {1e-3 * y, -1e-3 * z}; }
constexpr Vec2 kFlankEnd = mm(36.39278664727267, 34.05573294545356);
constexpr Vec2 kHeadCorner = mm(33.396529630639144, 34.20554579628524);  // centre of R3
constexpr Vec2 kUndersideBegin = mm(34.345212928689655, 37.051595690436784),
               kUndersideEnd = mm(18.891640108631478, 42.202786630456174);
constexpr Vec2 kHeadFillet = mm(22.686373300833534, 53.58698620706234);  // R12
constexpr Vec2 kWebBegin = mm(10.761725052405666, 52.24431567738385),
               kWebEnd = mm(10.19742027146441, 136.42263019456968);
constexpr Vec2 kWebCentre = mm(408.25, 97.0);                            // R400
constexpr Vec2 kFootFillet = mm(30.100049257891172, 134.4514986848412);  // R20
constexpr Vec2 kFootBegin = mm(23.775493937554412, 153.42516464585148),
               kFootBreakBegin = mm(41.72984620668091, 159.4099487355603);
constexpr Vec2 kFootBreak = mm(54.37895684735443, 121.46261681353975);  // R40
constexpr Vec2 kFootBreakEnd = mm(49.96169580436056, 161.2179662004845),
               kFootEnd = mm(71.44172610429939, 163.60463623381105);
constexpr Vec2 kToeTop = mm(71.0, 167.58017117250552);  // centre of R4
constexpr Vec2 kToeBegin = mm(75.0, 167.58017117250552), kToeEnd = mm(75.0, 174.0), kToeBottom = mm(73.0, 174.0),
               kBaseEnd = mm(73.0, 176.0);

Vec2 at_angle(Vec2 centre, double radius, double degrees) {
  return centre + radius * Vec2{std::cos(degrees * kDegree), std::sin(degrees * kDegree)};
}

/// Appends the shorter arc about the centre from the list's last point to `end`.
void arc_to(std::vector<Vec2>& line, Vec2 centre, Vec2 end) {
  const Vec2 a = line.back() - centre, b = end - centre;
  const double radius = norm(a), angle = std::atan2(cross(a, b), dot(a, b));
  const int n = static_cast<int>(std::ceil(std::abs(angle) / (2 * std::acos(1 - kSagitta / radius))));
  for (int i = 1; i < n; ++i) line.push_back(centre + roll(rotation_by(angle * i / n), a));
  line.push_back(end);
}

/// Moves CN60's underside so that it begins at another flank's end and still ends on the web.
void widen(std::vector<Vec2>& underside, double by) {
  const double web = underside.back().y, width = kFlankEnd.y - web;
  for (Vec2& p : underside) p.y += by * std::clamp((p.y - web) / width, 0.0, 1.0);
}

/// y of the flank's end: where the field-side flank reaches CN60's depth, continued straight if it ends higher.
double flank_end_y(const Profile& head) {
  const ProfilePoint end = head.at(head.s_at_y(head.y_max()));
  if (head.primitive() || std::abs(end.tangent.z) < std::abs(end.tangent.y))
    throw CaseError(fmt::format("the rail profile {} has no flanks: it ends {:.1f} mm below the crown", head.name(),
                                -1e3 * end.position.z),
                    "give a head profile that reaches down its sides, or use rail_shape = \"block\"");
  if (end.position.z > kFlankEnd.z)
    return end.position.y + end.tangent.y * (kFlankEnd.z - end.position.z) / end.tangent.z;
  double above = 0, below = head.y_max();
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (above + below);
    (head.height(middle) > kFlankEnd.z ? above : below) = middle;
  }
  return above;
}

}  // namespace

RailOutline rail_outline(const Profile& head) {
  RailOutline out;
  out.flank_y = flank_end_y(head);
  out.flank_z = kFlankEnd.z;
  out.underside = {kFlankEnd};
  arc_to(out.underside, kHeadCorner, kUndersideBegin);
  out.underside.push_back(kUndersideEnd);
  arc_to(out.underside, kHeadFillet, at_angle(kHeadFillet, 0.012, 135));
  out.web = {out.underside.back()};
  arc_to(out.web, kHeadFillet, kWebBegin);
  arc_to(out.web, kWebCentre, kWebEnd);
  arc_to(out.web, kFootFillet, at_angle(kFootFillet, 0.020, 225));
  out.foot_top = {out.web.back()};
  arc_to(out.foot_top, kFootFillet, kFootBegin);
  out.foot_top.push_back(kFootBreakBegin);
  arc_to(out.foot_top, kFootBreak, kFootBreakEnd);
  out.foot_top.push_back(kFootEnd);
  arc_to(out.foot_top, kToeTop, kToeBegin);
  out.toe = {kToeBegin, kToeEnd};
  arc_to(out.toe, kToeBottom, kBaseEnd);
  out.base_z = kBaseEnd.z;
  widen(out.underside, out.flank_y - kFlankEnd.y);
  return out;
}

}  // namespace railstrata
