#include "damage/critical_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "core/parallel.hpp"
#include "damage/deviator.hpp"
#include "damage/enclosing_ball.hpp"
#include "material/elastic.hpp"

namespace railstrata {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kFine = 0.2 * kDegree;
// Of the largest so far: what may become the largest on planes at 2.5 degrees, and on the finest.
constexpr double kNear = 0.9, kNearFine = 0.98;

double tension(double stress) { return std::max(stress, 0.0); }

/// Two unit vectors that complete n to a frame.
std::array<Vec3, 2> plane_axes(Vec3 n) {
  const Vec3 other = std::abs(n.z) < 0.7 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 across = cross(other, n);
  const Vec3 first = (1 / norm(across)) * across;
  return {first, cross(n, first)};
}

/// The hemisphere z >= 0, each plane once.
const std::vector<Vec3>& coarse_planes() {
  static const std::vector<Vec3> all = [] {
    std::vector<Vec3> planes{{0, 0, 1}};
    for (int polar = 10; polar <= 90; polar += 10)
      for (int azimuth = 0; azimuth < (polar < 90 ? 360 : 180); azimuth += 10) {
        const double p = polar * kDegree, a = azimuth * kDegree;
        planes.push_back({std::sin(p) * std::cos(a), std::sin(p) * std::sin(a), polar < 90 ? std::cos(p) : 0});
      }
    return planes;
  }();
  return all;
}

/// The cycle of a point, ready to be looked at on many planes.
class PointCycle {
 public:
  PointCycle(std::span<const Sym3> cycle, const Sym3& residual, double young, double poisson)
      : cycle_(cycle),
        residual_(residual),
        young_(young),
        poisson_(poisson),
        shear_modulus_(young / (2 * (1 + poisson))),
        along_(cycle.size()),
        across_(cycle.size()) {
    for (const Sym3& s : cycle) volume_.push_back(poisson / young * (s.xx + s.yy + s.zz));
  }

  double shear_modulus() const { return shear_modulus_; }

  /// Normal part; shear_bound() and shear_range() are of the plane last looked at.
  PlaneCycle look_at(Vec3 n) {
    const auto [first, second] = plane_axes(n);
    double stress_high = -HUGE_VAL, strain_low = HUGE_VAL, strain_high = -HUGE_VAL;
    for (std::size_t i = 0; i < cycle_.size(); ++i) {
      const Vec3 t = cycle_[i] * n;
      const double normal = dot(t, n), strain = normal / (2 * shear_modulus_) - volume_[i];
      along_[i] = dot(t, first);
      across_[i] = dot(t, second);
      stress_high = std::max(stress_high, normal);
      strain_low = std::min(strain_low, strain);
      strain_high = std::max(strain_high, strain);
    }
    return {stress_high + dot(residual_ * n, n), strain_high - strain_low, 0};
  }
  /// Diameter of a circle that holds the shear vector's path: the smallest one is not wider.
  double shear_bound() const {
    const auto middle = [](const std::vector<double>& v) {
      const auto [low, high] = std::minmax_element(v.begin(), v.end());
      return 0.5 * (*low + *high);
    };
    const double first = middle(along_), second = middle(across_);
    double most = 0;
    for (std::size_t i = 0; i < along_.size(); ++i) {
      const double a = along_[i] - first, b = across_[i] - second;
      most = std::max(most, a * a + b * b);
    }
    return 2 * std::sqrt(most);
  }
  double shear_range() {
    path_.resize(along_.size());
    for (std::size_t i = 0; i < along_.size(); ++i) path_[i] = {along_[i], across_[i], 0, 0, 0};
    return 2 * enclosing_ball(path_, free_directions(0, 1)).radius;
  }

  /// No plane has more of either. Normal stress: the largest principal one. Shear: no plane carries more than sqrt(J2)
  /// of a stress, so twice the largest distance of the deviator from any centre. Normal strain: twice the largest
  /// principal strain from any centre, in magnitude.
  PlaneCycle bound() const {
    PlaneCycle out{-HUGE_VAL, 0, 0};
    const Sym3 centre = middle();
    for (std::size_t i = 0; i < cycle_.size(); ++i) {
      out.normal_max = std::max(out.normal_max, principal_stresses(cycle_[i] + residual_).x);
      const Sym3 d = cycle_[i] - centre;
      out.shear_range = std::max(out.shear_range, 2 * equivalent_shear(d));
      const Vec3 p = principal_stresses(d);
      const double volume = poisson_ / young_ * (d.xx + d.yy + d.zz);
      for (const double s : {p.x, p.z})
        out.normal_strain_range = std::max(out.normal_strain_range, 2 * std::abs(s / (2 * shear_modulus_) - volume));
    }
    return out;
  }

