#pragma once
// A whole run: static preload, run-up, rolling, samples around the wanted positions.
#include <span>

#include "body/plastic_field.hpp"
#include "fem/rolling_sample.hpp"

namespace railstrata {

struct PositionSamples {
  double position = 0;  ///< wanted wheel position, m
  std::vector<RollingSample> samples;
};

/// Plastic strains and residual stress at the end of the run.
struct PlasticRemains {
  BodyId body = BodyId::rail;  ///< whose peak it is: the larger of both
  PlasticPeak peak;
  double work = 0;        ///< J, on the plastic strains of both bodies
  double backstress = 0;  ///< J of it that the backstresses hold; the rest has become heat
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
  bool stopped = false;   ///< ended early on demand
  PlasticExtent plastic;  ///< of both bodies at the end
  PlasticRemains remains;
};

/// A run between two steps: all that is needed to go on with it.
struct RunState {
  RunResult result;  ///< so far; wall_seconds: of all sittings
  RestartState stepper;
  std::size_t next_sample = 0;
  double next_history = 0, next_frame = 0;  ///< m, wheel positions
  std::vector<double> frame_times;          ///< s, of the frames shown so far
  EnergyBalance start_energy;
  bool started = false;                            ///< start_energy is known
  double largest_closure = 0, largest_energy = 0;  ///< J

  /// m, of the wheel from the start; on a ring, where the axle does not travel, that of the last row of the history.
  double position() const {
    const double travelled = stepper.state.axle.x;
    return travelled != 0 || result.history.empty() ? travelled : result.history.back().position;
  }
};

/// Requests to a run, looked at between two steps.
enum class Demand { go_on, save, save_and_stop };

/// Callbacks of the run. Any may be empty.
struct RunObserver {
  PreloadProgress preload;
  std::function<void(double fraction, const HistoryRow&)> progress;  ///< with every row; fraction of the way, 0 to 1
  std::function<void(const HistoryRow&)> history;                    ///< every run.history_interval
  std::function<void(const RollingSample&)> frame;  ///< evenly spaced frames, output.series_frames of them
  std::function<Demand()> demand;                   ///< asked wherever the stepper can be restarted
  /// Of a run until windows repeat (Model::until_repeated), after each whole window, with those so far: true ends it.
  std::function<bool(std::span<const PositionSamples>)> repeats;
  std::function<void(const RollingState&)> finished;  ///< the last state of a rolling that was not stopped
  /// The state to go on from: on demand, when the run stops (`stopping`), and the last good one before a
  /// NumericalError. May throw: that ends the run.
  std::function<void(const RunState&, bool stopping)> save;
};

/// before: not null: what earlier wheels have left in the rail. Throws NumericalError (NaN, lost contact, a wheel that
/// stops, no equilibrium), CaseError (wheel too heavy) and Interrupted.
/// by: what computes the steps; the result of several ranks is the same on all of them, to the last bit, as that of
/// one. Each has an observer whose functions are empty where they are on the others; its demand and preload answer the
/// same on all.
RunResult run_rolling(const RollingSystem& system, const RunObserver& observer, const RailBefore* before = nullptr,
                      const StepBy& by = {});
/// Goes on with a run that observer.save was given: result, history and samples have the same bits as those of a run in
/// one go.
RunResult resume_rolling(const RollingSystem& system, const RunObserver& observer, RunState state,
                         const StepBy& by = {});

}  // namespace railstrata
