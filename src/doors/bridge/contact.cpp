// Contacts that are solved state by state.
#include "ask/contact.hpp"

#include <memory>
#include <mutex>

#include "ask/patch_forces.hpp"
#include "ask/solve_settings.hpp"
#include "bridge/functions.hpp"
#include "bridge/patches.hpp"
#include "bridge/records.hpp"
#include "core/stop_request.hpp"

namespace railstrata::bridge {
namespace {

/// A contact, which one thread may use at a time.
struct SharedContact {
  explicit SharedContact(const LoadedCase& loaded) : contact(loaded) {}
  Contact contact;
  std::mutex one_at_a_time;
};

/// A contact for as long as a call uses it.
struct HeldContact {
  explicit HeldContact(Call& call)
      : shared(call.made<SharedContact>("contact")), hold(shared->one_at_a_time), stop(&call.control.stop) {}
  Contact* operator->() const { return &shared->contact; }
  std::shared_ptr<SharedContact> shared;
  std::lock_guard<std::mutex> hold;
  StopRequest stop;
};

void open_contact(Call& call) {
  const auto made = std::make_shared<SharedContact>(*call.made<LoadedCase>("case"));
  made->contact.set_cell(call.number("cell"));
  call.make(made);
}

void solve(Call& call) {
  const HeldContact contact(call);
  const ThreadsOfCaller threads(call.whole("threads"));
  const Forces forces = contact->solve(record_of<State>(kState, call.argument("state")));
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
  call.answer = json_of(kPatchForces, patch_forces(*contact.operator->(), call.whole("patch"), point));
}

void stress(Call& call) {
  const HeldContact contact(call);
  const std::vector<Vec3> points = points_of(call.array("points"));
  const BodyId body = call.text("body") == "rail" ? BodyId::rail : BodyId::wheel;
  answer_stresses(call, contact->stress(body, points));
}

void forget(Call& call) { HeldContact(call)->start = {}; }

}  // namespace

Functions contact_functions() {
  return {{"open_contact", open_contact},       {"solve_contact", solve},      {"patch_of_contact", patch},
          {"forces_of_patch", forces_of_patch}, {"stress_of_contact", stress}, {"forget_contact", forget}};
}

}  // namespace railstrata::bridge
