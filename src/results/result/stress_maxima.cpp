#include "result/stress_maxima.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "contact/enforcement.hpp"
#include "core/parabola.hpp"
#include "material/elastic.hpp"
#include "model/zone.hpp"

namespace railstrata {
namespace {

double largest_principal(const Sym3& s) { return principal_stresses(s).x; }
using Measure = double (*)(const Sym3&);

void offer(StressMaximum& best, double value, double x, double y, double depth) {
  if (std::isnan(best.value) || value > best.value) best = {value, x, y, depth};
}

// Largest value over the centres that `wanted` accepts, refined by parabolas in depth and along the rail where the
// neighbours are accepted too.
StressMaximum largest(const BandStress& b, Measure measure,
                      const std::function<bool(int column, int row, int station)>& wanted) {
  StressMaximum best;
  int bc = 0, br = 0, bs = 0;
  for (int s = 0; s < b.sample.stations; ++s)
    for (int r = 0; r < b.sample.rows; ++r)
      for (int c = 0; c < b.sample.columns; ++c) {
        if (!wanted(c, r, s)) continue;
        const double value = measure(b.at(c, r, s));
        if (std::isnan(best.value) || value > best.value) {
          best = {value, b.x(s), b.centre_y[c] - b.contact_y, b.centre_depth[r]};
          bc = c;
          br = r;
          bs = s;
        }
      }
  if (std::isnan(best.value)) return best;
  const auto refine = [&](double t0, double f0, double t1, double f1, double t2, double f2, double& place) {
    const ParabolaTop t = parabola_top(t0, f0, t1, f1, t2, f2);
    place = t.at;
    best.value += t.above;
  };
  const double top = best.value;
  if (br > 0 && br + 1 < b.sample.rows && wanted(bc, br - 1, bs) && wanted(bc, br + 1, bs))
    refine(b.centre_depth[br - 1], measure(b.at(bc, br - 1, bs)), b.centre_depth[br], top, b.centre_depth[br + 1],
           measure(b.at(bc, br + 1, bs)), best.depth);
  if (bs > 0 && bs + 1 < b.sample.stations && wanted(bc, br, bs - 1) && wanted(bc, br, bs + 1))
    refine(b.x(bs - 1), measure(b.at(bc, br, bs - 1)), b.x(bs), top, b.x(bs + 1), measure(b.at(bc, br, bs + 1)),
           best.x);
  return best;
}

StressPair largest_pair(const BandStress& b, const std::function<bool(int, int, int)>& wanted) {
  return {largest(b, von_mises, wanted), largest(b, largest_principal, wanted)};
}

// Largest value on either side of every interface between layers.
StressPair at_interfaces(const BandStress& b) {
  StressPair best;
  const auto& depth = b.body->contact.depth;
  for (int r = 1; r < b.sample.rows; ++r)
    for (int c = 0; c < b.sample.columns; ++c)
      for (int s = 0; s < b.sample.stations; ++s) {
        if (b.layer(c, r - 1, s) == b.layer(c, r, s)) continue;
        for (const bool below : {false, true}) {
          const Sym3 stress = stress_at_interface(b, c, r, s, below);
          const double x = b.x(s), y = b.centre_y[c] - b.contact_y;
          offer(best.von_mises, von_mises(stress), x, y, depth[r]);
          offer(best.sigma1, largest_principal(stress), x, y, depth[r]);
        }
      }
  return best;
}

void below_surface(const BandStress& b, double begin, bool layered, StressSummary& out) {
  const auto deep = [&](int, int r, int) { return b.centre_depth[r] > begin; };
  out.subsurface = largest_pair(b, deep);
  if (!layered) return;
  // where a layer has ended the sample may have none of it
  const auto if_any = [](StressPair pair) {
    return std::isnan(pair.von_mises.value) ? std::nullopt : std::optional(pair);
  };
  out.layer = if_any(largest_pair(b, [&](int c, int r, int s) { return b.layer(c, r, s) > 0; }));
  out.matrix = if_any(largest_pair(b, [&](int c, int r, int s) { return b.layer(c, r, s) == 0; }));
  out.interface = if_any(at_interfaces(b));
}

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

StressPair surface_maxima(const std::vector<Sym3>& stress, const BandSample& sample, const ContactSurface& surface,
                          double contact_y) {
  StressPair best;
  const int columns = sample.columns + 1;
  for (int j = 1; j < sample.stations; ++j)
    for (int c = 1; c + 1 < columns; ++c) {
      const Sym3& s = stress[static_cast<std::size_t>(j) * columns + c];
      const double y = surface.origin.y + surface.node[c].y - contact_y;
      offer(best.von_mises, von_mises(s), sample.along[j], y, 0);
      offer(best.sigma1, largest_principal(s), sample.along[j], y, 0);
    }
  return best;
}

/// Poisson's ratio at the surface in the middle of the contact band.
double surface_poisson(const SweptBody& body, const std::vector<Elastic>& at_surface) {
  return poisson(at_surface[body.blocks[body.contact.block].section.quad_material[body.contact.columns / 2]]);
}

/// Where the subsurface begins: subsurface_begin, no nearer than an element.
double begin_of(const CaseSpec& spec, BodyId body, const MeanContact& m) {
  const std::vector<std::size_t> layers = layers_on(spec, body);
  const double first_layer = layers.empty() ? HUGE_VAL : spec.layers[layers.front()].thickness;
  return std::max(spec.mesh.element_size, subsurface_begin(m.patch, first_layer));
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

StressSummary band_stress_summary(const RollingSystem& sys, BodyId id, const MeanContact& m) {
  const bool rail = id == BodyId::rail;
  const SweptBody& body = rail ? sys.model.rail : sys.model.wheel;
  const BandSample& sample = rail ? m.rail : m.wheel;
  const double contact_y = sys.model.placement.contact.point.y;
  StressSummary out;
  below_surface(band_stress(body, sample, contact_y - body.origin.y), begin_of(sys.model.spec, id, m),
                !layers_on(sys.model.spec, id).empty(), out);
  out.surface =
      surface_maxima(stress_at_surface(sys, id, m), sample, rail ? sys.rail_surface() : sys.wheel_surface(), contact_y);
  return out;
}

}  // namespace railstrata
