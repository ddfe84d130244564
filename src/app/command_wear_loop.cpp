#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

#include <nlohmann/json.hpp>

#include "app/case_of.hpp"
#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "app/control.hpp"
#include "app/option_values.hpp"
#include "case/load_rows.hpp"
#include "case/units.hpp"
#include "core/faults.hpp"
#include "geometry/profile_texts.hpp"
#include "io/csv.hpp"
#include "io/json_text.hpp"
#include "io/output_file.hpp"
#include "io/output_folder.hpp"
#include "many/collective_files.hpp"
#include "study/wear_loop.hpp"
#include "study/wear_loop_page.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

constexpr const char *kWearTable = "wear_loop.csv", *kLoads = "wear_loads.csv", *kUnworn = "unworn.csv";
constexpr const char* kWearIdentity = "wear_loop.id";  // of the case, for --resume
constexpr const char* kPage = "report.html";
constexpr const char* kStepFiles[] = {"rail_profile.csv", "rail_profile.prr", "rail_profile.ban", "collective.csv",
                                      "rail_damage.csv"};
const std::vector<std::string> kNames{"step",     "passages",  "deepest_of_step_um", "worn_area_mm2",  "area_error",
                                      "gauge_mm", "p_max_MPa", "t_gamma_max_N",      "rail_y_first_mm"};

/// One step as a row of the table.
std::vector<double> row_of(const WearStep& step, double area_before) {
  double pressure = 0, t_gamma = 0;
  for (const CollectiveRow& row : step.rows) {
    pressure = std::max(pressure, row.summary.contact.patch.p_max);
    t_gamma = std::max(t_gamma, row.summary.damage.t_gamma);
  }
  const CollectiveRow& first = step.rows.front();
  return {static_cast<double>(step.rail.step),
          step.rail.passages,
          1e6 * step.deepest,
          1e6 * step.rail.area,
          (step.rail.area - area_before) / step.wanted_area - 1,
          1e3 * step.gauge,
          1e-6 * pressure,
          t_gamma,
          1e3 * model_to_rail(first.track, first.patches.front().contact.point).y};
}

std::string step_name(int step) { return fmt::format("step_{:04}", step); }

double depth_option(const std::string& text) {
  try {
    const double depth = parse_quantity(text, dimension::kLength);
    if (depth > 0 && depth <= 1e-3) return depth;
  } catch (const UnitError& e) {
    throw CaseError(fmt::format("--max-wear {}: {}", text, e.what()), e.remedy);
  }
  throw CaseError(fmt::format("--max-wear {}: must be above 0 and at most 1 mm", text), "take e.g. \"0.05 mm\"");
}

std::string whole_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The loop of one folder.
class WearLoopRun {
 public:
  WearLoopRun(const CommandOptions& options, LoadedCase loaded)
      : options_(options),
        loaded_(std::move(loaded)),
        out_(output_folder_of(options, loaded_, "-wear-loop")),
        original_(place(loaded_.spec, loaded_.folder())) {
    step_.collective.bem.cell = cell_size(options.cell);
    step_.collective.bem.cache = &cache_;
    step_.collective.shakedown = false;
    step_.collective.control = &control_by_signals();
    step_.max_wear = depth_option(options.wear_loop.max_wear);
    rail_ = unworn(original_, step_.collective.bem.cell);
    plan_collective(loaded_.spec);
    require_apart(out_, loaded_);
  }

  ExitCode run() {
    const FolderHold hold = prepare_output_folder(out_, options_.force || options_.wear_loop.resume);
    remove_parts(out_, PartsOf::dead);
    options_.wear_loop.resume ? resume() : begin();
    while (!finished())
      if (!take_step()) return interrupted();
    spdlog::info("{:.6g} passages in {} steps, {:.4g} mm² worn off; the worn rail: {}", rail_.passages, rail_.step,
                 1e6 * rail_.area, rail_.file.string());
    if (options_.json) print_json();
    write_page();
    return ExitCode::ok;
  }

 private:
  void begin() {
    remove_old_steps();
    write_origin(out_, loaded_, options_.command_line, options_.threads);
    write_whole_file(out_ / kWearIdentity, case_identity(loaded_) + "\n");
    write_worn_profile(out_ / kUnworn, table_origin(loaded_), rail_.points);
    write_table();
  }

