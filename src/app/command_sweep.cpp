#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <optional>

#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/progress.hpp"
#include "core/parallel.hpp"
#include "io/csv.hpp"
#include "io/output_file.hpp"
#include "io/summary_json.hpp"
#include "post/bem_summary.hpp"
#include "runs/output_folder.hpp"
#include "runs/run_bem.hpp"
#include "runs/stop_flag.hpp"
#include "study/result_columns.hpp"
#include "study/variation.hpp"

namespace railstrata {
namespace {

struct SweepCase {
  std::vector<std::string> values;
  std::optional<LoadedCase> loaded;
  nlohmann::ordered_json summary;  ///< null: there is none
  std::string fault;               ///< empty: all is well
  bool done = false;
};

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string fault_of(const CaseError& e) {
  return e.diagnostics.empty() ? first_line(e.what()) : first_line(e.diagnostics.front().message);
}

/// Cases whose values are refused carry the fault; if all are, the first one's error goes to the user: a key that does
/// not exist, most likely.
std::vector<SweepCase> load_cases(const CommandOptions& options, const LoadedCase& base,
                                  const std::vector<VariedKey>& keys) {
  std::vector<SweepCase> cases;
  std::optional<CaseError> first_error;
  bool any = false;
  for (std::vector<std::string>& values : combinations(keys)) {
    std::vector<std::string> overrides = options.overrides;
    for (std::size_t k = 0; k < keys.size(); ++k) overrides.push_back(keys[k].key + "=" + values[k]);
    cases.push_back({std::move(values), {}, nullptr, {}, false});
    try {
      cases.back().loaded = parse_case(base.source_text, base.file, overrides);
      any = true;
    } catch (const CaseError& e) {
      cases.back().fault = fault_of(e);
      if (!first_error) first_error = e;
    }
  }
  if (!any) throw CaseError(*first_error);
  return cases;
}

void solve(SweepCase& c, const BemOptions& bem, bool stresses) {
  if (!c.loaded) return;
  try {
    const CaseSpec spec = half_space_case(c.loaded->spec);
    const BemResult result = solve_bem(spec, place(spec, c.loaded->folder()), bem);
    Summary summary = bem_contact_summary(spec, result);
    if (stresses) summary.rail = bem_rail_stress(result, summary.contact);
    c.summary = summary_json(summary);
    c.fault = failed_check(c.summary);
  } catch (const CaseError& e) {
    c.fault = fault_of(e);
  } catch (const std::exception& e) {
    c.fault = first_line(e.what());
  }
}

/// sweep.csv, which grows in the order of the cases, whatever the order in which they end.
class SweepTable {
 public:
  SweepTable(const std::filesystem::path& file, const std::vector<std::string>& origin,
             const std::vector<VariedKey>& keys, std::vector<ResultColumn> columns)
      : file_(file), columns_(std::move(columns)) {
    std::string head = csv_remarks(origin);
    for (const VariedKey& k : keys) head += k.key + ',';
    for (const ResultColumn& c : columns_) head += std::string(c.name) + ',';
    file_.write(head + "fault\n");
  }
  /// Writes the rows that are done and not yet written; returns the number of cases done.
  std::size_t add_done(const std::vector<SweepCase>& cases) {
    while (written_ < cases.size() && cases[written_].done) file_.write(row(cases[written_++]));
    ++done_;
    return done_;
  }

