#pragma once
// Whether a rolling is steady: what changes from one measuring window to the next.
#include "result/rolling_mean.hpp"
#include "result/summary.hpp"
#include "spec/drive_spec.hpp"

namespace railstrata {

struct WindowChange {
  ContactErrors change;  ///< of the numbers from the window before to the last one
  double largest = 0;    ///< of them all, over its tolerance
};

/// Tolerances: forces 0.5 % of F_z, p_max 0.5 %, q_max 2 %, creepages 2 % of the rigid slip, slip share 0.03.
WindowChange change_between(const MeanContact& before, const MeanContact& last, const DriveSpec& drive);

inline bool repeats(const WindowChange& change) { return change.largest <= 1; }

/// The warning that the last windows do not repeat.
void warn_of_change(const WindowChange& change, Summary& summary);

}  // namespace railstrata
