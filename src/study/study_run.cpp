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
#include "io/kept_inputs.hpp"
#include "io/output_file.hpp"
#include "post/row_strength.hpp"
#include "study/child_process.hpp"
#include "study/study_results.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
constexpr double kPatience = 20;  // s; batch systems wait about thirty before they kill

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

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
  const std::string text = text_of(log);
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
};

class Pool {
 public:
  Pool(const StudyRun& run, const std::vector<const StudyCase*>& cases) : run_(run), cases_(cases) {
    for (const StudyCase* c : cases) ++left_[c->engine];
    ignore_second_signal_in_children();
  }

  ~Pool() {
    for (const Running& r : running_) ::kill(r.process, SIGKILL);
    for (const Running& r : running_) ::waitpid(r.process, nullptr, 0);
  }

  int work() {
    while (next_ < cases_.size() || !running_.empty()) {
      if (*run_.stop) return stop();
      if (run_.save && run_.save->exchange(false)) pass_on(SIGUSR1);
      while (next_ < cases_.size() && static_cast<int>(running_.size()) < run_.jobs) start(*cases_[next_++]);
      collect();
      run_.progress(fraction());
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return failures_;
  }

 private:
  void start(const StudyCase& c) {
    const fs::path folder = working_folder(run_.out, c);
    const bool begun = c.engine == Engine::fem && take_over(run_.out, c, folder);
    if (!begun) make_folder(folder);
    std::vector<std::string> words =
        begun ? resume_command(run_.threads, folder) : case_command(c, run_.cell, run_.threads, folder);
    words.insert(words.begin(), "railstrata");
    running_.push_back({&c, start_self(words, folder / "log.txt"), folder, Clock::now()});
  }

  void collect() {
    for (auto r = running_.begin(); r != running_.end();) {
      int status = 0;
      if (!has_ended(r->process, status)) {
        ++r;
        continue;
      }
      const Running ended = *r;
      r = running_.erase(r);
      // once it is asked to stop, a case may end in any way: in the preload with an error
      if (*run_.stop && !has_result(status))
        discard(ended);
      else
        finish(ended, status);
    }
  }

  void finish(const Running& r, int status) {
    const StudyCase& c = *r.study_case;
    std::string fault;
    if (!has_result(status))
      fault = reason_of(text_of(r.folder / "log.txt"), status);
    else if (!text_of(r.folder / "case.toml").ends_with(kept_case(c.loaded, kept_inputs(c.loaded, r.folder))))
      fault = "the base case changed while the study ran: start it again";
    if (fault.empty()) {
      try {
        keep_result(run_.out, c, r.folder);
      } catch (const CaseError& e) {
        fault = fmt::format("its result cannot be read: {}", e.diagnostics.front().message);
      }
    }
    if (!fault.empty()) {
      keep_failure(run_.out, c, r.folder, fault);
      ++failures_;
    }
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
  int stop() {
    pass_on(SIGTERM);
    for (const auto asked = Clock::now(); !running_.empty() && seconds_since(asked) < kPatience;
         std::this_thread::sleep_for(std::chrono::milliseconds(20)))
      collect();
    for (const Running& r : running_) {
      ::kill(r.process, SIGKILL);
      ::waitpid(r.process, nullptr, 0);
      discard(r);
    }
    running_.clear();
    return failures_;
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
  const StudyRun& run_;
  const std::vector<const StudyCase*>& cases_;
  std::size_t next_ = 0;
  std::list<Running> running_;
  std::map<Engine, int> left_;
  std::map<Engine, Spent> spent_;
  int failures_ = 0, done_ = 0;
};

}  // namespace

std::vector<std::string> case_command(const StudyCase& c, const std::string& cell, int threads,
                                      const fs::path& folder) {
  std::vector<std::string> words{std::string(row_of(c.engine).command), c.loaded.file.string()};
  for (const std::string& o : c.overrides) words.insert(words.end(), {"--set", o});
  if (c.engine == Engine::bem && !cell.empty()) words.insert(words.end(), {"--cell", cell});
  const CaseSpec& spec = c.loaded.spec;
  if (c.engine == Engine::bem && (strength_given(spec, BodyId::rail) || strength_given(spec, BodyId::wheel)))
    words.emplace_back("--no-single-track");  // a third of the time of a case, and the same for hundreds of them
  words.insert(words.end(),
               {"--out", folder.string(), "--force", "--no-report", "--threads", fmt::format("{}", threads)});
  return words;
}

std::vector<std::string> resume_command(int threads, const fs::path& folder) {
  return {"run", "--resume", folder.string(), "--no-report", "--threads", fmt::format("{}", threads)};
}

int run_cases(const StudyRun& run, const std::vector<const StudyCase*>& cases) { return Pool(run, cases).work(); }

}  // namespace railstrata
