#include "capi/state_of_case.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string_view>

#include "core/faults.hpp"
#include "options/option_table.hpp"

namespace railstrata::capi {
namespace {

/// The option of a key "table.option".
const Option& option_of(std::string_view key) {
  const std::size_t dot = key.find('.');
  for (const Option& option : find_table(key.substr(0, dot))->options)
    if (option.key == key.substr(dot + 1)) return option;
  throw std::logic_error(fmt::format("no option {}", key));
}

/// A member of the state and the key of the case that it stands for.
struct Member {
  unsigned bit;
  double rs_state::*value;
  std::string_view name, key;
  double step;  ///< of differences, in the member's unit
};
constexpr Member kMembers[] = {
    {RS_APPROACH, &rs_state::approach, "approach", "vehicle.approach", 1e-10},
    {RS_LATERAL_SHIFT, &rs_state::lateral_shift, "lateral_shift", "geometry.lateral_shift", 1e-08},
    {RS_YAW, &rs_state::yaw, "yaw", "geometry.yaw", 1e-07},
    {RS_ROLL, &rs_state::roll, "roll", "geometry.roll", 1e-07},
    {RS_SPEED, &rs_state::speed, "speed", "drive.speed", 0.0001},
    {RS_FRICTION, &rs_state::friction, "friction", "drive.friction_coefficient", 1e-07},
    {RS_CREEPAGE_X, &rs_state::creepage_x, "creepage_x", "drive.creepage", 1e-08},
    {RS_CREEPAGE_Y, &rs_state::creepage_y, "creepage_y", "drive.lateral_creepage", 1e-08},
    {RS_SPIN, &rs_state::spin, "spin", "drive.spin", 1e-06}};
constexpr unsigned kAllBits = RS_LOAD | RS_APPROACH | RS_LATERAL_SHIFT | RS_YAW | RS_ROLL | RS_SPEED | RS_FRICTION |
                              RS_CREEPAGE_X | RS_CREEPAGE_Y | RS_SPIN | RS_FORCE_X | RS_FORCE_Y;

void put(CaseSpec& spec, const Member& m, double value) {
  const Option& option = option_of(m.key);
  if (!std::isfinite(value) || !option.range.holds(value))
    throw CaseError(fmt::format("rs_state.{} = {:g} is out of range", m.name, value),
                    fmt::format("give a value {}", describe(option.range, option.dimension)), std::string(m.key));
  const Slot slot = option.slot(spec, 0);
  if (const auto* number = std::get_if<double*>(&slot))
    **number = value;
  else
    *std::get<std::optional<double>*>(slot) = value;
}

void require_one_of(const rs_state& s, unsigned one, unsigned other, std::string_view text) {
  if ((s.given & one) && (s.given & other))
    throw CaseError(fmt::format("rs_state.given has both {}", text), "set one of the two bits");
}

/// A drive of a case at rest would be void, its forces zero.
void require_rolling(const rs_state& s, const CaseSpec& spec) {
  constexpr unsigned kDrive = RS_CREEPAGE_X | RS_CREEPAGE_Y | RS_SPIN | RS_FORCE_X | RS_FORCE_Y;
  if (spec.run.rolling || !(s.given & kDrive)) return;
  throw CaseError("rs_state gives a creepage, a spin or a force, and the case is at rest, without friction",
                  "take out run.rolling = false, or give the load and the position alone", "run.rolling");
}

double number(double value, std::string_view name, bool positive) {
  if (std::isfinite(value) && (!positive || value > 0)) return value;
  throw CaseError(fmt::format("rs_state.{} = {:g} is no force that can be used", name, value),
                  positive ? "give a force above 0 N" : "give a finite force in N");
}

/// The load, all of it sprung (the wheel's mass would count in finite elements alone); other drives of the direction
/// are taken back.
void put_forces(const rs_state& s, CaseSpec& spec) {
  if (s.given & RS_LOAD) {
    spec.vehicle.wheel_mass = 0;
    spec.vehicle.set_load(number(s.load, "load", true));
  }
  if ((s.given & (RS_FORCE_X | RS_FORCE_Y)) && spec.vehicle.approach)
    throw CaseError("forces cannot be given together with an approach: the load that bears them is a result",
                    "give creepages, or a load", "vehicle.approach");
  const double load = spec.vehicle.load();
  if (s.given & RS_FORCE_X) {
    spec.drive.creepage.reset();
    spec.drive.traction_coefficient = number(s.force_x, "force_x", false) / load;
  }
  if (s.given & RS_FORCE_Y) {
    spec.drive.lateral_creepage.reset();
    spec.drive.lateral_traction_coefficient = number(s.force_y, "force_y", false) / load;
  }
}

}  // namespace

CaseSpec with_state(CaseSpec spec, const rs_state& s) {
  if (s.size != sizeof(rs_state))
    throw CaseError(fmt::format("rs_state.size = {} is of another version of the library", s.size),
                    "set size = sizeof(rs_state), and compile with this version's railstrata.h");
  if (s.given & ~kAllBits)
    throw CaseError(fmt::format("rs_state.given = {} has bits that have no meaning", s.given),
                    "use RS_LOAD, RS_APPROACH and so on");
  require_one_of(s, RS_LOAD, RS_APPROACH, "RS_LOAD and RS_APPROACH");
  require_one_of(s, RS_CREEPAGE_X, RS_FORCE_X, "RS_CREEPAGE_X and RS_FORCE_X");
  require_one_of(s, RS_CREEPAGE_Y, RS_FORCE_Y, "RS_CREEPAGE_Y and RS_FORCE_Y");
  require_rolling(s, spec);
  for (const Member& m : kMembers)
    if (s.given & m.bit) put(spec, m, s.*m.value);
  if (s.given & RS_CREEPAGE_Y) spec.drive.lateral_traction_coefficient.reset();
  put_forces(s, spec);
  return spec;
}

namespace {

[[noreturn]] void refuse_result(std::string_view name, std::string_view instead) {
  throw CaseError(fmt::format("{} is a result of the last state, not an input", name),
                  fmt::format("ask for the derivative by {}, or give {} in rs_state", instead, name));
}

void refuse_results(unsigned bit, const CaseSpec& spec) {
  const bool pressed = spec.vehicle.approach.has_value(), pulled = spec.drive.traction().has_value(),
             pushed = spec.drive.lateral_traction_coefficient.has_value();
  if (bit == RS_LOAD && pressed) refuse_result("load", "RS_APPROACH");
  if (bit == RS_APPROACH && !pressed) refuse_result("approach", "RS_LOAD");
  if (bit == RS_CREEPAGE_X && pulled) refuse_result("creepage_x", "RS_FORCE_X");
  if (bit == RS_CREEPAGE_Y && pushed) refuse_result("creepage_y", "RS_FORCE_Y");
  if (bit == RS_FORCE_X && !pulled) refuse_result("force_x", "RS_CREEPAGE_X");
  if (bit == RS_FORCE_Y && !pushed) refuse_result("force_y", "RS_CREEPAGE_Y");
}

double value_in(const CaseSpec& spec, const Member& m, double absent) {
  CaseSpec copy = spec;
  const Slot slot = option_of(m.key).slot(copy, 0);
  if (const auto* number = std::get_if<double*>(&slot)) return **number;
  return std::get<std::optional<double>*>(slot)->value_or(absent);
}

}  // namespace

Input input_of(const rs_state& s, unsigned bit, const CaseSpec& spec, const BemResult& result) {
  constexpr double kOfLoad = 1e-6;
  refuse_results(bit, spec);
  const double load = spec.vehicle.load();
  const auto force = [&](double rs_state::*member, double value) {
    return Input{member, s.given & bit ? s.*member : value, kOfLoad * load};
  };
  if (bit == RS_LOAD) return force(&rs_state::load, load);
  if (bit == RS_FORCE_X) return force(&rs_state::force_x, spec.drive.traction().value_or(0) * load);
  if (bit == RS_FORCE_Y) return force(&rs_state::force_y, spec.drive.lateral_traction_coefficient.value_or(0) * load);
  for (const Member& m : kMembers) {
    if (m.bit != bit) continue;
    const double absent = bit == RS_CREEPAGE_X   ? result.rigid_slip.x
                          : bit == RS_CREEPAGE_Y ? result.rigid_slip.y
                                                 : result.rigid_slip.spin;
    return {m.value, s.given & bit ? s.*m.value : value_in(spec, m, absent), m.step};
  }
  throw CaseError(fmt::format("{} is no input of rs_state", bit), "give RS_LOAD, RS_YAW and so on, one bit each");
}

}  // namespace railstrata::capi
