#include "passes/pass_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "record/unit.hpp"

namespace railstrata {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kCompared = 4;  // passes, as many as a class takes

/// How a column of passes.csv is compared.
enum class Compared { by_share, by_size, as_place };
struct ComparedColumn {
  const char *name, *words;  ///< words: empty: not_converged leaves it out
  Compared how;
};
constexpr std::array kColumns{ComparedColumn{"accumulated_strain", "accumulated strain", Compared::by_share},
                              ComparedColumn{"net_strain", "net strain", Compared::by_share},
                              ComparedColumn{"net_depth_mm", "", Compared::as_place},
                              ComparedColumn{"sigma_x_min_MPa", "residual stress along", Compared::by_size},
                              ComparedColumn{"sigma_x_depth_mm", "", Compared::as_place},
                              ComparedColumn{"sigma_y_min_MPa", "residual stress across", Compared::by_size},
                              ComparedColumn{"sigma_y_depth_mm", "", Compared::as_place},
                              ComparedColumn{"sinking_um", "sinking", Compared::by_size},
                              ComparedColumn{"cycle_accumulated", "", Compared::by_share},
                              ComparedColumn{"cycle_net", "", Compared::by_share}};

/// The last row of the column that has a number: a round may not be over yet.
std::size_t last_number(const std::vector<double>& values) {
  std::size_t n = values.size();
  while (n > 1 && std::isnan(values[n - 1])) --n;
  return n - 1;
}

double error_of(const ComparedColumn& column, const ComparedPasses& passes, const ComparedPasses& other) {
  const std::vector<double> f = passes.table.column(column.name), g = other.table.column(column.name),
                            pass = passes.table.column("pass"), there = other.table.column("pass");
  const std::size_t last = last_number(f);
  double out = 0;
  for (std::size_t n = last + 1 > kCompared ? last + 1 - kCompared : 0; n <= last; ++n) {
    const auto same = std::find(there.begin(), there.end(), pass[n]);
    if (same == there.end() || std::isnan(f[n])) continue;
    const double difference = f[n] - g[static_cast<std::size_t>(same - there.begin())];
    const bool share = column.how == Compared::by_share;
    if (share && !(f[n] >= kNoFlow)) {
      if (n == last) out = std::max(out, grid_bar(difference, other.coarser));
      continue;
    }
    out = std::max(out, grid_bar(difference, other.coarser) * (share ? f[last] / f[n] : 1));
  }
  return out;
}

/// mm, thickness of the row at a depth in mm.
double row_at(const std::vector<double>& rows, double depth) {
  double top = 0;
  for (const double row : rows) {
    top += kToMilli * row;
    if (depth < top) return kToMilli * row;
  }
  return 0;
}

}  // namespace

double grid_bar(double difference, double coarser) {
  constexpr double kSafety = 1.25;
  return kSafety * std::abs(difference) / (coarser - 1);
}

double PassErrors::of(const std::string& column) const {
  for (const auto& [name, error] : last)
    if (name == column) return error;
  return kUnknown;
}

std::vector<double> coarser_grids(const PassesSpec& passes) {
  constexpr int kFewest = 2;
  std::vector<double> out;
  for (const double r : {2.0, 1.5}) {
    const int cells = std::max(kFewest, static_cast<int>(std::lround(passes.patch_cells / r)));
    const double whole = static_cast<double>(passes.patch_cells) / cells;
    if (whole > 1 && (out.empty() || whole < out.front())) out.push_back(whole);
  }
  return out;
}

PassesSpec on_coarser_grid(PassesSpec passes, double r) {
  passes.patch_cells = static_cast<int>(std::lround(passes.patch_cells / r));
  passes.patch_rows /= r;
  if (passes.first_row) *passes.first_row *= r;
  return passes;
}

PassErrors pass_errors(const ComparedPasses& passes, const std::vector<ComparedPasses>& coarser,
                       const std::vector<double>& rows) {
  PassErrors out;
  if (coarser.empty()) return out;
  for (const ComparedColumn& column : kColumns) {
    double error = 0;
    for (const ComparedPasses& other : coarser) error = std::max(error, error_of(column, passes, other));
    if (column.how == Compared::as_place) error += row_at(rows, passes.table.column(column.name).back());
    out.last.emplace_back(column.name, error);
  }
  for (const ComparedPasses& other : coarser) {
    out.strain = std::max(out.strain, grid_bar(passes.strain - other.strain, other.coarser));
    out.classes.push_back(other.kind);
  }
  return out;
}

std::vector<std::string> not_converged(const PassErrors& errors, const CsvTable& table) {
  constexpr double kSmall = 0.05;
  std::vector<std::string> out;
  const auto last = [&](const char* name) { return std::abs(table.column(name).back()); };
  const double largest = std::max(last("sigma_x_min_MPa"), last("sigma_y_min_MPa"));
  for (const ComparedColumn& column : kColumns) {
    const double value = last(column.name);
    const bool stress = std::string_view(column.name).starts_with("sigma");
    const bool nothing = column.how == Compared::by_share ? value < kNoFlow : stress && value < kSmall * largest;
    if (*column.words != 0 && !nothing && errors.of(column.name) > kNotConverged * value)
      out.emplace_back(column.words);
  }
  return out;
}

std::string strain_text(double strain, double error) {
  std::string text = fmt::format("{:.1e}", strain);
  const std::size_t e = text.find('e');
  if (e != std::string::npos && e + 2 < text.size() && text[e + 2] == '0') text.erase(e + 2, 1);
  if (std::isnan(error)) return text;
  if (!(strain > 0)) return fmt::format("{} ± {:.1e}", text, error);
  const double digits = error / std::pow(10, std::floor(std::log10(strain)));
  return fmt::format("{} ± {:.{}f}{}", text, digits, digits < 0.1 ? 2 : 1, text.substr(e));
}

}  // namespace railstrata
