#pragma once
// The memory of this process, in bytes.

namespace railstrata {

/// What it may still take: the least of what the system has available, its control group's limit and the limit of its
/// address space.
double memory_at_hand();

/// The largest amount it has had in use.
double peak_memory();

}  // namespace railstrata
