#pragma once
// A study as a job of a batch system.
#include <filesystem>
#include <string>
#include <vector>

namespace railstrata {

/// Estimated time and memory of one case; 0: not known.
struct CaseNeed {
  double seconds = 0, memory_bytes = 0;
};

struct BatchJob {
  std::string program, study, out;   ///< absolute: a job begins in any folder
  std::vector<std::string> options;  ///< that every call repeats: --set and its value, --group, --shard
  int threads = 1;                   ///< cores of a task
  std::vector<int> finite_elements;  ///< indices of the cases to do, from 1, each a task of the array
  bool half_spaces = false;          ///< there are cases by half-spaces to do: one task more, 0
  CaseNeed most;                     ///< the largest of any task, all half-spaces being one
};

/// A job script for Slurm: memory and time from the needs with a margin (three times the time, a quarter of an hour at
/// least; half as much memory again), and a task that is stopped before its end requeues itself.
std::string slurm_script(const BatchJob& job);

/// "1-3,7": ascending.
std::string index_ranges(const std::vector<int>& indices);

}  // namespace railstrata
