#pragma once
// A step of pads, sleepers and ballast (fem/rail_pads.hpp), by central differences; dashpots take the velocities of the
// half step before. What they dissipate is force times the mean of the velocities before and after the update, exact
// for the scheme.
#include "fem/rail_pads.hpp"

namespace railstrata {

struct TrackLosses {
  double pads = 0, ballast = 0;  ///< J
};

class TrackStep {
 public:
  explicit TrackStep(const RailPads& pads);

  /// Adds the forces of the pads to f (like internal forces, positive against the motion) and moves the sleepers on.
  /// u: of the beginning of the step, v: of the half step before.
  void press(const Field& u, const Field& v, double dt, std::vector<MassGroup>& sleepers, Field& f);
  /// Of this step; v: after the update of the rail.
  TrackLosses losses(const Field& v) const;
  /// J, in the springs of pads and ballast, and of the sleepers, at the beginning of the step (kinetic energy as
  /// that of a node: w(n-1/2) w(n+1/2)/2).
  double elastic() const { return elastic_; }
  double kinetic() const { return kinetic_; }

 private:
  struct Dashpot {
    std::ptrdiff_t index;
    double force, before;  // N, on the rail's node against its motion; m/s
  };
  void move(MassGroup& sleeper, double spring, double dashpot);

  const RailPads& pads_;
  std::vector<Dashpot> dashpots_;
  double dt_ = 0, elastic_ = 0, kinetic_ = 0;
  TrackLosses of_sleepers_;
};

}  // namespace railstrata
