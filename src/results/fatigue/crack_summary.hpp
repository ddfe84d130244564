#pragma once
// The crack of a case under the wheel of a half-space result: K over the passage, and over depths.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bem/solve_bem.hpp"
#include "crack/crack_passage.hpp"
#include "result/summary.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

struct CrackSpec;  // spec/crack_spec.hpp

/// A crack of a case that reaches so deep [m]; one inside keeps its start, one along an interface its place.
CrackLine crack_line(const CrackSpec& crack, double depth, const LayeredHalfSpace& body);

/// What a passage does at the crack's end, with the factors of a half-elliptical front.
struct CrackState {
  double depth = 0;       ///< m
  StressIntensity range;  ///< Pa √m
  double equivalent = 0;  ///< Pa √m
  double growth = 0;      ///< m a wheel, along the crack; NaN: along an interface, which has no law
  Kink kink;              ///< angle from the crack's direction
  Release release;        ///< the largest of the passage
  bool settled = true;
};

struct CrackResult {
  double azimuth = 0;              ///< rad, given or the fastest
  double y = 0;                    ///< m, in the contact plane from the rigid contact point
  CrackPassage passage;            ///< at the case's depth, with the factors
  CrackState state;                ///< the same
  std::vector<CrackState> depths;  ///< the same crack from shallow to deep; empty: it is inside
  std::vector<std::string> notes;
};

/// A place across where a crack begins, as far as it may reach.
struct CrackPlace {
  double y = 0, deepest = 0;                       ///< m; y in the contact plane of the patch
  std::optional<double> azimuth = {};              ///< rad; none: it may turn to any
  std::function<Sym3(double depth)> further = {};  ///< Pa, residual stress besides that of the process
};
/// The plane of a crack under a patch, with the residual stress of the process.
PlaneOfRolling crack_plane(const CaseSpec& spec, const BemResult& result, const BemPatch& patch, const CrackPlace& at);

/// The direction, in steps of 15 degrees, in which a crack grows fastest; 0 where it grows in none.
double fastest_azimuth(const std::function<double(double azimuth)>& growth);

/// The state of the crack at a depth under the stresses of a passage. passage: where it is wanted.
CrackState crack_state(const CrackSpec& crack, double depth, const LayeredHalfSpace& body, const PlaneOfRolling& plane,
                       CrackPassage* passage = nullptr);

/// Of the patch with the largest pressure. The case has a crack.
CrackResult half_space_crack(const CaseSpec& spec, const BemResult& result);
/// wheel_force: N, of each wheel, for traffic in gross tonnes.
CrackSummary crack_summary(const CrackSpec& crack, const CrackResult& result, double wheel_force);

}  // namespace railstrata
