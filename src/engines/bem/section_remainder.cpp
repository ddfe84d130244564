#include "bem/section_remainder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "bem/wave_quadrature.hpp"
#include "section/section_compliance.hpp"

namespace railstrata {

/// How fine a section is looked at: elements are as wide as its stations.
struct SectionSizes {
  MeshSizes mesh;
  double place = 0;    ///< m, arc length of the middle of the stations
  double largest = 0;  ///< 1/m, of the wave numbers
};

namespace {

constexpr double kStation = 2e-3;  // m, from one to the next of a smooth difference
constexpr double kPlace = kSectionPlace;
constexpr double kOneAlone = 0.25;   // of kPlace: so far on both sides of its middle a section is alone
constexpr double kSmallestWave = 1;  // 1/m, of the wave numbers
constexpr double kLogStep = 0.415;   // from one wave number to the next
constexpr double kFinest = 0.25e-3;  // m, of stations

SectionSizes smooth_sizes(double place, double half_width) {
  const double farthest = (1 - kOneAlone) * kPlace,
               across = kPlace * std::ceil((half_width + kStation + farthest) / kPlace);
  return {{.element = kStation,
           .fine_width = 2 * across,
           .fine_depth = 8e-3,
           .coarse_ratio = 3,
           .largest = 12e-3,
           .to_sides = true},
          place,
          SectionRemainder::kSmoothTo};
}

/// Stations as near as the rows of cells, one of them at the edge; waves down to the length of a cell.
SectionSizes sizes_in_full(double place, double edge, const PatchGrid& grid) {
  const double station = std::max(grid.dy, kFinest);
  const double across = station * std::ceil((0.5 * grid.ny * grid.dy + 2 * station + 0.5 * kPlace) / station);
  return {{.element = station,
           .fine_width = 2 * across,
           .fine_depth = 8 * station,
           .coarse_ratio = 3,
           .largest = 12e-3,
           .to_sides = true},
          edge + station * std::round((place - edge) / station),
          2 * std::numbers::pi / std::max(grid.dx, kFinest)};
}

/// Does the layer's thickness vary between these places of the profile?
bool varies_between(const LayerSpec& layer, double y0, double y1) {
  const double first = over_table(layer.thickness_table, y0);
  const auto other = [&](const TablePoint& p) { return p.at > y0 && p.at < y1 && p.value != first; };
  return over_table(layer.thickness_table, y1) != first ||
         std::any_of(layer.thickness_table.begin(), layer.thickness_table.end(), other);
}

/// Arc length of the nearest side of a layer within the reach of the stations; the place itself where none is but the
/// thickness of a layer varies below them.
std::optional<double> nearest_side(const CaseSpec& spec, const Profile& profile, BodyId body, double place,
                                   double reach) {
  std::optional<double> nearest;
  bool varies = false;
  const auto y_at = [&](double s) { return profile.at(std::clamp(s, profile.s_min(), profile.s_max())).position.y; };
  for (const LayerSpec& layer : spec.layers) {
    if (layer.on != body) continue;
    varies = varies || varies_between(layer, y_at(place - reach), y_at(place + reach));
    for (const double y : {layer.low(), layer.high()}) {
      if (y <= profile.y_min() || y >= profile.y_max()) continue;
      const double s = profile.s_at_y(y), distance = std::abs(s - place);
      if (distance < (nearest ? std::abs(*nearest - place) : reach)) nearest = s;
    }
  }
  return nearest || !varies ? nearest : place;
}

/// What the section depends on: the case's numbers, and the profile by its points.
std::vector<double> key_of(const CaseSpec& spec, const Placement& placement, BodyId body,
                           const LayeredHalfSpace& half_space, const SectionSizes& sizes) {
  constexpr int kPoints = 400;
  const bool wheel = body == BodyId::wheel;
  const Profile& profile = wheel ? placement.wheel : placement.rail;
  const GeometrySpec& g = spec.geometry;
  const MaterialSpec& m = wheel ? spec.wheel_material : spec.rail_material;
  std::vector<double> key{static_cast<double>(wheel),
                          sizes.place,
                          sizes.mesh.element,
                          sizes.mesh.fine_width,
                          sizes.largest,
                          m.young,
                          m.poisson};
  if (wheel) {
    const WheelSection& w = g.wheel_section;
    key.insert(key.end(), {static_cast<double>(g.wheel_shape), g.wheel_radius, w.rim_thickness, w.web_thickness,
                           w.web_offset, w.hub_radius, w.hub_width, w.bore_radius});
  } else {
    key.insert(key.end(), {static_cast<double>(g.rail_shape), static_cast<double>(section_below_head(g, profile)),
                           g.cant, g.block_width, g.block_height});
  }
  for (const HalfSpaceLayer& layer : half_space.layers) key.push_back(layer.thickness);
  for (const LayerSpec& layer : spec.layers) {
    if (layer.on != body) continue;
    key.insert(key.end(), {layer.thickness, layer.width, layer.material.young, layer.material.poisson});
    for (const ModulusPoint& point : layer.young_table) key.insert(key.end(), {point.depth, point.young});
    for (const TablePoint& point : layer.thickness_table) key.insert(key.end(), {point.at, point.value});
  }
  for (int i = 0; i <= kPoints; ++i) {
    const double s = profile.s_min() + (profile.s_max() - profile.s_min()) * i / kPoints;
    const Vec2 at = profile.at(std::min(s, profile.s_max())).position;
    key.insert(key.end(), {at.y, at.z});
  }
  return key;
}

std::vector<double> wave_numbers(double largest) {
  const int last = static_cast<int>(std::ceil(std::log(largest / kSmallestWave) / kLogStep));
  std::vector<double> k;
  for (int i = 0; i <= last; ++i) k.push_back(kSmallestWave * std::pow(largest / kSmallestWave, 1.0 * i / last));
  return k;
}

/// Index 3 m + direction as direction * stations + m.
Eigen::MatrixXd by_direction(const Eigen::MatrixXd& by_station) {
  const Eigen::Index n = by_station.rows() / 3;
  Eigen::MatrixXd out(3 * n, 3 * n);
  for (Eigen::Index a = 0; a < 3; ++a)
    for (Eigen::Index b = 0; b < 3; ++b)
      out.block(a * n, b * n, n, n) = by_station(Eigen::seqN(a, n, 3), Eigen::seqN(b, n, 3));
  return out;
}

std::shared_ptr<const SectionRemainder> remainder_of(const CaseSpec& spec, const Placement& placement, BodyId body,
                                                     const LayeredHalfSpace& half_space, const SectionSizes& sizes) {
  const bool wheel = body == BodyId::wheel;
  const MeshedSection meshed = meshed_section(spec, placement, body, sizes.place, sizes.mesh);
  SectionRemainder out;
  out.radius = wheel ? spec.geometry.wheel_radius - placement.wheel.at(sizes.place).position.z : 0;
  out.in_full = sizes.largest > SectionRemainder::kSmoothTo;
  const std::vector<double> k = wave_numbers(sizes.largest);
  const QuadraticSection mesh = quadratic_section(meshed.body);
  SectionCompliance section = section_compliance(mesh, section_stiffness(mesh, meshed.materials, out.radius), 1, k);
  out.half_space =
      half_space_compliance(half_space, wheel, section.spacing, static_cast<int>(section.stations.size()), k);
  out.own = std::move(section.at);
  out.stations = std::move(section.stations);
  out.by_rotation = std::move(section.by_rotation);
  out.k = k;
  for (auto* of : {&out.own, &out.half_space})
    for (Eigen::MatrixXd& at : *of) at = by_direction(at);
  return std::make_shared<const SectionRemainder>(std::move(out));
}

std::vector<Eigen::MatrixXd> without_limit(std::vector<Eigen::MatrixXd> values, Eigen::MatrixXd limit) {
  const Eigen::Index n = limit.rows() / 3;
  limit.topRightCorner(n, 2 * n).setZero();
  limit.bottomLeftCorner(2 * n, n).setZero();
  for (Eigen::MatrixXd& value : values) value -= limit;
  return values;
}

}  // namespace

std::shared_ptr<const SectionRemainder::AtWaves> SectionRemainder::at(const std::vector<double>& waves) const {
  constexpr std::size_t kMost = 8;
  const std::lock_guard lock(kept_->mutex);
  for (const auto& one : kept_->all)
    if (one->k == waves) return one;
  if (kept_->all.size() == kMost) kept_->all.erase(kept_->all.begin());
  kept_->all.push_back(
      std::make_shared<const AtWaves>(AtWaves{waves, without_limit(at_waves(own, k, waves), own.back()),
                                              without_limit(at_waves(half_space, k, waves), half_space.back())}));
  return kept_->all.back();
}

std::shared_ptr<const SectionRemainder> SectionStore::at(const CaseSpec& spec, const Placement& placement, BodyId body,
                                                         const LayeredHalfSpace& half_space,
                                                         const SectionSizes& sizes) {
  constexpr std::size_t kEntries = 64;
  std::vector<double> key = key_of(spec, placement, body, half_space, sizes);
  const std::lock_guard lock(mutex_);
  for (const Entry& entry : entries_)
    if (entry.key == key) return entry.remainder;
  if (entries_.size() == kEntries) entries_.erase(entries_.begin());
  auto made = remainder_of(spec, placement, body, half_space, sizes);
  entries_.push_back({std::move(key), made});
  return made;
}

std::vector<RemainderShare> SectionStore::get(const CaseSpec& spec, const Placement& placement, BodyId body,
                                              const LayeredHalfSpace& half_space, const PatchGrid& grid) {
  const bool wheel = body == BodyId::wheel;
  const Profile& profile = wheel ? placement.wheel : placement.rail;
  const double places = (wheel ? placement.contact.wheel_s : placement.contact.rail_s) / kPlace,
               half_width = 0.5 * grid.ny * grid.dy, nearest = kPlace * std::round(places);
  const double reach = 0.5 * smooth_sizes(nearest, half_width).mesh.fine_width;
  if (const auto side = nearest_side(spec, profile, body, nearest, reach))
    return {{at(spec, placement, body, half_space, sizes_in_full(nearest, *side, grid)), 1}};
  const double before = std::floor(places);
  const double further = std::clamp((places - before - kOneAlone) / (1 - 2 * kOneAlone), 0.0, 1.0);
  std::vector<RemainderShare> out;
  for (const auto& [step, share] : {std::pair{0.0, 1 - further}, std::pair{1.0, further}}) {
    if (!(share > 0)) continue;
    const double place = std::clamp(kPlace * (before + step), profile.s_min(), profile.s_max());
    out.push_back({at(spec, placement, body, half_space, smooth_sizes(place, half_width)), share});
  }
  return out;
}

}  // namespace railstrata
