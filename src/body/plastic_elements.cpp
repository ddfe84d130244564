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

std::ptrdiff_t PlasticElements::slots_begin() const {
  constexpr std::ptrdiff_t kLine = 8;  // of memory
  return (static_cast<std::ptrdiff_t>(candidates_.size()) + kLine - 1) / kLine * kLine;
}

std::ptrdiff_t PlasticElements::slot_size() const {
  return PlasticEntries::kHeader + static_cast<std::ptrdiff_t>(entries()) * kTile;
}

int PlasticElements::hot_places(const Field& history) const {
  if (empty()) return 0;
  return static_cast<int>((static_cast<std::ptrdiff_t>(history.size()) - slots_begin()) / slot_size());
}

PlasticElements::Hot PlasticElements::hot(const Field& history, int slot) const {
  return {candidates_[candidate_of(history, slot)], first_of(slot)};
}

long PlasticElements::hot_elements(const Body& body, const Field& history) const {
  long count = 0;
  for (int k = 0; k < hot_places(history); ++k) {
    const Tile& tile = body.tiling.tiles[hot(history, k).tile];
    count += tile.end - tile.first;
  }
  return count;
}

void PlasticElements::initialise(Field& history) const {
  if (empty()) return;
  history.resize(static_cast<std::size_t>(slots_begin()), 0.0);
  history.reserve(static_cast<std::size_t>(first_of(static_cast<int>(hot_at_start_.size()))));
  for (int candidate : hot_at_start_) add(history, candidate);
}

void PlasticElements::add(Field& history, int candidate) const {
  const int slot = hot_places(history);
  history.resize(history.size() + static_cast<std::size_t>(slot_size()), 0.0);
  history[candidate] = 1 + slot;
  double* const rows = history.data() + first_of(slot);
  const std::array<double, 6>& stress = quad(candidates_[candidate]).material.initial_stress;
  rows[PlasticEntries::kCandidate] = candidate;
  rows[PlasticEntries::kStressed] = stress == std::array<double, 6>{} ? 0 : 1;
  for (int i = 0; i < 6; ++i)
    std::fill_n(rows + (PlasticEntries::kEigenstress + i) * kTile, kTile, stress[i] == 0 ? 0.0 : -stress[i]);
}

bool PlasticElements::fits(const Field& history) const {
  const auto size = static_cast<std::ptrdiff_t>(history.size());
  if (size < slots_begin() || (size - slots_begin()) % slot_size() != 0) return false;
  const int slots = hot_places(history);
  for (int slot = 0; slot < slots; ++slot) {
    const double candidate = history[first_of(slot) + PlasticEntries::kCandidate];
    if (!(candidate >= 0 && candidate < static_cast<double>(candidates_.size()))) return false;
    if (history[static_cast<std::ptrdiff_t>(candidate)] != 1 + slot) return false;
  }
  return slots == std::count_if(history.begin(), history.begin() + slots_begin(), [](double x) { return x != 0; });
}

}  // namespace railstrata
