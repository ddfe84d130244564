#include "damage/critical_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "core/parallel.hpp"
#include "core/vectorize.hpp"
#include "damage/deviator.hpp"
#include "damage/enclosing_ball.hpp"
#include "material/elastic.hpp"

namespace railstrata {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kFine = 0.2 * kDegree;
// Shares of the largest value so far above which a plane is refined: at 2.5 degrees, and on the finest planes.
constexpr double kNear = 0.9, kNearFine = 0.98;

constexpr std::array<double Sym3::*, 6> kComponents{&Sym3::xx, &Sym3::yy, &Sym3::zz, &Sym3::xy, &Sym3::yz, &Sym3::xz};

double tension(double stress) { return std::max(stress, 0.0); }

struct Extremes {
  double low = HUGE_VAL, high = -HUGE_VAL;
  double middle() const { return 0.5 * (low + high); }
};
/// In eight lanes, so that compilers have vectors without leave to reorder.
Extremes extremes(const std::vector<double>& values) {
  constexpr std::size_t lanes = 8;
  double low[lanes], high[lanes];
  std::fill_n(low, lanes, HUGE_VAL);
  std::fill_n(high, lanes, -HUGE_VAL);
  std::size_t i = 0;
  for (; i + lanes <= values.size(); i += lanes)
    for (std::size_t k = 0; k < lanes; ++k) {
      const double v = values[i + k];
      low[k] = low[k] < v ? low[k] : v;
      high[k] = high[k] > v ? high[k] : v;
    }
  Extremes all{*std::min_element(low, low + lanes), *std::max_element(high, high + lanes)};
  for (; i < values.size(); ++i) {
    all.low = std::min(all.low, values[i]);
    all.high = std::max(all.high, values[i]);
  }
  return all;
}

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
        across_(cycle.size()),
        normal_(cycle.size()),
        strain_(cycle.size()) {
    for (std::size_t c = 0; c < components_.size(); ++c)
      for (const Sym3& s : cycle) components_[c].push_back(s.*kComponents[c]);
    for (const Sym3& s : cycle) volume_.push_back(poisson / young * (s.xx + s.yy + s.zz));
  }

  double shear_modulus() const { return shear_modulus_; }

  /// Normal part; shear_bound() and shear_range() are of the plane last looked at.
  PlaneCycle look_at(Vec3 n) {
    const auto [u, v] = plane_axes(n);
    const double* xx = components_[0].data();
    const double* yy = components_[1].data();
    const double* zz = components_[2].data();
    const double* xy = components_[3].data();
    const double* yz = components_[4].data();
    const double* xz = components_[5].data();
    const double* volume = volume_.data();
    double *along = along_.data(), *across = across_.data(), *normal = normal_.data(), *strain = strain_.data();
    const double by_two_g = 0.5 / shear_modulus_;
    const std::size_t samples = cycle_.size();
    RAILSTRATA_INDEPENDENT
    for (std::size_t i = 0; i < samples; ++i) {
      const double x = xx[i] * n.x + xy[i] * n.y + xz[i] * n.z, y = xy[i] * n.x + yy[i] * n.y + yz[i] * n.z,
                   z = xz[i] * n.x + yz[i] * n.y + zz[i] * n.z;
      normal[i] = x * n.x + y * n.y + z * n.z;
      strain[i] = normal[i] * by_two_g - volume[i];
      along[i] = x * u.x + y * u.y + z * u.z;
      across[i] = x * v.x + y * v.y + z * v.z;
    }
    const Extremes strains = extremes(strain_);
    return {extremes(normal_).high + dot(residual_ * n, n), strains.high - strains.low, 0};
  }
  /// Diameter of a circle that holds the shear vector's path: the smallest one is not wider.
  double shear_bound() {
    const double middle_a = extremes(along_).middle(), middle_b = extremes(across_).middle();
    const double *along = along_.data(), *across = across_.data();
    double* squared = normal_.data();
    const std::size_t samples = cycle_.size();
    RAILSTRATA_INDEPENDENT
    for (std::size_t i = 0; i < samples; ++i) {
      const double a = along[i] - middle_a, b = across[i] - middle_b;
      squared[i] = a * a + b * b;
    }
    return 2 * std::sqrt(extremes(normal_).high);
  }
  /// The smallest circle, of the few points that can lie on it. One of radius r around any centre c that holds all, and
  /// half a chord, h: the smallest circle's centre is at most sqrt(r² - h²) from c, its radius at least h.
  double shear_range() {
    const std::size_t one = farthest(along_[0], across_[0]), other = farthest(along_[one], across_[one]);
    const double a = 0.5 * (along_[one] + along_[other]), b = 0.5 * (across_[one] + across_[other]);
    const std::size_t rim = farthest(a, b);
    const double least = squared_distance(one, a, b), most = squared_distance(rim, a, b);
    const double inside = std::sqrt(least) * (1 - 1e-12) - std::sqrt(std::max(0.0, most - least));
    path_.clear();
    for (std::size_t i = 0; i < along_.size(); ++i)
      if (inside <= 0 || squared_distance(i, a, b) >= inside * inside)
        path_.push_back({along_[i], across_[i], 0, 0, 0});
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
  double squared_distance(std::size_t i, double a, double b) const {
    return (along_[i] - a) * (along_[i] - a) + (across_[i] - b) * (across_[i] - b);
  }
  std::size_t farthest(double a, double b) const {
    std::size_t found = 0;
    double most = -1;
    for (std::size_t i = 0; i < along_.size(); ++i)
      if (const double d = squared_distance(i, a, b); d > most) {
        most = d;
        found = i;
      }
    return found;
  }
  /// Mean of the smallest and largest value of every component.
  Sym3 middle() const {
    Sym3 out;
    for (std::size_t c = 0; c < components_.size(); ++c) out.*kComponents[c] = extremes(components_[c]).middle();
    return out;
  }

  std::span<const Sym3> cycle_;
  Sym3 residual_;
  double young_, poisson_, shear_modulus_;
  std::array<std::vector<double>, 6> components_;
  std::vector<double> volume_;                            ///< nu/E times the trace
  std::vector<double> along_, across_, normal_, strain_;  ///< on the plane last looked at; normal_ is scratch too
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
