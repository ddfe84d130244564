// Contacts and wheelsets that are solved state by state.
#include <memory>
#include <mutex>

#include "ask/contact.hpp"
#include "ask/patch_forces.hpp"
#include "ask/solve_settings.hpp"
#include "ask/wheelset.hpp"
#include "bridge/records.hpp"
#include "core/stop_request.hpp"

namespace railstrata::bridge {
namespace {

/// A contact or a wheelset, which one thread may use at a time.
template <class T>
struct Shared {
  template <class... Cases>
  explicit Shared(const Cases&... cases) : object(cases...) {}
  T object;
  std::mutex one_at_a_time;
};

/// The same for as long as a call uses it.
template <class T>
struct Held {
  Held(Call& call, const char* name)
      : shared(call.made<Shared<T>>(name)), hold(shared->one_at_a_time), stop(&call.control.stop) {}
  T& operator*() const { return shared->object; }
  T* operator->() const { return &shared->object; }
  std::shared_ptr<Shared<T>> shared;
  std::lock_guard<std::mutex> hold;
  StopRequest stop;
};

struct HeldContact : Held<Contact> {
  explicit HeldContact(Call& call) : Held(call, "contact") {}
};

void open_contact(Call& call) {
  const auto made = std::make_shared<Shared<Contact>>(*call.made<LoadedCase>("case"));
  made->object.set_cell(call.number("cell"));
  call.make(made);
}

void solve(Call& call) {
  const HeldContact contact(call);
  const ThreadsOfCaller threads(call.whole("threads"));
  State state = record_of<State>(kState, call.argument("state"));
  state.extrapolate = true;
  const Forces forces = contact->solve(state);
  call.answer = {{"forces", json_of(kForces, forces)}, {"remarks", contact->remarks()}};
}

/// Copies of the arrays of a patch of the last solution.
void patch(Call& call) {
  const HeldContact contact(call);
  const auto copy = std::make_shared<ContactField>(contact->patch(call.whole("patch")).field);
  call.answer["patch"] = patch_of(*copy);
  call.make(copy);
}

void forces_of_patch(Call& call) {
  const HeldContact contact(call);
  const Array about = call.array("about");
  if (about.shape != std::vector<std::size_t>{3}) throw std::invalid_argument("about: three numbers are wanted");
  const Vec3 point{about.data[0], about.data[1], about.data[2]};
  call.answer = json_of(kPatchForces, patch_forces(*contact, call.whole("patch"), point));
}

void stress(Call& call) {
  const HeldContact contact(call);
  const std::vector<Vec3> points = points_of(call.array("points"));
  const BodyId body = call.text("body") == "rail" ? BodyId::rail : BodyId::wheel;
  answer_stresses(call, contact->stress(body, points));
}

void forget(Call& call) { HeldContact(call)->start = {}; }

void open_wheelset(Call& call) {
  const auto made = std::make_shared<Shared<Wheelset>>(*call.made<LoadedCase>("case"), *call.made<LoadedCase>("right"));
  for (Wheel& wheel : made->object.wheels) wheel.contact.set_cell(call.number("cell"));
  call.make(made);
}

void solve_wheelset(Call& call) {
  const Held<Wheelset> set(call, "wheelset");
  const ThreadsOfCaller threads(call.whole("threads"));
  WheelsetState state = record_of<WheelsetState>(kWheelsetState, call.argument("state"));
  state.extrapolate = true;
  const WheelsetForces found = solve(*set, state);
  call.answer = json_of(kWheelsetForces, found);
  call.answer["remarks"] = set->remarks;
  call.answer["left"] = json_of(kWheelForces, found.wheels[kLeft]);
  call.answer["right"] = json_of(kWheelForces, found.wheels[kRight]);
}

template <void (*kStart)(Wheelset&)>
void start(Call& call) {
  kStart(*Held<Wheelset>(call, "wheelset"));
}

}  // namespace

Functions contact_functions() {
  return {{"open_contact", open_contact},
          {"solve_contact", solve},
          {"patch_of_contact", patch},
          {"forces_of_patch", forces_of_patch},
          {"stress_of_contact", stress},
          {"forget_contact", forget},
          {"open_wheelset", open_wheelset},
          {"solve_wheelset", solve_wheelset},
          {"keep_wheelset", start<railstrata::keep>},
          {"reset_wheelset", start<railstrata::reset>},
          {"forget_wheelset", start<railstrata::forget>}};
}

}  // namespace railstrata::bridge
