#pragma once
// The contact of one step: which rows, which free velocities, which tractions, and their forces on both bodies.
#include <vector>

#include "contact/enforcement.hpp"
#include "fem/contact_law.hpp"
#include "fem/node_update.hpp"
#include "fem/rolling_system.hpp"

namespace railstrata {

/// How far and how close the search looks.
struct SearchWindow {
  double half_length = 0;  ///< m, along the rail from the axle
  double gap = 0;          ///< m
};

SearchWindow search_window(const RollingSystem& system);

class ContactStep {
 public:
  static constexpr int kSearchInterval = 16;  ///< steps; the wheel moves less than 0.1 mm between searches

  explicit ContactStep(const RollingSystem& system);

  /// Rows of this step. Every kSearchInterval steps they are searched anew, and nodes that left the neighbourhood of
  /// the patch lose their tractions.
  void find_rows(long step, RollingBodies& bodies, const BodyStates& states, const AxlePose& pose,
                 SurfaceTractions& tractions);

  /// Free velocities of the nodes of the contact and how they answer an impulse.
  void gather(const RollingBodies& bodies, const BodyStates& states, const StepScope& scope);

  /// The tractions that hold at the end of the step.
  void enforce(double dt, SurfaceTractions& tractions) { enforce_contact(*rows_, dt, options_, system_, tractions); }

  /// Adds the tractions to the forces.
  void apply_tractions(const RollingBodies& bodies, BodyStates& states, const SurfaceTractions& tractions) const;

  /// Sums the forces on the wheel and what was lost; adds friction's work to that of the nodes.
  ContactLosses measure(double dt, SurfaceTractions& tractions);

  const ContactForces& forces() const { return forces_; }
  bool reached_edge() const { return reached_edge_; }

  /// Result of this search that the next one starts from.
  void save(RestartState& to) const;
  void restore(RestartState&& from);

 private:
  Vec3 force_on_rail(const ContactRow& row, const SurfaceTractions& tractions) const;

  MortarContact search_;
  SearchWindow window_;
  const EnforcementOptions& options_;
  const MortarRows* rows_ = nullptr;
  ContactSystem system_;
  std::vector<NodeTraction> kept_;
  ContactForces forces_;
  bool reached_edge_ = false;
};

}  // namespace railstrata
