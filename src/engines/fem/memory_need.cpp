#include "fem/memory_need.hpp"

#include <fmt/format.h>

#include "core/faults.hpp"
#include "record/this_process.hpp"

namespace railstrata {
namespace {

// Peaks of runs between 50 and 350 thousand nodes: 45 to 70 MB and 270 bytes a node. A checkpoint holds the four fields
// of the state three times over: the last good state, which is the one to write, HDF5's image of it and the file's
// bytes.
constexpr double kBytesPerNode = 300 + 3 * 96, kBase = 60e6;

}  // namespace

double memory_needed(const Model& model) {
  return kBase + kBytesPerNode * static_cast<double>(model.rail.nodes() + model.wheel.nodes());
}

void require_memory(const Model& model) {
  const double needed = memory_needed(model), at_hand = memory_at_hand();
  if (needed <= at_hand) return;
  throw EnvironmentError(
      fmt::format("this mesh needs about {:.3g} GB of memory ({:.3g} million nodes), {:.3g} GB are at hand\n    try a "
                  "larger mesh.element_size or mesh.coarse_ratio, or a shorter path (run.positions)",
                  1e-9 * needed, 1e-6 * static_cast<double>(model.rail.nodes() + model.wheel.nodes()), 1e-9 * at_hand));
}

}  // namespace railstrata
