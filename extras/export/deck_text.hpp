#pragma once
// Shared by the writers of decks: units mm, t, s, MPa, and text on one line.
#include <fmt/format.h>

#include <cctype>
#include <iterator>
#include <string>
#include <utility>

#include "record/unit.hpp"

namespace railstrata {

inline constexpr double kTonnesPerCubicMetre = 1e-12;  ///< of kg/m³ to t/mm³
inline constexpr double kFirstPush = 0.6;  ///< of Hertz's approach: by which a deck's first step moves the axle down

/// Appends a formatted text.
template <class... Args>
void add(std::string& out, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

/// A comment's text without control characters.
inline std::string one_line(const std::string& text) {
  std::string out;
  for (const char c : text) out += std::iscntrl(static_cast<unsigned char>(c)) != 0 ? ' ' : c;
  return out;
}

}  // namespace railstrata
