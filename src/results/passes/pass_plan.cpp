#include "passes/pass_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>

#include "core/counted_random.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

constexpr double kMostDeviations = 3;
constexpr int kScatteredCycle = 10;

/// Standard normal numbers: one for each seed and n. Counters through the finalizer of splitmix64
/// [SteeleLeaFlood2014], Box and Muller's transform [BoxMuller1958].
double normal_number(int seed, int n) {
  const std::uint64_t at = mixed(static_cast<std::uint64_t>(seed)) + 2 * static_cast<std::uint64_t>(n);
  return std::sqrt(-2 * std::log(uniform_number(at))) * std::cos(2 * std::numbers::pi * uniform_number(at + 1));
}

/// The draws of one pass, until one lies within the cut.
double cut_normal_number(int seed, int pass) {
  constexpr int kDraws = 16;  // all beyond three deviations: chance 1e-41
  double v = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    v = normal_number(seed, kDraws * pass + draw);
    if (std::abs(v) <= kMostDeviations) return v;
  }
  return std::clamp(v, -kMostDeviations, kMostDeviations);
}

std::size_t turn(std::size_t count, int pass) { return count == 0 ? 0 : static_cast<std::size_t>(pass - 1) % count; }

}  // namespace

PassPlan pass_plan(const PassesSpec& spec, int pass) {
  PassPlan plan;
  if (!spec.lateral_positions.empty()) plan.lateral = spec.lateral_positions[turn(spec.lateral_positions.size(), pass)];
  if (spec.lateral_deviation) plan.lateral += *spec.lateral_deviation * cut_normal_number(spec.lateral_seed, pass);
  plan.traction = turn(spec.traction_coefficients.size(), pass);
  return plan;
}

int passes_per_cycle(const PassesSpec& spec) {
  const auto length = [](const std::vector<double>& list) { return std::max<std::size_t>(list.size(), 1); };
  const std::size_t lists = std::lcm(length(spec.lateral_positions), length(spec.traction_coefficients));
  return static_cast<int>(spec.lateral_deviation ? std::lcm(lists, std::size_t{kScatteredCycle}) : lists);
}

double farthest_pass(const PassesSpec& spec) {
  double most = 0;
  for (const double y : spec.lateral_positions) most = std::max(most, std::abs(y));
  return most + kMostDeviations * spec.lateral_deviation.value_or(0);
}

std::vector<CaseSpec> cases_of_tractions(const CaseSpec& spec) {
  if (spec.passes.traction_coefficients.empty()) return {spec};
  std::vector<CaseSpec> out;
  for (const double traction : spec.passes.traction_coefficients) {
    out.push_back(spec);
    out.back().drive.traction_coefficient = traction;
    out.back().drive.creepage.reset();
  }
  return out;
}

}  // namespace railstrata
