#include "io/geometry_json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/turned_wheel.hpp"
#include "record/output_file.hpp"
#include "rules/track_facts.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kSpacing = 0.5e-3, kReach = 80e-3;

/// Points of a profile, `depth` below its surface, in the model frame; `half_width`: of the profile's own y.
template <class ToModel>
Json curve(const Profile& profile, double contact_s, double depth, double half_width, ToModel&& to_model) {
  const double begin = std::max(profile.s_min(), contact_s - kReach),
               end = std::min(profile.s_max(), contact_s + kReach);
  const int pieces = static_cast<int>(std::ceil((end - begin) / kSpacing));
  Json points = Json::array();
  for (int k = 0; k <= pieces; ++k) {
    const ProfilePoint p = profile.at(k == pieces ? end : begin + (end - begin) * k / pieces);
    if (std::abs(p.position.y) > half_width) continue;
    const Vec2 point = to_model(p.position - depth * p.outward);
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
  out["profile_notes"] = placement.notes;
  out["load_N"] = hertz.load;
  out["contact"] = contact_json(c, placement);
  out["hertz"] = hertz_json(hertz);
  if (patches.size() > 1)
    for (const LoadedContact& p : patches)
      out["patches"].push_back({{"contact", contact_json(p.contact, placement)},
                                {"load_N", p.load},
                                {"hertz", hertz_json(hertz_under(spec, p))}});
  out["rail_m"] = curve(placement.rail, c.rail_s, 0, kReach, rail);
  out["wheel_m"] = curve(placement.wheel, c.wheel_s, 0, kReach, wheel);
  out["layers"] = Json::array();
  const std::vector<double> tops = layer_tops(spec.layers);
  for (std::size_t i = 0; i < spec.layers.size(); ++i) {
    const LayerSpec& l = spec.layers[i];
    const bool on_rail = l.on == BodyId::rail;
    const double depth = tops[i] + l.thickness;
    out["layers"].push_back(
        {{"name", l.name},
         {"on", body_word(l.on)},
         {"thickness_m", l.thickness},
         {"width_m", l.width},
         {"young_Pa", l.material.young},
         {"young_ratio", l.material.young / (on_rail ? spec.rail_material : spec.wheel_material).young},
         {"bottom_m", on_rail ? curve(placement.rail, c.rail_s, depth, 0.5 * l.width, rail)
                              : curve(placement.wheel, c.wheel_s, depth, 0.5 * l.width, wheel)}});
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

}  // namespace railstrata
