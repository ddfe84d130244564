#pragma once
// The half-space solution of a case as values: patch, forces, stresses and summary. Nothing is written or printed here.
#include "bem/solve_bem.hpp"
#include "post/summary.hpp"

namespace railstrata {

struct HalfSpaceSolution {
  BemResult result;  ///< patch and forces; rail_interior() and wheel_interior() give the stresses at any point
  Summary summary;   ///< with the largest stresses of both bodies
};

/// What half-space theory takes of a case. A static case (run.rolling = false) has frictionless contact, as the finite
/// elements' preload has.
CaseSpec half_space_case(CaseSpec spec);

/// Solves half_space_case(spec). summary.run.threads is the number of threads of the calling thread
/// (core/parallel.hpp), commit that of the program. Several threads may solve at a time. Throws as solve_bem.
HalfSpaceSolution solve_half_space(const CaseSpec& spec, const Placement& placement, const BemOptions& options = {});

}  // namespace railstrata
