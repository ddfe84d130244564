#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "app/case_list.hpp"
#include "app/case_of.hpp"
#include "app/common_options.hpp"
#include "app/control.hpp"
#include "bem/bem_options.hpp"
#include "clock/clock.hpp"
#include "clock/clock_files.hpp"
#include "clock/clock_state.hpp"
#include "collective/collective.hpp"
#include "collective/collective_errors.hpp"
#include "collective/collective_files.hpp"
#include "collective/life_files.hpp"
#include "collective/measured_wear.hpp"
#include "core/faults.hpp"
#include "core/printable.hpp"
#include "curving/curve_files.hpp"
#include "fatigue/row_strength.hpp"
#include "io/output_folder.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"
#include "runs/write_half_space_result.hpp"
#include "runs/write_report.hpp"
#include "traffic/range_files.hpp"
#include "traffic/traffic_page.hpp"
#include "traffic/traffic_range.hpp"
#include "wear/wear_loop_job.hpp"

namespace railstrata {
namespace {

constexpr const char* kRowFolder = "shown_load";

CollectiveOptions options_of(double cell, InfluenceCache& cache) {
  CollectiveOptions how;
  how.bem.cell = cell;
  how.bem.cache = &cache;
  how.control = &control_by_signals();
  return how;
}

void solve(const LoadedCase& loaded, const CollectiveOptions& how, std::vector<CollectiveRow>& rows) {
  solve_collective(rows, loaded.folder(), how);
  how.control->progress("");
}

/// The row that the page shows whole: with the least reserve, without strengths the one that rubs most.
const CollectiveRow* shown_row(const std::vector<CollectiveRow>& rows) {
  if (const CollectiveRow* worst = worst_row(rows)) return worst;
  const auto energy = [](const CollectiveRow& r) {
    return r.sound() ? r.passages * r.summary.damage.friction_energy : -1;
  };
  const auto most = std::max_element(
      rows.begin(), rows.end(), [&](const CollectiveRow& a, const CollectiveRow& b) { return energy(a) < energy(b); });
  return most->sound() ? &*most : nullptr;
}

/// The whole result of a row, in a folder of its own.
void write_row(const CommandOptions& options, const LoadedCase& loaded, const std::filesystem::path& folder,
               const CollectiveRow& row) {
  LoadedCase one = loaded;
  one.spec = row.spec;
  one.spec.title = fmt::format("{}: {}", loaded.spec.title, row.name);
  one.resolved_toml = resolved_case(one.spec);
  BemOptions bem;
  bem.cell = cell_size(options.cell);
  const Placement placement = place(one.spec, loaded.folder());
  const Answer answer = ask(one.spec, placement, {}, {.bem = bem});
  make_folder(folder);
  clear_old_results(folder);
  write_origin(folder, one, options.command_line, options.threads);
  write_half_space_result(folder, table_origin(one), one.spec, placement, answer);
}

/// Columns of a load on the terminal.
const std::vector<ListedNumber> kListed{{"passages", "passages", 1, 0},     {"F_z kN", "F_z_kN"},
                                        {"p_max MPa", "p_max_MPa", 1, 0},   {"T-gamma N", "t_gamma_N"},
                                        {"USFD nm", "usfd_depth_nm", 1, 2}, {"shakedown", "shakedown_wandering", 1, 3}};

/// `collective --until`.
struct TrafficOptions {
  std::string until;    ///< a mass
  bool range = false;   ///< a run for each end of what is not known
  bool resume = false;  ///< from the state that the folder has; of wear, too
};

/// The rail through its traffic, in a folder.
class Traffic {
 public:
  /// resume: from the state that the folder has.
  Traffic(const LoadedCase& loaded, std::filesystem::path folder, double cell, bool resume)
      : loaded_(loaded), folder_(std::move(folder)) {
    BemOptions bem;
    bem.cell = cell;
    bem.cache = &cache_;
    how_ = clock_options(loaded.spec, bem, &control_by_signals());
    how_.keep = [this](const ClockState& state) { keep(state); };
    identity_ = clock_identity(loaded, how_);
    if (resume)
      how_.begun = &begun_.emplace(read_clock_state(file(), identity_, how_.horizon));
    else
      std::filesystem::remove(file());
  }
  Traffic(const Traffic&) = delete;
  Traffic& operator=(const Traffic&) = delete;

