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

/// Tolerances: at the head of window_change.cpp; forces over F_z, creepages over the rigid slip.
WindowChange change_between(const MeanContact& before, const MeanContact& last, const DriveSpec& drive);

inline bool repeats(const WindowChange& change) { return change.largest <= 1; }

/// The warning that the last windows do not repeat.
void warn_of_change(const WindowChange& change, Summary& summary);

}  // namespace railstrata
