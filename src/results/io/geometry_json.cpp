#include "io/geometry_json.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>

#include "geometry/height_field.hpp"
#include "geometry/turned_wheel.hpp"
#include "model/rolling_start.hpp"
#include "record/output_file.hpp"
#include "record/unit.hpp"
#include "rules/track_facts.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kSpacing = 0.5e-3, kReach = 80e-3;  // m, the latter to either side of the contact
constexpr double kSurfaceSpacing = 1e-3, kHalfLength = 0.1;
constexpr int kStations = 21, kAngles = 181;

/// Points of a profile so far apart.
std::vector<ProfilePoint> outline(const Profile& profile, double contact_s, double spacing) {
  const double begin = std::max(profile.s_min(), contact_s - kReach),
               end = std::min(profile.s_max(), contact_s + kReach);
  const int pieces = static_cast<int>(std::ceil((end - begin) / spacing));
  std::vector<ProfilePoint> out;
  for (int k = 0; k <= pieces; ++k) out.push_back(profile.at(k == pieces ? end : begin + (end - begin) * k / pieces));
  return out;
}

/// Points of a profile, below its surface by a depth at their own y, in the model frame; low … high: of the own y.
template <class ToModel, class Depth>
Json curve(const Profile& profile, double contact_s, double low, double high, Depth&& depth, ToModel&& to_model) {
  Json points = Json::array();
  for (const ProfilePoint& p : outline(profile, contact_s, kSpacing)) {
    if (p.position.y < low || p.position.y > high) continue;
    const Vec2 point = to_model(p.position - depth(p.position.y) * p.outward);
    points.push_back({point.y, point.z});
  }
  return points;
}

Json contact_json(const RigidContact& c, const Placement& placement) {
  return {{"y_m", c.point.y},
          {"z_m", c.point.z},
          {"wheel_y_m", c.roll == 0 ? c.point.y - c.wheel_offset_y : placement.wheel.at(c.wheel_s).position.y},
          {"angle_rad", c.angle},
          {"rolling_radius_m", c.rolling_radius},
          {"curvature_rolling_per_m", c.curvature_rolling},
          {"curvature_wheel_lateral_per_m", c.curvature_wheel_lateral},
          {"curvature_rail_lateral_per_m", c.curvature_rail_lateral}};
}

Json hertz_json(const HertzContact& hertz) {
  return {{"a_m", hertz.a}, {"b_m", hertz.b}, {"p0_Pa", hertz.p0}, {"approach_m", hertz.approach}};
}

/// Without layers, under this load.
HertzContact hertz_under(CaseSpec spec, const LoadedContact& patch) {
  spec.vehicle.set_load(patch.load);
  return hertz_estimate(spec, patch.contact);
}

VtkQuads swept(const std::vector<ProfilePoint>& line, int stations, const std::function<Vec3(Vec2, int)>& at) {
  VtkQuads mesh;
  const auto n = static_cast<long long>(line.size());
  for (int s = 0; s < stations; ++s)
    for (const ProfilePoint& p : line) mesh.points.push_back(at(p.position, s));
  for (long long s = 0; s + 1 < stations; ++s)
    for (long long k = 0; k + 1 < n; ++k)
      mesh.cells.push_back({s * n + k, (s + 1) * n + k, (s + 1) * n + k + 1, s * n + k + 1});
  return mesh;
}

/// Heights of both bodies below the axle, at equal distances along its way; null without any.
Json heights_json(const CaseSpec& spec) {
  constexpr int kPlaces = 1200;
  const double end = end_of_way(spec);
  if (spec.irregularities.empty() || !std::isfinite(end)) return nullptr;
  Json out{{"x_mm", Json::array()}, {"rail_um", Json::array()}, {"wheel_um", Json::array()}};
  const HeightField rail(spec.irregularities, BodyId::rail, spec.geometry.wheel_radius),
      wheel(spec.irregularities, BodyId::wheel, spec.geometry.wheel_radius);
  for (int k = 0; k <= kPlaces; ++k) {
    const double x = end * k / kPlaces;
    out["x_mm"].push_back(unit::kMillimetres.factor * x);
    out["rail_um"].push_back(unit::kMicrometres.factor * rail.at(x, 0).z);
    out["wheel_um"].push_back(unit::kMicrometres.factor * wheel.at(x, 0).z);
  }
  return out;
}

}  // namespace

Json track_json(const GeometrySpec& geometry) {
  Json out = Json::array();
  for (const TrackFact& f : track_facts(geometry))
    out.push_back({{"name", f.label}, {"value", f.value}, {"from", f.from}});
  return out;
}

