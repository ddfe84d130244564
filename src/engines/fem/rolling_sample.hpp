#pragma once
// Records of the moving contact: samples of both bodies around the wheel, and rows of the history.
#include <vector>

#include "contact/patch_extent.hpp"
#include "fem/band_sample.hpp"
#include "fem/stepper.hpp"

namespace railstrata {

/// One look at the moving contact.
struct RollingSample {
  double time = 0, position = 0;
  AxleMotion axle;
  ContactForces forces;
  double creepage = 0, lateral_creepage = 0;
  BandSample rail, wheel;
  int first_station = 0;  ///< of the rail's surface: that of the first tractions; its negative if they go backwards
  std::vector<NodeTraction>
      tractions;  ///< rail surface nodes of the band sample, index station * (columns + 1) + column
};

/// The largest von Mises stress at the centres of the rail's elements around the wheel.
struct StressOnWay {
  double von_mises = 0, x = 0, depth = 0;  ///< Pa, m, m
};

/// At one of the system's watched_points.
struct WatchedStress {
  Sym3 stress;            ///< Pa, at the element's centre
  double plastic_strain;  ///< accumulated, mean of the element
};

/// A row of history.csv.
struct HistoryRow {
  double time, position, torque;
  ContactForces forces;
  double p_max, creepage, axle_vx, axle_vz, spin;
  EnergyBalance energy;
  double closure;            ///< change of the balance's total since the start, J
  double lateral_creepage;   ///< in the contact plane
  double axle_y;             ///< m, travel sideways
  double foot_z, sleeper_z;  ///< m, of a rail on a track: its foot below the wheel, and the nearest sleeper
  PatchOnWay way;            ///< over what changes along rail or wheel
  StressOnWay stress;        ///< the same
  std::vector<WatchedStress> points;
  InterfaceGap interface;  ///< between layers that have come off and their base
};

/// A body as it is sampled.
struct SampledBody {
  const Field& u;                 ///< m, model frame
  const PlasticHistory& history;  ///< of the elements, as committed
};
/// Time, axle, forces and creepage are left at zero.
RollingSample take_sample(const RollingSystem& system, const SampledBody& rail, const SampledBody& wheel,
                          const SurfaceTractions& tractions, const AxlePose& pose);

/// Sample of the stepper's present state.
RollingSample take_sample(const Stepper& stepper);

/// Row of the stepper's last step, whose energies must have been requested.
HistoryRow history_row(const Stepper& stepper, const EnergyBalance& start);

}  // namespace railstrata
