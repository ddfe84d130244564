#pragma once
// What an engine or a command does not support of a case: the pairs of the table of clashes (clashes.hpp), and ranges
// of numbers that are narrower there.
#include <vector>

#include "rules/clashes.hpp"

namespace railstrata {

/// Largest creepage of a run of finite elements, in either direction.
inline constexpr double kLargestRunCreepage = 0.1;

/// Each with its key as its place; empty for a case that it takes.
std::vector<Diagnostic> refused_by(const Use& use, const CaseSpec& spec);

/// Throws CaseError with all of them.
void require_support(const Use& use, const CaseSpec& spec);

}  // namespace railstrata
