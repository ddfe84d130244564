#pragma once
// A time series of one wheel, as vehicle codes write it, as the rows of a load collective.
#include <string>
#include <string_view>
#include <vector>

#include "spec/case_spec.hpp"

namespace railstrata {

/// Whether a column is the time or the distance of samples.
bool names_way(std::string_view column);
/// Whether a line of names has a column of time or distance: its rows are then samples of one wheel.
bool names_series(std::string_view text);

/// Samples in the same bin become one load: the means of their numbers, each weighted by its passages, which are added
/// up. Bins are `scale` times 10 kN, 1 mm, 1 mrad, 5 m/s, 0.001 1/m of curvature, 0.02 of friction and traction and
/// 0.0005 of creepage wide, about 0; of what a sample does not give there is none. Samples of different names are apart
/// where there are at most 40 names. Roll, and forces to compare with, part no samples. The bins follow in the order of
/// their passages, most first; their names end with load and shift.
std::vector<LoadSpec> binned(const std::vector<LoadSpec>& samples, double scale);

}  // namespace railstrata
