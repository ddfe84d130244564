#include "body/plastic_pass.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "body/traversal_kernel.hpp"
#include "core/parallel.hpp"

namespace railstrata {
namespace {

using Entries = PlasticEntries;
using Place = PlasticElements::Place;
constexpr int kNewton = 2;  // iterations of the law: 5e-14 of the yield stress at strain increments of 1e-4

// Rows of a pack's numbers: entry k at rows[k * kTile].
struct PackRows {
  double* at;
  Pack get(int entry) const { return load(at + entry * kTile); }
  void set(int entry, Pack value) const { store(at + entry * kTile, value); }
};

// Displacement gradients, amplitudes and Green strain of the mean gradient of kLanes elements.
struct PackStrain {
  ElementKinematics<Pack> kin;
  Pack mean[6];
};

Rotation<double> turn_by(const Body& body, double psi) {
  return body.mesh.kind == SweepKind::extrude ? Rotation<double>{} : rotation_by(psi);
}

PackStrain pack_strain(const Body& body, int block, int quad, int first, const Rotation<double>& turn, const Field& u) {
  PackStrain out;
  out.kin = traversal::pack_kinematics(body, block, quad, first, turn, u);
  const auto stress = finite_stress<SweepKind::revolve>(turn, out.kin, [](const Pack(&)[6], Pack(&s)[6]) {
    for (Pack& x : s) x = Pack{};
  });
  Pack real{};
  for (int l = 0; l < std::min(kLanes, body.layout.blocks[block].elements - first); ++l) real[l] = 1;
  for (int i = 0; i < 6; ++i) out.mean[i] = real * stress.strain[i];
  return out;
}

// sqrt(3/2)|s - alpha| over the yield stress.
template <int terms>
Pack yield_share(const PlasticParameters<double>& law, const Pack (&strain)[6], const Pack* history) {
  const Pack mean = (strain[0] + strain[1] + strain[2]) * (1.0 / 3);
  Pack elastic[6];
  RecalledShare<Pack> nothing_recalled[kMostBackstresses];
  for (int i = 0; i < 6; ++i) elastic[i] = 2 * law.mu * (strain[i] - (i < 3 ? mean : Pack{}) - history[i]);
  for (RecalledShare<Pack>& share : nothing_recalled) share = {Pack{} + 1.0, Pack{}, Pack{} + 1.0};
  const PlasticTrial<Pack> at = plastic_trial<terms>(law, elastic, history, Pack{}, nothing_recalled);
  return at.norm / (at.norm - at.excess);
}

double largest(const Pack& x) {
  double out = x[0];
  for (int l = 1; l < kLanes; ++l) out = std::max(out, x[l]);
  return out;
}

double lane_sum(const Pack& x) {
  double sum = 0;
  for (int l = 0; l < kLanes; ++l) sum += x[l];
  return sum;
}

struct PassScope {
  const Body& body;
  const Field& u;
  Rotation<double> turn;
  PlasticLook look;
};

// Data for the points of one pack of elements.
struct PackWork {
  const PlasticElements::Quad& quad;
  const IncompatibleModes<double>& modes;
  double inv_sigma, inv_c, volume;  // of the class that the modes are made for
  PackRows rows;
  bool touched;  // has yielded: else its numbers are zero, and are not read
};

// A pair of Gauss points: strain -> history; adds to the work [J/m³]. Leaves 2 mu Ep in place of the strain. True if it
// flows.
template <int terms>
bool advance_pair(const PackWork& work, int pair, Pack (&strain)[6], Pack& done, double* nearest) {
  constexpr int kEntries = kPlasticHistory<terms>;
  const YieldingMaterial& material = work.quad.material;
  const double twice = 2 * material.law.mu;
  const int first = Entries::kPoints + pair * kEntries;
  Pack history[kEntries] = {}, before[6];
  if (work.touched)
    for (int k = 0; k < kEntries; ++k) history[k] = work.rows.get(first + k);
  for (int i = 0; i < 6; ++i) {
    before[i] = history[i];
    strain[i] += material.initial_stress[i] / twice;  // its mean is nothing to the law
  }
  const Pack p = history[6];
  advance_plastic<terms, kNewton>(material.law, strain, history);
  const bool flows = any_positive(Pack(history[6] - p));
  if (flows) {
    Pack flow[6], deviator[6];
    const Pack mean = (strain[0] + strain[1] + strain[2]) * (1.0 / 3);
    for (int i = 0; i < 6; ++i) {
      flow[i] = history[i] - before[i];
      deviator[i] = twice * (strain[i] - (i < 3 ? mean : Pack{}) - history[i]);
    }
    done += work.quad.gauss.pair[pair].weight * double_contraction(deviator, flow);
    for (int k = 0; k < kEntries; ++k) work.rows.set(first + k, history[k]);
  }
  if (nearest) *nearest = std::max(*nearest, largest(yield_share<terms>(material.law, strain, history)));
  for (int i = 0; i < 6; ++i) strain[i] = twice * history[i];
  return flows;
}

// nearest: asked for if not null, the largest share of the yield stress. Returns whether the pack has ever yielded.
template <int terms>
bool advance_pack(const PackWork& work, const PackStrain& at, double* nearest) {
  BubbleAmplitudes<Pack> bubbles = following_bubbles(work.modes, at.kin);
  if (work.touched)
    for (int n = 0; n < 3; ++n)
      for (int i = 0; i < 3; ++i) bubbles.a[n][i] += work.rows.get(Entries::kBubbles + 3 * n + i);
  PlasticSums<Pack> sums{};
  Pack done{};
  bool touched = work.touched;
  for (int k = 0; k < kGaussPairs; ++k) {
    const GaussPair<double>& g = work.quad.gauss.pair[k];
    Pack strain[6];
    pair_strain(g, work.inv_sigma, work.inv_c, at.mean, at.kin, bubbles, strain);
    touched |= advance_pair<terms>(work, k, strain, done, nearest);
    if (touched) add_pair(g, work.inv_sigma, work.inv_c, strain, sums);  // zero until then
  }
  if (!touched) return false;
  Eigenstress<Pack> eigen = condensed(work.modes, work.volume, sums);
  for (int i = 0; i < 6; ++i) eigen.mean[i] -= work.quad.material.initial_stress[i];
  each_entry(eigen, [&](int n, const Pack& x) { work.rows.set(Entries::kEigenstress + n, x); });
  for (int n = 0; n < 3; ++n)
    for (int i = 0; i < 3; ++i) work.rows.set(Entries::kBubbles + 3 * n + i, eigen.bubbles.a[n][i]);
  work.rows.set(Entries::kWork, work.rows.get(Entries::kWork) + done);
  return true;
}

// of(kind, own): for every kind of elements in the pack from element `first` on that yields; own: null where all lanes
// are of it, else 1 in those that are.
template <class Of>
void each_kind(const Body& body, const Place& place, int first, Of&& of) {
  if (place.kind != PlasticElements::kMixed) return of(place.kind, static_cast<const Pack*>(nullptr));
  const Tile& tile = body.tiling.tiles[place.tile];
  int kinds[kLanes];
  for (int l = 0; l < kLanes; ++l)
    kinds[l] = body.plastic.kind_at(place, tile, body.elements[tile.block], std::min(first + l, tile.end - 1));
  for (int l = 0; l < kLanes; ++l) {
    if (kinds[l] == PlasticElements::kElastic || std::find(kinds, kinds + l, kinds[l]) != kinds + l) continue;
    Pack own{};
    for (int k = l; k < kLanes; ++k) own[k] = kinds[k] == kinds[l];
    of(kinds[l], &own);
  }
}

// Largest share of the yield stress of cold elements, by their mean strain.
double elastic_share(const Body& body, const PlasticElements::Place& place, const Rotation<double>& turn,
                     const Field& u) {
  const Tile& tile = body.tiling.tiles[place.tile];
  const Pack virgin[kPlasticHistory<0>] = {};
  double most = 0;
  for (int e = tile.first; e < tile.end; e += kLanes) {
    const PackStrain at = pack_strain(body, tile.block, place.quad, e, turn, u);
    each_kind(body, place, e, [&](int kind, const Pack*) {
      const YieldingMaterial& material = body.plastic.quad(kind).material;
      Pack strain[6];
      for (int i = 0; i < 6; ++i) strain[i] = at.mean[i] + material.initial_stress[i] / (2 * material.law.mu);
      most = std::max(most, largest(yield_share<0>(material.law, strain, virgin)));
    });
  }
  return most;
}

PackWork pack_work(const Body& body, const Place& place, int kind, int element, double* rows) {
  const PlasticElements& plastic = body.plastic;
  const Tile& tile = body.tiling.tiles[place.tile];
  const int cls = body.elements[tile.block].hourglass_class[element / kHourglassGroup];
  const SweepScale scale = plastic.scale(tile.block, cls);
  const double volume = body.elements[tile.block].table.quads[place.quad].shape.volume * scale.sigma * scale.c;
  const PlasticElements::Quad& quad = plastic.quad(kind);
  const int group = (element - tile.first) / kHourglassGroup * kHourglassGroup;
  const bool touched = rows[Entries::kTouched * kTile + group] != 0;
  return {quad, quad.modes[cls], 1 / scale.sigma, 1 / scale.c, volume, {rows + element - tile.first}, touched};
}

// Elements of one pack of several kinds: every kind's answer for all of them, of which its own keep theirs.
template <class Advance>
bool advance_by_kind(const PassScope& scope, const Place& place, int e, double* rows, Advance&& advance) {
  const Tile& tile = scope.body.tiling.tiles[place.tile];
  if (place.kind != PlasticElements::kMixed) return advance(pack_work(scope.body, place, place.kind, e, rows));
  thread_local std::vector<double> tried;
  tried.resize(static_cast<std::size_t>(scope.body.plastic.slot_numbers()));
  const PackRows kept{rows + e - tile.first}, own_try{tried.data() + e - tile.first};
  const int entries = scope.body.plastic.entries();
  bool touched = false;
  each_kind(scope.body, place, e, [&](int kind, const Pack* own) {
    for (int k = 0; k < entries; ++k) own_try.set(k, kept.get(k));
    PackWork work = pack_work(scope.body, place, kind, e, rows);
    work.rows = own_try;
    touched |= advance(work);
    for (int k = 0; k < entries; ++k) kept.set(k, *own != 0.0 ? own_try.get(k) : kept.get(k));
  });
  return touched;
}

template <int terms>
void advance_place(const PassScope& scope, const Place& place, double* rows) {
  const Tile& tile = scope.body.tiling.tiles[place.tile];
  for (int group = tile.first; group < tile.end; group += kHourglassGroup) {
    double& awake = rows[Entries::kAwake * kTile + group - tile.first];
    if (scope.look == PlasticLook::awake && awake == 0) continue;
    double nearest = 0;
    double* wanted = scope.look == PlasticLook::all ? &nearest : nullptr;
    bool touched = false;
    for (int e = group; e < std::min(group + kHourglassGroup, tile.end); e += kLanes)
      touched |= advance_by_kind(scope, place, e, rows, [&](const PackWork& work) {
        return advance_pack<terms>(work, pack_strain(scope.body, tile.block, place.quad, e, scope.turn, scope.u),
                                   wanted);
      });
    if (touched) rows[Entries::kTouched * kTile + group - tile.first] = rows[Entries::kStressed * kTile] = 1;
    if (wanted) awake = nearest > kSleepBelow ? 1 : 0;
  }
}

constexpr void (*kAdvanceByTerms[kMostBackstresses + 1])(const PassScope&, const Place&, double* rows) = {
    advance_place<0>, advance_place<1>, advance_place<2>, advance_place<3>, advance_place<4>};

// Sum of of_place(place, its numbers) over the hot places that have any eigenstress, in their order.
template <class OfPlace>
double sum_of_places(const PlasticElements& plastic, const PlasticHistory& history, OfPlace&& of_place) {
  std::vector<double> part(static_cast<std::size_t>(plastic.hot_places(history)));
  for_each(static_cast<std::ptrdiff_t>(part.size()), [&](std::ptrdiff_t k) {
    const double* rows = plastic.rows(history, static_cast<int>(k));
    if (plastic.has_eigenstress(rows)) part[k] = of_place(plastic.hot(history, static_cast<int>(k)), rows);
  });
  return std::accumulate(part.begin(), part.end(), 0.0);
}

// -V E:eigenstress - q.eigenforces - P_a.alpha_p/2 + V mu sum_g w_g Ep_g:Ep_g of a pack. With P_a = K_aa alpha_p and
// the points' strains at hand the last two are V mu sum_g w_g Ep_g:(Ep_g - G_g alpha_p).
Pack pack_energy(const PackWork& work, const PackStrain& at, const Pack& volume, int point_entries) {
  Eigenstress<Pack> eigen;
  each_entry(eigen, [&](int n, Pack& x) { x = work.rows.get(Entries::kEigenstress + n); });
  Pack energy = -volume * double_contraction(at.mean, eigen.mean);
  for (int i = 0; i < 3; ++i) {
    energy -= at.kin.even[i] * eigen.even[i];
    for (int m = 0; m < 3; ++m) energy -= at.kin.odd[m][i] * eigen.odd[m][i];
  }
  BubbleAmplitudes<Pack> own;
  for (int n = 0; n < 3; ++n)
    for (int i = 0; i < 3; ++i) own.a[n][i] = work.rows.get(Entries::kBubbles + 3 * n + i);
  const ElementKinematics<Pack> no_amplitudes{};
  const Pack no_strain[6] = {};
  Pack kept{};
  for (int k = 0; k < kGaussPairs; ++k) {
    const GaussPair<double>& g = work.quad.gauss.pair[k];
    Pack bubble[6], plastic[6], rest[6];
    pair_strain(g, work.inv_sigma, work.inv_c, no_strain, no_amplitudes, own, bubble);
    for (int i = 0; i < 6; ++i) {
      plastic[i] = work.rows.get(Entries::kPoints + k * point_entries + i);
      rest[i] = plastic[i] - bubble[i];
    }
    kept += g.weight * double_contraction(plastic, rest);
  }
  return energy + volume * work.quad.material.law.mu * kept;
}

Pack volumes(const Body& body, int block, int quad, int element) {
  const ElementTable<double>& table = body.elements[block].table;
  return table.quads[quad].shape.volume * load(&table.sigma_c[element]);
}

}  // namespace

void advance_plastic_elements(const Body& body, const Field& u, double psi, PlasticHistory& history, PlasticLook look,
                              const TileCut* cut) {
  if (body.plastic.empty()) return;
  const PassScope scope{body, u, turn_by(body, psi), look};
  const auto advance = kAdvanceByTerms[body.plastic.terms()];
  for_each(
      body.plastic.hot_places(history),
      [&](std::ptrdiff_t k) {
        const Place& place = body.plastic.hot(history, static_cast<int>(k));
        if (!cut || cut->is_own(place.tile)) advance(scope, place, body.plastic.rows(history, static_cast<int>(k)));
      },
      true);
}

int extend_plastic_elements(const Body& body, const Field& u, double psi, PlasticHistory& history) {
  const PlasticElements& plastic = body.plastic;
  const Rotation<double> turn = turn_by(body, psi);
  std::vector<char> near(plastic.candidates().size(), 0);
  for_each(
      static_cast<std::ptrdiff_t>(near.size()),
      [&](std::ptrdiff_t k) {
        if (plastic.is_hot(history, static_cast<int>(k))) return;
        near[k] = elastic_share(body, plastic.candidates()[k], turn, u) > kSleepBelow;
      },
      true);
  int added = 0;
  for (int k = 0; k < static_cast<int>(near.size()); ++k) {
    if (!near[k]) continue;
    plastic.add(history, k);
    ++added;
  }
  return added;
}

void restore_points(const Body& body, const PlasticHistory& from, PlasticHistory& history) {
  const std::ptrdiff_t kept = static_cast<std::ptrdiff_t>(Entries::kWork) * kTile;
  const std::ptrdiff_t end = static_cast<std::ptrdiff_t>(body.plastic.entries()) * kTile;
  const int common = body.plastic.hot_places(from);
  for_each(body.plastic.hot_places(history), [&](std::ptrdiff_t k) {
    double* rows = body.plastic.rows(history, static_cast<int>(k));
    if (k < common)
      std::copy(body.plastic.rows(from, static_cast<int>(k)) + kept, body.plastic.rows(from, static_cast<int>(k)) + end,
                rows + kept);
    else
      std::fill(rows + kept, rows + end, 0.0);
  });
}

double plastic_strain_energy(const Body& body, const Field& u, double psi, const PlasticHistory& history) {
  const Rotation<double> turn = turn_by(body, psi);
  return sum_of_places(body.plastic, history, [&](const Place& place, const double* rows) {
    const Tile& tile = body.tiling.tiles[place.tile];
    Pack sum{};
    for (int e = tile.first; e < tile.end; e += kLanes)
      each_kind(body, place, e, [&](int kind, const Pack* own) {
        const Pack energy = pack_energy(pack_work(body, place, kind, e, const_cast<double*>(rows)),  // only read
                                        pack_strain(body, tile.block, place.quad, e, turn, u),
                                        volumes(body, tile.block, place.quad, e), body.plastic.point_entries());
        sum += own ? *own * energy : energy;
      });
    return lane_sum(sum);
  });
}

double initial_stress_energy(const Body& body, const Field& u, double psi, const PlasticHistory& history) {
  const Rotation<double> turn = turn_by(body, psi);
  std::vector<double> part(body.tiling.tiles.size(), 0.0);
  for_each(static_cast<std::ptrdiff_t>(part.size()), [&](std::ptrdiff_t t) {
    const Tile& tile = body.tiling.tiles[t];
    const int quads = static_cast<int>(body.mesh.blocks[tile.block].section.quads.size());
    for (int q = 0; q < quads; ++q) {
      const double* const taken_off = body.initial_stress.rows(tile.block, q);
      if (!taken_off || body.plastic.rows(history, static_cast<int>(t), q)) continue;
      Pack given[6], sum{};
      for (int i = 0; i < 6; ++i) given[i] = Pack{} - taken_off[i * kTile];
      for (int e = tile.first; e < tile.end; e += kLanes)
        sum += volumes(body, tile.block, q, e) *
               double_contraction(pack_strain(body, tile.block, q, e, turn, u).mean, given);
      for (int l = 0; l < kLanes; ++l) part[t] += sum[l];
    }
  });
  return std::accumulate(part.begin(), part.end(), 0.0);
}

double plastic_work(const Body& body, const PlasticHistory& history) {
  return sum_of_places(body.plastic, history, [&](const Place& place, const double* rows) {
    const Tile& tile = body.tiling.tiles[place.tile];
    Pack sum{};
    for (int e = tile.first; e < tile.end; e += kLanes)
      sum += volumes(body, tile.block, place.quad, e) * load(rows + Entries::kWork * kTile + e - tile.first);
    return lane_sum(sum);
  });
}

}  // namespace railstrata
