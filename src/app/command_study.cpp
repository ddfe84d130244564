#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "app/control.hpp"
#include "app/mpi_ranks.hpp"
#include "app/option_values.hpp"
#include "app/progress.hpp"
#include "app/shipped_files.hpp"
#include "app/study_list.hpp"
#include "core/faults.hpp"
#include "io/json_text.hpp"
#include "runs/device_at_hand.hpp"
#include "runs/write_report.hpp"
#include "study/study_folder.hpp"
#include "study/study_page.hpp"
#include "study/study_results.hpp"
#include "study/study_run.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

LoadedStudy study_of(const CommandOptions& options) {
  fs::path file = shipped_unless_there(options.case_file);
  if (fs::is_directory(file) && fs::exists(file / "study.toml")) file /= "study.toml";
  return load_study(file);
}

fs::path folder_of(const CommandOptions& options, const LoadedStudy& study) {
  if (!options.out.empty()) return options.out;
  const fs::path file = fs::absolute(study.file).lexically_normal();
  return fs::path("results") /
         (file.stem() == "study" ? file.parent_path().filename().string() + "-study" : file.stem().string());
}

/// Less than a second would hold living ones for dead: their renewals are tenths of it.
double lease_of(const CommandOptions& options) {
  const double lease = wall_time("--lease", options.study.lease);
  if (lease < 1)
    throw CaseError(fmt::format("--lease {}: too short", options.study.lease), "one second or more; minutes, usually");
  return lease;
}

void print_list(const std::vector<StudyRow>& rows, bool json) {
  if (json) {
    auto all = nlohmann::ordered_json::array();
    for (const StudyRow& r : rows) {
      nlohmann::ordered_json values = nlohmann::ordered_json::object(), numbers = nlohmann::ordered_json::object();
      for (const auto& [key, text] : r.study_case->values) values[key] = text;
      for (const auto& [name, v] : r.numbers)
        numbers[name] = std::isfinite(v) ? nlohmann::ordered_json(v) : nlohmann::ordered_json(nullptr);
      all.push_back({{"group", r.study_case->group},
                     {"case", r.study_case->name},
                     {"engine", r.study_case->engine},
                     {"values", values},
                     {"folder", r.study_case->folder.generic_string()},
                     {"state", r.state},
                     {"fault", r.fault.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(r.fault)},
                     {"numbers", numbers}});
    }
    fmt::print("{}\n", json_text(all, 2));
    return;
  }
  std::size_t width = 4;
  for (const StudyRow& r : rows) width = std::max(width, r.study_case->group.size() + 1 + r.study_case->name.size());
  fmt::print("{:<{}}  {:<6}  {:<6}  {:>9}  {:>9}  {:>9}  {:>6}\n", "case", width, "engine", "state", "p_max MPa",
             "q_max MPa", "area mm²", "slip %");
  for (const StudyRow& r : rows) {
    const auto cell = [&](const char* name, double factor, int w) {
      for (const auto& [n, v] : r.numbers)
        if (n == name && std::isfinite(v)) return fmt::format("{:>{}.1f}", factor * v, w);
      return fmt::format("{:>{}}", "-", w);
    };
    fmt::print("{:<{}}  {:<6}  {:<6}  {}  {}  {}  {}{}\n", r.study_case->group + "/" + r.study_case->name, width,
               engine_word(r.study_case->engine), r.state, cell("p_max_MPa", 1, 9), cell("q_max_MPa", 1, 9),
               cell("patch_area_mm2", 1, 8), cell("slip_area_fraction", 100, 6), r.fault.empty() ? "" : "  " + r.fault);
  }
}

/// The rows of the cases that this call is to see to.
std::vector<StudyRow> rows_of(const std::vector<StudyRow>& all, const std::vector<bool>& ours) {
  std::vector<StudyRow> rows;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (ours[k]) rows.push_back(all[k]);
  return rows;
}

ExitCode list_cases(const CommandOptions& options, const fs::path& out, std::vector<StudyCase>& cases,
                    const std::vector<bool>& ours) {
  find_results(out, cases);
  const std::vector<StudyRow> rows = rows_of(study_rows(out, cases), ours);
  print_list(rows, options.json);
  spdlog::info("{} cases, {} to compute into {}", rows.size(),
               std::count_if(rows.begin(), rows.end(), [](const StudyRow& r) { return r.state != "done"; }),
               out.string());
  return ExitCode::ok;
}

/// --list and --batch.
ExitCode report_cases(const CommandOptions& options, const LoadedStudy& study, const fs::path& out,
                      std::vector<StudyCase>& cases, const std::vector<bool>& ours) {
  find_results(out, cases);
  const std::vector<StudyRow> rows = study_rows(out, cases);
  const std::vector<ListedCase> listed = listed_cases(rows, ours, study.spec.cell);
  options.study.list ? print_cases(listed, options, study.file, out) : print_batch(listed, options, study.file, out);
  return ExitCode::ok;
}

