#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <mutex>
#include <optional>

#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/output_folder.hpp"
#include "app/progress.hpp"
#include "app/run_bem.hpp"
#include "app/stop_flag.hpp"
#include "app/sweep_plan.hpp"
#include "core/parallel.hpp"
#include "io/output_file.hpp"
#include "post/bem_summary.hpp"

namespace railstrata {
namespace {

struct SweepCase {
  std::vector<std::string> values;
  std::optional<LoadedCase> loaded;
  std::optional<Summary> summary;
  std::string fault;   ///< empty: all is well
  bool done = false;
};

struct Column {
  const char* name;
  double (*value)(const Summary&);
};
constexpr Column kContactColumns[] = {{"p_max_MPa", [](const Summary& s) { return 1e-6 * s.contact.p_max; }},
                                      {"q_max_MPa", [](const Summary& s) { return 1e-6 * s.contact.q_max; }},
                                      {"patch_length_mm", [](const Summary& s) { return 1e3 * s.contact.patch_length; }},
                                      {"patch_width_mm", [](const Summary& s) { return 1e3 * s.contact.patch_width; }},
                                      {"patch_area_mm2", [](const Summary& s) { return 1e6 * s.contact.patch_area; }},
                                      {"slip_area_fraction", [](const Summary& s) { return s.contact.slip_area_fraction; }},
                                      {"F_x_kN", [](const Summary& s) { return 1e-3 * s.contact.F_x; }},
                                      {"F_y_kN", [](const Summary& s) { return 1e-3 * s.contact.F_y; }},
                                      {"F_z_kN", [](const Summary& s) { return 1e-3 * s.contact.F_z; }},
                                      {"normal_force_kN", [](const Summary& s) { return 1e-3 * s.contact.normal_force; }},
                                      {"lateral_force_kN", [](const Summary& s) { return 1e-3 * s.contact.lateral_force; }},
                                      {"creepage_x", [](const Summary& s) { return s.contact.creepage_x; }},
                                      {"spin_per_m", [](const Summary& s) { return s.contact.spin_per_m; }},
                                      {"approach_um", [](const Summary& s) { return 1e6 * s.contact.approach; }},
                                      {"wall_s", [](const Summary& s) { return s.run.wall_s; }}};
double mises(const std::optional<StressPair>& p) { return p ? 1e-6 * p->von_mises.value : kNotApplicable; }
double sigma1(const std::optional<StressPair>& p) { return p ? 1e-6 * p->sigma1.value : kNotApplicable; }
constexpr Column kStressColumns[] = {{"rail_surface_von_mises_MPa", [](const Summary& s) { return mises(s.rail.surface); }},
                                     {"rail_surface_sigma_1_MPa", [](const Summary& s) { return sigma1(s.rail.surface); }},
                                     {"rail_subsurface_von_mises_MPa", [](const Summary& s) { return mises(s.rail.subsurface); }},
                                     {"rail_subsurface_von_mises_depth_mm", [](const Summary& s) { return s.rail.subsurface ? 1e3 * s.rail.subsurface->von_mises.depth : kNotApplicable; }},
                                     {"rail_layer_von_mises_MPa", [](const Summary& s) { return mises(s.rail.layer); }},
                                     {"rail_layer_sigma_1_MPa", [](const Summary& s) { return sigma1(s.rail.layer); }},
                                     {"rail_interface_von_mises_MPa", [](const Summary& s) { return mises(s.rail.interface); }},
                                     {"rail_matrix_von_mises_MPa", [](const Summary& s) { return mises(s.rail.matrix); }}};

std::vector<Column> columns_of(bool stresses) {
  std::vector<Column> out(std::begin(kContactColumns), std::end(kContactColumns));
  if (stresses) out.insert(out.end() - 1, std::begin(kStressColumns), std::end(kStressColumns));
  return out;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string fault_of(const CaseError& e) { return e.diagnostics.empty() ? first_line(e.what()) : first_line(e.diagnostics.front().message); }

/// Cases whose values are refused carry the fault; if all are, the first one's error goes to the user: a key that does not exist, most likely.
std::vector<SweepCase> load_cases(const CommandOptions& options, const LoadedCase& base, const std::vector<VariedKey>& keys) {
  std::vector<SweepCase> cases;
  std::optional<CaseError> first_error;
  bool any = false;
  for (std::vector<std::string>& values : combinations(keys)) {
    std::vector<std::string> overrides = options.overrides;
    for (std::size_t k = 0; k < keys.size(); ++k) overrides.push_back(keys[k].key + "=" + values[k]);
    cases.push_back({std::move(values), {}, {}, {}, false});
    try {
      cases.back().loaded = parse_case(base.source_text, base.file, overrides);
      any = true;
    } catch (const CaseError& e) {
      cases.back().fault = fault_of(e);
      if (!first_error) first_error = e;
    }
  }
  if (!any) throw *first_error;
  return cases;
}

void solve(SweepCase& c, const BemOptions& bem, bool stresses) {
  if (!c.loaded) return;
  try {
    const CaseSpec spec = half_space_case(c.loaded->spec);
    const BemResult result = solve_bem(spec, place(spec, c.loaded->folder()), bem);
    c.summary = bem_contact_summary(spec, result);
    if (stresses) c.summary->rail = bem_rail_stress(result, c.summary->contact);
    for (const Check& k : c.summary->checks)
      if (!k.ok) c.fault = "check failed: " + k.name;
  } catch (const CaseError& e) {
    c.fault = fault_of(e);
  } catch (const std::exception& e) {
    c.fault = first_line(e.what());
  }
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

/// sweep.csv, which grows in the order of the cases, whatever the order in which they end.
class SweepTable {
 public:
  SweepTable(const std::filesystem::path& file, const std::vector<std::string>& origin, const std::vector<VariedKey>& keys, std::vector<Column> columns)
      : file_(file), columns_(std::move(columns)) {
    std::string head;
    for (const std::string& line : origin) head += "# " + line + '\n';
    for (const VariedKey& k : keys) head += k.key + ',';
    for (const Column& c : columns_) head += std::string(c.name) + ',';
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
    auto to = std::back_inserter(out);
    for (const std::string& v : c.values) fmt::format_to(to, "{},", v.find('"') == std::string::npos ? v : quoted(v));
    for (const Column& column : columns_) {
      const double v = c.summary ? column.value(*c.summary) : kNotApplicable;
      if (std::isfinite(v)) fmt::format_to(to, "{}", v);
      out += ',';
    }
    return out + (c.fault.empty() ? "" : quoted(c.fault)) + '\n';
  }
  OutputFile file_;
  std::vector<Column> columns_;
  std::size_t written_ = 0, done_ = 0;
};

/// Cases side by side, one thread each: their grids are too small to share one.
void solve_all(std::vector<SweepCase>& cases, const BemOptions& bem, bool stresses, SweepTable& table, bool shown) {
  Progress progress("sweep", shown);
  std::mutex writing;
  std::exception_ptr failure;
  for_each(static_cast<std::ptrdiff_t>(cases.size()), [&](std::ptrdiff_t i) {
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
  }, true);
  if (failure) std::rethrow_exception(failure);
}

std::string cell_text(double v, int width, int digits) { return std::isfinite(v) ? fmt::format("  {:>{}.{}f}", v, width, digits) : fmt::format("  {:>{}}", "-", width); }

void print_table(const std::vector<SweepCase>& cases, const std::vector<VariedKey>& keys) {
  std::vector<std::size_t> width;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    width.push_back(keys[k].key.size());
    for (const std::string& v : keys[k].values) width[k] = std::max(width[k], v.size());
    fmt::print("{:<{}}  ", keys[k].key, width[k]);
  }
  fmt::print("  {:>9}  {:>9}  {:>8}  {:>6}  {:>10}\n", "p_max MPa", "q_max MPa", "area mm²", "slip %", "creep 1e-3");
  for (const SweepCase& c : cases) {
    if (!c.done) continue;
    for (std::size_t k = 0; k < keys.size(); ++k) fmt::print("{:<{}}  ", c.values[k], width[k]);
    if (c.summary) {
      const ContactSummary& s = c.summary->contact;
      fmt::print("{}{}{}{}{}", cell_text(1e-6 * s.p_max, 9, 1), cell_text(1e-6 * s.q_max, 9, 1), cell_text(1e6 * s.patch_area, 8, 1), cell_text(100 * s.slip_area_fraction, 6, 1),
                 cell_text(1e3 * s.creepage_x, 10, 3));
    }
    fmt::print("{}\n", c.fault.empty() ? "" : "  " + c.fault);
  }
}

nlohmann::ordered_json as_json(const std::vector<SweepCase>& cases, const std::vector<VariedKey>& keys, const std::vector<Column>& columns) {
  auto out = nlohmann::ordered_json::array();
  for (const SweepCase& c : cases) {
    if (!c.done) continue;
    nlohmann::ordered_json row;
    for (std::size_t k = 0; k < keys.size(); ++k) row[keys[k].key] = c.values[k];
    for (const Column& column : columns) {
      const double v = c.summary ? column.value(*c.summary) : kNotApplicable;
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
  const std::vector<Column> columns = columns_of(options.stresses);

  const std::filesystem::path out = output_folder_of(options, base, "-sweep");
  prepare_output_folder(out, options.force);
  write_origin(out, base, options.command_line, options.threads);
  spdlog::info("{} cases; the table grows in {}", cases.size(), (out / "sweep.csv").string());
  SweepTable table(out / "sweep.csv", table_origin(base), keys, columns);
  solve_all(cases, bem, options.stresses, table, spdlog::default_logger()->level() <= spdlog::level::info);

  if (options.json) fmt::print("{}\n", as_json(cases, keys, columns).dump(2));
  else print_table(cases, keys);
  if (stop_flag()) {
    spdlog::warn("stopped; {} holds the first cases", (out / "sweep.csv").string());
    return ExitCode::interrupted;
  }
  const auto faults = std::count_if(cases.begin(), cases.end(), [](const SweepCase& c) { return !c.fault.empty(); });
  if (faults > 0) spdlog::warn("{} of {} cases failed: see the last column", faults, cases.size());
  return faults > 0 ? ExitCode::failed_checks : ExitCode::ok;
}

}  // namespace railstrata
