#pragma once
// What functions over the C interface share.
#include <cstddef>
#include <stdexcept>

#include "bridge/call.hpp"
#include "capi/railstrata.h"
#include "core/faults.hpp"
#include "core/stop_request.hpp"

namespace railstrata::bridge {

/// The exception that a code of the C interface came from.
[[noreturn]] inline void raise(const Call& call, const rs_error& error) {
  if (call.control.stop.load()) throw Interrupted("stopped");
  if (error.code == RS_CASE || error.code == RS_NO_ANSWER) throw CaseError(error.message);
  if (error.code == RS_NUMERICS) throw NumericalError(error.message);
  if (error.code == RS_MACHINE) throw EnvironmentError(error.message);
  throw std::runtime_error(error.message);
}

template <std::size_t kCount>
Json array_of(const double (&values)[kCount]) {
  Json out = Json::array();
  for (const double value : values) out.push_back(number(value));
  return out;
}

}  // namespace railstrata::bridge
