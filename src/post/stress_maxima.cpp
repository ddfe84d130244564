#include "post/stress_maxima.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "contact/enforcement.hpp"
#include "material/elastic.hpp"

namespace railstrata {
namespace {

double largest_principal(const Sym3& s) { return principal_stresses(s).x; }
using Measure = double (*)(const Sym3&);

int material_of(const BandStress& b, int column, int row) {
  const ContactBand& band = b.body->contact;
  return b.body->blocks[band.block].section.quad_material[static_cast<std::size_t>(row) * band.columns + column];
}

void offer(StressMaximum& best, double value, double x, double y, double depth) {
  if (std::isnan(best.value) || value > best.value) best = {value, x, y, depth};
}

// Largest value over the centres that `wanted` accepts, refined by parabolas in depth and along the rail where the neighbours are accepted too.
StressMaximum largest(const BandStress& b, Measure measure, const std::function<bool(int column, int row)>& wanted) {
  StressMaximum best;
  int bc = 0, br = 0, bs = 0;
  for (int s = 0; s < b.sample.stations; ++s)
    for (int r = 0; r < b.sample.rows; ++r)
      for (int c = 0; c < b.sample.columns; ++c) {
        if (!wanted(c, r)) continue;
        const double value = measure(b.at(c, r, s));
        if (std::isnan(best.value) || value > best.value) {
          best = {value, b.x(s), b.centre_y[c] - b.contact_y, b.centre_depth[r]};
          bc = c, br = r, bs = s;
        }
      }
  if (std::isnan(best.value)) return best;
  auto refine = [&](double t0, double f0, double t1, double f1, double t2, double f2, double& place) {
    const double a = ((f2 - f1) / (t2 - t1) - (f1 - f0) / (t1 - t0)) / (t2 - t0);
    if (a >= 0) return;
    const double slope = (f1 - f0) / (t1 - t0) + a * (t1 - t0), d = std::clamp(-slope / (2 * a), t0 - t1, t2 - t1);
    place = t1 + d;
    best.value += slope * d + a * d * d;
  };
  const double top = best.value;
  if (br > 0 && br + 1 < b.sample.rows && wanted(bc, br - 1) && wanted(bc, br + 1))
    refine(b.centre_depth[br - 1], measure(b.at(bc, br - 1, bs)), b.centre_depth[br], top, b.centre_depth[br + 1], measure(b.at(bc, br + 1, bs)), best.depth);
  if (bs > 0 && bs + 1 < b.sample.stations)
    refine(b.x(bs - 1), measure(b.at(bc, br, bs - 1)), b.x(bs), top, b.x(bs + 1), measure(b.at(bc, br, bs + 1)), best.x);
  return best;
}

StressPair largest_pair(const BandStress& b, const std::function<bool(int, int)>& wanted) { return {largest(b, von_mises, wanted), largest(b, largest_principal, wanted)}; }

Sym3 extrapolate(const Sym3& near, const Sym3& far, double d_near, double d_far, double d) {
  const double t = (d - d_near) / (d_near - d_far);
  return near + t * (near - far);
}

// Largest value on either side of every interface between materials.
StressPair at_interfaces(const BandStress& b) {
  StressPair best;
  const auto& depth = b.body->contact.depth;
  for (int r = 1; r < b.sample.rows; ++r)
    for (int c = 0; c < b.sample.columns; ++c) {
      if (material_of(b, c, r - 1) == material_of(b, c, r)) continue;
      for (int s = 0; s < b.sample.stations; ++s)
        for (int side = 0; side < 2; ++side) {
          const int near = side ? r : r - 1, far = side ? r + 1 : r - 2;
          Sym3 stress = b.at(c, near, s);
          if (far >= 0 && far < b.sample.rows && material_of(b, c, far) == material_of(b, c, near))
            stress = extrapolate(stress, b.at(c, far, s), b.centre_depth[near], b.centre_depth[far], depth[r]);
          const double x = b.x(s), y = b.centre_y[c] - b.contact_y;
          offer(best.von_mises, von_mises(stress), x, y, depth[r]);
          offer(best.sigma1, largest_principal(stress), x, y, depth[r]);
        }
    }
  return best;
}

void below_surface(const BandStress& b, double element_size, bool layered, StressSummary& out) {
  const auto deep = [&](int, int r) { return b.centre_depth[r] > element_size; };
  out.subsurface = largest_pair(b, deep);
  if (!layered) return;
  out.layer = largest_pair(b, [&](int c, int r) { return material_of(b, c, r) > 0; });
  out.matrix = largest_pair(b, [&](int c, int r) { return material_of(b, c, r) == 0; });
  out.interface = at_interfaces(b);
}

}  // namespace

BandStress band_stress(const SweptBody& body, BandSample sample, double contact_y) {
  BandStress b{&body, std::move(sample), contact_y, {}, {}};
  const ContactBand& band = body.contact;
  const auto& nodes = body.blocks[band.block].section.nodes;
  for (int c = 0; c < band.columns; ++c) b.centre_y.push_back(0.5 * (nodes[c].y + nodes[c + 1].y));
  for (int r = 0; r < band.rows; ++r) b.centre_depth.push_back(0.5 * (band.depth[r] + band.depth[r + 1]));
  return b;
}

std::vector<Sym3> rail_surface_stress(const RollingSystem& sys, const MeanContact& m) {
  const ContactField& f = m.field;
  const ContactSurface& surface = sys.rail_surface;
  std::vector<Sym3> out(static_cast<std::size_t>(f.size()));
  const int nodes_per_station = (m.rail.rows + 1) * (m.rail.columns + 1);
  const auto& quad_material = sys.model.rail.blocks[sys.model.rail.contact.block].section.quad_material;
  for (int j = 1; j + 1 < f.stations; ++j)
    for (int c = 1; c + 1 < f.columns; ++c) {
      const int i = j * f.columns + c;
      auto u = [&](int column, int station) { return m.rail.displacement[static_cast<std::size_t>(station) * nodes_per_station + column]; };
      const Vec3 n{0, surface.outward[c].y, surface.outward[c].z};
      const TangentFrame t = tangent_frame(n);
      const double dx = m.rail.along[j + 1] - m.rail.along[j - 1], dy = surface.width[c - 1] + surface.width[c];
      const Vec3 du1 = (1 / dx) * (u(c, j + 1) - u(c, j - 1)), du2 = (1 / dy) * (u(c + 1, j) - u(c - 1, j));
      const double e11 = dot(du1, t.t1), e22 = dot(du2, t.t2), g12 = dot(du1, t.t2) + dot(du2, t.t1);
      const Elastic& mat = sys.model.rail_materials[quad_material[std::min(c, m.rail.columns - 1)]];
      const double e = young(mat), nu = poisson(mat), snn = -f.p[i];
      const double s11 = e / (1 - nu * nu) * (e11 + nu * e22) + nu / (1 - nu) * snn, s22 = e / (1 - nu * nu) * (e22 + nu * e11) + nu / (1 - nu) * snn, s12 = mat.mu * g12;
      const double s1n = f.q_x[i], s2n = f.q_y[i];
      // t1 = x; rotate (t2, n) into (y, z)
      const double cy = t.t2.y, sy = t.t2.z;  // t2 = (0, cy, sy), n = (0, -sy, cy)
      out[i] = {s11, cy * cy * s22 - 2 * cy * sy * s2n + sy * sy * snn, sy * sy * s22 + 2 * cy * sy * s2n + cy * cy * snn, cy * s12 - sy * s1n, cy * sy * (s22 - snn) + (cy * cy - sy * sy) * s2n,
                sy * s12 + cy * s1n};
    }
  return out;
}

StressSummary rail_stress_summary(const RollingSystem& sys, const MeanContact& m) {
  StressSummary out;
  const double contact_y = sys.model.placement.contact.point.y - sys.model.rail.origin.y;
  const BandStress b = band_stress(sys.model.rail, m.rail, contact_y);
  below_surface(b, sys.model.spec.mesh.element_size, sys.model.rail_materials.size() > 1, out);
  const std::vector<Sym3> surface = rail_surface_stress(sys, m);
  StressPair best;
  for (int j = 1; j + 1 < m.field.stations; ++j)
    for (int c = 1; c + 1 < m.field.columns; ++c) {
      const int i = j * m.field.columns + c;
      const double y = m.field.y[i] - sys.model.placement.contact.point.y;
      offer(best.von_mises, von_mises(surface[i]), m.field.x[i], y, 0);
      offer(best.sigma1, largest_principal(surface[i]), m.field.x[i], y, 0);
    }
  out.surface = best;
  return out;
}

StressSummary wheel_stress_summary(const RollingSystem& sys, const MeanContact& m) {
  StressSummary out;
  const double contact_y = sys.model.placement.contact.point.y - sys.model.wheel.origin.y;
  below_surface(band_stress(sys.model.wheel, m.wheel, contact_y), sys.model.spec.mesh.element_size, sys.model.wheel_materials.size() > 1, out);
  return out;
}

DepthLine depth_line(const BandStress& b, double x, double y) {
  DepthLine line{x, y, {}, {}, {}};
  int station = 0, column = 0;
  for (int s = 1; s < b.sample.stations; ++s)
    if (std::abs(b.x(s) - x) < std::abs(b.x(station) - x)) station = s;
  for (int c = 1; c < b.sample.columns; ++c)
    if (std::abs(b.centre_y[c] - b.contact_y - y) < std::abs(b.centre_y[column] - b.contact_y - y)) column = c;
  line.x = b.x(station);
  line.y = b.centre_y[column] - b.contact_y;
  for (int r = 0; r < b.sample.rows; ++r) {
    line.depth.push_back(b.centre_depth[r]);
    line.stress.push_back(b.at(column, r, station));
    line.material.push_back(material_of(b, column, r));
  }
  return line;
}

}  // namespace railstrata
