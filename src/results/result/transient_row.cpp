#include "result/transient_row.hpp"

#include <fmt/format.h>

#include "result/patch.hpp"
#include "result/summary.hpp"

namespace railstrata {

TransientRow transient_row(const TransientState& state) {
  const BemResult& r = state.result;
  const bool shift = r.field.slip_is_distance;
  TransientRow row;
  row.step = state.step;
  row.distance = state.distance;
  row.time = state.time;
  row.load = state.moment.load;
  ContactSummary c;
  c.F_y = 0.0 - r.force.y;
  c.F_z = 0.0 - r.force.z;
  turn_into_contact_plane(c, r.contact.angle);
  row.F_x = 0.0 - r.force.x;
  row.F_y = c.F_y;
  row.F_z = c.F_z;
  row.normal_force = c.normal_force;
  row.lateral_force = c.lateral_force;
  row.spin_moment = 0.0 - r.force.moment;
  row.creepage_x = shift ? kNotApplicable : r.rigid_slip.x;
  row.creepage_y = shift ? kNotApplicable : r.rigid_slip.y;
  row.spin = shift ? kNotApplicable : r.rigid_slip.spin;
  row.displacement_x = state.displacement_x;
  row.displacement_y = state.displacement_y;
  row.approach = r.approach;
  row.p_max = measure_patch(r.field).p_max;
  row.q_max = shear_at_front_of_slip(r.field);
  row.contact_area = r.patch.area;
  row.slip_area = r.patch.slip_area;
  row.stick_area = r.patch.area - r.patch.slip_area;
  row.friction_power = shift ? kNotApplicable : r.dissipation;
  row.friction_work = state.friction_work;
  return row;
}

std::string state_text(const CaseSpec& spec, const TransientState& state) {
  if (spec.transient.kind == TransientKind::shift)
    return fmt::format("after {} of {} increments of a shift", state.step, state.steps);
  return fmt::format("after {:.6g} mm of rolling from {}", 1e3 * state.distance,
                     spec.transient.start == TransientStart::steady ? "steady rolling" : "rest");
}

}  // namespace railstrata
