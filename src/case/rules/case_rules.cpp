#include "rules/case_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "options/option_table.hpp"
#include "rules/irregularity_rules.hpp"
#include "rules/layer_rules.hpp"
#include "rules/line_rules.hpp"
#include "rules/strength_rules.hpp"
#include "rules/transient_rules.hpp"
#include "tables/load_rows.hpp"
#include "text/units.hpp"

namespace railstrata {
namespace {

constexpr double kNanometre = 1e-9;

/// For messages: rounded, since sums of lengths carry round-off.
std::string length(double value) { return format_quantity(std::round(value / kNanometre) / 1e9, dimension::kLength); }

/// Whose creepages follow from those of the wheel.
void check_creepage_of(const CaseSpec& spec, CaseSource& source) {
  if (spec.drive.creepage_of == CreepageOf::contact) return;
  const auto refuse = [&](bool asked, const char* with) {
    if (asked)
      source.complain("drive.creepage_of", fmt::format("drive.creepage_of = \"wheel\" with {} is not computed", with),
                      "give creepages of the contact");
  };
  refuse(spec.geometry.rail_radius.has_value(), "geometry.rail_radius");
  refuse(spec.geometry.in_line(), "a line contact");
  refuse(spec.transient.kind != TransientKind::none, "transient.kind");
}

/// Under a given approach the load is a result, and a force over it is not known beforehand.
void check_approach(const CaseSpec& spec, CaseSource& source) {
  if (!spec.vehicle.approach) return;
  for (const char* key : {"drive.tractive_force", "drive.lateral_force"})
    if (source.has(key))
      source.complain(key,
                      fmt::format("{}: under vehicle.approach the load is a result, a force may be beyond it", key),
                      "give drive.traction_coefficient or lateral_traction_coefficient, which then count over the load "
                      "that comes out, or a creepage");
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
  if (!source.sound(
          {"friction.law", "friction.kinetic_coefficient", "friction.half_velocity", "drive.friction_coefficient"}))
    return;
  const auto needs = [&](const char* key, bool given, const char* remedy) {
    if (f.law != FrictionForm::coulomb && !given)
      source.complain("friction.law", fmt::format("friction that falls with slip needs {}", key), remedy);
    if (f.law == FrictionForm::coulomb && given)
      source.complain(key, fmt::format("{} has no meaning with friction.law = \"coulomb\"", key),
                      "take it out, or take friction.law = \"falling_exponential\" or \"falling_rational\"");
  };
  needs("friction.kinetic_coefficient", f.kinetic_coefficient.has_value(),
        "give the coefficient of fast slip, e.g. 0.4 times drive.friction_coefficient");
  needs("friction.half_velocity", f.half_velocity.has_value(),
        "give the slip velocity at which half of the fall is done, e.g. \"1 m/s\"");
  if (f.kinetic_coefficient && *f.kinetic_coefficient > spec.drive.friction_coefficient)
    source.complain("friction.kinetic_coefficient",
                    fmt::format("friction.kinetic_coefficient = {}: must be at most drive.friction_coefficient = {}, "
                                "the coefficient at rest",
                                *f.kinetic_coefficient, spec.drive.friction_coefficient),
                    "friction falls with slip: exchange the two");
}

void check_softening(const ThirdBodySpec& t, CaseSource& source) {
  if (t.thickness && t.shear_modulus && t.hardening < 0 && !(-t.hardening < *t.shear_modulus / *t.thickness))
    source.complain("third_body.hardening",
                    fmt::format("third_body.hardening = {}: must be above -shear_modulus / thickness = {}",
                                format_quantity(t.hardening, dimension::kPressureGradient),
                                format_quantity(-*t.shear_modulus / *t.thickness, dimension::kPressureGradient)),
                    "a film that softens faster springs back and slips all at once: take a slower softening");
  if (t.hardening < 0 && !t.residual_shear)
    source.complain("third_body.hardening", "a film that softens needs third_body.residual_shear",
                    "give the strength that much shear leaves, e.g. a tenth of yield_shear");
  if (t.residual_shear && !(t.hardening < 0))
    source.complain("third_body.residual_shear",
                    "third_body.residual_shear has no meaning for a film that does not soften",
                    "take it out, or give a third_body.hardening below 0");
  if (t.residual_shear && t.yield_shear && *t.residual_shear > *t.yield_shear)
    source.complain("third_body.residual_shear",
                    fmt::format("third_body.residual_shear = {}: must be at most third_body.yield_shear = {}",
                                format_quantity(*t.residual_shear, dimension::kPressure),
                                format_quantity(*t.yield_shear, dimension::kPressure)),
                    "softening ends below the strength it begins with: exchange the two");
}

void check_third_body(const CaseSpec& spec, CaseSource& source) {
  const ThirdBodySpec& t = spec.third_body;
  if (!source.sound({"third_body.thickness", "third_body.shear_modulus", "third_body.yield_shear",
                     "third_body.hardening", "third_body.residual_shear", "friction.law", "friction.memory_distance"}))
    return;
  const auto needs = [&](const char* key, bool given, const char* other, bool other_given, const char* remedy) {
    if (given && !other_given) source.complain(key, fmt::format("{} needs {}", key, other), remedy);
  };
  needs("third_body.thickness", t.thickness.has_value(), "third_body.shear_modulus", t.shear_modulus.has_value(),
        "give the film's shear modulus, e.g. \"100 MPa\"");
  needs("third_body.shear_modulus", t.shear_modulus.has_value(), "third_body.thickness", t.thickness.has_value(),
        "give the film's thickness, e.g. \"20 µm\"");
  needs("third_body.yield_shear", t.yield_shear.has_value(), "third_body.thickness", t.thickness.has_value(),
        "give the film's thickness, e.g. \"20 µm\"");
  needs("third_body.hardening", t.hardening != 0, "third_body.yield_shear", t.yield_shear.has_value(),
        "give the stress at which the film begins to yield");
  needs("third_body.yield_by_pressure", t.yield_by_pressure != 0, "third_body.yield_shear", t.yield_shear.has_value(),
        "give the stress at which the film begins to yield without pressure");
  needs("third_body.modulus_by_pressure", t.modulus_by_pressure != 0, "third_body.thickness", t.thickness.has_value(),
        "give the film's thickness, e.g. \"20 µm\"");
  needs("third_body.temperature_table", !t.temperature_table.empty(), "third_body.thickness", t.thickness.has_value(),
        "give the film's thickness, e.g. \"20 µm\"");
  if (t.thickness && t.shear_modulus && t.hardening > *t.shear_modulus / *t.thickness)
    source.complain("third_body.hardening",
                    fmt::format("third_body.hardening = {}: must be at most shear_modulus / thickness = {}",
                                format_quantity(t.hardening, dimension::kPressureGradient),
                                format_quantity(*t.shear_modulus / *t.thickness, dimension::kPressureGradient)),
                    "a film that yields is softer than an elastic one: lower the hardening");
  check_softening(t, source);
  if (t.thickness && spec.friction.law != FrictionForm::coulomb && !(spec.friction.memory_distance > 0))
    source.complain("third_body.thickness",
                    "a third-body layer under friction that falls with slip at once has no steady state: it would jump",
                    "give friction.memory_distance, e.g. \"14 um\", or take friction.law = \"coulomb\"");
}

/// An ellipse of friction has no place for laws that count slip by its size alone.
void check_lateral_coefficient(const CaseSpec& spec, CaseSource& source) {
  if (!spec.friction.lateral_coefficient) return;
  const auto refuse = [&](bool asked, const char* with) {
    if (asked)
      source.complain("friction.lateral_coefficient",
                      fmt::format("friction.lateral_coefficient and {}: that law counts slip the same along and across "
                                  "rolling",
                                  with),
                      "take one of them out");
  };
  refuse(spec.friction.law != FrictionForm::coulomb, "friction that falls with slip");
  refuse(spec.third_body.yield_shear.has_value(), "a film that yields");
  if (!(spec.drive.friction_coefficient > 0))
    source.complain("friction.lateral_coefficient", "friction.lateral_coefficient needs friction along rolling too",
                    "give drive.friction_coefficient above 0");
}

void check_temperatures(const CaseSpec& spec, CaseSource& source) {
  const FrictionSpec& f = spec.friction;
  const bool by_temperature = !f.temperature_table.empty() || !spec.third_body.temperature_table.empty();
  const char* const table = f.temperature_table.empty() ? "third_body.temperature_table" : "friction.temperature_table";
  if (!source.sound({"friction.temperature_table", "third_body.temperature_table", "friction.rail_temperature",
                     "friction.wheel_temperature"}))
    return;
  for (const auto& [key, given] : {std::pair("friction.rail_temperature", f.rail_temperature.has_value()),
                                   std::pair("friction.wheel_temperature", f.wheel_temperature.has_value())}) {
    if (by_temperature && !given)
      source.complain(table, fmt::format("{} needs {}", table, key),
                      "give the temperature at which the body comes, from the same zero as the table's: \"20 K\" if "
                      "that is 0 °C");
    if (given && !by_temperature)
      source.complain(key, fmt::format("{} has no meaning without a temperature_table", key),
                      "give friction.temperature_table or third_body.temperature_table, or take it out");
  }
  if (by_temperature && spec.transient.kind == TransientKind::shift)
    source.complain(table, "a shift takes no time that heat could be counted by", "take the table out, or let it roll");
}

void check_lateral_friction(const CaseSpec& spec, CaseSource& source) {
  const std::vector<TablePoint>& rows = spec.friction.lateral_table;
  if (rows.empty() || !source.sound({"drive.friction_coefficient", "friction.lateral_table"})) return;
  if (spec.drive.friction_coefficient != largest_value(rows))
    source.complain("friction.lateral_table", "friction.lateral_table has the coefficients of the case",
                    "take drive.friction_coefficient out");
  if (spec.geometry.in_line())
    source.complain("friction.lateral_table", "friction.lateral_table has no meaning in a line contact",
                    "give drive.friction_coefficient instead");
}

void check_curve(const GeometrySpec& g, CaseSource& source) {
  constexpr double kTightest = 5;
  if (g.curve_radius && source.sound({"geometry.curve_radius"}) && !(std::abs(*g.curve_radius) >= kTightest))
    source.complain("geometry.curve_radius",
                    fmt::format("geometry.curve_radius = {}: must be at least {} to either side",
                                length(*g.curve_radius), length(kTightest)),
                    "leave it out for straight track");
}

/// A rail that is curved along rolling.
void check_roller(const GeometrySpec& g, CaseSource& source) {
  constexpr double kSmallest = 5e-3;
  if (!g.rail_radius || !source.sound({"geometry.rail_radius", "geometry.wheel_radius"})) return;
  const auto refuse = [&](const std::string& rule, const char* remedy) {
    source.complain("geometry.rail_radius", fmt::format("geometry.rail_radius = {}: {}", length(*g.rail_radius), rule),
                    remedy);
  };
  if (!(std::abs(*g.rail_radius) >= kSmallest))
    refuse(fmt::format("must be at least {} to either side", length(kSmallest)), "leave it out for a straight rail");
  else if (*g.rail_radius < 0 && !(-*g.rail_radius > g.wheel_radius))
    refuse(fmt::format("a hollow rail must be wider than the wheel, wheel_radius = {}", length(g.wheel_radius)),
           "give a larger radius; above 0 it is a roller");
  if (g.roll != 0) refuse("not together with geometry.roll", "take one of them out");
  if (g.curve_radius) refuse("a roller lies in no curve (geometry.curve_radius)", "take one of them out");
}

void check_path(const RunSpec& run, CaseSource& source) {
  if (!run.rolling || run.positions.empty() || !source.sound({"run.positions", "run.run_up", "run.window"})) return;
  if (!std::is_sorted(run.positions.begin(), run.positions.end(), std::less_equal<>()))
    source.complain("run.positions", "run.positions must increase",
                    "list each wheel position once, the smallest first");
  const double first = *std::min_element(run.positions.begin(), run.positions.end());
  const double needed = run.run_up + 0.5 * run.window;
  if (first < needed - kNanometre)
    source.complain("run.positions",
                    fmt::format("run.positions: {} is not yet beyond the run-up ({}) and half the window ({})",
                                length(first), length(run.run_up), length(0.5 * run.window)),
                    fmt::format("start at {} or later, or shorten run.run_up or run.window", length(needed)));
}

void check_wheel(const GeometrySpec& g, CaseSource& source) {
  if (!source.sound({"geometry.wheel_radius", "geometry.rim_thickness", "geometry.hub_radius", "geometry.bore_radius"}))
    return;
  const double rim_inside = g.wheel_radius - g.wheel_section.rim_thickness;
  if (g.wheel_shape == WheelShape::disc) {
    if (!(g.wheel_section.bore_radius < g.wheel_radius))
      source.complain("geometry.bore_radius",
                      fmt::format("geometry.bore_radius = {}: must be below wheel_radius = {}",
                                  length(g.wheel_section.bore_radius), length(g.wheel_radius)),
                      "make the bore smaller");
    return;
  }
  if (!(g.wheel_section.bore_radius < g.wheel_section.hub_radius))
    source.complain("geometry.bore_radius",
                    fmt::format("geometry.bore_radius = {}: must be below hub_radius = {}",
                                length(g.wheel_section.bore_radius), length(g.wheel_section.hub_radius)),
                    "make the bore smaller or the hub larger");
  if (!(g.wheel_section.hub_radius < rim_inside))
    source.complain("geometry.hub_radius",
                    fmt::format("geometry.hub_radius = {}: must be below wheel_radius - rim_thickness = {}",
                                length(g.wheel_section.hub_radius), length(rim_inside)),
                    "make the hub or the rim smaller");
}

void check_mesh(const MeshSpec& m, CaseSource& source) {
  const auto at_least = [&](const char* key, double value, double least, const char* why) {
    if (value < least && source.sound({fmt::format("mesh.{}", key), "mesh.element_size"}))
      source.complain(fmt::format("mesh.{}", key),
                      fmt::format("mesh.{} = {}: must be at least {} ({})", key, length(value), length(least), why),
                      "make it larger, or mesh.element_size smaller");
  };
  at_least("fine_width", m.fine_width, 4 * m.element_size, "four elements");
  at_least("fine_depth", m.fine_depth, m.element_size, "one element");
  at_least("largest", m.largest, m.element_size, "one element");
}

void check_plasticity(const CaseSpec& spec, CaseSource& source) {
  if (!spec.run.plasticity) return;
  const auto refuse = [&](bool asked, const char* key, const char* why, const char* remedy) {
    if (asked && source.sound({key}))
      source.complain(key, fmt::format("{} with run.plasticity = true: {}", key, why), remedy);
  };
  refuse(spec.mesh.element == ElementFormulation::one_point, "mesh.element",
         "elements with one point stay too stiff after yield", "mesh.element = \"full\"");
  refuse(spec.run.time_step_method == TimeStepMethod::local, "run.time_step_method",
         "rows with inner steps keep no plastic strain", "run.time_step_method = \"mass_scaling\" or \"auto\"");
}

void check_device(const CaseSpec& spec, CaseSource& source) {
  if (spec.run.device == ComputeDevice::cpu || !source.sound({"run.device"})) return;
  const auto refuse = [&](bool asked, const char* what) {
    if (asked)
      source.complain("run.device", fmt::format("run.device: a device takes steps without {} only", what),
                      "run.device = \"cpu\"");
  };
  refuse(spec.run.time_step_method == TimeStepMethod::local, "run.time_step_method = \"local\"");
  refuse(spec.run.plasticity, "run.plasticity = true");
  refuse(!spec.friction.lateral_table.empty(), "friction.lateral_table");
}

/// A set gives the numbers that a case leaves out; without one nothing is below the foot.
void check_track(const CaseSpec& spec, CaseSource& source) {
  if (spec.track.held()) {
    for (const Option& o : find_table("track")->options)
      if (const std::string key = fmt::format("track.{}", o.key); key != "track.preset" && source.has(key))
        return source.complain(key, fmt::format("{} needs track.preset: without it the foot is held", key),
                               "give track.preset = \"delft\", \"medium\" or \"cn60\", whose numbers the keys have "
                               "that are not given");
    return;
  }
  const auto refuse = [&](bool asked, const char* with, const char* remedy) {
    if (asked) source.complain("track.preset", fmt::format("track.preset with {} is not computed", with), remedy);
  };
  refuse(spec.geometry.rail_radius.has_value(), "geometry.rail_radius", "a roller turns about a shaft: take it out");
  refuse(spec.run.time_step_method == TimeStepMethod::local, "run.time_step_method = \"local\"",
         "inner steps know a held foot: give run.time_step_method = \"auto\"");
  refuse(spec.run.device != ComputeDevice::cpu, "run.device = \"gpu\"", "run.device = \"cpu\"");
  const SleeperTrack& t = spec.track.support;
  if (source.sound({"track.pad_length", "track.spacing"}) && t.pad_length > 0.8 * t.spacing)
    source.complain("track.pad_length",
                    fmt::format("track.pad_length = {}: must be at most {}, 0.8 spacings", length(t.pad_length),
                                length(0.8 * t.spacing)),
                    "give the pad's length along the rail, e.g. \"150 mm\"");
}

void check_passes(const CaseSpec& spec, CaseSource& source) {
  if (spec.passes.jump != PassJump::off && spec.passes.lateral_deviation)
    source.complain("passes.jump",
                    "passes.jump = \"auto\": wheels that scatter never repeat, so no round shows the next",
                    "take out passes.lateral_deviation, or give passes.lateral_positions alone");
  if (!source.sound({"passes.traction_coefficients", "drive.friction_coefficient"})) return;
  for (const double traction : spec.passes.traction_coefficients)
    if (std::abs(traction) >= spec.drive.friction_coefficient && traction != 0)
      return source.complain("passes.traction_coefficients",
                             fmt::format("passes.traction_coefficients: {} must be below drive.friction_coefficient = "
                                         "{} in magnitude",
                                         traction, spec.drive.friction_coefficient),
                             "the wheel would slide: lower the traction or raise the friction");
}

void check_life(const CaseSpec& spec, CaseSource& source) {
  constexpr int kFewest = 8;
  if (spec.life.passes > 0 && spec.life.passes < kFewest)
    source.complain("life.passes",
                    fmt::format("life.passes = {}: must be 0, or at least {} for a trend", spec.life.passes, kFewest),
                    "take some 40");
  if (spec.grinding.every.has_value() != (spec.grinding.depth > 0))
    source.complain(spec.grinding.every ? "grinding.every" : "grinding.depth",
                    "grinding.every and grinding.depth belong together",
                    "give both, e.g. every = \"15 Mt\" and depth = \"0.2 mm\", or none");
}

}  // namespace

void check_case_rules(const CaseSpec& spec, CaseSource& source) {
  check_drive(spec, source);
  check_creepage_of(spec, source);
  check_approach(spec, source);
  check_transient(spec, source);
  check_friction_law(spec, source);
  check_third_body(spec, source);
  check_temperatures(spec, source);
  check_lateral_coefficient(spec, source);
  check_lateral_friction(spec, source);
  check_curve(spec.geometry, source);
  check_line_contact(spec, source);
  check_path(spec.run, source);
  check_wheel(spec.geometry, source);
  check_roller(spec.geometry, source);
  check_mesh(spec.mesh, source);
  check_layers(spec, source);
  check_strengths(spec, source);
  check_plasticity(spec, source);
  check_device(spec, source);
  check_track(spec, source);
  check_passes(spec, source);
  check_irregularities(spec, source);
  check_life(spec, source);
  check_loads(spec, source);
}

std::vector<std::string> idle_settings(const CaseSpec& spec) {
  const CaseSpec defaults;
  std::vector<std::string> notes;
  const auto idle = [&](bool set, const char* key, const char* when) {
    if (set) notes.push_back(fmt::format("{} has no effect: it needs {}", key, when));
  };
  idle(spec.contact.method != ContactMethod::penalty && spec.contact.penalty_scale != defaults.contact.penalty_scale,
       "contact.penalty_scale", "contact.method = \"penalty\"");
  idle(spec.mesh.element != ElementFormulation::one_point &&
           spec.mesh.hourglass_coefficient != defaults.mesh.hourglass_coefficient,
       "mesh.hourglass_coefficient", "mesh.element = \"one_point\"");
  const DriveSpec& d = spec.drive;
  const char* const rolling = "a case that rolls, transient.kind = \"shift\" does not";
  if (spec.transient.kind == TransientKind::none)
    for (const GivenColumn& c : given_columns(spec))
      idle(true, ("transient." + c.key).c_str(), "transient.kind = \"rolling\" or \"shift\"");
  if (spec.transient.kind == TransientKind::shift) {
    idle(d.creepage.has_value(), "drive.creepage", rolling);
    idle(d.traction_coefficient != defaults.drive.traction_coefficient, "drive.traction_coefficient", rolling);
    idle(d.lateral_creepage.has_value(), "drive.lateral_creepage", rolling);
    idle(d.lateral_traction_coefficient.has_value(), "drive.lateral_traction_coefficient", rolling);
    idle(d.spin.has_value(), "drive.spin", rolling);
  }
  idle(spec.transient.kind != TransientKind::shift && spec.transient.increments != defaults.transient.increments,
       "transient.increments", "transient.kind = \"shift\"; what rolls goes on by one cell a step");
  for (std::size_t i = 0; i < spec.layers.size(); ++i)
    idle(!spec.layers[i].graded() && spec.layers[i].grading_tolerance != LayerSpec{}.grading_tolerance,
         fmt::format("layer.{}.grading_tolerance", i).c_str(), "a young_table");
  idle(spec.geometry.rail_shape != RailShape::block && spec.geometry.block_width != defaults.geometry.block_width,
       "geometry.block_width", "geometry.rail_shape = \"block\"");
  idle(spec.geometry.rail_shape != RailShape::block && spec.geometry.block_height != defaults.geometry.block_height,
       "geometry.block_height", "geometry.rail_shape = \"block\"");
  idle(!spec.run.rolling && spec.run.device != ComputeDevice::cpu, "run.device", "run.rolling = true");
  idle(!spec.run.plasticity && spec.run.plastic_depth.has_value(), "run.plastic_depth", "run.plasticity = true");
  idle(!spec.run.plasticity && spec.run.plastic_width.has_value(), "run.plastic_width", "run.plasticity = true");
  return notes;
}

std::vector<std::string> void_drive(const CaseSpec& spec, const CaseSource& source) {
  std::vector<std::string> notes;
  if (spec.run.rolling || spec.transient.kind == TransientKind::shift) return notes;
  const auto is_void = [&](bool given, const char* key) {
    if (given)
      notes.push_back(
          fmt::format("{} has no effect: run.rolling = false presses the wheel on without friction; take "
                      "it out, or set run.rolling = true",
                      key));
  };
  const DriveSpec& d = spec.drive;
  is_void(d.creepage.has_value(), "drive.creepage");
  const char* const traction =
      source.has("drive.tractive_force") ? "drive.tractive_force" : "drive.traction_coefficient";
  is_void(d.traction().value_or(0) != 0 &&
              (d.traction_coefficient != DriveSpec{}.traction_coefficient || source.has_origin(traction)),
          traction);
  is_void(d.lateral_creepage.has_value(), "drive.lateral_creepage");
  is_void(d.lateral_traction_coefficient.has_value(), "drive.lateral_traction_coefficient");
  is_void(d.spin.has_value(), "drive.spin");
  const std::vector<double>& passes = spec.passes.traction_coefficients;
  is_void(std::any_of(passes.begin(), passes.end(), [](double t) { return t != 0; }), "passes.traction_coefficients");
  return notes;
}

std::vector<std::string> unread_hardening(const CaseSpec& spec) {
  std::vector<std::string> notes;
  if (spec.run.plasticity || spec.life.passes > 0) return notes;  // passes of a life take it
  const auto look = [&](const std::string& table, const StrengthSpec& s) {
    const char* const key = !s.hardening.empty()             ? "hardening"
                            : s.isotropic_hardening          ? "isotropic_hardening"
                            : !s.kinematic_hardening.empty() ? "kinematic_hardening"
                                                             : nullptr;
    if (key)
      notes.push_back(
          fmt::format("{}.{}: `run` and `bem` compute elastically without run.plasticity = true (finite elements); "
                      "`railstrata passes` and `railstrata material` take it",
                      table, key));
  };
  look("material.rail", spec.rail_material.strength);
  look("material.wheel", spec.wheel_material.strength);
  for (std::size_t i = 0; i < spec.layers.size(); ++i)
    look(fmt::format("layer.{}", i), spec.layers[i].material.strength);
  return notes;
}

}  // namespace railstrata
