#include "fem/watched_points.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "geometry/height_field.hpp"

namespace railstrata {
namespace {

class PointsOf {
 public:
  PointsOf(const SweptBody& rail, double end) : rail_(rail), band_(rail.contact), end_(end) {}

  /// The element of `row` that has x, or the one before it.
  void add(double x, int row, int back = 0) {
    const Block& block = rail_.blocks[static_cast<std::size_t>(band_.block)];
    const int element = block.stations.element_at(x) - back, quad = row * band_.columns + band_.columns / 2;
    if (x < 0 || x > end_ || element < 0 || row < 0 || row >= band_.rows || !known_.emplace(quad, element).second)
      return;
    out_.push_back({quad, element, block.stations.centre(element), 0.5 * (band_.depth[row] + band_.depth[row + 1]),
                    rail_.layer_of(block.material(quad, element))});
  }
  /// The row that has a depth.
  int row_at(double depth) const {
    const auto below = std::upper_bound(band_.depth.begin(), band_.depth.end(), depth);
    return static_cast<int>(below - band_.depth.begin()) - 1;
  }
  std::vector<WatchedPoint> points() {
    std::stable_sort(out_.begin(), out_.end(), [](const WatchedPoint& a, const WatchedPoint& b) { return a.x < b.x; });
    return std::move(out_);
  }

 private:
  const SweptBody& rail_;
  const ContactBand& band_;
  double end_;
  std::set<std::pair<int, int>> known_;
  std::vector<WatchedPoint> out_;
};

}  // namespace

std::vector<WatchedPoint> watched_points(const CaseSpec& spec, const SweptBody& rail, double end, double semi_axis) {
  constexpr double kRoundOff = 1e-9;
  PointsOf points(rail, end);
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
