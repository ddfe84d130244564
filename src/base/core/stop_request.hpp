#pragma once
// A request to stop what a thread computes. The caller of a computation has a flag and a StopRequest; solvers that
// iterate call stop_if_requested between two iterations.
#include <atomic>

namespace railstrata {

/// As long as it lives, what this thread computes stops once the flag is set. Wishes nest: the innermost counts.
class StopRequest {
 public:
  explicit StopRequest(const std::atomic<bool>* flag);
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

 private:
  const std::atomic<bool>* before_;
};

/// Throws Interrupted where a StopRequest of this thread is set; inside a parallel loop, which nothing may leave, it
/// waits for the loop's end.
void stop_if_requested();

}  // namespace railstrata
