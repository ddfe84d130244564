#include "bem/section_remainder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/faults.hpp"

namespace railstrata {

namespace {

constexpr double kStation = 2e-3;  // m, from one to the next
constexpr double kPlace = 4e-3;    // m, to which the middle of the stations is rounded: contacts nearby share a section
constexpr int kWaves = 16;
constexpr double kSmallestWave = 1,
                 kLargestWave = 500;  // 1/m, of the wave numbers: with elements as wide as the stations

MeshSizes sizes_for(double half_width) {
  const double across = kStation * std::ceil((half_width + kStation + 0.5 * kPlace) / kStation);
  return {.element = kStation, .fine_width = 2 * across, .fine_depth = 8e-3, .coarse_ratio = 3, .largest = 12e-3};
}

/// What the section depends on: the case's numbers, and the profile by its points.
std::vector<double> key_of(const CaseSpec& spec, const Placement& placement, BodyId body, double place,
                           const MeshSizes& sizes) {
  constexpr int kPoints = 400;
  const bool wheel = body == BodyId::wheel;
  const Profile& profile = wheel ? placement.wheel : placement.rail;
  const GeometrySpec& g = spec.geometry;
  const MaterialSpec& m = wheel ? spec.wheel_material : spec.rail_material;
  std::vector<double> key{static_cast<double>(wheel), place, sizes.fine_width, m.young, m.poisson};
  if (wheel) {
    const WheelSection& w = g.wheel_section;
    key.insert(key.end(), {static_cast<double>(g.wheel_shape), g.wheel_radius, w.rim_thickness, w.web_thickness,
                           w.web_offset, w.hub_radius, w.hub_width, w.bore_radius});
  } else {
    key.insert(key.end(), {static_cast<double>(g.rail_shape), g.cant, g.block_width, g.block_height});
  }
  for (const LayerSpec& layer : spec.layers) {
    if (layer.on != body) continue;
    key.insert(key.end(), {layer.thickness, layer.width, layer.material.young, layer.material.poisson});
    for (const ModulusPoint& point : layer.young_table) key.insert(key.end(), {point.depth, point.young});
  }
  for (int i = 0; i <= kPoints; ++i) {
    const double s = profile.s_min() + (profile.s_max() - profile.s_min()) * i / kPoints;
    const Vec2 at = profile.at(std::min(s, profile.s_max())).position;
    key.insert(key.end(), {at.y, at.z});
  }
  return key;
}

/// The half-space's layers, off which the section is taken, are endless.
void refuse_narrow_layers(const CaseSpec& spec, const Profile& profile, BodyId body, double place,
                          const MeshSizes& sizes) {
  const double y = profile.at(place).position.y, reach = std::abs(y) + 0.5 * sizes.fine_width;
  for (std::size_t i = 0; i < spec.layers.size(); ++i)
    if (spec.layers[i].on == body && 0.5 * spec.layers[i].width < reach)
      throw CaseError(fmt::format("sections need layers that reach {:.0f} mm beyond the contact: a width of {:.0f} mm",
                                  0.5e3 * sizes.fine_width, 2e3 * reach),
                      "give a larger width, or bem.bodies = \"half_spaces\"", fmt::format("layer.{}.width", i));
}

std::shared_ptr<const SectionRemainder> remainder_of(const CaseSpec& spec, const Placement& placement, BodyId body,
                                                     const LayeredHalfSpace& half_space, double place,
                                                     const MeshSizes& sizes) {
  const bool wheel = body == BodyId::wheel;
  refuse_narrow_layers(spec, wheel ? placement.wheel : placement.rail, body, place, sizes);
  const MeshedSection meshed = meshed_section(spec, placement, body, place, sizes);
  SectionRemainder out;
  out.radius = wheel ? spec.geometry.wheel_radius - placement.wheel.at(place).position.z : 0;
  std::vector<double> k;
  for (int i = 0; i < kWaves; ++i)
    k.push_back(kSmallestWave * std::pow(kLargestWave / kSmallestWave, i / (kWaves - 1.0)));
  const QuadraticSection mesh = quadratic_section(meshed.body);
  out.section = section_compliance(mesh, section_stiffness(mesh, meshed.materials, out.radius), 1, k);
  out.half_space =
      half_space_compliance(half_space, wheel, out.section.spacing, static_cast<int>(out.section.stations.size()), k);
  return std::make_shared<const SectionRemainder>(std::move(out));
}

}  // namespace

std::shared_ptr<const SectionRemainder> SectionStore::get(const CaseSpec& spec, const Placement& placement, BodyId body,
                                                          const LayeredHalfSpace& half_space, double half_width) {
  constexpr std::size_t kEntries = 16;
  const RigidContact& contact = placement.contact;
  const double place = kPlace * std::round((body == BodyId::wheel ? contact.wheel_s : contact.rail_s) / kPlace);
  const MeshSizes sizes = sizes_for(half_width);
  std::vector<double> key = key_of(spec, placement, body, place, sizes);
  const std::lock_guard lock(mutex_);
  for (const Entry& entry : entries_)
    if (entry.key == key) return entry.remainder;
  if (entries_.size() == kEntries) entries_.erase(entries_.begin());
  auto made = remainder_of(spec, placement, body, half_space, place, sizes);
  entries_.push_back({std::move(key), made});
  return made;
}

}  // namespace railstrata
