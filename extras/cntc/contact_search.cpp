#include "cntc/contact_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "cntc/codes.hpp"

namespace railstrata::cntc {
namespace {

constexpr double kNoSurface = 0.05;  // m: the distance where one of the bodies has ended

struct Lowest {
  double x = 0, y = 0, z = 0;
};

/// The line of the wheel's lowest points, by rising y: where its normal has no part along the track.
std::vector<Lowest> lowest_line(const RigidPair& pair) {
  const Marker& m = pair.wheel_at;
  const double along = m.axes[0].x, across = m.axes[1].x, up = m.axes[2].x;
  std::vector<Lowest> out;
  for (const Outline::Point& p : pair.wheel->points()) {
    const double radius = pair.wheel_radius + p.z;
    double x = 0;
    for (int k = 0; k < 3; ++k) {
      const double depth = std::sqrt(std::max(radius * radius - x * x, 0.0));
      x = std::clamp((radius * p.slope * across - depth * up) / along, -0.5 * radius, 0.5 * radius);
    }
    const Vec3 q = m.to_outer({x, p.y, std::sqrt(radius * radius - x * x) - pair.wheel_radius});
    if (out.empty() || q.y > out.back().y) out.push_back({q.x, q.y, q.z});
  }
  return out;
}

/// The points of the rail's profile in the track, by rising y, with its inclination.
struct RailPoint {
  double y = 0, z = 0, angle = 0;
};
std::vector<RailPoint> rail_line(const RigidPair& pair) {
  std::vector<RailPoint> out;
  for (const Outline::Point& p : pair.rail->points()) {
    const Vec3 q = pair.rail_at.to_outer({0, p.y, p.z});
    if (out.empty() || q.y > out.back().y) out.push_back({q.y, q.z, std::atan(p.slope) + pair.rail_at.roll()});
  }
  return out;
}

/// The interval of a list by rising y that holds y, and the share of its end.
template <class List>
std::optional<std::pair<std::size_t, double>> between(const List& list, double y) {
  if (list.size() < 2 || y < list.front().y || y > list.back().y) return {};
  const auto after =
      std::upper_bound(list.begin() + 1, list.end() - 1, y, [](double v, const auto& p) { return v < p.y; });
  const auto k = static_cast<std::size_t>(after - list.begin()) - 1;
  return std::pair{k, (y - list[k].y) / (list[k + 1].y - list[k].y)};
}
double mix(double a, double b, double share) { return a + share * (b - a); }

/// One row of the search.
struct Row {
  double x = 0, y = 0, z = 0, angle = 0;
  double gap = 1;  ///< m; 1: one of the bodies is not there
};

/// How much a roller's surface falls from its crown line to x.
double fall(double roller_radius, double profile_z, double x) {
  if (roller_radius == 0) return 0;
  const double r = roller_radius - profile_z;
  return r - std::copysign(std::sqrt(std::max(r * r - x * x, 0.0)), r);
}

std::vector<Row> rows_of(const RigidPair& pair, double ds) {
  const std::vector<RailPoint> rail = rail_line(pair);
  const std::vector<Lowest> wheel = lowest_line(pair);
  const double step = 0.3 * ds;
  const int count = static_cast<int>(std::ceil((rail.back().y - rail.front().y) / step)) + 1;
  std::vector<Row> out(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    Row& row = out[static_cast<std::size_t>(k)];
    row.y = rail.front().y + k * step;
    const auto r = between(rail, row.y);
    const auto w = between(wheel, row.y);
    if (!r || !w) continue;
    const RailPoint &a = rail[r->first], &b = rail[r->first + 1];
    const Lowest &c = wheel[w->first], &d = wheel[w->first + 1];
    row.z = mix(a.z, b.z, r->second);
    row.angle = mix(a.angle, b.angle, r->second);
    row.x = mix(c.x, d.x, w->second);
    double lowest = mix(c.z, d.z, w->second);
    if (pair.roller_radius != 0) {
      // Of two parabolas along x, the wheel's about its lowest point and the roller's about 0, the nearest points.
      const double share = pair.wheel_radius / (pair.wheel_radius + pair.roller_radius);
      const double x = row.x * (1 - share);
      lowest -= 0.5 * (row.x - x) * (row.x - x) / pair.wheel_radius;
      row.z += fall(pair.roller_radius, row.z - pair.rail_at.at.z, x);
      row.x = x;
    }
    row.gap = row.z - lowest;
  }
  return out;
}

Overlap overlap_of(const std::vector<Row>& rows, std::size_t begin, std::size_t end, const RigidPair& pair) {
  const double curvature = 0.5 / pair.wheel_radius + (pair.roller_radius != 0 ? 0.5 / pair.roller_radius : 0);
  Overlap out;
  out.extent.x[0] = 1e9;
  out.extent.x[1] = -1e9;
  for (std::size_t k = begin; k < end; ++k) {
    const Row& row = rows[k];
    const double half = std::sqrt(-row.gap / curvature);
    const double weight = std::pow(-row.gap, 2.5);
    out.extent.x[0] = std::min(out.extent.x[0], row.x - half);
    out.extent.x[1] = std::max(out.extent.x[1], row.x + half);
    out.x += weight * row.x;
    out.y += weight * row.y;
    out.angle += weight * row.angle;
    out.weight += weight;
  }
  for (double* sum : {&out.x, &out.y, &out.angle}) *sum /= out.weight;
  const auto ends_at = [&](std::size_t inside, std::size_t outside, int side) {
    const Row &a = rows[inside], &b = rows[outside];
    const bool ends = inside == outside || b.gap > 0.5;
    const double share = ends ? 0 : a.gap / (a.gap - b.gap);
    out.at_end = out.at_end || ends;
    out.extent.y[side] = mix(a.y, b.y, share);
    out.extent.z[side] = mix(a.z, b.z, share);
  };
  ends_at(begin, begin > 0 ? begin - 1 : begin, 0);
  ends_at(end - 1, end < rows.size() ? end : end - 1, 1);
  out.parts = {out.extent};
  return out;
}

double distance(const Box& a, const Box& b) {
  const double x = std::max({a.x[0] - b.x[1], b.x[0] - a.x[1], 0.0});
  double y = 0, z = 0;
  if (a.y[0] > b.y[1]) {
    y = a.y[0] - b.y[1];
    z = a.z[0] - b.z[1];
  } else if (b.y[0] > a.y[1]) {
    y = b.y[0] - a.y[1];
    z = b.z[0] - a.z[1];
  }
  return std::hypot(x, y, z);
}

/// `b` is added to `a`; as a part of its own or in full.
void add(Overlap& a, const Overlap& b, bool as_part) {
  const double all = a.weight + b.weight;
  a.x = (a.x * a.weight + b.x * b.weight) / all;
  a.y = (a.y * a.weight + b.y * b.weight) / all;
  a.angle = (a.angle * a.weight + b.angle * b.weight) / all;
  a.weight = all;
  a.at_end = a.at_end || b.at_end;
  Box& e = a.extent;
  e.x[0] = std::min(e.x[0], b.extent.x[0]);
  e.x[1] = std::max(e.x[1], b.extent.x[1]);
  if (b.extent.y[0] < e.y[0]) {
    e.y[0] = b.extent.y[0];
    e.z[0] = b.extent.z[0];
  }
  if (b.extent.y[1] > e.y[1]) {
    e.y[1] = b.extent.y[1];
    e.z[1] = b.extent.z[1];
  }
  if (as_part)
    a.parts.push_back(b.extent);
  else
    a.parts = {e};
}

void combine(std::vector<Overlap>& all, const SearchSteps& steps, bool as_parts) {
  const double near = as_parts ? steps.separate : std::min(steps.separate, steps.combine);
  for (std::size_t i = 0; i + 1 < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size();) {
      const bool apart =
          std::abs(all[i].angle - all[j].angle) > steps.angle || distance(all[i].extent, all[j].extent) > near;
      if (apart) {
        ++j;
        continue;
      }
      add(all[i], all[j], as_parts);
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(j));
    }
}

/// Patches that are nearly near enough for one turn their planes towards each other.
void turn_planes(std::vector<Overlap>& all, const SearchSteps& steps) {
  if (steps.turn <= steps.separate) return;
  const std::vector<Overlap> before = all;
  for (std::size_t i = 0; i + 1 < before.size(); ++i) {
    const Overlap &a = before[i], &b = before[i + 1];
    const double apart = std::hypot(a.extent.y[0] - b.extent.y[1], a.extent.z[0] - b.extent.z[1]);
    if (std::abs(a.angle - b.angle) > steps.angle || apart < steps.separate || apart > steps.turn) continue;
    const double common = (a.angle * a.weight + b.angle * b.weight) / (a.weight + b.weight);
    const double share = (steps.turn - apart) / (steps.turn - steps.separate);
    all[i].angle += share * (common - a.angle);
    all[i + 1].angle += share * (common - b.angle);
  }
}

/// Newton's method on the way n along the normal; none where a profile ends or turns away.
template <class Function>
std::optional<double> way_to(Function&& value_and_slope, double start) {
  constexpr double kClose = 1e-11;  // m
  double n = start;
  for (int k = 0; k < 30; ++k) {
    const std::optional<std::pair<double, double>> f = value_and_slope(n);
    if (!f || !(std::abs(f->second) > 0.05)) return {};
    const double step = f->first / f->second;
    n -= step;
    if (std::abs(n) > kNoSurface) return {};
    if (std::abs(step) < kClose) return n;
  }
  return {};
}

/// A wheel's profile by chords between points a step apart, from the one at y on: CONTACT's surface, whose distances
/// are then those that it computes.
class Chords {
 public:
  Chords(const Outline& wheel, double y, double step) {
    const std::vector<Outline::Point>& all = wheel.points();
    const double least = wheel.arc(all.front().y), most = wheel.arc(all.back().y);
    const double middle = wheel.arc(std::clamp(y, all.front().y, all.back().y));
    for (double k = std::ceil((least - middle) / step); middle + k * step <= most; ++k)
      points_.push_back(wheel.along(middle + k * step));
  }
  std::optional<Outline::Point> at(double y) const {
    const auto place = between(points_, y);
    if (!place) return {};
    const Outline::Point &a = points_[place->first], &b = points_[place->first + 1];
    return Outline::Point{y, mix(a.z, b.z, place->second), (b.z - a.z) / (b.y - a.y)};
  }

