// A step whose fields are computed by an engine (fem/step_engine.hpp).
#include "fem/stepper.hpp"

namespace railstrata {

void Stepper::use(const EngineOf& engine_of) {
  if (!engine_of) return;
  engine_ = engine_of(sys_, bodies_);
  engine_->load(state_.bodies);
  fields_here_ = true;
}

void Stepper::fetch() {
  if (fields_here_) return;
  engine_->store(state_.bodies);
  fields_here_ = true;
}

// False where energies are wanted that the engine does not know.
bool Stepper::book_stored_energy_of_engine() {
  const std::optional<StepEngine::Stored> stored = engine_->stored_energy(bodies_, drift());
  if (!stored) return false;
  balance_.strain = stored->strain;
  balance_.hourglass = stored->hourglass;
  balance_.plastic = 0;
  balance_.weight = sys_.gravity * (stored->weight_moment + sys_.axle.mass_z * state_.axle.z);
  balance_.spring = spring_energy(sys_, state_.axle, axle_rest_z_, state_.groups);
  return true;
}

bool Stepper::step_on_engine() {
  const EnergyBalance before = balance_;
  if (want_energy_ && !book_stored_energy_of_engine()) return false;
  const StepScope scope{dt(), sys_.gravity, damping_rate(), want_energy_, PlasticLook::all};
  const AxlePose pose = state_.axle.pose();
  fields_here_ = false;
  const StepEngine::Loads loads = engine_->forces(bodies_, drift(), scope, pose, state_.bodies);
  balance_.absorbed += scope.dt * loads.absorbed;

  contact_.find_rows(state_.step, bodies_, state_.bodies, pose, state_.tractions);
  contact_.gather(bodies_, state_.bodies, scope);
  contact_.enforce(scope.dt, state_.tractions);
  engine_->add_forces(contact_.surface_forces(bodies_, state_.tractions));
  book_contact(contact_.measure(scope.dt, state_.tractions));

  sums_ = engine_->update(bodies_, scope);
  book_update(scope);
  const double axle_kinetic =
      advance_axle(sys_, loads.axle, axle_drive(), axle_rest_z_, scope, state_.axle, state_.groups, balance_);
  if (want_energy_) {
    balance_.kinetic = sums_[kWheel].kinetic + sums_[kRail].kinetic + axle_kinetic;
    recorded_ = halfway(before, balance_);
  }
  advance_clock();
  engine_->constrain(pose_in_frame());
  want_energy_ = false;
  return true;
}

}  // namespace railstrata
