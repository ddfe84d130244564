#pragma once
// What a case may ask of the half-space engine alone.
#include <string>
#include <vector>

#include "case/case_fwd.hpp"

namespace railstrata {

/// Of the creepages that a run of finite elements takes, in either direction.
inline constexpr double kLargestRunCreepage = 0.1;

/// A key of a case and why an engine does not compute it, with what to do instead.
struct BeyondEngine {
  std::string key, message, remedy;
};

/// What the finite element engine does not do; empty for a case that it runs.
std::vector<BeyondEngine> beyond_finite_elements(const CaseSpec& spec);

/// Throws CaseError if there is any of it.
void require_finite_elements(const CaseSpec& spec);

}  // namespace railstrata
