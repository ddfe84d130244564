#include "core/process_memory.hpp"

#include <windows.h>
// after windows.h, whose types it takes
#include <psapi.h>

#include <algorithm>

namespace railstrata {

double memory_at_hand() {
  MEMORYSTATUSEX memory{};
  memory.dwLength = sizeof memory;
  ::GlobalMemoryStatusEx(&memory);
  return static_cast<double>(std::min(memory.ullAvailPhys, memory.ullAvailVirtual));
}

double peak_memory() {
  PROCESS_MEMORY_COUNTERS used{};
  ::GetProcessMemoryInfo(::GetCurrentProcess(), &used, sizeof used);
  return static_cast<double>(used.PeakWorkingSetSize);
}

}  // namespace railstrata
