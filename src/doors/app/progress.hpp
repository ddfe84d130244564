#pragma once
// How far a run is: a bar with the time left on a terminal, a line every half minute elsewhere; screen and answer to
// Ctrl-C during a computation of unknown progress.
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "jobs/duration_text.hpp"

namespace railstrata {

/// "rolling  [#####-----]  50 %  12 s left": fraction in [0, 1], elapsed: seconds since it was `begin` (a resumed run
/// does not begin at 0).
std::string progress_bar(const std::string& what, double fraction, double elapsed, double begin = 0);

class Progress {
 public:
  /// Writes to standard error. `shown` = false: no output.
  explicit Progress(std::string what, bool shown = true);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// Cheap when called often.
  void update(double fraction);
  /// Takes the bar off the terminal, so that a line can be written; the next update draws it again.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  bool shown_, terminal_, drawn_ = false;
  double begin_ = -1;  // fraction of the first update
  Clock::time_point start_ = Clock::now(), next_ = start_;
};

/// From two seconds on: what is being done and for how long, renewed on a terminal, a line every half minute elsewhere.
/// Writes to standard error from a thread of its own; what it has drawn is gone when it ends.
class Waiting {
 public:
  /// No output where the log shows no information.
  explicit Waiting(std::string what);
  ~Waiting();
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

 private:
  void show();
  std::string what_;
  bool done_ = false;
  std::mutex mutex_;
  std::condition_variable ended_;
  std::thread thread_;
};

/// From here on Ctrl-C (SIGINT) ends the program at once with exit code 130 after writing `text`, a constant, to
/// standard error. Where the signal is ignored, as in the background of a script, it stays so.
void answer_interrupt_with(const char* text);

}  // namespace railstrata
