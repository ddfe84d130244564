#pragma once
// The processors this process may use and how busy they are.
#include <string>

namespace railstrata {

/// Cores this process may run on, two hardware threads of one core counted once; at least 1. They share their arithmetic units: a second one on a core wins nothing here.
int physical_cores();
/// Threads to start with: OMP_NUM_THREADS if that is set, otherwise physical_cores().
int default_threads();
/// What slows `threads` threads down before they start: more of them than processors, or other programs that keep these busy. Empty if nothing does.
std::string oversubscription(int threads);

}  // namespace railstrata
