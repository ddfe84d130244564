#include "study/study_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <semaphore>

#include "core/faults.hpp"
#include "core/text.hpp"
#include "io/output_folder.hpp"
#include "record/output_file.hpp"
#include "runs/write_fem_result.hpp"
#include "study/running_case.hpp"
#include "study/study_results.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
constexpr double kPatience = 20;  // s; batch systems wait about thirty before they kill

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct Running {
  const StudyCase* study_case;
  std::unique_ptr<RunningCase> at_work;
  fs::path folder;
  Clock::time_point start;
  Claim claim;
};

class Pool {
 public:
  Pool(const StudyRun& run, const std::vector<const StudyCase*>& cases)
      : run_(run),
        settings_{run.cell, run.threads, &cache_, &wake_, run.life_of},
        pending_(cases.begin(), cases.end()),
        began_(file_server_time(run.out / "study")) {
    for (const StudyCase* c : cases) ++left_[c->engine];
    ignore_second_signal_in_children();
  }

  StudyRunEnd work() {
    while (!pending_.empty() || !running_.empty()) {
      if (run_.control->stop) {
        stop();
        break;
      }
      if (run_.control->save.exchange(false)) for_all(&RunningCase::ask_to_save);
      start_free();
      renew();
      collect();
      run_.control->progress("study", fraction());
      if (running_.empty() && !pending_.empty() && looked_ && !run_.wait) break;
      rest();
    }
    end_.not_ours.assign(pending_.begin(), pending_.end());
    return std::move(end_);
  }

 private:
  /// Until a thread has ended, or a process may have.
  void rest() { static_cast<void>(wake_.try_acquire_for(std::chrono::milliseconds(20))); }

  bool has_room() const { return static_cast<int>(running_.size()) < run_.jobs; }

  /// Starts cases that nobody computes. Where there is none it looks again after a while, that grows.
  void start_free() {
    if (pending_.empty() || !has_room() || Clock::now() < look_) return;
    bool any = false;
    for (auto at = pending_.begin(); at != pending_.end() && has_room();) {
      const StudyCase& c = **at;
      std::optional<Claim> claim = Claim::take(claim_file(run_.out, c), run_.lease);
      if (!claim) {
        ++at;
        continue;
      }
      any = true;
      at = pending_.erase(at);
      if (is_done(run_.out, c) || has_failed_elsewhere(c)) {
        ++end_.elsewhere;
        --left_[c.engine];
      } else {
        refuse_another_study(c);
        start(c, std::move(*claim));
      }
    }
    looked_ = !pending_.empty() && has_room();
    pause_ = any ? kShortPause : std::min(2 * pause_, kLongPause);
    look_ = Clock::now() + std::chrono::milliseconds(looked_ ? pause_ : 0);
  }

  /// By another process, since this one began: it would fail again.
  bool has_failed_elsewhere(const StudyCase& c) const {
    if (last_failure(run_.out, c).empty()) return false;
    const auto failed = written_at(run_.out / (c.folder.string() + ".failed") / kStudyFile);
    return began_ && failed && *failed > *began_;
  }

  /// The place has a result of other settings that was made since this one began: two studies would replace each
  /// other's results.
  void refuse_another_study(const StudyCase& c) const {
    const auto made = written_at(run_.out / c.folder / kStudyFile);
    if (began_ && made && *made > *began_)
      throw CaseError(fmt::format("another study, with other settings, writes into {}", run_.out.string()),
                      "wait until it has ended, or give this one a folder of its own with --out");
  }

  void start(const StudyCase& c, Claim claim) {
    const fs::path folder = working_folder(run_.out, c);
    const bool begun = take_over(run_.out, c, folder);
    if (!begun) make_folder(folder);
    std::unique_ptr<RunningCase> at_work =
        c.engine == Engine::fem ? start_process(c, settings_, folder, begun) : start_thread(c, settings_, folder);
    running_.push_back({&c, std::move(at_work), folder, Clock::now(), std::move(claim)});
  }

  /// A case that another process has taken over, having held this one for dead, is left to it.
  void renew() {
    for (auto r = running_.begin(); r != running_.end();) {
      if (r->claim.renew()) {
        ++r;
        continue;
      }
      r->at_work.reset();
      leave(*r);
      r = running_.erase(r);
    }
  }

