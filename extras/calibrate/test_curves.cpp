#include "calibrate/test_curves.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "core/faults.hpp"
#include "options/option_slots.hpp"
#include "tables/material_tables.hpp"
#include "tables/unit_table.hpp"

namespace railstrata {
namespace {

/// Throws CaseError unless an amplitude is one of a cycle that has yielded.
void require_amplitude(double plastic, double stress, const std::string& where) {
  if (plastic > 0 && stress > 0) return;
  throw CaseError(fmt::format("a plastic strain amplitude of {:g} at {:g} MPa is none", plastic, 1e-6 * stress),
                  "leave elastic cycles out; if the steel yielded, look at young in the card", where);
}

}  // namespace

std::vector<CurvePoint> test_curve_of(const std::vector<double>& strain, const std::vector<double>& stress,
                                      bool plastic, TestCurve kind, double young) {
  if (strain.size() != stress.size()) throw CaseError("strains and stresses of a test have one length", "");
  const Option e = strain_option("strain"), s = stress_option("stress");
  std::vector<CurvePoint> out;
  for (std::size_t row = 0; row < strain.size(); ++row) {
    require_in(e, strain[row], row);
    require_in(s, stress[row], row);
    out.push_back({plastic ? strain[row] : strain[row] - stress[row] / young, stress[row]});
    if (kind == TestCurve::amplitudes)
      require_amplitude(out.back().plastic_strain, out.back().stress, fmt::format("row {}", row));
  }
  return out;
}

namespace {

std::vector<std::string> notes_of(const UnitTable& table, const std::filesystem::path& file, bool amplitudes) {
  std::vector<std::string> notes;
  if (!table.ignored.empty())
    notes.push_back(fmt::format("{}: not read: {}", file.string(), fmt::join(table.ignored, ", ")));
  std::vector<std::string> plain;
  for (const std::string& name : table.names)
    if (amplitudes && name.find("amplitude") == std::string::npos) plain.push_back(name);
  if (!plain.empty())
    notes.push_back(
        fmt::format("{}: {} {} taken as amplitudes, half the range of a stabilised cycle each; a monotonic "
                    "curve belongs to --monotonic",
                    file.string(), fmt::join(plain, ", "), plain.size() == 1 ? "is" : "are"));
  return notes;
}

}  // namespace

std::vector<CurvePoint> read_shear_yield(const std::string& text, const std::filesystem::path& file) {
  const std::array<Option, 2> options{Option{"pss", nullptr, "", dimension::kNumber, {0, 50}},
                                      Option{"sys", nullptr, "", dimension::kPressure, option_slot::above(0, 2e10)}};
  UnitTableForm form{{{&options[0], "plastic_shear_strain"}, {&options[1], "shear_yield_stress"}},
                     {},
                     "a table of points",
                     "pss, sys_MPa"};
  form.others = true;
  const UnitTable table = read_unit_table(text, file, form);
  if (table.columns.size() < options.size())
    refuse_in_table(file, table.line, "the table needs two columns, pss and sys",
                    fmt::format("give both, e.g. \"{}\"", form.example));
  const std::size_t strain = table.columns[0] == &options[0] ? 0 : 1;
  std::vector<CurvePoint> out;
  for (const UnitTable::Row& row : table.rows) {
    const double pss = row.cells[strain].number.value(), sys = row.cells[1 - strain].number.value();
    out.push_back({pss / std::numbers::sqrt3, std::numbers::sqrt3 * sys});
  }
  return out;
}

std::vector<CurvePoint> read_test_curve(const std::string& text, const std::filesystem::path& file, TestCurve kind,
                                        double young, std::vector<std::string>* notes) {
  const bool amplitudes = kind == TestCurve::amplitudes;
  const std::array<Option, 3> options{strain_option(amplitudes ? "strain_amplitude" : "strain"),
                                      strain_option(amplitudes ? "plastic_strain_amplitude" : "plastic_strain"),
                                      stress_option(amplitudes ? "stress_amplitude" : "stress")};
  UnitTableForm form{{{&options[0], "strain"}, {&options[1], "plastic_strain"}, {&options[2], "stress"}},
                     {{options[0].key, options[1].key}},
                     "a curve",
                     amplitudes ? "strain_amplitude, stress_amplitude_MPa" : "strain, stress_MPa"};
  form.others = true;
  const UnitTable table = read_unit_table(text, file, form);
  if (notes) *notes = notes_of(table, file, amplitudes);
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
    if (amplitudes) require_amplitude(e, s, fmt::format("{}:{}", file.string(), row.line));
    out.push_back({e, s});
  }
  return out;
}

}  // namespace railstrata
