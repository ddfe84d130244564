#include "case/material_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "case/unit_table.hpp"

namespace railstrata {
namespace {

constexpr Range kStrain{-0.5, 0.5}, kStress{-2e10, 2e10};
constexpr std::array<std::string_view, 6> kStrainKeys{"e_xx", "e_yy", "e_zz", "e_xy", "e_yz", "e_xz"},
    kStressKeys{"s_xx", "s_yy", "s_zz", "s_xy", "s_yz", "s_xz"};

Option strain_option(std::string_view key) { return {key, nullptr, "", dimension::kNumber, kStrain}; }
Option stress_option(std::string_view key) { return {key, nullptr, "", dimension::kPressure, kStress}; }

}  // namespace

MaterialPathTable read_material_path(const std::string& text, const std::filesystem::path& file, Prescribed absent) {
  std::vector<Option> options;
  for (const std::string_view key : kStrainKeys) options.push_back(strain_option(key));
  UnitTableForm form{{}, {}, "a path", "e_xx, e_yy, e_zz, e_xy, e_yz, e_xz"};
  if (absent == Prescribed::stress) {
    for (const std::string_view key : kStressKeys) options.push_back(stress_option(key));
    for (std::size_t j = 0; j < 6; ++j) form.rivals.push_back({kStrainKeys[j], kStressKeys[j]});
    form.example = "s_xx_MPa, s_xy_MPa";
  }
  for (const Option& option : options) form.columns.push_back({&option, option.key});
  const UnitTable table = read_unit_table(text, file, form);
  MaterialPathTable out;
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

std::vector<CurvePoint> read_test_curve(const std::string& text, const std::filesystem::path& file, TestCurve kind,
                                        double young) {
  const bool amplitudes = kind == TestCurve::amplitudes;
  const std::array<Option, 3> options{strain_option(amplitudes ? "strain_amplitude" : "strain"),
                                      strain_option(amplitudes ? "plastic_strain_amplitude" : "plastic_strain"),
                                      stress_option(amplitudes ? "stress_amplitude" : "stress")};
  UnitTableForm form{{{&options[0], "strain"}, {&options[1], "plastic_strain"}, {&options[2], "stress"}},
                     {{options[0].key, options[1].key}},
                     "a curve",
                     amplitudes ? "plastic_strain_amplitude, stress_amplitude_MPa" : "strain, stress_MPa"};
  const UnitTable table = read_unit_table(text, file, form);
  const auto column = [&](const Option& option) {
    return std::find(table.columns.begin(), table.columns.end(), &option) - table.columns.begin();
  };
  const auto width = static_cast<std::ptrdiff_t>(table.columns.size());
  const std::ptrdiff_t total = column(options[0]), plastic = column(options[1]), stress = column(options[2]);
  if (stress == width || (total == width && plastic == width))
    refuse_in_table(file, table.line,
                    fmt::format("the table has no column {}", stress == width ? "of stress" : "of strain"),
                    fmt::format("give both, e.g. \"{}\"", form.example));
  std::vector<CurvePoint> out;
  for (const UnitTable::Row& row : table.rows) {
    const auto at = [&](std::ptrdiff_t k) { return row.cells[static_cast<std::size_t>(k)].number.value(); };
    const double s = at(stress), e = total < width ? at(total) - s / young : at(plastic);
    if (amplitudes && !(e > 0 && s > 0))
      refuse_in_table(file, row.line,
                      fmt::format("a plastic strain amplitude of {:g} at {:g} MPa is none", e, 1e-6 * s),
                      "leave elastic cycles out; if the steel yielded, look at young in the card");
    out.push_back({e, s});
  }
  return out;
}

}  // namespace railstrata