 private:
  /// Of the smallest and largest value of every component.
  Sym3 middle() const {
    Sym3 low = cycle_[0], high = cycle_[0];
    for (const Sym3& s : cycle_)
      for (double Sym3::*c : {&Sym3::xx, &Sym3::yy, &Sym3::zz, &Sym3::xy, &Sym3::yz, &Sym3::xz}) {
        low.*c = std::min(low.*c, s.*c);
        high.*c = std::max(high.*c, s.*c);
      }
    return 0.5 * (low + high);
  }

  std::span<const Sym3> cycle_;
  Sym3 residual_;
  double young_, poisson_, shear_modulus_;
  std::vector<double> volume_;  ///< nu/E times the trace
  std::vector<double> along_, across_;
  std::vector<Vec5> path_;
};

enum class Parameter { smith_watson_topper, fatemi_socie, jiang_sehitoglu };

double value_of(Parameter parameter, const PlaneCycle& c, const CriticalPlaneMaterial& m, double shear_modulus) {
  const double normal = 0.5 * tension(c.normal_max) * c.normal_strain_range, slide = c.shear_range / shear_modulus;
  switch (parameter) {
    case Parameter::smith_watson_topper:
      return normal;
    case Parameter::fatemi_socie:
      return 0.5 * slide * tension(1 + m.fatemi_socie->k * c.normal_max / m.fatemi_socie->yield);
    case Parameter::jiang_sehitoglu:
      return normal + *m.jiang_sehitoglu * slide * c.shear_range;
  }
  return 0;
}

/// The search on the planes of one point.
class PlaneSearch {
 public:
  PlaneSearch(Parameter parameter, const CriticalPlaneMaterial& material, PointCycle& point)
      : parameter_(parameter), material_(material), point_(point) {}

  /// Takes the best plane where it beats `best`.
  void improve(CriticalPlane& best, int column) {
    const std::vector<Vec3>& planes = coarse_planes();
    std::vector<double> values(planes.size());
    double largest = best.value;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      values[i] = look(planes[i], kNear * largest).value;
      largest = std::max(largest, values[i]);
    }
    std::vector<CriticalPlane> cells;
    for (std::size_t i = 0; i < planes.size(); ++i)
      if (values[i] > 0 && values[i] >= kNear * largest) cells.push_back(scan({values[i], column, planes[i], {}}));
    std::stable_sort(cells.begin(), cells.end(),
                     [](const CriticalPlane& one, const CriticalPlane& other) { return one.value > other.value; });
    std::vector<Vec3> starts;
    for (const CriticalPlane& cell : cells) {
      if (cell.value < kNearFine * std::max(cells.front().value, best.value)) break;
      if (std::any_of(starts.begin(), starts.end(), [&](Vec3 n) { return is_beside(n, cell.normal); })) continue;
      starts.push_back(cell.normal);
      climb(cell, best);
    }
  }

 private:
  struct Looked {
    double value = 0;  ///< 0 where it cannot be above the threshold
    PlaneCycle cycle;
  };
  Looked look(Vec3 normal, double threshold) {
    Looked out{0, point_.look_at(normal)};
    if (parameter_ != Parameter::smith_watson_topper) {
      out.cycle.shear_range = point_.shear_bound();
      if (value(out.cycle) <= threshold) return out;
      out.cycle.shear_range = point_.shear_range();
    }
    out.value = value(out.cycle);
    return out;
  }
  double value(const PlaneCycle& cycle) const { return value_of(parameter_, cycle, material_, point_.shear_modulus()); }

  /// So near that a climb from one comes to the other's peak, or to one of the same height.
  static bool is_beside(Vec3 a, Vec3 b) {
    static const double near = std::cos(6 * kDegree);
    return std::abs(dot(a, b)) > near;
  }
  static Vec3 tilted(Vec3 n, const std::array<Vec3, 2>& axes, double i, double j) {
    const Vec3 v = n + std::tan(i) * axes[0] + std::tan(j) * axes[1];
    return (1 / norm(v)) * v;
  }

