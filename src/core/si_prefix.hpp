#pragma once
// SI prefixes, and the factors by which tables and pages show SI numbers: 2 * kMilli is 2 mm in m; kToMilli * x is x m
// in mm.

namespace railstrata {

inline constexpr double kMilli = 1e-3, kMicro = 1e-6, kMega = 1e6;
inline constexpr double kToMilli = 1e3, kToMicro = 1e6, kToMega = 1e-6, kToPercent = 100;

}  // namespace railstrata
