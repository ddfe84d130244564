#include "bem/one_patch.hpp"

#include <cmath>
#include <utility>

#include "model/drive_at_contact.hpp"

namespace railstrata {

OnePatch::OnePatch(const CaseSpec& spec, const Placement& touching, PatchPlace place)
    : spec_(&spec), touching_(&touching), place_(std::move(place)), placement_(touching) {}

bool OnePatch::lower(double descent) {
  descent_ = descent;
  const RigidContact before = plane();
  if (!spec_->geometry.in_line()) placement_.contact = plane_of(*touching_, place_, descent);
  reference_ = place_.beside_low || place_.beside_high ? reference_of(*touching_, descent) : plane();
  room_ = room_of(*touching_, place_, plane(), descent);
  return !same_place(before, plane());
}

double OnePatch::approach() const {
  return same_place(reference_, plane()) ? *spec_->vehicle.approach : own_approach();
}

double OnePatch::descent_at(double approach) const { return approach / std::cos(plane().angle) + below(); }

void OnePatch::drive(double weight, RollingContact& problem) const {
  drive_contact(*spec_, reference_, weight, problem);
  if (!same_place(reference_, plane()))
    carry_creepages(turn_about_vertical(*spec_, reference_), reference_, plane(), problem);
}

CasePatch OnePatch::lay(const NormalTarget& target, const BemOptions& options) const {
  return make_case_patch(*spec_, placement_, options, target, room_);
}

CasePatch OnePatch::lay_on(const PatchGrid& grid, const NormalTarget& target, const BemOptions& options) const {
  return case_patch_on(grid, *spec_, placement_, options, target, room_);
}

bool OnePatch::starts_from_neighbour(const BemOptions& options) const {
  const PatchRoom whole;
  if (!options.neighbour || !options.neighbour->alone()) return false;
  return room_.low == whole.low && room_.high == whole.high && holds(options.neighbour->alone()->grid, room_) &&
         suits(*options.neighbour->alone(), first_grid(*spec_, placement_, options, {}, room_));
}

FirstPatch press_first(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  constexpr int kMostRounds = 20;
  constexpr double kSettled = 1e-4;
  const RigidContact& contact = placement.contact;
  const bool pressed = spec.vehicle.approach.has_value();
  double descent = pressed ? descent_of(placement, *spec.vehicle.approach)
                           : hertz_estimate(spec, contact).approach / std::cos(contact.angle);
  for (int round = 1;; ++round) {
    FirstPatch out{{spec, placement, first_place(spec, placement, descent)}, {}};
    out.one.lower(descent);
    const NormalTarget target = pressed ? NormalTarget{{}, out.one.approach()}
                                        : NormalTarget{normal_load(spec.vehicle.load(), 0, out.one.plane()), {}};
    out.laid = out.one.lay(target, options);
    const double before = descent;
    descent = out.one.descent_at(out.laid.frictionless.approach);
    const bool settled = pressed || out.one.level() || std::abs(descent - before) <= kSettled * descent;
    if (settled || round == kMostRounds) return out;
  }
}

Placement in_plane(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  FirstPatch first = press_first(spec, placement, options);
  if (first.one.place().contacts.size() > 1 || first.one.place().beside_low || first.one.place().beside_high)
    return placement;
  Placement out = first.one.placement();
  out.contact.settled = true;
  return out;
}

}  // namespace railstrata
