#include "contact/mortar.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/parallel.hpp"

namespace railstrata {

using namespace mortar_law;

namespace {

// Displacements of a surface's nodes.
struct SurfaceField {
  const Field& u;
  const ContactSurface& surface;
  Vec3 operator()(int column, int station) const {
    const std::ptrdiff_t i = surface.index(column, station);
    return {u[i], u[i + surface.stride], u[i + 2 * surface.stride]};
  }
};

void find_angles(const ContactSurface& surface, std::vector<double>& sine, std::vector<double>& cosine) {
  for (double t : surface.stations.at) {
    sine.push_back(std::sin(t));
    cosine.push_back(std::cos(t));
  }
}

}  // namespace

MortarContact::MortarContact(ContactSurface rail, ContactSurface wheel)
    : rail_(std::move(rail)),
      wheel_(std::move(wheel)),
      inner_columns_(rail_.columns - 2),
      apart_(independent_distance(rail_, wheel_)) {
  find_angles(wheel_, wheel_turn_.sin, wheel_turn_.cos);
  if (!rail_.rises) return;
  find_angles(rail_, rail_turn_.sin, rail_turn_.cos);
  for (int c = 0; c + 1 < rail_.columns; ++c) rail_.width[c] *= 0.5 * std::abs(rail_.node[c].z + rail_.node[c + 1].z);
}

// The ring is met as the wheel is, about its own axle.
Vec3 MortarContact::rail_point(const Field& u, int c, int j, double wy, double wx) const {
  if (rail_.rises)
    return in_wheel_axes(
        wheel_,
        wheel_point(rail_, rail_turn_.sin, rail_turn_.cos, SurfaceField{u, rail_}, {0, 0, 0, rail_turn_.psi},
                    rail_turn_.by,
                    Hit{.column = c, .station = j, .weight_y = wy, .weight_t = wx, .offset = {}, .inside = true}));
  const Vec3 p = mortar_law::rail_point(rail_, SurfaceField{u, rail_}, c, j, wy, wx);
  if (rail_.heights.none()) return in_wheel_axes(wheel_, p);
  const double z = rail_height(c, j, wy, wx).z;
  const Vec2 n = (1 - wy) * rail_.outward[c] + wy * rail_.outward[c + 1];
  return in_wheel_axes(wheel_, p + Vec3{0, z * n.y, z * n.z});
}

// Of a material point: it stays where the rail is meshed.
SurfaceHeight MortarContact::rail_height(int c, int j, double wy, double wx) const {
  const auto& at = rail_.stations.at;
  const double next = wx > 0 ? at[j + 1] : at[j], y = (1 - wy) * rail_.node[c].y + wy * rail_.node[c + 1].y;
  return rail_.heights.at(rail_.origin.x + (1 - wx) * at[j] + wx * next - wheel_.origin.x,
                          rail_.origin.y + y - rail_.first_contact_y);
}

// The wheel's surface lies higher by what its arc has there.
void MortarContact::raise_wheel(const AxlePose& pose, Hit& h) const {
  const auto& at = wheel_.stations.at;
  const int next = h.station + 1 < wheel_.stations.nodes() ? h.station + 1 : 0;
  const double end = next ? at[next] : at[0] + kPeriod, theta = at[h.station] + h.weight_t * (end - at[h.station]);
  const Vec2 a = wheel_.node[h.column], b = wheel_.node[h.column + 1], n = wheel_.outward[h.column];
  const double y = wheel_.origin.y + (1 - h.weight_y) * a.y + h.weight_y * b.y;
  const double z = wheel_.heights.at(wheel_.radius * theta, y - wheel_.first_contact_y).z;
  const Rotation<double> turn = turn_of(theta - pose.psi);
  h.offset += z * Vec3{-n.z * turn.s, n.y, n.z * turn.c};
}

Vec3 MortarContact::rail_normal(int c, int j) const {
  const double along = rail_.rises ? rail_.radius * (rail_.contact_at + rail_turn_.psi - rail_.stations.at[j]) : 0.0;
  const Vec3 normal = rail_.rail_normal(c, along);
  if (rail_.heights.none()) return normal;
  const Vec3 tilted = normal - Vec3{rail_height(c, j, 0, 0).along, 0, 0};
  return (1 / std::sqrt(dot(tilted, tilted))) * tilted;
}

void MortarContact::turn_to(const AxlePose& pose) {
  wheel_turn_.by = rotation_by(pose.psi);
  rail_turn_.psi = pose.rail_psi;
  rail_turn_.by = rotation_by(rail_turn_.psi);
}

MortarContact::Hit MortarContact::opposite(const Field& u, const AxlePose& pose, Vec3 p, Tangential correction,
                                           const Hit& guess) const {
  Hit h = mortar_law::opposite(wheel_, wheel_turn_.sin, wheel_turn_.cos, SurfaceField{u, wheel_}, pose, wheel_turn_.by,
                               p, correction, guess);
  if (!wheel_.heights.none()) raise_wheel(pose, h);
  return h;
}

Vec3 MortarContact::gauss_point(const Field& u_rail, const Facet& facet, int g) const {
  return rail_point(u_rail, facet.column, facet.station, gauss(g % 2), gauss(g / 2));
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
  patches_.reserve(nodes);
  sum_.reserve(kWeights * nodes);
}

void MortarContact::test_nodes(const Field& u_rail, const Field& u_wheel, const AxlePose& pose, double gap_limit) {
  near_.assign(static_cast<std::size_t>(inner_columns_) * window_stations_, 0);
  edge_.assign(near_.size(), 0);
  for_each(window_stations_, [&](std::ptrdiff_t w) {
    const int j = window_first_ + static_cast<int>(w);
    for (int c = 1; c <= inner_columns_; ++c) {
      const Vec3 p = rail_point(u_rail, c, j, 0, 0);
      const Vec3 normal = yaw_back(wheel_.yaw, rail_normal(c, j));
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

std::size_t MortarContact::facet_at(int column, int station) const {
  const int w = station - window_first_ + 1;
  assert(column >= 0 && column < rail_.columns);
  assert(w >= 0 && w < window_stations_ + 2);
  return static_cast<std::size_t>(w) * rail_.columns + column;
}

void MortarContact::choose_node(int c, int j) {
  chosen_column_.push_back(c);
  chosen_station_.push_back(j);
  for (int dj = -1; dj <= 0; ++dj)
    for (int dc = -1; dc <= 0; ++dc)
      if (int& f = facet_of_[facet_at(c + dc, j + dj)]; f < 0) {
        f = static_cast<int>(facets_.size());
        facets_.push_back({c + dc, j + dj, {}});
      }
}

void MortarContact::choose_nodes() {
  chosen_column_.clear();
  chosen_station_.clear();
  facets_.clear();
  facet_of_.assign(static_cast<std::size_t>(rail_.columns) * (window_stations_ + 2), -1);
  const auto first_of = [&](int group, int least) { return least + ((group - least) % apart_ + apart_) % apart_; };
  for (int along = 0; along < apart_; ++along)
    for (int across = 0; across < apart_; ++across)
      for (int j = first_of(along, window_first_); j < window_first_ + window_stations_; j += apart_)
        for (int c = first_of(across, 1); c <= inner_columns_; c += apart_)
          if (near_[static_cast<std::size_t>(j - window_first_) * inner_columns_ + (c - 1)]) choose_node(c, j);
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
  const AxlePose pose = in_wheel_axes(wheel_, in_model);
  turn_to(pose);
  const double centre = rail_.rises ? rail_.contact_at + rail_turn_.psi : wheel_.origin.x + in_model.x - rail_.origin.x;
  const Window window = window_around(rail_, centre, half_length / rail_.radius);
  window_first_ = window.first;
  window_stations_ = window.stations;
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
      h = opposite(u_wheel, pose, gauss_point(u_rail, facet, g), facet.correction[g], h);
      facet.correction[g] = facet.correction[g] + Tangential{h.offset.x, h.offset.y};
    }
  });
}

std::array<int, 4> MortarContact::facets_around(int c, int j) const {
  return {facet_index(c - 1, j - 1), facet_index(c, j - 1), facet_index(c - 1, j), facet_index(c, j)};
}

void MortarContact::integrate_row(std::size_t r) {
  ContactRow& row = result_.rows[r];
  row.normal = rail_normal(row.column, row.station);
  row.on_wheel = yaw_back(wheel_.yaw, row.normal);
  const std::array<int, 4> around = facets_around(row.column, row.station);
  const auto hit = [&](int q, int g) -> const Hit& { return hits_[around[q]][g]; };
  double* const sum = &sum_[patches_[r].first_sum];
  std::fill(sum, sum + patches_[r].on.nodes(), 0.0);
  const auto add = [&](int k, double weight) { sum[k] += weight; };
  const RowMeasure measured =
      integrate(rail_, row.column, row.station, hit, patches_[r].on, wheel_.stations.nodes(), row.on_wheel, add);
  row.area = measured.area;
  row.gap = measured.gap;
}

void MortarContact::append_weights(std::size_t r) {
  ContactRow& row = result_.rows[r];
  row.first = static_cast<int>(result_.weights.size());
  const WheelPatch& patch = patches_[r].on;
  const int ring = wheel_.stations.nodes();
  const double* sum = &sum_[patches_[r].first_sum];
  for (int t = 0; t < patch.stations; ++t) {
    const int station = ((patch.anchor + patch.first + t) % ring + ring) % ring;
    for (int n = 0; n < patch.columns; ++n, ++sum)
      if (*sum != 0) result_.weights.push_back({wheel_.index(patch.column + n, station), *sum / row.area});
  }
  row.count = static_cast<int>(result_.weights.size()) - row.first;
}

const MortarRows& MortarContact::rows(const Field& u_rail, const Field& u_wheel, const AxlePose& in_model) {
  const AxlePose pose = in_wheel_axes(wheel_, in_model);
  turn_to(pose);
  update_hits(u_rail, u_wheel, pose);
  result_.rows.clear();
  result_.weights.clear();
  patches_.clear();
  std::size_t sums = 0;
  for (std::size_t r = 0; r < chosen_column_.size(); ++r) {
    ContactRow& row = result_.rows.emplace_back();
    row.column = chosen_column_[r];
    row.station = chosen_station_[r];
    row.rail = rail_.index(row.column, row.station);
    const std::array<int, 4> around = facets_around(row.column, row.station);
    const auto hit = [&](int q, int g) -> const Hit& { return hits_[around[q]][g]; };
    patches_.push_back({wheel_patch(hit, wheel_.stations.nodes()), sums});
    sums += patches_.back().on.nodes();
  }
  sum_.resize(sums);
  for_each(static_cast<std::ptrdiff_t>(patches_.size()), [&](std::ptrdiff_t r) { integrate_row(r); });
  for (std::size_t r = 0; r < patches_.size(); ++r) append_weights(r);
  return result_;
}

}  // namespace railstrata
