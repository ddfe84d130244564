#include "result/stress_sections.hpp"

#include <algorithm>
#include <cmath>

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

/// Slices at these places, without stresses.
std::vector<StressSection> empty_slices(const std::vector<double>& x, const std::vector<int>& at,
                                        const std::vector<double>& y, const std::vector<int>& columns) {
  std::vector<StressSection> out;
  for (int i : at) {
    StressSection slice;
    slice.at = x[i];
    for (int j : columns) slice.along.push_back(y[j]);
    out.push_back(std::move(slice));
  }
  return out;
}

StressSections interior_sections(const BemResult& r, const LayeredHalfSpace& body, const Subsurface& interior,
                                 double z_up, double x, double y, double deepest) {
  const PatchGrid& g = r.grid;
  StressSections out;
  StressSection &along = out.longitudinal, &across = out.cross;
  for (int i = 0; i < g.nx; ++i) along.along.push_back(g.x(i));
  const int columns = g.line ? 3 : g.ny;  // of a line the same in each third of it
  const auto y_of = [&](int j) { return g.line ? g.dy * (j - 1) / columns : g.y(j); };
  for (int j = 0; j < columns; ++j) across.along.push_back(r.contact.point.y + y_of(j) * std::cos(r.contact.angle));
  const int i0 = nearest(along.along, x), j0 = nearest(across.along, y);
  along.at = across.along[j0];
  across.at = along.along[i0];
  const std::vector<int> at = thinned(g.nx, kMostSlices), beside = thinned(columns, kMostSliceColumns);
  out.slices = empty_slices(along.along, at, across.along, beside);
  for (const Row& row : rows_of(body, g.dx, deepest)) {
    const StatePlane plane = interior.plane(row.depth);
    const auto add = [&](StressSection& section, std::size_t k) {
      Sym3 s = interior.stress(plane, k);
      s.yz *= z_up;
      s.xz *= z_up;
      section.stress.push_back(roll(rotation_by(r.contact.angle), s));
      section.material.push_back(row.material);
    };
    for (int i = 0; i < g.nx; ++i) add(along, g.index(i, g.line ? 0 : j0));
    for (int j = 0; j < columns; ++j) add(across, g.index(i0, g.line ? 0 : j));
    for (std::size_t k = 0; k < at.size(); ++k) {
      for (int j : beside) add(out.slices[k], g.index(at[k], g.line ? 0 : j));
      out.slices[k].depth.push_back(row.depth);
    }
    along.depth.push_back(row.depth);
    across.depth.push_back(row.depth);
  }
  return out;
}

}  // namespace

StressSections band_sections(const BandStress& b, double x, double y) {
  StressSections out;
  StressSection &along = out.longitudinal, &across = out.cross;
  for (int s = 0; s < b.sample.stations; ++s) along.along.push_back(b.x(s));
  for (double t : b.centre_y) across.along.push_back(b.body->origin.y + t);
  const int station = nearest(along.along, x), column = nearest(across.along, y);
  along.at = across.along[column];
  across.at = along.along[station];
  along.depth = across.depth = b.centre_depth;
  const std::vector<int> at = thinned(b.sample.stations, kMostSlices),
                         beside = thinned(b.sample.columns, kMostSliceColumns);
  out.slices = empty_slices(along.along, at, across.along, beside);
  for (StressSection& slice : out.slices) slice.depth = b.centre_depth;
  for (int r = 0; r < b.sample.rows; ++r) {
    const auto add = [&](StressSection& section, int c, int s) {
      section.stress.push_back(b.at(c, r, s));
      section.material.push_back(b.layer(c, r, s));
      if (!b.sample.plastic.empty()) section.plastic.push_back(b.sample.plastic[b.index(c, r, s)]);
    };
    for (int s = 0; s < b.sample.stations; ++s) add(along, column, s);
    for (int c = 0; c < b.sample.columns; ++c) add(across, c, station);
    for (std::size_t k = 0; k < at.size(); ++k)
      for (int c : beside) add(out.slices[k], c, at[k]);
  }
  return out;
}

StressSections rail_sections(const BemResult& r, double x, double y, double deepest) {
  return interior_sections(r, r.rail, rail_interior(r), -1, x, y, deepest);
}
StressSections wheel_sections(const BemResult& r, double x, double y, double deepest) {
  return interior_sections(r, r.wheel, wheel_interior(r), 1, x, y, deepest);
}

}  // namespace railstrata