Json geometry_json(const CaseSpec& spec, const Placement& placement, const std::vector<LoadedContact>& patches) {
  const RigidContact& c = placement.contact;
  const HertzContact hertz = hertz_estimate(spec, c);
  const auto rail = [&](Vec2 p) { return rail_to_model(placement.track, p); };
  const TurnedWheel turned(placement.wheel, placement.track);
  const auto wheel = [&](Vec2 p) {
    const Vec2 at = turned.section(p);
    return Vec2{at.y + c.wheel_offset_y, at.z + c.wheel_offset_z};
  };
  Json out;
  out["rail_profile"] = placement.rail.name();
  out["wheel_profile"] = placement.wheel.name();
  out["track"] = track_json(spec.geometry);
  out["profile_notes"] = placement.doubts;
  for (const std::string& note : placement.notes) out["profile_notes"].push_back(note);
  out["load_N"] = hertz.load;
  out["contact"] = contact_json(c, placement);
  out["hertz"] = hertz_json(hertz);
  if (patches.size() > 1)
    for (const LoadedContact& p : patches)
      out["patches"].push_back({{"contact", contact_json(p.contact, placement)},
                                {"load_N", p.load},
                                {"hertz", hertz_json(hertz_under(spec, p))}});
  const auto surface = [](double) { return 0.0; };
  out["rail_m"] = curve(placement.rail, c.rail_s, -kReach, kReach, surface, rail);
  out["wheel_m"] = curve(placement.wheel, c.wheel_s, -kReach, kReach, surface, wheel);
  if (Json heights = heights_json(spec); !heights.is_null()) out["heights"] = std::move(heights);
  out["layers"] = Json::array();
  for (std::size_t i = 0; i < spec.layers.size(); ++i) {
    const LayerSpec& l = spec.layers[i];
    const bool on_rail = l.on == BodyId::rail;
    const auto depth = [&](double y) { return layer_tops(layers_across(spec.layers, y, y))[i] + l.thickness_at(y); };
    out["layers"].push_back(
        {{"name", l.name},
         {"on", body_word(l.on)},
         {"thickness_m", l.thickness},
         {"width_m", l.high() - l.low()},
         {"young_Pa", l.material.young},
         {"young_ratio", l.material.young / (on_rail ? spec.rail_material : spec.wheel_material).young},
         {"bottom_m", on_rail ? curve(placement.rail, c.rail_s, l.low(), l.high(), depth, rail)
                              : curve(placement.wheel, c.wheel_s, l.low(), l.high(), depth, wheel)}});
    if (l.from) out["layers"].back()["from_m"] = *l.from;
    if (l.to) out["layers"].back()["to_m"] = *l.to;
    if (l.taper_length > 0) out["layers"].back()["taper_length_m"] = l.taper_length;
    for (const ModulusPoint& point : l.young_table)
      out["layers"].back()["young_table"].push_back({point.depth, point.young});
  }
  return out;
}

void write_geometry(const std::filesystem::path& file, const CaseSpec& spec, const Placement& placement,
                    const std::vector<LoadedContact>& patches) {
  write_whole_file(file, geometry_json(spec, placement, patches).dump() + "\n");
}

VtkQuads rail_surface(const Placement& placement, double wheel_x) {
  return swept(outline(placement.rail, placement.contact.rail_s, kSurfaceSpacing), kStations, [&](Vec2 p, int s) {
    const Vec2 q = rail_to_model(placement.track, p);
    const double along = kHalfLength * (2.0 * s / (kStations - 1) - 1), radius = placement.track.rail_radius + q.z;
    if (!std::isfinite(radius)) return Vec3{wheel_x + along, q.y, q.z};
    const double angle = along / std::max(std::abs(radius), kHalfLength / std::numbers::pi);
    return Vec3{wheel_x + std::abs(radius) * std::sin(angle), q.y, q.z - radius * (1 - std::cos(angle))};
  });
}

VtkQuads wheel_surface(const Placement& placement, double wheel_x) {
  const RigidContact& c = placement.contact;
  const TurnedWheel turned(placement.wheel, placement.track);
  return swept(outline(placement.wheel, c.wheel_s, kSurfaceSpacing), kAngles, [&](Vec2 p, int s) {
    const double radius = placement.track.wheel_radius - p.z, t = 2 * std::numbers::pi * s / (kAngles - 1);
    const double along = radius * std::sin(t);
    const Vec2 section = turned.section({p.y, placement.track.wheel_radius - radius * std::cos(t)});
    return Vec3{wheel_x - c.x + along * std::cos(c.yaw) - section.y * std::sin(c.yaw),
                c.wheel_offset_y + section.y * std::cos(c.yaw) + along * std::sin(c.yaw), c.wheel_offset_z + section.z};
  });
}

void write_placed_surfaces(const std::filesystem::path& folder, const Placement& placement, double wheel_x) {
  write_vtp(folder / "rail_surface.vtp", rail_surface(placement, wheel_x));
  write_vtp(folder / "wheel_surface.vtp", wheel_surface(placement, wheel_x));
}

}  // namespace railstrata