  void resume() {
    if (whole_text(out_ / kWearIdentity) != case_identity(loaded_) + "\n")
      throw CaseError(fmt::format("{}: no wear loop of this very case", out_.string()),
                      "give the case and the --set of its beginning, or another --out without --resume");
    const CsvTable table = read_csv(out_ / kWearTable);
    for (std::size_t i = 0; i < table.rows(); ++i) {
      table_.emplace_back();
      for (const std::string& name : kNames) table_.back().push_back(table.column(name).at(i));
    }
    if (table_.empty()) return;
    rail_.step = static_cast<int>(table_.back()[0]);
    rail_.passages = table_.back()[1];
    rail_.area = 1e-6 * table_.back()[3];
    rail_.file = out_ / step_name(rail_.step) / kStepFiles[0];
    rail_.points = read_worn_profile(rail_.file);
    if (fs::exists(out_ / kLoads)) loads_ = read_wear_loads(out_ / kLoads);
  }

  /// Nothing of an older loop stands beside the steps of this one.
  void remove_old_steps() const {
    std::error_code ignored;
    for (int step = 1; fs::is_directory(out_ / step_name(step), ignored); ++step)
      for (const char* name : kStepFiles) {
        fs::remove(out_ / step_name(step) / name, ignored);
        if (fs::is_empty(out_ / step_name(step), ignored)) fs::remove(out_ / step_name(step), ignored);
      }
    for (const char* name : {kPage, kLoads}) fs::remove(out_ / name, ignored);
  }

  bool finished() const {
    const WearLoopOptions& w = options_.wear_loop;
    return (w.steps > 0 && rail_.step >= w.steps) || (w.passages > 0 && rail_.passages >= w.passages * (1 - 1e-12));
  }

  /// False: stopped before it was whole.
  bool take_step() {
    if (control().stop) return false;
    const double wanted = options_.wear_loop.passages;
    step_.passages_left = wanted > 0 ? wanted - rail_.passages : 0;
    WearStep step = wear_step(loaded_.spec, loaded_.folder(), original_, rail_, step_);
    if (step.stopped) return false;
    const fs::path folder = out_ / step_name(step.rail.step);
    make_folder(folder);
    step.rail.file = folder / kStepFiles[0];
    write_worn_profile(step.rail.file, table_origin(loaded_), step.rail.points);
    write_exchange_profiles(folder, step.rail);
    write_collective_table(folder / "collective.csv", table_origin(loaded_), step.rows);
    write_rail_damage(folder / "rail_damage.csv", table_origin(loaded_), step.damage);
    for (const WearLoad& load : wear_loads(step, rail_.passages)) loads_.push_back(load);
    write_wear_loads(out_ / kLoads, table_origin(loaded_), loads_);
    table_.push_back(row_of(step, rail_.area));
    write_table();
    tell(step);
    rail_ = std::move(step.rail);
    rail_.points = read_worn_profile(rail_.file);  // as --resume has them
    return true;
  }

  /// A jump of the contact shows a step that is too long: wear of that depth moves it further than it can follow.
  void warn_of_jump() const {
    constexpr double kJump = 0.2;
    if (table_.size() < 2) return;
    const double before = table_[table_.size() - 2][6], now = table_.back()[6];
    if (std::abs(now / before - 1) > kJump)
      spdlog::warn(
          "step {}: the largest pressure jumped from {:.0f} to {:.0f} MPa: the steps are too long, profiles "
          "from here on are not to be trusted; start anew with a smaller --max-wear",
          table_.back()[0], before, now);
  }

  void tell(const WearStep& step) const {
    const std::vector<double>& r = table_.back();
    warn_of_jump();
    spdlog::info("step {}: {:.4g} passages, deepest {:.3g} µm, {:.4g} mm² in all, p_max {:.0f} MPa", step.rail.step,
                 r[1], r[2], r[3], r[6]);
  }

