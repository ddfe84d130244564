#include "passes/rolled_pass.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "body/plastic_field.hpp"
#include "body/stress.hpp"
#include "core/faults.hpp"
#include "fem/rail_at_rest.hpp"
#include "model/section_axes.hpp"

namespace railstrata {
namespace {

/// Tensors of the rail's section in the axes of the rigid contact point: y in the contact plane to the field side, z
/// into the rail.
struct ContactPlane : SectionAxes {
  explicit ContactPlane(const Model& m) : SectionAxes(m, BodyId::rail) {}
  /// Components xx, yy, zz, xy, yz, xz of a tensor given in the rail's axes.
  std::array<double, 6> turned(const Sym3& s) const {
    const auto pair = [&](Vec2 a, Vec2 b) { return a.y * (s.yy * b.y + s.yz * b.z) + a.z * (s.yz * b.y + s.zz * b.z); };
    return {s.xx,
            pair(across, across),
            pair(into, into),
            s.xy * across.y + s.xz * across.z,
            pair(across, into),
            s.xy * into.y + s.xz * into.z};
  }
};

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

/// Green's strain at an element's centre, in the rail's axes.
Sym3 green_strain(const Body& rail, const Field& u, PlasticSection::Quad q, int station) {
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
  PlasticSection::Quad quad;
};

std::vector<Named> named_quads(const SweptBody& rail, PlasticSection::Quad first) {
  std::vector<Named> out{{"governing", first}};
  const ContactBand& band = rail.contact;
  if (first.block != band.block) return out;
  const std::vector<int>& material = rail.blocks[band.block].section.quad_material;
  const int column = first.quad % band.columns;
  const auto add = [&](const char* name, int row) {
    const PlasticSection::Quad q{band.block, row * band.columns + column};
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

constexpr double kStart = 6, kFarthestBehind = 6, kNearest = 4;  // half-lengths

std::string too_short(const Model& model, double a) {
  const double run_up = *model.spec.run.run_up, start = std::max(kStart * a, run_up);
  return fmt::format(
      "the run is too short: stations are steady from {:.3g} mm ({}) to {:g} half-lengths of the patch ({:.3g} mm) "
      "behind the wheel; let run.positions end at {:.3g} mm or more",
      1e3 * start,
      run_up > kStart * a ? std::string("run.run_up") : fmt::format("{:g} half-lengths of the patch", kStart), kNearest,
      1e3 * kNearest * a, 1e3 * (start + kFarthestBehind * a));
}

constexpr ResidualNumber kNumbers[] = {
    {"sigma_x_min", unit::kMPa, "Most compressive residual stress along the rail",
     [](const RunResidual& r) { return r.pass.row.stress[0]; }},
    {"sigma_x_depth", unit::kMillimetres, "Its depth", [](const RunResidual& r) { return r.pass.row.stress_depth[0]; }},
    {"sigma_y_min", unit::kMPa, "Most compressive residual stress across the rail, along the surface",
     [](const RunResidual& r) { return r.pass.row.stress[1]; }},
    {"sigma_y_depth", unit::kMillimetres, "Its depth", [](const RunResidual& r) { return r.pass.row.stress_depth[1]; }},
    {"plastic_strain", unit::kNone, "Largest equivalent plastic strain √(2/3) |E^p|",
     [](const RunResidual& r) { return r.pass.row.strain; }},
    {"balance", unit::kNone,
     "Larger resultant of the shear stresses τ_xy and τ_xz over the section, divided by the integral of |σ_x|: 0 in "
     "equilibrium",
     [](const RunResidual& r) { return r.pass.row.balance; }},
    {"steady_from", unit::kMillimetres, "First station of the mean, measured from the start of the wheel",
     [](const RunResidual& r) { return r.from; }},
    {"steady_to", unit::kMillimetres, "Last station of the mean", [](const RunResidual& r) { return r.to; }},
    {"uneven", unit::kNone,
     "Largest difference of the plastic strain between the two halves of these stations, divided by the largest "
     "plastic strain: 0 where rolling is steady",
     [](const RunResidual& r) { return r.pass.uneven; }}};

}  // namespace

RolledPass rolled_pass(const RollingSystem& sys, const Model& base, const PlasticSection& before,
                       const PlasticSection& after, const RailBefore& at_rest, double middle) {
  const ContactPlane plane(base);
  RolledPass out;
  for (std::size_t n = 0; n < after.quads.size(); ++n)
    out.points.push_back(point_of(sys, after.quads[n], plane, section_strain(sys.rail(), before, n),
                                  section_strain(sys.rail(), after, n), at_rest, middle));
  out.mesh = mesh_of(sys.rail().mesh, after.quads, plane);
  for (const PassPoint& p : out.points) add_extremes(p, out.row);
  add_displacement(sys, plane, at_rest.u, middle, out.row);
  add_balance(sys, at_rest, middle, out.row);
  return out;
}

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

std::span<const ResidualNumber> residual_numbers() { return kNumbers; }

RunResidual run_residual(const RollingSystem& system, const RollingState& end) {
  RunResidual out;
  const Model& model = system.model;
  const double a = hertz_estimate(model.spec, model.placement.contact).a, wheel = end.axle.pose().x;
  out.from = wheel - kFarthestBehind * a;
  out.to = wheel - kNearest * a;
  if (out.from < std::max(kStart * a, *model.spec.run.run_up)) {
    out.none = too_short(model, a);
    return out;
  }
  const Body& rail = system.rail();
  const PlasticHistory& history = end.bodies[kRail].history;
  const double middle = 0.5 * (out.from + out.to);
  const PlasticSection after = plastic_section(rail, history, out.from, out.to), before = on_quads({}, after);
  const bool yielded = std::any_of(after.history.begin(), after.history.end(), [](double v) { return v != 0; });
  if (!yielded) {
    out.none = "the rail has not yielded there";
    return out;
  }
  RailBefore at_rest;
  at_rest.history = history_of_section(rail, after);
  try {
    at_rest.u = rail_at_rest(system, at_rest.history, true);
  } catch (const NumericalError& e) {  // the run itself is sound
    out.none = e.what();
    return out;
  }
  out.pass = rolled_pass(system, model, before, after, at_rest, middle);
  out.pass.uneven = unevenness(before, plastic_section(rail, history, out.from, middle),
                               plastic_section(rail, history, middle, out.to));
  return out;
}

std::string describe(const RunResidual& residual) {
  if (!residual.none.empty()) return fmt::format("residual stress not available: {}", residual.none);
  const PassRow& row = residual.pass.row;
  return fmt::format(
      "residual stress behind the wheel: {:.0f} MPa along, {:.0f} MPa across where it is most compressive",
      1e-6 * row.stress[0], 1e-6 * row.stress[1]);
}

std::string doubt_of(const RunResidual& residual) {
  if (!residual.none.empty() || residual.pass.uneven <= kLargestUnevenness) return {};
  return fmt::format(
      "plastic strain varies by {:.2g} of its largest along the stations that give the residual stress: roll farther, "
      "or use `railstrata passes --engine fem` with a given creepage, which becomes steady sooner",
      residual.pass.uneven);
}

}  // namespace railstrata
