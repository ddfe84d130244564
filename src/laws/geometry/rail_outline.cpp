#include "geometry/rail_outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "core/faults.hpp"
#include "core/rotation.hpp"

namespace railstrata {
namespace {

constexpr double kSagitta = 2e-6;  // m
constexpr double kDegree = std::numbers::pi / 180;

/// An arc between two tangents.
struct Rounding {
  Vec2 begin, centre, end;
};
/// A section below its flank, right half, in metres and z up.
struct LowerDrawing {
  Rounding head_corner, head_fillet, foot_fillet, foot_break, toe, base;
  std::optional<Vec2> web_centre;  ///< of the web's arc; none: straight
};

constexpr Vec2 mm(double y, double z) { return {1e-3 * y, -1e-3 * z}; }

/// CN60, from the drawing's radii and lines (data/profiles/README.md).
constexpr LowerDrawing kLowerCn60{
    {mm(36.39278664727267, 34.05573294545356), mm(33.396529630639144, 34.20554579628524),
     mm(34.345212928689655, 37.051595690436784)},  // R3
    {mm(18.891640108631478, 42.202786630456174), mm(22.686373300833534, 53.58698620706234),
     mm(10.761725052405666, 52.24431567738385)},  // R12
    {mm(10.19742027146441, 136.42263019456968), mm(30.100049257891172, 134.4514986848412),
     mm(23.775493937554412, 153.42516464585148)},  // R20
    {mm(41.72984620668091, 159.4099487355603), mm(54.37895684735443, 121.46261681353975),
     mm(49.96169580436056, 161.2179662004845)},                                                               // R40
    {mm(71.44172610429939, 163.60463623381105), mm(71.0, 167.58017117250552), mm(75.0, 167.58017117250552)},  // R4
    {mm(75.0, 174.0), mm(73.0, 174.0), mm(73.0, 176.0)},                                                      // R2
    mm(408.25, 97.0)};                                                                                        // R400

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

Rounding rounding(Vec2 before, Vec2 corner, Vec2 after, double radius) {
  const Vec2 back = (1 / norm(before - corner)) * (before - corner), on = (1 / norm(after - corner)) * (after - corner),
             middle = (1 / norm(back + on)) * (back + on);
  const double half = 0.5 * std::acos(dot(back, on)), along = radius / std::tan(half);
  return {corner + along * back, corner + (radius / std::sin(half)) * middle, corner + along * on};
}

/// A section by its main dimensions, m: the fishing surfaces 1:2.75 meet the middle at these distances from crown and
/// base; the toe is 1:14 above. One fillet stands for the compound ones on both ends of the web: it makes the area that
/// of the standard.
struct StandardSection {
  double height, foot_width, web;
  double head_depth, foot_height, toe, fillet;
  Vec2 flank;  ///< a point of its 1:20 flank
};
constexpr StandardSection kLowerUic60{0.172, 0.150, 0.0165, 0.051, 0.0315, 0.0115, 0.02388, mm(36.7848129208559, 30.0)},
    kLowerUic54{0.159, 0.140, 0.016, 0.0494, 0.0302, 0.011, 0.0225, mm(35.79505571118438, 30.0)};

LowerDrawing drawing_of(const StandardSection& s) {
  constexpr double kFishing = 1 / 2.75, kToe = 1.0 / 14, kFlank = 1.0 / 20;  // slopes
  constexpr double kHeadCornerRadius = 3e-3, kBreakRadius = 40e-3, kToeRadius = 4e-3, kBaseRadius = 2e-3;
  const double web = 0.5 * s.web, edge = 0.5 * s.foot_width,
               corner = (s.flank.y + kFlank * (s.flank.z + s.head_depth)) / (1 + kFlank * kFishing),
               foot_break = (s.foot_height - s.toe - edge * kToe) / (kFishing - kToe);
  const Vec2 head{corner, corner * kFishing - s.head_depth};
  const Vec2 web_top{web, web * kFishing - s.head_depth}, web_bottom{web, s.foot_height - web * kFishing - s.height};
  const Vec2 change{foot_break, s.foot_height - foot_break * kFishing - s.height};
  const Vec2 toe{edge, s.toe - s.height}, heel{edge, -s.height}, middle{0, -s.height};
  return {rounding(s.flank, head, web_top, kHeadCornerRadius),
          rounding(head, web_top, web_bottom, s.fillet),
          rounding(web_top, web_bottom, change, s.fillet),
          rounding(web_bottom, change, toe, kBreakRadius),
          rounding(change, toe, heel, kToeRadius),
          rounding(toe, heel, middle, kBaseRadius),
          {}};
}

LowerDrawing drawing_of(RailSection section) {
  switch (section) {
    case RailSection::UIC60:
      return drawing_of(kLowerUic60);
    case RailSection::UIC54:
      return drawing_of(kLowerUic54);
    default:
      return kLowerCn60;
  }
}

/// Moves an underside so that it begins at another flank's end and still ends on the web.
void widen(std::vector<Vec2>& underside, double by) {
  const double web = underside.back().y, width = underside.front().y - web;
  for (Vec2& p : underside) p.y += by * std::clamp((p.y - web) / width, 0.0, 1.0);
}

/// y of the flank's end: where the field-side flank reaches a depth, continued straight if it ends higher.
double flank_end_y(const Profile& head, double z) {
  const ProfilePoint end = head.at(head.s_at_y(head.y_max()));
  if (head.primitive() || std::abs(end.tangent.z) < std::abs(end.tangent.y))
    throw CaseError(fmt::format("the rail profile {} has no flanks: it ends {:.1f} mm below the crown", head.name(),
                                -1e3 * end.position.z),
                    "give a head profile that reaches down its sides, or use rail_shape = \"block\"");
  if (end.position.z > z) return end.position.y + end.tangent.y * (z - end.position.z) / end.tangent.z;
  double above = 0, below = head.y_max();
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (above + below);
    (head.height(middle) > z ? above : below) = middle;
  }
  return above;
}

}  // namespace

