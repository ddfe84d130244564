#include "core/process_memory.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

namespace railstrata {
namespace {

/// A file of one number of bytes; no limit if it contains none or does not exist.
double number_in(const char* file) {
  double value = 0;
  std::ifstream in(file);
  return in >> value ? value : HUGE_VAL;
}

double available_in_system() {
  std::ifstream in("/proc/meminfo");
  for (std::string word; in >> word;)
    if (double kilobytes = 0; word == "MemAvailable:" && in >> kilobytes) return 1024 * kilobytes;
  return HUGE_VAL;
}

}  // namespace

double memory_at_hand() {
  rlimit limit{};
  getrlimit(RLIMIT_AS, &limit);
  const double address_space = limit.rlim_cur == RLIM_INFINITY ? HUGE_VAL : static_cast<double>(limit.rlim_cur);
  const double group =
      number_in("/sys/fs/cgroup/memory.max") -
      (std::ifstream("/sys/fs/cgroup/memory.current") ? number_in("/sys/fs/cgroup/memory.current") : 0);
  return std::min({available_in_system(), group, address_space});
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace railstrata
