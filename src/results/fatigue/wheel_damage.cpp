#include "fatigue/wheel_damage.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

namespace railstrata {

const std::vector<double>& WheelDamage::depth(WearLaw law) const {
  return law == WearLaw::usfd ? usfd : law == WearLaw::kth ? kth : archard;
}

WheelDamage unworn_wheel(const Profile& wheel, double cell) {
  const RailDamage cells = undamaged(wheel, cell);
  WheelDamage out{cells.cell, cells.s, cells.y, cells.z, {}, {}, {}, {}};
  for (auto* a : {&out.share, &out.usfd, &out.archard, &out.kth}) a->assign(out.s.size(), 0.0);
  return out;
}

void add_distance(WheelDamage& damage, const PatchDamage& patch, double share) {
  const RigidContact& c = patch.contact;
  const Vec2 tangent{std::cos(c.angle), std::sin(c.angle)};
  for (const StreamlineRow& row : patch.rows) {
    const Vec2 from_contact = Vec2{row.y, row.z} - c.point;
    const double middle = c.wheel_s + dot(from_contact, tangent);
    const double turn = 2 * std::numbers::pi * (c.rolling_radius - from_contact.z);
    for_cells(damage, {middle - 0.5 * row.width, middle + 0.5 * row.width}, [&](std::size_t i, double length) {
      const double part = share * length / damage.cell;
      damage.share[i] += part;
      damage.usfd[i] += part * row.wheel_usfd_depth / turn;
      damage.archard[i] += part * row.wheel_archard_depth / turn;
      damage.kth[i] += part * row.wheel_kth_depth / turn;
    });
  }
}

void spread_aside(WheelDamage& d, double deviation) {
  if (!(deviation > 0)) return;
  for (auto* a : {&d.share, &d.usfd, &d.archard, &d.kth}) spread_aside(*a, d.cell, deviation);
}

double worn_area(const WheelDamage& damage, const std::vector<double>& depth) {
  return damage.cell * std::accumulate(depth.begin(), depth.end(), 0.0);
}

}  // namespace railstrata
