#pragma once
// A wheel that bears its load on one patch, whose place and plane follow the descent of the wheel.
#include <cmath>

#include "bem/case_patch.hpp"
#include "bem/contact_places.hpp"

namespace railstrata {

class OnePatch {
 public:
  /// spec and touching are kept by reference.
  OnePatch(const CaseSpec& spec, const Placement& touching, PatchPlace place);

  /// The same of a case with this placement and wheel, which is kept by reference, too.
  OnePatch in_case(const CaseSpec& spec) const {
    OnePatch out = *this;
    out.spec_ = &spec;
    return out;
  }

  /// Lowers the wheel by a descent [m]. Returns whether the plane is another one than before.
  bool lower(double descent);
  double descent() const { return descent_; }
  const PatchPlace& place() const { return place_; }
  /// Its contact is the plane.
  const Placement& placement() const { return placement_; }
  const RigidContact& plane() const { return placement_.contact; }
  /// Whether the plane is that of the place where the wheel touches first.
  bool level() const { return same_place(plane(), touching_->contact); }

  /// Along the normal of the plane [m]: where the case gives that of the reference, and of the descent.
  double approach() const;
  double own_approach() const { return (descent_ - below()) * std::cos(plane().angle); }
  /// The descent under an approach [m] along the normal of the plane.
  double descent_at(double approach) const;
  /// Gives the problem the case's creepages or forces: those of the reference, in the plane.
  void drive(double weight, RollingContact& problem) const;

  CasePatch lay(const NormalTarget& target, const BemOptions& options) const;
  CasePatch lay_on(const PatchGrid& grid, const NormalTarget& target, const BemOptions& options) const;
  bool starts_from_neighbour(const BemOptions& options) const;

 private:
  double below() const { return touching_->contact.axle_height - plane().axle_height; }

  const CaseSpec* spec_;
  const Placement* touching_;
  PatchPlace place_;
  Placement placement_;
  RigidContact reference_;
  PatchRoom room_;
  double descent_ = 0;
};

/// The patch that touches first, under the whole load without friction or under the given approach, and the problem
/// laid for it. Descent and plane agree to 1e-4 of the descent.
struct FirstPatch {
  OnePatch one;
  CasePatch laid;
};
FirstPatch press_first(const CaseSpec& spec, const Placement& placement, const BemOptions& options);

/// The placement with its contact at the place and in the plane that press_first finds, which solutions then keep: for
/// jobs that follow one patch. As it is where the wheel touches at several places.
Placement in_plane(const CaseSpec& spec, const Placement& placement, const BemOptions& options);

}  // namespace railstrata
