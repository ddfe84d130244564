#pragma once
// Counts every request to the heap of the C library (operator new, aligned or not, ends there too), from any thread.

namespace railstrata::fem_checks {

/// Of the program so far: by its own code, and by the OpenMP library for itself (g++'s makes a team of one anew for
/// every parallel loop).
struct Allocations {
  long own = 0, openmp = 0;
};
Allocations allocations();
/// False in programs whose memory another tool looks after (sanitizers).
bool allocations_are_counted();

}  // namespace railstrata::fem_checks
