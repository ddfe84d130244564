#include "steady/pass_class.hpp"

#include <algorithm>
#include <cmath>

namespace railstrata {

namespace {

constexpr double kNothing = 1e-6;  // plastic strain of a pass that counts as none
constexpr double kClosed = 0.01;   // net over accumulated of a closed cycle
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

PassVerdict classify(const std::vector<PassStrain>& passes) {
  PassVerdict verdict;
  if (passes.empty()) return verdict;
  const PassStrain& last = passes.back();
  verdict.rate = last.net;
  verdict.trend = trend_of(passes);
  if (last.accumulated < kNothing) {
    verdict.kind = PassClass::elastic_shakedown;
  } else if (last.net < kClosed * last.accumulated && steady(passes, &PassStrain::accumulated)) {
    verdict.kind = PassClass::plastic_shakedown;
  } else if (last.net >= kClosed * last.accumulated && steady(passes, &PassStrain::net)) {
    verdict.kind = PassClass::ratchetting;
  }
  return verdict;
}

std::string words(PassClass kind) {
  switch (kind) {
    case PassClass::elastic_shakedown:
      return "elastic shakedown";
    case PassClass::plastic_shakedown:
      return "plastic shakedown";
    case PassClass::ratchetting:
      return "ratchetting";
    case PassClass::transient:
      break;
  }
  return "transient: no claim yet";
}

}  // namespace railstrata
