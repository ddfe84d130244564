#pragma once
// Residual state after a run with run.plasticity: plastic strain of the section and residual stress of the rail at
// rest, without the wheel.
#include <span>
#include <string>
#include <string_view>

#include "fem/rolling_run.hpp"
#include "passes/rolled_pass.hpp"
#include "record/unit.hpp"

namespace railstrata {

struct RunResidual {
  double from = 0, to = 0;  ///< m from where the wheel was put on: the stations whose mean is the section's
  RolledPass pass;          ///< of the whole run; of its row extremes, displacements and balance
  std::string none;         ///< why there is none; empty: there is
};

/// The steady stations of a run, in half-lengths a of Hertz's ellipse: from 6 to 4 behind the wheel at its end, if the
/// first of them lies beyond 6 a and beyond the run-up. Nearer to the start the rail has the marks of the wheel that
/// was put on; nearer to the wheel its strain still changes (runs/rolled_passes.hpp has the measurements).
/// One more increment of the rail's equilibrium is solved, with that state at all stations of an endless rail; nothing
/// yields in it. None, in words: the run is too short, nothing has yielded, no equilibrium.
RunResidual run_residual(const RollingSystem& system, const RollingState& end);

/// A number of residual.json, SI.
struct ResidualNumber {
  std::string_view name;  ///< its key, less the unit's ending
  Unit unit;
  std::string_view doc;
  double (*value)(const RunResidual&);

  std::string key() const { return std::string(name) + std::string(unit.key_ending); }
};
/// All numbers, in the order of the file; its writer and its documentation use them.
std::span<const ResidualNumber> residual_numbers();

/// One line for the screen: the most compressive stresses, or the reason why there are none.
std::string describe(const RunResidual& residual);
/// A warning where the stations are not steady; else empty.
std::string doubt_of(const RunResidual& residual);

}  // namespace railstrata
