#include "tables/material_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/faults.hpp"
#include "tables/unit_table.hpp"

namespace railstrata {
namespace {

constexpr Range kStrain{-0.5, 0.5}, kStress{-2e10, 2e10};
constexpr std::array<std::string_view, 6> kStrainKeys{"e_xx", "e_yy", "e_zz", "e_xy", "e_yz", "e_xz"},
    kStressKeys{"s_xx", "s_yy", "s_zz", "s_xy", "s_yz", "s_xz"};

/// The options of a path's columns: strains, of a path of stresses these too, in the order of components.
std::vector<Option> path_options(Prescribed absent) {
  std::vector<Option> options;
  for (const std::string_view key : kStrainKeys) options.push_back(strain_option(key));
  if (absent == Prescribed::stress)
    for (const std::string_view key : kStressKeys) options.push_back(stress_option(key));
  return options;
}

}  // namespace

Option strain_option(std::string_view key) { return {key, nullptr, "", dimension::kNumber, kStrain}; }
Option stress_option(std::string_view key) { return {key, nullptr, "", dimension::kPressure, kStress}; }

void require_in(const Option& option, double value, std::size_t row) {
  if (option.range.holds(value)) return;  // not NaN
  throw CaseError(
      fmt::format("{} = {:g}: must be between {:g} and {:g}", option.key, value, option.range.min, option.range.max),
      "strain has no unit, stress is in Pa", fmt::format("row {}", row));
}

std::string MaterialPathTable::where(std::size_t point) const {
  return file.empty() ? fmt::format("row {}", lines[point]) : fmt::format("{}:{}", file.string(), lines[point]);
}

MaterialPathTable material_path_of(const std::vector<PathColumn>& columns, Prescribed absent) {
  const std::vector<Option> options = path_options(absent);
  MaterialPathTable out;
  out.path.prescribed.fill(absent);
  out.path.points.resize(columns.empty() ? 0 : columns.front().values.size());
  for (std::size_t row = 0; row < out.path.points.size(); ++row) out.lines.push_back(static_cast<int>(row));
  std::array<const PathColumn*, 6> given{};
  for (const PathColumn& column : columns) {
    const auto found =
        std::find_if(options.begin(), options.end(), [&](const Option& o) { return o.key == column.name; });
    if (found == options.end() || column.values.size() != out.path.points.size())
      throw CaseError(
          found == options.end() ? fmt::format("a path has no component \"{}\"", column.name)
                                 : fmt::format("{} has another length than {}", column.name, columns.front().name),
          "give e_xx, e_yy, e_zz, e_xy, e_yz, e_xz; of a path of stresses s_xx, ... too; one value a point");
    const auto place = static_cast<std::size_t>(found - options.begin()), component = place % 6;
    if (given[component])
      throw CaseError(fmt::format("the path has {} and {}", given[component]->name, column.name), "give one of them");
    given[component] = &column;
    out.path.prescribed[component] = place < 6 ? Prescribed::strain : Prescribed::stress;
    for (std::size_t row = 0; row < column.values.size(); ++row) {
      require_in(*found, column.values[row], row);
      out.path.points[row][component] = column.values[row];
    }
  }
  if (out.path.points.empty()) throw CaseError("the path has no points", "give one component or more, a value a point");
  return out;
}

MaterialPathTable read_material_path(const std::string& text, const std::filesystem::path& file, Prescribed absent) {
  const std::vector<Option> options = path_options(absent);
  UnitTableForm form{{}, {}, "a path", "e_xx, e_yy, e_zz, e_xy, e_yz, e_xz"};
  if (absent == Prescribed::stress) {
    for (std::size_t j = 0; j < 6; ++j) form.rivals.push_back({kStrainKeys[j], kStressKeys[j]});
    form.example = "s_xx_MPa, s_xy_MPa";
  }
  for (const Option& option : options) form.columns.push_back({&option, option.key});
  const UnitTable table = read_unit_table(text, file, form);
  MaterialPathTable out;
  out.file = file;
  out.path.prescribed.fill(absent);
  for (const UnitTable::Row& row : table.rows) {
    auto& point = out.path.points.emplace_back();
    out.lines.push_back(row.line);
    for (std::size_t k = 0; k < row.cells.size(); ++k) {
      const auto place = static_cast<std::size_t>(table.columns[k] - options.data()), component = place % 6;
      out.path.prescribed[component] = place < 6 ? Prescribed::strain : Prescribed::stress;
      point[component] = row.cells[k].number.value();
    }
  }
  return out;
}

}  // namespace railstrata
