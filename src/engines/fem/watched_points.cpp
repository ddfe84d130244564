#include "fem/watched_points.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "geometry/height_field.hpp"

namespace railstrata {
namespace {

struct PointsOf {
  const SweptBody& rail;
  double end;
  std::set<std::pair<int, int>> known = {};
  std::vector<WatchedPoint> out = {};

  /// The element of `row` that has x, or the one before it.
  void add(double x, int row, int back = 0) {
    const ContactBand& band = rail.contact;
    const Block& block = rail.blocks[static_cast<std::size_t>(band.block)];
    const int element = block.stations.element_at(x) - back, quad = row * band.columns + band.columns / 2;
    if (x < 0 || x > end || element < 0 || row < 0 || row >= band.rows || !known.emplace(quad, element).second) return;
    out.push_back({quad, element, block.stations.centre(element), 0.5 * (band.depth[row] + band.depth[row + 1]),
                   rail.layer_of(block.material(quad, element))});
  }
  /// The row that has a depth.
  int row_at(double depth) const {
    const std::vector<double>& rows = rail.contact.depth;
    return static_cast<int>(std::upper_bound(rows.begin(), rows.end(), depth) - rows.begin()) - 1;
  }
  std::vector<WatchedPoint> points() {
    std::stable_sort(out.begin(), out.end(), [](const WatchedPoint& a, const WatchedPoint& b) { return a.x < b.x; });
    return std::move(out);
  }
};

}  // namespace

std::vector<WatchedPoint> watched_points(const CaseSpec& spec, const SweptBody& rail, double end, double semi_axis) {
  constexpr double kRoundOff = 1e-9;
  PointsOf points{rail, end};
  const std::vector<double> tops = layer_tops(spec.layers);
  for (std::size_t i = 0; i < spec.layers.size(); ++i) {
    const LayerSpec& layer = spec.layers[i];
    if (layer.on != BodyId::rail) continue;
    const int below = points.row_at(tops[i] + layer.thickness + kRoundOff);
    for (const double x :
         {layer.begin(), layer.begin() + layer.taper_length, layer.end() - layer.taper_length, layer.end()})
      if (std::isfinite(x))
        for (const int row : {0, below - 1, below})
          for (const int back : {1, 0}) points.add(x + kRoundOff, row, back);
    for (const UnbondedStretch& stretch : layer.unbonded)
      for (const double x : {stretch.from, stretch.to})
        for (const int row : {below - 1, below})
          for (const int back : {1, 0}) points.add(x + kRoundOff, row, back);
  }
  const int inside = points.row_at(0.5 * semi_axis);
  const auto add_place = [&](double x) {
    for (const int row : {0, inside}) points.add(x, row);
  };
  for (const StretchSpec& stretch : spec.stretches)
    if (stretch.on == BodyId::rail)
      for (const StretchPoint& p : stretch.along) add_place(p.x);
  for (const Irregularity& is : spec.irregularities) {
    const Extent extent = extent_of(is);
    if (is.on != BodyId::rail || !std::isfinite(extent.from + extent.to)) continue;
    for (const double x : {extent.from, 0.5 * (extent.from + extent.to), extent.to}) add_place(x);
  }
  return points.points();
}

}  // namespace railstrata
