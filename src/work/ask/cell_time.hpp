#pragma once
// Time that half-space theory takes for a case on this machine, from trials of the same work on coarser cells.
//
// Iterations, patches and searches differ from case to case, so a count of cells alone is right within a factor of
// three (half_space_need.hpp). The work itself on cells two to four times as wide, in about a third of its time,
// gives what does not depend on the cells and what each of them takes; from some ten thousand cells on the caches grow
// too small and iterations more.
#include <cstddef>
#include <functional>
#include <vector>

#include "model/model.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

/// Processor seconds of this process that a call takes, on one thread.
double processor_seconds(const std::function<void()>& call);

struct CellWork {
  std::function<double(double cell)> cells;    ///< that are solved, times the steps of a transient
  std::function<double(double cell)> seconds;  ///< carries it out, or a sample of it, on cells of this size [m]
  double apart = 1.5;                          ///< the coarse trial's cells over the fine one's
};

/// Seconds of one core; carries out the trials. A small work, or one that coarse cells refuse, is carried out itself:
/// throws then what it throws.
double estimated_seconds(const CellWork& work, double cell);

/// Of the first grid of a case; of a transient of all steps.
double cells_to_solve(const CaseSpec& spec, const Placement& placement, double cell);

/// A few places of a list, evenly spread; the first one is there.
std::vector<std::size_t> sample_of(std::size_t count);
/// Of `count` similar works of which those of a sample took these times: the first one alone has made what all share.
double seconds_of_all(const std::vector<double>& sample, std::size_t count);

}  // namespace railstrata
