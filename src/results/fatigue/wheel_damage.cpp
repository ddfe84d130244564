#include "fatigue/wheel_damage.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

template <class Damage>
void finish(const CollectiveSpec& collective, Damage& damage) {
  for (auto* depth : {&damage.usfd, &damage.archard, &damage.kth})
    for (double& d : *depth) d *= collective.wear_factor;
  spread_aside(damage, collective.lateral_deviation);
}

}  // namespace

WheelDamage unworn_wheel(const Profile& wheel, double cell) {
  WheelDamage out{unworn(wheel, cell), {}};
  out.share.assign(out.s.size(), 0.0);
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

RailDamage rail_damage(const CaseSpec& spec, std::span<const WheelKind> kinds, const Placement& placement,
                       double cell) {
  RailDamage out = undamaged(placement.rail, cell);
  for (const WheelKind& kind : kinds)
    for (const PatchDamage& patch : kind.patches)
      add_passages(out, placement.rail, placement.track, patch, kind.passages);
  finish(spec.collective, out);
  return out;
}

WheelDamage wheel_damage(const CaseSpec& spec, std::span<const WheelKind> kinds, const Placement& placement,
                         double cell) {
  WheelDamage out = unworn_wheel(placement.wheel, cell);
  double all = 0;
  for (const WheelKind& kind : kinds) all += kind.passages;
  for (const WheelKind& kind : kinds)
    for (const PatchDamage& patch : kind.patches) add_distance(out, patch, kind.passages / all);
  finish(spec.collective, out);
  return out;
}

}  // namespace railstrata