 private:
  std::vector<Outline::Point> points_;
};

/// Along `ray` from `at`, both in the wheel's system.
std::optional<double> way_to_wheel(const RigidPair& pair, const Chords& wheel, Vec3 at, Vec3 ray, double start) {
  return way_to(
      [&](double n) -> std::optional<std::pair<double, double>> {
        const Vec3 p = at + n * ray;
        const std::optional<Outline::Point> q = wheel.at(p.y);
        if (!q) return {};
        const double rho = std::hypot(p.x, p.z + pair.wheel_radius);
        return std::pair{rho - pair.wheel_radius - q->z,
                         (p.x * ray.x + (p.z + pair.wheel_radius) * ray.z) / rho - q->slope * ray.y};
      },
      start);
}

/// The same in the rail's system.
std::optional<double> way_to_rail(const RigidPair& pair, Vec3 at, Vec3 ray, double start) {
  return way_to(
      [&](double n) -> std::optional<std::pair<double, double>> {
        const Vec3 p = at + n * ray;
        if (!pair.rail->covers(p.y)) return {};
        const Outline::Point q = pair.rail->at(p.y);
        if (pair.roller_radius == 0) return std::pair{p.z - q.z, ray.z - q.slope * ray.y};
        const double depth = pair.roller_radius - p.z, rho = std::copysign(std::hypot(p.x, depth), pair.roller_radius);
        return std::pair{pair.roller_radius - q.z - rho, (depth * ray.z - p.x * ray.x) / rho - q.slope * ray.y};
      },
      start);
}

}  // namespace

