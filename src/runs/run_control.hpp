#pragma once
// When a run saves its state and when it stops: signals, the time between checkpoints, the time limit of a batch queue.
#include <chrono>
#include <string>

#include "fem/rolling_run.hpp"

namespace railstrata {

/// Wall times [s]; 0: never, no limit.
struct RunTimes {
  double checkpoint_every = 600;
  double limit = 0;
};

/// "10 min", "90 s", "1.5 h"; "0" and "never" are 0. `option` names it in the CaseError of a text that is no time.
double wall_time(const std::string& option, const std::string& text);

class RunControl {
 public:
  /// The clock starts here. Installs the signals' handlers.
  explicit RunControl(const RunTimes& times);

  /// What is asked of the run now. A limit is kept by stopping early: what is left must do for twice the longest
  /// checkpoint, the longest pause between two calls and one part in a hundred of the limit.
  Demand demand();
  /// A checkpoint took so long [s].
  void saved(double seconds);
  /// To be called during the preload: lets the limit raise the stop flag.
  void watch_limit();
  /// Stopped by the limit, not by a signal.
  bool limit_reached() const { return limit_reached_; }

 private:
  using Clock = std::chrono::steady_clock;
  double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  bool out_of_time(double now) const;
  RunTimes times_;
  Clock::time_point start_ = Clock::now();
  double last_save_ = 0, longest_save_ = 0, last_call_ = -1, longest_pause_ = 0;
  bool limit_reached_ = false;
};

}  // namespace railstrata
