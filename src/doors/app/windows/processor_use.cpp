#include "app/processors.hpp"

#include <windows.h>

#include <algorithm>
#include <bit>
#include <vector>

namespace railstrata {
namespace {

DWORD_PTR allowed() {
  DWORD_PTR own = 1, all = 1;
  ::GetProcessAffinityMask(::GetCurrentProcess(), &own, &all);
  return own;
}

}  // namespace

int allowed_processors() { return std::max(1, std::popcount(allowed())); }

int all_processors() { return std::max(1, static_cast<int>(::GetActiveProcessorCount(ALL_PROCESSOR_GROUPS))); }

int physical_cores() {
  DWORD bytes = 0;
  ::GetLogicalProcessorInformation(nullptr, &bytes);
  std::vector<SYSTEM_LOGICAL_PROCESSOR_INFORMATION> parts(bytes / sizeof(SYSTEM_LOGICAL_PROCESSOR_INFORMATION));
  if (parts.empty() || ::GetLogicalProcessorInformation(parts.data(), &bytes) == 0) return allowed_processors();
  const auto cores = std::count_if(parts.begin(), parts.end(), [](const SYSTEM_LOGICAL_PROCESSOR_INFORMATION& part) {
    return part.Relationship == RelationProcessorCore && (part.ProcessorMask & allowed()) != 0;
  });
  return std::max(1, static_cast<int>(cores));
}

double mean_load() { return 0; }

}  // namespace railstrata
