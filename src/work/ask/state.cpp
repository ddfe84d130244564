#include "ask/state.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>

#include "core/faults.hpp"
#include "geometry/wheelset.hpp"

namespace railstrata {
namespace {

/// The option of a member with its key, "table.option".
struct OptionOfMember {
  const Option* option = nullptr;
  std::string key;
};
const OptionOfMember& option_of(const StateMember& member) {
  static const auto kOptions = [] {
    std::array<OptionOfMember, kState.size()> out;
    for (std::size_t k = 0; k < out.size(); ++k)
      for (const OptionTable& table : case_tables())
        for (const Option& option : table.options)
          if (kState[k].in_case && option.slot == kState[k].in_case && !option.derivation)
            out[k] = {&option, fmt::format("{}.{}", table.name, option.key)};
    return out;
  }();
  return kOptions[static_cast<std::size_t>(&member - kState.data())];
}

std::optional<double> value_in(const CaseSpec& spec, const StateMember& member) {
  const Slot slot = member.in_case(const_cast<CaseSpec&>(spec), 0);  // only read
  if (const auto* number = std::get_if<double*>(&slot)) return **number;
  return *std::get<std::optional<double>*>(slot);
}

void put(CaseSpec& spec, const StateMember& member, std::optional<double> value) {
  const Slot slot = member.in_case(spec, 0);
  if (const auto* number = std::get_if<double*>(&slot))
    **number = *value;
  else
    *std::get<std::optional<double>*>(slot) = value;
}

void require_range(const StateMember& member, double value) {
  const auto& [option, key] = option_of(member);
  if (!std::isfinite(value) || !option->range.holds(value))
    throw CaseError(fmt::format("{} = {:g} is out of range", member.name, value),
                    fmt::format("give a value {}", describe(option->range, option->dimension)), key);
}

void require_one_of(const std::optional<double>& one, const std::optional<double>& other, std::string_view names) {
  if (one && other) throw CaseError(fmt::format("{} are both given", names), fmt::format("give one of {}", names));
}

/// A drive of a case at rest would be void, its forces zero.
void require_rolling(const State& s, const CaseSpec& spec) {
  if (spec.run.rolling || !(s.creepage_x || s.creepage_y || s.spin || s.force_x || s.force_y)) return;
  throw CaseError("the state gives a creepage, a spin or a force, and the case is at rest, without friction",
                  "take out run.rolling = false, or give the load and the position alone", "run.rolling");
}

double force(double value, std::string_view name, bool positive) {
  if (std::isfinite(value) && (!positive || value > 0)) return value;
  throw CaseError(fmt::format("{} = {:g} is no force that can be used", name, value),
                  positive ? "give a force above 0 N" : "give a finite force in N");
}

/// The load, all of it sprung: the wheel's mass counts in finite elements alone. Other drives of the direction are
/// taken back.
void put_forces(const State& s, CaseSpec& spec) {
  if (s.load) {
    spec.vehicle.wheel_mass = 0;
    spec.vehicle.set_load(force(*s.load, "load", true));
  }
  if ((s.force_x || s.force_y) && spec.vehicle.approach)
    throw CaseError("forces cannot be given together with an approach: the load that bears them is a result",
                    "give creepages, or a load", "vehicle.approach");
  const double load = spec.vehicle.load();
  if (s.force_x) {
    spec.drive.creepage.reset();
    spec.drive.traction_coefficient = force(*s.force_x, "force_x", false) / load;
  }
  if (s.force_y) {
    spec.drive.lateral_creepage.reset();
    spec.drive.lateral_traction_coefficient = force(*s.force_y, "force_y", false) / load;
  }
}

/// Of two members one is given, the other a result.
void refuse_result(const StateMember& member, const CaseSpec& spec) {
  const bool pressed = spec.vehicle.approach.has_value(), pulled = spec.drive.traction().has_value(),
             pushed = spec.drive.lateral_traction_coefficient.has_value();
  const struct {
    std::optional<double> State::*result;
    const char* given;
  } rivals[] = {{pressed ? &State::load : &State::approach, pressed ? "approach" : "load"},
                {pulled ? &State::creepage_x : &State::force_x, pulled ? "force_x" : "creepage_x"},
                {pushed ? &State::creepage_y : &State::force_y, pushed ? "force_y" : "creepage_y"}};
  for (const auto& [result, given] : rivals)
    if (member.at == result)
      throw CaseError(fmt::format("{} is a result of the last state, not an input", member.name),
                      fmt::format("ask for the derivative by {}, or give {} in the state", given, member.name));
}

}  // namespace

void set_state(const State& s, const CaseSpec& base, CaseSpec& out) {
  require_one_of(s.load, s.approach, "load and approach");
  require_one_of(s.creepage_x, s.force_x, "creepage_x and force_x");
  require_one_of(s.creepage_y, s.force_y, "creepage_y and force_y");
  require_rolling(s, base);
  out.vehicle = base.vehicle;
  out.drive = base.drive;
  out.drive.rolling_share = s.rolling_share;
  for (const StateMember& member : kState) {
    if (!member.in_case) continue;
    std::optional<double> given = s.*member.at;
    if (given && member.at == &State::speed) given = reference_speed(*given);
    if (given) require_range(member, *given);
    put(out, member, given ? given : value_in(base, member));
  }
  if (s.creepage_y) out.drive.lateral_traction_coefficient.reset();
  put_forces(s, out);
}

double value_in_state(const StateMember& member, const State& state, const CaseSpec& spec, const BemResult& result) {
  refuse_result(member, spec);
  if (state.*member.at) return *(state.*member.at);
  const double load = spec.vehicle.load();
  if (member.at == &State::load) return load;
  if (member.at == &State::force_x) return spec.drive.traction().value_or(0) * load;
  if (member.at == &State::force_y) return spec.drive.lateral_traction_coefficient.value_or(0) * load;
  const double absent = member.at == &State::creepage_x   ? result.rigid_slip.x
                        : member.at == &State::creepage_y ? result.rigid_slip.y
                                                          : result.rigid_slip.spin;
  return value_in(spec, member).value_or(absent);
}

double step_of(const StateMember& member, const CaseSpec& spec) {
  return member.in_case ? member.step : member.step * spec.vehicle.load();
}

}  // namespace railstrata
