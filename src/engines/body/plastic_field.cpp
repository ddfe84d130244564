#include "body/plastic_field.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"

namespace railstrata {
namespace {

using Entries = PlasticEntries;

/// A tensor 11, 22, 33, 12, 23, 13 of an element's frame in the model frame: back by the turn, column by column.
Sym3 turned(const Rotation<double>& turn, const std::array<double, 6>& t) {
  const Vec3 a = rotate_back(turn, {t[0], t[3], t[5]}), b = rotate_back(turn, {t[3], t[1], t[4]}),
             c = rotate_back(turn, {t[5], t[4], t[2]});
  const Vec3 x = rotate_back(turn, {a.x, b.x, c.x}), y = rotate_back(turn, {a.y, b.y, c.y}),
             z = rotate_back(turn, {a.z, b.z, c.z});
  return {x.x, y.y, z.z, x.y, y.z, x.z};
}

/// of(place, block, element of the block, its numbers: entry k at + k * kTile), of all that have any eigenstress.
template <class Of>
void each_element(const Body& body, const PlasticHistory& history, Of&& of) {
  for (int slot = 0; slot < body.plastic.hot_places(history); ++slot) {
    const PlasticElements::Place& place = body.plastic.hot(history, slot);
    const Tile& tile = body.tiling.tiles[place.tile];
    const double* rows = body.plastic.rows(history, slot);
    if (!body.plastic.has_eigenstress(rows)) continue;
    for (int e = tile.first; e < tile.end; ++e) of(place, tile.block, e, rows + e - tile.first);
  }
}

const double* point_of(const Body& body, const double* element, int point) {
  return element + (Entries::kPoints + point * body.plastic.point_entries()) * kTile;
}

}  // namespace

ElementPlasticity element_plasticity(const Body& body, double psi, const PlasticHistory& history, int block, int quad,
                                     int station) {
  ElementPlasticity out;
  const int tile = body.tiling.first_tile[block] + station / kTile;
  const double* rows = body.plastic.rows(history, tile, quad);
  if (!rows) return out;
  const GaussShape<double>& gauss = body.plastic.gauss_at(tile, quad);
  std::array<double, 6> strain{}, backstress{};
  for (int point = 0; point < kGaussPairs; ++point) {
    const double* at = point_of(body, rows + station % kTile, point);
    const double weight = gauss.pair[point].weight;
    for (std::size_t i = 0; i < 6; ++i) strain[i] += weight * at[i * kTile];
    for (int k = 0; k < body.plastic.terms(); ++k)
      for (std::size_t i = 0; i < 6; ++i) backstress[i] += weight * at[(7 + 6 * k + i) * kTile];
    out.accumulated += weight * at[6 * kTile];
  }
  const BlockElements& elements = body.elements[block];
  const bool turns = body.mesh.kind == SweepKind::revolve;
  const Rotation<double> own{elements.cos_q[station], elements.sin_q[station]},
      turn = turns ? own.minus(rotation_by(psi)) : own;
  out.strain = turned(turn, strain);
  out.backstress = turned(turn, backstress);
  return out;
}

PlasticPeak plastic_peak(const Body& body, const PlasticHistory& history) {
  PlasticPeak out;
  each_element(body, history, [&](const PlasticElements::Place& place, int block, int element, const double* rows) {
    for (int point = 0; point < kGaussPairs; ++point) {
      const double p = point_of(body, rows, point)[6 * kTile];
      if (p > out.accumulated) out = {p, block, place.quad, element};
    }
  });
  return out;
}

PlasticExtent plastic_extent(const Body& body, const PlasticHistory& history) {
  PlasticExtent out;
  each_element(body, history, [&](const PlasticElements::Place&, int, int, const double* rows) {
    bool yielded = false;
    for (int point = 0; point < kGaussPairs; ++point) {
      const double* at = point_of(body, rows, point);
      if (at[6 * kTile] == 0) continue;
      yielded = true;
      double plastic[6];
      for (int i = 0; i < 6; ++i) plastic[i] = at[i * kTile];
      out.accumulated = std::max(out.accumulated, at[6 * kTile]);
      out.strain = std::max(out.strain, std::sqrt(2.0 / 3 * double_contraction(plastic, plastic)));
    }
    out.yielded += yielded;
  });
  return out;
}

double backstress_energy(const Body& body, const PlasticHistory& history) {
  double sum = 0;
  each_element(body, history, [&](const PlasticElements::Place& place, int block, int element, const double* rows) {
    const int kind = body.plastic.kind_at(place, body.tiling.tiles[place.tile], body.elements[block], element);
    if (kind == PlasticElements::kElastic) return;
    const PlasticElements::Quad& quad = body.plastic.quad(kind);
    const ElementTable<double>& table = body.elements[block].table;
    const double volume = table.quads[place.quad].shape.volume * table.sigma_c[element];
    for (int point = 0; point < kGaussPairs; ++point)
      for (int k = 0; k < body.plastic.terms(); ++k) {
        const double modulus = quad.material.law.modulus[k];
        if (!(modulus > 0)) continue;
        double back[6];
        for (int i = 0; i < 6; ++i) back[i] = point_of(body, rows, point)[(7 + 6 * k + i) * kTile];
        sum += volume * quad.gauss.pair[point].weight * 0.75 / modulus * double_contraction(back, back);
      }
  });
  return sum;
}

}  // namespace railstrata
