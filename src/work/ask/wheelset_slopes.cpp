#include "ask/wheelset_slopes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string_view>

#include "ask/wheelset_forces.hpp"
#include "ask/wheelset_wheel.hpp"
#include "core/faults.hpp"

namespace railstrata {
namespace {

using Wrenches = std::array<Wrench, 2>;

/// That of the size of the list: there is none.
std::size_t row_of(std::string_view name) {
  std::size_t k = 0;
  while (k < kWheelsetState.size() && kWheelsetState[k].name != name) ++k;
  return k;
}

bool is_pair(std::size_t row) {
  return std::holds_alternative<std::array<double, 2> WheelsetState::*>(kWheelsetState[row].at);
}

/// The number that an input is, of a state that has it.
double& number_of(WheelsetState& state, const WheelsetInput& input) {
  double* out = nullptr;
  with_member(kWheelsetState[input.row], state, [&](auto& value) {
    if constexpr (requires { value.size(); })
      out = &value[input.side];
    else if constexpr (requires { value.has_value(); })
      out = &value.value();
    else
      out = &value;
  });
  return *out;
}

/// z and roll as they were given or found: forces follow from motions alone.
WheelsetState pressed_state(const SolvedWheelset& solved) {
  WheelsetState out = solved.state;
  out.z = solved.z;
  out.roll = solved.roll;
  out.load.reset();
  out.roll_moment = 0;
  return out;
}

/// Of a difference: small beside what tractions and geometry do on the way to a cell's coming into contact, large
/// beside round-off.
double step_of(const WheelsetInput& input, double speed) {
  constexpr double kLength = 2e-9, kHeight = 2e-10, kAngle = 1e-7, kTilt = 3e-10, kCreepage = 1e-8;
  const std::string_view name = kWheelsetState[input.row].name, unit = kWheelsetState[input.row].unit;
  if (unit == "m") return name == "z" || name == "rail_z" ? kHeight : kLength;
  if (unit == "rad") return name == "roll" ? kTilt : kAngle;
  return kCreepage * speed;
}

/// Whether it moves a wheel or a rail; else it changes how they slip.
bool moves(const WheelsetInput& input) {
  const std::string_view unit = kWheelsetState[input.row].unit;
  return unit == "m" || unit == "rad";
}

constexpr std::size_t kSlips = 4;
/// Creepages, spin and the share of rolling of a state.
double& slip_of(State& state, std::size_t k) {
  double* const of[kSlips] = {&*state.creepage_x, &*state.creepage_y, &*state.spin, &state.rolling_share};
  return *of[k];
}

/// Derivatives of what one wheel carries, in its own axes: by the linear equations of its last solution, all rates
/// through the slip that they make; else between two solutions.
class WheelSlopes {
 public:
  WheelSlopes(Wheel& wheel, std::size_t side, const WheelsetState& state)
      : wheel_(wheel),
        side_(side),
        state_(state),
        speed_(slip_at(wheel.track(), wheel.reference, wheel.motion, wheel.rail).speed),
        known_{&wheel.touching(), descent_at(wheel, *state.z)},
        more_(wheel),
        less_(wheel),
        equations_(wheel.contact.equations()) {
    for (Wheel* w : {&more_, &less_}) {
      w->contact.set_tolerance(kTolerance);
      w->contact.start = {};
    }
  }

  Wrench by(const WheelsetInput& input) {
    if (!equations_) return {};
    const bool linear = equations_->of && !wheel_.forces.beyond;
    if (linear && !moves(input)) return through_slip(input);
    const double step = (linear ? 1 : kLonger) * step_of(input, speed_);
    const std::array<double, 2> descents{move(more_, input, step), move(less_, input, -step)};
    return linear ? linearised(state_under(more_, descents[0]), state_under(less_, descents[1]), step)
                  : between(descents, step);
  }

 private:
  static constexpr double kTolerance = 1e-10, kLonger = 30;  // of differences: a step that their errors allow

