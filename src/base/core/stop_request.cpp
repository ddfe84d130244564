#include "core/stop_request.hpp"

#include <omp.h>

#include "core/faults.hpp"

namespace railstrata {
namespace {

thread_local const std::atomic<bool>* wish = nullptr;

}  // namespace

StopRequest::StopRequest(const std::atomic<bool>* flag) : before_(wish) { wish = flag; }
StopRequest::~StopRequest() { wish = before_; }

void stop_if_wished() {
  if (wish != nullptr && *wish && omp_in_parallel() == 0) throw Interrupted("stopped");
}

}  // namespace railstrata
