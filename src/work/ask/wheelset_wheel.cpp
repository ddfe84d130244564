#include "ask/wheelset_wheel.hpp"

#include <cmath>

#include "ask/wheelset_forces.hpp"
#include "bem/contact_places.hpp"

namespace railstrata {
namespace {

WheelsetMotion motion_of(const WheelsetState& s, double roll, std::size_t side) {
  return {s.y,      s.z.value_or(0), s.yaw,      roll,        s.speed,
          s.y_rate, s.z_rate,        s.yaw_rate, s.roll_rate, s.pitch_rate + s.wheel_pitch_rate[side]};
}

RailMotion rail_of(const WheelsetState& s, std::size_t side) {
  return {s.rail_y[side],      s.rail_z[side],      s.rail_roll[side],
          s.rail_y_rate[side], s.rail_z_rate[side], s.rail_yaw[side]};
}

}  // namespace

void turn(Wheel& w, std::size_t side, const WheelsetState& state, double roll) {
  w.motion = motion_of(state, roll, side);
  w.rail = rail_of(state, side);
  if (side == kRight) {
    w.motion = mirrored(w.motion);
    w.rail = mirrored(w.rail);
  }
  if (state.speed < 0) {
    w.motion = reversed(w.motion);
    w.rail = reversed(w.rail);
  }
}

void place(Wheel& w, std::size_t side, const WheelsetState& state, double roll, const HeldPlace& held,
           const KnownPlace& known) {
  turn(w, side, state, roll);
  const Placement& p = w.contact.placement();
  w.contact.move_to(track_under(p.wheel, p.rail, w.at_rest, w.motion, w.rail), held, known);
}

double descent_at(const Wheel& w, double z) {
  WheelsetMotion m = w.motion;
  m.z = z;
  return descent(w.track(), w.touching(), m, w.rail);
}

State state_under(Wheel& w, double descent) {
  w.reference = descent > 0 ? reference_of(w.contact.placement(), descent) : w.touching();
  const WheelSlip slip = slip_at(w.track(), w.reference, w.motion, w.rail);
  State out;
  out.approach = descent * std::cos(w.reference.angle);
  out.speed = slip.speed;
  out.rolling_share = w.motion.speed / slip.speed;
  out.creepage_x = slip.creepage_x;
  out.creepage_y = slip.creepage_y;
  out.spin = slip.spin;
  out.descent = descent;
  return out;
}

void press(Wheel& w, double descent, bool extrapolate, bool keep_cells) {
  State state = state_under(w, descent);
  state.extrapolate = extrapolate;
  state.keep_cells = keep_cells;
  w.forces = w.contact.solve(state);
  const Wrench carried = carried_by(w);
  w.force = carried.force;
  w.moment = carried.moment;
}

}  // namespace railstrata
