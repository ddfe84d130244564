#pragma once
// Where the fields of both bodies are computed, if not in the stepper's own loops: on a device (device/engine.hpp).
//
// The fields then live in the engine; the stepper has the scalars (axle, suspension, clock, energy book) and solves the
// contact on a band of lines that the engine hands it.
#include <functional>
#include <memory>
#include <optional>

#include "core/ranks.hpp"
#include "fem/axle_step.hpp"
#include "fem/contact_step.hpp"

namespace railstrata {

class StepEngine {
 public:
  StepEngine() = default;
  StepEngine(const StepEngine&) = delete;
  StepEngine& operator=(const StepEngine&) = delete;
  virtual ~StepEngine() = default;

  /// Displacements and velocities of both bodies, to the engine and back.
  virtual void load(const BodyStates& states) = 0;
  virtual void store(BodyStates& states) = 0;

  /// Of both bodies, at the displacements and velocities before a step [J]; mass times height above the undeformed
  /// bodies [kg m].
  struct Stored {
    double strain = 0, hourglass = 0, weight_moment = 0;
  };
  /// None: this engine does not know them, and the stepper takes the step itself.
  virtual std::optional<Stored> stored_energy(const RollingBodies& bodies, const std::array<double, 2>& drift) = 0;

  struct Loads {
    AxleLoads axle;
    double absorbed = 0;  ///< W, by the rail's ends
  };
  /// Forces on all nodes but those of the contact: elements, ties, the rail's ends, added mass. Nodes that wait for
  /// nothing are updated. Puts u, v and f of the running surfaces around the axle into `states`; what else stands there
  /// is old. drift: rotation of the bodies relative to their frames [rad].
  virtual Loads forces(const RollingBodies& bodies, const std::array<double, 2>& drift, const StepScope& scope,
                       const AxlePose& pose, BodyStates& states) = 0;
  /// The contact's, to those.
  virtual void add_forces(const std::array<std::vector<SurfaceForce>, 2>& forces) = 0;
  /// The nodes that waited. Returns the sums of the step's updates; zero if none are wanted. Kinetic energies have that
  /// of added mass, if stored_energy was asked for before.
  virtual std::array<UpdateSums, 2> update(const RollingBodies& bodies, const StepScope& scope) = 0;
  /// The bore moves with the axle, the slaves with their masters; pose: in the wheel's frame.
  virtual void constrain(const AxlePose& pose) = 0;
};

/// Makes the engine of a stepper; empty: none.
using EngineOf = std::function<std::unique_ptr<StepEngine>(const RollingSystem&, const RollingBodies&)>;

/// What computes the steps: several ranks, or an engine; neither: the stepper's own loops.
struct StepBy {
  Ranks ranks;
  EngineOf engine;
};

}  // namespace railstrata
