#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <exception>
#include <memory>

#include <nlohmann/json.hpp>

#include "app/case_list.hpp"
#include "app/case_of.hpp"
#include "app/common_options.hpp"
#include "app/control.hpp"
#include "app/mpi_ranks.hpp"
#include "app/progress.hpp"
#include "app/shipped_files.hpp"
#include "ask/half_space_need.hpp"
#include "batch/batch_script.hpp"
#include "clock/wheel_life.hpp"
#include "core/engine.hpp"
#include "core/faults.hpp"
#include "fem/memory_need.hpp"
#include "record/escaped_text.hpp"
#include "record/json.hpp"
#include "record/this_process.hpp"
#include "runs/run_estimate.hpp"
#include "study/study_job.hpp"
#include "study/study_results.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

struct StudyOptions {
  int jobs = 0;                     ///< --jobs; 0: as many as threads
  std::string shard = "1/1";        ///< --shard
  std::string engine;               ///< --engine; empty: all
  std::vector<std::string> groups;  ///< --group; empty: all
  bool dry_run = false;             ///< --dry-run
  std::string lease = "5 min";      ///< --lease: a time
  bool list = false;                ///< --list
  std::string batch;                ///< --batch: the word of a batch system
  int only = 0;                     ///< --only: from 1; 0: all
  bool wait = true;                 ///< --no-wait: for cases that others compute
};

/// A case with its place in the list of all, from 1.
struct ListedCase {
  int index = 0;
  const StudyCase* study_case = nullptr;
  std::string state;
  CaseNeed need;  ///< of one that is to do
};

CaseNeed need_of(const StudyCase& c, const std::string& cell) {
  try {
    if (c.engine != Engine::fem) {
      const CaseSpec& spec = c.loaded.spec;
      const HalfSpaceNeed need = half_space_need(spec, place(spec, c.loaded.folder()), cell_size(cell));
      return {need.seconds, need.memory_bytes};
    }
    const Model model = build_model(c.loaded.spec, c.loaded.folder());
    return {estimate_run(model).seconds, memory_needed(model)};
  } catch (const std::exception& e) {  // the case will fail and report why
    spdlog::warn("{}: cannot be estimated: {}", c.label(), e.what());
    return {};
  }
}

std::string whole_path(const fs::path& path) { return fs::absolute(path).lexically_normal().string(); }

std::string command_of(const ListedCase& c, const CommandOptions& options, const fs::path& study, const fs::path& out) {
  std::vector<std::string> words{"railstrata", "study", whole_path(study), "--out", whole_path(out)};
  for (const std::string& o : options.overrides) words.insert(words.end(), {"--set", o});
  words.insert(words.end(), {"--only", fmt::format("{}", c.index), "--no-report"});
  std::transform(words.begin(), words.end(), words.begin(), shell_word);
  return fmt::format("{}", fmt::join(words, " "));
}

nlohmann::ordered_json as_json(const ListedCase& c, const CommandOptions& options, const fs::path& study,
                               const fs::path& out) {
  const StudyCase& s = *c.study_case;
  const auto known = [](double v) { return v > 0 ? nlohmann::ordered_json(v) : nlohmann::ordered_json(nullptr); };
  return {{"index", c.index},
          {"group", s.group},
          {"case", s.name},
          {"engine", engine_word(s.engine)},
          {"state", c.state},
          {"key", s.key},
          {"seconds", known(c.need.seconds)},
          {"memory_bytes", known(c.need.memory_bytes)},
          {"command", command_of(c, options, study, out)}};
}

/// These cases with what those to do are estimated to need: seconds for each by finite elements, since it is meshed
/// and its forces are timed on this machine. cell: of the half-spaces.
std::vector<ListedCase> listed_cases(const std::vector<StudyCase>& cases, const std::vector<CaseRow>& rows,
                                     const std::vector<bool>& ours, const std::string& cell) {
  std::vector<ListedCase> out;
  for (std::size_t k = 0; k < cases.size(); ++k)
    if (ours[k])
      out.push_back(
          {static_cast<int>(k) + 1, &cases[k], rows[k].state, rows[k].done() ? CaseNeed{} : need_of(cases[k], cell)});
  return out;
}

