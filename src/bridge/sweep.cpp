#include "many/sweep.hpp"

#include "bridge/functions.hpp"

namespace railstrata::bridge {
namespace {

std::vector<Axis> keys_of(const Json& varied) {
  std::vector<Axis> out;
  for (const Json& one : varied) out.push_back(make_axis(one.at(0).get<std::string>(), texts_of(one.at(1))));
  return out;
}

/// Row of a case: `values` (one per key), `summary` (null without a result), `fault`, `static_notes`.
Json row_of(const SweepCase& c) {
  return {{"values", c.values},
          {"summary", c.summary},
          {"fault", c.fault},
          {"static_notes", c.loaded ? c.loaded->static_notes : std::vector<std::string>{}}};
}

/// rows, and the columns of a table made from their summaries: (name, path, factor).
void sweep(Call& call) {
  const auto base = call.made<LoadedCase>("case");
  std::vector<SweepCase> cases = plan_sweep(*base, base->overrides, keys_of(call.argument("varied")));
  InfluenceCache cache;
  std::size_t done = 0;
  SweepOptions options;
  options.bem.cell = call.number("cell");
  options.bem.cache = &cache;
  options.stresses = call.flag("stresses");
  options.control = &call.control;
  options.ended = [&] { call.report(Json::array({static_cast<double>(++done) / static_cast<double>(cases.size())})); };
  run_sweep(cases, options);
  Json& rows = call.answer["rows"] = Json::array();
  for (const SweepCase& c : cases) rows.push_back(row_of(c));
  Json& columns = call.answer["columns"] = Json::array();
  for (const ResultColumn& c : result_columns(options.stresses)) columns.push_back({c.name, c.path, c.factor});
}

}  // namespace

Functions sweep_functions() { return {{"sweep", sweep}}; }

}  // namespace railstrata::bridge
