#pragma once
// The largest memory this process has had in use.
#include <sys/resource.h>

namespace railstrata {

/// Bytes.
inline double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace railstrata
