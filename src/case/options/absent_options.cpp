#include "options/absent_options.hpp"

#include <algorithm>
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
                           kTrack = "gauge, cant and lateral_shift are keys of [geometry]";

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
};

constexpr std::string_view
    kContact = "take it out: contact is enforced without penetration",
    kHot = "take it out: elements follow their law wherever they come near yielding, with the same results";

constexpr std::array kRetired{
    RetiredKey{"contact", "method", "\"mortar\"", kContact},
    RetiredKey{"contact", "penalty_scale", "0.1", kContact},
    RetiredKey{"geometry", "inclination", "", "write geometry.cant"},
    RetiredKey{"layer", "grading_tolerance", "0.05", "take it out: the modulus is cut as finely as results can show"},
    RetiredKey{"vehicle", "gravity", "\"9.81 m/s^2\"", "take it out, and give loads as forces"},
    RetiredKey{"vehicle", "suspension_groups", "8", "take it out: groups of springs move alike"},
    RetiredKey{"mesh", "hourglass_coefficient", "0.05", "take it out, or give mesh.element = \"full\""},
    RetiredKey{"mesh", "elements_through_layer_one", "false", "give elements = 1 in every [[layer]]"},
    RetiredKey{"run", "time_step_method", "\"auto\"",
               "take it out: masses of thin layers are scaled where the step gains by it; use run.mass_scaling_step = "
               "0 for real masses"},
    RetiredKey{"run", "plastic_depth", "", kHot},
    RetiredKey{"run", "plastic_width", "", kHot},
    RetiredKey{"life", "passes", "0",
               "write life.until = \"50 Mt\": the rail is followed through its traffic instead of some first passes"},
    RetiredKey{"passes", "window_tolerance", "0.001", "take it out, or give a longer passes.window"},
};

}  // namespace

std::string_view answer_for_absent(std::string_view name) {
  for (const Absent& a : kAbsent)
    if (a.name == name) return a.answer;
  return {};
}

const RetiredKey* retired_key(std::string_view table, std::string_view key) {
  const auto found = std::find_if(kRetired.begin(), kRetired.end(),
                                  [&](const RetiredKey& r) { return r.table == table && r.key == key; });
  return found == kRetired.end() ? nullptr : &*found;
}

}  // namespace railstrata
