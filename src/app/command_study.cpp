#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/progress.hpp"
#include "app/shipped_files.hpp"
#include "io/json_text.hpp"
#include "io/output_file.hpp"
#include "io/provenance.hpp"
#include "runs/output_folder.hpp"
#include "runs/run_bem.hpp"
#include "runs/stop_flag.hpp"
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

/// By what prepare_study_folder writes there first; study.toml is what people call their own files.
bool is_study_folder(const fs::path& out) {
  std::ifstream in(out / "provenance.json", std::ios::binary);
  const auto origin = nlohmann::json::parse(in, nullptr, false);
  if (!origin.is_object() || !origin.contains("command_line") || !origin["command_line"].is_array()) return false;
  const auto& words = origin["command_line"];
  return std::find(words.begin(), words.end(), "study") != words.end();
}

[[nodiscard]] FolderHold prepare_study_folder(const fs::path& out, const LoadedStudy& study,
                                              const CommandOptions& options) {
  FolderHold hold = prepare_output_folder(out, options.force, [&] { return is_study_folder(out); });
  std::vector<fs::path> inputs{study.file};
  for (const StudyGroup& g : study.spec.groups)
    if (std::find(inputs.begin(), inputs.end(), g.base) == inputs.end()) inputs.push_back(g.base);
  write_whole_file(out / "provenance.json",
                   provenance_json(options.command_line, options.overrides, inputs, options.threads));
  write_whole_file(out / "study.toml", study.source_text);
  return hold;
}

std::vector<std::string> origin_of(const LoadedStudy& study) {
  return {fmt::format("RailStrata {}", version_text()),
          fmt::format("study: {} ({})", study.file.filename().string(), study.spec.title),
          "a case by one engine a line; the names of columns say their units; stresses of the rail"};
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
               r.study_case->engine, r.state, cell("p_max_MPa", 1, 9), cell("q_max_MPa", 1, 9),
               cell("patch_area_mm2", 1, 8), cell("slip_area_fraction", 100, 6), r.fault.empty() ? "" : "  " + r.fault);
  }
}

}  // namespace

ExitCode command_study(const CommandOptions& options) {
  const LoadedStudy study = study_of(options);
  cell_size(study.spec.cell);  // what is wrong is told before the first case
  const Published published = study.spec.published.empty() ? Published{} : load_published(study.spec.published);
  const Shard shard = parse_shard(options.shard);
  std::vector<StudyCase> cases = plan_study(study, options.overrides);
  const std::vector<bool> ours = chosen(study, cases, options.engine, options.groups, shard);
  const auto only_ours = [&](const std::vector<StudyRow>& all) {
    std::vector<StudyRow> rows;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (ours[k]) rows.push_back(all[k]);
    return rows;
  };
  const fs::path out = folder_of(options, study);
  if (options.dry_run) {
    find_results(out, cases);
    const std::vector<StudyRow> rows = only_ours(study_rows(out, cases));
    print_list(rows, options.json);
    spdlog::info("{} cases, {} to compute into {}", rows.size(),
                 std::count_if(rows.begin(), rows.end(), [](const StudyRow& r) { return r.state != "done"; }),
                 out.string());
    return ExitCode::ok;
  }

  const FolderHold hold = prepare_study_folder(out, study, options);
  recover(out, cases);
  find_results(out, cases);
  std::vector<const StudyCase*> to_do;
  for (std::size_t k = 0; k < cases.size(); ++k)
    if (ours[k] && !is_done(out, cases[k])) to_do.push_back(&cases[k]);
  std::stable_sort(to_do.begin(), to_do.end(), [](const StudyCase* a, const StudyCase* b) {
    return a->engine < b->engine;
  });  // half-spaces first: they tell of mistakes in seconds

  StudyRun run;
  run.out = out;
  run.cell = study.spec.cell;
  run.jobs =
      std::clamp(options.jobs > 0 ? options.jobs : options.threads, 1, std::max(1, static_cast<int>(to_do.size())));
  run.threads = std::max(1, options.threads / run.jobs);
  run.stop = &stop_flag();
  spdlog::info("{}: {} cases, {} of them to compute, {} at a time with {} thread{} each; results go to {}",
               study.spec.title, std::count(ours.begin(), ours.end(), true), to_do.size(), run.jobs, run.threads,
               run.threads == 1 ? "" : "s", out.string());
  Progress progress("study", spdlog::default_logger()->level() <= spdlog::level::info);
  run.progress = [&](double fraction) { progress.update(fraction); };
  run.ended = [&](const StudyCase& c, const std::string& fault, double seconds, int done) {
    progress.clear();
    if (fault.empty())
      spdlog::info("{}/{}  {}: {}", done, to_do.size(), c.label(), duration_text(seconds));
    else
      spdlog::warn("{}/{}  {} failed: {}", done, to_do.size(), c.label(), fault);
    write_study_table(out / "study.csv", origin_of(study), study_rows(out, cases));
  };
  run_cases(run, to_do);
  progress.clear();

  const std::vector<StudyRow> rows = study_rows(out, cases);
  write_study_table(out / "study.csv", origin_of(study), rows);
  if (stop_flag()) {
    spdlog::warn("stopped; the same command goes on where it was");
    return ExitCode::interrupted;
  }
  if (options.report) add_study_page(out, study, published, rows);
  print_list(only_ours(rows), options.json);
  spdlog::info("the table is {}", (out / "study.csv").string());
  std::size_t faults = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) faults += ours[k] && !rows[k].fault.empty();
  if (faults > 0)
    spdlog::warn("{} of {} cases failed or have a failed check: see the last column", faults,
                 std::count(ours.begin(), ours.end(), true));
  return faults > 0 ? ExitCode::failed_checks : ExitCode::ok;
}

}  // namespace railstrata
