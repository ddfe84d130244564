#include "options/absent_options.hpp"

#include <array>

namespace railstrata {
namespace {

struct Absent {
  std::string_view name, answer;
};

constexpr std::string_view
    kLoad =
        "set vehicle.wheel_load or vehicle.axle_load, or the masses of [vehicle]; `railstrata check` shows the load",
    kCreepage =
        "set drive.creepage, drive.lateral_creepage or drive.spin; `railstrata creep` computes traction against "
        "creepage",
    kYaw = "geometry.yaw is the angle of attack", kCurve = "geometry.curve_radius is the radius of the track's curve",
    kRoll = "geometry.roll is the roll of the wheelset";

constexpr std::string_view kElastic =
                               "contact is computed with linear elastic materials; yield_strength, hardening, "
                               "initial_stress and the like are keys of [material.rail], [material.wheel] and "
                               "[[layer]]",
                           kTrack = "gauge, cant and lateral_shift are keys of [geometry]",
                           kStepMethod =
                               "this key is gone: masses of thin layers are scaled where the step gains by it; use "
                               "run.mass_scaling_step = 0 for real masses",
                           kContact =
                               "this table is gone: contact is enforced without penetration; take method and "
                               "penalty_scale out";

constexpr std::array kAbsent{
    Absent{"load", kLoad},
    Absent{"axle_load", kLoad},
    Absent{"wheel_load", kLoad},
    Absent{"normal_force", kLoad},
    Absent{"creepage", kCreepage},
    Absent{"longitudinal_creepage", kCreepage},
    Absent{"lateral_creepage", kCreepage},
    Absent{"spin", kCreepage},
    Absent{"slip", kCreepage},
    Absent{"curve_radius", kCurve},
    Absent{"curvature", kCurve},
    Absent{"yaw", kYaw},
    Absent{"yaw_angle", kYaw},
    Absent{"angle_of_attack", kYaw},
    Absent{"roll", kRoll},
    Absent{"roll_angle", kRoll},
    Absent{"yield_stress", kElastic},
    Absent{"yield_strength", kElastic},
    Absent{"hardening", kElastic},
    Absent{"residual_stress", kElastic},
    Absent{"gauge", kTrack},
    Absent{"cant", kTrack},
    Absent{"time_step_method", kStepMethod},
    Absent{"contact", kContact},
};

}  // namespace

std::string_view answer_for_absent(std::string_view name) {
  for (const Absent& a : kAbsent)
    if (a.name == name) return a.answer;
  return {};
}

}  // namespace railstrata
