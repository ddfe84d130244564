#include "passes/pass_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "passes/pass_files.hpp"

namespace railstrata {

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

}  // namespace railstrata
