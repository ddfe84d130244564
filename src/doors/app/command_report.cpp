#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "app/common_options.hpp"
#include "app/control.hpp"
#include "bem/bem_options.hpp"
#include "core/engine.hpp"
#include "core/faults.hpp"
#include "core/printable.hpp"
#include "explore/page.hpp"
#include "io/folder_kind.hpp"
#include "io/output_folder.hpp"
#include "io/provenance.hpp"
#include "io/result_folder.hpp"
#include "record/csv.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"
#include "report/passes_page.hpp"
#include "report/pictures.hpp"
#include "report/report.hpp"
#include "result/compare.hpp"
#include "result/result_table.hpp"
#include "runs/write_report.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

struct ReportOptions {
  std::vector<fs::path> folders;
  bool reference = true;  ///< --no-reference: without the half-space solution beside a single result
  bool what_if = false;   ///< --what-if: with the explorer on the case
};

fs::path page_of(const ReportOptions& own, const CommandOptions& options) {
  fs::path page = options.out.empty() ? own.folders.front() / "report.html" : options.out;
  if (fs::is_directory(page)) page /= "report.html";
  return page;
}

/// Folders of `passes`, one or several beside each other.
bool of_passes(const std::vector<fs::path>& folders) {
  return std::all_of(folders.begin(), folders.end(),
                     [](const fs::path& folder) { return fs::exists(folder / "passes.json"); });
}

/// Cells of a half-space result [m], of the explorer's choice for others.
double cell_of(const ReportRun& run) {
  constexpr double kDigits = 1e9;  // of a patch file
  const ContactField& f = run.result.field;
  if (is_engine(run.result.engine, Engine::fem) || f.stations < 2) return BemOptions{}.cell;
  const double between = std::abs(f.x[static_cast<std::size_t>(f.columns)] - f.x[0]);
  return std::clamp(std::round(kDigits * between) / kDigits, kSmallestCell, kLargestCell);
}

/// The explorer on the case of the first result, to compare with that.
FramedPage what_if(const ReportOptions& options) {
  if (!options.what_if) return {};
  const fs::path& folder = options.folders.front();
  const fs::path file = case_file_of(folder);
  if (!fs::exists(file))
    throw CaseError(fmt::format("--what-if: there is no case in {}", folder.string()),
                    "put back case.toml of the run, or leave --what-if out");
  const fs::path as_given = folder.is_absolute() ? file : file.lexically_proximate(fs::current_path());
  const ReportRun run = read_report_run(folder);
  return what_if_page(load_case(file), as_given, cell_of(run), run);
}

void require_results(const std::vector<fs::path>& folders) {
  for (const fs::path& folder : folders)
    if (!fs::exists(folder / "summary.json")) throw CaseError(std::vector<Diagnostic>{no_result_here(folder)});
}

/// Returns whether the page's verdict holds.
bool write_page(const std::filesystem::path& page, const ReportOptions& own) {
  const WrittenPage written = write_report(page, own.folders, own.reference, what_if(own));
  if (own.what_if)
    spdlog::info("with the explorer: {:.1f} MB", 1e-6 * static_cast<double>(std::filesystem::file_size(page)));
  report_page(written, control());
  return written.verdict.ok;
}

struct Row {
  ResultColumn column;
  double a, b;         ///< SI
  double noise = 0;    ///< below it is what round-off leaves
  std::string of_a{};  ///< patch
  std::string of_b{};
  double shown(double v) const { return std::abs(v) <= noise ? 0 : v; }
  /// NaN where b is not above the noise.
  double relative() const {
    return std::abs(b) <= noise ? std::numeric_limits<double>::quiet_NaN() : (a - b) / std::abs(b);
  }
};

/// Two results, of either engine, on one grid: numbers and fields with their differences, relative to B.
struct FolderComparison {
  ResultFolder a, b;
  FieldComparison fields{};
  std::vector<Row> rows{};
};

std::size_t patches_of(const ResultFolder& r) { return 1 + r.further.size(); }

/// The part of the contact that a number belongs to: "patch", "patch 1 of 2", "2 patches".
std::string of_text(const ResultFolder& r, const ResultColumn& column) {
  const std::size_t patches = patches_of(r);
  if (patches == 1) return "patch";
  return column.of_all_patches ? fmt::format("{} patches", patches) : fmt::format("patch 1 of {}", patches);
}

