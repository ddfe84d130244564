#pragma once
// Settings of callers from other programs and languages besides the case: threads, cells.
#include <fmt/format.h>

#include "bem/bem_options.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"

namespace railstrata {

/// The number of threads of the calling thread, for as long as this lives; 0: as it is.
class ThreadsOfCaller {
 public:
  explicit ThreadsOfCaller(int wanted) : before_(max_threads()) {
    if (wanted < 0) throw CaseError(fmt::format("{} threads", wanted), "give 0 for as many as OpenMP has");
    if (wanted > 0) set_threads(wanted);
  }
  ~ThreadsOfCaller() { set_threads(before_); }
  ThreadsOfCaller(const ThreadsOfCaller&) = delete;
  ThreadsOfCaller& operator=(const ThreadsOfCaller&) = delete;

 private:
  int before_;
};

/// m. Throws CaseError: BemOptions::cell cannot be that.
inline void require_cell(double cell) {
  if (!(cell >= kSmallestCell && cell <= kLargestCell))
    throw CaseError(fmt::format("a cell of {} m is out of range", cell), "give a length from 0.02e-3 to 5e-3 m");
}

}  // namespace railstrata
