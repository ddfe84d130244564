#include "fatigue/traffic_damage.hpp"

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
