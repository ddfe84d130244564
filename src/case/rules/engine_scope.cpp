#include "rules/engine_scope.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/faults.hpp"
#include "geometry/height_field.hpp"
#include "rules/irregularity_rules.hpp"
#include "spec/case_spec.hpp"
#include "text/units.hpp"

namespace railstrata {
namespace {

constexpr const char* kNoWindow = "give run.window = \"0 mm\": states at the positions themselves";
constexpr const char* kWithHalfSpaces = "take it out, or solve the case with `railstrata bem`";

/// A rail with a radius along rolling is meshed as a ring that turns about a shaft.
void refuse_on_ring(const CaseSpec& spec, std::vector<BeyondEngine>& out) {
  const GeometrySpec& g = spec.geometry;
  if (!g.rail_radius) return;
  const auto refuse = [&](bool asked, const char* key, const char* why, const char* remedy) {
    if (asked)
      out.push_back({key, fmt::format("{} with geometry.rail_radius is not in this engine: {}", key, why), remedy});
  };
  refuse(!(*g.rail_radius > 0), "geometry.rail_radius", "a hollow rail has no axle below it", kWithHalfSpaces);
  refuse(g.rail_shape != RailShape::block, "geometry.rail_shape", "a rail with web and foot does not close to a ring",
         "give rail_shape = \"block\": a disc as wide as its profile, block_height thick down to its bore");
  refuse(g.cant != 0, "geometry.cant", "the ring's axle is parallel to the wheel's",
         "give cant = 0.0, or solve the case with `railstrata bem`");
  refuse(spec.run.plasticity, "run.plasticity", "elements of a ring that turns stay elastic", "take it out");
  refuse(spec.run.time_step_method == TimeStepMethod::local, "run.time_step_method", "inner steps know a straight rail",
         "give time_step_method = \"auto\"");
}

/// Heights along rail and wheel: what is written while the wheel passes them, and where they may lie.
void refuse_irregularities(const CaseSpec& spec, std::vector<BeyondEngine>& out) {
  if (spec.irregularities.empty()) return;
  const auto refuse = [&](bool asked, const std::string& key, const std::string& why, const char* remedy) {
    const char* with = key.starts_with("irregularity") ? "" : " with [[irregularity]]";
    if (asked) out.push_back({key, fmt::format("{}{} is not in this engine: {}", key, with, why), remedy});
  };
  refuse(spec.geometry.rail_radius.has_value(), "geometry.rail_radius", "the heights are those of a straight rail",
         kWithHalfSpaces);
  refuse(spec.run.device != ComputeDevice::cpu, "run.device", "a device meets surfaces without heights",
         "give run.device = \"cpu\"");
  refuse(spec.run.rolling && spec.run.window > 0, "run.window",
         "the mean over a stretch of the way is no state of a rail that varies along it", kNoWindow);
  for (std::size_t i = 0; i < spec.irregularities.size(); ++i) {
    const Irregularity& is = spec.irregularities[i];
    const std::string key = fmt::format("irregularity.{}", i);
    const bool of_joint = is.kind == IrregularityKind::dip || is.kind == IrregularityKind::step;
    refuse(of_joint && spec.track.held(), key,
           "the forces of a dip and of a step are made by the track's springs and masses, and the foot of this rail is "
           "held",
           "give [track] preset = \"delft\", or kind = \"indentation\" for a short one, or solve the case with "
           "`railstrata bem`, under a given load");
    if (const auto fault = too_coarse(spec, i, spec.mesh.element_size, "elements", "mesh.element_size"))
      out.push_back({key, fault->message, fault->remedy});
    refuse(spec.run.rolling && is.on == BodyId::rail && extent_of(is).from < spec.run.run_up, key,
           fmt::format("it begins before the end of run.run_up ({})",
                       format_quantity(spec.run.run_up, dimension::kLength)),
           "put it farther on (at, from), or shorten run.run_up");
  }
}

/// Of the rail's layers; layer_rules.cpp has those of a wheel.
bool any_unbonded(const CaseSpec& spec) {
  return std::any_of(spec.layers.begin(), spec.layers.end(), [](const LayerSpec& l) { return !l.unbonded.empty(); });
}

/// Stretches of a layer that have come off: what moves their two sides one by one.
void refuse_unbonded(const CaseSpec& spec, std::vector<BeyondEngine>& out) {
  if (!any_unbonded(spec)) return;
  const auto refuse = [&](bool asked, const char* key, const char* why, const char* remedy) {
    if (asked)
      out.push_back({key, fmt::format("{} with an unbonded layer is not in this engine: {}", key, why), remedy});
  };
  const TimeStepMethod method = spec.run.time_step_method;
  refuse(!spec.run.rolling, "run.rolling", "a wheel at rest stands beside the stretch, and does not feel it",
         "give run.rolling = true, or take unbonded out");
  refuse(method != TimeStepMethod::automatic && method != TimeStepMethod::uniform, "run.time_step_method",
         "the two sides of the interface meet with the masses that they have, once a step",
         "give time_step_method = \"uniform\"");
}

/// Layers that begin and end, and stretches: what is written while the wheel passes their ends, and what knows bodies
/// that are the same all along only.
void refuse_changes_along(const CaseSpec& spec, std::vector<BeyondEngine>& out) {
  const bool ends = std::any_of(spec.layers.begin(), spec.layers.end(), [](const LayerSpec& l) { return l.ends(); });
  const bool unbonded = any_unbonded(spec);
  if (!ends && !unbonded && spec.stretches.empty()) return;
  const char* const changes = ends ? "a layer that ends" : unbonded ? "an unbonded layer" : "a [[stretch]]";
  const auto refuse = [&](bool asked, const std::string& key, const char* why, const char* remedy) {
    if (asked) out.push_back({key, fmt::format("{} with {} is not in this engine: {}", key, changes, why), remedy});
  };
  refuse(spec.geometry.rail_radius.has_value(), "geometry.rail_radius", "a roller is the same all round",
         "take from, to and unbonded of layers and [[stretch]] out");
  refuse(spec.run.device != ComputeDevice::cpu, "run.device",
         "a device has one material for a row of elements, and layers that hold", "give run.device = \"cpu\"");
  refuse(spec.run.rolling && spec.run.window > 0, "run.window",
         "the mean over a stretch of the way is no state of a rail that varies along it", kNoWindow);
  const auto refuse_stress = [&](const std::string& table, const MaterialSpec& material) {
    const StrengthSpec& s = material.strength;
    const bool given = !s.initial_stress.empty() || !s.initial_stress_table.empty();
    refuse(ends && spec.run.plasticity && given, table + ".initial_stress",
           "stress from the start is the same all along", "take it out");
  };
  for (std::size_t i = 0; i < spec.layers.size(); ++i)
    refuse_stress(fmt::format("layer.{}", i), spec.layers[i].material);
  refuse_stress("material.rail", spec.rail_material);
  refuse_stress("material.wheel", spec.wheel_material);
}

}  // namespace

std::vector<BeyondEngine> beyond_finite_elements(const CaseSpec& spec) {
  std::vector<BeyondEngine> out;
  const auto beyond = [&](bool asked, const char* key, const char* what, const char* why) {
    if (asked)
      out.push_back({key, fmt::format("{} ({}) is not in this engine: in the finite elements {}", what, key, why),
                     kWithHalfSpaces});
  };
  const std::string largest = fmt::format("it reaches to {:g}", kLargestRunCreepage);
  const GeometrySpec& g = spec.geometry;
  const DriveSpec& d = spec.drive;
  beyond(spec.vehicle.approach.has_value(), "vehicle.approach", "a given approach",
         "masses press the wheel down, and the approach follows");
  beyond(spec.transient.kind != TransientKind::none, "transient.kind", "a history of loads and motions",
         "one drive leads to the wanted positions, with inertia");
  beyond(g.in_line(), "geometry.contact", "a line contact", "bodies have ends across, and patches too");
  refuse_on_ring(spec, out);
  refuse_irregularities(spec, out);
  refuse_changes_along(spec, out);
  refuse_unbonded(spec, out);
  beyond(g.roll != 0, "geometry.roll", "a roll of the wheelset", "the wheel is meshed upright");
  if (!spec.run.rolling) return out;
  if (spec.friction.law != FrictionForm::coulomb && !(spec.friction.memory_distance > 0))
    out.push_back({"friction.law",
                   "friction that falls with slip (friction.law) is not in this engine without a memory: surfaces of "
                   "finite elements chatter on a law that follows slip at once",
                   "give friction.memory_distance, 10 to 50 um for a wheel on a rail, or solve the case with "
                   "`railstrata bem`"});
  const ThirdBodySpec& film = spec.third_body;
  beyond(film.hardening < 0, "third_body.hardening", "a film that softens",
         "a step would have several answers, and the film shears in one place");
  const char* const no_heat = "the flow of heat into the bodies is not computed";
  beyond(!spec.friction.temperature_table.empty(), "friction.temperature_table", "friction by temperature", no_heat);
  beyond(!film.temperature_table.empty(), "third_body.temperature_table", "a film that softens with heat", no_heat);
  beyond(film.yield_by_pressure != 0, "third_body.yield_by_pressure", "a film whose strength depends on pressure",
         "each node has one film for its whole way");
  beyond(film.modulus_by_pressure != 0, "third_body.modulus_by_pressure", "a film whose stiffness depends on pressure",
         "each node has one film for its whole way");
  beyond(g.curve_radius.has_value(), "geometry.curve_radius", "a curve", "the track is straight");
  beyond(std::abs(d.creepage.value_or(0)) > kLargestRunCreepage, "drive.creepage", "so large a creepage",
         largest.c_str());
  beyond(std::abs(d.lateral_creepage.value_or(0)) > kLargestRunCreepage, "drive.lateral_creepage",
         "so large a lateral creepage", ("the wheel moves sideways on its way, and " + largest).c_str());
  beyond(d.spin.has_value(), "drive.spin", "a given spin", "it follows from the geometry");
  return out;
}

void require_shareable(const CaseSpec& spec) {
  const auto refuse = [&](bool asked, const char* what, const char* key, const char* why) {
    if (asked)
      throw CaseError(fmt::format("{} ({}) is not shared by ranks: {}", what, key, why), "run the case in one process",
                      key);
  };
  refuse(spec.geometry.rail_radius.has_value(), "a rail that is a ring", "geometry.rail_radius",
         "they exchange what stands around a wheel that travels along a straight rail");
  for (std::size_t i = 0; i < spec.layers.size(); ++i)
    refuse(!spec.layers[i].unbonded.empty(), "an unbonded layer", fmt::format("layer.{}.unbonded", i).c_str(),
           "its two sides meet in one process");
}

void require_half_spaces(const CaseSpec& spec) {
  if (!spec.track.held())
    throw CaseError("half-spaces have no inertia, and no track below them",
                    "take [track] out, or roll over it with `railstrata run`", "track.preset");
  for (std::size_t i = 0; i < spec.layers.size(); ++i) {
    const LayerSpec& layer = spec.layers[i];
    if (!layer.unbonded.empty())
      throw CaseError(
          fmt::format("layer \"{}\" has come off in a stretch; the layers of half-spaces are bonded", layer.name),
          "take its unbonded out, or roll over it with `railstrata run`", fmt::format("layer.{}.unbonded", i));
    if (layer.ends())
      throw CaseError(fmt::format("layer \"{}\" ends along the {}; the layers of half-spaces are endless", layer.name,
                                  body_word(layer.on)),
                      "take its from and to out, or roll over its ends with `railstrata run`",
                      fmt::format("layer.{}.{}", i, layer.from ? "from" : "to"));
  }
  if (!spec.stretches.empty())
    throw CaseError("half-spaces are the same all along, and the case has a [[stretch]]",
                    "take it out, or roll over it with `railstrata run`", "stretch");
}

void require_finite_elements(const CaseSpec& spec) {
  std::vector<Diagnostic> all;
  for (BeyondEngine& b : beyond_finite_elements(spec)) all.push_back({"", std::move(b.message), std::move(b.remedy)});
  if (!all.empty()) throw CaseError(std::move(all));
}

}  // namespace railstrata
