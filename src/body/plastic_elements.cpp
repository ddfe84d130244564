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
  add_candidates(body, wanted);
}

void PlasticElements::add_quads(const Body& body, const MaterialOf& material_of) {
  for (int b = 0; b < static_cast<int>(body.elements.size()); ++b)
    for (int q = 0; q < static_cast<int>(body.mesh.blocks[b].section.quads.size()); ++q)
      if (const std::optional<YieldingMaterial> material = material_of(b, q)) {
        quads_.push_back({{}, *material, {}});
        quad_of_.push_back({b, q});
      }
}

void PlasticElements::add_candidates(const Body& body, const Wanted& wanted) {
  const std::vector<Tile>& tiles = body.tiling.tiles;
  tile_quads_.resize(tiles.size());
  for (int t = 0; t < static_cast<int>(tiles.size()); ++t)
    for (int k = 0; k < static_cast<int>(quads_.size()); ++k) {
      const auto [block, q] = quad_of_[k];
      if (block != tiles[t].block) continue;
      if (tile_quads_[t].empty()) tile_quads_[t].assign(body.mesh.blocks[block].section.quads.size(), -1);
      tile_quads_[t][q] = static_cast<int>(candidates_.size());
      if (wanted(block, q, tiles[t])) hot_at_start_.push_back(tile_quads_[t][q]);
      candidates_.push_back({t, q, k});
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

long PlasticElements::hot_elements(const Body& body, const PlasticHistory& history) const {
  long count = 0;
  for (int k = 0; k < hot_places(history); ++k) {
    const Tile& tile = body.tiling.tiles[hot(history, k).tile];
    count += tile.end - tile.first;
  }
  return count;
}

void PlasticElements::initialise(PlasticHistory& history) const {
  history = {};
  history.slot_of.assign(candidates_.size(), PlasticHistory::kCold);
  history.numbers.reserve(hot_at_start_.size() * static_cast<std::size_t>(slot_numbers()));
  for (int candidate : hot_at_start_) add(history, candidate);
}

void PlasticElements::add(PlasticHistory& history, int candidate) const {
  const int slot = hot_places(history);
  history.places.push_back(candidate);
  history.slot_of[candidate] = slot;
  history.numbers.resize(history.numbers.size() + static_cast<std::size_t>(slot_numbers()), 0.0);
  double* const own = rows(history, slot);
  const std::array<double, 6>& stress = quad(candidates_[candidate]).material.initial_stress;
  own[PlasticEntries::kStressed * kTile] = stress == std::array<double, 6>{} ? 0 : 1;
  for (int i = 0; i < 6; ++i)
    std::fill_n(own + (PlasticEntries::kEigenstress + i) * kTile, kTile, stress[i] == 0 ? 0.0 : -stress[i]);
}

bool PlasticElements::fits(const PlasticHistory& history) const {
  if (history.numbers.size() != history.places.size() * static_cast<std::size_t>(slot_numbers())) return false;
  std::vector<char> seen(candidates_.size(), 0);
  for (int candidate : history.places) {
    if (candidate < 0 || candidate >= static_cast<int>(seen.size()) || seen[candidate]) return false;
    seen[candidate] = 1;
  }
  return true;
}

void PlasticElements::index(PlasticHistory& history) const {
  history.slot_of.assign(candidates_.size(), PlasticHistory::kCold);
  for (int slot = 0; slot < hot_places(history); ++slot) history.slot_of[history.places[slot]] = slot;
}

}  // namespace railstrata
