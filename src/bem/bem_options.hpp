#pragma once
// How the half-space engine solves a case.
#include "bem/influence_cache.hpp"
#include "bem/rolling_contact.hpp"

namespace railstrata {

/// m, of BemOptions::cell: what commands and tools take.
inline constexpr double kSmallestCell = 0.02e-3, kLargestCell = 5e-3;

struct BemOptions {
  double cell = 0.25e-3;         ///< m
  double largest_patch = 60e-3;  ///< m, of the potential contact area, per direction
  RollingOptions rolling;
  InfluenceCache* cache = nullptr;  ///< for sweeps; may be null
};

}  // namespace railstrata
