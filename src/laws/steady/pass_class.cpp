#include "steady/pass_class.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "material/strain_claim.hpp"

namespace railstrata {

namespace {

constexpr double kSame = 0.02;     // from pass to pass
constexpr std::size_t kSteps = 3;  // from pass to pass

/// Whether the last steps of a number change it by less than kSame of itself.
bool steady(const std::vector<PassStrain>& passes, double PassStrain::*number) {
  if (passes.size() <= kSteps) return false;
  for (std::size_t n = passes.size() - kSteps; n < passes.size(); ++n) {
    const double is = passes[n].*number, was = passes[n - 1].*number;
    if (std::abs(is - was) > kSame * std::max(is, was)) return false;
  }
  return true;
}

/// Least squares of log net over log n.
double trend_of(const std::vector<PassStrain>& passes) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = passes.size() / 2; i < passes.size(); ++i) {
    if (!(passes[i].net > 0)) continue;
    const double x = std::log(static_cast<double>(i + 1)), y = std::log(passes[i].net);
    n += 1;
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const double spread = n * sxx - sx * sx;
  return n < 3 || spread <= 0 ? 0 : -(n * sxy - sx * sy) / spread;
}

}  // namespace

double net_strain(const double* before, const double* after) {
  double change[6];
  for (int c = 0; c < 6; ++c) change[c] = after[c] - before[c];
  return equivalent_strain(change);
}

PassVerdict classify(const std::vector<PassStrain>& passes) {
  PassVerdict verdict;
  if (passes.empty()) return verdict;
  const PassStrain& last = passes.back();
  verdict.rate = last.net;
  verdict.trend = trend_of(passes);
  if (last.accumulated < kNoFlow) {
    verdict.kind = PassClass::elastic_shakedown;
  } else if (last.net < kClosed * last.accumulated && steady(passes, &PassStrain::accumulated)) {
    verdict.kind = PassClass::plastic_shakedown;
  } else if (last.net >= kClosed * last.accumulated && steady(passes, &PassStrain::net) &&
             verdict.trend <= kConstantTrend) {
    verdict.kind = PassClass::ratchetting;
  }
  return verdict;
}

PassClass class_of_point(const std::vector<PassStrain>& passes, PassClass whole) {
  const PassClass own = classify(passes).kind;
  return whole == PassClass::transient && own != PassClass::elastic_shakedown ? PassClass::transient : own;
}

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Passes until net = rate (n / last)^-s has added up to `more`.
double passes_by_trend(double more, double rate, double last, double s) {
  if (!(rate > 0)) return kNever;
  const double share = more / (rate * last);
  if (std::abs(s - 1) < 1e-9) return last * std::exp(share);
  const double base = 1 + share * (1 - s);
  return base > 0 ? last * std::pow(base, 1 / (1 - s)) : kNever;
}

}  // namespace

DuctilityReach passes_to_ductility(double ductility, double reached, const std::vector<PassStrain>& passes) {
  const PassVerdict verdict = classify(passes);
  if (passes.empty() || verdict.kind == PassClass::elastic_shakedown || verdict.kind == PassClass::plastic_shakedown)
    return {kNever, kNever, kNever};
  const double last = static_cast<double>(passes.size()), more = ductility - reached;
  if (more <= 0) return {last, 0, last};
  DuctilityReach out{passes_by_trend(more, verdict.rate, last, 0), kNever, 0};
  const double by_trend = passes_by_trend(more, verdict.rate, last, verdict.trend);
  out.earliest = std::min(out.passes, by_trend);
  out.latest = std::max(out.passes, by_trend);
  for (std::size_t i = passes.size() / 2; i < passes.size(); ++i) {
    const double at_rate = passes_by_trend(more, passes[i].net, last, 0);
    out.earliest = std::min(out.earliest, at_rate);
    out.latest = std::max(out.latest, at_rate);
  }
  return out;
}

std::string class_text(PassClass kind) {
  constexpr const char* kTexts[]{"elastic shakedown", "plastic shakedown", "ratchetting", "transient: no claim yet"};
  return kTexts[static_cast<int>(kind)];
}

}  // namespace railstrata
