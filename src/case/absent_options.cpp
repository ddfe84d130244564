#include "case/absent_options.hpp"

#include <array>

namespace railstrata {
namespace {

struct Absent {
  std::string_view name, answer;
};

constexpr std::string_view
    kLoad =
        "the load is (vehicle.wheel_mass + vehicle.sprung_mass) * vehicle.gravity: set the masses; `railstrata check` "
        "shows it",
    kCreepage =
        "creepage follows from drive.traction_coefficient; drive.creepage_start is the one at "
        "the start, and `railstrata creep-curve` gives traction against creepage",
    kStraight =
        "the track is straight and the wheel runs upright along it; geometry.lateral_shift and "
        "geometry.cant place them",
    kElastic = "all materials are linear elastic; results warn where rail steel would yield",
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
    Absent{"curve_radius", kStraight},
    Absent{"curvature", kStraight},
    Absent{"yaw", kStraight},
    Absent{"yaw_angle", kStraight},
    Absent{"angle_of_attack", kStraight},
    Absent{"roll", kStraight},
    Absent{"yield_stress", kElastic},
    Absent{"yield_strength", kElastic},
    Absent{"hardening", kElastic},
    Absent{"residual_stress", kElastic},
    Absent{"track", kTrack},
};

}  // namespace

std::string_view answer_for_absent(std::string_view name) {
  for (const Absent& a : kAbsent)
    if (a.name == name) return a.answer;
  return {};
}

}  // namespace railstrata
