#pragma once
// When a run saves its state and when it stops: wishes from outside, the time between checkpoints, the time limit of a
// batch queue.
#include <atomic>
#include <chrono>

#include "fem/rolling_run.hpp"

namespace railstrata {

/// Wall times [s]; 0: never, no limit.
struct RunTimes {
  double checkpoint_every = 0;
  double limit = 0;
  std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();  ///< both count from here
};

/// What another thread, or a signal's handler, may wish of a run. Either may be null.
struct RunWishes {
  const std::atomic<bool>* stop = nullptr;  ///< true: end between two steps and keep the state
  std::atomic<bool>* save = nullptr;        ///< true: a checkpoint is wanted; the run sets it back
};

class RunControl {
 public:
  RunControl(const RunTimes& times, const RunWishes& wishes) : times_(times), wishes_(wishes) {}

  /// What is asked of the run now. A limit is kept by stopping early: what is left must do for twice the longest
  /// checkpoint, the longest pause between two calls and one part in a hundred of the limit.
  Demand demand();
  /// A checkpoint took so long [s].
  void saved(double seconds);
  /// To be called during the preload: raises preload_stop() when the run is to stop.
  void watch_preload();
  const std::atomic<bool>& preload_stop() const { return preload_stop_; }
  /// Stopped by the limit, not by a wish.
  bool limit_reached() const { return limit_reached_; }

 private:
  double elapsed() const;
  bool out_of_time(double now) const;
  bool must_stop(double now);
  RunTimes times_;
  RunWishes wishes_;
  double last_save_ = 0, longest_save_ = 0, last_call_ = -1, longest_pause_ = 0;
  bool limit_reached_ = false;
  std::atomic<bool> preload_stop_{false};
};

}  // namespace railstrata
