#pragma once
// A whole run: static preload, run-up, rolling, samples around the wanted positions.
#include <atomic>

#include "fem/stepper.hpp"

namespace railstrata {

/// Stresses and displacements of a body's contact band around the wheel, on stations counted from the wheel's position
/// (relative station 0 is nearest to it).
struct BandSample {
  int columns = 0, rows = 0, stations = 0;  ///< elements
  std::vector<double> along;  ///< stations + 1: distance of the node planes from the axle in the rolling direction, m
                              ///< (arc length on the wheel)
  std::vector<Sym3> stress;   ///< Cauchy stress at the element centres, model frame, Pa; index (station * rows + row) *
                              ///< columns + column
  std::vector<Vec3> displacement;  ///< of the nodes, m, model frame, without the wheel's rigid motion; index (station *
                                   ///< (rows + 1) + row) * (columns + 1) + column
};

/// One look at the moving contact.
struct RollingSample {
  double time = 0, position = 0;
  AxleMotion axle;
  ContactForces forces;
  double creepage = 0;
  BandSample rail, wheel;
  std::vector<NodeTraction>
      tractions;  ///< rail surface nodes of the band sample, index station * (columns + 1) + column
};

/// A row of history.csv.
struct HistoryRow {
  double time, position, torque;
  ContactForces forces;
  double p_max, creepage, axle_vx, axle_vz, spin;
  EnergyBalance energy;
  double closure;  ///< change of the balance's total since the start, J
};

struct PositionSamples {
  double position = 0;  ///< wanted wheel position, m
  std::vector<RollingSample> samples;
};

struct RunResult {
  PreloadResult preload;  ///< fields emptied
  StepLimits limits;
  std::vector<HistoryRow> history;
  std::vector<PositionSamples> positions;  ///< a static case has one with one sample
  double closure = 0;                      ///< largest |closure| / largest of torque work and strain energy
  double hourglass_share = 0;              ///< largest hourglass / strain energy
  double penetration = 0;                  ///< m, largest in the measuring windows
  double run_up_damping_energy = 0;
  bool reached_edge = false;
  long steps = 0;
  double dt = 0, wall_seconds = 0, preload_wall_seconds = 0;
  double output_wall_seconds = 0;  ///< of the rolling in this sitting: samples, histories, pictures, checkpoints
  long elements = 0, nodes = 0;
  bool stopped = false;  ///< ended early on demand
};

/// A run between two steps: all that is needed to go on with it.
struct RunState {
  RunResult result;  ///< so far; wall_seconds: of all sittings
  StepperMemory stepper;
  std::size_t next_sample = 0;
  double next_history = 0, next_frame = 0;  ///< m, wheel positions
  std::vector<double> frame_times;          ///< s, of the frames told so far
  EnergyBalance start_energy;
  bool started = false;                            ///< start_energy is known
  double largest_closure = 0, largest_energy = 0;  ///< J
};

/// What may be asked of a run between two steps.
enum class Demand { go_on, save, save_and_stop };

/// What the run tells while it runs. Any may be empty.
struct RunObserver {
  PreloadProgress preload;
  std::function<void(double fraction, const HistoryRow&)> progress;
  std::function<void(const HistoryRow&)> history;
  std::function<void(const RollingSample&)> frame;  ///< evenly spaced frames, output.series_frames of them
  const std::atomic<bool>* stop = nullptr;          ///< of the static preload, which throws Interrupted
  std::function<Demand()> demand;                   ///< asked every sixteen steps
  std::function<void(const RunState&)> save;        ///< on demand, and the last good state before a NumericalError
};

/// Throws NumericalError (NaN, lost contact, a wheel that stops, no equilibrium), CaseError (wheel too heavy) and
/// Interrupted.
RunResult run_rolling(const RollingSystem& system, const RunObserver& observer);
/// Goes on with a run that observer.save was given: result, history and samples have the same bits as those of a run in
/// one go.
RunResult resume_rolling(const RollingSystem& system, const RunObserver& observer, RunState state);

RollingSample take_sample(const RollingSystem& system, const Field& u_rail, const Field& u_wheel,
                          const TractionMemory& tractions, const AxlePose& pose);

}  // namespace railstrata
