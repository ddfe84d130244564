#pragma once
// Counts every request to the heap of the C library (operator new, aligned or not, ends there too), from any thread.

namespace railstrata::fem_checks {

/// False in programs whose memory another tool looks after (sanitizers).
bool allocations_are_counted();
/// Of the program so far.
long allocations();

}  // namespace railstrata::fem_checks
