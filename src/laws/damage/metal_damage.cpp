#include "damage/metal_damage.hpp"

#include <algorithm>
#include <utility>

namespace railstrata {

DepthRate::DepthRate(std::vector<double> depth, std::vector<double> rate, bool ends)
    : depth_(std::move(depth)),
      rate_(std::move(rate)),
      ends_(ends),
      none_(std::all_of(rate_.begin(), rate_.end(), [](double r) { return r == 0; })) {
  double sum = rate_.empty() ? 0 : rate_.front() * depth_.front();
  for (std::size_t j = 0; j < rate_.size(); ++j) {
    if (j > 0) sum += 0.5 * (rate_[j] + rate_[j - 1]) * (depth_[j] - depth_[j - 1]);
    sum_.push_back(sum);
  }
}

double DepthRate::at(double z) const {
  if (none_ || z < 0) return 0;
  if (z <= depth_.front()) return rate_.front();
  if (z > depth_.back()) return ends_ ? 0 : rate_.back();
  const auto j = static_cast<std::size_t>(std::lower_bound(depth_.begin(), depth_.end(), z) - depth_.begin());
  const double share = (z - depth_[j - 1]) / (depth_[j] - depth_[j - 1]);
  return (1 - share) * rate_[j - 1] + share * rate_[j];
}

double DepthRate::until(double z) const {
  if (none_ || z <= 0) return 0;
  if (z <= depth_.front()) return z * rate_.front();
  if (z > depth_.back()) return sum_.back() + (ends_ ? 0 : (z - depth_.back()) * rate_.back());
  const auto j = static_cast<std::size_t>(std::lower_bound(depth_.begin(), depth_.end(), z) - depth_.begin());
  return sum_[j - 1] + 0.5 * (rate_[j - 1] + at(z)) * (z - depth_[j - 1]);
}

std::optional<DamageReached> gather(const DepthRate& rate, const SinkingStep& step, double z, double& damage) {
  if (rate.none() || z <= step.before || !(step.traffic > 0)) return {};
  const double was = damage, sunk = step.after - step.before, from = z - step.before;
  const double gone = std::min(step.after, z) - step.before, there = sunk > 0 ? gone / sunk : 1;
  damage +=
      sunk > 0 ? step.traffic / sunk * (rate.until(from) - rate.until(from - gone)) : step.traffic * rate.at(from);
  if (was >= 1 || damage < 1) return {};
  const double share = there * (1 - was) / (damage - was);
  return DamageReached{share, from - share * sunk};
}

}  // namespace railstrata
