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

PlasticElements::PlasticElements(const Body& body, const MaterialOf& material_of, const Wanted& wanted) {
  add_quads(body, material_of);
  if (quads_.empty()) return;
  if (body.options.element != ElementKind::full)
    throw CaseError("elements with one point cannot yield: their hourglass stiffness stays elastic",
                    "mesh.element = \"full\"");
  for (const Quad& q : quads_) terms_ = std::max(terms_, terms_of(q.material.law));
  for (const BlockElements& elements : body.elements) scales_.push_back(class_scales(body.mesh.kind, elements));
  make_modes(body);
  add_places(body, wanted);
}

void PlasticElements::add_quads(const Body& body, const MaterialOf& material_of) {
  for (int b = 0; b < static_cast<int>(body.elements.size()); ++b)
    for (int q = 0; q < static_cast<int>(body.mesh.blocks[b].section.quads.size()); ++q)
      if (const std::optional<YieldingMaterial> material = material_of(b, q)) {
        quads_.push_back({{}, *material, {}});
        quad_of_.push_back({b, q});
      }
}

void PlasticElements::add_places(const Body& body, const Wanted& wanted) {
  const std::vector<Tile>& tiles = body.tiling.tiles;
  tile_quads_.resize(tiles.size());
  for (int t = 0; t < static_cast<int>(tiles.size()); ++t)
    for (int k = 0; k < static_cast<int>(quads_.size()); ++k) {
      const auto [block, q] = quad_of_[k];
      if (block != tiles[t].block || !wanted(block, q, tiles[t])) continue;
      if (tile_quads_[t].empty()) tile_quads_[t].assign(body.mesh.blocks[block].section.quads.size(), -1);
      tile_quads_[t][q] = size();
      places_.push_back({t, q, k, tile_quads_[t][q]});
    }
}

void PlasticElements::make_modes(const Body& body) {
  for_each(static_cast<std::ptrdiff_t>(quads_.size()), [&](std::ptrdiff_t k) {
    const auto [block, q] = quad_of_[k];
    const Section& section = body.mesh.blocks[block].section;
    quads_[k].gauss = gauss_shape(body.mesh.kind, quad_corners(section, q));
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
