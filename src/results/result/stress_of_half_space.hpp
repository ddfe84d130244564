#pragma once
// Stresses of a half-space wherever they are asked for, near the patch and far from it.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "bem/subsurface.hpp"

namespace railstrata {

/// Stresses of a half-space at any point: from the patch's own cells near it, from cells three times as large farther
/// away. Planes are kept: the same depths are asked for again and again.
class StressOfHalfSpace {
 public:
  StressOfHalfSpace(Subsurface near, std::vector<double> interfaces, double reach_x, double reach_y)
      : near_(std::move(near)), interfaces_(std::move(interfaces)) {
    const std::unique_ptr<Subsurface> coarse = near_.coarsened();
    const PatchGrid& g = coarse->grid();
    constexpr int kRim = 3;  // cells that bicubic interpolation asks for
    const auto more = [&](double reach, double first, double last, double cell) {
      return std::max(0, static_cast<int>(std::ceil((reach - std::min(-first, last)) / cell)) + kRim);
    };
    far_ = coarse->widened(more(reach_x, g.x(0), g.x(g.nx - 1), g.dx),
                           g.line ? 0 : more(reach_y, g.y(0), g.y(g.ny - 1), g.dy));
  }

  /// From so deep on upwards near the patch from these, of the same tractions on finer cells.
  void refine(std::unique_ptr<Subsurface> finer, double depth) {
    finer_ = std::move(finer);
    finer_to_ = depth;
  }

  std::vector<Sym3> operator()(const std::vector<Vec3>& points, bool below) {
    std::vector<Sym3> out;
    out.reserve(points.size());
    for (Vec3 p : points) {
      p.z = snapped(p.z);
      const bool near = near_.covers(p);
      if (!near && !far_->covers(p)) {
        out.push_back({});  // beyond the box: as good as unloaded
        continue;
      }
      const bool fine = near && p.z < finer_to_ && finer_->covers(p);
      const Subsurface& body = fine ? *finer_ : near ? near_ : *far_;
      std::map<double, StatePlane>& known = fine ? finer_planes_ : near ? near_planes_ : far_planes_;
      out.push_back(body.stress_at(plane_of(body, known, p.z), p, below));
    }
    return out;
  }

 private:
  /// An interface by its own depth: one rounded to the other side of it would have the other material's stress.
  double snapped(double depth) const {
    constexpr double kRoundOff = 1e-9;
    for (const double z : interfaces_)
      if (std::abs(depth - z) < kRoundOff) return z;
    return depth;
  }

  static const StatePlane& plane_of(const Subsurface& body, std::map<double, StatePlane>& known, double depth) {
    const auto found = known.find(depth);
    return found != known.end() ? found->second : known.emplace(depth, body.plane(depth)).first->second;
  }

  Subsurface near_;
  std::vector<double> interfaces_;
  std::unique_ptr<Subsurface> far_, finer_;
  double finer_to_ = -1;
  std::map<double, StatePlane> near_planes_, far_planes_, finer_planes_;
};

}  // namespace railstrata