  void write_table() const {
    std::vector<CsvColumn> columns;
    for (const std::string& name : kNames) columns.push_back({name, {}});
    for (const std::vector<double>& row : table_)
      for (std::size_t k = 0; k < row.size(); ++k) columns[k].values.push_back(row[k]);
    write_csv(out_ / kWearTable, table_origin(loaded_), columns);
  }

  /// The worn rail for other programs.
  void write_exchange_profiles(const fs::path& folder, const WornRail& rail) const {
    const std::string remark = fmt::format("{}, {:.6g} passages", loaded_.spec.title, rail.passages);
    write_whole_file(folder / "rail_profile.prr", simpack_text(ProfileKind::rail, rail.points, remark));
    write_whole_file(folder / "rail_profile.ban", miniprof_text(ProfileKind::rail, rail.points, remark));
  }

  void print_json() const {
    const nlohmann::ordered_json end{{"steps", rail_.step},
                                     {"passages", rail_.passages},
                                     {"worn_area_m2", rail_.area},
                                     {"rail_profile", rail_.file.string()}};
    fmt::print("{}\n", json_text(end, 2));
  }

  /// What the folder holds, as a page.
  void write_page() const {
    if (!options_.page || table_.empty()) return;
    WearLoopStory story;
    story.title = loaded_.spec.title;
    for (std::size_t i = 0; i < loaded_.spec.loads.size(); ++i) story.loads.push_back(load_name(loaded_.spec, i));
    story.unworn = read_worn_profile(out_ / kUnworn);
    for (const std::vector<double>& row : table_) {
      const int step = static_cast<int>(row[0]);
      story.profiles.push_back(
          {step, row[1], 1e-6 * row[3], read_worn_profile(out_ / step_name(step) / kStepFiles[0])});
    }
    story.contacts = loads_;
    write_wear_loop_page(out_ / kPage, story);
    spdlog::info("everything on one page: {}", (out_ / kPage).string());
  }

  ExitCode interrupted() const {
    write_page();
    spdlog::warn("stopped after step {}; what is done is in {}: go on with --resume", rail_.step, out_.string());
    return ExitCode::interrupted;
  }

  const CommandOptions& options_;
  LoadedCase loaded_;
  fs::path out_;
  Placement original_;
  InfluenceCache cache_;
  WearStepOptions step_;
  WornRail rail_;
  std::vector<std::vector<double>> table_;
  std::vector<WearLoad> loads_;
};

ExitCode command_wear_loop(const CommandOptions& options) {
  if (options.wear_loop.steps == 0 && options.wear_loop.passages == 0)
    throw CaseError("wear-loop: how far?", "give --steps 10, or --passages 2e6, or both");
  return WearLoopRun(options, load_half_space_case_of(options)).run();
}

void declare_wear_loop(CLI::App& sub, CommandOptions& options) {
  add_case(sub, options);
  add_output(sub, options, "results/<case name>-wear-loop");
  add_cell(sub, options);
  sub.add_option("--steps", options.wear_loop.steps, "End after so many steps")->check(CLI::Range(1, 9999));
  sub.add_option("--passages", options.wear_loop.passages, "End after so many passages of the whole collective")
      ->check(CLI::Range(1.0, 1e15))
      ->check(finite());
  sub.add_option("--max-wear", options.wear_loop.max_wear, "Depth at the deepest place in one step")
      ->capture_default_str();
  sub.add_flag("--resume", options.wear_loop.resume, "Go on with the loop of the folder where it stopped");
  add_no_report(sub, options);
}

}  // namespace

const Command kWearLoopCommand{
    "wear-loop",
    "Wear of the case's load collective taken off the rail's profile, step by step: the worn profiles, and how the "
    "contact changes",
    "Examples:\n  railstrata wear-loop cases/collective/mixed_traffic.toml --steps 10\n  railstrata wear-loop "
    "cases/collective/mixed_traffic.toml --passages 1e5 --max-wear \"0.002 mm\" --out results/worn\n  railstrata "
    "wear-loop cases/collective/mixed_traffic.toml --passages 2e5 --out results/worn --resume\n\nCtrl-C: nothing of "
    "the step under way is kept, everything before is.\n",
    declare_wear_loop, command_wear_loop};

}  // namespace railstrata
