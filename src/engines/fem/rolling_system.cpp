#include "fem/rolling_system.hpp"

#include <fmt/format.h>

#include <cmath>

#include "body/traversal.hpp"
#include "core/faults.hpp"
#include "fem/lateral_start.hpp"
#include "fem/plastic_zone.hpp"
#include "rules/support.hpp"

namespace railstrata {

namespace {

// Areas of the section that belong to each of its nodes.
std::vector<double> nodal_areas(const Section& s) {
  std::vector<double> area(s.nodes.size(), 0.0);
  for (const auto& q : s.quads) {
    const double a = quad_area(s, q);
    for (int k : q) area[k] += 0.25 * a;
  }
  return area;
}

std::vector<EndLoad> end_loads_of(const Body& rail) {
  if (rail.initial_stress.empty()) return {};
  Field undeformed = rail.layout.field(), f = rail.layout.field();
  Traversal(rail).internal_force(undeformed, 0, f, initial_history(rail));
  rail.ties.apply_transpose(f);
  std::vector<EndLoad> out;
  for (const NodeLine& l : rail.lines)
    if (l.component == 0)
      for (int j : {0, l.count - 1}) out.push_back({l.first + j, f[l.first + j]});
  return out;
}

// The lines of prescribed nodes carry no mass of their own: the foundation or the axle has it.
void clear_prescribed_mass(Body& body) {
  for (const SectionNode& n : body.mesh.prescribed) {
    const BlockLayout& b = body.layout.blocks[n.block];
    for (int i = 0; i < 3; ++i) std::fill_n(body.mass.begin() + b.line(n.node, i), b.stations, 0.0);
  }
}

std::vector<BoreNode> bore_nodes(const Body& body) {
  std::vector<BoreNode> out;
  for (const SectionNode& n : body.mesh.prescribed) {
    const BlockLayout& lay = body.layout.blocks[n.block];
    for (int j = 0; j < lay.stations; ++j)
      out.push_back(
          {lay.line(n.node, 0) + j, lay.stride, reference_position(body, n.block, n.node, j) - body.mesh.origin});
  }
  return out;
}

// The axle as a solid shaft of the bore's radius and what is not meshed, with the nodes of the bore.
Axle axle_of(const Body& wheel, const CaseSpec& spec) {
  const VehicleSpec& v = spec.vehicle;
  const double meshed = total_mass(wheel), added = v.wheel_mass - meshed;
  if (added < 0)
    throw CaseError(
        fmt::format("vehicle.wheel_mass = {:.1f} kg is less than the meshed wheel alone weighs ({:.1f} kg)",
                    v.wheel_mass, meshed),
        "give the mass of wheel and axle share together, or make the wheel lighter (geometry.web_thickness, "
        "rim_thickness, hub_radius)");
  Axle axle;
  axle.mass_z = added;
  const double bore = spec.geometry.wheel_section.bore_radius;
  axle.inertia = 0.5 * added * bore * bore;
  axle.bore = bore_nodes(wheel);
  for (const BoreNode& n : axle.bore) {
    axle.mass_z += wheel.mass[n.index];
    axle.inertia += wheel.mass[n.index] * (n.arm.x * n.arm.x + n.arm.z * n.arm.z);
  }
  axle.mass_x = axle.mass_z + (v.couple_sprung_mass ? v.sprung_mass : 0.0);
  return axle;
}

/// Sixteen times the time constant of the fastest shear vibration of the rail's surface, whose angular frequency is 2
/// c_s/h.
double vibration_time(const CaseSpec& spec) {
  constexpr double kTimes = 16;
  const MaterialSpec& m = spec.rail_material;
  return kTimes * 0.5 * spec.mesh.element_size * std::sqrt(2 * (1 + m.poisson) * m.density / m.young);
}

ExplicitOptions explicit_options(const Model& m) {
  const CaseSpec& spec = m.spec;
  ExplicitOptions out;
  const DriveSpec& drive = spec.drive;
  const RigidContact& contact = m.reference;
  out.keeps_pace = drive.creepage.has_value();
  const LateralStart lateral = lateral_start(m);
  out.free_sideways = drive.lateral_traction_coefficient.has_value();
  if (lateral.creepage != 0)
    out.lateral_speed = drive.speed * (lateral.creepage * std::cos(contact.angle) + std::tan(contact.yaw));
  out.lateral_friction = lateral.friction;
  out.contact.friction = {spec.drive.friction_coefficient, third_body(spec), falling_friction(spec)};
  out.contact.friction.lateral_share = lateral_friction_share(spec);
  out.contact.slip_time = vibration_time(spec);
  return out;
}

ContactSurface rail_surface_of(const Model& m, const Body& rail) {
  const Vec3 origin = m.rail.origin;
  const bool rises = m.rail.rises();
  return contact_surface(m.rail, rail.layout, [&, origin, rises](double s) {
    const Vec2 p = m.rail_section_point(s), n = m.rail_section_normal(s);
    return rises ? SectionPoint{{p.y, origin.z - p.z}, {n.y, -n.z}} : SectionPoint{p, n};
  });
}

ContactSurface wheel_surface_of(const Model& m, const Body& wheel) {
  return contact_surface(m.wheel, wheel.layout, [&](double s) {
    return SectionPoint{m.wheel_section_point(s), m.wheel_section_normal(s)};
  });
}

}  // namespace

ElementOptions element_options(const CaseSpec& spec) {
  return {spec.mesh.element == ElementFormulation::one_point ? ElementKind::one_point : ElementKind::full,
          spec.run.precision == ArithmeticPrecision::single_precision ? Precision::single_precision
                                                                      : Precision::double_precision};
}

std::vector<EndDashpot> end_absorbers(const Body& rail) {
  const BodyLayout& lay = rail.layout;
  Field coefficient = lay.field();
  const Elastic& m = rail.materials.front();
  const double normal = std::sqrt(m.p_wave_modulus() * m.density), tangential = std::sqrt(m.mu * m.density);
  for (std::size_t b = 0; b < lay.blocks.size(); ++b) {
    const std::vector<double> area = nodal_areas(rail.mesh.blocks[b].section);
    for (std::size_t n = 0; n < area.size(); ++n)
      for (int i = 0; i < 3; ++i)
        for (int j : {0, lay.blocks[b].stations - 1})
          coefficient[lay.blocks[b].line(static_cast<int>(n), i) + j] = area[n] * (i == 0 ? normal : tangential);
  }
  rail.ties.apply_transpose(coefficient);
  std::vector<EndDashpot> out;
  for (std::ptrdiff_t k = 0; k < lay.size; ++k)
    if (coefficient[k] > 0 && rail.inverse_mass[k] > 0) out.push_back({k, coefficient[k]});
  return out;
}

RollingSystem::RollingSystem(const Model& m)
    : model((require_support(uses::kFiniteElements, m.spec), m)),
      options(explicit_options(m)),
      bodies{Body(m.rail, m.rail_materials, element_options(m.spec)),
             Body(m.wheel, m.wheel_materials, element_options(m.spec))},
      axle(axle_of(wheel(), m.spec)),
      rolling_radius(m.placement.contact.rolling_radius) {
  for (Body& b : bodies) clear_prescribed_mass(b);
  for (const BodyId id : kBodies) {
    bodies[index_of(id)].plastic = plastic_zone(m, id, body(id));
    bodies[index_of(id)].initial_stress = initial_stress(m, id, body(id).mesh);
  }
  const VehicleSpec& v = m.spec.vehicle;
  travel_mass = v.wheel_mass + (v.couple_sprung_mass ? v.sprung_mass : 0.0);
  spin_inertia = axle.inertia;
  for (const NodeLine& l : wheel().lines) {
    if (l.component != 0) continue;
    const double radius = line_radius(wheel(), l.block, l.node);
    for (int j = 0; j < l.count; ++j) spin_inertia += wheel().mass[l.first + j] * radius * radius;
  }
  const DriveSpec& drive = m.spec.drive;
  if (m.spec.run.rolling)
    start_spin = drive.creepage ? drive.speed * (1 - *drive.creepage) / m.reference.rolling_radius
                                : drive.speed * (1 - drive.creepage_start) / rolling_radius;
  const double traction = drive.traction().value_or(0) * m.load;
  torque = traction * (rolling_radius + (on_ring() ? 0.0 : spin_inertia / (travel_mass * rolling_radius)));
  if (on_ring()) {
    rail_bore = bore_nodes(rail());
    if (m.spec.run.rolling) rail_spin = -drive.speed / (m.placement.contact.point.z - rail().mesh.origin.z);
  } else {
    absorbers = end_absorbers(rail());
    end_loads = end_loads_of(rail());
    pads = rail_pads(rail(), m.spec.track.support);
  }
  surfaces = {rail_surface_of(m, rail()), wheel_surface_of(m, wheel())};
  for (const BodyId id : kBodies) {
    ContactSurface& surface = surfaces[index_of(id)];
    surface.heights = {m.spec.irregularities, id, m.spec.geometry.wheel_radius};
    surface.first_contact_y = m.placement.contact.point.y;
  }
  if (m.spec.run.rolling && !on_ring())
    watched_points = railstrata::watched_points(m.spec, rail().mesh, m.x_end, m.hertz.a);
  if (const std::vector<TablePoint>& across = m.spec.friction.lateral_table; !across.empty())
    for (int c = 0; c < rail_surface().columns; ++c)
      options.contact.coefficient_across.push_back(
          over_table(across, model_to_rail(m.placement.track, rail_surface().at_contact(c)).y));
  const double yaw_angle = m.placement.contact.yaw;
  surfaces[kWheel].yaw = {std::cos(yaw_angle), std::sin(yaw_angle)};
}

double foot_height(const RollingSystem& system, double x, const Field& u) {
  if (system.pads.none()) return 0;
  return mean_height(spread_along(system.rail(), system.rail().mesh.on_pads, x, 0), u);
}

void RollingSystem::apply_constraints(Field& u_rail, Field& u_wheel, const AxlePose& pose,
                                      const std::array<TiedPart*, 2>& parts) const {
  const Rotation<double> turn = rotation_by(pose.psi);
  for (const BoreNode& n : axle.bore) {
    const auto shift = rigid_displacement({pose.x, pose.z}, turn, {n.arm.x, n.arm.z});
    u_wheel[n.index] = shift.x;
    u_wheel[n.index + n.stride] = pose.y;
    u_wheel[n.index + 2 * n.stride] = shift.z;
  }
  const TiedField tied[] = {{.ties = rail().ties, .values = u_rail, .part = parts[kRail]},
                            {.ties = wheel().ties, .values = u_wheel, .turn = turn, .part = parts[kWheel]}};
  spread_ties(tied);
}

}  // namespace railstrata
