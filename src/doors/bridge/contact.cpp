// Contacts and wheelsets that are solved state by state.
#include <algorithm>
#include <memory>
#include <mutex>

#include "ask/contact.hpp"
#include "ask/many_handles.hpp"
#include "ask/patch_forces.hpp"
#include "ask/solve_settings.hpp"
#include "ask/wheelset_slopes.hpp"
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

Json solved(Contact& contact, const Json& given) {
  State state = record_of<State>(kState, given);
  state.extrapolate = true;
  const Forces forces = contact.solve(state);
  return {{"forces", json_of(kForces, forces)}, {"remarks", contact.remarks()}};
}

void solve(Call& call) {
  const HeldContact contact(call);
  const ThreadsOfCaller threads(call.whole("threads"));
  call.answer = solved(*contact, call.argument("state"));
}

/// Derivatives by inputs of the state, by their names.
void jacobian(Call& call) {
  const HeldContact contact(call);
  std::vector<const StateMember*> inputs;
  for (const std::string& name : call.texts("inputs")) {
    const auto found = std::find_if(kState.begin(), kState.end(), [&](const StateMember& m) { return m.name == name; });
    if (found == kState.end()) throw std::invalid_argument(name + " is no input of solve");
    inputs.push_back(found);
  }
  const ThreadsOfCaller threads(call.whole("threads"));
  call.answer["slopes"] = Json::array();
  for (const Slopes& one : contact->slopes(inputs)) {
    Json named = Json::object();
    for (std::size_t k = 0; k < one.size(); ++k) named[kForces[k].name] = json_of(one[k]);
    call.answer["slopes"].push_back(std::move(named));
  }
}

BodyId body_of(Call& call) { return call.text("body") == "rail" ? BodyId::rail : BodyId::wheel; }

void give_profile(Call& call, Contact& contact) {
  const Array points = call.array("points");
  if (points.shape.size() != 2 || points.shape[1] != 2)
    throw std::invalid_argument("points: an array of shape (n, 2) is wanted");
  std::vector<Vec2> out;
  for (std::size_t k = 0; k < points.shape[0]; ++k) out.push_back({points.data[2 * k], points.data[2 * k + 1]});
  contact.set_profile(body_of(call), std::move(out));
}

void set_profile(Call& call) { give_profile(call, *HeldContact(call)); }
void set_tolerance(Call& call) { HeldContact(call)->set_tolerance(call.number("tolerance")); }

template <class T>
void copy(Call& call, const char* name) {
  const Held<T> original(call, name);
  call.make(std::make_shared<Shared<T>>(*original));
}
void copy_contact(Call& call) { copy<Contact>(call, "contact"); }
void copy_wheelset(Call& call) { copy<Wheelset>(call, "wheelset"); }

/// Copies of the arrays of a patch of the last solution.
void patch(Call& call) {
  const HeldContact contact(call);
  const auto copy = std::make_shared<ContactField>(contact->patch(call.whole("patch")).field);
  call.answer["patch"] = patch_of(*copy);
  call.make(copy);
}

Vec3 point_of(Call& call) {
  const Array about = call.array("about");
  if (about.shape != std::vector<std::size_t>{3}) throw std::invalid_argument("about: three numbers are wanted");
  return {about.data[0], about.data[1], about.data[2]};
}

void forces_of_patch(Call& call) {
  const HeldContact contact(call);
  call.answer = json_of(kPatchForces, patch_forces(*contact, call.whole("patch"), point_of(call)));
}

void stress(Call& call) {
  const HeldContact contact(call);
  const std::vector<Vec3> points = points_of(call.array("points"));
  answer_stresses(call, contact->stress(body_of(call), points));
}

void forget(Call& call) { HeldContact(call)->start = {}; }

void open_wheelset(Call& call) {
  const auto made = std::make_shared<Shared<Wheelset>>(*call.made<LoadedCase>("case"), *call.made<LoadedCase>("right"));
  for (Wheel& wheel : made->object.wheels) wheel.contact.set_cell(call.number("cell"));
  call.make(made);
}

Json solved(Wheelset& set, const Json& given) {
  WheelsetState state = record_of<WheelsetState>(kWheelsetState, given);
  state.extrapolate = true;
  const WheelsetForces found = railstrata::solve(set, state);
  Json out = json_of(kWheelsetForces, found);
  out["remarks"] = set.remarks;
  out["left"] = json_of(kWheelForces, found.wheels[kLeft]);
  out["right"] = json_of(kWheelForces, found.wheels[kRight]);
  return out;
}

