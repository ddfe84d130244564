#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "bem/subsurface.hpp"
#include "core/parabola.hpp"
#include "material/elastic.hpp"

namespace railstrata {

namespace {

bool lies_in(const PatchGrid& g, double x, double y) {
  return x >= g.x0 && x <= g.x(g.nx - 1) && y >= g.y0 && y <= g.y(g.ny - 1);
}

constexpr int kAnyLayer = -1;
/// A cell that does not belong to the layer that is asked for.
constexpr double kElsewhere = -std::numeric_limits<double>::infinity();

/// without: a grid whose cells do not count; may be null.
StressPeak peak_of(const Plane& v, const PatchGrid& g, double depth, const PatchGrid* without) {
  std::size_t k = 0;
  for (std::size_t c = 0; c < v.size(); ++c)
    if (v[c] > v[k] && !(without && lies_in(*without, g.x_of(c), g.y_of(c)))) k = c;
  const int i = static_cast<int>(k) / g.ny, j = static_cast<int>(k) % g.ny;
  StressPeak peak{v[k], g.x(i), g.y(j), depth, largest_at_rim(v, g)};
  const auto refine = [&](std::size_t before, std::size_t after, double size, double& place) {
    if (v[before] == kElsewhere || v[after] == kElsewhere) return;
    if (v[before] > v[k] || v[after] > v[k]) return;  // a slope that goes on within the other grid
    const ParabolaTop t = parabola_top(v[before], v[k], v[after]);
    place += t.at * size;
    peak.value += t.above;
  };
  if (i > 0 && i + 1 < g.nx) refine(g.index(i - 1, j), g.index(i + 1, j), g.dx, peak.x);
  if (j > 0 && j + 1 < g.ny) refine(k - 1, k + 1, g.dy, peak.y);
  if (peak.value == kElsewhere) return {};
  return peak;
}

void keep_larger(StressPeak& best, const StressPeak& other) {
  const double rim = std::max(best.at_rim, other.at_rim);
  if (other.value > best.value) best = other;
  best.at_rim = rim;
}
void keep_larger(ZonePeaks& zone, const ZonePeaks& other) {
  keep_larger(zone.von_mises, other.von_mises);
  keep_larger(zone.sigma1, other.sigma1);
}

/// Which of the two maxima is wanted.
struct Wanted {
  bool von_mises = true, sigma1 = true;
  bool any() const { return von_mises || sigma1; }
};

/// Which maxima to look for on a wider grid: those of which the rim has a good share. The von Mises stress falls from
/// its maximum on; tension may have a second, larger maximum outside.
Wanted beyond(const ZonePeaks& z) {
  return {z.von_mises.at_rim > 0.9 * z.von_mises.value, z.sigma1.at_rim > 0.5 * z.sigma1.value};
}

/// On one grid. Evaluates planes once, however often a depth is asked for.
class GridSearch {
 public:
  explicit GridSearch(const Subsurface& body, const PatchGrid* without = nullptr)
      : body_(body), grid_(body.grid()), without_(without), varies_(!body.layers_of_rows(0, false).empty()) {}

  /// layer: of the cells that count.
  ZonePeaks at(double depth, bool below, int layer) {
    if (!varies_) layer = kAnyLayer;
    const auto key = std::make_tuple(depth, below, layer);
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    if (!(plane_.depth == depth && !plane_.s_zz.empty())) plane_ = body_.plane(depth);
    Plane mises(grid_.size()), sigma1(grid_.size());
    const std::vector<int> layers = layer == kAnyLayer ? std::vector<int>{} : body_.layers_of_rows(depth, below);
    for (std::size_t k = 0; k < mises.size(); ++k) {
      if (!layers.empty() && layers[k % layers.size()] != layer) {
        mises[k] = sigma1[k] = kElsewhere;
        continue;
      }
      const Sym3 s = body_.stress(plane_, k, below);
      mises[k] = von_mises(s);
      sigma1[k] = principal_stresses(s).x;
    }
    return known_[key] = {peak_of(mises, grid_, depth, without_), peak_of(sigma1, grid_, depth, without_)};
  }

  /// Largest values for depths in [top, bottom] of one material; at the top its own (lower) side is taken.
  ZonePeaks zone(double top, double bottom, int layer, Wanted wanted) {
    const int pieces = std::clamp(static_cast<int>(std::ceil((bottom - top) / (2 * grid_.finest()))), 2, 16);
    std::vector<double> depth;
    for (int i = 0; i <= pieces; ++i) depth.push_back(i == pieces ? bottom : top + (bottom - top) * i / pieces);
    ZonePeaks best;
    for (double z : depth) keep_larger(best, at(z, z == top, layer));
    if (wanted.von_mises) refine(depth, top, layer, best, &ZonePeaks::von_mises);
    if (wanted.sigma1) refine(depth, top, layer, best, &ZonePeaks::sigma1);
    return best;
  }

