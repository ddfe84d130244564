#include "clock/wheel_kinds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace railstrata {
namespace {

/// Rows that differ in their names and numbers alone are one.
CaseSpec merged(CaseSpec spec) {
  std::vector<LoadSpec> out;
  for (const LoadSpec& load : spec.loads) {
    const auto same = std::find_if(out.begin(), out.end(), [&](LoadSpec other) {
      other.name = load.name;
      other.passages = load.passages;
      return other == load;
    });
    if (same == out.end())
      out.push_back(load);
    else
      same->passages += load.passages;
  }
  spec.loads = std::move(out);
  return spec;
}

/// A row for each of three places of a normal distribution about the row's, by Gauss and Hermite: exact for what is a
/// polynomial of fifth degree in the shift.
CaseSpec spread(CaseSpec spec) {
  const double deviation = spec.collective.lateral_deviation;
  if (!(deviation > 0)) return spec;
  std::vector<LoadSpec> out;
  for (const LoadSpec& load : spec.loads)
    for (const auto& [aside, share] : {std::pair{-1.0, 1.0 / 6}, std::pair{0.0, 2.0 / 3}, std::pair{1.0, 1.0 / 6}}) {
      out.push_back(load);
      out.back().passages *= share;
      out.back().lateral_shift =
          load.lateral_shift.value_or(spec.geometry.lateral_shift) + aside * std::sqrt(3.0) * deviation;
    }
  spec.loads = std::move(out);
  spec.collective.lateral_deviation = 0;
  return spec;
}

}  // namespace

CaseSpec kinds_of_wheels(const CaseSpec& spec) { return merged(spread(spec)); }

}  // namespace railstrata
