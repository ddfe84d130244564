#include "result/band_stress.hpp"

#include <utility>

#include "core/lagrange.hpp"

namespace railstrata {

BandStress band_stress(const SweptBody& body, BandSample sample, double contact_y) {
  BandStress b{&body, std::move(sample), contact_y, {}, {}};
  const ContactBand& band = body.contact;
  const auto& nodes = body.blocks[band.block].section.nodes;
  for (int c = 0; c < band.columns; ++c) b.centre_y.push_back(0.5 * (nodes[c].y + nodes[c + 1].y));
  for (int r = 0; r < band.rows; ++r) b.centre_depth.push_back(0.5 * (band.depth[r] + band.depth[r + 1]));
  return b;
}

Sym3 stress_at_depth(const BandStress& b, int column, int row, int station, double depth) {
  constexpr int kLine = 2, kParabola = 3;
  const int layer = b.layer(column, row, station);
  int first = row, end = row + 1;
  while (first > 0 && b.layer(column, first - 1, station) == layer) --first;
  while (end < b.sample.rows && b.layer(column, end, station) == layer) ++end;
  const int most = end - first > kParabola ? kParabola : kLine;
  const LagrangeStencil through = lagrange_stencil(&b.centre_depth[first], end - first, depth, most);
  Sym3 sum;
  for (int k = 0; k < through.count; ++k)
    sum = sum + through.weight[k] * b.at(column, first + through.first + k, station);
  return sum;
}

}  // namespace railstrata
