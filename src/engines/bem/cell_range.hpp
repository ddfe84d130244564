#pragma once
// Side of the cells of the potential contact area.

namespace railstrata {

inline constexpr double kDefaultCell = 0.25e-3;                        ///< m
inline constexpr double kSmallestCell = 0.02e-3, kLargestCell = 5e-3;  ///< m: what commands and tools take

}  // namespace railstrata
