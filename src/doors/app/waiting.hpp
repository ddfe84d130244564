#pragma once
// Screen and answer to Ctrl-C during a computation of unknown progress.
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace railstrata {

/// From two seconds on: what is being done and for how long, renewed on a terminal, a line every half minute elsewhere.
/// Writes to standard error from a thread of its own; what it has drawn is gone when it ends.
class Waiting {
 public:
  /// `shown` = false: no output.
  Waiting(std::string what, bool shown);
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