 private:
  /// Successive parabolas through the largest value and its neighbours; every depth tried joins the list. No golden
  /// section: a plane costs a convolution, and near its top the curve is a parabola.
  void refine(std::vector<double> depth, double top, int layer, ZonePeaks& best, StressPeak ZonePeaks::*which) {
    for (int pass = 0; pass < 6; ++pass) {
      std::size_t m = 0;
      const auto value = [&](std::size_t i) { return (at(depth[i], depth[i] == top, layer).*which).value; };
      for (std::size_t i = 1; i < depth.size(); ++i)
        if (value(i) > value(m)) m = i;
      if (m == 0 ||
          m + 1 == depth.size()) {  // at the end of the zone: halve the end interval, the peak may hide inside
        const double inner = m == 0 ? 0.5 * (depth[0] + depth[1]) : 0.5 * (depth[m] + depth[m - 1]);
        if (std::abs(inner - depth[m]) < 0.05 * grid_.finest()) return;
        depth.insert(m == 0 ? depth.begin() + 1 : depth.end() - 1, inner);
        keep_larger(best, at(inner, false, layer));
        continue;
      }
      const double a = depth[m - 1], b = depth[m], c = depth[m + 1], fa = value(m - 1), fb = value(m),
                   fc = value(m + 1);
      const double numerator = (b - a) * (b - a) * (fb - fc) - (b - c) * (b - c) * (fb - fa),
                   denominator = (b - a) * (fb - fc) - (b - c) * (fb - fa);
      const double next = denominator != 0 ? b - 0.5 * numerator / denominator : b;
      if (!(next > a && next < c) || std::abs(next - b) < 0.01 * grid_.finest()) return;
      keep_larger(best, at(next, false, layer));
      depth.insert(depth.begin() + static_cast<std::ptrdiff_t>(next < b ? m : m + 1), next);
    }
  }

  const Subsurface& body_;
  const PatchGrid& grid_;
  const PatchGrid* without_;
  bool varies_;  // layers, from row to row
  StatePlane plane_;
  std::map<std::tuple<double, bool, int>, ZonePeaks> known_;
};

/// Goes outside of the grid where its rim has a good share of a maximum, and deeper where one lies at the lower end.
class PeakSearch {
 public:
  explicit PeakSearch(const Subsurface& body) : body_(body), near_(body) {}

  ZonePeaks at(double depth, bool below, int layer) {
    return widening([&](GridSearch& grid, Wanted) { return grid.at(depth, below, layer); });
  }

  ZonePeaks zone(double top, double bottom, int layer) {
    return widening([&](GridSearch& grid, Wanted wanted) { return grid.zone(top, bottom, layer, wanted); });
  }

  /// The substrate, a zone without a floor, looked at from `top` to `bottom` and, while a maximum lies there, to twice
  /// that depth.
  ZonePeaks zone_without_floor(double top, double bottom) {
    constexpr int kDeepenings = 3;
    ZonePeaks best = zone(top, bottom, 0);
    const auto at_floor = [&] { return best.von_mises.depth >= bottom || best.sigma1.depth >= bottom; };
    for (int i = 0; i < kDeepenings && at_floor(); ++i) {
      top = bottom;
      bottom *= 2;
      keep_larger(best, zone(top, bottom, 0));
    }
    for (StressPeak* peak : {&best.von_mises, &best.sigma1})
      if (peak->depth >= bottom) peak->at_rim = peak->value;
    return best;
  }

 private:
  template <class Search>
  ZonePeaks widening(Search&& search) {
    ZonePeaks best = search(near_, Wanted{});
    const Wanted wanted = beyond(best);
    if (!wanted.any()) return best;
    if (!far_) {
      far_body_ = body_.coarsened();
      far_.emplace(*far_body_, &body_.grid());
    }
    const ZonePeaks outside = search(*far_, wanted);
    const auto take = [](StressPeak& peak, const StressPeak& other) {
      if (other.value > peak.value) peak = other;
      peak.at_rim = other.at_rim;
    };
    if (wanted.von_mises) take(best.von_mises, outside.von_mises);
    if (wanted.sigma1) take(best.sigma1, outside.sigma1);
    return best;
  }

  const Subsurface& body_;
  GridSearch near_;
  std::unique_ptr<Subsurface> far_body_;
  std::optional<GridSearch> far_;
};

}  // namespace

SubsurfacePeaks Subsurface::peaks(SearchDepths depths) const {
  PeakSearch search(*this);
  SubsurfacePeaks out;
  out.surface = search.at(0, true, kAnyLayer);
  double top = 0;
  int number = 0;
  for (const LayerExtent& layer : layer_extents(body_)) {
    const double varied = bottom_of(++number),
                 from = top == 0 || varied > 0 ? std::min(depths.from, 0.5 * layer.bottom) : top;
    out.layers.push_back(search.zone(from, std::max(layer.bottom, varied), number));
    if (layer.bottom > depths.from) keep_larger(out.subsurface, out.layers.back());
    out.above_interface.push_back(search.at(layer.bottom, false, number));
    out.below_interface.push_back(search.at(layer.bottom, true, kAnyLayer));
    top = layer.bottom;
  }
  const double floor = top + 4 * grid_.finest();
  if (!layers_of_rows(0, false).empty()) top = 0;  // the substrate beside the layers
  out.matrix = search.zone_without_floor(std::max(top, depths.from), std::max(depths.deepest, floor));
  if (!out.below_interface.empty()) keep_larger(out.matrix, search.at(layer_extents(body_).back().bottom, true, 0));
  keep_larger(out.subsurface, out.matrix);
  return out;
}

}  // namespace railstrata
