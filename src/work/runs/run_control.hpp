#pragma once
// When a run saves its state and when it stops: what is asked from outside, the time between checkpoints, the time
// limit of a batch queue.
#include <chrono>

#include "core/control.hpp"
#include "fem/rolling_run.hpp"

namespace railstrata {

/// Wall times [s]; 0: never, no limit.
struct RunTimes {
  double checkpoint_every = 0;
  double limit = 0;
  std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();  ///< both count from here
};

class RunControl {
 public:
  RunControl(const RunTimes& times, Control& asked) : times_(times), asked_(asked) {}

  /// The present request to the run. A limit is kept by stopping early: the remaining time must suffice for twice the
  /// longest checkpoint, the longest pause between two calls and one part in a hundred of the limit.
  Demand demand();
  /// A checkpoint took so long [s].
  void saved(double seconds);
  /// The same during the preload, which has no state to save.
  bool must_stop() { return must_stop(elapsed()); }
  /// Stopped by the limit, not on request.
  bool limit_reached() const { return limit_reached_; }

 private:
  double elapsed() const;
  bool must_stop(double now);
  RunTimes times_;
  Control& asked_;
  double last_save_ = 0, longest_save_ = 0, last_call_ = -1, longest_pause_ = 0;
  bool limit_reached_ = false;
};

}  // namespace railstrata
