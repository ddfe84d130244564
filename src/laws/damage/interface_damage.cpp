#include "damage/interface_damage.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace railstrata {
namespace {

/// Smallest and largest value over the cycle.
struct Range {
  double low = HUGE_VAL, high = -HUGE_VAL;
  void take(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double size() const { return high - low; }
};

Interface interface_at(const StressHistory& history, ResidualRows residual, int above, const BondStrength* bond) {
  Interface out{.row_above = above, .depth = history.depth[above]};
  const Sym3 rest[2] = {residual_of(residual, above), residual_of(residual, above + 1)};
  for (int column = 0; column < history.columns(); ++column) {
    Range shear_x, xx[2];
    for (int i = 0; i < history.samples(); ++i) {
      const Sym3 s[2] = {history.cycle(above, column)[i] + rest[0], history.cycle(above + 1, column)[i] + rest[1]};
      const Sym3 mean = 0.5 * (s[0] + s[1]);
      const double tension = std::max(mean.zz, 0.0), shear = std::hypot(mean.xz, mean.yz);
      out.tension = std::max(out.tension, tension);
      out.shear = std::max(out.shear, shear);
      shear_x.take(mean.xz);
      for (int side = 0; side < 2; ++side) xx[side].take(s[side].xx);
      if (!bond) continue;
      const double n = tension / bond->normal, t = shear / bond->shear;
      out.delamination = std::max(out.delamination, n * n + t * t);
    }
    if (column > 0 && !(shear_x.size() > out.shear_range)) continue;
    out.shear_range = shear_x.size();
    for (int side = 0; side < 2; ++side) out.xx_range[side] = xx[side].size();
  }
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
