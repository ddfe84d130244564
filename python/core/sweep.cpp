#include "study/sweep.hpp"

#include <atomic>
#include <utility>

#include "python/core/bind.hpp"

namespace railstrata::python {
namespace {

using Varied = std::vector<std::pair<std::string, std::vector<std::string>>>;

/// A dict a case: `values` (one per key), `summary` (JSON, None without a result), `fault`, `static_notes`.
py::list rows_of(const std::vector<SweepCase>& cases) {
  py::list out;
  for (const SweepCase& c : cases) {
    py::dict row;
    row["values"] = c.values;
    row["summary"] = c.summary.is_null() ? py::object(py::none()) : py::str(c.summary.dump());
    row["fault"] = c.fault;
    row["static_notes"] = c.loaded ? c.loaded->static_notes : std::vector<std::string>{};
    out.append(row);
  }
  return out;
}

py::list sweep(const LoadedCase& base, const Varied& varied, double cell, bool stresses, const py::object& progress) {
  std::vector<VariedKey> keys;
  for (const auto& [key, values] : varied) keys.push_back({key, values});
  std::vector<SweepCase> cases = plan_sweep(base, base.overrides, keys);
  InfluenceCache cache;
  std::atomic<bool> stop{false};
  std::atomic<std::size_t> done{0};
  SweepOptions options;
  options.bem.cell = cell;
  options.bem.cache = &cache;
  options.stresses = stresses;
  options.stop = &stop;
  options.ended = [&] { ++done; };
  const auto look = [&] {
    if (!progress.is_none()) progress(static_cast<double>(done) / static_cast<double>(cases.size()));
  };
  in_background([&] { run_sweep(cases, options); }, look, [&] { stop = true; });
  return rows_of(cases);
}

/// Columns of tables made from summaries: (name, path, factor).
py::list columns(bool stresses) {
  py::list out;
  for (const ResultColumn& c : result_columns(stresses)) out.append(py::make_tuple(c.name, c.path, c.factor));
  return out;
}

}  // namespace

void bind_sweep(py::module_& m) {
  m.def("sweep", &sweep);
  m.def("result_columns", &columns);
}

}  // namespace railstrata::python