Search search_overlaps(const RigidPair& pair, const SearchSteps& steps) {
  const std::vector<Row> rows = rows_of(pair, steps.ds);
  const auto least =
      std::min_element(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.gap < b.gap; });
  if (least->gap > 0.5) throw Refused(kSearch, "the wheel does not stand over the rail: check places and profiles");
  Search out;
  out.least_gap = least->gap;
  for (std::size_t k = 0; k < rows.size();) {
    std::size_t end = k;
    while (end < rows.size() && rows[end].gap < 0) ++end;
    if (end > k) out.overlaps.push_back(overlap_of(rows, k, end, pair));
    k = end + 1;
  }
  std::reverse(out.overlaps.begin(), out.overlaps.end());
  combine(out.overlaps, steps, false);
  combine(out.overlaps, steps, true);
  turn_planes(out.overlaps, steps);
  return out;
}

double interaction(const Box& a, const Box& b, const SearchSteps& steps) {
  return std::pow(std::max(0.0, steps.separate - distance(a, b)) / (steps.separate - steps.combine), 0.8);
}

PatchPlane plane_of(const Overlap& overlap, const RigidPair& pair, const SearchSteps& steps, int most_elements,
                    Lattice lattice) {
  const std::vector<RailPoint> rail = rail_line(pair);
  const Marker& at = pair.rail_at;
  const auto profile_y = [&](double y) {
    const auto place = between(rail, y);
    if (!place) throw Refused(kSearch, "a contact lies at the end of the rail's profile");
    const double z = mix(rail[place->first].z, rail[place->first + 1].z, place->second);
    return at.to_inner({0, y, z}).y;
  };
  const auto arc = [&](double y) { return pair.rail->arc(profile_y(y)); };
  PatchPlane out;
  out.angle = overlap.angle;
  const Outline::Point p = pair.rail->at(profile_y(overlap.y));
  Vec3 place = at.to_outer({0, p.y, p.z});
  place.z += fall(pair.roller_radius, p.z, overlap.x);
  place.x = overlap.x;
  out.reference = marker(place, out.angle);
  const double middle = arc(overlap.y), s[2] = {arc(overlap.extent.y[0]) - middle, arc(overlap.extent.y[1]) - middle};
  out.dx = steps.dx;
  out.ds = steps.ds;
  out.rail_arc = middle;
  std::copy(s, s + 2, out.reach);
  if (lattice) {
    out.origin_x = *lattice + overlap.x;
    out.origin_s = middle - pair.rail->zero_arc();
  }
  const double x[2] = {overlap.extent.x[0] - overlap.x + out.origin_x, overlap.extent.x[1] - overlap.x + out.origin_x};
  for (;;) {
    const double x_first = std::floor(x[0] / out.dx) - 1, s_first = std::floor((s[0] + out.origin_s) / out.ds) - 1;
    out.mx = static_cast<int>(std::ceil(x[1] / out.dx) + 2 - x_first);
    out.my = static_cast<int>(std::ceil((s[1] + out.origin_s) / out.ds) + 2 - s_first);
    out.x = x_first * out.dx - out.origin_x;
    out.s = s_first * out.ds - out.origin_s;
    if (lattice || most_elements < 100 || out.mx * out.my < most_elements || (out.mx <= 10 && out.my <= 10)) return out;
    if (out.mx > 10) out.dx *= 2;
    if (out.my > 10) out.ds *= 2;
  }
}

