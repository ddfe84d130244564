#pragma once
// How far a run is: a bar with the time left on a terminal, a line every half minute elsewhere.
#include <chrono>
#include <string>

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

}  // namespace railstrata
