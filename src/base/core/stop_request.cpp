#include "core/stop_request.hpp"

#include <omp.h>

#include "core/faults.hpp"

namespace railstrata {
namespace {

thread_local const std::atomic<bool>* requested = nullptr;

}  // namespace

StopRequest::StopRequest(const std::atomic<bool>* flag) : before_(requested) { requested = flag; }
StopRequest::~StopRequest() { requested = before_; }

void stop_if_requested() {
  if (requested != nullptr && *requested && omp_in_parallel() == 0) throw Interrupted("stopped");
}

}  // namespace railstrata
