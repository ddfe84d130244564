#pragma once
// An engine takes whole steps in the stepper's place: a device (device/engine.hpp).
//
// Fields, axle, suspension, contact and energy book then live in the engine. The stepper asks for some steps at once
// and gets a record of each: what its callers look at between steps.
#include <functional>
#include <memory>
#include <span>

#include "core/ranks.hpp"
#include "fem/axle_step.hpp"
#include "fem/contact_step.hpp"
#include "fem/rolling_state.hpp"
#include "fem/steady_start.hpp"
#include "fem/step_record.hpp"

namespace railstrata {

class StepEngine {
 public:
  /// Most steps that are taken at once.
  static constexpr int kMostSteps = ContactStep::kSearchInterval;

  StepEngine() = default;
  StepEngine(const StepEngine&) = delete;
  StepEngine& operator=(const StepEngine&) = delete;
  virtual ~StepEngine() = default;

  /// Takes over where the contact is searched anew.
  virtual void load(const RestartState& state) = 0;
  /// Into arrays of the right sizes.
  virtual void store(RestartState& state) = 0;
  /// `count` steps, at most kMostSteps; energies: with those stored at the beginning of the first. The records are
  /// valid until the next call.
  virtual std::span<const StepRecord> take(int count, bool energies) = 0;
};

/// Makes the engine of a stepper with steps of dt [s]; empty: none.
using EngineOf = std::function<std::unique_ptr<StepEngine>(const RollingSystem&, const RollingBodies&, double dt)>;

/// Who computes the steps: several ranks, or an engine; neither: the stepper's own loops. And the friction that they
/// start with; none: at rest.
struct StepBy {
  Ranks ranks = {};
  EngineOf engine = {};
  SteadyFriction friction = {};
};

}  // namespace railstrata
