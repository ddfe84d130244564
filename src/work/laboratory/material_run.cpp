#include "laboratory/material_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/faults.hpp"
#include "material/strain_claim.hpp"
#include "model/material_strength.hpp"
#include "record/unit.hpp"
#include "report/pictures.hpp"

namespace railstrata {
namespace {

constexpr std::size_t kMostTraced = 20000;  // states that a picture shows
constexpr double kStill = 0.02;             // of the largest range: a component that moves less is not drawn
constexpr std::size_t kMostLoops = 3;

CaseError beyond(const PlasticMaterial& material, const MaterialPathTable& table, const BeyondMaterial& e) {
  const auto row = static_cast<std::size_t>(e.point) % table.lines.size();
  const double most = largest_stress(material.plastic);
  return CaseError(
      fmt::format("no strain gives the stress of this row: the material follows to {:.0f} % of the way{}",
                  kToPercent * e.reached,
                  std::isfinite(most) ? fmt::format(", it bears {:.1f} MPa (von Mises) at most", kToMega * most) : ""),
      "lower the stress, or prescribe the strain of this direction (a column e_xx instead of s_xx)", table.where(row));
}

using Tensor = std::array<double, 6> MaterialState::*;

double range_of(const std::vector<MaterialState>& trace, Tensor what, std::size_t j) {
  double low = 0, high = 0;
  for (const MaterialState& s : trace) {
    low = std::min(low, (s.*what)[j]);
    high = std::max(high, (s.*what)[j]);
  }
  return high - low;
}

/// The components of strain or stress that move most, largest range first.
std::vector<std::size_t> moving(const std::vector<MaterialState>& trace, Tensor what) {
  std::vector<std::size_t> out{0, 1, 2, 3, 4, 5};
  std::stable_sort(out.begin(), out.end(),
                   [&](std::size_t a, std::size_t b) { return range_of(trace, what, a) > range_of(trace, what, b); });
  const double most = range_of(trace, what, out.front());
  std::erase_if(out, [&](std::size_t j) { return range_of(trace, what, j) < kStill * most; });
  if (out.size() > kMostLoops) out.resize(kMostLoops);
  return out;
}

Plot loops(const MaterialRun& run) {
  Plot out{"strain [%], shear as tensor", "stress [MPa]", {}};
  for (const std::size_t j : moving(run.trace, &MaterialState::stress)) {
    PlotCurve curve{fmt::format("s_{0} by e_{0}", kTensorComponents[j]), {}, {}, false};
    for (const MaterialState& s : run.trace) {
      curve.x.push_back(kToPercent * s.strain[j]);
      curve.y.push_back(kToMega * s.stress[j]);
    }
    out.curves.push_back(std::move(curve));
  }
  return out;
}

Plot along_path(const MaterialRun& run) {
  Plot out{"state on the way, of all drawn [%]", "plastic strain [%]", {}};
  PlotCurve accumulated{"p, accumulated", {}, {}, false};
  const auto n = static_cast<double>(std::max<std::size_t>(run.trace.size(), 2) - 1);
  for (std::size_t i = 0; i < run.trace.size(); ++i) {
    accumulated.x.push_back(kToPercent * static_cast<double>(i) / n);
    accumulated.y.push_back(kToPercent * run.trace[i].history[6]);
  }
  for (const std::size_t j : moving(run.trace, &MaterialState::strain)) {
    PlotCurve curve{fmt::format("{}", kTensorComponents[j]), accumulated.x, {}, false};
    for (const MaterialState& s : run.trace) curve.y.push_back(kToPercent * s.history[j]);
    out.curves.push_back(std::move(curve));
  }
  out.curves.push_back(std::move(accumulated));
  return out;
}

Plot by_cycle(const MaterialRun& run) {
  Plot out{"cycle", "net plastic strain of a cycle [%]", {}};
  for (const std::size_t j : moving(run.trace, &MaterialState::strain)) {
    PlotCurve curve{fmt::format("{}", kTensorComponents[j]), {}, {}, run.cycles.size() < 3};
    for (std::size_t n = 0; n < run.cycles.size(); ++n) {
      curve.x.push_back(static_cast<double>(n + 1));
      curve.y.push_back(kToPercent * run.cycles[n].net[j]);
    }
    out.curves.push_back(std::move(curve));
  }
  return out;
}

MaterialRun in_increments(const PlasticMaterial& material, const MaterialPathTable& table, int increments, int cycles,
                          const Control* control) {
  MaterialPath path{table.path.prescribed, {}};
  for (int n = 0; n < cycles; ++n)
    path.points.insert(path.points.end(), table.path.points.begin(), table.path.points.end());
  MaterialRun out;
  out.increments = increments;
  out.trace.emplace_back();
  const std::size_t every = path.points.size() * static_cast<std::size_t>(increments) / kMostTraced + 1;
  std::size_t seen = 0;
  const auto look = [&](const MaterialState& s) {
    if (asked_to_stop(control)) throw Interrupted("stopped on the path");
    if (++seen % every == 0 || seen % static_cast<std::size_t>(increments) == 0) out.trace.push_back(s);
  };
  try {
    out.states = drive_path(material, path, increments, look);
  } catch (const BeyondMaterial& e) {
    throw beyond(material, table, e);
  }
  return out;
}

std::vector<MaterialState> extrapolated(const std::vector<MaterialState>& coarse, std::vector<MaterialState> fine) {
  const auto improve = [](auto& f, const auto& c) {
    for (std::size_t j = 0; j < f.size(); ++j) f[j] += f[j] - c[j];
  };
  for (std::size_t i = 0; i < fine.size(); ++i) {
    improve(fine[i].strain, coarse[i].strain);
    improve(fine[i].stress, coarse[i].stress);
    improve(fine[i].history, coarse[i].history);
    fine[i].dissipated += fine[i].dissipated - coarse[i].dissipated;
  }
  return fine;
}

/// Puts what two extrapolations differ by into the errors of `run`; whether that is little.
bool compare(const std::vector<MaterialState>& before, const std::vector<MaterialState>& now, MaterialRun& run) {
  constexpr double kEnough = 1e-3, kNone = 1e-9, kNoStress = 1;  // -, -, Pa: round-off
  constexpr std::size_t kStrains = 7;                            // plastic strain and p
  double largest_strain = 0, largest_stress = 0;
  run.strain_error = run.stress_error = 0;
  const auto look = [](const auto& a, const auto& b, std::size_t count, double& error, double& largest) {
    for (std::size_t j = 0; j < count; ++j) {
      error = std::max(error, std::abs(b[j] - a[j]));
      largest = std::max(largest, std::abs(b[j]));
    }
  };
  for (std::size_t i = 0; i < now.size(); ++i) {
    look(before[i].history, now[i].history, kStrains, run.strain_error, largest_strain);
    look(before[i].strain, now[i].strain, now[i].strain.size(), run.strain_error, largest_strain);
    look(before[i].stress, now[i].stress, now[i].stress.size(), run.stress_error, largest_stress);
  }
  return run.strain_error <= std::max(kEnough * largest_strain, kNone) &&
         run.stress_error <= std::max(kEnough * largest_stress, kNoStress);
}

std::vector<MaterialCycle> cycles_of(const std::vector<MaterialState>& states, std::size_t rows) {
  std::vector<MaterialCycle> out;
  MaterialState before;
  for (std::size_t last = rows; last <= states.size(); last += rows) {
    const MaterialState& after = states[last - 1];
    MaterialCycle& cycle = out.emplace_back();
    cycle.number = static_cast<int>(out.size());
    for (std::size_t j = 0; j < 6; ++j) cycle.net[j] = after.history[j] - before.history[j];
    cycle.accumulated = after.history[6] - before.history[6];
    before = after;
  }
  return out;
}

}  // namespace

double MaterialCycle::largest_net() const {
  double out = 0;
  for (const double e : net) out = std::max(out, std::abs(e));
  return out;
}

ChosenMaterial choose_material(const LoadedCase& card, const std::string& word) {
  const CaseSpec& spec = card.spec;
  if (word == "rail") return {spec.rail_material, "rail", "material.rail"};
  if (word == "wheel") return {spec.wheel_material, "wheel", "material.wheel"};
  for (std::size_t i = 0; i < spec.layers.size(); ++i)
    if (word == fmt::format("layer.{}", i) || word == spec.layers[i].name)
      return {spec.layers[i].material, spec.layers[i].name, fmt::format("layer.{}", i)};
  throw CaseError(fmt::format("\"{}\": the card has no such material", word),
                  spec.layers.empty() ? "write rail or wheel" : "write rail, wheel or a layer's name");
}

ChosenLaw law_of(const LoadedCase& card, const ChosenMaterial& chosen, double depth) {
  const auto law = with_places(card, [&] { return plastic_law(chosen.spec, chosen.name, chosen.key); });
  if (!law)
    throw CaseError(
        chosen.spec.strength.elastic ? fmt::format("{} is elastic on purpose: there is no law to drive", chosen.key)
                                     : fmt::format("{} does not give where the material begins to yield", chosen.key),
        "give yield_strength = \"500 MPa\", or a ready set such as hardening = \"R260\"", card.file.string());
  return {law->at(depth), law->notes};
}

MaterialRun run_material(const PlasticMaterial& material, const MaterialPathTable& table, int increments, int cycles,
                         const Control* control) {
  constexpr int kMostDoublings = 8;
  MaterialRun coarse = in_increments(material, table, increments, cycles, control),
              out = in_increments(material, table, 2 * increments, cycles, control);
  std::vector<MaterialState> before = extrapolated(coarse.states, out.states);
  for (int doubling = 2; doubling <= kMostDoublings; ++doubling) {
    coarse = std::move(out);
    out = in_increments(material, table, 2 * coarse.increments, cycles, control);
    std::vector<MaterialState> now = extrapolated(coarse.states, out.states);
    const bool enough = compare(before, now, out);
    before = std::move(now);
    if (enough) break;
  }
  out.states = std::move(before);
  out.cycles = cycles_of(out.states, table.lines.size());
  return out;
}

std::vector<CsvColumn> point_columns(const MaterialRun& run, bool strains) {
  using M = MaterialState;
  Columns<M> columns;
  if (strains) columns = tensor_columns<M>("e", unit::kNone, &M::strain);
  append(columns, tensor_columns<M>("s", unit::kMPa, &M::stress));
  append(columns, {{"p", unit::kNone, [](const M& m) { return m.history[6]; }}});
  return csv_columns(run.states, columns);
}

std::vector<CsvColumn> cycle_columns(const MaterialRun& run) {
  using C = MaterialCycle;
  Columns<C> columns{{"cycle", unit::kCount, &C::number}};
  append(columns, tensor_columns<C>("net", unit::kNone, &C::net));
  append(columns, {{"p_of_cycle", unit::kNone, &C::accumulated}});
  return csv_columns(run.cycles, columns);
}

std::string path_picture(const std::string& title, const MaterialRun& run, const std::vector<std::string>& remarks) {
  return plots_svg(title, {loops(run), run.cycles.size() > 1 ? by_cycle(run) : along_path(run)}, remarks);
}

std::string increments_text(const MaterialRun& run) {
  return fmt::format("{} increments a row, extrapolated: ± {:.2g} % of strain, ± {:.2g} MPa", run.increments,
                     kToPercent * run.strain_error, kToMega * run.stress_error);
}

double largest_plastic_strain(const MaterialRun& run) {
  double out = 0;
  for (const MaterialState& s : run.trace) out = std::max(out, equivalent_strain(s.history.data()));
  return out;
}

}  // namespace railstrata
