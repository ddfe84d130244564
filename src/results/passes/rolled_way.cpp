#include "passes/rolled_way.hpp"

#include <algorithm>

#include "body/plastic_field.hpp"
#include "body/stress.hpp"
#include "result/contact_plane.hpp"

namespace railstrata {
namespace {

using Quad = PlasticSection::Quad;

/// Green's strain at an element's centre, in the rail's axes.
Sym3 green_strain(const Body& rail, const Field& u, Quad q, int station) {
  const auto h = displacement_gradient(rail, u, q.block, q.quad, station);
  return {h[0].x + 0.5 * dot(h[0], h[0]),
          h[1].y + 0.5 * dot(h[1], h[1]),
          h[2].z + 0.5 * dot(h[2], h[2]),
          0.5 * (h[0].y + h[1].x + dot(h[0], h[1])),
          0.5 * (h[1].z + h[2].y + dot(h[1], h[2])),
          0.5 * (h[0].z + h[2].x + dot(h[0], h[2]))};
}

/// The governing point; null where nothing has yielded.
const PassPoint* governing(const std::vector<PassPoint>& points) {
  const auto most = [&](auto&& of) {
    return std::max_element(points.begin(), points.end(),
                            [&](const PassPoint& a, const PassPoint& b) { return of(a) < of(b); });
  };
  if (points.empty()) return nullptr;
  const auto net = most([](const PassPoint& p) { return p.strain.net; });
  if (net->strain.net > 0) return &*net;
  const auto p = most([](const PassPoint& q) { return q.accumulated; });
  return p->accumulated > 0 ? &*p : nullptr;
}

struct Named {
  std::string name;
  Quad quad;
};

std::vector<Named> named_quads(const SweptBody& rail, Quad first) {
  std::vector<Named> out{{"governing", first}};
  const ContactBand& band = rail.contact;
  if (first.block != band.block) return out;
  const std::vector<int>& material = rail.blocks[band.block].section.quad_material;
  const int column = first.quad % band.columns;
  const auto add = [&](const char* name, int row) {
    const Quad q{band.block, row * band.columns + column};
    if (std::none_of(out.begin(), out.end(), [&](const Named& n) { return n.quad == q; })) out.push_back({name, q});
  };
  add("surface", 0);
  for (int r = 1; r < band.rows; ++r) {
    const auto layer = [&](int row) {
      return rail.layer_of(material[static_cast<std::size_t>(row) * band.columns + column]);
    };
    if (layer(r) == layer(r - 1)) continue;
    add("above the border", r - 1);
    add("below the border", r);
  }
  return out;
}

}  // namespace

std::vector<PassLoop> rolled_loops(const RollingSystem& system, const Model& base, const PlasticSection& section,
                                   const RolledPass& pass, const RolledRail& at) {
  const PassPoint* most = governing(pass.points);
  if (!most) return {};
  const Body& rail = system.rail();
  const ContactPlane plane(base);
  std::vector<PassLoop> out;
  for (Named& named : named_quads(rail.mesh, section.quads[static_cast<std::size_t>(most - pass.points.data())])) {
    const Block& block = rail.mesh.blocks[named.quad.block];
    const Vec2 from = centre_of(block.section, named.quad.quad) - plane.point;
    PassLoop loop{std::move(named.name), dot(from, plane.across), dot(from, plane.into), {}, {}};
    for (int e = block.stations.elements(); e-- > 0;) {
      const double x = 0.5 * (block.stations.at[e] + block.stations.at[e + 1]) - at.wheel;
      if (x > at.ahead || x < -at.behind) continue;
      loop.x.push_back(x);
      loop.states.push_back(
          {plane.turned(green_strain(rail, at.u, named.quad, e)),
           plane.turned(element_stress(rail, at.u, at.history, named.quad.block, named.quad.quad, e)),
           element_plasticity(rail, 0, at.history, named.quad.block, named.quad.quad, e).accumulated});
    }
    out.push_back(std::move(loop));
  }
  return out;
}

}  // namespace railstrata