/// study: its file. --list: a case a line; with json an array, each of its lines an object.
void print_cases(const std::vector<ListedCase>& cases, const CommandOptions& options, const fs::path& study,
                 const fs::path& out) {
  if (options.json) {
    std::string text;
    for (const ListedCase& c : cases) text += (text.empty() ? "[" : ",\n") + as_json(c, options, study, out).dump();
    fmt::print("{}]\n", text.empty() ? "[" : text);
    return;
  }
  fmt::print("{:>5}  {:<6}  {:<6}  {:>12}  {:>9}  {}\n", "index", "engine", "state", "about", "memory MB", "case");
  for (const ListedCase& c : cases)
    fmt::print("{:>5}  {:<6}  {:<6}  {:>12}  {:>9}  {}/{}\n", c.index, engine_word(c.study_case->engine), c.state,
               c.need.seconds > 0 ? duration_text(c.need.seconds) : "-",
               c.need.memory_bytes > 0 ? fmt::format("{:.0f}", 1e-6 * c.need.memory_bytes) : "-", c.study_case->group,
               c.study_case->name);
}

/// --batch slurm: the script.
void print_batch(const std::vector<ListedCase>& cases, const StudyOptions& own, const CommandOptions& options,
                 const fs::path& study, const fs::path& out) {
  BatchJob job{.program = program_file().string(),
               .study = whole_path(study),
               .out = whole_path(out),
               .options = {},
               .threads = options.threads,
               .finite_elements = {},
               .half_spaces = false,
               .most = {}};
  for (const std::string& o : options.overrides) job.options.insert(job.options.end(), {"--set", o});
  for (const std::string& g : own.groups) job.options.insert(job.options.end(), {"--group", g});
  if (own.shard != "1/1") job.options.insert(job.options.end(), {"--shard", own.shard});
  double half_space_seconds = 0;
  for (const ListedCase& c : cases) {
    if (c.state == "done") continue;
    const bool fem = c.study_case->engine == Engine::fem;
    if (fem) job.finite_elements.push_back(c.index);
    job.half_spaces = job.half_spaces || !fem;
    half_space_seconds += fem ? 0 : c.need.seconds;
    job.most.seconds = std::max({job.most.seconds, half_space_seconds, c.need.seconds});
    const int at_once = fem ? 1 : options.threads;  // half-space cases, one a thread
    job.most.memory_bytes = std::max(job.most.memory_bytes, at_once * c.need.memory_bytes);
  }
  if (job.finite_elements.empty() && !job.half_spaces)
    spdlog::warn("every case has a result: there is nothing to submit");
  else
    fmt::print("{}", slurm_script(job));
}

fs::path folder_of(const CommandOptions& options, const LoadedStudy& study) {
  if (!options.out.empty()) return options.out;
  const fs::path file = fs::absolute(study.file).lexically_normal();
  return fs::path("results") /
         (file.stem() == "study" ? file.parent_path().filename().string() + "-study" : file.stem().string());
}

/// Less than a second would hold living ones for dead: their renewals are tenths of it.
double lease_of(const StudyOptions& own) {
  const double lease = wall_time("--lease", own.lease);
  if (lease < 1)
    throw CaseError(fmt::format("--lease {}: too short", own.lease), "one second or more; minutes, usually");
  return lease;
}

void print_list(const std::vector<CaseRow>& rows, bool json) {
  if (json) {
    auto all = nlohmann::ordered_json::array();
    for (const CaseRow& r : rows) {
      nlohmann::ordered_json values = nlohmann::ordered_json::object(), numbers = nlohmann::ordered_json::object();
      for (const auto& [key, text] : r.values) values[key] = text;
      for (const auto& [name, v] : r.numbers) numbers[name] = json_number(v);
      all.push_back({{"group", r.group},
                     {"case", r.name},
                     {"engine", r.engine},
                     {"values", values},
                     {"folder", r.folder.generic_string()},
                     {"state", r.state},
                     {"fault", r.fault.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(r.fault)},
                     {"numbers", numbers}});
    }
    fmt::print("{}\n", json_text(all, 2));
    return;
  }
  const std::vector<CaseColumn> head{
      {"case", [](const CaseRow& row) { return row.group + "/" + row.name; }},
      {"engine", [](const CaseRow& row) { return std::string(engine_word(row.engine)); }},
      {"state", [](const CaseRow& row) { return row.state; }}};
  print_rows(joined(head, answer_columns(rows)), telling_numbers(rows), rows);
}

ExitCode list_cases(const CommandOptions& options, const fs::path& out, std::vector<StudyCase>& cases,
                    const std::vector<bool>& ours) {
  find_results(out, cases);
  const std::vector<CaseRow> rows = rows_of(study_rows(out, cases), ours);
  print_list(rows, options.json);
  spdlog::info("{} cases, {} to compute into {}", rows.size(),
               std::count_if(rows.begin(), rows.end(), [](const CaseRow& r) { return r.state != "done"; }),
               out.string());
  return ExitCode::ok;
}

