#include "contact/mortar.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/parallel.hpp"

namespace railstrata {
namespace {

constexpr double kPeriod = 2 * std::numbers::pi;
// Two Gauss points on [0, 1] and the linear shape functions and their duals there: psi_0 = 2 - 3 t, psi_1 = 3 t - 1.
constexpr double kPoint[2] = {0.21132486540518711775, 0.78867513459481288225};
double shape(int side, double t) { return side ? t : 1 - t; }
double dual(int side, double t) { return side ? 3 * t - 1 : 2 - 3 * t; }

}  // namespace

MortarContact::MortarContact(ContactSurface rail, ContactSurface wheel)
    : rail_(std::move(rail)), wheel_(std::move(wheel)), inner_columns_(rail_.columns - 2) {
  for (double t : wheel_.stations.at) {
    sin_t_.push_back(std::sin(t));
    cos_t_.push_back(std::cos(t));
  }
}

Vec3 MortarContact::rail_point(const Field& u, int c, int j, double wy, double wx) const {
  const Vec2 a = rail_.node[c], b = rail_.node[c + 1], sag = rail_.sagitta[c];
  const double bulge = 4 * wy * (1 - wy);
  const double x = (1 - wx) * rail_.stations.at[j] + wx * rail_.stations.at[j + 1];
  Vec3 p{rail_.origin.x + x, rail_.origin.y + (1 - wy) * a.y + wy * b.y + bulge * sag.y,
         rail_.origin.z + (1 - wy) * a.z + wy * b.z + bulge * sag.z};
  const std::ptrdiff_t i0 = rail_.index(c, j), i1 = rail_.index(c + 1, j);
  const int s = rail_.stride;
  auto at = [&](std::ptrdiff_t k) {
    return (1 - wy) * ((1 - wx) * u[i0 + k] + wx * u[i0 + k + 1]) + wy * ((1 - wx) * u[i1 + k] + wx * u[i1 + k + 1]);
  };
  p.x += at(0);
  p.y += at(s);
  p.z += at(2 * s);
  return p;
}

// Index of the station at or before theta, whatever turn it is counted in, and the share of the way to the next one.
int MortarContact::wheel_station(double theta, double& weight) const {
  const auto& at = wheel_.stations.at;
  if (!std::isfinite(theta)) return weight = 0, 0;  // require_sound ends such a run
  theta -= kPeriod * std::floor((theta - at.front()) / kPeriod);
  const int j = std::max(static_cast<int>(std::upper_bound(at.begin(), at.end(), theta) - at.begin()) - 1,
                         0);  // round-off may leave theta below the first station
  const double next = j + 1 < static_cast<int>(at.size()) ? at[j + 1] : at.front() + kPeriod;
  weight = (theta - at[j]) / (next - at[j]);
  return j;
}

// The wheel's facet on the radius through a point at `arm` from the moved axle.
MortarContact::Hit MortarContact::facet_below(const AxlePose& pose, Vec3 arm, Tangential correction) const {
  Hit h{};
  const double radius = std::sqrt(arm.x * arm.x + arm.z * arm.z);
  const double theta = std::atan2(arm.x, -arm.z) + pose.psi - correction.x / radius;
  h.station = wheel_station(theta, h.weight_t);
  const double y = arm.y - correction.y;
  const auto above =
      std::upper_bound(wheel_.node.begin(), wheel_.node.end(), y, [](double v, Vec2 n) { return v < n.y; });
  h.column = static_cast<int>(above - wheel_.node.begin()) - 1;
  h.inside = h.column >= 1 && h.column < wheel_.columns - 2;
  h.column = std::clamp(h.column, 0, wheel_.columns - 2);
  const Vec2 a = wheel_.node[h.column], b = wheel_.node[h.column + 1];
  h.weight_y = (y - a.y) / (b.y - a.y);
  return h;
}

// The exact undeformed point, turned and moved with the axle, plus what the nodal displacements add to the rigid motion
// of the chord between the nodes.
Vec3 MortarContact::wheel_point(const Field& u, const AxlePose& pose, const Hit& h) const {
  const Vec2 a = wheel_.node[h.column], b = wheel_.node[h.column + 1], sag = wheel_.sagitta[h.column];
  const int next = next_wheel_station(h.station);
  const double t0 = wheel_.stations.at[h.station],
               t1 = next ? wheel_.stations.at[next] : wheel_.stations.at[0] + kPeriod;
  const double wy = h.weight_y, wt = h.weight_t, bulge = 4 * wy * (1 - wy);
  const Vec2 section{(1 - wy) * a.y + wy * b.y + bulge * sag.y, (1 - wy) * a.z + wy * b.z + bulge * sag.z};
  const double angle = t0 + wt * (t1 - t0) - pose.psi;
  Vec3 x{wheel_.origin.x - section.z * std::sin(angle), wheel_.origin.y + section.y,
         wheel_.origin.z + section.z * std::cos(angle)};
  const double weights[4] = {(1 - wy) * (1 - wt), wy * (1 - wt), (1 - wy) * wt, wy * wt};
  PlaneVector<double> chord;  // of the interpolated undeformed nodes, from the axle
  for (int n = 0; n < 4; ++n) {
    const int c = h.column + n % 2, j = n < 2 ? h.station : next;
    const double wz = weights[n] * wheel_.node[c].z;
    chord.x -= wz * sin_t_[j];
    chord.z += wz * cos_t_[j];
    const std::ptrdiff_t i = wheel_.index(c, j);
    x += weights[n] * Vec3{u[i], u[i + wheel_.stride], u[i + 2 * wheel_.stride]};
  }
  const PlaneVector<double> turned = turned_.forward(chord.x, chord.z);
  x.x += chord.x - turned.x;
  x.z += chord.z - turned.z;
  return x;
}

Vec3 MortarContact::in_wheel_axes(Vec3 point) const {
  if (wheel_.yaw.s == 0) return point;
  return wheel_.origin + yaw_back(wheel_.yaw, point - wheel_.origin);
}

AxlePose MortarContact::in_wheel_axes(AxlePose pose) const {
  const Vec3 travel = yaw_back(wheel_.yaw, {pose.x, pose.y, pose.z});
  return {travel.x, travel.y, travel.z, pose.psi};
}

// The wheel's surface opposite a point of the rail, all in the wheel's axes. The correction takes off the tangential
// mismatch that the radial projection had the last time.
MortarContact::Hit MortarContact::opposite(const Field& u, const AxlePose& pose, Vec3 p, Tangential correction) const {
  const Vec3 arm{p.x - wheel_.origin.x - pose.x, p.y - wheel_.origin.y - pose.y, p.z - wheel_.origin.z - pose.z};
  Hit h = facet_below(pose, arm, correction);
  h.offset = wheel_point(u, pose, h) - p;
  return h;
}

Vec3 MortarContact::gauss_point(const Field& u_rail, const Facet& facet, int g) const {
  return in_wheel_axes(rail_point(u_rail, facet.column, facet.station, kPoint[g % 2], kPoint[g / 2]));
}

void MortarContact::move_window(double centre, double half_length) {
  const auto& at = rail_.stations.at;
  window_first_ = static_cast<int>(std::lower_bound(at.begin(), at.end(), centre - half_length) - at.begin());
  window_first_ = std::max(window_first_, 1);
  const int window_last =
      std::min(static_cast<int>(std::upper_bound(at.begin(), at.end(), centre + half_length) - at.begin()),
               static_cast<int>(at.size()) - 1);
  window_stations_ = std::max(window_last - window_first_, 0);
}

// Memory for all nodes of the window, so that nothing grows while the patch moves on.
void MortarContact::reserve_window() {
  constexpr std::size_t kWeights = 16;  // of a row, if the wheel's facets are no smaller than the rail's
  const auto stations = static_cast<std::size_t>(window_stations_) + 2,
             columns = static_cast<std::size_t>(rail_.columns);
  if (stations * columns <= near_.capacity()) return;
  const std::size_t nodes = (stations + 2) * columns;  // a window of one length covers now a station more, now one less
  for (auto* flags : {&near_, &edge_}) flags->reserve(nodes);
  for (auto* indices : {&chosen_column_, &chosen_station_, &facet_of_}) indices->reserve(nodes);
  for (auto* facets : {&facets_, &before_}) facets->reserve(nodes);
  hits_.reserve(nodes);
  result_.rows.reserve(nodes);
  result_.weights.reserve(kWeights * nodes);
}

void MortarContact::test_nodes(const Field& u_rail, const Field& u_wheel, const AxlePose& pose, double gap_limit) {
  near_.assign(static_cast<std::size_t>(inner_columns_) * window_stations_, 0);
  edge_.assign(near_.size(), 0);
  for_each(window_stations_, [&](std::ptrdiff_t w) {
    const int j = window_first_ + static_cast<int>(w);
    for (int c = 1; c <= inner_columns_; ++c) {
      const Vec3 p = in_wheel_axes(rail_point(u_rail, c, j, 0, 0));
      const Vec3 normal = yaw_back(wheel_.yaw, {0, rail_.outward[c].y, rail_.outward[c].z});
      Hit h = opposite(u_wheel, pose, p, {});
      h = opposite(u_wheel, pose, p, {h.offset.x, h.offset.y});
      const double gap = dot(normal, h.offset);
      const std::size_t k = static_cast<std::size_t>(w) * inner_columns_ + (c - 1);
      near_[k] = gap < gap_limit && h.inside;
      edge_[k] = gap < 0 && (!h.inside || c == 1 || c == inner_columns_ || w == 0 || w == window_stations_ - 1);
    }
  });
  result_.reached_edge = std::any_of(edge_.begin(), edge_.end(), [](char e) { return e; });
}

int& MortarContact::facet_index(int column, int station) {
  const int w = station - window_first_ + 1;
  assert(column >= 0 && column < rail_.columns);
  assert(w >= 0 && w < window_stations_ + 2);
  return facet_of_[static_cast<std::size_t>(w) * rail_.columns + column];
}

MortarContact::FacetsAroundNode MortarContact::facets_around(int c, int j) {
  return {facet_index(c - 1, j - 1), facet_index(c, j - 1), facet_index(c - 1, j), facet_index(c, j)};
}

void MortarContact::choose_nodes() {
  chosen_column_.clear();
  chosen_station_.clear();
  facets_.clear();
  facet_of_.assign(static_cast<std::size_t>(rail_.columns) * (window_stations_ + 2), -1);
  for (int w = 0; w < window_stations_; ++w)
    for (int c = 1; c <= inner_columns_; ++c) {
      if (!near_[static_cast<std::size_t>(w) * inner_columns_ + (c - 1)]) continue;
      const int j = window_first_ + w;
      chosen_column_.push_back(c);
      chosen_station_.push_back(j);
      for (int dj = -1; dj <= 0; ++dj)
        for (int dc = -1; dc <= 0; ++dc)
          if (int& f = facet_index(c + dc, j + dj); f < 0) {
            f = static_cast<int>(facets_.size());
            facets_.push_back({c + dc, j + dj, {}});
          }
    }
}

// Facets that the search before has seen go on with their corrections.
void MortarContact::keep_corrections() {
  for (const Facet& old : before_) {
    const int w = old.station - window_first_ + 1;
    if (w < 0 || w >= window_stations_ + 2) continue;
    if (const int f = facet_index(old.column, old.station); f >= 0)
      std::copy(old.correction, old.correction + 4, facets_[f].correction);
  }
}

// The others start with the mismatch of the radial projection.
void MortarContact::start_corrections(const Field& u_rail, const Field& u_wheel, const AxlePose& pose) {
  for_each(static_cast<std::ptrdiff_t>(facets_.size()), [&](std::ptrdiff_t f) {
    for (int g = 0; g < 4; ++g) {
      Tangential& correction = facets_[f].correction[g];
      if (correction.x != 0 || correction.y != 0) continue;
      const Hit h = opposite(u_wheel, pose, gauss_point(u_rail, facets_[f], g), {});
      correction = {h.offset.x, h.offset.y};
    }
  });
}

void MortarContact::search(const Field& u_rail, const Field& u_wheel, const AxlePose& in_model, double half_length,
                           double gap_limit) {
  const AxlePose pose = in_wheel_axes(in_model);
  turned_ = rotation_by(pose.psi);
  move_window(wheel_.origin.x + in_model.x - rail_.origin.x, half_length);
  reserve_window();
  test_nodes(u_rail, u_wheel, pose, gap_limit);
  std::swap(before_, facets_);
  choose_nodes();
  keep_corrections();
  start_corrections(u_rail, u_wheel, pose);
}

void MortarContact::update_hits(const Field& u_rail, const Field& u_wheel, const AxlePose& pose) {
  hits_.resize(facets_.size());
  for_each(static_cast<std::ptrdiff_t>(facets_.size()), [&](std::ptrdiff_t f) {
    Facet& facet = facets_[f];
    for (int g = 0; g < 4; ++g) {
      Hit& h = hits_[f][g];
      h = opposite(u_wheel, pose, gauss_point(u_rail, facet, g), facet.correction[g]);
      facet.correction[g] = facet.correction[g] + Tangential{h.offset.x, h.offset.y};
    }
  });
}

// Signed number of stations from `anchor` the shorter way round.
int MortarContact::stations_from(int anchor, int station) const {
  const int ring = wheel_.stations.nodes();
  int d = station - anchor;
  if (d > ring / 2) d -= ring;
  if (d < -ring / 2) d += ring;
  return d;
}

MortarContact::WheelPatch MortarContact::wheel_patch(const FacetsAroundNode& around) const {
  const int anchor = hits_[around[0]][0].station;
  int column_lo = std::numeric_limits<int>::max(), column_hi = -1, lo = 0, hi = 0;
  for (int f : around)
    for (const Hit& h : hits_[f]) {
      const int station = stations_from(anchor, h.station);
      column_lo = std::min(column_lo, h.column);
      column_hi = std::max(column_hi, h.column + 1);
      lo = std::min(lo, station);
      hi = std::max(hi, station + 1);
    }
  return {column_lo, column_hi - column_lo + 1, anchor, lo, hi - lo + 1};
}

// Area and gap of a row, and a_A m_AW of the wheel nodes in its patch.
void MortarContact::integrate(const FacetsAroundNode& around, const WheelPatch& patch, ContactRow& row) {
  const int nc = patch.columns;
  sum_.assign(static_cast<std::size_t>(nc) * patch.stations, 0.0);
  double area = 0, gap = 0;
  for (int q = 0; q < 4; ++q) {
    const int side_y = q % 2 ? 0 : 1, side_x = q / 2 ? 0 : 1;  // which corner of the facet the node is
    const Facet& facet = facets_[around[q]];
    const double facet_area =
        rail_.width[facet.column] * (rail_.stations.at[facet.station + 1] - rail_.stations.at[facet.station]);
    for (int g = 0; g < 4; ++g) {
      const Hit& h = hits_[around[q]][g];
      const double ty = kPoint[g % 2], tx = kPoint[g / 2];
      const double weight = 0.25 * facet_area * dual(side_y, ty) * dual(side_x, tx);
      area += 0.25 * facet_area * shape(side_y, ty) * shape(side_x, tx);
      gap += weight * dot(h.offset, row.on_wheel);
      const int station = stations_from(patch.anchor, h.station) - patch.first, column = h.column - patch.column;
      assert(station >= 0 && station + 1 < patch.stations);
      assert(column >= 0 && column + 1 < nc);
      double* at = &sum_[static_cast<std::size_t>(station) * nc + column];
      at[0] += weight * (1 - h.weight_y) * (1 - h.weight_t);
      at[1] += weight * h.weight_y * (1 - h.weight_t);
      at[nc] += weight * (1 - h.weight_y) * h.weight_t;
      at[nc + 1] += weight * h.weight_y * h.weight_t;
    }
  }
  row.area = area;
  row.gap = gap / area;
}

void MortarContact::append_weights(const WheelPatch& patch, double area) {
  const int ring = wheel_.stations.nodes();
  for (int t = 0; t < patch.stations; ++t) {
    const int station = ((patch.anchor + patch.first + t) % ring + ring) % ring;
    for (int n = 0; n < patch.columns; ++n)
      if (const double m = sum_[static_cast<std::size_t>(t) * patch.columns + n]; m != 0)
        result_.weights.push_back({wheel_.index(patch.column + n, station), m / area});
  }
}

const MortarRows& MortarContact::rows(const Field& u_rail, const Field& u_wheel, const AxlePose& in_model) {
  const AxlePose pose = in_wheel_axes(in_model);
  turned_ = rotation_by(pose.psi);
  update_hits(u_rail, u_wheel, pose);
  result_.rows.clear();
  result_.weights.clear();
  for (std::size_t r = 0; r < chosen_column_.size(); ++r) {
    const int c = chosen_column_[r], j = chosen_station_[r];
    ContactRow row{};
    row.column = c;
    row.station = j;
    row.rail = rail_.index(c, j);
    row.first = static_cast<int>(result_.weights.size());
    row.normal = {0, rail_.outward[c].y, rail_.outward[c].z};
    row.on_wheel = yaw_back(wheel_.yaw, row.normal);
    const FacetsAroundNode around = facets_around(c, j);
    const WheelPatch patch = wheel_patch(around);
    integrate(around, patch, row);
    append_weights(patch, row.area);
    row.count = static_cast<int>(result_.weights.size()) - row.first;
    result_.rows.push_back(row);
  }
  return result_;
}

}  // namespace railstrata
