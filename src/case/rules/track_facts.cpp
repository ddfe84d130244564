#include "rules/track_facts.hpp"

#include <fmt/format.h>

#include <cmath>

#include "geometry/profile_names.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

constexpr double kCrest = 0.055;           // m, of a flange's crest from the tape circle
constexpr double kFlank = 0.034;           // m, depth at which the flanks of CN60's head end (geometry/rail_outline)
constexpr double kLargestWheel = 0.65;     // m, radius
constexpr double kOfTheSameKind = 3.5e-3;  // m, tolerance of a distance between the backs [EN15313]
constexpr double kSameDepth = 1e-3;        // m

bool on_no_track(const GeometrySpec& g) { return names_primitive(g.wheel_profile) || names_primitive(g.rail_profile); }

const TrackPreset& preset_of(const GeometrySpec& g) {
  return track_preset_of(g.track, g.wheel_profile, g.rail_profile);
}

bool has_track(const std::string& profile) { return track_of_profile(profile) != TrackKind::by_profile; }

/// "EN, of S1002".
std::string origin_of(const GeometrySpec& g) {
  const std::string_view name = preset_of(g).name;
  if (g.track != TrackKind::by_profile) return fmt::format("{}, by geometry.track", name);
  if (!on_no_track(g))
    for (const std::string& profile : {g.wheel_profile, g.rail_profile})
      if (has_track(profile)) return fmt::format("{}, of {}", name, profile);
  return fmt::format("{}, the default", name);
}

std::string millimetres(double metres) { return fmt::format("{:.6g} mm", 1e3 * metres); }
std::string one_in(double tangent) {
  return tangent == 0 ? "0" : fmt::format("{}1:{:.4g}", tangent < 0 ? "-" : "", 1 / std::abs(tangent));
}

/// Profile and distance do not belong together.
void compare(const GeometrySpec& g, std::vector<std::string>& notes) {
  const TrackKind wheel = track_of_profile(g.wheel_profile), rail = track_of_profile(g.rail_profile);
  if (wheel != TrackKind::by_profile && rail != TrackKind::by_profile && wheel != rail)
    notes.push_back(fmt::format(
        "{} is a wheel of {}, {} a rail of {}: gauge_depth and back_to_back are {} and {}; geometry.track names those "
        "of one",
        g.wheel_profile, track_preset(wheel).name, g.rail_profile, track_preset(rail).name, millimetres(g.gauge_depth),
        millimetres(g.back_to_back)));
  if (wheel != TrackKind::by_profile)
    if (const double usual = track_preset(wheel).back_to_back; std::abs(g.back_to_back - usual) > kOfTheSameKind)
      notes.push_back(fmt::format("{} with {} between the backs: {} is usual", g.wheel_profile,
                                  millimetres(g.back_to_back), millimetres(usual)));
  if (rail != TrackKind::by_profile)
    if (const double usual = track_preset(rail).gauge_depth; std::abs(g.gauge_depth - usual) > kSameDepth)
      notes.push_back(fmt::format("{} with the gauge measured {} below its top: {} is usual", g.rail_profile,
                                  millimetres(g.gauge_depth), millimetres(usual)));
}

}  // namespace

std::vector<TrackFact> track_facts(const GeometrySpec& g) {
  const TrackPreset& p = preset_of(g);
  const std::string origin = origin_of(g);
  std::vector<TrackFact> out;
  const auto fact = [&](const char* label, double value, double usual, std::string (*text)(double)) {
    out.push_back({label, text(value), value == usual ? origin : fmt::format("given; {} has {}", p.name, text(usual))});
  };
  if (!on_no_track(g)) {
    fact("between the backs of the wheels", g.back_to_back, p.back_to_back, millimetres);
    fact("flange back to tape circle", g.flange_back_to_tape, p.flange_back_to_tape, millimetres);
    fact("gauge", g.gauge, p.gauge, millimetres);
    fact("gauge measured below the top by", g.gauge_depth, p.gauge_depth, millimetres);
  }
  fact("inclination of the rail", g.cant, p.cant, one_in);
  fact("radius of the wheel", g.wheel_radius, p.wheel_radius, millimetres);
  return out;
}

std::vector<std::string> track_notes(const CaseSpec& spec, const CaseSource& source) {
  const GeometrySpec& g = spec.geometry;
  std::vector<std::string> notes;
  if (g.wheel_radius > kLargestWheel)
    notes.push_back(fmt::format("geometry.wheel_radius = {}: wheels above {} are rare, is this the diameter?",
                                millimetres(g.wheel_radius), millimetres(kLargestWheel)));
  double layers = 0;
  for (const LayerSpec& l : spec.layers)
    if (l.on == BodyId::rail) layers += l.thickness;
  if (g.rail_shape == RailShape::rail && layers > kFlank)
    notes.push_back(fmt::format(
        "the layers of the rail are {} thick, the flanks of a head end about {} below its top: half-spaces go on for "
        "ever and do not notice",
        millimetres(layers), millimetres(kFlank)));
  const auto of_no_file = [&](const char* key, bool set, const std::string& profile) {
    if (set && !profile.empty() && (names_primitive(profile) || has_track(profile)))
      notes.push_back(fmt::format("geometry.{} has no effect: {} is built in, not a file", key, profile));
  };
  of_no_file("rail_mirror", g.rail_mirror, g.rail_profile);
  of_no_file("rail_offset", g.rail_offset != 0, g.rail_profile);
  of_no_file("wheel_mirror", g.wheel_mirror, g.wheel_profile);
  of_no_file("wheel_offset", g.wheel_offset != 0, g.wheel_profile);
  if (on_no_track(g)) return notes;
  compare(g, notes);
  if (g.track == TrackKind::by_profile && !has_track(g.wheel_profile) && !has_track(g.rail_profile) &&
      !source.has("geometry.back_to_back"))
    notes.push_back(fmt::format(
        "wheel and rail are from files, and the case names no track: {} between the backs and a gauge measured {} "
        "below the top are taken, those of CN; set geometry.track, or back_to_back and gauge_depth",
        millimetres(g.back_to_back), millimetres(g.gauge_depth)));
  const double crest_to_gauge = 0.5 * (g.gauge - g.back_to_back) - g.flange_back_to_tape + kCrest;
  if (-g.lateral_shift > crest_to_gauge)
    notes.push_back(fmt::format(
        "geometry.lateral_shift = {}: the other wheel of the axle would have its flange's crest beyond its rail's "
        "gauge face, {} away; it has derailed",
        millimetres(g.lateral_shift), millimetres(crest_to_gauge)));
  return notes;
}

}  // namespace railstrata
