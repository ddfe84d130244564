#include "runs/solve_half_space.hpp"

#include <utility>

#include "core/parallel.hpp"
#include "io/provenance.hpp"
#include "post/bem_summary.hpp"
#include "runs/peak_memory.hpp"

namespace railstrata {

CaseSpec half_space_case(CaseSpec spec) {
  if (spec.run.rolling) return spec;
  spec.drive.creepage = spec.drive.lateral_creepage = spec.drive.lateral_traction_coefficient = std::nullopt;
  spec.drive.traction_coefficient = spec.drive.friction_coefficient = 0;
  return spec;
}

HalfSpaceSolution solve_half_space(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  const CaseSpec solved = half_space_case(spec);
  HalfSpaceSolution out;
  out.result = solve_bem(solved, placement, options);
  out.summary = bem_summary(solved, out.result);
  out.summary.run.commit = commit_text();
  out.summary.run.threads = max_threads();
  out.summary.run.peak_memory_bytes = peak_memory();
  return out;
}

}  // namespace railstrata
