#include "many/sweep.hpp"

#include <cmath>

#include "bridge/records.hpp"
#include "clock/wheel_life.hpp"
#include "options/option_table.hpp"

namespace railstrata::bridge {
namespace {

std::vector<Axis> keys_of(const Json& varied) {
  std::vector<Axis> out;
  for (const Json& one : varied) {
    const auto key = one.at(0).get<std::string>();
    std::vector<std::string> texts;
    for (const Json& value : one.at(1)) texts.push_back(value_text(key, value));
    out.push_back(make_axis(key, std::move(texts)));
  }
  return out;
}

/// Row of a case: `values` (one per key, numbers in SI), `summary` (null without a result), `fault`, `static_notes`.
Json row_of(const SweepCase& c, const std::vector<Axis>& axes) {
  Json values = Json::array();
  for (std::size_t k = 0; k < axes.size(); ++k) values.push_back(si_value(axes[k].key, c.values[k]));
  return {{"values", values},
          {"summary", c.summary},
          {"fault", c.fault},
          {"static_notes", c.loaded ? notes_at_rest(*c.loaded) : std::vector<std::string>{}}};
}

/// rows, the axes (SI unit, number of values), and the columns of a table made from their summaries: (name, path,
/// factor).
void sweep(Call& call) {
  const auto base = call.made<LoadedCase>("case");
  const std::vector<Axis> axes = keys_of(call.argument("varied"));
  std::vector<SweepCase> cases = plan_sweep(*base, axes);
  InfluenceCache cache;
  std::size_t done = 0;
  SweepOptions options;
  options.bem.cell = call.number("cell");
  options.bem.cache = &cache;
  options.stresses = call.flag("stresses");
  options.life_of = life_of_wheels;
  options.control = &call.control;
  options.ended = [&] { call.report(Json::array({static_cast<double>(++done) / static_cast<double>(cases.size())})); };
  run_sweep(cases, options);
  Json& rows = call.answer["rows"] = Json::array();
  for (const SweepCase& c : cases) rows.push_back(row_of(c, axes));
  call.answer["axes"] = Json::array();
  for (const Axis& axis : axes) {
    const Option* option = option_of_key(axis.key);
    call.answer["axes"].push_back({option ? si_unit(option->dimension) : "", axis.values.size()});
  }
  Json& columns = call.answer["columns"] = Json::array();
  for (const ResultColumn& c : result_columns(options.stresses)) columns.push_back({c.name, c.path, c.factor});
}

}  // namespace

Functions sweep_functions() { return {{"sweep", sweep}}; }

}  // namespace railstrata::bridge
