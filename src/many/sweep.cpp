#include "many/sweep.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <exception>
#include <utility>

#include "core/faults.hpp"
#include "io/csv.hpp"
#include "io/summary_json.hpp"
#include "judge/bem_summary.hpp"
#include "many/each_case.hpp"
#include "runs/solve_half_space.hpp"

namespace railstrata {
namespace {

void solve(SweepCase& c, const BemOptions& bem, bool stresses) {
  if (!c.loaded) return;
  try {
    const CaseSpec spec = half_space_case(c.loaded->spec);
    const HalfSpaceSolution solution = solve_half_space_contact(spec, place(spec, c.loaded->folder()), bem);
    const BemResult& result = solution.result;
    Summary summary = solution.summary;
    if (stresses) {
      summary.rail = bem_rail_stress(result, summary.contact);
      summary.warnings = bem_warnings(summary, spec, result);
    }
    c.summary = summary_json(summary);
    c.fault = failed_check(c.summary);
  } catch (const std::exception& e) {
    c.fault = fault_line(e);
  }
}

}  // namespace

std::vector<SweepCase> plan_sweep(const LoadedCase& base, const std::vector<std::string>& overrides,
                                  const std::vector<Axis>& keys) {
  std::vector<SweepCase> cases;
  std::optional<CaseError> first_error;
  bool any = false;
  for (std::vector<std::string>& values : combinations(keys)) {
    std::vector<std::string> all = overrides;
    for (std::size_t k = 0; k < keys.size(); ++k) all.push_back(keys[k].key + "=" + values[k]);
    cases.push_back({std::move(values), {}, nullptr, {}, false});
    try {
      cases.back().loaded = parse_case(base.source_text, base.file, all);
      any = true;
    } catch (const CaseError& e) {
      cases.back().fault = fault_line(e);
      if (!first_error) first_error = e;
    }
  }
  if (!any) throw CaseError(*first_error);
  return cases;
}

void run_sweep(std::vector<SweepCase>& cases, const SweepOptions& options) {
  for_each_ended(cases.size(), options.control, [&](std::size_t i) {
    solve(cases[i], options.bem, options.stresses);
    return [&cases, &options, i] {
      cases[i].done = true;
      if (options.ended) options.ended();
    };
  });
}

SweepTable::SweepTable(const std::filesystem::path& file, const std::vector<std::string>& origin,
                       const std::vector<Axis>& keys, std::vector<ResultColumn> columns)
    : file_(file), columns_(std::move(columns)) {
  std::string head = csv_remarks(origin) + csv_remarks({patches_remark(columns_)});
  for (const Axis& k : keys) head += k.key + ',';
  for (const ResultColumn& c : columns_) head += std::string(c.name) + ',';
  file_.write(head + "fault,patches,checks,warnings\n");
}

void SweepTable::add_done(const std::vector<SweepCase>& cases) {
  while (written_ < cases.size() && cases[written_].done) file_.write(row(cases[written_++]));
}

std::string SweepTable::row(const SweepCase& c) const {
  std::string out;
  for (const std::string& v : c.values) out += csv_cell(v) + ',';
  for (const ResultColumn& column : columns_) out += csv_cell(column_value(column, c.summary)) + ',';
  const ResultRemarks remarks = remarks_of(c.summary);
  return out + fmt::format("{},{},{},{}\n", csv_cell(c.fault), remarks.patches, csv_cell(remarks.checks),
                           csv_cell(remarks.warnings));
}

}  // namespace railstrata
