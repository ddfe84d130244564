#pragma once
// The processors this process may use and how busy they are.
#include <string>

namespace railstrata {

inline constexpr int kMostThreads = 1024;

/// Threads to start with: OMP_NUM_THREADS if that is set (at most kMostThreads), otherwise physical_cores(), shared
/// with the other ranks that mpirun has started on this machine.
int default_threads();
/// A warning if there are more threads than processors; else empty.
std::string oversubscription(int threads);
/// Whether other programs keep the processors busy that `threads` threads are about to use (load average of the last
/// minute). Empty if they do not.
std::string competition(int threads);

}  // namespace railstrata
