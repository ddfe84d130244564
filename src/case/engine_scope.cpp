#include "case/engine_scope.hpp"

#include <fmt/format.h>

#include "core/faults.hpp"

namespace railstrata {
namespace {

constexpr const char* kWithHalfSpaces = "take it out, or solve the case with `railstrata bem`";

}  // namespace

std::vector<BeyondEngine> beyond_finite_elements(const CaseSpec& spec) {
  std::vector<BeyondEngine> out;
  const auto beyond = [&](bool asked, const char* key, const char* what, const char* why) {
    if (asked)
      out.push_back({key, fmt::format("{} ({}) is not in this engine: in the finite elements {}", what, key, why),
                     kWithHalfSpaces});
  };
  const GeometrySpec& g = spec.geometry;
  const DriveSpec& d = spec.drive;
  beyond(g.yaw != 0, "geometry.yaw", "yaw", "the wheel runs straight along the rail");
  if (!spec.run.rolling) return out;
  beyond(spec.friction.law != FrictionForm::coulomb, "friction.law", "friction that falls with slip",
         "surfaces chatter on a law without memory that falls faster than waves carry away");
  beyond(spec.third_body.thickness.has_value(), "third_body.thickness", "a third-body layer",
         "surfaces touch without a film between them");
  beyond(g.curve_radius.has_value(), "geometry.curve_radius", "a curve", "the track is straight");
  beyond(d.creepage.has_value(), "drive.creepage", "a given creepage",
         "a torque drives the wheel, and the creepage follows");
  beyond(d.lateral_traction_coefficient.has_value(), "drive.lateral_traction_coefficient", "a given lateral force",
         "the axle is guided and takes the lateral force that comes");
  beyond(d.lateral_creepage.has_value(), "drive.lateral_creepage", "lateral creepage",
         "the axle does not move sideways");
  beyond(d.spin.has_value(), "drive.spin", "a given spin", "it follows from the geometry");
  return out;
}

void require_finite_elements(const CaseSpec& spec) {
  std::vector<Diagnostic> all;
  for (BeyondEngine& b : beyond_finite_elements(spec)) all.push_back({"", std::move(b.message), std::move(b.remedy)});
  if (!all.empty()) throw CaseError(std::move(all));
}

}  // namespace railstrata