  /// Returns the descent.
  double move(Wheel& w, const WheelsetInput& input, double by) {
    at_home_ = false;
    WheelsetState there = state_;
    number_of(there, input) += by;
    place(w, side_, there, *there.roll, {}, known_);
    return descent_at(w, *there.z);
  }

  /// Returns the state of the contact, at the wheel's own place.
  State slipping(const WheelsetInput& input, double by) {
    WheelsetState there = state_;
    number_of(there, input) += by;
    turn(more_, side_, there, *there.roll);
    return state_under(more_, descent_at(more_, *there.z));
  }

  Wrench through_slip(const WheelsetInput& input) {
    if (!at_home_)
      for (Wheel* w : {&more_, &less_}) place(*w, side_, state_, *state_.roll, {}, known_);
    at_home_ = true;
    if (!by_slip_) find_slip_columns();
    const double step = step_of(input, speed_);
    State above = slipping(input, step), below = slipping(input, -step);
    Wrench out;
    for (std::size_t k = 0; k < kSlips; ++k) {
      const double share = 0.5 / step * (slip_of(above, k) - slip_of(below, k));
      out.force += share * (*by_slip_)[k].force;
      out.moment += share * (*by_slip_)[k].moment;
    }
    return out;
  }

  /// By one slip each.
  void find_slip_columns() {
    constexpr double kSteps[kSlips] = {1e-8, 1e-8, 1e-6, 1e-6};
    by_slip_.emplace();
    const State here = state_under(more_, descent_at(more_, *state_.z));
    state_under(less_, here.descent);
    for (std::size_t k = 0; k < kSlips; ++k) {
      State above = here, below = here;
      slip_of(above, k) += kSteps[k];
      slip_of(below, k) -= kSteps[k];
      (*by_slip_)[k] = linearised(above, below, kSteps[k]);
    }
  }

  Wrench linearised(const State& above, const State& below, double step) {
    ContactDerivatives& of = *equations_->of;
    if (!weighed_) {
      const PlaneTractions here = of.here();
      of.weigh(wrench_sums(wheel_, here.plane, here.field));
      weighed_ = true;
    }
    const auto [more, less, sums] =
        of.change_of(more_.contact.case_in(above), less_.contact.case_in(below), {above.descent, below.descent}, step);
    return slope(carried_by(more_, more.plane, more.field), carried_by(less_, less.plane, less.field), step) +
           wrench_from(wheel_, sums);
  }

  Wrench between(const std::array<double, 2>& descents, double step) {
    press(more_, descents[0], true);
    press(less_, descents[1], true);
    return slope({more_.force, more_.moment}, {less_.force, less_.moment}, step);
  }

  static Wrench slope(const Wrench& more, const Wrench& less, double step) {
    const double share = 0.5 / step;
    return {share * (more.force - less.force), share * (more.moment - less.moment)};
  }

  Wheel& wheel_;
  std::size_t side_;
  const WheelsetState& state_;
  double speed_;  ///< m/s, that creepages are of
  KnownPlace known_;
  Wheel more_, less_;
  bool at_home_ = false;  ///< these two stand where the wheel stands
  std::unique_ptr<ContactEquations> equations_;
  bool weighed_ = false;  ///< they have the wheel's sums
  std::optional<std::array<Wrench, kSlips>> by_slip_;
};

/// Derivatives of the forces by motions, z and roll standing still, each once.
class PressedSlopes {
 public:
  explicit PressedSlopes(Wheelset& set)
      : set_(set),
        state_(pressed_state(*set.solved)),
        left_(set.wheels[kLeft], kLeft, state_),
        right_(set.wheels[kRight], kRight, state_) {}

  Wrenches by(const WheelsetInput& input) {
    const bool one = is_pair(input.row);
    Wrenches out;
    if (!one || input.side == kLeft) out[kLeft] = in_track(set_, kLeft, left_.by(input));
    if (!one || input.side == kRight) out[kRight] = in_track(set_, kRight, right_.by(input));
    return out;
  }

