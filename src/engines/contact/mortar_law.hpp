#pragma once
// The geometry of contact/mortar.hpp, pointwise: where the wheel's surface is opposite a point of the rail, and what a
// rail node's row has from its four facets. Templates on the surfaces (contact/surface.hpp, or what a device has of
// them) and on where displacements come from: u(column, station), the node's displacement [m] in the model frame, of
// the wheel in its own axes. Compiled for the search of the processor and for the threads of a device.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/rotation.hpp"
#include "core/simd.hpp"
#include "core/sweep_kind.hpp"

namespace railstrata {

/// Components in the plane of the contact: x in the rolling direction, y lateral.
struct Tangential {
  double x = 0, y = 0;
};
constexpr Tangential operator+(Tangential a, Tangential b) { return {a.x + b.x, a.y + b.y}; }

/// Rigid position of the axle: displacement from the start and rotation psi (positive rolling forward, any number of
/// turns); rail_psi: the same of a rail that is a ring, negative, for the wheel stays where it is.
struct AxlePose {
  double x = 0, y = 0, z = 0, psi = 0, rail_psi = 0;
};

namespace mortar_law {

inline constexpr double kPeriod = 2 * std::numbers::pi;

// Two Gauss points on [0, 1] and the linear shape functions and their duals there: psi_0 = 2 - 3 t, psi_1 = 3 t - 1.
inline constexpr double kFarPoint = 0.78867513459481288225;
RAILSTRATA_POINTWISE double gauss(int side) { return side ? kFarPoint : 0.21132486540518711775; }
RAILSTRATA_POINTWISE double shape(int side, double t) { return side ? t : 1 - t; }
RAILSTRATA_POINTWISE double dual(int side, double t) { return side ? 3 * t - 1 : 2 - 3 * t; }

/// The wheel's surface opposite a rail point.
struct Hit {
  int column, station;        ///< facet
  double weight_y, weight_t;  ///< bilinear coordinates in it
  Vec3 offset;                ///< x_wheel - x_rail, wheel's axes
  bool inside;                ///< within the wheel's contact band
};

/// Wheel nodes that a rail node's facets touch. Stations count from `anchor`, so that they run on over the place where
/// a ring closes.
struct WheelPatch {
  int column = 0, columns = 0;
  int anchor = 0, first = 0, stations = 0;
  RAILSTRATA_POINTWISE int nodes() const { return columns * stations; }
};

/// Area and gap of a row.
struct RowMeasure {
  double area = 0, gap = 0;  ///< m², m
};

/// Value in facet (c, j) at the coordinates wy, wx in [0, 1].
template <class Surface, class U>
RAILSTRATA_POINTWISE Vec3 rail_point(const Surface& rail, const U& u, int c, int j, double wy, double wx) {
  const Vec2 a = rail.node[c], b = rail.node[c + 1], sag = rail.sagitta[c];
  const double bulge = 4 * wy * (1 - wy);
  const double x = (1 - wx) * rail.stations.at[j] + wx * rail.stations.at[j + 1];
  const Vec3 p{rail.origin.x + x, rail.origin.y + (1 - wy) * a.y + wy * b.y + bulge * sag.y,
               rail.origin.z + (1 - wy) * a.z + wy * b.z + bulge * sag.z};
  return p +
         ((1 - wy) * ((1 - wx) * u(c, j) + wx * u(c, j + 1)) + wy * ((1 - wx) * u(c + 1, j) + wx * u(c + 1, j + 1)));
}

template <class Surface>
RAILSTRATA_POINTWISE Vec3 in_wheel_axes(const Surface& wheel, Vec3 point) {
  if (wheel.yaw.s == 0) return point;
  return wheel.origin + yaw_back(wheel.yaw, point - wheel.origin);
}
template <class Surface>
RAILSTRATA_POINTWISE AxlePose in_wheel_axes(const Surface& wheel, const AxlePose& pose) {
  const Vec3 travel = yaw_back(wheel.yaw, {pose.x, pose.y, pose.z});
  return {travel.x, travel.y, travel.z, pose.psi, pose.rail_psi};
}

/// Number of the values at the front of a sorted array that are not above x; below(x, value): x < value.
template <class Values, class Below>
RAILSTRATA_POINTWISE int count_up_to(const Values& values, int count, double x, Below below) {
  int first = 0;
  while (count > 0) {
    const int half = count / 2;
    if (below(x, values[first + half])) {
      count = half;
    } else {
      first += half + 1;
      count -= half + 1;
    }
  }
  return first;
}

/// The same, looked for at `guess` first, and one further either way.
template <class Values, class Below>
RAILSTRATA_POINTWISE int count_up_to(const Values& values, int count, double x, int guess, Below below) {
  for (const int n : {guess, guess + 1, guess - 1})
    if (n > 0 && n < count && !below(x, values[n - 1]) && below(x, values[n])) return n;
  return count_up_to(values, count, x, below);
}

/// Stations of the rail that a search looks at.
struct Window {
  int first = 0, stations = 0;
};
/// Within half_length of `centre`, without the ends of the rail.
template <class Surface>
RAILSTRATA_POINTWISE Window window_around(const Surface& rail, double centre, double half_length) {
  const int stations = rail.stations.nodes();
  const auto& at = rail.stations.at;
  const int begin = count_up_to(at, stations, centre - half_length, [](double x, double v) { return x <= v; }),
            end = count_up_to(at, stations, centre + half_length, [](double x, double v) { return x < v; });
  const int first = std::max(begin, 1);
  return {first, std::max(std::min(end, stations - 1) - first, 0)};
}

/// Index of the station at or before theta, whatever turn it is counted in, and the share of the way to the next one.
/// guess: where it may be.
template <class Surface>
RAILSTRATA_POINTWISE int wheel_station(const Surface& wheel, double theta, double& weight, int guess = 0) {
  const auto& at = wheel.stations.at;
  const int stations = wheel.stations.nodes();
  if (!std::isfinite(theta)) return weight = 0, 0;  // guards end such a run
  theta -= kPeriod * std::floor((theta - at[0]) / kPeriod);
  const int found = count_up_to(at, stations, theta, guess + 1, [](double x, double v) { return x < v; });
  const int j = std::max(found - 1, 0);  // round-off may leave theta below the first station
  const double next = j + 1 < stations ? at[j + 1] : at[0] + kPeriod;
  weight = (theta - at[j]) / (next - at[j]);
  return j;
}

/// The wheel's facet on the radius through a point at `arm` from the moved axle. The correction takes off the
/// tangential mismatch that the radial projection had the last time. guess: where the facet may be.
template <class Surface>
RAILSTRATA_POINTWISE Hit facet_below(const Surface& wheel, const AxlePose& pose, Vec3 arm, Tangential correction,
                                     const Hit& guess) {
  Hit h{};
  const double radius = std::sqrt(arm.x * arm.x + arm.z * arm.z);
  const double theta = std::atan2(arm.x, -arm.z) + pose.psi - correction.x / radius;
  h.station = wheel_station(wheel, theta, h.weight_t, guess.station);
  const double y = arm.y - correction.y;
  h.column = count_up_to(wheel.node, wheel.columns, y, guess.column + 1, [](double v, Vec2 n) { return v < n.y; }) - 1;
  h.inside = h.column >= 1 && h.column < wheel.columns - 2;
  h.column = h.column < 0 ? 0 : h.column > wheel.columns - 2 ? wheel.columns - 2 : h.column;
  const Vec2 a = wheel.node[h.column], b = wheel.node[h.column + 1];
  h.weight_y = (y - a.y) / (b.y - a.y);
  return h;
}

/// Wheel with sines and cosines of its stations, `sine` and `cosine`.
///
/// The exact undeformed point, turned and moved with the axle, plus what the nodal displacements add to the rigid
/// motion of the chord between the nodes. turned: by psi.
template <class Surface, class Angles, class U>
RAILSTRATA_POINTWISE Vec3 wheel_point(const Surface& wheel, const Angles& sine, const Angles& cosine, const U& u,
                                      const AxlePose& pose, const Rotation<double>& turned, const Hit& h) {
  const Vec2 a = wheel.node[h.column], b = wheel.node[h.column + 1], sag = wheel.sagitta[h.column];
  const int next = h.station + 1 < wheel.stations.nodes() ? h.station + 1 : 0;
  const double t0 = wheel.stations.at[h.station], t1 = next ? wheel.stations.at[next] : wheel.stations.at[0] + kPeriod;
  const double wy = h.weight_y, wt = h.weight_t, bulge = 4 * wy * (1 - wy);
  const Vec2 section{(1 - wy) * a.y + wy * b.y + bulge * sag.y, (1 - wy) * a.z + wy * b.z + bulge * sag.z};
  const Rotation<double> at = turn_of(t0 + wt * (t1 - t0) - pose.psi);
  Vec3 x{wheel.origin.x - section.z * at.s, wheel.origin.y + section.y, wheel.origin.z + section.z * at.c};
  PlaneVector<double> chord;  // of the interpolated undeformed nodes, from the axle
  for (int n = 0; n < 4; ++n) {
    const int c = h.column + n % 2, j = n < 2 ? h.station : next;
    const double weight = (n % 2 ? wy : 1 - wy) * (n < 2 ? 1 - wt : wt);
    const double wz = weight * wheel.node[c].z;
    chord.x -= wz * sine[j];
    chord.z += wz * cosine[j];
    x += weight * u(c, j);
  }
  const PlaneVector<double> straight = turned.forward(chord.x, chord.z);
  x.x += chord.x - straight.x;
  x.z += chord.z - straight.z;
  return x;
}

/// The wheel's surface opposite a point p of the rail, all in the wheel's axes. guess: what it was the last time.
template <class Surface, class Angles, class U>
RAILSTRATA_POINTWISE Hit opposite(const Surface& wheel, const Angles& sine, const Angles& cosine, const U& u,
                                  const AxlePose& pose, const Rotation<double>& turned, Vec3 p, Tangential correction,
                                  const Hit& guess = {}) {
  const Vec3 arm{p.x - wheel.origin.x - pose.x, p.y - wheel.origin.y - pose.y, p.z - wheel.origin.z - pose.z};
  Hit h = facet_below(wheel, pose, arm, correction, guess);
  h.offset = wheel_point(wheel, sine, cosine, u, pose, turned, h) - p;
  return h;
}

/// Signed number of stations from `anchor` the shorter way round a ring.
RAILSTRATA_POINTWISE int stations_from(int anchor, int station, int ring) {
  int d = station - anchor;
  if (d > ring / 2) d -= ring;
  if (d < -ring / 2) d += ring;
  return d;
}

/// Facets around the rail node (c, j) are (c - 1, j - 1), (c, j - 1), (c - 1, j), (c, j): the node is their corner (1,
/// 1), (0, 1), (1, 0), (0, 0). hit(q, g): at Gauss point g of facet q.
template <class Hits>
RAILSTRATA_POINTWISE WheelPatch wheel_patch(const Hits& hit, int ring) {
  const int anchor = hit(0, 0).station;
  int column_lo = hit(0, 0).column, column_hi = column_lo + 1, lo = 0, hi = 1;
  for (int q = 0; q < 4; ++q)
    for (int g = 0; g < 4; ++g) {
      const int station = stations_from(anchor, hit(q, g).station, ring), column = hit(q, g).column;
      column_lo = std::min(column_lo, column);
      column_hi = std::max(column_hi, column + 1);
      lo = std::min(lo, station);
      hi = std::max(hi, station + 1);
    }
  return {column_lo, column_hi - column_lo + 1, anchor, lo, hi - lo + 1};
}

/// Area and gap of the row of rail node (c, j), and a_A m_AW of the wheel nodes in its patch: add(k, number), k =
/// station * columns + column.
template <class Surface, class Hits, class Add>
RAILSTRATA_POINTWISE RowMeasure integrate(const Surface& rail, int c, int j, const Hits& hit, const WheelPatch& patch,
                                          int ring, Vec3 normal_on_wheel, const Add& add) {
  const int nc = patch.columns;
  double area = 0, gap = 0;
  for (int q = 0; q < 4; ++q) {
    const int side_y = q % 2 ? 0 : 1, side_x = q / 2 ? 0 : 1;  // which corner of the facet the node is
    const int column = c - side_y, station = j - side_x;
    const double facet_area = rail.width[column] * (rail.stations.at[station + 1] - rail.stations.at[station]);
    for (int g = 0; g < 4; ++g) {
      const Hit& h = hit(q, g);
      const double ty = gauss(g % 2), tx = gauss(g / 2);
      const double weight = 0.25 * facet_area * dual(side_y, ty) * dual(side_x, tx);
      area += 0.25 * facet_area * shape(side_y, ty) * shape(side_x, tx);
      gap += weight * dot(h.offset, normal_on_wheel);
      const int t = stations_from(patch.anchor, h.station, ring) - patch.first, n = h.column - patch.column;
      assert(t >= 0 && t + 1 < patch.stations);
      assert(n >= 0 && n + 1 < nc);
      const int at = t * nc + n;
      add(at, weight * (1 - h.weight_y) * (1 - h.weight_t));
      add(at + 1, weight * h.weight_y * (1 - h.weight_t));
      add(at + nc, weight * (1 - h.weight_y) * h.weight_t);
      add(at + nc + 1, weight * h.weight_y * h.weight_t);
    }
  }
  return {area, gap / area};
}

/// Rows whose nodes lie as many columns or as many stations apart share no wheel node: the least such number. The
/// outermost Gauss points of two rows then are two of the wheel's facets apart, with 2 % for what the surfaces deform.
/// Along the sweep it is that of the finest stations, which the contact is to stay on. Surfaces with vectors.
template <class Surface>
int independent_distance(const Surface& rail, const Surface& wheel) {
  const auto across = [](const Surface& s, bool finest) {
    double out = std::abs(s.node[1].y - s.node[0].y);
    for (int c = 1; c + 1 < s.columns; ++c) {
      const double d = std::abs(s.node[c + 1].y - s.node[c].y);
      out = finest ? std::min(out, d) : std::max(out, d);
    }
    return out;
  };
  const auto along = [](const Surface& s) {
    double out = s.stations.at[1] - s.stations.at[0];
    for (std::size_t j = 1; j + 1 < s.stations.at.size(); ++j)
      out = std::min(out, s.stations.at[j + 1] - s.stations.at[j]);
    return out;
  };
  const double ratio =
      std::max(across(wheel, false) / across(rail, true), wheel.radius * along(wheel) / (rail.radius * along(rail)));
  constexpr double kMost = 64;  // farther than any patch: the rows stand one after the other
  return static_cast<int>(std::ceil(std::min(2 * kFarPoint + 2.04 * ratio, kMost)));
}

}  // namespace mortar_law
}  // namespace railstrata
