#pragma once
// The crack of a case under the wheel of a half-space result: K over the passage, and over depths.
#include <optional>
#include <string>
#include <vector>

#include "bem/solve_bem.hpp"
#include "crack/crack_passage.hpp"
#include "result/summary.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

struct CrackSpec;  // spec/crack_spec.hpp

/// A crack of a case that reaches so deep [m]; one inside keeps its start.
CrackLine crack_line(const CrackSpec& crack, double depth);

/// What a passage does at the crack's end, with the factors of a half-elliptical front.
struct CrackState {
  double depth = 0;       ///< m
  StressIntensity range;  ///< Pa √m
  double equivalent = 0;  ///< Pa √m
  double growth = 0;      ///< m a wheel, along the crack
  Kink kink;              ///< angle from the crack's direction
  bool settled = true;
};

struct CrackResult {
  double y = 0;                    ///< m, in the contact plane from the rigid contact point
  CrackPassage passage;            ///< at the case's depth, with the factors
  CrackState state;                ///< the same
  std::vector<CrackState> depths;  ///< the same crack from shallow to deep; empty: it is inside
  std::vector<std::string> notes;
};

/// The state of the crack at a depth under the stresses of a passage. passage: where it is wanted.
CrackState crack_state(const CrackSpec& crack, double depth, const LayeredHalfSpace& body, const PlaneOfRolling& plane,
                       CrackPassage* passage = nullptr);

/// Of the patch with the largest pressure. The case has a crack.
CrackResult half_space_crack(const CaseSpec& spec, const BemResult& result);
CrackSummary crack_summary(const CrackSpec& crack, const CrackResult& result);

}  // namespace railstrata
