#include "body/plastic_elements.hpp"

#include <algorithm>

#include "body/body.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"

namespace railstrata {
namespace {

int terms_of(const PlasticParameters<double>& law) {
  int terms = 0;
  for (int k = 0; k < kMostBackstresses; ++k)
    if (law.modulus[k] != 0) terms = k + 1;
  return terms;
}

// By hourglass class: the shortest spacing among the elements that share it is what it was made for.
std::vector<SweepScale> class_scales(SweepKind kind, const BlockElements& elements) {
  std::vector<double> spacing;
  for (const SpacingClass& c : elements.classes) {
    const auto at = static_cast<std::size_t>(c.hourglass);
    if (spacing.size() <= at) spacing.resize(at + 1, 0.0);
    spacing[at] = spacing[at] > 0 ? std::min(spacing[at], c.spacing) : c.spacing;
  }
  std::vector<SweepScale> out;
  for (double s : spacing) out.push_back(sweep_scale(kind, s));
  return out;
}

}  // namespace

PlasticElements::PlasticElements(const Body& body, const std::vector<std::optional<PlasticMaterial>>& materials,
                                 const Wanted& wanted) {
  const bool any = std::any_of(materials.begin(), materials.end(), [](const auto& m) { return m.has_value(); });
  if (!any) return;
  if (body.options.element != ElementKind::full)
    throw CaseError("elements with one point cannot yield: their hourglass stiffness stays elastic",
                    "mesh.element = \"full\"");
  for (const auto& m : materials)
    if (m) terms_ = std::max(terms_, terms_of(m->law));
  tile_quads_.resize(body.tiling.tiles.size());
  for (int b = 0; b < static_cast<int>(body.elements.size()); ++b) {
    scales_.push_back(class_scales(body.mesh.kind, body.elements[b]));
    add_block(body, b, materials, wanted);
  }
  make_modes(body);
}

void PlasticElements::add_block(const Body& body, int block,
                                const std::vector<std::optional<PlasticMaterial>>& materials, const Wanted& wanted) {
  const Section& section = body.mesh.blocks[block].section;
  std::vector<int> kind(section.quads.size(), -1);
  for (int t = body.tiling.first_tile[block]; t < body.tiling.first_tile[block + 1]; ++t)
    for (int q = 0; q < static_cast<int>(section.quads.size()); ++q) {
      const std::optional<PlasticMaterial>& material = materials[section.quad_material[q]];
      if (!material || !wanted(block, q, body.tiling.tiles[t])) continue;
      if (kind[q] < 0) {
        kind[q] = static_cast<int>(quads_.size());
        quads_.push_back({gauss_shape(body.mesh.kind, quad_corners(section, q)), *material, {}});
        quad_of_.push_back({block, q});
      }
      if (tile_quads_[t].empty()) tile_quads_[t].assign(section.quads.size(), -1);
      tile_quads_[t][q] = size();
      places_.push_back({t, q, kind[q], tile_quads_[t][q]});
    }
}

void PlasticElements::make_modes(const Body& body) {
  for_each(static_cast<std::ptrdiff_t>(quads_.size()), [&](std::ptrdiff_t k) {
    const auto [block, q] = quad_of_[k];
    const Section& section = body.mesh.blocks[block].section;
    for (const SweepScale& scale : scales_[block])
      quads_[k].modes.push_back(incompatible_modes(body.mesh.kind, quad_corners(section, q), scale,
                                                   body.materials[section.quad_material[q]]));
  });
}

void PlasticElements::initialise(double* history) const {
  std::fill_n(history, size(), 0.0);
  for (const Place& p : places_)
    for (int i = 0; i < 6; ++i)
      std::fill_n(history + p.first + (PlasticEntries::kEigenstress + i) * kTile, kTile,
                  -quad(p).material.initial_stress[i]);
}

}  // namespace railstrata
