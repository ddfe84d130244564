#pragma once
// A creep curve: force against one creepage by the full theory and the fast ones (bem/creep_curve.hpp), as a table and
// a page.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bem/creep_curve.hpp"
#include "record/csv.hpp"

namespace railstrata {

/// The input that a curve varies.
struct CurveAxis {
  std::string_view word;  ///< "creepage", "lateral_creepage", "spin"
  VariedCreepage varied;
  Unit unit;
  const char *force, *label;  ///< the force over f F_n that it shows; of a chart's axis
  double side;                ///< sign of a curve to one side, driving
  double largest, bound;      ///< chosen where nothing is asked; as much as may be asked; in its unit

  Column<CreepCurvePoint> column() const { return {std::string(word), unit, &CreepCurvePoint::creepage}; }
};

/// The words.
std::vector<std::string> creep_curve_words();
const CurveAxis& curve_axis(const std::string& word);

/// Values up to `largest` by equal ratios over two and a half decades (many/axis.hpp); `both_sides`: through zero.
std::vector<double> curve_values(const CurveAxis& axis, double largest, int points, bool both_sides);

/// Forces and moment on the wheel, a driving one's positive.
std::vector<CsvColumn> curve_table(const CurveAxis& axis, const std::vector<CreepCurvePoint>& curve);

void write_creep_curve_page(const std::filesystem::path& page, const std::string& title, const CurveAxis& axis,
                            const std::vector<CsvColumn>& table, const std::vector<std::string>& notes);

}  // namespace railstrata
