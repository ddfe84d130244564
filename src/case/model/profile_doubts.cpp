#include "model/profile_doubts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "geometry/profile_scatter.hpp"
#include "geometry/profile_signs.hpp"

namespace railstrata {
namespace {

constexpr double kUpright = 1.0 / 500;
constexpr double kBackTolerance = 0.3e-3;  // m

std::string too_far_apart(const Profile& p, const std::string& file) {
  const ListedPoints& listed = *p.listed();
  return fmt::format(
      "{}: {} points, {:.1f} mm apart in the middle, do not give the curvature of a running surface; give one every "
      "0.1 to 1 mm",
      file, listed.points.size(), 1e3 * listed.scatter.spacing);
}

std::string inclined_already(const GeometrySpec& g, double slope) {
  return fmt::format(
      "{}: the running surface at the head's middle is inclined {}, as that of a rail listed in the track's frame; "
      "geometry.cant inclines it once more: if it is such a list, set cant = 0{}",
      g.rail_profile, inclination_text(slope),
      slope < 0 ? fmt::format(" and rail_mirror = {}: the list has its gauge side at the other end", !g.rail_mirror)
                : "");
}

}  // namespace

std::string inclination_text(double slope) {
  if (std::abs(slope) < kUpright) return "upright";
  return fmt::format("1:{:.0f}, {} side down", 1 / std::abs(slope), slope > 0 ? "gauge" : "field");
}

std::vector<std::string> profile_doubts(const GeometrySpec& g, const Profile& wheel, const Profile& rail) {
  std::vector<std::string> out;
  const auto from_file = [](const Profile& p, const std::string& name) {
    return p.listed() && std::filesystem::path(name).has_extension();
  };
  if (from_file(rail, g.rail_profile)) {
    if (rail.listed()->scatter.spacing > kFarApart) out.push_back(too_far_apart(rail, g.rail_profile));
    if (const double slope = head_inclination(rail).value_or(0); g.cant != 0 && looks_laid(slope))
      out.push_back(inclined_already(g, slope));
  }
  if (from_file(wheel, g.wheel_profile)) {
    if (wheel.listed()->scatter.spacing > kFarApart) out.push_back(too_far_apart(wheel, g.wheel_profile));
    if (const auto back = flange_back(wheel); back && std::abs(*back - g.flange_back_to_tape) > kBackTolerance)
      out.push_back(fmt::format(
          "{}: its flange back stands {:.2f} mm from the tape circle, geometry.flange_back_to_tape is {:.2f} mm: the "
          "wheel would stand {:.2f} mm aside; set flange_back_to_tape = \"{:.2f} mm\"",
          g.wheel_profile, 1e3 * *back, 1e3 * g.flange_back_to_tape, 1e3 * std::abs(*back - g.flange_back_to_tape),
          1e3 * *back));
  }
  return out;
}

}  // namespace railstrata
