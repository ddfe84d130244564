#include "ask/half_space_need.hpp"

#include <fmt/format.h>

#include <cmath>

#include "bem/case_patch.hpp"
#include "bem/transient.hpp"
#include "core/faults.hpp"
#include "record/this_process.hpp"

namespace railstrata {
namespace {

// Peaks and times of cases/quick and cases/paper/base on cells of 0.125, 0.0625 and 0.04 mm (18 to 230 thousand cells):
// 890 to 1360 bytes a cell, the planes of the Fourier transforms being larger than the grid; 0.6, 3.5 and 12 s for 26,
// 96 and 230 thousand cells on one thread of a busy machine.
constexpr double kBaseBytes = 20e6, kBytesPerCell = 1300;
constexpr double kCells = 1e5, kSecondsPerCell = 4e-5, kGrowth = 0.4;

}  // namespace

HalfSpaceNeed half_space_need(const CaseSpec& spec, const Placement& placement, double cell) {
  BemOptions options;
  options.cell = cell;
  const PatchGrid grid = first_grid(spec, placement, options);
  HalfSpaceNeed need;
  need.cells = static_cast<double>(grid.nx) * grid.ny;
  need.memory_bytes = kBaseBytes + kBytesPerCell * need.cells;
  need.seconds = kSecondsPerCell * need.cells * std::pow(need.cells / kCells, kGrowth);
  // a step takes about six tenths of a steady solution, whose iterations begin far off
  constexpr double kOfSteady = 0.6;
  if (spec.transient.kind != TransientKind::none)
    need.seconds *= 1 + kOfSteady * transient_steps(spec, placement, cell);
  return need;
}

void require_memory(const HalfSpaceNeed& need, double cell) {
  const double at_hand = memory_at_hand();
  if (need.memory_bytes <= at_hand) return;
  throw EnvironmentError(
      fmt::format("half-spaces on cells of {:.3g} mm need about {:.3g} GB of memory ({:.3g} million cells), {:.3g} GB "
                  "are at hand",
                  1e3 * cell, 1e-9 * need.memory_bytes, 1e-6 * need.cells, 1e-9 * at_hand),
      "choose larger cells, e.g. --cell \"0.1 mm\"");
}

std::string need_text(const HalfSpaceNeed& need) {
  const bool soon = need.seconds < 90;
  return fmt::format("{:.2g} million cells, about {:.2g} GB of memory and {:.0f} {}", 1e-6 * need.cells,
                     1e-9 * need.memory_bytes, soon ? need.seconds : need.seconds / 60, soon ? "s" : "min");
}

}  // namespace railstrata
