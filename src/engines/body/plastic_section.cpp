#include "body/plastic_section.hpp"

#include <algorithm>
#include <map>

#include "body/body_state.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"

namespace railstrata {
namespace {

using Entries = PlasticEntries;
using HotPlace = PlasticElements::Place;

/// The quadrilaterals of hot places.
std::vector<PlasticSection::Quad> quads_of(const Body& body, const PlasticHistory& history) {
  std::vector<PlasticSection::Quad> out;
  for (int slot = 0; slot < body.plastic.hot_places(history); ++slot) {
    const HotPlace p = body.plastic.hot(history, slot);
    out.push_back({body.tiling.tiles[p.tile].block, p.quad});
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// Elements first <= e < end of a block.
struct Range {
  int first = 0, end = 0;
};
Range between(const Stations& stations, double from, double to) {
  Range out{0, stations.elements()};
  while (out.first < out.end && stations.centre(out.first) < from) ++out.first;
  while (out.end > out.first && stations.centre(out.end - 1) > to) --out.end;
  if (out.first < out.end) return out;
  const int e = stations.element_at(0.5 * (from + to));
  return {e, e + 1};
}

/// Adds the points of an element, pair by pair.
void add_element(const Body& body, const PlasticHistory& history, int block, int quad, int element, double weight,
                 double* sum) {
  const int tile = body.tiling.first_tile[block] + element / kTile, entries = body.plastic.point_entries();
  const double* rows = body.plastic.rows(history, tile, quad);
  if (!rows) return;
  rows += element % kTile + Entries::kPoints * kTile;
  for (int pair = 0; pair < kGaussPairs; ++pair)
    for (int k = 0; k < entries; ++k) sum[pair * entries + k] += weight * rows[(pair * entries + k) * kTile];
}

/// Eigenstress and bubbles of an element.
Eigenstress<double> eigenstress_of(const Body& body, const HotPlace& place, int element, const double* points) {
  const Tile& tile = body.tiling.tiles[place.tile];
  const PlasticElements::Quad& quad =
      body.plastic.quad(body.plastic.kind_at(place, tile, body.elements[tile.block], element));
  const int cls = body.elements[tile.block].hourglass_class[element / kHourglassGroup];
  const SweepScale scale = body.plastic.scale(tile.block, cls);
  PlasticSums<double> sums{};
  for (int pair = 0; pair < kGaussPairs; ++pair) {
    double stress[6];
    for (int i = 0; i < 6; ++i) stress[i] = 2 * quad.material.law.mu * points[pair * body.plastic.point_entries() + i];
    add_pair(quad.gauss.pair[pair], 1 / scale.sigma, 1 / scale.c, stress, sums);
  }
  const double volume = body.elements[tile.block].table.quads[place.quad].shape.volume * scale.sigma * scale.c;
  Eigenstress<double> out = condensed(quad.modes[cls], volume, sums);
  for (int i = 0; i < 6; ++i) out.mean[i] -= quad.material.initial_stress[i];
  return out;
}

void put_place(const Body& body, const HotPlace& place, const double* points, double* rows) {
  const Tile& tile = body.tiling.tiles[place.tile];
  const int entries = body.plastic.point_entries();
  for (int e = tile.first; e < tile.end; ++e) {
    double* own = rows + e - tile.first;
    Eigenstress<double> eigen = eigenstress_of(body, place, e, points);
    own[Entries::kTouched * kTile] = rows[Entries::kStressed * kTile] = 1;
    each_entry(eigen, [&](int n, double x) { own[(Entries::kEigenstress + n) * kTile] = x; });
    for (int n = 0; n < 3; ++n)
      for (int i = 0; i < 3; ++i) own[(Entries::kBubbles + 3 * n + i) * kTile] = eigen.bubbles.a[n][i];
    for (int k = 0; k < kGaussPairs * entries; ++k) own[(Entries::kPoints + k) * kTile] = points[k];
  }
}

std::map<PlasticSection::Quad, std::size_t> places_of(const PlasticSection& section) {
  std::map<PlasticSection::Quad, std::size_t> at;
  for (std::size_t n = 0; n < section.quads.size(); ++n) at[section.quads[n]] = n;
  return at;
}

[[noreturn]] void refuse() {
  throw CaseError("earlier passes left plastic strain where the elements of this one cannot yield",
                  "continue with the strengths and the mesh of the first pass");
}

}  // namespace

PlasticSection plastic_section(const Body& body, const PlasticHistory& history, double from, double to) {
  PlasticSection out;
  out.point_entries = body.plastic.point_entries();
  out.quads = quads_of(body, history);
  const std::size_t each = static_cast<std::size_t>(kGaussPairs) * out.point_entries;
  out.history.assign(out.quads.size() * each, 0.0);
  for_each(static_cast<std::ptrdiff_t>(out.quads.size()), [&](std::ptrdiff_t n) {
    const auto [block, quad] = out.quads[n];
    const Range range = between(body.mesh.blocks[block].stations, from, to);
    const double weight = 1.0 / (range.end - range.first);
    for (int e = range.first; e < range.end; ++e)
      add_element(body, history, block, quad, e, weight, out.history.data() + static_cast<std::size_t>(n) * each);
  });
  return out;
}

PlasticSection on_quads(const PlasticSection& section, const PlasticSection& like) {
  const auto at = places_of(section);
  const std::size_t each = static_cast<std::size_t>(kGaussPairs) * like.point_entries;
  PlasticSection out = like;
  for (std::size_t n = 0; n < like.quads.size(); ++n) {
    const auto found = at.find(like.quads[n]);
    double* own = out.history.data() + n * each;
    if (found == at.end())
      std::fill_n(own, each, 0.0);
    else
      std::copy_n(section.point(found->second, 0), each, own);
  }
  return out;
}

PlasticHistory history_of_section(const Body& body, const PlasticSection& section) {
  const auto at = places_of(section);
  PlasticHistory out = initial_history(body);
  std::vector<char> placed(section.quads.size(), 0);
  for (std::size_t c = 0; c < body.plastic.candidates().size(); ++c) {
    const HotPlace& place = body.plastic.candidates()[c];
    const auto found = at.find({body.tiling.tiles[place.tile].block, place.quad});
    if (found == at.end()) continue;
    if (section.point_entries != body.plastic.point_entries()) refuse();
    if (!body.plastic.is_hot(out, static_cast<int>(c))) body.plastic.add(out, static_cast<int>(c));
    put_place(body, place, section.point(found->second, 0), body.plastic.rows(out, out.slot_of[c]));
    placed[found->second] = 1;
  }
  for (std::size_t n = 0; n < placed.size(); ++n)
    for (int pair = 0; pair < kGaussPairs; ++pair)
      if (!placed[n] && section.point(n, pair)[6] > 0) refuse();
  return out;
}

SectionStrain section_strain(const Body& body, const PlasticSection& section, std::size_t quad) {
  const auto [block, q] = section.quads[quad];
  const GaussShape<double> gauss = gauss_shape(body.mesh.kind, quad_corners(body.mesh.blocks[block].section, q));
  SectionStrain out;
  for (int pair = 0; pair < kGaussPairs; ++pair) {
    const double weight = gauss.pair[pair].weight;
    const double* point = section.point(quad, pair);
    for (int i = 0; i < 6; ++i) out.plastic[i] += weight * point[i];
    out.accumulated += weight * point[6];
  }
  return out;
}

}  // namespace railstrata
