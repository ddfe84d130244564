#pragma once
// The memory of this process, in bytes.

namespace railstrata {

/// Memory that the process may still take: the least of the system's available memory, its control group's limit and
/// the limit of its address space.
double memory_at_hand();

/// The largest amount it has had in use.
double peak_memory();

}  // namespace railstrata
