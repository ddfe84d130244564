#pragma once
// Options of a case that only one of the engines has.
#include <string>
#include <vector>

#include "spec/case_fwd.hpp"

namespace railstrata {

/// Largest creepage of a run of finite elements, in either direction.
inline constexpr double kLargestRunCreepage = 0.1;

/// A key of a case and why an engine does not compute it, with what to do instead.
struct BeyondEngine {
  std::string key, message, remedy;
};

/// The reason why the finite element engine refuses a case; empty for one that it runs.
std::vector<BeyondEngine> beyond_finite_elements(const CaseSpec& spec);

/// Throws CaseError for what several ranks cannot share.
void require_shareable(const CaseSpec& spec);

/// Throws CaseError for what only the finite elements know.
void require_half_spaces(const CaseSpec& spec);

/// Throws CaseError if there is anything that they refuse.
void require_finite_elements(const CaseSpec& spec);

}  // namespace railstrata