  void leave(const Running& r) {
    std::error_code error;
    fs::remove_all(r.folder, error);
    pending_.push_back(r.study_case);
  }

  void collect() {
    for (auto r = running_.begin(); r != running_.end();) {
      const std::optional<std::string> fault = r->at_work->ended();
      if (!fault) {
        ++r;
        continue;
      }
      const Running ended = std::move(*r);
      r = running_.erase(r);
      // once it is asked to stop, a case may end in any way: in the preload with an error
      if (run_.control->stop && !fault->empty())
        discard(ended);
      else
        finish(ended, *fault);
    }
  }

  /// The base case may have changed while the study ran; the folder has the one that was solved.
  static bool is_of_case(const Running& r) {
    const LoadedCase& loaded = r.study_case->loaded;
    return file_text(r.folder / "case.toml").ends_with(kept_case(loaded, kept_inputs(loaded, r.folder)));
  }

  void finish(const Running& r, std::string fault) {
    const StudyCase& c = *r.study_case;
    if (fault.empty() && !is_of_case(r)) fault = "the base case changed while the study ran: start it again";
    bool ours = true;
    if (fault.empty()) {
      try {
        ours = keep_result(run_.out, c, r.folder, r.claim);
      } catch (const CaseError& e) {
        fault = fmt::format("its result cannot be read: {}", e.diagnostics.front().message);
      }
    }
    if (!fault.empty()) ours = keep_failure(run_.out, c, r.folder, fault, r.claim);
    if (!ours) {
      leave(r);
      return;
    }
    const double seconds = seconds_since(r.start);
    Spent& s = spent_[c.engine];
    s.seconds += seconds;
    ++s.cases;
    --left_[c.engine];
    run_.ended(c, fault, seconds, ++done_);
  }

  void for_all(void (RunningCase::*ask)()) const {
    for (const Running& r : running_) ((*r.at_work).*ask)();
  }

  /// Removes the folder of a case that a later call cannot go on from.
  void discard(const Running& r) {
    std::error_code error;
    if (!has_checkpoint(r.folder)) fs::remove_all(r.folder, error);
  }

  /// Those that can end their step do, with a checkpoint; who has not ended after that time is killed. A result that is
  /// whole by then is kept.
  void stop() {
    for_all(&RunningCase::ask_to_stop);
    for (const auto asked = Clock::now(); !running_.empty() && seconds_since(asked) < kPatience; rest()) {
      renew();
      collect();
    }
    for (Running& r : running_) {
      r.at_work.reset();
      discard(r);
    }
    running_.clear();
  }

  /// A case counts as its engine's cases have taken so far; before one has ended, as half-spaces usually compare with
  /// finite elements.
  double fraction() const {
    double done = 0, all = 0;
    for (const auto& [engine, left] : left_) {
      const auto s = spent_.find(engine);
      const double each =
          s == spent_.end() ? (engine == Engine::fem ? 600.0 : 2.0) : s->second.seconds / s->second.cases;
      if (s != spent_.end()) {
        done += s->second.seconds;
        all += s->second.seconds;
      }
      all += each * left;
      for (const Running& r : running_)
        if (r.study_case->engine == engine) done += each * r.at_work->fraction();
    }
    return all > 0 ? done / all : 1;
  }

  struct Spent {
    double seconds = 0;
    int cases = 0;
  };
  static constexpr long kShortPause = 100, kLongPause = 5000;  // ms
  const StudyRun& run_;
  InfluenceCache cache_;
  std::counting_semaphore<> wake_{0};
  const CaseSettings settings_;
  std::list<const StudyCase*> pending_;
  const std::optional<double> began_;  ///< by the clock of the file server
  std::list<Running> running_;
  Clock::time_point look_ = Clock::now();
  long pause_ = kShortPause;
  bool looked_ = false;  ///< all that is pending is with others
  std::map<Engine, int> left_;
  std::map<Engine, Spent> spent_;
  StudyRunEnd end_;
  int done_ = 0;
};

}  // namespace

void require_case_processes() {}

StudyRunEnd run_cases(const StudyRun& run, const std::vector<const StudyCase*>& cases) {
  return Pool(run, cases).work();
}

}  // namespace railstrata
