#pragma once
// Random numbers by their place in a series: the same however a computation is cut. [SteeleLeaFlood2014]
#include <cstdint>

namespace railstrata {

/// Finalizer of splitmix64.
inline std::uint64_t mixed(std::uint64_t v) {
  v += 0x9e3779b97f4a7c15U;
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9U;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebU;
  return v ^ (v >> 31);
}

/// Above 0 and up to 1, uniform.
inline double uniform_number(std::uint64_t v) { return (static_cast<double>(mixed(v) >> 11) + 1) * 0x1p-53; }

}  // namespace railstrata
