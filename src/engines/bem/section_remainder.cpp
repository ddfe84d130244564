#include "bem/section_remainder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "bem/wave_quadrature.hpp"
#include "core/faults.hpp"
#include "geometry/profile_names.hpp"
#include "section/section_compliance.hpp"

namespace railstrata {

namespace {

/// How fine a section is looked at: elements are as wide as its stations.
struct SectionSizes {
  MeshSizes mesh;
  double place = 0;    ///< m, arc length of the middle of the stations
  double largest = 0;  ///< 1/m, of the wave numbers
};

constexpr double kStation = 2e-3;  // m, from one to the next of a smooth difference
constexpr double kPlace = kSectionPlace;
constexpr double kOneAlone = 0.25;         // of kPlace: so far on both sides of its middle a section is alone
constexpr double kSmallestWave = 1;        // 1/m, of the wave numbers of a body that is held
constexpr double kBelowBending = 0.1;      // smallest wave number over (K/(E I))^1/4 of a rail on springs
constexpr double kHeavyRail = 5e-5;        // m^4, I of the heaviest rails: of others the waves reach further down
constexpr double kLogStep = 0.415;         // from one wave number to the next
constexpr double kDepthBelow = 16e-3;      // m, to which states are asked for
constexpr double kFullDepthBelow = 8e-3;   // m, the same in full
constexpr double kFinestBelow = 0.5e-3;    // m, of stations for them
constexpr double kLargestOfBlock = 60e-3;  // m, of its elements
constexpr double kFinest = 0.25e-3;        // m, of stations

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
SectionSizes sizes_in_full(double place, double edge, const PatchGrid& grid, double finest) {
  const double station = std::max(grid.dy, finest);
  const double across = station * std::ceil((0.5 * grid.ny * grid.dy + 2 * station + 0.5 * kPlace) / station);
  return {{.element = station,
           .fine_width = 2 * across,
           .fine_depth = 8 * station,
           .coarse_ratio = 3,
           .largest = 12e-3,
           .to_sides = true},
          edge + station * std::round((place - edge) / station),
          2 * std::numbers::pi / std::max(grid.dx, finest)};
}

/// Does the layer's thickness vary between these places of the profile?
bool varies_between(const LayerSpec& layer, double y0, double y1) {
  const double first = over_table(layer.thickness_table, y0);
  const auto other = [&](const TablePoint& p) { return p.at > y0 && p.at < y1 && p.value != first; };
  return over_table(layer.thickness_table, y1) != first ||
         std::any_of(layer.thickness_table.begin(), layer.thickness_table.end(), other);
}

/// Arc length of the nearest side of a layer or of a block within the reach of the stations; the place itself where
/// none is but the thickness of a layer varies below them.
std::optional<double> nearest_side(const CaseSpec& spec, const Profile& profile, BodyId body, double place,
                                   double reach) {
  std::optional<double> nearest;
  bool varies = false;
  const auto y_at = [&](double s) { return profile.at(std::clamp(s, profile.s_min(), profile.s_max())).position.y; };
  const auto offer = [&](double y) {
    if (y <= profile.y_min() || y >= profile.y_max()) return;
    const double s = profile.s_at_y(y), distance = std::abs(s - place);
    if (distance < (nearest ? std::abs(*nearest - place) : reach)) nearest = s;
  };
  for (const LayerSpec& layer : spec.layers) {
    if (layer.on != body) continue;
    varies = varies || varies_between(layer, y_at(place - reach), y_at(place + reach));
    offer(layer.low());
    offer(layer.high());
  }
  if (body == BodyId::rail && spec.geometry.rail_shape == RailShape::block)
    for (const double side : {-0.5, 0.5}) offer(side * spec.geometry.block_width);
  return nearest || !varies ? nearest : place;
}

/// Pads and ballast as a continuous support.
RailSupport support_of(const SleeperTrack& t) {
  return {t.pad_stiffness / t.spacing, t.pad_shear * t.pad_stiffness / t.spacing, t.ballast_stiffness / t.spacing};
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
                          m.poisson,
                          m.density};
  if (wheel) {
    const WheelSection& w = g.wheel_section;
    key.insert(key.end(), {static_cast<double>(g.wheel_shape), g.wheel_radius, w.rim_thickness, w.web_thickness,
                           w.web_offset, w.hub_radius, w.hub_width, w.bore_radius});
  } else {
    key.insert(key.end(), {static_cast<double>(g.rail_shape), static_cast<double>(section_below_head(g, profile)),
                           g.cant, g.block_width, g.block_height});
    const RailSupport on = support_of(spec.track.support);
    if (!spec.track.held()) key.insert(key.end(), {on.pad, on.pad_across, on.ballast});
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

/// Down to where a rail on springs K sinks as a rigid one: bending adds E I k^4 to K.
double smallest_wave(const CaseSpec& spec, BodyId body) {
  if (body == BodyId::wheel || spec.track.held()) return kSmallestWave;
  const double bending = spec.rail_material.young * kHeavyRail;
  return std::min(kSmallestWave, kBelowBending * std::pow(support_of(spec.track.support).vertical() / bending, 0.25));
}

/// Of a rail on springs at half the steps: its bending falls with k^4.
std::vector<double> wave_numbers(double smallest, double largest) {
  const double step = smallest < kSmallestWave ? 0.5 * kLogStep : kLogStep;
  const int last = static_cast<int>(std::ceil(std::log(largest / smallest) / step));
  std::vector<double> k;
  for (int i = 0; i <= last; ++i) k.push_back(smallest * std::pow(largest / smallest, 1.0 * i / last));
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

struct PlacedSizes {
  SectionSizes sizes;
  double share = 1;
};

/// The kept places on both sides of the contact; one where a layer ends or varies nearby.
std::vector<PlacedSizes> places_of(const CaseSpec& spec, const Placement& placement, BodyId body, const PatchGrid& grid,
                                   double finest) {
  const bool wheel = body == BodyId::wheel;
  const Profile& profile = wheel ? placement.wheel : placement.rail;
  const double places = (wheel ? placement.contact.wheel_s : placement.contact.rail_s) / kPlace,
               half_width = 0.5 * grid.ny * grid.dy, nearest = kPlace * std::round(places);
  const double reach = 0.5 * smooth_sizes(nearest, half_width).mesh.fine_width;
  if (const auto side = nearest_side(spec, profile, body, nearest, reach))
    return {{sizes_in_full(nearest, *side, grid, finest), 1}};
  const double before = std::floor(places);
  const double further = std::clamp((places - before - kOneAlone) / (1 - 2 * kOneAlone), 0.0, 1.0);
  std::vector<PlacedSizes> out;
  for (const auto& [step, share] : {std::pair{0.0, 1 - further}, std::pair{1.0, further}}) {
    if (!(share > 0)) continue;
    const double place = std::clamp(kPlace * (before + step), profile.s_min(), profile.s_max());
    out.push_back({smooth_sizes(place, half_width), share});
  }
  return out;
}

/// Of a wheel's surface at a place; 0: of a rail.
double radius_at(const CaseSpec& spec, const Placement& placement, BodyId body, double place) {
  return body == BodyId::wheel ? spec.geometry.wheel_radius - placement.wheel.at(place).position.z : 0;
}

/// SectionRemainder::stretch_by_load: the strain -k U at x = 0 of u_x = i U e^{ikx} by a force downwards.
double stretch_by_load(MeshedSection rail, const SectionCompliance& on_springs) {
  std::swap(rail.body.on_pads, rail.body.prescribed);
  const QuadraticSection mesh = quadratic_section(rail.body);
  const std::vector<double>& k = on_springs.k;
  const SectionCompliance held = section_compliance(mesh, section_stiffness(mesh, rail.materials, 0), 1, k);
  const auto middle = static_cast<Eigen::Index>(3 * (held.stations.size() / 2));
  std::vector<Eigen::MatrixXd> beyond;
  for (std::size_t i = 0; i < k.size(); ++i)
    beyond.emplace_back((on_springs.at[i] - held.at[i]).block(middle, middle + 2, 1, 1));
  const WaveQuadrature waves(k.front(), k.back(), held.spacing);
  const std::vector<Eigen::MatrixXd> at = at_waves(beyond, k, waves.k);
  double sum = 0;
  for (std::size_t q = 0; q < at.size(); ++q) sum += waves.weight[q] * waves.k[q] * at[q](0, 0);
  return sum / std::numbers::pi;
}

SectionRemainder remainder_of(const CaseSpec& spec, const Placement& placement, BodyId body,
                              const LayeredHalfSpace& half_space, const SectionSizes& sizes) {
  const MeshedSection meshed = meshed_section(spec, placement, body, sizes.place, sizes.mesh);
  SectionRemainder out;
  out.radius = radius_at(spec, placement, body, sizes.place);
  out.in_full = sizes.largest > SectionRemainder::kSmoothTo;
  const std::vector<double> k = wave_numbers(smallest_wave(spec, body), sizes.largest);
  const QuadraticSection mesh = quadratic_section(meshed.body);
  SectionCompliance section = section_compliance(
      mesh, section_stiffness(mesh, meshed.materials, out.radius, support_of(spec.track.support)), 1, k);
  if (!meshed.body.on_pads.empty()) out.stretch_by_load = stretch_by_load(meshed, section);
  out.half_space = half_space_compliance(half_space, body == BodyId::wheel, section.spacing,
                                         static_cast<int>(section.stations.size()), k);
  out.own = std::move(section.at);
  out.stations = std::move(section.stations);
  out.by_rotation = std::move(section.by_rotation);
  out.k = k;
  for (auto* of : {&out.own, &out.half_space})
    for (Eigen::MatrixXd& at : *of) at = by_direction(at);
  return out;
}

SectionInterior interior_on(const MeshedSection& meshed, double radius, const RailSupport& support,
                            const std::vector<double>& k) {
  const QuadraticSection mesh = quadratic_section(meshed.body);
  return section_interior(meshed.body, mesh, section_stiffness(mesh, meshed.materials, radius, support),
                          meshed.materials, radius, k);
}

/// The same layers all over a block under a plane, so large that it is a half-space; in full the same rows of elements,
/// of the substrate alone.
struct LargeBlock {
  CaseSpec spec;
  Placement placement;
};

LargeBlock large_block(const CaseSpec& spec, const Placement& placement, BodyId body, bool in_full, double place) {
  constexpr double kWidth = 2, kHeight = 1;  // m
  const double y = (body == BodyId::wheel ? placement.wheel : placement.rail).at(place).position.y;
  LargeBlock out{in_full ? spec : case_at_contact(spec, placement), placement};
  std::erase_if(out.spec.layers, [body](const LayerSpec& layer) { return layer.on != body; });
  if (body == BodyId::wheel) out.spec.rail_material = spec.wheel_material;
  for (LayerSpec& layer : out.spec.layers) {
    layer.on = BodyId::rail;
    layer.width = kWidth;
    if (!in_full) {
      layer.thickness_table.clear();
      continue;
    }
    layer.material = out.spec.rail_material;
    for (ModulusPoint& point : layer.young_table) point.young = out.spec.rail_material.young;
    for (TablePoint& point : layer.thickness_table) point.at -= y;
  }
  out.spec.geometry.rail_shape = RailShape::block;
  out.spec.geometry.block_width = kWidth;
  out.spec.geometry.block_height = kHeight;
  out.placement.rail = circular_profile(ProfileKind::rail, HUGE_VAL, 0.6 * kWidth);
  out.placement.track.cant = 0;
  out.spec.track = {};
  return out;
}

void take_off(const SectionInterior& block, bool in_full, SectionInterior& from) {
  if (in_full) from.block_young = block.elements.front().material.young;
  for (std::size_t i = 0; i < from.at.size(); ++i)
    for (Eigen::Index row = 0; row < from.at[i].rows(); ++row) {
      const auto element = static_cast<std::size_t>(row / SectionInterior::kComponents);
      const bool scaled = in_full && row % SectionInterior::kComponents < SectionInterior::kStrains;
      from.at[i].row(row) -=
          (scaled ? from.block_young / from.elements[element].material.young : 1) * block.at[i].row(row);
    }
}

std::vector<Eigen::MatrixXd> without_limit(std::vector<Eigen::MatrixXd> values, Eigen::MatrixXd limit) {
  const Eigen::Index n = limit.rows() / 3;
  limit.topRightCorner(n, 2 * n).setZero();
  limit.bottomLeftCorner(2 * n, n).setZero();
  for (Eigen::MatrixXd& value : values) value -= limit;
  return values;
}

}  // namespace

std::vector<double> SectionPlane::along(const std::vector<Vec2>& points) const {
  const Vec2 direction{std::cos(angle), std::sin(angle)};
  std::vector<double> out;
  for (const Vec2 p : points) out.push_back(dot(p - contact, direction));
  return out;
}

SectionPlane section_plane(const CaseSpec& spec, const Placement& placement, BodyId body) {
  const RigidContact& contact = placement.contact;
  if (body == BodyId::rail)
    return {rail_to_model(placement.track, placement.rail.at(contact.rail_s).position), contact.angle};
  return {placement.wheel.at(contact.wheel_s).position - Vec2{0, spec.geometry.wheel_radius},
          contact.angle - contact.roll};
}

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

std::vector<RemainderShare> SectionStore::get(const CaseSpec& spec, const Placement& placement, BodyId body,
                                              const LayeredHalfSpace& half_space, const PatchGrid& grid) {
  std::vector<RemainderShare> out;
  for (const PlacedSizes& at : places_of(spec, placement, body, grid, kFinest))
    out.push_back({remainders_.get(key_of(spec, placement, body, half_space, at.sizes),
                                   [&] { return remainder_of(spec, placement, body, half_space, at.sizes); }),
                   at.share});
  return out;
}

std::vector<InteriorShare> SectionStore::below(const CaseSpec& spec, const Placement& placement, BodyId body,
                                               const LayeredHalfSpace& half_space, const PatchGrid& grid) {
  const auto difference = [&](const SectionSizes& sizes) {
    const bool in_full = sizes.largest > SectionRemainder::kSmoothTo;
    const MeshedSection meshed = meshed_section(spec, placement, body, sizes.place, sizes.mesh);
    const std::vector<double> k = wave_numbers(smallest_wave(spec, body), sizes.largest);
    SectionInterior out =
        interior_on(meshed, radius_at(spec, placement, body, sizes.place), support_of(spec.track.support), k);
    const ContactBand& band = meshed.body.contact;
    const LargeBlock block = large_block(spec, placement, body, in_full, sizes.place);
    SectionSizes alike = sizes;
    alike.place = block.placement.rail.s_at_y(0);
    alike.mesh.fine_width = band.s.back() - band.s.front();
    alike.mesh.fine_depth = band.depth.back();
    alike.mesh.largest = kLargestOfBlock;
    const auto of_block = [&] {
      return interior_on(meshed_section(block.spec, block.placement, BodyId::rail, alike.place, alike.mesh), 0, {}, k);
    };
    std::vector<double> key = key_of(block.spec, block.placement, BodyId::rail, half_space, alike);
    key.insert(key.end(), {alike.mesh.fine_depth, k.front()});
    const auto flat = in_full ? std::make_shared<const SectionInterior>(of_block()) : blocks_.get(key, of_block);
    if (flat->at.front().size() != out.at.front().size())
      throw NumericalError("a section's rows of elements are not those of a block");
    take_off(*flat, in_full, out);
    return out;
  };
  std::vector<InteriorShare> out;
  for (const PlacedSizes& at : places_of(spec, placement, body, grid, kFinestBelow)) {
    SectionSizes sizes = at.sizes;
    sizes.mesh.fine_depth =
        std::max(sizes.mesh.fine_depth, sizes.largest > SectionRemainder::kSmoothTo ? kFullDepthBelow : kDepthBelow);
    out.push_back({interiors_.get(key_of(spec, placement, body, half_space, sizes), [&] { return difference(sizes); }),
                   at.share});
  }
  return out;
}

}  // namespace railstrata
