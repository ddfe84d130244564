#include "model/rolling_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "spec/case_spec.hpp"

namespace railstrata {

std::string varying_key(const CaseSpec& spec) {
  if (!spec.irregularities.empty()) return "irregularity";
  const auto changes =
      std::find_if(spec.layers.begin(), spec.layers.end(), [](const LayerSpec& l) { return l.changes_along(); });
  if (changes != spec.layers.end()) return fmt::format("layer.{}", changes - spec.layers.begin());
  return spec.stretches.empty() ? "" : "stretch";
}

bool changes_on_way(const CaseSpec& spec) {
  return spec.run.rolling && !(varying_key(spec).empty() && spec.track.held());
}

std::string why_from_rest(const CaseSpec& spec) {
  constexpr double kNearlyAllFriction = 0.98, kLongEnd = 0.1;  // m; docs/finite-elements-verification.md
  const DriveSpec& drive = spec.drive;
  const double f = drive.friction_coefficient, across = spec.friction.lateral_coefficient.value_or(f);
  if (!spec.run.rolling) return "the wheel does not roll";
  if (spec.run.start == RunStart::rest) return "run.start = \"rest\"";
  if (!(f > 0) || !(across > 0)) return "there is no friction";
  if (spec.run.plasticity) return "materials yield";
  if (changes_on_way(spec)) return "rail or wheel change along the way";
  if (spec.friction.law != FrictionForm::coulomb) return "friction falls with slip";
  if (spec.third_body.yield_shear || spec.third_body.modulus_by_pressure > 0) return "the third body is not elastic";
  if (drive.torque_ramp != DriveSpec{}.torque_ramp) return "the case gives drive.torque_ramp";
  if (drive.creepage_start != 0) return "the case gives drive.creepage_start";
  if (!spec.geometry.rail_radius && spec.mesh.end_length < kLongEnd)
    return "the rail ends near the wheel (mesh.end_length below 100 mm)";
  if (std::hypot(drive.traction().value_or(0) / f, drive.lateral_traction_coefficient.value_or(0) / across) >
      kNearlyAllFriction)
    return "the wheel slides all over the patch";
  return {};
}

double run_up_of(const CaseSpec& spec, double patch_length) {
  constexpr double kFromRest = 0.12;
  return spec.run.run_up.value_or(why_from_rest(spec).empty() ? 2 * patch_length : kFromRest);
}

double end_of_way(const CaseSpec& spec) {
  const TransientSpec& t = spec.transient;
  if (t.kind == TransientKind::rolling) {
    if (t.distance) return *t.distance;
    if (!t.at_distance.empty()) return t.at_distance.back();
    if (!t.at_time.empty()) return t.at_time.back() * spec.drive.speed;
  } else if (const std::vector<double>& positions = spec.run.positions; !positions.empty()) {
    return *std::max_element(positions.begin(), positions.end());
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace railstrata
