#include <fmt/format.h>

#include <optional>

#include "bem/contact_derivative.hpp"
#include "capi/contact.hpp"
#include "capi/guarded.hpp"
#include "capi/state_of_case.hpp"
#include "judge/bem_summary.hpp"

using namespace railstrata;

namespace {

/// The case of the last state with one input moved.
struct Moved {
  CaseSpec spec;
  std::optional<Placement> placement;  ///< none: that of the last state
  const Placement& unmoved;
  PlacedCase there() const { return {spec, placement ? *placement : unmoved}; }
};
Moved moved(const rs_contact& contact, const capi::Input& input, unsigned bit, double by, const PlacedCase& here) {
  rs_state state = *contact.state;
  state.given |= bit;
  state.*input.member = input.value + by;
  Moved out{capi::with_state(contact.loaded.spec, state), {}, here.placement};
  if (!capi::same_place(out.spec.geometry, here.spec.geometry)) out.placement = capi::placed(contact, out.spec);
  return out;
}

/// Forces on the wheel are those on the rail turned round.
void fill(const ContactDerivative& d, rs_derivatives& out) {
  out.force_x = -d.force.x;
  out.force_y = -d.force.y;
  out.force_z = -d.force.z;
  out.normal_force = d.force.normal;
  out.lateral_force = -d.force.tangential;
  out.spin_moment = -d.force.moment;
  out.creepage_x = d.creepage_x;
  out.creepage_y = d.creepage_y;
  out.spin = d.spin;
  out.approach = d.approach;
  out.contact_angle = d.angle;
}

/// The same as differences of two solutions.
void difference(const rs_contact& contact, const capi::Input& input, unsigned bit, BemOptions options,
                const PlacedCase& here, rs_derivatives& out) {
  constexpr double kTolerance = 1e-10, kLonger = 30;  // a step that its errors allow
  capi::set_tolerance(options, kTolerance);
  const double step = kLonger * input.step;
  const auto forces = [&](double by) {
    const Moved there = moved(contact, input, bit, by, here);
    const BemResult result = solve_bem(there.spec, there.there().placement, options);
    return capi::forces_of(result, bem_contact_summary(there.spec, result));
  };
  rs_forces more{}, less{};
  capi::answer([&] {
    more = forces(step);
    less = forces(-step);
  });
  struct Pair {
    double rs_derivatives::*to;
    double rs_forces::*from;
  };
  constexpr Pair kPairs[] = {{&rs_derivatives::force_x, &rs_forces::force_x},
                             {&rs_derivatives::force_y, &rs_forces::force_y},
                             {&rs_derivatives::force_z, &rs_forces::force_z},
                             {&rs_derivatives::normal_force, &rs_forces::normal_force},
                             {&rs_derivatives::lateral_force, &rs_forces::lateral_force},
                             {&rs_derivatives::spin_moment, &rs_forces::spin_moment},
                             {&rs_derivatives::creepage_x, &rs_forces::creepage_x},
                             {&rs_derivatives::creepage_y, &rs_forces::creepage_y},
                             {&rs_derivatives::spin, &rs_forces::spin},
                             {&rs_derivatives::approach, &rs_forces::approach},
                             {&rs_derivatives::contact_angle, &rs_forces::contact_angle}};
  for (const Pair& p : kPairs) out.*p.to = (more.*p.from - less.*p.from) / (2 * step);
}

void jacobian(rs_contact& contact, const unsigned* inputs, int count, rs_derivatives* out) {
  for (int k = 0; k < count; ++k) {
    if (out[k].size != sizeof(rs_derivatives))
      throw CaseError(fmt::format("rs_derivatives.size = {} is of another version of the library", out[k].size),
                      "set size = sizeof(rs_derivatives), and compile with this version's railstrata.h");
    out[k] = {};
    out[k].size = sizeof(rs_derivatives);
  }
  if (contact.state && !contact.last) return;  // lifted
  capi::patch_of(&contact, 0);
  const BemResult& result = *contact.last;
  const CaseSpec spec = capi::with_state(contact.loaded.spec, *contact.state);
  const Placement placement = capi::placed(contact, spec);
  BemOptions options = contact.options;
  options.cache = &contact.cache;
  std::optional<ContactDerivatives> derivatives;
  if (const BemNeighbour& solved = contact.start.last(); !solved.empty() && !solved.common)
    derivatives.emplace(spec, placement, options, solved);
  for (int k = 0; k < count; ++k) {
    const capi::Input input = capi::input_of(*contact.state, inputs[k], spec, result);
    if (!derivatives || !derivatives->linear()) {
      difference(contact, input, inputs[k], options, {spec, placement}, out[k]);
      continue;
    }
    const Moved more = moved(contact, input, inputs[k], input.step, {spec, placement}),
                less = moved(contact, input, inputs[k], -input.step, {spec, placement});
    fill(derivatives->by(more.there(), less.there(), input.step), out[k]);
  }
}

}  // namespace

extern "C" int rs_jacobian(rs_contact* contact, const unsigned* inputs, int count, rs_derivatives* out,
                           rs_error* error) {
  return capi::guarded(error, [&] {
    capi::require(contact);
    if (count < 0 || (count > 0 && (!inputs || !out)))
      throw CaseError("inputs or out is missing", "give arrays of `count`");
    jacobian(*contact, inputs, count, out);
  });
}
