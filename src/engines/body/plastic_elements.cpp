#include "body/plastic_elements.hpp"

#include <algorithm>
#include <map>

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
    throw CaseError("elements with one integration point cannot yield: their hourglass stiffness stays elastic",
                    "mesh.element = \"full\"");
  for (const Quad& q : quads_) terms_ = std::max(terms_, terms_of(q.material.law));
  for (const BlockElements& elements : body.elements) scales_.push_back(class_scales(body.mesh.kind, elements));
  for_each(static_cast<std::ptrdiff_t>(quads_.size()), [&](std::ptrdiff_t k) {
    Quad& q = quads_[k];
    const std::array<Vec2, 4> corners = quad_corners(body.mesh.blocks[q.block].section, q.quad);
    q.gauss = gauss_shape(body.mesh.kind, corners);
    for (const SweepScale& scale : scales_[q.block])
      q.modes.push_back(incompatible_modes(body.mesh.kind, corners, scale, body.materials[q.of_body]));
  });
  add_candidates(body, wanted);
}

void PlasticElements::add_quads(const Body& body, const MaterialOf& material_of) {
  for (int b = 0; b < static_cast<int>(body.elements.size()); ++b) {
    const Block& block = body.mesh.blocks[b];
    const int quads = static_cast<int>(block.section.quads.size());
    std::vector<int>& kinds = kinds_.emplace_back(static_cast<std::size_t>(block.sets()) * quads, kElastic);
    for (int q = 0; q < quads; ++q) {
      std::map<int, int> known;  // kinds by material
      for (int set = 0; set < block.sets(); ++set) {
        const int material = block.material_of_set(set, q);
        if (!known.count(material)) {
          const std::optional<YieldingMaterial> yields = material_of(b, q, material);
          known[material] = yields ? static_cast<int>(quads_.size()) : kElastic;
          if (yields) quads_.push_back({{}, *yields, {}, b, q, material});
        }
        kinds[static_cast<std::size_t>(set) * quads + q] = known[material];
      }
    }
  }
}

PlasticElements::Place PlasticElements::place_of(const Body& body, int t, int q) const {
  const Tile& tile = body.tiling.tiles[t];
  const BlockElements& elements = body.elements[tile.block];
  Place out{t, q, kMixed, kElastic};
  const int first = kind_at(out, tile, elements, tile.first);
  bool alike = true;
  for (int e = tile.first; e < tile.end; ++e) {
    const int kind = kind_at(out, tile, elements, e);
    alike = alike && kind == first;
    if (kind != kElastic) out.some_kind = kind;
  }
  if (alike) out.kind = first;
  return out;
}

void PlasticElements::add_candidates(const Body& body, const Wanted& wanted) {
  const std::vector<Tile>& tiles = body.tiling.tiles;
  tile_quads_.resize(tiles.size());
  for (int t = 0; t < static_cast<int>(tiles.size()); ++t) {
    const int block = tiles[t].block, quads = static_cast<int>(body.mesh.blocks[block].section.quads.size());
    for (int q = 0; q < quads; ++q) {
      const Place place = place_of(body, t, q);
      if (place.some_kind == kElastic) continue;
      if (tile_quads_[t].empty()) tile_quads_[t].assign(static_cast<std::size_t>(quads), -1);
      tile_quads_[t][q] = static_cast<int>(candidates_.size());
      if (wanted(block, q, tiles[t])) hot_at_start_.push_back(tile_quads_[t][q]);
      candidates_.push_back(place);
    }
  }
}

PlasticHistory PlasticElements::initial_history() const {
  PlasticHistory out;
  index(out);
  out.numbers.reserve(hot_at_start_.size() * static_cast<std::size_t>(slot_numbers()));
  for (int candidate : hot_at_start_) add(out, candidate);
  return out;
}

void PlasticElements::add(PlasticHistory& history, int candidate) const {
  const int slot = hot_places(history);
  history.places.push_back(candidate);
  history.slot_of[candidate] = slot;
  history.numbers.resize(history.numbers.size() + static_cast<std::size_t>(slot_numbers()), 0.0);
  double* const own = rows(history, slot);
  const std::array<double, 6>& stress = quad(candidates_[candidate].some_kind).material.initial_stress;
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
