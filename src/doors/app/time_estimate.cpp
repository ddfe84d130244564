#include "app/time_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <utility>

#include "ask/cell_time.hpp"
#include "collective/collective.hpp"
#include "core/faults.hpp"
#include "core/printable.hpp"
#include "fatigue/row_strength.hpp"
#include "io/output_folder.hpp"
#include "jobs/duration_text.hpp"
#include "many/sweep.hpp"
#include "record/this_process.hpp"
#include "rules/clashes.hpp"
#include "runs/pass_folder.hpp"
#include "runs/pass_job.hpp"
#include "runs/write_half_space_result.hpp"

namespace railstrata {
namespace {

/// Two digits below ten seconds.
std::string seconds_text(double seconds) {
  return seconds < 9.95 ? fmt::format("{:.2g} s", std::max(0.1, seconds)) : duration_text(seconds);
}

bool takes(const Use& use, const LoadedCase& loaded) { return refused_by(use, loaded).empty(); }

/// A folder for a trial that is removed with it.
class TrialFolder {
 public:
  TrialFolder() : path_(std::filesystem::temp_directory_path() / fmt::format("railstrata-trial-{}", process_id())) {}
  ~TrialFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TrialFolder(const TrialFolder&) = delete;
  TrialFolder& operator=(const TrialFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A contact with the files of its result.
double seconds_of_result(const CaseSpec& spec, const Placement& placement, const Wanted& wanted, double cell) {
  const TrialFolder folder;
  AskOptions how;
  how.bem.cell = cell;
  return processor_seconds([&] {
    make_folder(folder.path());
    write_half_space_result(folder.path(), {}, spec, placement, ask(spec, placement, wanted, how));
  });
}

/// The loads, and the one that the page shows whole.
double seconds_of_loads(const LoadedCase& loaded, std::vector<CollectiveRow> rows, double cell) {
  const auto count = static_cast<double>(rows.size());
  const Placement placement = place(rows.front().spec, loaded.folder());
  const auto seconds = [&](double of_trial) {
    InfluenceCache cache;
    CollectiveOptions how;
    how.bem.cell = of_trial;
    how.bem.cache = &cache;
    std::vector<double> took;
    for (const std::size_t k : sample_of(rows.size())) {
      std::vector<CollectiveRow> one{rows[k]};
      took.push_back(processor_seconds([&] { solve_collective(one, loaded.folder(), how); }));
    }
    return seconds_of_all(took, rows.size()) + seconds_of_result(rows.front().spec, placement, {}, of_trial);
  };
  return estimated_seconds({[&](double c) { return count * cells_to_solve(rows.front().spec, placement, c); }, seconds},
                           cell);
}

double seconds_of_sweep(std::vector<SweepCase> cases, const TimesWanted& wanted) {
  std::erase_if(cases, [](const SweepCase& c) { return !c.loaded; });
  const CaseSpec& first = cases.front().loaded->spec;
  const Placement placement = place(first, cases.front().loaded->folder());
  const auto seconds = [&](double of_trial) {
    InfluenceCache cache;
    SweepOptions how;
    how.bem.cell = of_trial;
    how.bem.cache = &cache;
    how.stresses = wanted.stresses || first.life.crack.there();
    std::vector<double> took;
    for (const std::size_t k : sample_of(cases.size())) {
      std::vector<SweepCase> one{cases[k]};
      took.push_back(processor_seconds([&] { run_sweep(one, how); }));
    }
    return seconds_of_all(took, cases.size());
  };
  const auto count = static_cast<double>(cases.size());
  return estimated_seconds({[&](double c) { return count * cells_to_solve(first, placement, c); }, seconds},
                           wanted.cell);
}

/// Passes of which the first `tried` took so long: their iterations fall with about the cube root of their number.
double seconds_of_further(double tried_seconds, int tried, int passes) {
  const auto sum = [](int n) {
    double out = 0;
    for (int k = 1; k <= n; ++k) out += 1 / std::cbrt(k);
    return out;
  };
  return tried_seconds * sum(passes) / sum(tried);
}

double seconds_of_passes(const LoadedCase& loaded, const TimesWanted& wanted) {
  const Placement placement = place(loaded.spec, loaded.folder());
  const int tried = std::min(3, wanted.passes);
  const auto seconds = [&](double of_trial) {
    const TrialFolder folder;
    PassOrder order;
    order.folder = folder.path();
    order.page = false;
    order.passes = tried;
    order.cell = of_trial;
    double begun = 0;
    const auto clock = [begin = std::clock()] { return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; };
    Control control;
    control.on_progress = [&](const std::string&, double, int pass) {
      if (pass == 1) begun = clock();
    };
    const double all = processor_seconds([&] { passes_in_folder(loaded, order, control); });
    return begun + seconds_of_further(all - begun, tried, wanted.passes);
  };
  return estimated_seconds({[&](double c) { return cells_to_solve(loaded.spec, placement, c); }, seconds}, wanted.cell);
}

double on_threads(double seconds, int threads, std::size_t cases) {
  return seconds / std::max(1, std::min(threads, static_cast<int>(cases)));
}

/// A solution that fails takes no known time, and the command reports why.
template <class Seconds>
void add(const char* command, std::string what, Seconds&& seconds, std::vector<TimeEstimate>& out) {
  out.push_back({command, std::move(what), kNotApplicable});
  try {
    out.back().seconds = seconds();
  } catch (const CaseError& e) {
    out.back().what = e.what();
  } catch (const NumericalError& e) {
    out.back().what = e.what();
  }
}

double seconds_of_bem(const LoadedCase& loaded, double cell) {
  constexpr double kTwice = 2;  // cells of a trial
  const Placement placement = place(loaded.spec, loaded.folder());
  const bool transient = loaded.spec.transient.kind != TransientKind::none;
  Wanted wanted{.other_fits = true, .life = false};
  const auto seconds = [&](double c) { return seconds_of_result(loaded.spec, placement, wanted, c); };
  const double without = estimated_seconds(
      {[&](double c) { return cells_to_solve(loaded.spec, placement, c); }, seconds, transient ? kTwice : 1.5}, cell);
  if (transient || !strength_to_judge(loaded.spec) || kTwice * cell > kLargestCell) return without;
  // the limit for one track goes with the points across the patch
  const double plain = seconds(kTwice * cell);
  wanted.single_track = true;
  return without + kTwice * std::max(0.0, seconds(kTwice * cell) - plain);
}

void add_contact(const LoadedCase& loaded, const TimesWanted& wanted, std::vector<TimeEstimate>& out) {
  const bool followed = loaded.spec.life.until > 0 && loaded.spec.loads.empty();
  add(
      "bem", followed ? "of one core, and the life under life.until" : "of one core",
      [&] { return wanted.own + seconds_of_bem(loaded, wanted.cell); }, out);
}

void add_loads(const LoadedCase& loaded, const TimesWanted& wanted, std::vector<TimeEstimate>& out) {
  const std::vector<CollectiveRow> rows = plan_collective(loaded.spec);
  const char* followed = loaded.spec.life.until > 0 ? ", and the way through life.until" : "";
  add(
      "collective", fmt::format("for {}{}{}", rows.size(), rows.size() == 1 ? " load" : " loads", followed),
      [&] {
        const double loads = seconds_of_loads(loaded, rows, wanted.cell);
        return wanted.own + wanted.before + on_threads(loads, wanted.threads, rows.size());
      },
      out);
}

void add_sweep(const LoadedCase& loaded, const TimesWanted& wanted, std::vector<TimeEstimate>& out) {
  const std::vector<SweepCase> cases = plan_sweep(loaded, parse_axes("--vary", wanted.vary));
  add(
      "sweep", fmt::format("for {} cases", cases.size()),
      [&] { return wanted.own + on_threads(seconds_of_sweep(cases, wanted), wanted.threads, cases.size()); }, out);
}

}  // namespace

std::vector<TimeEstimate> time_estimates(const LoadedCase& loaded, const TimesWanted& wanted) {
  std::vector<TimeEstimate> out;
  if (takes(uses::kHalfSpaces, loaded)) add_contact(loaded, wanted, out);
  if (!loaded.spec.loads.empty() && takes(uses::kCollective, loaded)) add_loads(loaded, wanted, out);
  if (!wanted.vary.empty()) add_sweep(loaded, wanted, out);
  if (wanted.passes == 0) return out;
  require_support(uses::kPasses, loaded);
  add(
      "passes", fmt::format("of one core for {}", passes_text(wanted.passes)),
      [&] { return wanted.own + seconds_of_passes(loaded, wanted); }, out);
  return out;
}

void print_times(const std::vector<TimeEstimate>& times) {
  for (const TimeEstimate& t : times)
    if (std::isfinite(t.seconds))
      fmt::print("{:<14} about {} {}\n", t.command, seconds_text(t.seconds), t.what);
    else
      fmt::print("{:<14} {}\n", t.command, printable(t.what));
}

nlohmann::ordered_json times_json(const std::vector<TimeEstimate>& times) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const TimeEstimate& t : times) out.push_back({{"command", t.command}, {"of", t.what}, {"seconds", t.seconds}});
  return out;
}

}  // namespace railstrata
