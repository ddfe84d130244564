#include "many/sweep.hpp"

#include <cstddef>
#include <exception>
#include <utility>

#include "core/faults.hpp"
#include "io/summary_json.hpp"
#include "many/each_case.hpp"
#include "record/csv.hpp"

namespace railstrata {
namespace {

void solve(SweepCase& c, const SweepOptions& options) {
  if (!c.loaded) return;
  try {
    const CaseSpec& spec = c.loaded->spec;
    const Wanted wanted = options.stresses ? Wanted{.wheel = false} : kContactAlone;
    AskOptions how{.bem = options.bem};
    if (options.life_of) how.life_of = options.life_of(c.loaded->folder(), options.control);
    c.summary = summary_json(ask(spec, place(spec, c.loaded->folder()), wanted, how).summary);
    c.fault = failed_check(c.summary);
  } catch (const std::exception& e) {
    c.fault = fault_line(e);
  }
}

}  // namespace

std::vector<SweepCase> plan_rows(const LoadedCase& base, const std::vector<std::string>& further,
                                 const std::vector<std::string>& keys, std::vector<std::vector<std::string>> rows) {
  std::vector<SweepCase> cases;
  std::optional<CaseError> first_error;
  bool any = false;
  for (std::vector<std::string>& values : rows) {
    std::vector<std::string> all = further;
    for (std::size_t k = 0; k < keys.size(); ++k) all.push_back(keys[k] + "=" + values[k]);
    cases.push_back({std::move(values), {}, nullptr, {}, false});
    try {
      cases.back().loaded = with_overrides(base, all);
      any = true;
    } catch (const CaseError& e) {
      cases.back().fault = fault_line(e);
      if (!first_error) first_error = e;
    }
  }
  if (!any) throw CaseError(*first_error);
  return cases;
}

std::vector<SweepCase> plan_sweep(const LoadedCase& base, const std::vector<Axis>& axes) {
  std::vector<std::string> keys;
  for (const Axis& axis : axes) keys.push_back(axis.key);
  return plan_rows(base, {}, keys, combinations(axes));
}

void run_sweep(std::vector<SweepCase>& cases, const SweepOptions& options) {
  for_each_completed(cases.size(), options.control, [&](std::size_t i) {
    solve(cases[i], options);
    return [&cases, &options, i] {
      cases[i].done = true;
      if (options.ended) options.ended();
    };
  });
}

CaseTable sweep_table(const std::vector<SweepCase>& cases, const std::vector<Axis>& axes,
                      const std::vector<ResultColumn>& columns) {
  static const nlohmann::ordered_json none;
  std::vector<CaseRow> rows;
  for (const SweepCase& c : cases) {
    const nlohmann::ordered_json& summary = c.done ? c.summary : none;  // another thread may be at work on it
    CaseRow& row = rows.emplace_back();
    row.state = !c.done ? "to do" : summary.is_null() ? "failed" : "done";
    if (c.done) row.fault = c.fault;
    row.remarks = remarks_of(summary);
    for (std::size_t k = 0; k < axes.size(); ++k) row.values.emplace_back(axes[k].key, c.values[k]);
    for (const ResultColumn& column : columns) row.numbers.emplace_back(column.name, column_value(column, summary));
  }
  CaseTable out{joined(value_columns(rows), number_columns(rows), answer_columns(rows), remark_columns()),
                std::move(rows)};
  std::erase_if(out.rows, [](const CaseRow& row) { return row.state == "to do"; });
  return out;
}

}  // namespace railstrata
