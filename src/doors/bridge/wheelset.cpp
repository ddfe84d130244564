// Wheelsets that are solved motion by motion.
#include "ask/wheelset.hpp"

#include <memory>
#include <mutex>

#include "ask/solve_settings.hpp"
#include "bridge/functions.hpp"
#include "bridge/records.hpp"
#include "core/stop_request.hpp"

namespace railstrata::bridge {
namespace {

/// A wheelset, which one thread may use at a time.
struct SharedWheelset {
  SharedWheelset(const LoadedCase& left, const LoadedCase& right) : set(left, right) {}
  Wheelset set;
  std::mutex one_at_a_time;
};

void open_wheelset(Call& call) {
  const auto made = std::make_shared<SharedWheelset>(*call.made<LoadedCase>("case"), *call.made<LoadedCase>("right"));
  for (Wheel& wheel : made->set.wheels) wheel.contact.set_cell(call.number("cell"));
  call.make(made);
}

void solve_wheelset(Call& call) {
  const auto shared = call.made<SharedWheelset>("wheelset");
  const std::lock_guard hold(shared->one_at_a_time);
  const ThreadsOfCaller threads(call.whole("threads"));
  const StopRequest stop(&call.control.stop);
  const WheelsetForces found = solve(shared->set, record_of<WheelsetState>(kWheelsetState, call.argument("state")));
  call.answer = json_of(kWheelsetForces, found);
  call.answer["left"] = json_of(kWheelForces, found.wheels[kLeft]);
  call.answer["right"] = json_of(kWheelForces, found.wheels[kRight]);
}

template <void (*kStart)(Wheelset&)>
void start(Call& call) {
  const auto shared = call.made<SharedWheelset>("wheelset");
  const std::lock_guard hold(shared->one_at_a_time);
  kStart(shared->set);
}

}  // namespace

Functions wheelset_functions() {
  return {{"open_wheelset", open_wheelset},
          {"solve_wheelset", solve_wheelset},
          {"keep_wheelset", start<railstrata::keep>},
          {"reset_wheelset", start<railstrata::reset>},
          {"forget_wheelset", start<railstrata::forget>}};
}

}  // namespace railstrata::bridge
