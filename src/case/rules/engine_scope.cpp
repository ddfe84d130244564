#include "rules/engine_scope.hpp"

#include <utility>

#include "rules/irregularity_rules.hpp"
#include "rules/support.hpp"

namespace railstrata {

std::vector<BeyondEngine> beyond_finite_elements(const CaseSpec& spec) {
  std::vector<BeyondEngine> out;
  for (Refusal& r : refused_by(uses::kFiniteElements, spec))
    out.push_back({std::move(r.key), std::move(r.message), std::move(r.remedy)});
  return out;
}

void require_shareable(const CaseSpec& spec) { require_support(uses::kRanks, spec); }
void require_half_spaces(const CaseSpec& spec) { require_support(uses::kHalfSpaces, spec); }
void require_finite_elements(const CaseSpec& spec) { require_support(uses::kFiniteElements, spec); }

}  // namespace railstrata
