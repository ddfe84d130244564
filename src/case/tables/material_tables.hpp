#pragma once
// Tables of paths to drive a law along.
//
//   e_xx, e_yy, e_zz, e_xy, e_yz, e_xz        a strain path: tensor shears; also in per cent, "e_xx [%]"
//   s_xx_MPa, s_xy_MPa                        a stress path; e_xx instead of s_xx prescribes the strain of a direction
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "material/material_path.hpp"
#include "options/option_table.hpp"

namespace railstrata {

struct MaterialPathTable {
  MaterialPath path;
  std::filesystem::path file;  ///< empty: the points were given as numbers
  std::vector<int> lines;      ///< of the points; of numbers their rows, the first one is 0
  /// "FILE:LINE", or "row ROW".
  std::string where(std::size_t point) const;
};

/// `absent`: what a component without a column has at zero. Of a strain path (`absent` strain) there are strains alone.
/// Throws CaseError with file, line and remedy, as all of this header.
MaterialPathTable read_material_path(const std::string& text, const std::filesystem::path& file, Prescribed absent);

/// A component of a path as numbers: "e_xx" [-], "s_xy" [Pa]; all of one length.
struct PathColumn {
  std::string name;
  std::vector<double> values;
};
/// The same from numbers.
MaterialPathTable material_path_of(const std::vector<PathColumn>& columns, Prescribed absent);

/// A column of strains [-] and one of stresses [Pa], with the ranges that their numbers have.
Option strain_option(std::string_view key);
Option stress_option(std::string_view key);
/// Throws CaseError unless a value is a number in its range.
void require_in(const Option& option, double value, std::size_t row);

}  // namespace railstrata
