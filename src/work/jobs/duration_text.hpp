#pragma once
// Durations for people.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace railstrata {

/// "3 s", "2 min 05 s", "1 h 02 min".
inline std::string duration_text(double seconds) {
  const long s = std::lround(std::max(0.0, seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
}

}  // namespace railstrata