  /// The rail's lives become those of the traffic. None: stopped.
  std::optional<TrafficRange> follow(bool range, CollectiveDamage& damage) {
    TrafficRange out;
    try {
      out = range ? run_range(loaded_.spec, loaded_.folder(), how_, control_by_signals())
                  : range_of({{"", "", run_clock(loaded_.spec, loaded_.folder(), how_)}}, {});
    } catch (const Interrupted&) {
      how_.control->progress("");
      warn_of_stop();
      return {};
    }
    how_.control->progress("");
    const ClockResult& best = out.runs.front().result;
    write_history(folder_ / kHistory, table_origin(loaded_), best);
    write_worn_rail(folder_ / kWornRail, table_origin(loaded_), best.profile);
    if (range) write_range(folder_ / "range.csv", table_origin(loaded_), out);
    std::vector<LifeRow>& rows = damage.lives.rows;
    std::erase_if(rows, [&](const LifeRow& row) {
      return std::any_of(out.lives.begin(), out.lives.end(), [&](const LifeRow& other) {
        return other.body == row.body && other.mechanism == row.mechanism;
      });
    });
    rows.insert(rows.begin(), out.lives.begin(), out.lives.end());
    damage.lives.curve = {};
    return out;
  }
  void warn_of_stop() const {
    if (std::filesystem::exists(file()))
      spdlog::warn("stopped; {} and {} hold the rail after its last whole stretch of traffic; go on with --resume",
                   (folder_ / kHistory).string(), kWornRail);
    else
      spdlog::warn("stopped before the traffic began; start it again with --force");
  }

 private:
  static constexpr const char *kHistory = "history.csv", *kWornRail = "worn_rail.csv";
  std::filesystem::path file() const { return folder_ / "traffic.cbor"; }
  void keep(const ClockState& state) {
    write_clock_state(file(), identity_, state);
    write_history(folder_ / kHistory, table_origin(loaded_), state.out);
    write_worn_rail(folder_ / kWornRail, table_origin(loaded_), state.surface.points);
  }

