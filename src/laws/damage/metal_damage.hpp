#pragma once
// Damage at points that are fixed in the metal while wear and grinding bring them nearer to the surface.
//
// A point that lay at Z below the unworn surface lies at z = Z - removed(t) and gathers there the rate of that depth:
//   D(Z) = integral of rate(Z - removed(t)) dt.   [Miner1945]
// In a step the rates are those of one state of the rail, linear between the depths of a table, and the surface goes
// down evenly, so that the integral is that of a line over depth: exact.
#include <optional>
#include <vector>

namespace railstrata {

/// A rate by depth below the surface of the day: linear between nodes; above the first and below the last one their
/// values hold (a layer ends where its points end), or nothing where it `ends` there.
class DepthRate {
 public:
  DepthRate(std::vector<double> depth, std::vector<double> rate, bool ends);
  double at(double z) const;
  /// Its integral from the surface to z.
  double until(double z) const;
  bool none() const { return none_; }

 private:
  std::vector<double> depth_, rate_, sum_;  // sum: until each node
  bool ends_, none_;
};

/// A step in which the surface goes down from `before` to `after` [m, since the unworn one] while so much traffic runs.
struct SinkingStep {
  double traffic = 0, before = 0, after = 0;
};

/// Where a point was when its damage became one.
struct DamageReached {
  double share = 0;  ///< of the step, from 0 to 1
  double depth = 0;  ///< m, below the surface of that time
};

/// Adds to the damage of a point `z` [m] below the unworn surface what a step does to it until it is removed. Nothing
/// where its damage is not yet one, or was one before.
std::optional<DamageReached> gather(const DepthRate& rate, const SinkingStep& step, double z, double& damage);

}  // namespace railstrata
