#include "passes/pass_runner.hpp"

#include <utility>

namespace railstrata {

PassRunner::PassRunner(const CaseSpec& spec, std::vector<BemResult> solutions, FollowingContact* following,
                       const Control* control)
    : spec_(spec), solutions_(std::move(solutions)), following_(following), rail_(rail_passes(spec_, solutions_)) {
  renew_body();
  limits_.control = control;
}

void PassRunner::renew_body() { body_.emplace(rail_.grid, rail_.rows, rail_.below, rail_.initial_stress); }

void PassRunner::stand(Place place, PassState& state) {
  if (!strain_.empty() && place == place_) return;
  if (!strain_.empty()) move_guess(rail_.grid, place.column - place_.column, state);
  strain_ = contact_strain(rail_, *body_, rail_.contact_stress.at(place.solution), place.column);
  place_ = place;
}

void PassRunner::take_back(Place place, Field strain) {
  place_ = place;
  strain_ = std::move(strain);
}

FollowedPass PassRunner::roll(PassState& state) {
  FollowedPass pass;
  if (following_) {
    pass = following_->run_pass(rail_, *body_, place_.solution, place_.column, state, limits_);
    strain_ = std::move(pass.contact_strain);
    return pass;
  }
  pass.result = body_->run_pass(strain_, state, limits_);
  pass.largest_pressure = contact().patch.largest_pressure;
  pass.creepage = contact().rigid_slip.x;
  return pass;
}

bool PassRunner::lengthen(double late_flow, PassState& state) {
  const std::optional<double> window = longer_window(spec_.passes, rail_, late_flow);
  if (!window) return false;
  CaseSpec longer = spec_;
  longer.passes.window = window;
  rail_ = rail_passes(longer, solutions_);
  renew_body();
  strain_.clear();
  state = body_->virgin();
  return true;
}

FollowedPass PassRunner::next(Place place, PassState& state, const std::function<void()>& lengthened) {
  stand(place, state);
  FollowedPass pass = roll(state);
  while (state.passes == 1 && lengthen(pass.result.late_flow, state)) {
    if (lengthened) lengthened();
    stand(place, state);
    pass = roll(state);
  }
  return pass;
}

}  // namespace railstrata