/// Half-spaces first: they show mistakes in seconds.
std::vector<const StudyCase*> cases_to_do(const fs::path& out, const std::vector<StudyCase>& cases,
                                          const std::vector<bool>& ours) {
  std::vector<const StudyCase*> to_do;
  for (std::size_t k = 0; k < cases.size(); ++k)
    if (ours[k] && !is_done(out, cases[k])) to_do.push_back(&cases[k]);
  std::stable_sort(to_do.begin(), to_do.end(),
                   [](const StudyCase* a, const StudyCase* b) { return a->engine < b->engine; });
  return to_do;
}

/// Before the first case: where a card is missing each of them would fail by itself.
void require_devices(const fs::path& out, std::vector<StudyCase>& cases, const std::vector<bool>& ours) {
  const auto asks = [](const StudyCase& c) {
    return c.engine == Engine::fem && c.loaded.spec.run.device != ComputeDevice::cpu;
  };
  if (std::none_of(cases.begin(), cases.end(), asks)) return;
  find_results(out, cases);
  for (const StudyCase* c : cases_to_do(out, cases, ours))
    if (asks(*c)) require_device(c->loaded);
}

/// Computes what is to do; study.csv follows every case that ends. Returns how many are left to other processes.
std::ptrdiff_t compute(const CommandOptions& options, const LoadedStudy& study, const fs::path& out,
                       const std::vector<StudyCase>& cases, const std::vector<bool>& ours, double lease) {
  const std::vector<const StudyCase*> to_do = cases_to_do(out, cases, ours);
  StudyRun run;
  run.out = out;
  run.cell = study.spec.cell;
  run.jobs = std::clamp(options.study.jobs > 0 ? options.study.jobs : options.threads, 1,
                        std::max(1, static_cast<int>(to_do.size())));
  run.threads = std::max(1, options.threads / run.jobs);
  run.control = &control();
  spdlog::info("{}: {} cases, {} of them to compute, {} at a time with {} thread{} each; results go to {}",
               study.spec.title, std::count(ours.begin(), ours.end(), true), to_do.size(), run.jobs, run.threads,
               run.threads == 1 ? "" : "s", out.string());
  run.ended = [&](const StudyCase& c, const std::string& fault, double seconds, int done) {
    if (fault.empty())
      control().info("{}/{}  {}: {}", done, to_do.size(), c.label(), duration_text(seconds));
    else
      control().warn("{}/{}  {} failed: {}", done, to_do.size(), c.label(), fault);
    write_study_table(out / "study.csv", study_origin(study), study_rows(out, cases));
  };
  run.lease = lease;
  run.wait = options.study.wait;
  const StudyRunEnd end = run_cases(run, to_do);
  control().progress("");
  if (end.elsewhere > 0) spdlog::info("{} more cases have been computed by other processes", end.elsewhere);
  for (const StudyCase* c : end.not_ours)
    if (const std::string owner = claimed_by(claim_file(out, *c)); !owner.empty())
      spdlog::info("{}: left to {}", c->label(), owner);
  return static_cast<std::ptrdiff_t>(end.not_ours.size());
}

/// Cases that had a result and have none now.
std::ptrdiff_t lost(const std::vector<StudyRow>& rows, std::ptrdiff_t left) {
  const std::ptrdiff_t to_do =
      std::count_if(rows.begin(), rows.end(), [](const StudyRow& r) { return r.state == "to do"; });
  if (to_do > left)
    spdlog::warn("{} results have been replaced meanwhile: another study, with other settings, writes into this folder",
                 to_do - left);
  return std::max<std::ptrdiff_t>(0, to_do - left);
}

/// Returns whether its verdict holds.
bool add_study_page(const fs::path& out, const LoadedStudy& study, const Published& published,
                    const std::vector<StudyRow>& rows) {
  if (std::none_of(rows.begin(), rows.end(), [](const StudyRow& r) { return r.state == "done"; })) return true;
  const fs::path page = out / "report.html";
  return write_page_or_warn(page, control(), [&] {
    return WrittenPage{write_study_page(page, study, published, rows), {}};
  });
}

ExitCode warn_of_faults(const std::vector<StudyRow>& rows) {
  const auto faults = std::count_if(rows.begin(), rows.end(), [](const StudyRow& r) { return !r.fault.empty(); });
  if (faults == 0) return ExitCode::ok;
  spdlog::warn("{} of {} cases failed or have a failed check: see the column fault", faults, rows.size());
  return ExitCode::failed_checks;
}

