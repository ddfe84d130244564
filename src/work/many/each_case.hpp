#pragma once
// Cases solved by one thread each, several at a time, with what follows on each of them one at a time.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <exception>
#include <mutex>

#include "core/control.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"

namespace railstrata {

/// solve(i) for every i below `count`; what it returns is called without arguments, one at a time. What these calls
/// throw, the last one of it, is thrown at the end. Those that have not begun when `control` asks to stop are left out.
/// `solve` throws nothing.
template <class Solve>
void for_each_completed(std::size_t count, const Control* control, Solve&& solve) {
  std::mutex ending;
  std::exception_ptr failure;
  for_each(
      static_cast<std::ptrdiff_t>(count),
      [&](std::ptrdiff_t i) {
        if (asked_to_stop(control)) return;
        const auto ended = solve(static_cast<std::size_t>(i));
        const std::lock_guard lock(ending);
        try {
          ended();
        } catch (...) {
          failure = std::current_exception();
        }
      },
      true);
  if (failure) std::rethrow_exception(failure);
}

/// A table that grows is written anew, each second at most and for a twentieth of the time: else it would cost the
/// square of its rows.
class NowAndThen {
 public:
  template <class Write>
  void operator()(Write&& write) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    if (begin < next_) return;
    write();
    next_ = Clock::now() + std::max<Clock::duration>(std::chrono::seconds(1), 20 * (Clock::now() - begin));
  }

 private:
  std::chrono::steady_clock::time_point next_{};
};

}  // namespace railstrata
