#include "fem/plastic_zone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "body/body.hpp"
#include "body/stress.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "fem/stepper.hpp"
#include "model/material_strength.hpp"

namespace railstrata {
namespace {

constexpr double kDepth = 2.5, kWidth = 1.6;  // of Hertz's larger half-axis and half-width
constexpr double kBeyondPath = 3;             // half-lengths of the patch

// Laws of a body's materials, and the depth that their tables begin at.
struct Law {
  std::optional<PlasticLaw> law;
  double top = 0;
};
std::vector<Law> laws_of(const CaseSpec& spec, BodyId id, const SweptBody& mesh) {
  const bool rail = id == BodyId::rail;
  std::vector<Law> by_layer;
  const MaterialSpec& matrix = rail ? spec.rail_material : spec.wheel_material;
  by_layer.push_back({plastic_law(matrix, rail ? "rail" : "wheel", rail ? "material.rail" : "material.wheel"), 0});
  double top = 0;
  for (std::size_t i = 0; i < spec.layers.size(); ++i) {
    const LayerSpec& layer = spec.layers[i];
    if (layer.on != id) continue;
    by_layer.push_back({plastic_law(layer.material, layer.name, fmt::format("layer.{}", i)), top});
    top += layer.thickness;
  }
  std::vector<Law> out;
  for (int m = 0; m < static_cast<int>(mesh.materials.size()); ++m)
    out.push_back(by_layer.at(static_cast<std::size_t>(mesh.layer_of(m))));
  return out;
}

/// Section coordinates at the rigid contact point: depth below the running surface and distance to a side.
struct Below {
  double depth, aside;
};
struct ContactAxes {
  Vec2 point, outward;
  Below of(Vec2 p) const {
    const Vec2 r = p - point;
    return {-(r.y * outward.y + r.z * outward.z), std::abs(r.y * outward.z - r.z * outward.y)};
  }
};
ContactAxes contact_axes(const Model& m, BodyId id) {
  const RigidContact& c = m.placement.contact;
  if (id == BodyId::rail) return {m.rail_section_point(c.rail_s), m.rail_section_normal(c.rail_s)};
  return {m.wheel_section_point(c.wheel_s), m.wheel_section_normal(c.wheel_s)};
}

Vec2 centre_of(const Section& section, int quad) {
  Vec2 sum{};
  for (int n : section.quads[quad]) sum = sum + 0.25 * section.nodes[n];
  return sum;
}

class Zone {
 public:
  Zone(const Model& model, BodyId id, const SweptBody& mesh)
      : mesh_(mesh), axes_(contact_axes(model, id)), laws_(laws_of(model.spec, id, mesh)) {
    const RunSpec& run = model.spec.run;
    const HertzContact& hertz = model.hertz;
    depth_ = run.plastic_depth.value_or(kDepth * std::max(hertz.a, hertz.b));
    width_ = run.plastic_width.value_or(kWidth * hertz.b + 2 * model.spec.mesh.element_size);
    const double beyond = kBeyondPath * hertz.a, end = run.rolling ? model.x_end : 0;
    const double per_metre = id == BodyId::rail ? 1 : 1 / model.spec.geometry.wheel_radius;
    first_ = -beyond * per_metre;
    last_ = (end + beyond) * per_metre;
  }

  bool yields() const {
    return std::any_of(laws_.begin(), laws_.end(), [](const Law& l) { return l.law.has_value(); });
  }
  /// Of any quadrilateral, in the box or not.
  std::optional<PlasticMaterial> material(int block, int quad) const {
    const Section& section = mesh_.blocks[block].section;
    const Law& law = laws_[section.quad_material[quad]];
    if (!law.law) return std::nullopt;
    const double depth = axes_.of(centre_of(section, quad)).depth;
    return law.law->at(std::max(depth - law.top, 0.0));
  }
  bool reaches(int block, int quad) const {
    const Below at = axes_.of(centre_of(mesh_.blocks[block].section, quad));
    return at.depth < depth_ && at.aside < width_;
  }
  bool reaches(const Tile& tile) const {
    const Stations& stations = mesh_.blocks[tile.block].stations;
    const double from = stations.at[tile.first];
    const double to = tile.end < stations.nodes() ? stations.at[tile.end] : stations.at[0] + 2 * std::numbers::pi;
    if (mesh_.kind == SweepKind::extrude) return from < last_ && to > first_;
    for (int turn = -1; turn <= 1; ++turn) {
      const double shift = 2 * std::numbers::pi * turn;
      if (from + shift < last_ && to + shift > first_) return true;
    }
    return last_ - first_ > 2 * std::numbers::pi;
  }

