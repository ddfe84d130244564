#pragma once
// Wheels that run over a rail that yields, one pass after another by the stationary method, from half-space solutions:
// with the pressure of the elastic bodies, or with one that follows the surface (passes/following_contact.hpp).
#include <functional>
#include <optional>
#include <vector>

#include "passes/following_contact.hpp"
#include "passes/rail_passes.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {

class PassRunner {
 public:
  /// Where a wheel runs, and under which of the solutions.
  struct Place {
    int column = 0;
    std::size_t solution = 0;
    bool operator==(const Place&) const = default;
  };

  /// solutions: as of rail_passes; following: null where the pressure is that of the elastic bodies. Throws
  /// CaseError as rail_passes.
  PassRunner(const CaseSpec& spec, std::vector<BemResult> solutions, FollowingContact* following,
             const Control* control);

  const RailPasses& rail() const { return rail_; }
  const SteadyBody& body() const { return *body_; }
  /// Of the contact of the last pass, or of the next one.
  const Field& strain() const { return strain_; }
  Place place() const { return place_; }
  /// The elastic contact at place().
  const BemResult& contact() const { return solutions_[place_.solution]; }

  /// Puts the wheel there; its contact is computed anew only where it is another one.
  void stand(Place place, PassState& state);
  /// Back to an earlier strain() at its place().
  void take_back(Place place, Field strain);
  /// The pass of the wheel where it stands; the state advances. Throws Interrupted, the state is then as it was.
  FollowedPass roll(PassState& state);
  /// Where the first pass has flowed on behind the load, begins anew with a longer window (passes/rail_passes.hpp), if
  /// there is one: a new rail, no wheel on it, `state` its virgin one.
  bool lengthen(double late_flow, PassState& state);
  /// stand() and roll(), the first pass with a window as long as it needs. lengthened: called before it begins anew.
  FollowedPass next(Place place, PassState& state, const std::function<void()>& lengthened = {});

 private:
  void renew_body();
  CaseSpec spec_;
  std::vector<BemResult> solutions_;
  FollowingContact* following_;
  RailPasses rail_;
  std::optional<SteadyBody> body_;  ///< of rail_
  Field strain_;
  Place place_;
  PassLimits limits_;
};

}  // namespace railstrata
