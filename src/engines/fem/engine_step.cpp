// Steps that an engine takes (fem/step_engine.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/faults.hpp"
#include "fem/stepper.hpp"

namespace railstrata {

void Stepper::use(const EngineOf& engine_of) {
  if (!engine_of) return;
  engine_ = engine_of(sys_, bodies_, dt());
  record_ = {state_.time, state_.step, state_.axle, contact_.forces(), 0, balance_, contact_.reached_edge()};
  RestartState restart = release_state();
  engine_->load(restart);
  restore_state(std::move(restart));
}

// The state by moves, without a copy of its fields.
RestartState Stepper::release_state() {
  RestartState out = restart_beside_state();
  out.state = std::move(state_);
  return out;
}

void Stepper::restore_state(RestartState restart) {
  state_ = std::move(restart.state);
  balance_ = restart.balance;
  bodies_[kWheel].mean = restart.mean;
  start_ = restart.start;
  contact_.restore(std::move(restart));
  fields_here_ = true;
}

void Stepper::fetch() {
  if (fields_here_) return;
  require_none_ahead();
  RestartState restart = release_state();
  engine_->store(restart);
  restore_state(std::move(restart));
}

// As many as surely end before the wheel is there, or at the next restart point; at least one.
int Stepper::steps_until_look() const {
  constexpr double kSure = 0.9;  // no sound run has a wheel that gains a tenth of its speed in so few steps
  constexpr long kInterval = ContactStep::kSearchInterval;
  const long before_restart = kInterval - state_.step % kInterval;
  const double steps = kSure * (next_look_ - position()) / (std::abs(state_.axle.vx) * dt());
  return static_cast<int>(std::clamp(steps, 1.0, static_cast<double>(before_restart)));
}

// The wheel is where something is to be looked at before the steps that surely end there are over.
void Stepper::require_none_ahead() const {
  if (!ahead_.empty())
    throw NumericalError(
        fmt::format("the run became unstable at t = {:.4g} ms: the wheel has changed its speed by a "
                    "tenth within {} steps\n    try a smaller run.step_safety",
                    1e3 * state_.time, StepEngine::kMostSteps));
}

void Stepper::step_on_engine() {
  if (want_energy_) require_none_ahead();
  if (ahead_.empty()) ahead_ = engine_->take(want_energy_ ? 1 : steps_until_look(), want_energy_);
  fields_here_ = false;
  const EnergyBalance before = balance_;
  take_over(ahead_.front());
  ahead_ = ahead_.subspan(1);
  if (want_energy_) recorded_ = halfway(before, balance_);
  want_energy_ = false;
}

void Stepper::take_over(const StepRecord& record) {
  record_ = record;
  state_.time = record.time;
  state_.step = record.step;
  state_.axle = record.axle;
  balance_ = record.balance;
  for (RollingBody& b : bodies_) b.frame.move_to(state_.time);
}

}  // namespace railstrata
