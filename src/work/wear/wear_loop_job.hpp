#pragma once
// The wear loop (wear/wear_loop.hpp) as a job: a folder with a row a step in wear_loop.csv, what every load did in
// wear_loads.csv, the worn rail and its damage in step_0001, step_0002 and so on, and report.html.
#include <functional>

#include "jobs/job.hpp"
#include "wear/wear_loop.hpp"

namespace railstrata {

struct WearLoopOrder : JobOrder {
  int steps = 0;               ///< end after so many; 0: no limit
  double passages = 0;         ///< of the whole collective; 0: no limit
  double max_wear = 0.005e-3;  ///< m, at the deepest place in one step
  double cell = kDefaultCell;  ///< m
};

/// Carries the loop out; `at_end`: called with the worn rail once it is finished. Throws CaseError as wear_step, and
/// where the case has no collective.
JobEnd carry_out_wear_loop(LoadedCase loaded, const WearLoopOrder& order, Control& control,
                           const std::function<void(const WornRail&)>& at_end = {});

}  // namespace railstrata
