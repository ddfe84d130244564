#include "passes/pass_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "damage/low_cycle.hpp"
#include "material/strain_claim.hpp"
#include "passes/pass_files.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

/// ", falling as the pass to the power of -0.34"
std::string trend_text(const PassVerdict& v) {
  return v.trend > kConstantTrend ? fmt::format(", falling as the pass to the power of -{:.2f}", v.trend) : "";
}

/// "32000": two digits, nobody knows more of so many passes.
std::string roughly(double passes) {
  const double unit = passes >= 10 ? std::pow(10, std::floor(std::log10(passes)) - 1) : 1;
  return fmt::format("{:.0f}", unit * std::round(passes / unit));
}

std::string life_text(const PassProgress& s) {
  if (s.strain_life && (!s.ductility || s.strain_life->note.empty())) {
    const double amplitude = s.last.largest.accumulated / 4;  // damage/low_cycle.hpp
    const auto [fewest, most] = std::minmax({cycles_of_plastic_strain(s.strain_life->life, amplitude),
                                             cycles_of_plastic_strain(s.strain_life->other, amplitude)});
    const std::string range = fewest == most ? "" : roughly(fewest) + " to ";
    return fmt::format("{}{} passes until a crack by Coffin and Manson, {}", range, roughly(most),
                       s.strain_life->note.empty() ? "by the strain-life curve of the case" : s.strain_life->note);
  }
  if (!s.ductility) return "a grade, a tensile_strength or passes.ductility would give its life by Coffin and Manson";
  const LowCycleLife life = low_cycle_life(s.last.largest.accumulated, *s.ductility);
  return fmt::format("{} to {} passes until a crack by Coffin and Manson, ε_f = passes.ductility = {}",
                     roughly(life.fewest), roughly(life.most), *s.ductility);
}

std::string class_sentence(const PassProgress& s) {
  const double at = s.error.of("net_depth_mm"), cycle = s.error.of("cycle_net");
  const std::string where = fmt::format("{:.1f}{} mm depth", kToMilli * s.last.net_depth,
                                        std::isnan(at) ? "" : fmt::format(" ± {:.1f}", at)),
                    rate = strain_text(s.verdict.rate, cycle / s.cycle);
  switch (s.verdict.kind) {
    case PassClass::elastic_shakedown:
      if (!s.ever_yielded) return "Stays elastic: no point has yielded.";
      return fmt::format("Shakes down: no plastic flow from pass {} on.", s.first_quiet);
    case PassClass::plastic_shakedown:
      return fmt::format(
          "Closed cycles (plastic shakedown): {} plastic strain in every pass, {} of it remains: low-cycle fatigue, "
          "{}.",
          strain_text(s.last.largest.accumulated, s.error.of("accumulated_strain")), rate, life_text(s));
    case PassClass::ratchetting:
      return fmt::format("Ratchets: {} net strain per pass at {}, the same from pass to pass.", rate, where);
    case PassClass::transient:
      break;
  }
  return fmt::format("{}: {} net strain in pass {} at {}{}; more passes will show.",
                     s.verdict.trend > kConstantTrend ? "Still settling" : "No claim yet", rate, s.last.pass, where,
                     trend_text(s.verdict));
}

}  // namespace

void add_pass(const PassRow& pass, const PassResult& result, PassSeries& series) {
  const std::size_t points = result.accumulated.size();
  series.points.resize(points);
  series.begun.resize(points);
  const bool whole = pass.pass % series.cycle == 0;
  PassStrain largest;
  for (std::size_t n = 0; n < points; ++n) {
    std::array<double, 7>& begun = series.begun[n];
    const std::array<double, 6>& strain = result.plastic_strain[n];
    begun[6] += result.accumulated[n];
    if (!whole) continue;
    std::vector<PassStrain>& point = series.points[n];
    remember_pass({begun[6], net_strain(begun.data(), strain.data())}, point);
    largest.accumulated = std::max(largest.accumulated, point.back().accumulated);
    largest.net = std::max(largest.net, point.back().net);
    std::copy(strain.begin(), strain.end(), begun.begin());
    begun[6] = 0;
  }
  add_strain(pass.pass, pass.largest, series.strains);
  if (whole) add_strain(pass.pass / series.cycle, largest, series.cycles);
  add_row(stationary_columns(), {pass, whole ? largest : PassStrain{kNotApplicable, kNotApplicable}}, series.table);
}

