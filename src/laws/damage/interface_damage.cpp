#include "damage/interface_damage.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace railstrata {
namespace {

void extend(StressRange& range, double value, bool first) {
  range.low = first ? value : std::min(range.low, value);
  range.high = first ? value : std::max(range.high, value);
}

InterfacePoint point_of(const StressHistory& history, ResidualRows residual, int above, int column,
                        const BondStrength* bond) {
  InterfacePoint point;
  const Sym3 rest[2] = {residual_of(residual, above), residual_of(residual, above + 1)};
  for (int i = 0; i < history.samples(); ++i) {
    const Sym3 s[2] = {history.cycle(above, column)[i] + rest[0], history.cycle(above + 1, column)[i] + rest[1]};
    const Sym3 mean = 0.5 * (s[0] + s[1]), jump = s[0] - s[1];
    const double tension = std::max(mean.zz, 0.0), shear = std::hypot(mean.xz, mean.yz);
    point.tension = std::max(point.tension, tension);
    point.shear = std::max(point.shear, shear);
    point.traction_jump = std::max(point.traction_jump, norm(Vec3{jump.xz, jump.yz, jump.zz}));
    extend(point.shear_x, mean.xz, i == 0);
    for (int side = 0; side < 2; ++side) {
      extend(point.xx[side], s[side].xx, i == 0);
      extend(point.yy[side], s[side].yy, i == 0);
    }
    if (!bond) continue;
    const double n = tension / bond->normal, t = shear / bond->shear;
    point.delamination = std::max(point.delamination, n * n + t * t);
  }
  return point;
}

template <class Measure>
int column_of_largest(const std::vector<InterfacePoint>& points, Measure measure) {
  return static_cast<int>(
      std::max_element(points.begin(), points.end(),
                       [&](const InterfacePoint& a, const InterfacePoint& b) { return measure(a) < measure(b); }) -
      points.begin());
}

Interface interface_at(const StressHistory& history, ResidualRows residual, int above, const BondStrength* bond) {
  Interface out{.row_above = above, .depth = history.depth[above], .point = {}};
  for (int column = 0; column < history.columns(); ++column)
    out.point.push_back(point_of(history, residual, above, column, bond));
  out.most_tension = column_of_largest(out.point, [](const InterfacePoint& p) { return p.tension; });
  out.most_shear = column_of_largest(out.point, [](const InterfacePoint& p) { return p.shear; });
  out.most_range = column_of_largest(out.point, [](const InterfacePoint& p) { return p.shear_x.range(); });
  out.most_delamination = column_of_largest(out.point, [](const InterfacePoint& p) { return p.delamination; });
  return out;
}

}  // namespace

std::vector<Interface> interface_damage(const StressHistory& history, ResidualRows residual,
                                        std::span<const BondStrength> bonds) {
  check_residual(history, residual);
  std::vector<int> above;
  for (int row = 0; row + 1 < history.rows(); ++row)
    if (history.depth[row] == history.depth[row + 1]) above.push_back(row);
  if (!bonds.empty() && bonds.size() != above.size())
    throw std::invalid_argument("strengths of bonds must be given for every interface");
  for (const BondStrength& b : bonds)
    if (!(b.normal > 0 && b.shear > 0)) throw std::invalid_argument("strengths of a bond must be positive");
  std::vector<Interface> out;
  for (std::size_t i = 0; i < above.size(); ++i)
    out.push_back(interface_at(history, residual, above[i], bonds.empty() ? nullptr : &bonds[i]));
  return out;
}

}  // namespace railstrata