/// --list and --batch.
ExitCode report_cases(const StudyOptions& own, const CommandOptions& options, const LoadedStudy& study,
                      const fs::path& out, std::vector<StudyCase>& cases, const std::vector<bool>& ours) {
  find_results(out, cases);
  const std::vector<CaseRow> rows = study_rows(out, cases);
  const std::vector<ListedCase> listed = listed_cases(cases, rows, ours, study.spec.cell);
  own.list ? print_cases(listed, options, study.file, out) : print_batch(listed, own, options, study.file, out);
  return ExitCode::ok;
}

ExitCode command_study(const StudyOptions& own, const CommandOptions& options) {
  const LoadedStudy study = load_study(shipped_unless_there(options.case_file, "study.toml"));
  cell_size(study.spec.cell);  // what is wrong is reported before the first case
  const Shard shard = parse_shard(own.shard);
  const double lease = lease_of(own);
  std::vector<StudyCase> cases = plan_study(study, options.overrides);
  for (const std::string& key : varied_and_set(study, options.overrides))
    spdlog::warn("--set {}: the study varies it; cases named after its values have the one that is set", key);
  std::vector<bool> ours = chosen(study, cases, engine_of(own.engine), own.groups, shard);
  if (own.only > 0) ours = only(cases, own.only, ours);
  const fs::path out = folder_of(options, study);
  if (own.list || !own.batch.empty()) return report_cases(own, options, study, out, cases, ours);
  if (own.dry_run) return list_cases(options, out, cases, ours);

  StudyOrder order{job_order_of(options, out, false), options.overrides, own.jobs, lease, own.wait, life_of_wheels};
  start_children_alone();
  const auto show = [&](const std::vector<CaseRow>& rows) {
    print_list(rows, options.json);
    spdlog::info("the table is {}", (out / "study.csv").string());
  };
  return code_of(
      carry_out_study(study, std::move(cases), std::move(ours), std::move(order), control_by_signals(), show));
}

/// "fem (finite elements: …), bem (…)".
std::string engines_text() {
  std::string out;
  for (const EngineRow& row : kEngines)
    out += fmt::format("{}{} ({}: {})", out.empty() ? "" : ", ", row.word, row.title, row.about);
  return out;
}

CommandWork declare_study(CLI::App& sub, CommandOptions& options) {
  const auto own = std::make_shared<StudyOptions>();
  sub.add_option("study", options.case_file, "Study file, or a folder with study.toml")->required();
  add_set(sub, options, "Override a key in all cases: --set mesh.element_size=\"2 mm\"; once for each key");
  add_out(
      sub, options,
      "Folder for the results (default: results/<study name>); a study that is there already goes on where it stopped");
  sub.add_flag("--force", options.force, "Write into a folder that is not empty and holds no study");
  sub.add_option("--jobs", own->jobs, "Cases at a time; they share the threads (default: one thread a case)")
      ->check(CLI::Range(1, 1024));
  sub.add_option("--engine", own->engine, fmt::format("Only the cases of one engine: {}", engines_text()))
      ->check(CLI::IsMember(engine_words()));
  add_repeated(sub, "--group", own->groups, "NAME", "Only the cases of this group; once for each group");
  sub.add_option("--shard", own->shard,
                 "i/n: only every n-th case from the i-th on, for n machines that share the folder");
  auto* list = sub.add_flag("--list", own->list,
                            "List the cases with index, state and estimates of time and memory; compute nothing. With "
                            "--json also key and command");
  sub.add_option("--batch", own->batch,
                 "Print a job script for the cases to do, with time and memory from the estimates: slurm")
      ->check(CLI::IsMember({"slurm"}))
      ->excludes(list);
  sub.add_option("--only", own->only, "Only the case of this index, as --list counts")->check(CLI::Range(1, 1000000));
  sub.add_flag_callback(
      "--no-wait", [own] { own->wait = false; },
      "End when all that is left is being computed by other processes; else wait for it, and take over from "
      "those that die");
  sub.add_option("--lease", own->lease,
                 "A process that has not touched the claim of its case for so long counts as dead (by the clock of "
                 "the file server)")
      ->capture_default_str();
  sub.add_flag("--dry-run", own->dry_run, "List the cases and what is done of them; compute nothing");
  add_no_report(sub, options);
  return [own, &options] { return command_study(*own, options); };
}

}  // namespace

extern const Command kStudyCommand{
    "study",
    "Many cases from one file, by both engines, several at a time; goes on where it stopped; a table and a page over "
    "all of them",
    "Examples:\n  railstrata study cases/paper/study.toml --dry-run\n  railstrata study cases/paper/study.toml "
    "--engine bem --out results/study\n  railstrata study cases/paper/study.toml --out results/study --jobs 2 "
    "--threads 2\n  railstrata study cases/paper/study.toml --out /shared/study --shard 3/8     # one of eight "
    "machines\n",
    declare_study, true};

}  // namespace railstrata
