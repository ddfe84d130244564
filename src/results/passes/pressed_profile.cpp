#include "passes/pressed_profile.hpp"

#include <cmath>
#include <cstddef>

namespace railstrata {
namespace {

double sinking_at(const SteadyGrid& grid, const PassResult& last, double y) {
  const double place = (y - grid.y0) / grid.dy;
  if (!(place >= 0 && place < grid.ny - 1)) return 0;
  const auto left = static_cast<std::size_t>(place);
  const double right = place - static_cast<double>(left);
  return (1 - right) * last.sinking[left] + right * last.sinking[left + 1];
}

}  // namespace

std::vector<Vec2> pressed_profile(const Placement& placement, const SteadyGrid& grid, const PassResult& last) {
  constexpr double kStep = 0.25e-3;  // m
  const Profile& rail = placement.rail;
  const double length = rail.s_max() - rail.s_min();
  const int steps = static_cast<int>(std::ceil(length / kStep));
  std::vector<Vec2> out;
  for (int i = 0; i <= steps; ++i) {
    const double s = rail.s_min() + length * i / steps;
    const ProfilePoint at = rail.at(s);
    out.push_back(at.position - sinking_at(grid, last, s - placement.contact.rail_s) * at.outward);
  }
  return out;
}

}  // namespace railstrata
