#include "rules/support.hpp"

#include <fmt/format.h>

#include "core/faults.hpp"
#include "geometry/height_field.hpp"
#include "rules/irregularity_rules.hpp"
#include "spec/case_spec.hpp"
#include "text/units.hpp"

namespace railstrata {
namespace {

/// Heights along the rail: elements fine enough for their waves, and a rail that is smooth during the run-up.
void check_heights(const CaseSpec& spec, std::vector<Refusal>& out) {
  for (std::size_t i = 0; i < spec.irregularities.size(); ++i) {
    const Irregularity& is = spec.irregularities[i];
    const std::string key = fmt::format("irregularity.{}", i);
    if (const auto fault = too_coarse(spec, i, spec.mesh.element_size, "elements", "mesh.element_size"))
      out.push_back({key, fault->message, fault->remedy});
    if (spec.run.rolling && is.on == BodyId::rail && extent_of(is).from < spec.run.run_up)
      out.push_back({key,
                     fmt::format("{} begins before the end of run.run_up ({})", key,
                                 format_quantity(spec.run.run_up, dimension::kLength)),
                     "put it farther on (at, from), or shorten run.run_up"});
  }
}

}  // namespace

std::vector<Refusal> refused_by(const Use& use, const CaseSpec& spec) {
  std::vector<Refusal> out = clashes_with(use, spec);
  if (use.is(uses::kFiniteElements)) check_heights(spec, out);
  return out;
}

void require_support(const Use& use, const CaseSpec& spec) {
  std::vector<Diagnostic> all;
  for (Refusal& r : refused_by(use, spec)) all.push_back({std::move(r.key), std::move(r.message), std::move(r.remedy)});
  if (!all.empty()) throw CaseError(std::move(all));
}

}  // namespace railstrata
