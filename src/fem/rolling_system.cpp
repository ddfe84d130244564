#include "fem/rolling_system.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/faults.hpp"

namespace railstrata {

SolidOptions solid_options(const CaseSpec& spec) {
  return {spec.mesh.element == ElementFormulation::one_point ? ElementKind::one_point : ElementKind::full,
          spec.mesh.hourglass_coefficient,
          spec.run.precision == ArithmeticPrecision::single_precision ? Precision::single_precision
                                                                      : Precision::double_precision};
}

namespace {

// Areas of the section that belong to each of its nodes.
std::vector<double> nodal_areas(const Section& s) {
  std::vector<double> area(s.nodes.size(), 0.0);
  for (const auto& q : s.quads) {
    const double a = 0.5 * cross(s.nodes[q[2]] - s.nodes[q[0]], s.nodes[q[3]] - s.nodes[q[1]]);
    for (int k : q) area[k] += 0.25 * a;
  }
  return area;
}

std::vector<EndDashpot> end_absorbers(const DeformableBody& rail) {
  const BodyLayout& lay = rail.solid.layout();
  Field coefficient = lay.field();
  const Elastic& m = rail.solid.materials().front();
  const double normal = std::sqrt(m.p_wave_modulus() * m.density), tangential = std::sqrt(m.mu * m.density);
  for (std::size_t b = 0; b < lay.blocks.size(); ++b) {
    const std::vector<double> area = nodal_areas(rail.solid.body().blocks[b].section);
    for (std::size_t n = 0; n < area.size(); ++n)
      for (int i = 0; i < 3; ++i)
        for (int j : {0, lay.blocks[b].stations - 1})
          coefficient[lay.blocks[b].line(static_cast<int>(n), i) + j] = area[n] * (i == 0 ? normal : tangential);
  }
  rail.ties.collect(coefficient);
  std::vector<EndDashpot> out;
  for (std::ptrdiff_t k = 0; k < lay.size; ++k)
    if (coefficient[k] > 0 && rail.inverse_mass[k] > 0) out.push_back({k, coefficient[k]});
  return out;
}

// A penalty rule of explicit codes, k = scale K A / V with the bulk modulus K of the rail's surface elements (A / V = 1
// / height).
double penalty_rule(const Model& model) {
  const Elastic& m = model.rail_materials[model.rail_materials.size() > 1 ? 1 : 0];
  const auto& depth = model.rail.contact.depth;
  return model.spec.contact.penalty_scale * (m.lambda + 2.0 / 3.0 * m.mu) / (depth[1] - depth[0]);
}

}  // namespace

RollingSystem::RollingSystem(const Model& m)
    : model(m),
      rail(m.rail, m.rail_materials, solid_options(m.spec)),
      wheel(m.wheel, m.wheel_materials, solid_options(m.spec)),
      gravity(m.spec.vehicle.gravity),
      rolling_radius(m.placement.contact.rolling_radius) {
  const VehicleSpec& v = m.spec.vehicle;
  const double meshed = wheel.solid.total_mass(), added = v.wheel_mass - meshed;
  if (added < 0)
    throw CaseError(fmt::format("vehicle.wheel_mass = {:.1f} kg is less than the meshed wheel alone weighs ({:.1f} kg)",
                                v.wheel_mass, meshed),
                    "give the mass of wheel and axle share together, or make the wheel lighter "
                    "(geometry.web_thickness, rim_thickness, hub_radius)");
  const BodyLayout& lay = wheel.solid.layout();
  axle.mass_z = added;
  axle.inertia = 0.5 * added * m.spec.geometry.bore_radius * m.spec.geometry.bore_radius;
  for (const SectionNode& n : m.wheel.held)
    for (int j = 0; j < lay.blocks[n.block].stations; ++j) {
      const std::ptrdiff_t index = lay.blocks[n.block].line(n.node, 0) + j;
      const Vec3 arm = wheel.solid.reference_position(n.block, n.node, j) - m.wheel.origin;
      axle.bore.push_back({index, lay.blocks[n.block].stride, arm});
      axle.mass_z += wheel.mass[index];
      axle.inertia += wheel.mass[index] * (arm.x * arm.x + arm.z * arm.z);
    }
  for (const SectionNode& n : m.wheel.held)
    for (int i = 0; i < 3; ++i)
      std::fill_n(wheel.mass.begin() + lay.blocks[n.block].line(n.node, i), lay.blocks[n.block].stations, 0.0);
  for (const SectionNode& n : m.rail.held)
    for (int i = 0; i < 3; ++i) {
      const BlockLayout& b = rail.solid.layout().blocks[n.block];
      std::fill_n(rail.mass.begin() + b.line(n.node, i), b.stations, 0.0);
    }
  axle.mass_x = axle.mass_z + (v.couple_sprung_mass ? v.sprung_mass : 0.0);

  travel_mass = v.wheel_mass + (v.couple_sprung_mass ? v.sprung_mass : 0.0);
  spin_inertia = axle.inertia;
  for (const DeformableBody::Line& l : wheel.lines)
    if (l.component == 0)
      for (int j = 0; j < l.count; ++j) {
        const double radius = wheel.solid.body().blocks[l.block].section.nodes[l.node].z;
        spin_inertia += wheel.mass[l.first + j] * radius * radius;
      }
  if (m.spec.run.rolling) start_spin = m.spec.drive.speed * (1 - m.spec.drive.creepage_start) / rolling_radius;
  const double traction = m.spec.drive.traction_coefficient * m.load;
  torque = traction * (rolling_radius + spin_inertia / (travel_mass * rolling_radius));

  absorbers = end_absorbers(rail);
  rail_surface = contact_surface(m.rail, rail.solid.layout(), [&](double s) {
    return SectionPoint{m.rail_section_point(s), m.rail_section_normal(s)};
  });
  wheel_surface = contact_surface(m.wheel, wheel.solid.layout(), [&](double s) {
    return SectionPoint{m.wheel_section_point(s), m.wheel_section_normal(s)};
  });
  penalty_stiffness = penalty_rule(m);
}

void RollingSystem::apply_constraints(Field& u_rail, Field& u_wheel, const AxlePose& pose) const {
  const double c = std::cos(pose.psi), s = std::sin(pose.psi);
  for (const BoreNode& n : axle.bore) {
    u_wheel[n.index] = pose.x + (c - 1) * n.arm.x + s * n.arm.z;
    u_wheel[n.index + n.stride] = 0;
    u_wheel[n.index + 2 * n.stride] = pose.z + (c - 1) * n.arm.z - s * n.arm.x;
  }
  for_each(6, [&](std::ptrdiff_t k) {
    const int component = static_cast<int>(k % 3);
    if (k < 3)
      wheel.ties.spread_component(u_wheel, component, c, s, false);
    else
      rail.ties.spread_component(u_rail, component, 1, 0, false);
  });
}

}  // namespace railstrata