RailSection rail_section(std::string_view profile, TrackKind track) {
  if (profile == "UIC60") return RailSection::UIC60;
  if (profile == "UIC54") return RailSection::UIC54;
  return track == TrackKind::EN && profile != "CN60" ? RailSection::UIC60 : RailSection::CN60;
}

RailOutline rail_outline(const Profile& head, RailSection section) {
  const LowerDrawing d = drawing_of(section);
  const auto half_way = [](const Rounding& r, double degrees) {
    return at_angle(r.centre, norm(r.begin - r.centre), degrees);
  };
  RailOutline out;
  out.flank_z = d.head_corner.begin.z;
  out.flank_y = flank_end_y(head, out.flank_z);
  out.underside = {d.head_corner.begin};
  arc_to(out.underside, d.head_corner.centre, d.head_corner.end);
  out.underside.push_back(d.head_fillet.begin);
  arc_to(out.underside, d.head_fillet.centre, half_way(d.head_fillet, 135));
  out.web = {out.underside.back()};
  arc_to(out.web, d.head_fillet.centre, d.head_fillet.end);
  if (d.web_centre)
    arc_to(out.web, *d.web_centre, d.foot_fillet.begin);
  else
    out.web.push_back(d.foot_fillet.begin);
  arc_to(out.web, d.foot_fillet.centre, half_way(d.foot_fillet, 225));
  out.foot_top = {out.web.back()};
  arc_to(out.foot_top, d.foot_fillet.centre, d.foot_fillet.end);
  out.foot_top.push_back(d.foot_break.begin);
  arc_to(out.foot_top, d.foot_break.centre, d.foot_break.end);
  out.foot_top.push_back(d.toe.begin);
  arc_to(out.foot_top, d.toe.centre, d.toe.end);
  out.toe = {d.toe.end, d.base.begin};
  arc_to(out.toe, d.base.centre, d.base.end);
  out.base_z = d.base.end.z;
  widen(out.underside, out.flank_y - d.head_corner.begin.y);
  return out;
}

}  // namespace railstrata