void solve_wheelset(Call& call) {
  const Held<Wheelset> set(call, "wheelset");
  const ThreadsOfCaller threads(call.whole("threads"));
  call.answer = solved(*set, call.argument("state"));
}

/// Derivatives by numbers of the state, by their names.
void jacobian_of_wheelset(Call& call) {
  const Held<Wheelset> set(call, "wheelset");
  std::vector<WheelsetInput> inputs;
  for (const std::string& name : call.texts("inputs")) inputs.push_back(wheelset_input(name));
  const ThreadsOfCaller threads(call.whole("threads"));
  call.answer["slopes"] = Json::array();
  for (const WheelsetSlopes& one : slopes(*set, inputs)) {
    Json named = json_of(kWheelsetSlopes, one);
    for (const std::size_t side : {kLeft, kRight}) {
      const std::string wheel = side == kLeft ? "left" : "right";
      named[wheel + "_force"] = json_of(one.wheels[side].force);
      named[wheel + "_moment"] = json_of(one.wheels[side].moment);
    }
    call.answer["slopes"].push_back(std::move(named));
  }
}

/// All patches of a wheel, in the track's axes.
void patches_of_wheelset(Call& call) {
  const Held<Wheelset> set(call, "wheelset");
  std::optional<Vec3> about;
  if (!call.argument("about").is_null()) about = point_of(call);
  const int side = call.whole("side");
  call.answer["patches"] = Json::array();
  if (set->solved && !set->wheels[static_cast<std::size_t>(side)].contact.last()) return;  // lifted
  int count = 1;
  for (int k = 0; k < count; ++k) {
    call.answer["patches"].push_back(json_of(kPatchForces, patch_forces(*set, side, k, about)));
    count = set->wheels[static_cast<std::size_t>(side)].forces.patches;
  }
}

/// A copy of that of a side.
void contact_of_wheelset(Call& call) {
  const Held<Wheelset> set(call, "wheelset");
  const auto made =
      std::make_shared<Shared<Contact>>(set->wheels[static_cast<std::size_t>(call.whole("side"))].contact);
  made->object.of_wheelset = false;
  call.make(made);
}

void set_profile_of_wheelset(Call& call) {
  const Held<Wheelset> set(call, "wheelset");
  drop_solution(*set);
  give_profile(call, set->wheels[static_cast<std::size_t>(call.whole("side"))].contact);
}

void set_tolerance_of_wheelset(Call& call) {
  const Held<Wheelset> set(call, "wheelset");
  for (Wheel& wheel : set->wheels) wheel.contact.set_tolerance(call.number("tolerance"));
}

/// Contacts or wheelsets, each with its state: what each has found, or its fault.
template <class T>
void solve_many(Call& call) {
  const auto handles = call.made_list<Shared<T>>("handles");
  const Json& states = call.argument("states");
  std::vector<const void*> addresses;
  for (const auto& handle : handles) addresses.push_back(handle.get());
  std::vector<Json> found(handles.size());
  solve_apart(addresses, call.whole("threads"), [&](std::size_t k) {
    try {
      if (call.control.stop) throw Interrupted("stopped");
      const std::lock_guard hold(handles[k]->one_at_a_time);
      found[k] = solved(handles[k]->object, states.at(k));
    } catch (...) {
      found[k] = fault_of(std::current_exception());
    }
  });
  if (call.control.stop) throw Interrupted("stopped");
  call.answer["found"] = found;
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
          {"jacobian_of_contact", jacobian},
          {"set_profile_of_contact", set_profile},
          {"set_tolerance_of_contact", set_tolerance},
          {"copy_contact", copy_contact},
          {"solve_contacts", solve_many<Contact>},
          {"open_wheelset", open_wheelset},
          {"solve_wheelset", solve_wheelset},
          {"jacobian_of_wheelset", jacobian_of_wheelset},
          {"patches_of_wheelset", patches_of_wheelset},
          {"contact_of_wheelset", contact_of_wheelset},
          {"set_profile_of_wheelset", set_profile_of_wheelset},
          {"set_tolerance_of_wheelset", set_tolerance_of_wheelset},
          {"copy_wheelset", copy_wheelset},
          {"solve_wheelsets", solve_many<Wheelset>},
          {"keep_wheelset", start<railstrata::keep>},
          {"reset_wheelset", start<railstrata::reset>},
          {"forget_wheelset", start<railstrata::forget>}};
}

}  // namespace railstrata::bridge
