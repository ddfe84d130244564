#pragma once
// Number and load of the processors, as the system reports them.

namespace railstrata {

/// Hardware threads that this process may run on, and those that the machine has; at least 1.
int allowed_processors();
int all_processors();

/// Cores this process may run on, two hardware threads of one core counted once; at least 1. They share their
/// arithmetic units: a second one on a core wins nothing here.
int physical_cores();

/// Processors that programs have kept busy in the last minute; 0 where that is not known.
double mean_load();

}  // namespace railstrata