ExitCode command_study(const CommandOptions& options) {
  const LoadedStudy study = study_of(options);
  cell_size(study.spec.cell);  // what is wrong is reported before the first case
  const Published published = study.spec.published.empty() ? Published{} : load_published(study.spec.published);
  const Shard shard = parse_shard(options.study.shard);
  const double lease = lease_of(options);
  std::vector<StudyCase> cases = plan_study(study, options.overrides);
  for (const std::string& key : varied_and_set(study, options.overrides))
    spdlog::warn("--set {}: the study varies it; cases named after its values have the one that is set", key);
  std::vector<bool> ours = chosen(study, cases, engine_of(options.study.engine), options.study.groups, shard);
  if (options.study.only > 0) ours = only(cases, options.study.only, ours);
  const fs::path out = folder_of(options, study);
  if (options.study.list || !options.study.batch.empty()) return report_cases(options, study, out, cases, ours);
  if (options.study.dry_run) return list_cases(options, out, cases, ours);

  require_case_processes();
  require_devices(out, cases, ours);
  start_children_alone();
  control_by_signals();  // what is claimed is given back
  const FolderHold hold =
      prepare_study_folder(out, study, options.command_line, options.overrides, options.threads, options.force);
  recover(out, cases, lease);
  find_results(out, cases);
  const std::ptrdiff_t left = compute(options, study, out, cases, ours, lease);

  const std::vector<StudyRow> rows = study_rows(out, cases);
  write_study_table(out / "study.csv", study_origin(study), rows);
  if (control().stop) {
    spdlog::warn("stopped; the same command goes on where it was");
    return ExitCode::interrupted;
  }
  const bool page_ok = !options.page || add_study_page(out, study, published, rows);
  const std::vector<StudyRow> our_rows = rows_of(rows, ours);
  print_list(our_rows, options.json);
  spdlog::info("the table is {}", (out / "study.csv").string());
  const ExitCode code = warn_of_faults(our_rows);
  return page_ok && lost(our_rows, left) == 0 ? code : ExitCode::failed_checks;
}

void declare_study(CLI::App& sub, CommandOptions& options) {
  sub.add_option("study", options.case_file, "Study file, or a folder with study.toml")->required();
  add_set(sub, options, "Override a key in all cases: --set mesh.element_size=\"2 mm\"; once for each key");
  add_out(
      sub, options,
      "Folder for the results (default: results/<study name>); a study that is there already goes on where it stopped");
  sub.add_flag("--force", options.force, "Write into a folder that is not empty and holds no study");
  sub.add_option("--jobs", options.study.jobs, "Cases at a time; they share the threads (default: one thread a case)")
      ->check(CLI::Range(1, 1024));
  sub.add_option("--engine", options.study.engine, fmt::format("Only the cases of one engine: {}", engines_text()))
      ->check(CLI::IsMember(engine_words()));
  add_repeated(sub, "--group", options.study.groups, "NAME", "Only the cases of this group; once for each group");
  sub.add_option("--shard", options.study.shard,
                 "i/n: only every n-th case from the i-th on, for n machines that share the folder");
  auto* list = sub.add_flag("--list", options.study.list,
                            "List the cases with index, state and estimates of time and memory; compute nothing. With "
                            "--json also key and command");
  sub.add_option("--batch", options.study.batch,
                 "Print a job script for the cases to do, with time and memory from the estimates: slurm")
      ->check(CLI::IsMember({"slurm"}))
      ->excludes(list);
  sub.add_option("--only", options.study.only, "Only the case of this index, as --list counts")
      ->check(CLI::Range(1, 1000000));
  sub.add_flag_callback(
      "--no-wait", [&options] { options.study.wait = false; },
      "End when all that is left is being computed by other processes; else wait for it, and take over from "
      "those that die");
  sub.add_option("--lease", options.study.lease,
                 "A process that has not touched the claim of its case for so long is held for dead (by the clock of "
                 "the file server)")
      ->capture_default_str();
  sub.add_flag("--dry-run", options.study.dry_run, "List the cases and what is done of them; compute nothing");
  add_no_report(sub, options);
}

}  // namespace

const Command kStudyCommand{
    "study",
    "Many cases from one file, by both engines, several at a time; goes on where it stopped; a table and a page over "
    "all of them",
    "Examples:\n  railstrata study cases/paper/study.toml --dry-run\n  railstrata study cases/paper/study.toml "
    "--engine bem --out results/study\n  railstrata study cases/paper/study.toml --out results/study --jobs 2 "
    "--threads 2\n  railstrata study cases/paper/study.toml --out /shared/study --shard 3/8     # one of eight "
    "machines\n",
    declare_study,
    command_study,
    true};

}  // namespace railstrata