double noise_of(const ResultFolder& r, const ResultNumber* n) {
  if (!n) return 0;
  return round_off_size(n->round_off, [&](std::string_view path) { return r.number(std::string(path)); });
}

/// The columns of tables that either result has, but for the time it took.
std::vector<Row> rows_of(const ResultFolder& a, const ResultFolder& b) {
  std::vector<Row> rows;
  for (const ResultColumn& c : table_columns()) {
    const double of_a = a.number(c.path), of_b = b.number(c.path);
    if (c.path.starts_with("/run/") || c.is_error_bar() || (std::isnan(of_a) && std::isnan(of_b))) continue;
    const ResultNumber* n = find_number(c.path);
    rows.push_back({c, of_a, of_b, std::max(noise_of(a, n), noise_of(b, n)), of_text(a, c), of_text(b, c)});
  }
  return rows;
}

/// y of the largest pressure, m.
double place_of(const ResultFolder& r) {
  return r.field.y[static_cast<std::size_t>(std::max_element(r.field.p.begin(), r.field.p.end()) - r.field.p.begin())];
}

/// Notes on differences that the table does not show.
std::vector<std::string> notes_of(const FolderComparison& c) {
  std::vector<std::string> out;
  for (const auto& [name, r] : {std::pair{"A", &c.a}, std::pair{"B", &c.b}})
    if (patches_of(*r) > 1)
      out.push_back(fmt::format(
          "{} touches at {} places: compared is the patch with the largest pressure (patch 1), but F_x, F_y "
          "and F_z are those of all",
          name, patches_of(*r)));
  const double apart = std::abs(place_of(c.a) - place_of(c.b)), width = c.a.number("/contact/patch_width_m");
  if (apart > 0.5 * width)
    out.push_back(
        fmt::format("the patches lie at different places: the largest pressure of A at y = {} mm, of B at y = {} mm "
                    "(model frame)",
                    fixed(1e3 * place_of(c.a), 1), fixed(1e3 * place_of(c.b), 1)));
  return out;
}

std::string number(double v, const char* format) {
  return std::isfinite(v) ? fmt::format(fmt::runtime(format), v) : "-";
}

void print_table(const FolderComparison& c) {
  const ResultFolder &a = c.a, &b = c.b;
  fmt::print("A  {} ({}): {}\nB  {} ({}): {}\n\n", printable(a.folder.string()), a.engine, printable(a.title),
             printable(b.folder.string()), b.engine, printable(b.title));
  const bool several = patches_of(a) > 1 || patches_of(b) > 1;
  fmt::print("  {:<36} {:>12} {:>12} {:>12}{}\n", "", "A", "B", "(A-B)/|B|", several ? "  of" : "");
  for (const Row& r : c.rows) {
    const Unit& unit = r.column.shown_unit;
    fmt::print("  {:<36} {:>12} {:>12} {:>12}{}\n",
               fmt::format("{}{}{}", r.column.title, unit.shown.empty() ? "" : ", ", unit.shown),
               number(unit.factor * r.shown(r.a), "{:.4g}"), number(unit.factor * r.shown(r.b), "{:.4g}"),
               number(100 * r.relative(), "{:+.2f} %"), several ? fmt::format("  A: {}, B: {}", r.of_a, r.of_b) : "");
  }
  const auto field = [](const char* name, const FieldDifference& d) {
    if (std::isfinite(d.rms))
      fmt::print("  {:<4} over the patch: rms {:.2f} %, largest {:.2f} % of B's maximum, at x {}, y {} mm\n", name,
                 100 * d.rms, 100 * d.largest, fixed(1e3 * d.x, 2), fixed(1e3 * d.y, 2));
  };
  fmt::print("\n");
  field("p", c.fields.p);
  field("|q|", c.fields.q);
}

