#include "app/study_list.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>

#include <nlohmann/json.hpp>

#include "app/option_values.hpp"
#include "app/progress.hpp"
#include "ask/half_space_need.hpp"
#include "fem/memory_need.hpp"
#include "record/escaped_text.hpp"
#include "record/this_process.hpp"
#include "runs/run_estimate.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

CaseNeed need_of(const StudyCase& c, const std::string& cell) {
  try {
    if (c.engine == Engine::bem) {
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

std::vector<std::string> study_words(const CommandOptions& options, const fs::path& study, const fs::path& out) {
  std::vector<std::string> words{"railstrata", "study", whole_path(study), "--out", whole_path(out)};
  for (const std::string& o : options.overrides) words.insert(words.end(), {"--set", o});
  return words;
}

std::string command_of(const ListedCase& c, const CommandOptions& options, const fs::path& study, const fs::path& out) {
  std::vector<std::string> words = study_words(options, study, out);
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

}  // namespace

std::vector<ListedCase> listed_cases(const std::vector<StudyCase>& cases, const std::vector<CaseRow>& rows,
                                     const std::vector<bool>& ours, const std::string& cell) {
  std::vector<ListedCase> out;
  for (std::size_t k = 0; k < cases.size(); ++k)
    if (ours[k])
      out.push_back(
          {static_cast<int>(k) + 1, &cases[k], rows[k].state, rows[k].done() ? CaseNeed{} : need_of(cases[k], cell)});
  return out;
}

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

}  // namespace railstrata
