#include "result/band_stress.hpp"

#include <cmath>
#include <utility>

namespace railstrata {

BandStress band_stress(const SweptBody& body, BandSample sample, double contact_y) {
  BandStress b{&body, std::move(sample), contact_y, {}, {}};
  const ContactBand& band = body.contact;
  const auto& nodes = body.blocks[band.block].section.nodes;
  for (int c = 0; c < band.columns; ++c) b.centre_y.push_back(0.5 * (nodes[c].y + nodes[c + 1].y));
  for (int r = 0; r < band.rows; ++r) b.centre_depth.push_back(0.5 * (band.depth[r] + band.depth[r + 1]));
  return b;
}

Sym3 stress_at_interface(const BandStress& b, int column, int row, int station, bool below) {
  const int near = below ? row : row - 1, far = below ? row + 1 : row - 2;
  const Sym3 stress = b.at(column, near, station);
  if (far < 0 || far >= b.sample.rows || b.layer(column, far, station) != b.layer(column, near, station)) return stress;
  const double t = (b.body->contact.depth[row] - b.centre_depth[near]) / (b.centre_depth[near] - b.centre_depth[far]);
  return stress + t * (stress - b.at(column, far, station));
}

DepthLine depth_line(const BandStress& b, double x, double y) {
  DepthLine line{x, y, {}, {}, {}, {}};
  int station = 0, column = 0;
  for (int s = 1; s < b.sample.stations; ++s)
    if (std::abs(b.x(s) - x) < std::abs(b.x(station) - x)) station = s;
  for (int c = 1; c < b.sample.columns; ++c)
    if (std::abs(b.centre_y[c] - b.contact_y - y) < std::abs(b.centre_y[column] - b.contact_y - y)) column = c;
  line.x = b.x(station);
  line.y = b.centre_y[column] - b.contact_y;
  for (int r = 0; r < b.sample.rows; ++r) {
    line.depth.push_back(b.centre_depth[r]);
    line.stress.push_back(b.at(column, r, station));
    line.material.push_back(b.layer(column, r, station));
    if (!b.sample.plastic.empty()) line.plastic.push_back(b.sample.plastic[b.index(column, r, station)]);
  }
  return line;
}

}  // namespace railstrata
