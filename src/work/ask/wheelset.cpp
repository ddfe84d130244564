#include "ask/wheelset.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "ask/wheelset_forces.hpp"
#include "ask/wheelset_search.hpp"
#include "core/faults.hpp"
#include "rules/clashes.hpp"

namespace railstrata {

namespace {

std::array<double, 2> shifts_of(const WheelsetState& s) { return {s.y - s.rail_y[kLeft], s.y - s.rail_y[kRight]}; }

/// Where a wheel touches at several places, whose shares change fast with the shift: descents under the same force and
/// the left share of the load go on as from the solution before to the last one.
void follow(Wheelset& set, const WheelsetState& state) {
  constexpr double kFarthest = 2;  // steps
  const auto& [last, before] = set.sunk;
  if (!last || !before || !last->several || !before->several) return;
  const std::array<double, 2> now = shifts_of(state);
  for (std::size_t k : {0, 1}) {
    const double share = (now[k] - last->shift[k]) / (last->shift[k] - before->shift[k]);
    if (!(share > 0 && share <= kFarthest && last->stiffening[k].descent > 0)) continue;
    Stiffening& s = set.stiffening[k];
    s = last->stiffening[k];
    s.scale *= std::pow(before->stiffening[k].descent_at(s.force) / s.descent, share * s.power);
    s.descent = 0;  // the power stays
    if (k == kLeft) set.left_share = last->left_share + share * (last->left_share - before->left_share);
  }
}

void remember(Wheelset& set, const WheelsetState& state) {
  const bool several = at_several_places(set.wheels[kLeft]) || at_several_places(set.wheels[kRight]);
  set.sunk[1] = std::exchange(set.sunk[0], SunkWheelset{shifts_of(state), set.stiffening, set.left_share, several});
}

/// Height and, unless it is given, the roll at which the wheels touch without a force.
double hang(Wheelset& set, const WheelsetState& state) {
  if (state.roll_moment != 0)
    throw NoAnswer(fmt::format("a roll moment of {:.4g} N m tips the wheelset over under no load", state.roll_moment),
                   "give a roll_moment of 0, or the roll");
  if (!state.roll && !tilt(set, state, {0, 0}, false))
    throw NumericalError("the roll at which both wheels touch was not found");
  const double z = std::max(height_touching(set.wheels[0]), height_touching(set.wheels[1]));
  press(set, {0, 0});
  return z;
}

void require_state(const WheelsetState& s) {
  if (!(s.z && s.roll && !s.load) && !(s.load && !s.z))
    throw CaseError("the state does not say what is given", "give z and roll, load and roll, or load");
  if (s.load && !(*s.load >= 0)) throw CaseError(fmt::format("load = {:g}", *s.load), "give a load of 0 N or more");
  const auto require = [](double value, const std::string& name) {  // else answered as a wheel that misses its rail
    if (!std::isfinite(value)) throw CaseError(fmt::format("{} = {:g}", name, value), "give a finite number");
  };
  for (const auto& row : kWheelsetState)
    with_member(row, s, [&](const auto& value) {
      if constexpr (requires { value.size(); })
        for (std::size_t side : {kLeft, kRight}) require(value[side], fmt::format("{}[{}]", row.name, side));
      else if constexpr (requires { value.has_value(); })
        require(value.value_or(0), row.name);
      else
        require(value, row.name);
    });
}

}  // namespace

Wheel::Wheel(const LoadedCase& loaded) : contact(loaded), at_rest(track()) {
  at_rest.lateral_shift = 0;
  contact.of_wheelset = true;
  require_support(uses::kWheelset, loaded);
}

void drop_solution(Wheelset& set) {
  set.solved.reset();
  set.remarks.clear();
  for (Wheel& w : set.wheels) w.contact.drop_solution();
}

WheelsetForces solve(Wheelset& set, const WheelsetState& state) {
  drop_solution(set);
  require_state(state);
  set.solutions = 0;
  if (state.roll) place(set, state, *state.roll);
  WheelsetForces out;
  if (state.z) {
    out.z = *state.z;
    press(set, {descent_at(set.wheels[0], out.z), descent_at(set.wheels[1], out.z)}, state.extrapolate);
  } else {
    follow(set, state);
    out.z = *state.load == 0 ? hang(set, state) : state.roll ? sink(set, *state.load) : lean(set, state);
    remember(set, state);
  }
  out.roll = set.roll;
  out.solutions = set.solutions;
  set.solved = {state, out.z, out.roll};
  for (std::size_t side : {kLeft, kRight}) {
    out.wheels[side] = forces_of(set, side);
    out.force += out.wheels[side].force;
    out.moment += out.wheels[side].moment;
    out.beyond += out.wheels[side].beyond ? 1 : 0;
  }
  set.remarks = remarks_of(set);
  return out;
}

void keep(Wheelset& set) {
  set.kept = {set.roll,
              set.tilting,
              set.left_share,
              set.stiffening,
              set.leaning,
              set.sunk,
              {set.wheels[0].contact.start, set.wheels[1].contact.start}};
}

void reset(Wheelset& set) {
  set.roll = set.kept.roll;
  set.tilting = set.kept.tilting;
  set.left_share = set.kept.left_share;
  set.stiffening = set.kept.stiffening;
  set.leaning = set.kept.leaning;
  set.sunk = set.kept.sunk;
  for (std::size_t side : {kLeft, kRight}) set.wheels[side].contact.start = set.kept.contacts[side];
}

void forget(Wheelset& set) {
  set.roll = set.tilting = 0;
  set.left_share = 0.5;
  set.stiffening = {};
  set.leaning = {};
  set.sunk = {};
  for (Wheel& w : set.wheels) w.contact.start = {};
}

}  // namespace railstrata
