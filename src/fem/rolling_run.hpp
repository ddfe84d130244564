#pragma once
// A whole run: static preload, run-up, rolling, samples around the wanted positions.
#include <atomic>

#include "fem/stepper.hpp"

namespace railstrata {

/// Stresses and displacements of a body's contact band around the wheel, on stations counted from the wheel's position (relative station 0 is nearest to it).
struct BandSample {
  int columns = 0, rows = 0, stations = 0;  ///< elements
  std::vector<double> along;                ///< stations + 1: distance of the node planes from the axle in the rolling direction, m (arc length on the wheel)
  std::vector<Sym3> stress;                 ///< Cauchy stress at the element centres, model frame, Pa; index (station * rows + row) * columns + column
  std::vector<Vec3> displacement;           ///< of the nodes, m, model frame, without the wheel's rigid motion; index (station * (rows + 1) + row) * (columns + 1) + column
};

/// One look at the moving contact.
struct RollingSample {
  double time = 0, position = 0;
  AxleMotion axle;
  ContactForces forces;
  double creepage = 0;
  BandSample rail, wheel;
  std::vector<NodeTraction> tractions;      ///< rail surface nodes of the band sample, index station * (columns + 1) + column
};

/// A row of history.csv.
struct HistoryRow {
  double time, position, torque;
  ContactForces forces;
  double p_max, creepage, axle_vx, axle_vz, spin;
  EnergyBalance energy;
  double closure;                           ///< change of the balance's total since the start, J
};

struct PositionSamples {
  double position = 0;                      ///< wanted wheel position, m
  std::vector<RollingSample> samples;
};

struct RunResult {
  PreloadResult preload;                    ///< fields emptied
  StepLimits limits;
  std::vector<HistoryRow> history;
  std::vector<PositionSamples> positions;   ///< a static case has one with one sample
  double closure = 0;                       ///< largest |closure| / largest of torque work and strain energy
  double hourglass_share = 0;               ///< largest hourglass / strain energy
  double penetration = 0;                   ///< m, largest in the measuring windows
  double run_up_damping_energy = 0;
  bool reached_edge = false;
  long steps = 0;
  double dt = 0, wall_seconds = 0, preload_wall_seconds = 0;
  long elements = 0, nodes = 0;
  bool stopped = false;                     ///< ended early because of the stop flag
};

/// What the run tells while it runs. Any may be empty.
struct RunObserver {
  PreloadProgress preload;
  std::function<void(double fraction, const HistoryRow&)> progress;
  std::function<void(const HistoryRow&)> history;
  std::function<void(const RollingSample&)> frame;   ///< evenly spaced frames, output.series_frames of them
  const std::atomic<bool>* stop = nullptr;
};

/// Throws NumericalError (NaN, lost contact, a wheel that stops, no equilibrium) and CaseError (wheel too heavy).
RunResult run_rolling(const RollingSystem& system, const RunObserver& observer);

RollingSample take_sample(const RollingSystem& system, const Field& u_rail, const Field& u_wheel, const TractionMemory& tractions, const AxlePose& pose);

}  // namespace railstrata
