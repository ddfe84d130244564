#include "fem/plastic_zone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "body/body.hpp"
#include "core/faults.hpp"
#include "model/material_strength.hpp"
#include "model/section_axes.hpp"
#include "model/zone.hpp"

namespace railstrata {
namespace {

// A material of the mesh: its entry in the case, the depth that its tables begin at, how it yields, and its strength
// over that of its layer.
struct Source {
  const MaterialSpec* material;
  std::string name, key;
  double top = 0;
  std::optional<PlasticLaw> law = {};
  double factor = 1;
};
std::vector<Source> sources_of(const CaseSpec& spec, BodyId id, const SweptBody& mesh) {
  const bool rail = id == BodyId::rail;
  std::vector<Source> by_layer;
  by_layer.push_back(rail ? Source{&spec.rail_material, "rail", "material.rail", 0}
                          : Source{&spec.wheel_material, "wheel", "material.wheel", 0});
  const std::vector<double> tops = layer_tops(spec.layers);
  for (const std::size_t i : layers_on(spec, id))
    by_layer.push_back({&spec.layers[i].material, spec.layers[i].name, fmt::format("layer.{}", i), tops[i]});
  std::vector<Source> out;
  for (int m = 0; m < static_cast<int>(mesh.materials.size()); ++m) {
    Source& s = out.emplace_back(by_layer.at(static_cast<std::size_t>(mesh.layer_of(m))));
    s.law = plastic_law(*s.material, s.name, s.key);
    s.factor = mesh.strength_of(m);
  }
  return out;
}

class Zone {
 public:
  Zone(const Model& model, BodyId id, const SweptBody& mesh)
      : mesh_(mesh), axes_(model, id), sources_(sources_of(model.spec, id, mesh)) {}

  /// Of a quadrilateral's elements of a material.
  std::optional<PlasticMaterial> material(int block, int quad, int material) const {
    const Source& source = sources_[material];
    if (!source.law) return std::nullopt;
    const double depth = axes_.depth(centre_of(mesh_.blocks[block].section, quad));
    PlasticMaterial out = source.law->at(std::max(depth - source.top, 0.0));
    if (source.factor != 1) out.plastic = scaled(out.plastic, source.factor);
    return out;
  }
  bool within(const HotBox& box, int block, int quad) const {
    const Vec2 at = centre_of(mesh_.blocks[block].section, quad);
    return axes_.depth(at) < box.depth && axes_.aside(at) < box.half_width;
  }
  /// That a process has left, in the element's frame.
  InitialStress::Stress stress(int block, int quad) const {
    const Section& section = mesh_.blocks[block].section;
    const Source& source = sources_[section.quad_material[quad]];
    const StrengthSpec& s = source.material->strength;
    if (s.initial_stress.empty() && s.initial_stress_table.empty()) return {};
    Vec2 along = axes_.across;
    double depth = axes_.depth(centre_of(section, quad));
    if (const ContactBand& band = mesh_.contact; block == band.block) {
      const int row = quad / band.columns, column = quad % band.columns;
      const Vec2 facet = section.nodes[column + 1] - section.nodes[column];
      along = (1 / std::hypot(facet.y, facet.z)) * facet;
      depth = 0.5 * (band.depth[row] + band.depth[row + 1]);
    }
    const StressPoint given = process_stress(s, depth - source.top, source.key);
    const double lateral = given.lateral;
    return {given.longitudinal,          lateral * along.y * along.y,
            lateral * along.z * along.z, 0,
            lateral * along.y * along.z, 0};
  }

 private:
  const SweptBody& mesh_;
  SectionAxes axes_;
  std::vector<Source> sources_;
};

}  // namespace

PlasticElements plastic_zone(const Model& model, BodyId id, const Body& body, const HotBox& hot) {
  if (!model.spec.run.plasticity) return {};
  const Zone zone(model, id, body.mesh);
  return {body,
          [&](int block, int quad, int material) -> std::optional<YieldingMaterial> {
            const std::optional<PlasticMaterial> yields = zone.material(block, quad, material);
            if (!yields) return std::nullopt;
            YieldingMaterial out{yields->plastic, zone.stress(block, quad)};
            out.law.mu = body.materials[material].mu;  // of a row of a graded layer, or in a stretch
            return out;
          },
          [&](int block, int quad, const Tile&) { return zone.within(hot, block, quad); }};
}

InitialStress initial_stress(const Model& model, BodyId id, const SweptBody& mesh) {
  if (!model.spec.run.plasticity) return {};
  const Zone zone(model, id, mesh);
  return {mesh, [&](int block, int quad) { return zone.stress(block, quad); }};
}

}  // namespace railstrata