nlohmann::ordered_json as_json(const FolderComparison& c) {
  const auto side = [](const ResultFolder& r) {
    return nlohmann::ordered_json{
        {"folder", r.folder.string()}, {"engine", r.engine}, {"title", r.title}, {"patches", patches_of(r)}};
  };
  const auto field = [](const FieldDifference& d) {
    return nlohmann::ordered_json{
        {"rms_relative", json_number(d.rms)}, {"largest_relative", json_number(d.largest)}, {"x_m", d.x}, {"y_m", d.y}};
  };
  nlohmann::ordered_json out{{"a", side(c.a)}, {"b", side(c.b)}};
  for (const Row& r : c.rows)
    out["numbers"][r.column.key()] = {{"a", json_number(r.a)},
                                      {"b", json_number(r.b)},
                                      {"relative_difference", json_number(r.relative())},
                                      {"of_a", r.of_a},
                                      {"of_b", r.of_b}};
  out["fields"] = {{"pressure", field(c.fields.p)}, {"traction", field(c.fields.q)}};
  out["notes"] = notes_of(c);
  return out;
}

std::string csv_text(const std::vector<Row>& rows) {
  std::string out = "quantity,a,b,relative_difference,of_a,of_b\n";
  for (const Row& r : rows) {
    const ResultColumn& c = r.column;
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{}\n", c.name, c.factor * r.a, c.factor * r.b, r.relative(),
                   r.of_a, r.of_b);
  }
  return out;
}

void write_fields(const fs::path& file, const std::vector<std::string>& origin, const FieldComparison& g) {
  struct Point {
    double x, y, p_a, p_b, q_a, q_b;
  };
  std::vector<Point> points;
  for (std::size_t k = 0; k < g.p_a.size(); ++k)
    points.push_back({g.x[k / g.y.size()], g.y[k % g.y.size()], g.p_a[k], g.p_b[k], g.q_a[k], g.q_b[k]});
  write_csv(file, origin, points,
            Columns<Point>{{"x", unit::kMillimetres, &Point::x},
                           {"y", unit::kMillimetres, &Point::y},
                           {"p_a", unit::kMPa, &Point::p_a},
                           {"p_b", unit::kMPa, &Point::p_b},
                           {"q_a", unit::kMPa, &Point::q_a},
                           {"q_b", unit::kMPa, &Point::q_b}});
}

FieldComparison compare_fields_of(const ResultFolder& a, const ResultFolder& b) {
  try {
    return compare_fields(a.field, b.field);
  } catch (const std::invalid_argument& e) {
    throw CaseError(fmt::format("{} and {} cannot be compared: {}", a.folder.string(), b.folder.string(), e.what()),
                    "compare folders that `railstrata run` or `railstrata bem` has written");
  }
}

std::string last_name(const fs::path& folder) {
  return fs::absolute(folder / "").lexically_normal().parent_path().filename().string();
}

/// results/<folder A>-against-<folder B>
fs::path comparison_folder(const fs::path& a, const fs::path& b) {
  return fs::path("results") / fmt::format("{}-against-{}", last_name(a), last_name(b));
}

/// Warns of doubts about either; throws CaseError for folders without results and for fields that do not compare.
FolderComparison compared(const fs::path& a, const fs::path& b) {
  FolderComparison out{read_result_folder(a), read_result_folder(b)};
  for (const ResultFolder* side : {&out.a, &out.b})
    for (const ResultDoubt& doubt : result_doubts(*side)) spdlog::warn("{}: {}", side->folder.string(), doubt.text);
  out.fields = compare_fields_of(out.a, out.b);
  out.rows = rows_of(out.a, out.b);
  return out;
}

/// compare.json, compare.csv, fields.csv and compare.svg.
void write_comparison(const fs::path& out, const FolderComparison& c) {
  const std::vector<std::string> origin{
      fmt::format("RailStrata {}", version_text()),
      fmt::format("a: {} ({}); b: {} ({})", c.a.folder.string(), c.a.engine, c.b.folder.string(), c.b.engine),
      "x from the axle in the rolling direction, y towards the field side; q: magnitude of the traction"};
  write_whole_file(out / "compare.json", json_text(as_json(c), 2) + "\n");
  write_whole_file(out / "compare.csv", csv_text(c.rows));
  write_fields(out / "fields.csv", origin, c.fields);
  write_whole_file(out / "compare.svg",
                   comparison_svg({"A: " + last_name(c.a.folder) + " (" + c.a.engine + ")", c.a.field},
                                  {"B: " + last_name(c.b.folder) + " (" + c.b.engine + ")", c.b.field}, c.fields));
}

