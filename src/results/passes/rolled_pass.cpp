#include "passes/rolled_pass.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "body/stress.hpp"
#include "material/strain_claim.hpp"
#include "result/contact_plane.hpp"

namespace railstrata {
namespace {

PassPoint point_of(const RollingSystem& sys, PlasticSection::Quad q, const ContactPlane& plane,
                   const SectionStrain& before, const SectionStrain& after, const RailBefore& at_rest, double middle) {
  const Body& rail = sys.rail();
  const Section& section = rail.mesh.blocks[q.block].section;
  const Vec2 from = centre_of(section, q.quad) - plane.point;
  PassPoint out;
  out.y = dot(from, plane.across);
  out.depth = dot(from, plane.into);
  if (const ContactBand& band = rail.mesh.contact; band.block == q.block) {
    out.row = q.quad / band.columns;
    out.column = q.quad % band.columns;
  }
  out.zone = rail.mesh.layer_of(section.quad_material[q.quad]);
  out.strain = {after.accumulated - before.accumulated, net_strain(before.plastic.data(), after.plastic.data())};
  out.accumulated = after.accumulated;
  const auto& e = after.plastic;  // 11, 22, 33, 12, 23, 13
  out.plastic = plane.turned({e[0], e[1], e[2], e[3], e[4], e[5]});
  const int station = rail.mesh.blocks[q.block].stations.element_at(middle);
  out.stress = plane.turned(element_stress(rail, at_rest.u, at_rest.history, q.block, q.quad, station));
  return out;
}

/// Corners of the quadrilaterals, each node once.
SectionMesh mesh_of(const SweptBody& rail, const std::vector<PlasticSection::Quad>& quads, const ContactPlane& plane) {
  SectionMesh out;
  std::map<std::pair<int, int>, int> number;  // of (block, node)
  for (const PlasticSection::Quad& q : quads) {
    const Section& section = rail.blocks[q.block].section;
    std::array<int, 4> corners{};
    for (std::size_t k = 0; k < 4; ++k) {
      const int node = section.quads[q.quad][k];
      const auto [at, is_new] = number.try_emplace({q.block, node}, static_cast<int>(out.nodes.size()));
      corners[k] = at->second;
      if (!is_new) continue;
      const Vec2 from = section.nodes[node] - plane.point;
      out.nodes.push_back({dot(from, plane.across), dot(from, plane.into)});
    }
    out.quads.push_back(corners);
  }
  return out;
}

/// Over the whole section: the force along the rail, and the resultants of the shear stresses, which nothing holds.
void add_balance(const RollingSystem& sys, const RailBefore& at_rest, double middle, PassRow& row) {
  const Body& rail = sys.rail();
  double magnitude = 0;
  Vec2 shear{};
  for (int b = 0; b < static_cast<int>(rail.mesh.blocks.size()); ++b) {
    const Block& block = rail.mesh.blocks[b];
    const int station = block.stations.element_at(middle);
    for (int q = 0; q < static_cast<int>(block.section.quads.size()); ++q) {
      const Sym3 s = element_stress(rail, at_rest.u, at_rest.history, b, q, station);
      const double area = quad_area(block.section, block.section.quads[q]);
      row.force += s.xx * area;
      magnitude += std::abs(s.xx) * area;
      shear = shear + area * Vec2{s.xy, s.xz};
    }
  }
  row.balance = magnitude > 0 ? std::max(std::abs(shear.y), std::abs(shear.z)) / magnitude : 0;
}

void add_displacement(const RollingSystem& sys, const ContactPlane& plane, const Field& u, double middle,
                      PassRow& row) {
  const ContactSurface& surface = sys.rail_surface();
  const auto larger = [](double& most, double value) {
    if (std::abs(value) > std::abs(most)) most = value;
  };
  const int station = surface.stations.element_at(middle);
  for (int column = 0; column < surface.columns; ++column) {
    const Vec3 at = vector_at(u, surface.index(column, station), surface.stride);
    larger(row.forward, at.x);
    larger(row.lateral, at.y * plane.across.y + at.z * plane.across.z);
    larger(row.sinking, at.y * plane.into.y + at.z * plane.into.z);
  }
}

void add_extremes(const std::vector<PassPoint>& points, PassRow& row) {
  for (const PassPoint& p : points) {
    row.largest.accumulated = std::max(row.largest.accumulated, p.strain.accumulated);
    row.strain = std::max(row.strain, equivalent_strain(p.plastic.data()));
    if (p.strain.net > row.largest.net) {
      row.largest.net = p.strain.net;
      row.net_y = p.y;
      row.net_depth = p.depth;
    }
    for (std::size_t c = 0; c < 2; ++c)
      if (p.stress[c] < row.stress[c]) {
        row.stress[c] = p.stress[c];
        row.stress_depth[c] = p.depth;
      }
  }
}

}  // namespace

RolledPass rolled_pass(const RollingSystem& sys, const Model& base, const PlasticSection& before,
                       const PlasticSection& after, const RailBefore& at_rest, double middle) {
  const ContactPlane plane(base);
  RolledPass out;
  for (std::size_t n = 0; n < after.quads.size(); ++n)
    out.points.push_back(point_of(sys, after.quads[n], plane, section_strain(sys.rail(), before, n),
                                  section_strain(sys.rail(), after, n), at_rest, middle));
  out.mesh = mesh_of(sys.rail().mesh, after.quads, plane);
  add_extremes(out.points, out.row);
  add_displacement(sys, plane, at_rest.u, middle, out.row);
  add_balance(sys, at_rest, middle, out.row);
  return out;
}

std::string unevenness_text(double uneven) {
  if (uneven <= kLargestUnevenness) return {};
  return fmt::format(
      "plastic strain varies by {:.2g} of itself along the steady stations: use a smaller mesh.element_size, with at "
      "least five elements over the patch, or a longer way to them",
      uneven);
}

double unevenness(const PlasticSection& before, const PlasticSection& first, const PlasticSection& second) {
  const std::size_t points = first.quads.size() * kGaussPairs;
  double largest = 0, difference = 0;
  for (std::size_t n = 0; n < points; ++n) {
    const std::size_t at = n * static_cast<std::size_t>(first.point_entries);
    std::array<double, 6> step{}, apart{};
    for (std::size_t i = 0; i < 6; ++i) {
      const double is = 0.5 * (first.history[at + i] + second.history[at + i]);
      step[i] = is - before.history[at + i];
      apart[i] = second.history[at + i] - first.history[at + i];
    }
    largest = std::max(largest, double_contraction(step.data(), step.data()));
    difference = std::max(difference, double_contraction(apart.data(), apart.data()));
  }
  return largest > 0 ? std::sqrt(difference / largest) : 0;
}

}  // namespace railstrata
