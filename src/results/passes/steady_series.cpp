#include "passes/steady_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/faults.hpp"
#include "passes/pass_files.hpp"
#include "passes/pass_plan.hpp"

namespace railstrata {

SteadySeries::SteadySeries(const CaseSpec& spec, SeriesContacts contacts, Listener listener, const Control* control)
    : spec_(spec),
      tractions_(std::move(contacts.tractions)),
      following_(std::move(contacts.following)),
      listener_(std::move(listener)),
      runner_(spec_, std::move(contacts.solutions), following_.get(), control) {
  series_.state = runner_.body().virgin();
  series_.cycle = passes_per_cycle(spec_.passes);
  if (spec_.passes.jump != PassJump::off) series_.jump.length = kShortestJump;
}

void SteadySeries::resume(const std::filesystem::path& state, const std::filesystem::path& table) {
  const int stations = active_stations(state);
  // where no window is long enough it is a state of another grid, which is refused below
  while (grid().active_stations() < stations && runner_.lengthen(1, series_.state)) {
  }
  series_ = read_pass_series(state, table, grid(), series_.cycle);
  if (passes() > 0) runner_.stand(place_of(passes()), series_.state);
}

PassRunner::Place SteadySeries::place_of(int pass) const {
  const PassPlan plan = pass_plan(spec_.passes, pass);
  return {columns_to(grid(), plan.lateral), plan.traction};
}

bool SteadySeries::step(int wanted) {
  const int done = passes() / series_.cycle, left = wanted / series_.cycle - done;
  if (series_.jump.length == 0 || passes() % series_.cycle != 0 || left < 1) return one_pass();
  const int length = std::min(series_.jump.length, left - kRoundsAfterJumps - 1);
  const Kept kept = keep_all();
  const bool ready = done >= kRoundsBeforeJumps && length >= kShortestJump;
  if (ready ? jump(length) : round().has_value()) {
    if (!ready && series_.jump.length < kShortestJump) ++series_.jump.length;
    return true;
  }
  take_back(kept);
  return false;
}

SteadySeries::Kept SteadySeries::keep_all() const {
  return {series_, last_, last_row_, runner_.place(), runner_.strain(), settled_};
}

void SteadySeries::take_back(const Kept& kept) {
  series_ = kept.series;
  last_ = kept.last;
  last_row_ = kept.row;
  settled_ = kept.settled;
  runner_.take_back(kept.place, kept.strain);
}

/// All passes of a round and their effect on the state; empty: given up.
std::optional<std::vector<double>> SteadySeries::round() {
  std::vector<double> rate = series_.state.history;
  for (int n = 0; n < series_.cycle; ++n)
    if (!one_pass()) return {};
  for (std::size_t n = 0; n < rate.size(); ++n) rate[n] = series_.state.history[n] - rate[n];
  return rate;
}

/// The same from another state on, which leaves nothing but a first guess.
std::optional<std::vector<double>> SteadySeries::change_in_round(const std::vector<double>& history) {
  const PassState before = series_.state;
  std::vector<double> rate = history;
  series_.state.history = history;
  try {
    for (int n = 1; n <= series_.cycle; ++n) {
      runner_.stand(place_of(before.passes + n), series_.state);
      runner_.roll(series_.state);
    }
  } catch (const Interrupted&) {
    return {};
  }
  for (std::size_t n = 0; n < rate.size(); ++n) rate[n] = series_.state.history[n] - rate[n];
  series_.state.history = before.history;
  series_.state.passes = before.passes;
  return rate;
}

/// A round, and a jump behind it of as many rounds as wanted or fewer by the tolerance, with the round that shows its
/// error.
bool SteadySeries::jump(int rounds) {
  const double tolerance = spec_.passes.jump_tolerance;
  const std::optional<std::vector<double>> first = round();
  if (!first) return false;
  const Kept kept = keep_all();
  std::vector<double> start = series_.state.history;
  for (std::size_t n = 0; n < start.size(); ++n) start[n] -= (*first)[n];
  while (rounds >= kShortestJump) {
    std::optional<std::vector<double>> end =
        state_after(start, *first, rounds, [&](const std::vector<double>& state) { return change_in_round(state); });
    if (!end) return false;
    jump_over(rounds - 1, *end, series_);  // the first of them has been computed
    const std::optional<std::vector<double>> last = round();
    if (!last) return false;
    const double error = jump_error(start, *end, *first, *last, rounds);
    const int next = next_jump(rounds, error, tolerance);
    const std::string what = passes_text((rounds - 1) * series_.cycle);
    if (error <= tolerance) {
      say(fmt::format("jumped over {}; error of the rate {:.2g}", what, error));
      series_.jump = {std::max(next, 1), std::max(series_.jump.error, error)};
      return true;
    }
    say(fmt::format("a jump over {} is taken back: error of the rate {:.2g}", what, error));
    take_back(kept);
    rounds = next;
  }
  series_.jump.length = std::max(rounds, 1);
  return true;
}

bool SteadySeries::one_pass() {
  const int pass = passes() + 1;
  Kept kept = keep_all();
  if (listener_.begins) listener_.begins(pass);
  double window = rail().window;
  try {
    FollowedPass rolled = runner_.next(place_of(pass), series_.state, [&] {
      say(fmt::format("flow goes on behind the load: followed over {:.3g} half-lengths instead of {:.3g}",
                      rail().window, window));
      window = rail().window;
      kept = keep_all();
    });
    last_ = std::move(rolled.result);
    keep(pass_row(grid(), pass, *last_), rolled);
  } catch (const Interrupted&) {
    take_back(kept);
    return false;
  }
  return true;
}

void SteadySeries::keep(PassRow row, const FollowedPass& pass) {
  row.contact = {tractions_[runner_.place().solution], pass.creepage, pass.largest_pressure,
                 runner_.place().column * grid().dy};
  row.rounds = pass.rounds;
  last_row_ = row;
  add_pass(row, *last_, series_);
  settled_ = settled_ && pass.converged && row.converged;
  if (listener_.ends) listener_.ends(row, pass);
}

void SteadySeries::say(const std::string& text) const {
  if (listener_.says) listener_.says(text);
}

}  // namespace railstrata