 private:
  std::string row(const SweepCase& c) const {
    std::string out;
    for (const std::string& v : c.values) out += csv_cell(v) + ',';
    for (const ResultColumn& column : columns_) out += csv_cell(column_value(column, c.summary)) + ',';
    return out + csv_cell(c.fault) + '\n';
  }
  OutputFile file_;
  std::vector<ResultColumn> columns_;
  std::size_t written_ = 0, done_ = 0;
};

/// Cases side by side, one thread each: their grids are too small to share one.
void solve_all(std::vector<SweepCase>& cases, const BemOptions& bem, bool stresses, SweepTable& table, bool shown) {
  Progress progress("sweep", shown);
  std::mutex writing;
  std::exception_ptr failure;
  for_each(
      static_cast<std::ptrdiff_t>(cases.size()),
      [&](std::ptrdiff_t i) {
        SweepCase& c = cases[static_cast<std::size_t>(i)];
        if (stop_flag()) return;
        solve(c, bem, stresses);
        const std::lock_guard lock(writing);
        c.done = true;
        try {
          progress.update(static_cast<double>(table.add_done(cases)) / static_cast<double>(cases.size()));
        } catch (...) {
          failure = std::current_exception();
        }
      },
      true);
  if (failure) std::rethrow_exception(failure);
}

std::string cell_text(double v, int width, int digits) {
  return std::isfinite(v) ? fmt::format("  {:>{}.{}f}", v, width, digits) : fmt::format("  {:>{}}", "-", width);
}

/// What the terminal shows of a case.
struct Shown {
  const char *heading, *path;
  double factor;
  int width, digits;
};
constexpr Shown kShown[] = {{"p_max MPa", "/contact/p_max_Pa", 1e-6, 9, 1},
                            {"q_max MPa", "/contact/q_max_Pa", 1e-6, 9, 1},
                            {"area mm²", "/contact/patch_area_m2", 1e6, 8, 1},
                            {"slip %", "/contact/slip_area_fraction", 100, 6, 1},
                            {"creep 1e-3", "/contact/creepage_x", 1e3, 10, 3}};

void print_table(const std::vector<SweepCase>& cases, const std::vector<VariedKey>& keys) {
  std::vector<std::size_t> width;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    width.push_back(keys[k].key.size());
    for (const std::string& v : keys[k].values) width[k] = std::max(width[k], v.size());
    fmt::print("{:<{}}  ", keys[k].key, width[k]);
  }
  for (const Shown& s : kShown) fmt::print("  {:>{}}", s.heading, s.width);
  fmt::print("\n");
  for (const SweepCase& c : cases) {
    if (!c.done) continue;
    for (std::size_t k = 0; k < keys.size(); ++k) fmt::print("{:<{}}  ", c.values[k], width[k]);
    if (!c.summary.is_null())
      for (const Shown& s : kShown)
        fmt::print("{}", cell_text(column_value({s.heading, s.path, s.factor}, c.summary), s.width, s.digits));
    fmt::print("{}\n", c.fault.empty() ? "" : "  " + c.fault);
  }
}

nlohmann::ordered_json as_json(const std::vector<SweepCase>& cases, const std::vector<VariedKey>& keys,
                               const std::vector<ResultColumn>& columns) {
  auto out = nlohmann::ordered_json::array();
  for (const SweepCase& c : cases) {
    if (!c.done) continue;
    nlohmann::ordered_json row;
    for (std::size_t k = 0; k < keys.size(); ++k) row[keys[k].key] = c.values[k];
    for (const ResultColumn& column : columns) {
      const double v = column_value(column, c.summary);
      row[column.name] = std::isfinite(v) ? nlohmann::ordered_json(v) : nlohmann::ordered_json(nullptr);
    }
    row["fault"] = c.fault.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(c.fault);
    out.push_back(std::move(row));
  }
  return out;
}

}  // namespace

ExitCode command_sweep(const CommandOptions& options) {
  const std::vector<VariedKey> keys = parse_vary(options.vary);
  const LoadedCase base = load_case_of(options);
  std::vector<SweepCase> cases = load_cases(options, base, keys);
  InfluenceCache cache;
  BemOptions bem;
  bem.cell = cell_size(options.cell);
  bem.cache = &cache;
  const std::vector<ResultColumn> columns = result_columns(options.stresses);

  const std::filesystem::path out = output_folder_of(options, base, "-sweep");
  const FolderHold hold = prepare_output_folder(out, options.force);
  write_origin(out, base, options.command_line, options.threads);
  spdlog::info("{} cases; the table grows in {}", cases.size(), (out / "sweep.csv").string());
  SweepTable table(out / "sweep.csv", table_origin(base), keys, columns);
  solve_all(cases, bem, options.stresses, table, spdlog::default_logger()->level() <= spdlog::level::info);

  if (options.json)
    fmt::print("{}\n", as_json(cases, keys, columns).dump(2));
  else
    print_table(cases, keys);
  if (stop_flag()) {
    spdlog::warn("stopped; {} holds the first cases", (out / "sweep.csv").string());
    return ExitCode::interrupted;
  }
  const auto faults = std::count_if(cases.begin(), cases.end(), [](const SweepCase& c) { return !c.fault.empty(); });
  if (faults > 0) spdlog::warn("{} of {} cases failed: see the last column", faults, cases.size());
  return faults > 0 ? ExitCode::failed_checks : ExitCode::ok;
}

}  // namespace railstrata
