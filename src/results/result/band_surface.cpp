#include "result/band_surface.hpp"

#include <cmath>

#include "contact/enforcement.hpp"
#include "core/rotation.hpp"
#include "material/elastic.hpp"
#include "result/surface_peaks.hpp"

namespace railstrata {
namespace {

/// m, by which the surface turns upwards along the rail: of the wheel; negative of a ring below it; 0: straight.
double rising_radius(const ContactSurface& rail) { return rail.rises ? -rail.radius : 0.0; }

int material_at(const Block& block, const BandSample& sample, int column, int station) {
  return sample.element.empty() ? block.section.quad_material[column] : block.material(column, sample.element[station]);
}

// Recovery at the inner surface nodes of a sample; `traction(column, station)` acts on this body. radius: by which it
// rises along the rail.
template <class Traction>
std::vector<Sym3> recover_surface(const ContactSurface& surface, const BandSample& sample, const SweptBody& body,
                                  const std::vector<Elastic>& materials, double radius, Traction&& traction) {
  const int columns = sample.columns + 1, stations = sample.stations + 1,
            nodes_per_station = columns * (sample.rows + 1);
  const Block& block = body.blocks[body.contact.block];
  std::vector<Sym3> out(static_cast<std::size_t>(columns) * stations);
  auto u = [&](int c, int j) { return sample.displacement[static_cast<std::size_t>(j) * nodes_per_station + c]; };
  for (int j = 1; j + 1 < stations; ++j)
    for (int c = 1; c + 1 < columns; ++c) {
      const double angle = radius != 0 ? sample.along[j] / radius : 0;  // of the section plane against the vertical
      const Vec3 t1{std::cos(angle), 0, std::sin(angle)};
      const double up = surface.rises ? -surface.outward[c].z : surface.outward[c].z;
      const Vec3 n{-up * std::sin(angle), surface.outward[c].y, up * std::cos(angle)};
      const Vec3 t2 = cross(n, t1);
      const double along = sample.along[j + 1] - sample.along[j - 1],
                   across = (t2.y > 0 ? 1 : -1) * (surface.width[c - 1] + surface.width[c]);
      const Vec3 d1 = (1 / along) * (u(c, j + 1) - u(c, j - 1)), d2 = (1 / across) * (u(c + 1, j) - u(c - 1, j));
      const auto of = [&](int material) {
        return surface_stress(materials[material], n, t1, t2, dot(d1, t1), dot(d2, t2), dot(d1, t2) + dot(d2, t1),
                              traction(c, j));
      };
      Sym3& stress = out[static_cast<std::size_t>(j) * columns + c];
      const int behind = material_at(block, sample, c, j - 1), ahead = material_at(block, sample, c, j);
      stress = of(ahead);
      if (behind != ahead) stress = 0.5 * (stress + of(behind));
    }
  return out;
}

// Traction on the rail at a point of the field's plane, bilinear; zero outside.
Vec3 traction_at(const ContactField& f, const ContactSurface& rail, double x, double y) {
  Vec3 t{};
  points_around(f, x, y, [&](std::size_t i, int column, double weight) {
    t += weight * traction_vector({f.p[i], f.q_x[i], f.q_y[i], 0, 0}, rail.rail_normal(column, f.x[i]));
  });
  return t;
}

/// Poisson's ratio at the surface in the middle of the contact band.
double surface_poisson(const SweptBody& body, const std::vector<Elastic>& at_surface) {
  return poisson(at_surface[body.blocks[body.contact.block].section.quad_material[body.contact.columns / 2]]);
}

std::vector<Sym3> stress_at_surface(const RollingSystem& sys, BodyId id, const MeanContact& m) {
  const ContactField& f = m.field;
  const ContactSurface &rail = sys.rail_surface(), &wheel = sys.wheel_surface();
  if (id == BodyId::rail)
    return recover_surface(rail, m.rail, sys.model.rail, sys.model.rail_at_surface, rising_radius(rail),
                           [&](int c, int j) {
                             const int i = j * f.columns + c;
                             return traction_vector({f.p[i], f.q_x[i], f.q_y[i], 0, 0}, rail.rail_normal(c, f.x[i]));
                           });
  return recover_surface(
      wheel, m.wheel, sys.model.wheel, sys.model.wheel_at_surface, sys.rolling_radius,
      [&](int c, int j) { return -traction_at(f, rail, m.wheel.along[j], wheel.origin.y + wheel.node[c].y); });
}

/// Pressure, traction and state at a point of a contact field, linear between its points.
struct TouchAt {
  double p = 0, q = 0;  ///< Pa
  ContactState state = ContactState::separated;
};
TouchAt touch_at(const ContactField& f, double x, double y) {
  TouchAt out;
  double q_x = 0, q_y = 0, slip = 0;
  points_around(f, x, y, [&](std::size_t i, int, double weight) {
    out.p += weight * f.p[i];
    q_x += weight * f.q_x[i];
    q_y += weight * f.q_y[i];
    if (f.state[i] == ContactState::slip) slip += weight;
  });
  out.q = std::hypot(q_x, q_y);
  if (out.p > 0) out.state = slip >= 0.5 ? ContactState::slip : ContactState::stick;
  return out;
}

/// How deep the material at the surface reaches below a node.
double depth_of_material(const BandStress& band, int node) {
  int rows = 1;
  while (rows < band.sample.rows && band.layer(node, rows, 0) == band.layer(node, 0, 0)) ++rows;
  return band.body->contact.depth[rows];
}

}  // namespace

Sym3 surface_stress(const Elastic& material, Vec3 n, Vec3 t1, Vec3 t2, double e11, double e22, double g12,
                    Vec3 traction) {
  const double e = young(material), nu = poisson(material), snn = dot(traction, n);
  const double s11 = e / (1 - nu * nu) * (e11 + nu * e22) + nu / (1 - nu) * snn,
               s22 = e / (1 - nu * nu) * (e22 + nu * e11) + nu / (1 - nu) * snn;
  auto dyad = [](Vec3 a, Vec3 b) {  // (ab + ba)/2
    return Sym3{a.x * b.x,
                a.y * b.y,
                a.z * b.z,
                0.5 * (a.x * b.y + a.y * b.x),
                0.5 * (a.y * b.z + a.z * b.y),
                0.5 * (a.x * b.z + a.z * b.x)};
  };
  return s11 * dyad(t1, t1) + s22 * dyad(t2, t2) + snn * dyad(n, n) + (2 * material.mu * g12) * dyad(t1, t2) +
         (2 * dot(traction, t1)) * dyad(t1, n) + (2 * dot(traction, t2)) * dyad(t2, n);
}

BandSurface band_surface(const RollingSystem& sys, BodyId id, const MeanContact& m) {
  if (id == BodyId::rail)
    return {stress_at_surface(sys, id, m), m.field, surface_poisson(sys.model.rail, sys.model.rail_at_surface),
            rising_radius(sys.rail_surface())};
  return {stress_at_surface(sys, id, m), m.field, surface_poisson(sys.model.wheel, sys.model.wheel_at_surface),
          sys.rolling_radius};
}

Sym3 ColumnAxes::turned(const Sym3& stress, double x) const {
  Sym3 s = roll(rotation_by(-angle), stress);
  if (!(radius > 0)) {  // the rail's z axis points down into it, the wheel's up
    s.yz = -s.yz;
    s.xz = -s.xz;
    return s;
  }
  const double t = x / radius, c = std::cos(t), d = std::sin(t);  // about y; small
  return {c * c * s.xx + 2 * c * d * s.xz + d * d * s.zz,
          s.yy,
          d * d * s.xx - 2 * c * d * s.xz + c * c * s.zz,
          c * s.xy + d * s.yz,
          c * s.yz - d * s.xy,
          (c * c - d * d) * s.xz + c * d * (s.zz - s.xx)};
}

ColumnAxes column_axes(const BandStress& band, const BandSurface& surface, int left, int right) {
  const auto& nodes = band.body->blocks[band.body->contact.block].section.nodes;
  return {std::atan2(nodes[right].z - nodes[left].z, nodes[right].y - nodes[left].y), surface.radius};
}

std::vector<Sym3> surface_column(const BandStress& band, const BandSurface& surface, int column) {
  const auto& nodes = band.body->blocks[band.body->contact.block].section.nodes;
  const ColumnAxes axes = column_axes(band, surface, column - 1, column + 1);
  const BandSample& sample = band.sample;
  std::vector<Sym3> stresses;
  for (int j = 1; j < sample.stations; ++j)
    stresses.push_back(
        axes.turned(surface.stress[static_cast<std::size_t>(j) * (sample.columns + 1) + column], sample.along[j]));
  if (depth_of_material(band, column) < sample.along[1] - sample.along[0]) return stresses;
  const std::vector<Sym3> recovered = stresses;
  const auto stress = [&](int i) { return recovered[i]; };
  SurfaceRow row{{}, {}, {}, stress, surface.poisson};
  for (int j = 1; j < sample.stations; ++j) {
    const TouchAt touch = touch_at(surface.field, sample.along[j], band.body->origin.y + nodes[column].y);
    row.p.push_back(touch.p);
    row.q.push_back(touch.q);
    row.state.push_back(touch.state);
  }
  const SurfacePeaks peaks = surface_peaks(row);
  if (!peaks.any()) return stresses;
  if (peaks.first > 0) stresses[peaks.first - 1] = peaks.behind;
  if (peaks.last + 1 < static_cast<int>(stresses.size())) stresses[peaks.last + 1] = peaks.ahead;
  for (const SurfacePeaks::Front& f : peaks.fronts) stresses[f.at] = f.stress;
  return stresses;
}

}  // namespace railstrata