/// The table, or compare.json, on standard output.
void print_comparison(const FolderComparison& c, bool json) {
  if (json)
    fmt::print("{}\n", json_text(as_json(c), 2));
  else
    print_table(c);
  for (const std::string& note : notes_of(c)) spdlog::info("{}", note);
}

/// Of two folders, unless --out names a page: a folder with tables of their differences, and the page on both.
ExitCode compare(const ReportOptions& own, const CommandOptions& options) {
  const fs::path &a = own.folders[0], &b = own.folders[1];
  const FolderComparison comparison = compared(a, b);
  const fs::path out = options.out.empty() ? comparison_folder(a, b) : options.out;
  const FolderHold hold = prepare_output_folder(out, options.force);
  write_comparison(out, comparison);
  print_comparison(comparison, options.json);
  const bool ok = !options.page || write_page(out / "report.html", own);
  spdlog::info("results are in {}", out.string());
  return ok ? ExitCode::ok : ExitCode::failed_checks;
}

ExitCode write_alone(const ReportOptions& own, const CommandOptions& options, bool passes) {
  if (own.folders.size() > 1 && options.out.empty())
    throw CaseError(
        fmt::format("{} folders are given and no --out: a page on one folder goes into it, a page on several could go "
                    "into any of them",
                    own.folders.size()),
        "say where the page is to be written, e.g. --out comparison.html");
  const fs::path page = page_of(own, options);
  require_name_of_page(page, "report.html");
  if (!options.out.empty() && !options.force && fs::exists(page))
    throw CaseError(fmt::format("--out {}: there is a file of this name", page.string()),
                    "choose another name, or replace it with --force");
  if (passes && own.what_if)
    throw CaseError("--what-if: the page of passes has no explorer", "leave it out, or give a folder of run or bem");
  if (!passes) require_results(own.folders);
  if (page.has_parent_path()) make_folder(page.parent_path());
  if (passes) write_passes_page(page, own.folders);
  const bool ok = passes || write_page(page, own);
  if (options.json) fmt::print("{}\n", json_text(nlohmann::json{{"report", page.generic_string()}}));
  spdlog::info("the report is {}", page.string());
  return ok ? ExitCode::ok : ExitCode::failed_checks;
}

ExitCode command_report(const ReportOptions& own, const CommandOptions& options) {
  const bool passes = of_passes(own.folders), page = is_page_name(options.out);
  return own.folders.size() == 2 && !passes && !page ? compare(own, options) : write_alone(own, options, passes);
}

CommandWork declare_report(CLI::App& sub, CommandOptions& options) {
  const auto own = std::make_shared<ReportOptions>();
  sub.add_option("folders", own->folders,
                 "Result folders of `run` or `bem`; of two, A and B, also tables of their differences, relative to B")
      ->required();
  add_out(sub, options,
          "The page to write, NAME.html (default: report.html in the folder, made anew if it is there); of two folders "
          "also a folder (default: results/<folder A>-against-<folder B>)");
  sub.add_flag("--force", options.force, "Replace the file or the folder's files that --out names");
  sub.add_flag_callback(
      "--no-reference", [own] { own->reference = false; },
      "Do not set a finite element result against its case on half-spaces and sections");
  sub.add_flag("--what-if", own->what_if,
               "Put the explorer on the case of the first folder into the page: some 1.1 MB more");
  sub.add_flag_callback(
      "--no-report", [&options] { options.page = false; }, "Of two folders: the tables without the page");
  return [own, &options] { return command_report(*own, options); };
}

}  // namespace

extern const Command kReportCommand{
    "report",
    "One page on a result, or on several side by side: verdict, patch, stresses, history; opens in any browser, "
    "without a network. Of two results, of either engine, also the differences of numbers and fields on one grid",
    "Examples:\n  railstrata report results/quick\n  railstrata report results/quick results/quick-bem\n  railstrata "
    "report results/thin results/thick --out thin-thick.html\n",
    declare_report};

}  // namespace railstrata
