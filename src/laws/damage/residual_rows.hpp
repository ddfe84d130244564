#pragma once
// Residual stress that a body has whether or not a wheel rolls over it, by rows of a StressHistory.
#include <algorithm>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "damage/stress_history.hpp"

namespace railstrata {

/// Pa, one tensor for each row of the history (xx and yy of a layer's process; the surface carries no zz, xz, yz);
/// empty: none.
using ResidualRows = std::span<const Sym3>;

/// From stresses along x and y by row, as shakedown takes them; either may be empty.
inline std::vector<Sym3> residual_rows(std::span<const double> xx, std::span<const double> yy) {
  if (!xx.empty() && !yy.empty() && xx.size() != yy.size())
    throw std::invalid_argument("residual stresses along x and y have different numbers of rows");
  std::vector<Sym3> rows(std::max(xx.size(), yy.size()));
  for (std::size_t i = 0; i < xx.size(); ++i) rows[i].xx = xx[i];
  for (std::size_t i = 0; i < yy.size(); ++i) rows[i].yy = yy[i];
  return rows;
}

inline Sym3 residual_of(ResidualRows by_row, int row) { return by_row.empty() ? Sym3{} : by_row[row]; }

/// Throws std::invalid_argument unless `count` things by row fit the history.
inline void check_rows(const StressHistory& history, std::size_t count, const char* what) {
  if (count != static_cast<std::size_t>(history.rows()))
    throw std::invalid_argument(std::string(what) + " must be given for every row of the section");
}
inline void check_residual(const StressHistory& history, ResidualRows by_row) {
  if (!by_row.empty()) check_rows(history, by_row.size(), "residual stress");
}

}  // namespace railstrata
