#include "clock/gathered_damage.hpp"

#include <algorithm>
#include <utility>

#include "lives/zone_life.hpp"

namespace railstrata {
namespace {

/// m, points of the metal: fine where wear brings them to the surface.
std::vector<double> points_to(double deepest, const std::vector<double>& feet) {
  constexpr double kFine = 0.02e-3, kFineTo = 3e-3, kGrowth = 0.1;
  std::vector<double> out;
  for (double z = 0; z <= deepest; z += z < kFineTo ? kFine : kFine + kGrowth * (z - kFineTo)) out.push_back(z);
  constexpr double kAside = 1e-9;  // m, the points on both sides of a foot
  for (const double foot : feet) out.insert(out.end(), {foot - kAside, foot + kAside});
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

std::array<double, kDamages> numbers_of(const DamageRates& r) {
  return {r.ductility, r.cycles[0], r.cycles[1], r.cycles[2], r.fatigue[0], r.fatigue[1], r.fatigue[2]};
}

GatheredDamage::GatheredDamage(std::vector<double> s, std::vector<double> feet, double deepest)
    : s_(std::move(s)), depth_(points_to(deepest, feet)) {
  for (const double z : depth_) {
    const auto above = std::upper_bound(feet.begin(), feet.end(), z) - feet.begin();
    zone_.push_back(above < static_cast<std::ptrdiff_t>(feet.size()) ? static_cast<int>(above) + 1 : 0);
  }
  now_.damage.assign(s_.size() * depth_.size() * kDamages, 0.0);
}

void GatheredDamage::gather(std::size_t column, const std::vector<ZoneRates>& rates, const SinkingStep& step,
                            double since) {
  for (const ZoneRates& zone : rates)
    for (std::size_t kind = 0; kind < kDamages; ++kind) {
      std::vector<double> values;
      for (const DamageRates& r : zone.rates) values.push_back(numbers_of(r)[kind]);
      const DepthRate rate(zone.depth, std::move(values), zone.ends);
      if (rate.none()) continue;
      for (std::size_t p = 0; p < depth_.size(); ++p) {
        if (zone_[p] != zone.zone) continue;
        double& damage = now_.damage[(column * depth_.size() + p) * kDamages + kind];
        const std::optional<DamageReached> reached = railstrata::gather(rate, step, depth_[p], damage);
        if (!reached || reached->depth < kShallowest) continue;
        const DamageKey key{zone.zone, reached->depth <= kSkin, kind};
        const FirstFailure failure{since + reached->share * step.traffic, reached->depth, s_[column]};
        const auto [first, fresh] = now_.failures.emplace(key, failure);
        if (!fresh && failure.traffic < first->second.traffic) first->second = failure;
      }
    }
}

WorstPoint GatheredDamage::worst(std::size_t kind, const std::vector<double>& removed) const {
  WorstPoint out;
  for (std::size_t c = 0; c < s_.size(); ++c)
    for (std::size_t p = 0; p < depth_.size(); ++p) {
      if (depth_[p] < removed[c] + kShallowest) continue;
      const double d = damage(c, p, kind);
      if (d > out.damage) out = {d, s_[c], depth_[p]};
    }
  return out;
}

double GatheredDamage::depth_reached(std::size_t kind, const std::vector<double>& removed) const {
  double out = 0;
  for (std::size_t c = 0; c < s_.size(); ++c)
    for (std::size_t p = 0; p < depth_.size(); ++p) {
      if (depth_[p] < removed[c]) continue;
      if (damage(c, p, kind) < 1) break;
      out = std::max(out, depth_[p] - removed[c]);
    }
  return out;
}

}  // namespace railstrata
