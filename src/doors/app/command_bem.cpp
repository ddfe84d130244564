#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "app/case_of.hpp"
#include "app/common_options.hpp"
#include "app/control.hpp"
#include "app/progress.hpp"
#include "app/summary_text.hpp"
#include "ask/half_space_need.hpp"
#include "clock/wheel_life.hpp"
#include "core/faults.hpp"
#include "fatigue/row_strength.hpp"
#include "io/folder_kind.hpp"
#include "io/output_folder.hpp"
#include "rules/track_facts.hpp"
#include "runs/write_half_space_result.hpp"
#include "runs/write_report.hpp"
#include "runs/write_transient.hpp"

namespace railstrata {
namespace {

struct BemWords {
  bool single_track = true;  ///< --no-single-track: without the limit for one track, which takes some seconds
  bool maps = false;         ///< --maps: limits over traction too
};

/// Input of `bem` and the folder of its results.
struct HalfSpaceJob {
  LoadedCase loaded;
  Placement placement;
  std::filesystem::path out;
  BemOptions bem;
  HalfSpaceNeed need;
};

/// Without a strength there is nothing to draw limits for.
void require_strength(const LoadedCase& loaded) {
  if (strength_to_judge(loaded.spec)) return;
  const bool both = loaded.spec.run.judged == JudgedBodies::both;
  throw CaseError(both ? "--maps: the case gives no strength of rail, wheel or layers"
                       : "--maps: the case gives no strength of the body that run.judged names, nor of its layers",
                  "give yield_strength = \"500 MPa\", or grade = \"R260\", in [material.rail], [material.wheel] or a "
                  "[[layer]]",
                  loaded.file.string());
}

HalfSpaceJob job_of(const CommandOptions& options) {
  LoadedCase loaded = load_case_of(options, uses::kHalfSpaces);
  Placement placement = place(loaded.spec, loaded.folder());
  HalfSpaceJob job{std::move(loaded), std::move(placement), {}, {}, {}};
  job.out = output_folder_of(options, job.loaded, "-bem");
  job.bem.cell = cell_size(options.cell);
  job.need = half_space_need(job.loaded.spec, job.placement, job.bem.cell);
  with_places(job.loaded, [&] { require_solvable(job.loaded.spec, job.placement, job.bem); });
  return job;
}

/// Wheelset and track that the case stands on, with where they come from.
std::string track_text(const CaseSpec& spec) {
  std::vector<std::string> facts;
  for (const TrackFact& f : track_facts(spec.geometry))
    facts.push_back(fmt::format("{}: {} ({})", f.label, f.value, f.from));
  return fmt::format("{}", fmt::join(facts, "; "));
}

Answer solve_steady(const HalfSpaceJob& job, const BemWords& own) {
  answer_interrupt_with("\nstopped: nothing was written\n");
  const Waiting waiting(fmt::format("half-spaces, {}", need_text(job.need)));
  const Wanted wanted{.single_track = own.single_track, .maps = own.maps, .other_fits = true};
  const Control* control = job.loaded.spec.life.until > 0 ? &control_by_signals() : nullptr;
  return ask(job.loaded.spec, job.placement, wanted,
             {.bem = job.bem, .control = control, .life_of = life_of_wheels(job.loaded.folder(), control)});
}

/// Its history and pictures are there while it is followed, and after Ctrl-C up to there.
Answer solve_and_show(const HalfSpaceJob& job) {
  const Control& control = control_by_signals();
  TransientWriter writer(job.loaded.spec, job.out, table_origin(job.loaded));
  spdlog::info("{}: {} steps, {}; results go to {}", job.loaded.spec.title,
               transient_steps(job.loaded.spec, job.placement, job.bem.cell), need_text(job.need), job.out.string());
  const auto observer = [&](const TransientState& state) {
    writer.add(state);
    control.progress("steps", static_cast<double>(state.step) / state.steps);
  };
  Answer answer = ask(job.loaded.spec, job.placement, {}, {.bem = job.bem, .control = &control, .observer = observer});
  control.progress("");
  if (answer.stopped)
    throw Interrupted(
        fmt::format("stopped {}: history.csv and the patch on its way are in {} up to there\n    remedy: "
                    "start it again: {}",
                    answer.summary.state, job.out.string(), command_again(job.out)));
  return answer;
}

constexpr const char* kHalfWritten =
    "\nstopped while the results were written: they are not complete; start again with --force\n";

ExitCode command_bem(const BemWords& own, const CommandOptions& options) {
  const HalfSpaceJob job = job_of(options);
  if (own.maps) require_strength(job.loaded);
  const bool steady = job.loaded.spec.transient.kind == TransientKind::none;
  Answer answer;
  if (steady) answer = with_places(job.loaded, [&] { return solve_steady(job, own); });

  require_apart(job.out, job.loaded);
  const FolderHold hold = prepare_output_folder(job.out, options.force);
  try {
    if (steady) answer_interrupt_with(kHalfWritten);
    clear_old_results(job.out);
    write_origin(job.out, job.loaded, options.command_line, options.threads);
    if (!steady) answer = with_places(job.loaded, [&] { return solve_and_show(job); });
    answer_interrupt_with(kHalfWritten);
    write_half_space_result(job.out, table_origin(job.loaded), job.loaded.spec, job.placement, answer);
  } catch (EnvironmentError& e) {
    if (!e.remedy.empty()) e.remedy += ", then start it again with --force";
    throw;
  }
  if (const std::string track = track_text(job.loaded.spec); !track.empty()) spdlog::info("{}", track);
  for (const std::string& doubt : job.placement.doubts) spdlog::warn("{}", doubt);
  for (const auto& notes : {job.placement.notes, answer.result.notes})
    for (const std::string& note : notes) spdlog::info("{}", note);
  report_assumed(job.loaded, uses::kHalfSpaces);
  print_summary(answer.summary, options.json);
  spdlog::info("results are in {}", job.out.string());
  const bool page_ok = !options.page || add_report(job.out, control()), ok = page_ok && all_checks_hold(answer.summary);
  if (!ok) spdlog::warn("a check failed: read the results with care");
  return ok ? ExitCode::ok : ExitCode::failed_checks;
}

CommandWork declare_bem(CLI::App& sub, CommandOptions& options) {
  const auto own = std::make_shared<BemWords>();
  add_case(sub, options);
  add_output(sub, options, "results/<case name>-bem");
  add_cell(sub, options);
  sub.add_flag_callback(
      "--no-single-track", [own] { own->single_track = false; },
      "Of shakedown leave out the limit for one track, which takes some seconds");
  sub.add_flag("--maps", own->maps,
               "Of shakedown also the limits over traction and the strength that every depth asks for, drawn on the "
               "page; the case gives a strength");
  add_no_report(sub, options);
  return [own, &options] { return command_bem(*own, options); };
}

}  // namespace

extern const Command kBemCommand{
    "bem", "Solve a case by half-space theory, in about a second: the files and numbers of `run`, no meshes",
    "Examples:\n  railstrata bem cases/paper/base.toml\n  railstrata bem cases/quick --cell \"0.5 mm\" --out "
    "results/quick-coarse\n  railstrata bem cases/paper/base.toml --set drive.traction_coefficient=0.3 --json\n  "
    "railstrata bem cases/paper/base.toml --maps --set material.rail.grade=R260\n",
    declare_bem};

}  // namespace railstrata
