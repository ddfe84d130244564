#include "rules/case_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/rolling_start.hpp"
#include "rules/clashes.hpp"
#include "rules/irregularity_rules.hpp"
#include "spec/case_spec.hpp"
#include "tables/load_rows.hpp"
#include "text/units.hpp"

namespace railstrata {
namespace {

constexpr double kNanometre = 1e-9;

/// For messages: rounded, since sums of lengths carry round-off.
std::string length(double value) { return format_quantity(std::round(value / kNanometre) / 1e9, dimension::kLength); }

void refuse(CaseSource& source, const std::string& key, const std::string& value, const std::string& rule,
            const std::string& remedy) {
  source.complain(key, fmt::format("{} = {}: {}", key, value, rule), remedy);
}

void check_level_crack(const CaseSpec& spec, CaseSource& source) {
  constexpr double kLongest = 20;  // depths: points and time grow with the length, G hardly does
  const CrackSpec& crack = spec.life.crack;
  double depth = 0;
  int layers = 0;
  for (const LayerSpec& layer : spec.layers) {
    if (layer.on != BodyId::rail || ++layers > crack.layer) continue;
    depth += layer.thickness;
    if (layers == crack.layer && (layer.interface_normal_stiffness || layer.interface_shear_stiffness))
      refuse(source, "crack.layer", fmt::format("{}", crack.layer), "the interface there gives: a crack needs a bond",
             "take out its interface_normal_stiffness and interface_shear_stiffness");
  }
  if (layers < crack.layer)
    return refuse(source, "crack.layer", fmt::format("{}", crack.layer),
                  fmt::format("a crack with a length lies below a layer, of which the rail has {}", layers),
                  "give a [[layer]], or the crack a depth");
  if (crack.length > kLongest * depth)
    refuse(source, "crack.length", length(crack.length),
           fmt::format("must be at most {} times the depth of the interface, {}", kLongest, length(depth)),
           "choose a smaller value");
}

void check_crack(const CaseSpec& spec, CaseSource& source) {
  const CrackSpec& crack = spec.life.crack;
  const bool sound =
      source.sound({"crack.depth", "crack.top", "crack.length", "crack.layer", "crack.detectable", "crack.allowable"});
  if (sound && crack.level()) check_level_crack(spec, source);
  if (!sound || !(crack.depth > 0)) return;
  if (crack.top >= crack.depth)
    refuse(source, "crack.top", length(crack.top), fmt::format("must lie above crack.depth = {}", length(crack.depth)),
           "choose a smaller value");
  if (spec.life.until > 0 && crack.detectable >= crack.allowable)
    refuse(source, "crack.detectable", length(crack.detectable),
           fmt::format("must be less than crack.allowable = {}", length(crack.allowable)), "choose a smaller value");
  if (spec.life.until > 0 && crack.depth >= crack.allowable)
    refuse(source, "crack.depth", length(crack.depth),
           fmt::format("must be less than crack.allowable = {}", length(crack.allowable)),
           "choose a smaller value, e.g. \"0.2 mm\"");
}

void check_drive(const CaseSpec& spec, CaseSource& source) {
  const DriveSpec& d = spec.drive;
  if (spec.transient.kind == TransientKind::shift) return;  // it takes nothing of the drive but friction
  if (!spec.run.rolling ||
      !source.sound({"drive.traction_coefficient", "drive.tractive_force", "drive.creepage", "drive.lateral_creepage",
                     "drive.lateral_force", "drive.lateral_traction_coefficient", "drive.friction_coefficient"}))
    return;
  const double along = d.traction().value_or(0), across = d.lateral_traction_coefficient.value_or(0),
               wanted = std::hypot(along, across);
  if (wanted == 0 || wanted < d.friction_coefficient) return;
  const auto refuse = [&](const char* key, const std::string& value, const char* what) {
    source.complain(
        key, fmt::format("{}: {}must be below drive.friction_coefficient = {}", value, what, d.friction_coefficient),
        "the wheel would slide: lower the traction or raise the friction");
  };
  if (across == 0)
    refuse("drive.traction_coefficient", fmt::format("drive.traction_coefficient = {}", along),
           along < 0 ? "its magnitude " : "");
  else
    refuse(
        "drive.lateral_traction_coefficient",
        fmt::format("traction coefficients of {} along and {} across the rail, {:.4g} together", along, across, wanted),
        "");
}

void check_friction_law(const CaseSpec& spec, CaseSource& source) {
  const FrictionSpec& f = spec.friction;
  if (!source.sound({"friction.kinetic_coefficient", "drive.friction_coefficient"})) return;
  if (f.kinetic_coefficient && *f.kinetic_coefficient > spec.drive.friction_coefficient)
    refuse(source, "friction.kinetic_coefficient", fmt::format("{}", *f.kinetic_coefficient),
           fmt::format("must be at most drive.friction_coefficient = {}, the coefficient at rest",
                       spec.drive.friction_coefficient),
           "friction falls with slip: exchange the two");
}

void check_third_body(const CaseSpec& spec, CaseSource& source) {
  const ThirdBodySpec& t = spec.third_body;
  if (!source.sound({"third_body.thickness", "third_body.shear_modulus", "third_body.yield_shear",
                     "third_body.hardening", "third_body.residual_shear"}))
    return;
  const auto gradient = [](double value) { return format_quantity(value, dimension::kPressureGradient); };
  const auto pressure = [](double value) { return format_quantity(value, dimension::kPressure); };
  if (t.thickness && t.shear_modulus) {
    const double elastic = *t.shear_modulus / *t.thickness;
    if (t.hardening > elastic)
      refuse(source, "third_body.hardening", gradient(t.hardening),
             fmt::format("must be at most shear_modulus / thickness = {}", gradient(elastic)),
             "a film that yields is softer than an elastic one: lower the hardening");
    if (t.hardening < 0 && !(-t.hardening < elastic))
      refuse(source, "third_body.hardening", gradient(t.hardening),
             fmt::format("must be above -shear_modulus / thickness = {}", gradient(-elastic)),
             "a film that softens faster springs back and slips all at once: take a slower softening");
  }
  if (t.residual_shear && t.yield_shear && *t.residual_shear > *t.yield_shear)
    refuse(source, "third_body.residual_shear", pressure(*t.residual_shear),
           fmt::format("must be at most third_body.yield_shear = {}", pressure(*t.yield_shear)),
           "softening ends below the strength it begins with: exchange the two");
}

void check_curve(const GeometrySpec& g, CaseSource& source) {
  constexpr double kTightest = 5;
  if (g.curve_radius && source.sound({"geometry.curve_radius"}) && !(std::abs(*g.curve_radius) >= kTightest))
    refuse(source, "geometry.curve_radius", length(*g.curve_radius),
           fmt::format("must be at least {} to either side", length(kTightest)), "leave it out for straight track");
}

/// A rail that is curved along rolling.
void check_roller(const GeometrySpec& g, CaseSource& source) {
  constexpr double kSmallest = 5e-3;
  if (!g.rail_radius || !source.sound({"geometry.rail_radius", "geometry.wheel_radius"})) return;
  const std::string radius = length(*g.rail_radius);
  if (!(std::abs(*g.rail_radius) >= kSmallest))
    refuse(source, "geometry.rail_radius", radius, fmt::format("must be at least {} to either side", length(kSmallest)),
           "leave it out for a straight rail");
  else if (*g.rail_radius < 0 && !(-*g.rail_radius > g.wheel_radius))
    refuse(source, "geometry.rail_radius", radius,
           fmt::format("a hollow rail must be wider than the wheel, wheel_radius = {}", length(g.wheel_radius)),
           "give a larger radius; above 0 it is a roller");
}

void check_path(const CaseSpec& spec, CaseSource& source) {
  const RunSpec& run = spec.run;
  if (!run.rolling || run.positions.empty() || !source.sound({"run.positions", "run.run_up", "run.window"})) return;
  if (!std::is_sorted(run.positions.begin(), run.positions.end(), std::less_equal<>()))
    source.complain("run.positions", "run.positions must increase",
                    "list each wheel position once, the smallest first");
  const double first = *std::min_element(run.positions.begin(), run.positions.end());
  const double run_up = run_up_of(spec, 0), needed = run_up + 0.5 * run.window;
  if (first < needed - kNanometre)
    source.complain("run.positions",
                    fmt::format("run.positions: {} is not yet beyond the run-up ({}) and half the window ({})",
                                length(first), length(run_up), length(0.5 * run.window)),
                    fmt::format("start at {} or later, or shorten run.run_up or run.window", length(needed)));
}

void check_wheel(const GeometrySpec& g, CaseSource& source) {
  if (!source.sound({"geometry.wheel_radius", "geometry.rim_thickness", "geometry.hub_radius", "geometry.bore_radius"}))
    return;
  const double bore = g.wheel_section.bore_radius, hub = g.wheel_section.hub_radius;
  const auto below = [&](const char* key, double value, const char* other, double most, const char* remedy) {
    if (!(value < most))
      refuse(source, key, length(value), fmt::format("must be below {} = {}", other, length(most)), remedy);
  };
  if (g.wheel_shape == WheelShape::disc)
    return below("geometry.bore_radius", bore, "wheel_radius", g.wheel_radius, "make the bore smaller");
  below("geometry.bore_radius", bore, "hub_radius", hub, "make the bore smaller or the hub larger");
  below("geometry.hub_radius", hub, "wheel_radius - rim_thickness", g.wheel_radius - g.wheel_section.rim_thickness,
        "make the hub or the rim smaller");
}

void check_mesh(const MeshSpec& m, CaseSource& source) {
  const auto at_least = [&](const char* key, double value, double least, const char* why) {
    if (value < least && source.sound({key, "mesh.element_size"}))
      refuse(source, key, length(value), fmt::format("must be at least {} ({})", length(least), why),
             "make it larger, or mesh.element_size smaller");
  };
  at_least("mesh.fine_width", m.fine_width.value_or(kFineWidth), 4 * m.element_size, "four elements");
  at_least("mesh.fine_depth", m.fine_depth, m.element_size, "one element");
  at_least("mesh.largest", m.largest, m.element_size, "one element");
}

void check_track(const CaseSpec& spec, CaseSource& source) {
  const SleeperTrack& t = spec.track.support;
  if (!spec.track.held() && source.sound({"track.pad_length", "track.spacing"}) && t.pad_length > 0.8 * t.spacing)
    refuse(source, "track.pad_length", length(t.pad_length),
           fmt::format("must be at most {}, 0.8 spacings", length(0.8 * t.spacing)),
           "give the pad's length along the rail, e.g. \"150 mm\"");
}

void check_passes(const CaseSpec& spec, CaseSource& source) {
  if (!source.sound({"passes.traction_coefficients", "drive.friction_coefficient"})) return;
  for (const double traction : spec.passes.traction_coefficients)
    if (std::abs(traction) >= spec.drive.friction_coefficient && traction != 0)
      return source.complain("passes.traction_coefficients",
                             fmt::format("passes.traction_coefficients: {} must be below drive.friction_coefficient = "
                                         "{} in magnitude",
                                         traction, spec.drive.friction_coefficient),
                             "the wheel would slide: lower the traction or raise the friction");
}

void check_bogies(const CaseSpec& spec, CaseSource& source) {
  const std::vector<BogieSpec>& bogies = spec.collective.curve.bogies;
  for (std::size_t i = 0; i < bogies.size(); ++i) {
    const std::string name = fmt::format("bogie.{}", i);
    if (!bogies[i].mgt)
      source.complain(name + ".mgt", fmt::format("{}: its traffic is not given", name),
                      "give mgt, in million gross tonnes: a year's, or 100 for wear per 100 MGT");
    const double radius = bogies[i].wheel_radius.value_or(spec.geometry.wheel_radius);
    if (bogies[i].centre_of_gravity <= radius)
      refuse(source, name + ".centre_of_gravity", length(bogies[i].centre_of_gravity),
             fmt::format("must lie above the axle, {}", length(radius)), "give its height above the top of rail");
    if (bogies[i].wheelset_mass * kGravity >= 0.5 * bogies[i].axle_load)
      refuse(source, name + ".wheelset_mass", format_quantity(bogies[i].wheelset_mass, dimension::kMass),
             "must weigh less than half of the axle load", "check both");
  }
}

}  // namespace

void check_case_rules(const CaseSpec& spec, CaseSource& source) {
  check_clashes(spec, source);
  check_crack(spec, source);
  check_drive(spec, source);
  check_transient(spec, source);
  check_friction_law(spec, source);
  check_third_body(spec, source);
  check_curve(spec.geometry, source);
  check_path(spec, source);
  check_wheel(spec.geometry, source);
  check_roller(spec.geometry, source);
  check_mesh(spec.mesh, source);
  check_layers(spec, source);
  check_strengths(spec, source);
  check_track(spec, source);
  check_passes(spec, source);
  check_irregularities(spec, source);
  check_loads(spec, source);
  check_bogies(spec, source);
}

}  // namespace railstrata
