#include "app/axle_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/faults.hpp"
#include "geometry/wheelset.hpp"

namespace railstrata {
namespace {

AxleWheel wheel_of(const RigidContact& contact, double mean_radius, double half_distance, double curvature) {
  return {contact, 1 - half_distance * curvature - contact.rolling_radius / mean_radius, yaw_creepage(contact),
          wheel_spin(contact) + std::cos(contact.angle) * curvature};
}

std::optional<AxleOnTrack> axle_if_any(const CaseSpec& spec, const Placement& placement) {
  if (placement.wheel.primitive() || placement.rail.primitive() || std::isfinite(placement.track.rail_radius))
    return std::nullopt;
  try {
    return axle_of(spec, placement);
  } catch (const CaseError&) {
    return std::nullopt;
  }
}

std::string line_of(const char* name, const char* wheel, const AxleWheel& w) {
  return fmt::format(
      "{:<14} {}: rolling radius {:.3f} mm, contact angle {:.2f} mrad, creepages {:.3e} and {:.3e}, spin {:.4f} 1/m\n",
      name, wheel, 1e3 * w.contact.rolling_radius, 1e3 * w.contact.angle, w.creepage_x, w.creepage_y, w.spin);
}

nlohmann::ordered_json json_of(const AxleWheel& w) {
  return {{"rolling_radius_m", w.contact.rolling_radius},
          {"angle_rad", w.contact.angle},
          {"creepage_x", w.creepage_x},
          {"creepage_y", w.creepage_y},
          {"spin_per_m", w.spin}};
}

}  // namespace

AxleOnTrack axle_of(const CaseSpec& spec, const Placement& placement) {
  TrackGeometry beside = placement.track;
  for (double TrackGeometry::*odd : {&TrackGeometry::lateral_shift, &TrackGeometry::yaw, &TrackGeometry::roll})
    beside.*odd = -(beside.*odd);
  const RigidContact other = place_wheel(placement.wheel, placement.rail, beside);
  const double here = placement.contact.rolling_radius, mean = 0.5 * (here + other.rolling_radius),
               curvature = spec.geometry.curve_radius ? 1 / *spec.geometry.curve_radius : 0.0,
               half = tape_circle_distance(placement.track);
  return {wheel_of(placement.contact, mean, half, curvature), wheel_of(other, mean, half, -curvature),
          other.rolling_radius - here, 2 * half * mean * curvature};
}

std::string axle_text(const CaseSpec& spec, const Placement& placement) {
  const std::optional<AxleOnTrack> axle = axle_if_any(spec, placement);
  if (!axle) return {};
  return line_of("axle", "this wheel", axle->here) + line_of("", "the other ", axle->other) +
         fmt::format("{:<14} rolling radius of the other less this one {:.3f} mm; the curve asks for {:.3f} mm\n", "",
                     1e3 * axle->radius_difference, 1e3 * axle->wanted_difference);
}

nlohmann::ordered_json axle_json(const CaseSpec& spec, const Placement& placement) {
  const std::optional<AxleOnTrack> axle = axle_if_any(spec, placement);
  if (!axle) return nullptr;
  return {{"this_wheel", json_of(axle->here)},
          {"other_wheel", json_of(axle->other)},
          {"radius_difference_m", axle->radius_difference},
          {"wanted_difference_m", axle->wanted_difference}};
}

}  // namespace railstrata
