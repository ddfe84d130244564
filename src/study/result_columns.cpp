#include "study/result_columns.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "io/spreadsheet_text.hpp"

namespace railstrata {
namespace {

constexpr ResultColumn kContact[] = {{"p_max_MPa", "/contact/p_max_Pa", 1e-6},
                                     {"q_max_MPa", "/contact/q_max_Pa", 1e-6},
                                     {"patch_length_mm", "/contact/patch_length_m", 1e3},
                                     {"patch_width_mm", "/contact/patch_width_m", 1e3},
                                     {"patch_area_mm2", "/contact/patch_area_m2", 1e6},
                                     {"slip_area_fraction", "/contact/slip_area_fraction", 1},
                                     {"F_x_kN", "/contact/F_x_N", 1e-3},
                                     {"F_y_kN", "/contact/F_y_N", 1e-3},
                                     {"F_z_kN", "/contact/F_z_N", 1e-3},
                                     {"normal_force_kN", "/contact/normal_force_N", 1e-3},
                                     {"lateral_force_kN", "/contact/lateral_force_N", 1e-3},
                                     {"creepage_x", "/contact/creepage_x", 1},
                                     {"spin_per_m", "/contact/spin_per_m", 1},
                                     {"approach_um", "/contact/approach_m", 1e6}};
constexpr ResultColumn kStress[] = {
    {"rail_surface_von_mises_MPa", "/stress/rail/surface/von_mises_max/value_Pa", 1e-6},
    {"rail_surface_sigma_1_MPa", "/stress/rail/surface/sigma1_max/value_Pa", 1e-6},
    {"rail_subsurface_von_mises_MPa", "/stress/rail/subsurface/von_mises_max/value_Pa", 1e-6},
    {"rail_subsurface_von_mises_depth_mm", "/stress/rail/subsurface/von_mises_max/depth_m", 1e3},
    {"rail_layer_von_mises_MPa", "/stress/rail/layer/von_mises_max/value_Pa", 1e-6},
    {"rail_layer_sigma_1_MPa", "/stress/rail/layer/sigma1_max/value_Pa", 1e-6},
    {"rail_interface_von_mises_MPa", "/stress/rail/interface/von_mises_max/value_Pa", 1e-6},
    {"rail_matrix_von_mises_MPa", "/stress/rail/matrix/von_mises_max/value_Pa", 1e-6}};
constexpr ResultColumn kWall{"wall_s", "/run/wall_s", 1};

}  // namespace

std::vector<ResultColumn> result_columns(bool stresses) {
  std::vector<ResultColumn> out(std::begin(kContact), std::end(kContact));
  if (stresses) out.insert(out.end(), std::begin(kStress), std::end(kStress));
  out.push_back(kWall);
  return out;
}

double column_value(const ResultColumn& column, const nlohmann::ordered_json& summary) {
  const nlohmann::ordered_json::json_pointer at(column.path);
  return summary.contains(at) && summary[at].is_number() ? column.factor * summary[at].get<double>() : kNotApplicable;
}

std::string csv_cell(const std::string& given) {
  const std::string text = without_formula(given);
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

std::string csv_cell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

std::string failed_check(const nlohmann::ordered_json& summary) {
  std::string out;
  if (summary.contains("checks") && summary["checks"].is_array())
    for (const auto& c : summary["checks"])
      if (!c.value("ok", false)) out = "check failed: " + c.value("name", "?");
  return out;
}

}  // namespace railstrata