  const LoadedCase& loaded_;
  std::filesystem::path folder_;
  InfluenceCache cache_;
  ClockOptions how_;
  std::string identity_;
  std::optional<ClockState> begun_;
};

void print_collective(const std::vector<CollectiveRow>& rows, const std::vector<ReportAnswer>& answers,
                      const std::optional<MeasuredWear>& measured) {
  const CaseTable table = collective_table(rows);
  print_rows(joined(std::vector<CaseColumn>{{"load", [](const CaseRow& row) { return row.name; }}},
                    answer_columns(table.rows)),
             kListed, table.rows);
  for (const ReportAnswer& a : answers) fmt::print("{}: {}\n", a.title, printable(a.text));
  if (measured) fmt::print("Measured wear: {}\n", measured_text(*measured));
}

/// Returns whether the page's verdict holds, true without a page.
bool add_collective_page(const CommandOptions& options, const LoadedCase& loaded, const std::filesystem::path& out,
                         const std::vector<CollectiveRow>& rows, const CollectiveDamage& damage,
                         const CollectiveFront& front) {
  const CollectiveRow* shown = shown_row(rows);
  if (!shown) return true;
  const std::filesystem::path page = out / "report.html";
  write_row(options, loaded, out / kRowFolder, *shown);  // a full disk is an error: no command makes the page later
  const WrittenPage written{
      write_collective_page(page, loaded.spec.title, rows, damage, out / kRowFolder, shown->name, front), {}};
  report_page(written, control());
  spdlog::info("everything on one page: {}", page.string());
  return written.verdict.ok;
}

/// `collective --measured-before --measured-after --tonnes`.
struct MeasuredOptions {
  std::string before, after;  ///< files
  std::string tonnes;         ///< a mass
};

nlohmann::ordered_json traffic_json(const TrafficRange& traffic) {
  nlohmann::ordered_json out = history_json(traffic.runs.front().result);
  if (traffic.runs.size() > 1) out["range"] = range_json(traffic);
  return out;
}

/// The case with --until as its life.until.
LoadedCase case_until(CommandOptions options, const std::string& until) {
  if (!until.empty()) {
    mass_of("--until", until);
    options.overrides.push_back("life.until=" + until);
  }
  return load_case_of(options, uses::kCollective);
}

/// Of a case with a curve: where its wheelsets stand, listed too.
std::vector<BogieInCurve> solve_curve_of(const LoadedCase& loaded) {
  if (loaded.spec.collective.curve.bogies.empty()) return {};
  std::vector<BogieInCurve> out = solve_curve(loaded, &control());
  for (const std::string& line : curving_lines(out)) spdlog::info("{}", line);
  for (const BogieInCurve& bogie : out)
    if (!bogie.fault.empty()) spdlog::warn("{} is left out: {}", bogie.name, bogie.fault);
  return out;
}

/// With its bars.
CollectiveDamage damage_of(const LoadedCase& loaded, const std::vector<CollectiveRow>& rows, const Placement& placement,
                           const CollectiveOptions& how) {
  CollectiveDamage out{rail_damage(rows, placement, how.bem.cell), wheel_damage(rows, placement, how.bem.cell)};
  out.lives = collective_lives(loaded.spec, rows, out.rail, out.wheel);
  out.error = collective_errors(loaded.spec, rows, out, placement, loaded.folder(), how);
  how.control->progress("");
  return out;
}

/// bogies: that the loads of the case are of, for the tables.
ExitCode collective_of(const CommandOptions& options, const LoadedCase& loaded, const std::vector<BogieInCurve>& bogies,
                       const TrafficOptions& followed, const MeasuredOptions& wanted) {
  const double tonnes = wanted.before.empty() ? 0 : 1e-3 * mass_of("--tonnes", wanted.tonnes);
  const double horizon = tonnes > 0 ? 0 : loaded.spec.life.until;
  if ((followed.range || followed.resume) && !(horizon > 0))
    throw CaseError(fmt::format("{}: the rail is not followed", followed.range ? "--range" : "--resume"),
                    "give --until \"50 Mt\", or life.until in the case; of wear, step by step, --steps");
  std::vector<CollectiveRow> rows = plan_collective(loaded.spec);
  const double cell = cell_size(options.cell);
  const Placement placement = place(loaded.spec, loaded.folder());
  const std::filesystem::path out = output_folder_of(options, loaded, "-collective");
  require_apart(out, loaded);
  const FolderHold hold = prepare_output_folder(out, options.force || followed.resume);
  std::optional<Traffic> traffic;
  if (horizon > 0) traffic.emplace(loaded, out, cell, followed.resume);
  write_origin(out, loaded, options.command_line, options.threads);
  if (!bogies.empty()) write_curving(out / "curving.csv", table_origin(loaded), bogies);
  spdlog::info("{}: {} loads; results go to {}", loaded.spec.title, rows.size(), out.string());
  InfluenceCache cache;
  const CollectiveOptions how = options_of(cell, cache);
  solve(loaded, how, rows);
  write_collective_table(out / "collective.csv", table_origin(loaded), rows);
  if (control().stop) {
    spdlog::warn("stopped; {} holds the loads that were solved", (out / "collective.csv").string());
    if (traffic) traffic->warn_of_stop();
    return ExitCode::interrupted;
  }
  CollectiveDamage damage = damage_of(loaded, rows, placement, how);
  std::optional<TrafficRange> followed_to;
  CollectiveFront front;
  if (traffic) {
    followed_to = traffic->follow(followed.range, damage);
    if (!followed_to) return ExitCode::interrupted;
    if (damage.error.is_object()) damage.error["lives"] = nullptr;  // those of the traffic have none
    front = traffic_front({loaded.spec, rows, damage.rail, *followed_to, horizon, cell});
  }
  write_rail_damage(out / "rail_damage.csv", table_origin(loaded), damage.rail);
  write_wheel_damage(out / "wheel_damage.csv", table_origin(loaded), damage.wheel);
  write_lives(out / "life.csv", table_origin(loaded), damage.lives);
  nlohmann::ordered_json json = collective_json(loaded.spec.title, rows, damage);
  if (!bogies.empty()) json["curve"] = curving_json(bogies);
  if (followed_to) json["traffic"] = traffic_json(*followed_to);
  std::optional<MeasuredWear> measured;
  if (tonnes > 0) measured = measured_wear(rows, damage.rail, wanted.before, wanted.after, tonnes);
  if (measured) json["measured_wear"] = measured_json(*measured);
  write_whole_file(out / "collective.json", json_text(json, 2) + "\n");
  report_assumed(loaded, uses::kCollective);
  if (options.json)
    fmt::print("{}\n", json_text(json, 2));
  else
    print_collective(rows, traffic ? front.answers : collective_answers(rows, damage), measured);
  if (!bogies.empty()) front.tables.push_back(curving_table(bogies));
  const bool page_holds = !options.page || add_collective_page(options, loaded, out, rows, damage, front);
  const auto failed = faults(rows);
  if (failed > 0) spdlog::warn("{} of {} loads failed: see the last column", failed, rows.size());
  if (traffic && control().stop) return ExitCode::interrupted;
  return failed > 0 || !page_holds ? ExitCode::failed_checks : ExitCode::ok;
}

/// One collective, or of both rails of a curve one after the other, each in a folder of its own.
ExitCode command_collective(const CommandOptions& options, const TrafficOptions& followed,
                            const MeasuredOptions& wanted) {
  const LoadedCase loaded = case_until(options, followed.until);
  const std::vector<BogieInCurve> bogies = solve_curve_of(loaded);
  if (bogies.empty()) return collective_of(options, loaded, bogies, followed, wanted);
  if (loaded.spec.collective.curve.rail != CurveRail::both)
    return collective_of(options, with_curve_loads(loaded, bogies), bogies, followed, wanted);
  if (options.json)
    throw CaseError("--json has one result, and curve.rail = \"both\" asks for two",
                    "ask for one rail after the other");
  ExitCode worst = ExitCode::ok;
  for (const std::string rail : {"outer", "inner"}) {
    LoadedCase one = with_overrides(loaded, {fmt::format("curve.rail=\"{}\"", rail)});
    one.spec.title += fmt::format(", {} rail", rail);
    CommandOptions there = options;
    there.out = output_folder_of(options, loaded, "-collective") / rail;
    const ExitCode code = collective_of(there, with_curve_loads(one, bogies), bogies, followed, wanted);
    if (code == ExitCode::interrupted) return code;
    worst = std::max(worst, code);
  }
  return worst;
}

/// `collective --steps`: the wear taken off the rail's profile, step by step.
struct WearOptions {
  int steps = 0;                      ///< --steps; 0: no limit
  double passages = 0;                ///< --passages; 0: no limit
  std::string max_wear = "0.005 mm";  ///< --max-wear: a length
};

double depth_option(const std::string& text) {
  const double depth = length_of("--max-wear", text);
  if (depth > 0 && depth <= kMostWearOfOneProfile) return depth;
  throw CaseError(fmt::format("--max-wear {}: must be above 0 and at most 1 mm", text), "take e.g. \"0.05 mm\"");
}

ExitCode collective_wear(const WearOptions& wanted, bool resume, const CommandOptions& options) {
  LoadedCase loaded = load_case_of(options, uses::kWearLoop);
  if (const std::vector<BogieInCurve> bogies = solve_curve_of(loaded); !bogies.empty())
    loaded = with_curve_loads(loaded, bogies);
  const WearLoopOrder order{job_order_of(options, output_folder_of(options, loaded, "-wear-loop"), resume),
                            wanted.steps, wanted.passages, depth_option(wanted.max_wear), cell_size(options.cell)};
  return code_of(carry_out_wear_loop(std::move(loaded), order, control_by_signals(), [&](const WornRail& rail) {
    if (!options.json) return;
    const nlohmann::ordered_json end{{"steps", rail.step},
                                     {"passages", rail.passages},
                                     {"worn_area_m2", rail.area},
                                     {"rail_profile", rail.file.string()}};
    fmt::print("{}\n", json_text(end, 2));
  }));
}

CommandWork declare_collective(CLI::App& sub, CommandOptions& options) {
  const auto wear = std::make_shared<WearOptions>();
  const auto followed = std::make_shared<TrafficOptions>();
  add_case(sub, options);
  add_output(sub, options, "results/<case name>-collective, or -wear-loop");
  add_cell(sub, options);
  auto* steps = sub.add_option("--steps", wear->steps,
                               "Take the wear off the rail's profile step by step; end after so many steps");
  steps->check(CLI::Range(1, 9999));
  auto* passages = sub.add_option("--passages", wear->passages,
                                  "The same, to the end after so many passages of the whole collective");
  passages->check(CLI::Range(1.0, 1e15))->check(finite());
  auto* most = sub.add_option("--max-wear", wear->max_wear, "Of wear: depth at the deepest place in one step")
                   ->capture_default_str();
  sub.add_flag("--resume", followed->resume, "Of wear and --until: go on with the steps or the traffic of the folder");
  const auto measured = std::make_shared<MeasuredOptions>();
  auto* before = sub.add_option("--measured-before", measured->before,
                                "A measured profile of the rail: with the next two the wear factor of the line");
  auto* after = sub.add_option("--measured-after", measured->after, "The same place later");
  auto* tonnes = sub.add_option("--tonnes", measured->tonnes, "Gross traffic between them, e.g. \"20 Mt\"");
  for (auto* option : {before, after, tonnes})
    for (auto* other : {before, after, tonnes})
      if (option != other) option->needs(other);
  auto* traffic = sub.add_option("--until", followed->until,
                                 "Follow the rail through so much gross traffic: wear, grinding, strain and damage "
                                 "of the same metal on the profile of the day, e.g. \"50 Mt\"; not given: life.until");
  for (auto* other : std::initializer_list<CLI::Option*>{steps, passages, most, before}) traffic->excludes(other);
  sub.add_flag("--range", followed->range,
               "Of the rail that is followed: one more run for each end of what is not known (life.ductility_scatter "
               "and its neighbours), up to 11 in all; the lives have the range of all, and the answer names what "
               "decides");
  add_no_report(sub, options);
  return [=, &options] {
    if (*before && (*steps || *passages))
      throw CaseError("measured profiles belong to a collective without --steps", "leave --steps and --passages out");
    if (*steps || *passages) return collective_wear(*wear, followed->resume, options);
    if (*most)
      throw CaseError("--max-wear belongs to wear, step by step",
                      "give --steps 10, or --passages 2e6, or both with it");
    return command_collective(options, *followed, *measured);
  };
}

}  // namespace

extern const Command kCollectiveCommand{
    "collective",
    "All rows of the case's load collective by half-space theory, and what their passages do to the rail together: "
    "wear, rolling contact fatigue, shakedown, by position across it; with --steps or --passages the profile wears",
    "Examples:\n  railstrata collective cases/collective/mixed_traffic.toml\n  railstrata collective "
    "cases/collective/mixed_traffic.toml --set load.0.passages=1e6 --out results/more-freight\n  railstrata collective "
    "cases/collective/mixed_traffic.toml --passages 1e5 --max-wear \"0.002 mm\" --out results/worn\n  railstrata "
    "collective cases/collective/mixed_traffic.toml --passages 2e5 --out results/worn --resume\n\nCtrl-C: of a load, "
    "a step or a stretch of traffic under way nothing is kept, everything before it is.\n",
    declare_collective};

}  // namespace railstrata