  /// The best of 16 planes that divide the cell of a coarse one.
  CriticalPlane scan(CriticalPlane cell) {
    const Vec3 centre = cell.normal;
    const auto axes = plane_axes(centre);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        take(tilted(centre, axes, (2.5 * i - 3.75) * kDegree, (2.5 * j - 3.75) * kDegree), cell);
    return cell;
  }
  void climb(CriticalPlane cell, CriticalPlane& best) {
    cell.value = 0;  // so that its cycle is taken too
    take(cell.normal, cell);
    climb(kDegree, cell);
    climb(kFine, cell);
    if (cell.normal.z < 0) cell.normal = -cell.normal;
    if (cell.value > best.value) best = cell;
  }
  /// Windows of 7 x 7 planes around the best so far, moved on while the best lies at the rim.
  void climb(double step, CriticalPlane& found) {
    constexpr int reach = 3, moves = 20;
    for (int move = 0; move < moves; ++move) {
      const Vec3 centre = found.normal;
      const auto axes = plane_axes(centre);
      bool at_rim = false;
      for (int i = -reach; i <= reach; ++i)
        for (int j = -reach; j <= reach; ++j)
          if (take(tilted(centre, axes, i * step, j * step), found))
            at_rim = std::max(std::abs(i), std::abs(j)) == reach;
      if (!at_rim) return;
    }
  }
  bool take(Vec3 normal, CriticalPlane& found) {
    const Looked here = look(normal, found.value);
    if (!(here.value > found.value)) return false;
    found.value = here.value;
    found.normal = normal;
    found.cycle = here.cycle;
    return true;
  }

  Parameter parameter_;
  const CriticalPlaneMaterial& material_;
  PointCycle& point_;
};

/// The worst column of a row, columns with the largest bound first.
CriticalPlane worst_of_row(Parameter parameter, const CriticalPlaneMaterial& material, std::vector<PointCycle>& points,
                           const std::vector<PlaneCycle>& bounds) {
  std::vector<double> most(points.size());
  for (std::size_t c = 0; c < points.size(); ++c)
    most[c] = value_of(parameter, bounds[c], material, points[c].shear_modulus());
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return most[a] > most[b]; });
  CriticalPlane best;
  for (const int column : order) {
    if (!(most[column] > best.value)) break;
    PlaneSearch(parameter, material, points[column]).improve(best, column);
  }
  return best;
}

CriticalPlaneRow search_row(const StressHistory& history, const Sym3& residual, const CriticalPlaneMaterial& material,
                            int row) {
  std::vector<PointCycle> points;
  std::vector<PlaneCycle> bounds;
  for (int column = 0; column < history.columns(); ++column) {
    points.emplace_back(std::span(history.cycle(row, column), history.x.size()), residual, material.young,
                        material.poisson);
    bounds.push_back(points.back().bound());
  }
  CriticalPlaneRow out;
  out.smith_watson_topper = worst_of_row(Parameter::smith_watson_topper, material, points, bounds);
  if (material.fatemi_socie) out.fatemi_socie = worst_of_row(Parameter::fatemi_socie, material, points, bounds);
  if (material.jiang_sehitoglu)
    out.jiang_sehitoglu = worst_of_row(Parameter::jiang_sehitoglu, material, points, bounds);
  return out;
}

void check(const CriticalPlaneMaterial& m) {
  if (!(m.young > 0 && m.poisson > -1 && m.poisson < 0.5))
    throw std::invalid_argument("a critical plane needs E > 0 and -1 < nu < 0.5");
  if (m.fatemi_socie && !(m.fatemi_socie->k >= 0 && m.fatemi_socie->yield > 0))
    throw std::invalid_argument("Fatemi-Socie needs k >= 0 and a positive yield strength");
  if (m.jiang_sehitoglu && !(*m.jiang_sehitoglu >= 0)) throw std::invalid_argument("Jiang-Sehitoglu needs J >= 0");
}

}  // namespace

PlaneCycle plane_cycle(std::span<const Sym3> cycle, const Sym3& residual, const CriticalPlaneMaterial& material,
                       Vec3 normal) {
  check(material);
  if (cycle.empty()) return {};
  PointCycle point(cycle, residual, material.young, material.poisson);
  PlaneCycle out = point.look_at((1 / norm(normal)) * normal);
  out.shear_range = point.shear_range();
  return out;
}

std::vector<CriticalPlaneRow> critical_planes(const StressHistory& history, ResidualRows residual,
                                              std::span<const CriticalPlaneMaterial> materials) {
  check_residual(history, residual);
  check_rows(history, materials.size(), "materials of critical planes");
  for (const CriticalPlaneMaterial& m : materials) check(m);
  std::vector<CriticalPlaneRow> rows(history.depth.size());
  if (history.samples() == 0) return rows;
  for_each(
      history.rows(),
      [&](std::ptrdiff_t r) {
        const int row = static_cast<int>(r);
        rows[row] = search_row(history, residual_of(residual, row), materials[row], row);
      },
      true);
  return rows;
}

}  // namespace railstrata