void add_strain(int number, const PassStrain& strain, std::vector<PassStrain>& strains) {
  if (const PassStrain from = strains.empty() ? strain : strains.back(); !strains.empty()) {
    const double first = static_cast<double>(strains.size());
    const auto between = [&](double was, double is, double share) {
      return was > 0 && is > 0 ? was * std::pow(is / was, share) : was;
    };
    while (static_cast<int>(strains.size()) + 1 < number) {
      const double share = std::log(static_cast<double>(strains.size() + 1) / first) / std::log(number / first);
      strains.push_back({between(from.accumulated, strain.accumulated, share), between(from.net, strain.net, share)});
    }
  }
  strains.push_back(strain);
}

void jump_over(int rounds, std::vector<double> state, PassSeries& series) {
  series.state.history = std::move(state);
  series.state.passes += rounds * series.cycle;
  for (std::size_t n = 0; n < series.begun.size(); ++n) {
    const double* history = series.state.history.data() + n * kStreamlineHistory;
    std::copy_n(history, 6, series.begun[n].begin());
    series.begun[n][6] = 0;
  }
}

PassVerdict verdict_of(const PassSeries& series) {
  PassVerdict verdict = classify(series.cycles);
  verdict.rate /= series.cycle;
  return verdict;
}

void remember_pass(const PassStrain& strain, std::vector<PassStrain>& passes) {
  if (passes.size() == kPointPasses) passes.erase(passes.begin());
  passes.push_back(strain);
}

Columns<std::vector<PassStrain>> remembered_columns() {
  using P = std::vector<PassStrain>;
  Columns<P> out;
  for (std::size_t n = 0; n < kPointPasses; ++n)
    for (const auto& [symbol, member] :
         {std::pair{"accumulated", &PassStrain::accumulated}, std::pair{"net", &PassStrain::net}})
      out.push_back({fmt::format("{}_{}", symbol, n), unit::kNone,
                     [n, m = member](const P& p) { return n < p.size() ? p[n].*m : kNotApplicable; }});
  return out;
}

std::vector<PassStrain> remembered_passes(const CsvTable& state, std::size_t row, std::size_t first) {
  std::vector<PassStrain> out;
  for (std::size_t c = first; c < first + 2 * kPointPasses; c += 2) {
    const double net = state.columns[c + 1].values[row];
    if (!std::isnan(net)) out.push_back({state.columns[c].values[row], net});
  }
  return out;
}

std::string passes_text(int passes) { return fmt::format("{} {}", passes, passes == 1 ? "pass" : "passes"); }

PassProgress progress_of(const PassVerdict& verdict, const std::vector<PassStrain>& strains, const PassRow& last) {
  PassProgress out;
  out.verdict = verdict;
  out.last = last;
  for (std::size_t n = 0; n < strains.size(); ++n) {
    out.ever_yielded = out.ever_yielded || strains[n].accumulated > 0;
    if (strains[n].accumulated >= kNoFlow) out.first_quiet = static_cast<int>(n) + 2;
  }
  return out;
}

std::string describe(const PassProgress& s) {
  const std::string claim = strain_warning(s.last.strain);
  return claim.empty() ? class_sentence(s) : class_sentence(s) + " " + claim;
}

std::string describe_law(const PlasticParameters<double>& law) {
  if (!std::isfinite(law.yield)) return "elastic: it does not yield";
  bool recalls = false, linear = false;
  for (int k = 0; k < kMostBackstresses; ++k)
    if (law.modulus[k] > 0) (law.recall[k] > 0 ? recalls : linear) = true;
  if (linear)
    return "linear kinematic hardening: cannot ratchet indefinitely; at any load it ends in shakedown or closed cycles";
  if (recalls && law.power > 0)
    return "Ohno–Wang hardening: above its limit it ratchets at a rate that falls, the more the larger recall_power is";
  if (recalls)
    return "Armstrong–Frederick hardening: above its limit it ratchets indefinitely at a constant rate, which the law "
           "tends to overestimate";
  if (law.saturation > 0)
    return "isotropic hardening: hardens up to a limit and is then perfectly plastic: it shakes down, or ratchets "
           "indefinitely above that limit";
  return "perfect plasticity: above the shakedown limit it ratchets indefinitely or yields back and forth; below it, "
         "it shakes down";
}

}  // namespace railstrata