 private:
  Wheelset& set_;
  WheelsetState state_;
  WheelSlopes left_, right_;
};

void add(const Wrenches& column, double by, WheelsetSlopes& out) {
  for (std::size_t side : {kLeft, kRight}) {
    out.wheels[side].force += by * column[side].force;
    out.wheels[side].moment += by * column[side].moment;
    out.force += by * column[side].force;
    out.moment += by * column[side].moment;
  }
}

/// What is found under a load moves so that the vertical force stays the load and, where the roll is found too, the
/// moment about x that given.
class FoundUnderLoad {
 public:
  FoundUnderLoad(const WheelsetState& state, PressedSlopes& pressed) {
    if (!state.load) return;
    columns_.push_back(pressed.by({row_of("z")}));
    if (!state.roll) columns_.push_back(pressed.by({row_of("roll")}));
  }

  /// load, roll_moment: how the input changes these.
  void follow(double load, double roll_moment, WheelsetSlopes& out) const {
    if (columns_.empty()) return;
    WheelsetSlopes by_z, by_roll;
    add(columns_[0], 1, by_z);
    const double force = load - out.force.z, moment = -roll_moment - out.moment.x;
    if (columns_.size() == 1) {
      out.z = force / by_z.force.z;
    } else {
      add(columns_[1], 1, by_roll);
      const double det = by_z.force.z * by_roll.moment.x - by_roll.force.z * by_z.moment.x;
      out.z = (force * by_roll.moment.x - by_roll.force.z * moment) / det;
      out.roll = (by_z.force.z * moment - force * by_z.moment.x) / det;
      add(columns_[1], out.roll, out);
    }
    add(columns_[0], out.z, out);
  }

 private:
  std::vector<Wrenches> columns_;
};

/// Throws CaseError: no input, or a result of the state.
void require_input(const WheelsetInput& input, const WheelsetState& state) {
  if (input.row >= kWheelsetState.size() || input.side > (is_pair(input.row) ? kRight : kLeft))
    throw CaseError(fmt::format("there is no input {} of side {}", input.row, input.side),
                    "give a number of the wheelset's state");
  const std::string_view name = kWheelsetState[input.row].name;
  const bool result = (name == "z" && !state.z) || (name == "roll" && !state.roll) || (name == "load" && !state.load) ||
                      (name == "roll_moment" && (state.roll || !state.load));
  if (result)
    throw CaseError(fmt::format("{} is a result of the last state, not an input", name),
                    "ask for the derivative by another input, or give this one in the state");
}

}  // namespace

WheelsetInput wheelset_input(std::string_view name) {
  const std::size_t bracket = name.find('[');
  const WheelsetInput out{row_of(name.substr(0, bracket)), name.ends_with("[1]") ? kRight : kLeft};
  const bool side = bracket != name.npos && (name.ends_with("[0]") || name.ends_with("[1]"));
  if (out.row == kWheelsetState.size() || is_pair(out.row) != side || (side && bracket + 3 != name.size()))
    throw CaseError(fmt::format("{} is no number of a wheelset's state", name),
                    "give y, yaw and so on, of pairs rail_y[0] or rail_y[1]");
  return out;
}

std::vector<WheelsetSlopes> slopes(Wheelset& set, const std::vector<WheelsetInput>& inputs) {
  if (!set.solved) throw CaseError("there is no solution", "solve a state first");
  const WheelsetState& state = set.solved->state;
  for (const WheelsetInput& input : inputs) require_input(input, state);
  PressedSlopes pressed(set);
  const FoundUnderLoad found(state, pressed);
  std::vector<WheelsetSlopes> out;
  for (const WheelsetInput& input : inputs) {
    const std::string_view name = kWheelsetState[input.row].name;
    const bool load = name == "load", moment = name == "roll_moment";
    WheelsetSlopes& one = out.emplace_back();
    if (!load && !moment) add(pressed.by(input), 1, one);
    if (state.z && name == "z") one.z = 1;
    if (state.roll && name == "roll") one.roll = 1;
    found.follow(load, moment, one);
  }
  return out;
}

}  // namespace railstrata
