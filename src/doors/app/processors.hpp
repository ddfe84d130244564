#pragma once
// The processors this process may use and how busy they are; the last four as the system reports them
// (processor_use.cpp).
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

/// Hardware threads that this process may run on, and those that the machine has; at least 1.
int allowed_processors();
int all_processors();

/// Cores this process may run on, two hardware threads of one core counted once; at least 1. They share their
/// arithmetic units: a second one on a core wins nothing here.
int physical_cores();

/// Processors that programs have kept busy in the last minute; 0 where that is not known.
double mean_load();

}  // namespace railstrata
