#include "core/stop_wish.hpp"

#include <omp.h>

#include "core/faults.hpp"

namespace railstrata {
namespace {

thread_local const std::atomic<bool>* wish = nullptr;

}  // namespace

StopWish::StopWish(const std::atomic<bool>* flag) : before_(wish) { wish = flag; }
StopWish::~StopWish() { wish = before_; }

void stop_if_wished() {
  if (wish != nullptr && *wish && omp_in_parallel() == 0) throw Interrupted("stopped");
}

}  // namespace railstrata
