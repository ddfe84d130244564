#include "result/stress_sections.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/rotation.hpp"

namespace railstrata {
namespace {

constexpr int kMostSlices = 17, kMostSliceColumns = 34;

int nearest(const std::vector<double>& values, double wanted) {
  const auto closer = [&](double a, double b) { return std::abs(a - wanted) < std::abs(b - wanted); };
  return static_cast<int>(std::min_element(values.begin(), values.end(), closer) - values.begin());
}

struct Row {
  double depth;
  int material;
};

std::vector<Row> rows_of(const LayeredHalfSpace& body, double cell, double deepest) {
  constexpr double kGrowth = 1.06;
  std::vector<Row> rows;
  double top = 0;
  int material = 0;
  for (const LayerExtent& layer : layer_extents(body)) {
    const double thickness = layer.bottom - layer.top;
    const int pieces = std::clamp(static_cast<int>(std::ceil(thickness / cell)), 3, 40);
    ++material;
    for (int k = 0; k < pieces; ++k) rows.push_back({top + (k + 0.5) * thickness / pieces, material});
    top = layer.bottom;
  }
  for (double height = cell; rows.empty() || rows.back().material > 0 || top < deepest; height *= kGrowth) {
    rows.push_back({top + 0.5 * height, 0});
    top += height;
  }
  return rows;
}

/// Every n-th of so many, at most `most` of them, the same number left out at both ends.
std::vector<int> thinned(int n, int most) {
  const int step = (n + most - 1) / most;
  std::vector<int> out;
  for (int i = (n - 1) % step / 2; i < n; i += step) out.push_back(i);
  return out;
}

/// Through the cells nearest to x and y. row(r) gives what adds a cell of the row to a section: (section, column,
/// station).
template <class Row>
StressSections sections_of(std::vector<double> stations, std::vector<double> columns, const std::vector<double>& depth,
                           double x, double y, const Row& row) {
  const int ns = static_cast<int>(stations.size()), nc = static_cast<int>(columns.size());
  const int station = nearest(stations, x), column = nearest(columns, y);
  const std::vector<int> at = thinned(ns, kMostSlices), beside = thinned(nc, kMostSliceColumns);
  StressSections out{
      {columns[column], stations, depth, {}, {}, {}}, {stations[station], columns, depth, {}, {}, {}}, {}};
  for (const int s : at) {
    StressSection& slice = out.slices.emplace_back();
    slice.at = stations[s];
    for (const int c : beside) slice.along.push_back(columns[c]);
    slice.depth = depth;
  }
  for (std::size_t r = 0; r < depth.size(); ++r) {
    const auto add = row(static_cast<int>(r));
    for (int s = 0; s < ns; ++s) add(out.longitudinal, column, s);
    for (int c = 0; c < nc; ++c) add(out.cross, c, station);
    for (std::size_t k = 0; k < at.size(); ++k)
      for (const int c : beside) add(out.slices[k], c, at[k]);
  }
  return out;
}

StressSections interior_sections(const BemResult& r, const LayeredHalfSpace& body, const Subsurface& interior,
                                 double z_up, double x, double y, double deepest) {
  const PatchGrid& g = r.grid;
  std::vector<double> along, across, depth;
  for (int i = 0; i < g.nx; ++i) along.push_back(g.x(i));
  const int columns = g.line ? 3 : g.ny;  // of a line the same in each third of it
  const auto y_of = [&](int j) { return g.line ? g.dy * (j - 1) / columns : g.y(j); };
  for (int j = 0; j < columns; ++j) across.push_back(r.contact.point.y + y_of(j) * std::cos(r.contact.angle));
  const std::vector<Row> rows = rows_of(body, g.finest(), deepest);
  for (const Row& row : rows) depth.push_back(row.depth);
  return sections_of(std::move(along), std::move(across), depth, x, y, [&](int at) {
    const Row& row = rows[at];
    return [&, plane = interior.plane(row.depth)](StressSection& section, int c, int s) {
      Sym3 stress = interior.stress(plane, g.index(s, g.line ? 0 : c));
      stress.yz *= z_up;
      stress.xz *= z_up;
      section.stress.push_back(roll(rotation_by(r.contact.angle), stress));
      section.material.push_back(row.material);
    };
  });
}

void add_cell(const BandStress& b, int column, int row, int station, StressSection& section) {
  section.stress.push_back(b.at(column, row, station));
  section.material.push_back(b.layer(column, row, station));
  if (!b.sample.plastic.empty()) section.plastic.push_back(b.sample.plastic[b.index(column, row, station)]);
}

}  // namespace

StressSections band_sections(const BandStress& b, double x, double y) {
  std::vector<double> along, across;
  for (int s = 0; s < b.sample.stations; ++s) along.push_back(b.x(s));
  for (const double t : b.centre_y) across.push_back(b.body->origin.y + t);
  return sections_of(std::move(along), std::move(across), b.centre_depth, x, y, [&](int r) {
    return [&, r](StressSection& section, int c, int s) { add_cell(b, c, r, s, section); };
  });
}

StressSection depth_line(const BandStress& b, double x, double y) {
  std::vector<double> along, across;
  for (int s = 0; s < b.sample.stations; ++s) along.push_back(b.x(s));
  for (const double t : b.centre_y) across.push_back(t - b.contact_y);
  const int station = nearest(along, x), column = nearest(across, y);
  StressSection line{across[column], {along[station]}, b.centre_depth, {}, {}, {}};
  for (int r = 0; r < b.sample.rows; ++r) add_cell(b, column, r, station, line);
  return line;
}

StressSections rail_sections(const BemResult& r, double x, double y, double deepest) {
  return interior_sections(r, r.rail, rail_interior(r), -1, x, y, deepest);
}
StressSections wheel_sections(const BemResult& r, double x, double y, double deepest) {
  return interior_sections(r, r.wheel, wheel_interior(r), 1, x, y, deepest);
}

}  // namespace railstrata