Distance rigid_distance(const RigidPair& pair, const PatchPlane& plane) {
  const auto from = [&](const Marker& m, double x, double s) {
    return m.to_inner(plane.reference.to_outer({x, s, 0}));
  };
  const Vec3 normal = plane.reference.axes[2];
  const Vec3 in_wheel = pair.wheel_at.turned_back(normal), in_rail = pair.rail_at.turned_back(normal);
  const Vec3 origin = plane.reference.to_outer({-plane.origin_x, -plane.origin_s, 0});
  const Chords chords(*pair.wheel, pair.wheel_at.to_inner(origin).y, plane.ds);
  Distance out;
  const std::size_t count = static_cast<std::size_t>(plane.mx) * static_cast<std::size_t>(plane.my);
  out.gap.assign(count, kNoSurface);
  out.rail.assign(count, 0.0);
  out.wheel.assign(count, 0.0);
  out.has_both.assign(count, 0);
  double least = kNoSurface, of_wheel = 0, of_rail = 0;
  for (int j = 0; j < plane.my; ++j) {
    const double s = plane.across(j), turn = plane.rows.empty() ? 0 : plane.rows[static_cast<std::size_t>(j)].turn;
    for (int i = 0; i < plane.mx; ++i) {
      const double x = plane.x + i * plane.dx;
      const auto wheel = way_to_wheel(pair, chords, from(pair.wheel_at, x, s), in_wheel, of_wheel);
      const auto rail = way_to_rail(pair, from(pair.rail_at, x, s), in_rail, of_rail);
      of_wheel = wheel.value_or(0);
      of_rail = rail.value_or(0);
      if (!wheel || !rail) continue;
      const auto k = static_cast<std::size_t>(i + plane.mx * j);
      out.rail[k] = *rail;
      out.wheel[k] = *wheel;
      out.has_both[k] = 1;
      out.gap[k] = (*rail - *wheel) * std::cos(turn);
      least = std::min(least, out.gap[k]);
    }
  }
  for (double& gap : out.gap) gap -= least;
  out.approach = -least;
  return out;
}

}  // namespace railstrata::cntc
