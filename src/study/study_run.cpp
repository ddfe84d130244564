#include "study/study_run.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <list>
#include <map>
#include <sstream>
#include <thread>

#include "core/faults.hpp"
#include "core/text.hpp"
#include "io/kept_inputs.hpp"
#include "io/output_file.hpp"
#include "runs/write_fem_result.hpp"
#include "study/child_process.hpp"
#include "study/study_results.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
constexpr double kPatience = 20;  // s; batch systems wait about thirty before they kill

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// What the log says went wrong: its first error, else its last line.
std::string reason_of(const std::string& log, int status) {
  std::istringstream lines(log);
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    if (const auto at = line.find("error: "); at != std::string::npos) return line.substr(at + 7);
    if (!line.empty()) last = line;
  }
  return WIFEXITED(status) && !last.empty() ? fmt::format("{}: {}", describe_end(status), last) : describe_end(status);
}

bool has_result(int status) {
  return WIFEXITED(status) && (WEXITSTATUS(status) == static_cast<int>(ExitCode::ok) ||
                               WEXITSTATUS(status) == static_cast<int>(ExitCode::failed_checks));
}

/// How far a case is by the last percentage in its log.
double fraction_of(const fs::path& log) {
  const std::string text = file_text(log);
  const auto at = text.rfind(" %");
  if (at == std::string::npos || at < 3) return 0;
  double percent = 0;
  std::istringstream(text.substr(at - 3, 3)) >> percent;
  return std::clamp(0.01 * percent, 0.0, 1.0);
}

struct Running {
  const StudyCase* study_case;
  pid_t process;
  fs::path folder;
  Clock::time_point start;
  Claim claim;
};

void end_at_once(const Running& r) {
  ::kill(r.process, SIGKILL);
  ::waitpid(r.process, nullptr, 0);
}

class Pool {
 public:
  Pool(const StudyRun& run, const std::vector<const StudyCase*>& cases)
      : run_(run), pending_(cases.begin(), cases.end()), began_(file_server_time(run.out / "study")) {
    for (const StudyCase* c : cases) ++left_[c->engine];
    ignore_second_signal_in_children();
  }

  ~Pool() {
    for (const Running& r : running_) ::kill(r.process, SIGKILL);
    for (const Running& r : running_) ::waitpid(r.process, nullptr, 0);
  }

  StudyRunEnd work() {
    while (!pending_.empty() || !running_.empty()) {
      if (run_.control->stop) {
        stop();
        break;
      }
      if (run_.control->save.exchange(false)) pass_on(SIGUSR1);
      start_free();
      renew();
      collect();
      run_.control->progress("study", fraction());
      if (running_.empty() && !pending_.empty() && looked_ && !run_.wait) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    end_.not_ours.assign(pending_.begin(), pending_.end());
    return std::move(end_);
  }

 private:
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
    std::vector<std::string> words =
        begun ? resume_command(run_.threads, folder) : case_command(c, run_.cell, run_.threads, folder);
    words.insert(words.begin(), "railstrata");
    running_.push_back({&c, start_self(words, folder / "log.txt"), folder, Clock::now(), std::move(claim)});
  }

  /// A case that another process has taken over, having held this one for dead, is left to it.
  void renew() {
    for (auto r = running_.begin(); r != running_.end();) {
      if (r->claim.renew()) {
        ++r;
        continue;
      }
      end_at_once(*r);
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
      int status = 0;
      if (!has_ended(r->process, status)) {
        ++r;
        continue;
      }
      const Running ended = std::move(*r);
      r = running_.erase(r);
      // once it is asked to stop, a case may end in any way: in the preload with an error
      if (run_.control->stop && !has_result(status))
        discard(ended);
      else
        finish(ended, status);
    }
  }

  std::string fault_of(const Running& r, int status) const {
    const StudyCase& c = *r.study_case;
    if (!has_result(status)) return reason_of(file_text(r.folder / "log.txt"), status);
    if (!file_text(r.folder / "case.toml").ends_with(kept_case(c.loaded, kept_inputs(c.loaded, r.folder))))
      return "the base case changed while the study ran: start it again";
    return "";
  }

  void finish(const Running& r, int status) {
    const StudyCase& c = *r.study_case;
    std::string fault = fault_of(r, status);
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
    end_.failures += fault.empty() ? 0 : 1;
    const double seconds = seconds_since(r.start);
    Spent& s = spent_[c.engine];
    s.seconds += seconds;
    ++s.cases;
    --left_[c.engine];
    run_.ended(c, fault, seconds, ++done_);
  }

  void pass_on(int signal) const {
    for (const Running& r : running_) ::kill(r.process, signal);
  }

  /// What a later call cannot go on from.
  void discard(const Running& r) {
    std::error_code error;
    if (!has_checkpoint(r.folder)) fs::remove_all(r.folder, error);
  }

  /// Those that can end their step do, with a checkpoint; who has not ended after that time is killed. A result that is
  /// whole by then is kept.
  void stop() {
    pass_on(SIGTERM);
    for (const auto asked = Clock::now(); !running_.empty() && seconds_since(asked) < kPatience;
         std::this_thread::sleep_for(std::chrono::milliseconds(20))) {
      renew();
      collect();
    }
    for (const Running& r : running_) {
      end_at_once(r);
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
        if (r.study_case->engine == engine) done += each * fraction_of(r.folder / "log.txt");
    }
    return all > 0 ? done / all : 1;
  }

  struct Spent {
    double seconds = 0;
    int cases = 0;
  };
  static constexpr long kShortPause = 100, kLongPause = 5000;  // ms
  const StudyRun& run_;
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
