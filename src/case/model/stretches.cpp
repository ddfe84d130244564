#include "model/stretches.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

#include "model/section_axes.hpp"

namespace railstrata {
namespace {

/// Of Young's modulus and of strength.
struct Factors {
  double young = 1, strength = 1;
  friend auto operator<=>(const Factors&, const Factors&) = default;
};

Factors between(const std::vector<StretchPoint>& rows, double x) {
  if (rows.empty() || x < rows.front().x || x > rows.back().x) return {};
  const auto after = std::find_if(rows.begin() + 1, rows.end(), [&](const StretchPoint& p) { return x <= p.x; });
  const StretchPoint &a = *(after - 1), &b = *after;
  const double t = (x - a.x) / (b.x - a.x);
  return {a.young + t * (b.young - a.young), a.strength + t * (b.strength - a.strength)};
}

/// The materials of one body.
class BodyStretches {
 public:
  BodyStretches(Model& model, BodyId id)
      : spec_(model.spec),
        id_(id),
        body_(id == BodyId::rail ? model.rail : model.wheel),
        materials_(id == BodyId::rail ? model.rail_materials : model.wheel_materials),
        at_surface_(id == BodyId::rail ? model.rail_at_surface : model.wheel_at_surface),
        metres_(id == BodyId::rail ? 1 : model.placement.contact.rolling_radius),
        axes_(model, id) {
    body_.strength.assign(materials_.size(), 1.0);
  }

  void add_to(Block& block) {
    const int quads = static_cast<int>(block.section.quads.size());
    std::vector<std::vector<int>> sets;
    std::map<std::vector<int>, int> known;
    std::vector<int> of_element;
    for (int e = 0; e < block.stations.elements(); ++e) {
      std::vector<int> set;
      for (int q = 0; q < quads; ++q) set.push_back(material(block.material(q, e), factors(block, e, q)));
      const auto [at, fresh] = known.emplace(set, static_cast<int>(sets.size()));
      if (fresh) sets.push_back(set);
      of_element.push_back(at->second);
    }
    block.section.quad_material = sets.front();
    block.along = sets.size() > 1 ? MaterialSets{std::move(sets), std::move(of_element)} : MaterialSets{};
  }

 private:
  Factors factors(const Block& block, int element, int quad) const {
    const double centre = block.stations.centre(element), turn = block.stations.closed ? 2 * std::numbers::pi : 0;
    Factors out;
    for (const StretchSpec& stretch : spec_.stretches) {
      if (stretch.on != id_ || (stretch.depth && axes_.depth(centre_of(block.section, quad)) > *stretch.depth))
        continue;
      for (const int way : {-1, 0, 1}) {
        if (way != 0 && turn == 0) continue;
        const Factors here = between(stretch.along, metres_ * (centre + way * turn));
        out.young *= here.young;
        out.strength *= here.strength;
      }
    }
    return out;
  }

  int material(int base, const Factors& factors) {
    if (factors == Factors{}) return base;
    const auto [at, fresh] = made_.emplace(std::pair(base, factors), static_cast<int>(materials_.size()));
    if (!fresh) return at->second;
    const auto stiffer = [&](const Elastic& m) { return elastic(factors.young * young(m), poisson(m), m.density); };
    const std::string name = body_.materials[static_cast<std::size_t>(base)];
    const int layer = body_.layer_of(base);
    if (body_.material_layer.empty())
      for (std::size_t m = 0; m < body_.materials.size(); ++m) body_.material_layer.push_back(static_cast<int>(m));
    materials_.push_back(stiffer(materials_[static_cast<std::size_t>(base)]));
    at_surface_.push_back(stiffer(at_surface_[static_cast<std::size_t>(base)]));
    body_.materials.push_back(name);
    body_.material_layer.push_back(layer);
    body_.strength.push_back(factors.strength);
    return at->second;
  }

  const CaseSpec& spec_;
  BodyId id_;
  SweptBody& body_;
  std::vector<Elastic>&materials_, &at_surface_;
  double metres_;  // per unit of the sweep coordinate
  SectionAxes axes_;
  std::map<std::pair<int, Factors>, int> made_;
};

}  // namespace

void add_stretches(Model& model) {
  for (const BodyId id : kBodies) {
    const std::vector<StretchSpec>& all = model.spec.stretches;
    if (std::none_of(all.begin(), all.end(), [&](const StretchSpec& s) { return s.on == id; })) continue;
    BodyStretches stretches(model, id);
    for (Block& block : (id == BodyId::rail ? model.rail : model.wheel).blocks) stretches.add_to(block);
  }
}

}  // namespace railstrata
