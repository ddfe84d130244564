#include "damage/grades.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/faults.hpp"
#include "core/nearest_word.hpp"
#include "damage/positive.hpp"

#include "record/unit.hpp"

namespace railstrata {
namespace {

constexpr double kTensilePerVickers = 3.2 * kMega, kPressurePerVickers = 9.80665 * kMega, kBrinellPerVickers = 0.95;

constexpr std::string_view kRail = "EN 13674-1, minimum";
constexpr std::string_view kRailHardness = "EN 13674-1, range of the running surface";
constexpr std::string_view kRailYield = "usual Rp0.2; EN 13674-1 asks for none";
constexpr std::string_view kWheel = "EN 13262, minimum of the rim";
constexpr std::string_view kWheelTensile = "EN 13262, range of the rim";
constexpr std::string_view kHadfield = "usual values, cast, not hardened";
constexpr std::string_view kBainitic = "usual values";

GradeNumber standard(double low, double high, double unit, std::string_view source) {
  return {low * unit, high * unit, Certainty::standard_minimum, source};
}
GradeNumber estimated(double low, double high, double unit, std::string_view source) {
  return {low * unit, high * unit, Certainty::estimated, source};
}

/// Rail: usual yield strengths, least tensile strength, range of hardness.
Grade rail(std::string_view name, double yield_low, double yield_high, double tensile, double soft, double hard) {
  return {name, "rail", estimated(yield_low, yield_high, kMega, kRailYield), standard(tensile, tensile, kMega, kRail),
          standard(soft, hard, 1, kRailHardness)};
}
/// Wheel: least yield strength, range of tensile strength, least hardness.
Grade wheel(std::string_view name, double yield, double tensile_low, double tensile_high, double hardness) {
  return {name, "wheel", standard(yield, yield, kMega, kWheel),
          standard(tensile_low, tensile_high, kMega, kWheelTensile), standard(hardness, hardness, 1, kWheel)};
}

std::string capitals(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::toupper(c); });
  return out;
}

double share_of_tensile(double share) {
  if (!(share > 0 && share <= 1)) throw std::invalid_argument("yield over tensile strength must lie in (0, 1]");
  return share;
}

}  // namespace

const std::vector<Grade>& grades() {
  static const std::vector<Grade> all = {
      rail("R220", 430, 460, 770, 220, 260),
      rail("R260", 470, 500, 880, 260, 300),
      rail("R350HT", 760, 820, 1175, 350, 390),
      rail("R400HT", 850, 950, 1280, 400, 440),
      {"B320", "rail", {}, estimated(1100, 1100, kMega, kBainitic), estimated(320, 360, 1, kBainitic)},
      wheel("ER7", 520, 820, 940, 235),
      wheel("ER8", 540, 860, 980, 245),
      wheel("ER9", 580, 900, 1050, 255),
      {"Hadfield", "crossing", estimated(360, 400, kMega, kHadfield), estimated(1000, 1000, kMega, kHadfield),
       estimated(200, 200, 1, kHadfield)},
  };
  return all;
}

const Grade* find_grade(std::string_view name) {
  const std::string wanted = capitals(name);
  for (const Grade& g : grades())
    if (capitals(g.name) == wanted) return &g;
  return nullptr;
}

const Grade& grade(std::string_view name) {
  if (const Grade* found = find_grade(name)) return *found;
  std::vector<std::string> names;
  for (const Grade& g : grades()) names.emplace_back(g.name);
  const std::string near = nearest_word(name, names);
  std::string list;
  for (const std::string& n : names) list += (list.empty() ? "" : ", ") + n;
  throw CaseError("no grade \"" + std::string(name) + "\"",
                  (near.empty() ? "" : "did you mean \"" + near + "\"? ") + "Known are " + list +
                      "; for any other steel give yield_strength and hardness");
}

double shear_yield(double yield) { return yield / std::sqrt(3.0); }

double vickers_from_brinell(double brinell) { return positive(brinell, "hardness") / kBrinellPerVickers; }
double tensile_from_vickers(double vickers) { return positive(vickers, "hardness") * kTensilePerVickers; }
double vickers_from_tensile(double tensile) { return positive(tensile, "tensile strength") / kTensilePerVickers; }
double yield_from_vickers(double vickers, double yield_to_tensile) {
  return share_of_tensile(yield_to_tensile) * tensile_from_vickers(vickers);
}
double vickers_from_yield(double yield, double yield_to_tensile) {
  return vickers_from_tensile(positive(yield, "yield strength") / share_of_tensile(yield_to_tensile));
}
double flow_stress_from_vickers(double vickers) { return positive(vickers, "hardness") * kPressurePerVickers / 3; }
double vickers_from_flow_stress(double flow_stress) {
  return 3 * positive(flow_stress, "flow stress") / kPressurePerVickers;
}

}  // namespace railstrata
