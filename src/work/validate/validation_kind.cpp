#include "validate/validation_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "bem/case_patch.hpp"
#include "clock/clock.hpp"
#include "halfspace/circular_pressure.hpp"
#include "laboratory/material_run.hpp"
#include "many/result_columns.hpp"
#include "many/sweep.hpp"
#include "text/units.hpp"
#include "validate/validation_set.hpp"

namespace railstrata {
namespace {

// ---- contact: each row is a half-space solution of the case

/// A number of the stresses below the patch.
bool of_stress(const ComparedColumn& c) { return find_column(c.result)->of_stress; }

Answers contact_answers(const ValidationSet& set, const ValidationSeries& series, const RowTexts& rows,
                        const AnswerOptions& options) {
  std::vector<std::string> keys;
  for (const VariedColumn& v : set.varied) keys.push_back(v.key);
  std::vector<SweepCase> cases = plan_rows(set.loaded, series.overrides, keys, rows);
  SweepOptions sweep;
  sweep.bem = options.bem;
  sweep.control = options.control;
  sweep.stresses = std::any_of(set.compared.begin(), set.compared.end(), of_stress);
  run_sweep(cases, sweep);
  Answers out;
  for (std::size_t i = 0; i < cases.size(); ++i)
    if (!cases[i].fault.empty()) out.faults.push_back(fmt::format("row {}: {}", i + 1, cases[i].fault));
  for (const ComparedColumn& c : set.compared) {
    CsvColumn& numbers = out.numbers.emplace_back(CsvColumn{c.result, {}});
    for (const SweepCase& solved : cases)
      numbers.values.push_back(column_value(*find_column(c.result), solved.summary));
  }
  return out;
}

std::vector<std::string> contact_results() {
  std::vector<std::string> out;
  for (const ResultColumn& c : result_columns(true)) out.push_back(c.name);
  return out;
}

// ---- what a series does to a case that no contact is computed of

LoadedCase case_of(const ValidationSet& set, const ValidationSeries& series, const std::vector<std::string>& row = {}) {
  std::vector<std::string> overrides = series.overrides;
  overrides.insert(overrides.end(), row.begin(), row.end());
  return with_overrides(set.loaded, overrides);
}

/// The k-th varied column of all rows [SI]. Throws CaseError with key and row.
std::vector<double> quantities(const ValidationSet& set, const RowTexts& rows, std::size_t k, const Dimension& d) {
  std::vector<double> out;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    try {
      out.push_back(parse_quantity(rows[i][k], d));
    } catch (const UnitError& e) {
      throw CaseError(fmt::format("{} = \"{}\" in row {}: {}", set.varied[k].key, rows[i][k], i + 1, e.what()),
                      e.remedy, set.file.string());
    }
  }
  return out;
}

// ---- material: each row is a point of a path, or a path of its own from the virgin state

std::array<double, 6> centre(const MaterialState& m) {
  std::array<double, 6> out{};
  for (int k = 0; k < kMostBackstresses; ++k)
    for (std::size_t j = 0; j < 6; ++j) out[j] += m.history[7 + 6 * static_cast<std::size_t>(k) + j];
  return out;
}

/// Stresses, strains, accumulated plastic strain; the yield surface: its size in tension and its centre.
std::vector<CsvColumn> material_numbers(const MaterialRun& run, const PlasticParameters<double>& law) {
  Columns<MaterialState> surface{{"yield", unit::kMPa, [law](const MaterialState& m) {
                                    return law.yield + law.saturation * saturated_share(law.rate * m.history[6]);
                                  }}};
  append(surface, tensor_columns<MaterialState>("centre", unit::kMPa, &centre));
  std::vector<CsvColumn> out = point_columns(run, true);
  for (CsvColumn& c : csv_columns(run.states, surface)) out.push_back(std::move(c));
  return out;
}

std::vector<PathColumn> row_of(std::vector<PathColumn> path, std::size_t i) {
  for (PathColumn& c : path) c.values = {c.values[i]};
  return path;
}

Answers material_answers(const ValidationSet& set, const ValidationSeries& series, const RowTexts& rows,
                         const AnswerOptions& options) {
  const LoadedCase card = case_of(set, series);
  const PlasticMaterial law = law_of(card, choose_material(card, set.material), 0).material;
  std::vector<PathColumn> path;
  for (std::size_t k = 0; k < set.varied.size(); ++k) {
    const std::string& key = set.varied[k].key;
    path.push_back({key, quantities(set, rows, k, key.starts_with("e_") ? dimension::kNumber : dimension::kPressure)});
  }
  MaterialRun run;
  for (std::size_t i = 0; i < (set.from_virgin ? rows.size() : 1); ++i) {
    const MaterialPathTable table = material_path_of(set.from_virgin ? row_of(path, i) : path, Prescribed::stress);
    const MaterialRun part = run_material(law, table, set.increments, 1, options.control);
    run.states.insert(run.states.end(), part.states.begin(), part.states.end());
  }
  return {material_numbers(run, law.plastic), {}};
}

std::vector<std::string> names(const std::vector<CsvColumn>& columns) {
  std::vector<std::string> out;
  for (const CsvColumn& c : columns) out.push_back(c.name);
  return out;
}

// ---- pressure: each row is a point of the layered rail below circles of pressure

Columns<PointBelow> below_columns() {
  Columns<PointBelow> out = tensor_columns<PointBelow>("sigma", unit::kMPa, &PointBelow::stress);
  append(out, tensor_columns<PointBelow>("strain", unit::kNone, &PointBelow::strain));
  append(out, {{"sinking", unit::kMicrometres, &PointBelow::sinking}});
  return out;
}

Answers pressure_answers(const ValidationSet& set, const ValidationSeries& series, const RowTexts& rows,
                         const AnswerOptions& options) {
  const LayeredHalfSpace body = layered_body(case_of(set, series).spec, BodyId::rail);
  std::vector<Vec3> at(rows.size());
  for (std::size_t k = 0; k < set.varied.size(); ++k) {
    const std::string& key = set.varied[k].key;
    const std::vector<double> values = quantities(set, rows, k, dimension::kLength);
    for (std::size_t i = 0; i < at.size(); ++i) (key == "x" ? at[i].x : key == "y" ? at[i].y : at[i].z) = values[i];
  }
  std::vector<PointBelow> found;
  for (std::size_t i = 0; i < at.size() && !asked_to_stop(options.control); ++i) {
    if (!(at[i].z > 0))
      throw CaseError(fmt::format("depth = {} mm in row {}: the sum over waves ends below the surface alone",
                                  kToMilli * at[i].z, i + 1),
                      "leave the rows of the surface out", set.file.string());
    found.push_back(below_circles(body, set.circles, at[i]));
  }
  return {csv_columns(found, below_columns()), {}};
}

// ---- traffic: each row is a rail through the gross traffic of life.until

Columns<ClockResult> traffic_columns() {
  const auto per_100_tonnes = [](double amount, const ClockResult& r) {
    return 100 * amount / (unit::kMGT.factor * r.reached);
  };
  return {
      {"wear_per_100MGT", unit::kMillimetres,
       [=](const ClockResult& r) { return per_100_tonnes(r.history.back().removed, r); }},
      {"ductility_per_100MGT", unit::kCount,
       [=](const ClockResult& r) { return per_100_tonnes(r.history.back().ductility, r); }},
      {"crack_growth", unit::kMillimetresPerMGT, [](const ClockResult& r) { return r.history.back().crack_growth; }},
      {"first_crack_MGT", unit::kCount, [](const ClockResult& r) {
         const LifeRow* first = first_damage(r.lives);
         return first ? first->mgt.best : std::numeric_limits<double>::infinity();
       }}};
}

Answers traffic_answers(const ValidationSet& set, const ValidationSeries& series, const RowTexts& rows,
                        const AnswerOptions& options) {
  Answers out;
  std::vector<ClockResult> found;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<std::string> overrides;
    for (std::size_t k = 0; k < set.varied.size(); ++k)
      overrides.push_back(fmt::format("{}={}", set.varied[k].key, rows[i][k]));
    const LoadedCase one = case_of(set, series, overrides);
    if (!(one.spec.life.until > 0))
      throw CaseError("kind = \"traffic\": the rail is not followed", "add life.until = \"5 Mt\" to the case",
                      set.file.string());
    found.push_back(run_clock(one.spec, one.folder(), clock_options(one.spec, options.bem, options.control)));
    if (!found.back().ended.empty()) out.faults.push_back(fmt::format("row {}: {}", i + 1, found.back().ended));
  }
  out.numbers = csv_columns(found, traffic_columns());
  return out;
}

}  // namespace

const std::vector<ValidationKind>& validation_kinds() {
  static const std::vector<ValidationKind> kinds{
      {"contact", {"cell"}, {}, contact_results(), contact_answers},
      {"material",
       {"material", "increments", "from_virgin"},
       {"e_xx", "e_yy", "e_zz", "e_xy", "e_yz", "e_xz", "s_xx", "s_yy", "s_zz", "s_xy", "s_yz", "s_xz"},
       names(material_numbers({}, {})),
       material_answers},
      {"pressure",
       {"circle"},
       {"x", "y", "depth"},
       names(csv_columns<PointBelow>({}, below_columns())),
       pressure_answers},
      {"traffic", {"cell"}, {}, names(csv_columns<ClockResult>({}, traffic_columns())), traffic_answers}};
  return kinds;
}

}  // namespace railstrata
