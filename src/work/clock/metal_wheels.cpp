#include "clock/metal_wheels.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "bem/contact_places.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"

namespace railstrata {
namespace {

MetalWheel wheel_of(const CollectiveRow& row, const BemPatch& patch, const WornProfile& surface, const MetalGrid& g,
                    InteriorKernels& kernels) {
  // arc length of the unworn rail where the contact frame has y = 0
  const double at = surface.unworn_s_of(patch.place.rail_s) - along_plane(patch.contact, patch.place.point);
  const double line = g.s(static_cast<int>(std::lround((at - g.from) / g.apart))) - at;
  const PassLattice lattice{g.apart, line, g.thickness, &kernels};
  MetalWheel out{.rail = rail_passes(row.spec, {alone(*row.result, patch)}, &lattice), .share = 0};
  out.column = static_cast<int>(std::lround((at + out.rail.grid.y0 - g.from) / g.apart));
  return out;
}

}  // namespace

MetalWheels metal_wheels(const std::vector<CollectiveRow>& rows, const WornProfile& surface, const MetalGrid& grid,
                         double wheels, InteriorKernels& kernels) {
  std::vector<std::pair<std::size_t, const BemPatch*>> patches;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].sound() && rows[i].result)
      for (const BemPatch* patch : patches_of(*rows[i].result)) patches.emplace_back(i, patch);
  std::vector<std::optional<MetalWheel>> made(patches.size());
  std::vector<std::string> why(patches.size());
  for_each_that_throws(patches.size(), [&](std::size_t k) {
    const auto [i, patch] = patches[k];
    try {
      made[k] = wheel_of(rows[i], *patch, surface, grid, kernels);
    } catch (const CaseError& e) {
      why[k] = fault_line(e);
    }
  });
  MetalWheels out;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const std::size_t i = patches[k].first;
    if (!made[k]) {
      out.faults.push_back({i, why[k]});
      continue;
    }
    made[k]->share = rows[i].passages / wheels;
    out.wheels.push_back(std::move(*made[k]));
    out.load_of.push_back(i);
  }
  return out;
}

}  // namespace railstrata