 private:
  const SweptBody& mesh_;
  ContactAxes axes_;
  std::vector<Law> laws_;
  double depth_ = 0, width_ = 0, first_ = 0, last_ = 0;
};

// Elements that stay elastic although their material yields: von Mises stress over the yield stress.
struct Hottest {
  double share = 0;
  int block = 0, quad = 0, station = 0;
};
Hottest hottest_outside(const RollingSystem& sys, BodyId id, const Field& u, const Field& history) {
  const Body& body = sys.body(id);
  const SweptBody& mesh = body.mesh;
  const Zone zone(sys.model, id, mesh);
  const int block = mesh.contact.block;  // where stresses are highest
  const int quads = static_cast<int>(mesh.blocks[block].section.quads.size());
  std::vector<Hottest> worst(static_cast<std::size_t>(quads));
  for_each(
      quads,
      [&](std::ptrdiff_t k) {
        const int q = static_cast<int>(k);
        const std::optional<PlasticMaterial> material = zone.material(block, q);
        if (!material) return;
        for (int e = 0; e < body.layout.blocks[block].elements; ++e) {
          if (body.plastic.first(body.tiling.first_tile[block] + e / kTile, q) >= 0) continue;
          const double share = von_mises(element_stress(body, u, history, block, q, e)) / material->plastic.yield;
          if (share > worst[k].share) worst[k] = {share, block, q, e};
        }
      },
      true);
  Hottest out;
  for (const Hottest& w : worst)
    if (w.share > out.share) out = w;
  return out;
}

}  // namespace

PlasticElements plastic_zone(const Model& model, BodyId id, const Body& body) {
  if (!model.spec.run.plasticity) return {};
  if (!Zone(model, BodyId::rail, model.rail).yields() && !Zone(model, BodyId::wheel, model.wheel).yields())
    throw CaseError("run.plasticity = true, but no material of the case says a strength",
                    "give material.rail.yield_strength, or a ready set: material.rail.hardening = \"R260\"");
  const Zone zone(model, id, body.mesh);
  return {body,
          [&](int block, int quad) -> std::optional<YieldingMaterial> {
            if (!zone.reaches(block, quad)) return std::nullopt;
            const std::optional<PlasticMaterial> material = zone.material(block, quad);
            if (!material) return std::nullopt;
            return YieldingMaterial{material->plastic, {}};
          },
          [&](int, int, const Tile& tile) { return zone.reaches(tile); }};
}

void require_elastic_outside(const Stepper& st) {
  const RollingSystem& sys = st.system();
  if (!sys.model.spec.run.plasticity || st.state().step % kWatchInterval != 0) return;
  for (const BodyId id : {BodyId::rail, BodyId::wheel}) {
    const Body& body = sys.body(id);
    const Field u = st.displacement(id);
    const Hottest at = hottest_outside(sys, id, u, st.state().bodies[index_of(id)].history);
    if (at.share < 1) continue;
    const Below below = contact_axes(sys.model, id).of(centre_of(body.mesh.blocks[at.block].section, at.quad));
    throw NumericalError(fmt::format(
        "an element of the {} that is computed elastically reached {:.2f} of its yield stress at x = {:.4g} "
        "mm: {:.1f} mm deep, {:.1f} mm beside the contact point\n"
        "    try a larger run.plastic_depth or run.plastic_width",
        body.mesh.name, at.share, 1e3 * st.position(), 1e3 * below.depth, 1e3 * below.aside));
  }
}

}  // namespace railstrata
