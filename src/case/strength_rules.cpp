#include "case/strength_rules.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "case/units.hpp"
#include "core/faults.hpp"
#include "damage/grades.hpp"

namespace railstrata {
namespace {

constexpr double kRoundOff = 1e-9;              // m
constexpr double kPascalOfVickers = 9.80665e6;  // a hardness of 1 HV is 1 kgf/mm²
/// A ball or a pyramid is pressed in by a mean pressure of 2.5 to 3 times the yield strength [Johnson1985 6.3].
constexpr double kLeastConstraint = 2.5;

std::string pressure(double value) { return format_quantity(value, dimension::kPressure); }
std::string length(double value) { return format_quantity(value, dimension::kLength); }

class Rules {
 public:
  Rules(std::string table, const StrengthSpec& strength, CaseSource& source)
      : table_(std::move(table)), s_(strength), source_(source) {}

  void check() const {
    check_grade();
    check_pair();
    check_against_tensile();
    check_against_hardness();
  }

  /// Tables of a layer go down to its bottom.
  void check_reach(double thickness) const {
    reach("strength_table", s_.strength_table, thickness);
    reach("hardness_table", s_.hardness_table, thickness);
    reach("initial_stress_table", s_.initial_stress_table, thickness);
  }

 private:
  std::string key(const char* name) const { return fmt::format("{}.{}", table_, name); }
  void complain(const char* name, const std::string& what, const std::string& remedy) const {
    if (source_.sound({key(name)})) source_.complain(key(name), fmt::format("{}{}", key(name), what), remedy);
  }

  void check_grade() const {
    if (s_.grade.empty()) return;
    try {
      grade(s_.grade);
    } catch (const CaseError& e) {
      complain("grade", fmt::format(": {}", e.diagnostics.front().message), e.diagnostics.front().remedy);
    }
  }

  void check_pair() const {
    if (s_.initial_stress.empty() || s_.initial_stress.size() == 2) return;
    complain("initial_stress",
             fmt::format(": has {} value{}, must have two: the longitudinal and the lateral stress",
                         s_.initial_stress.size(), s_.initial_stress.size() == 1 ? "" : "s"),
             R"(write e.g. ["-344 MPa", "-200 MPa"])");
  }

  void check_against_tensile() const {
    if (s_.yield_strength && s_.tensile_strength && *s_.yield_strength > *s_.tensile_strength)
      complain("tensile_strength",
               fmt::format(" = {}: must be at least yield_strength = {}", pressure(*s_.tensile_strength),
                           pressure(*s_.yield_strength)),
               "a material does not yield beyond its tensile strength: correct one of them");
  }

  void check_against_hardness() const {
    if (!s_.yield_strength || !s_.hardness) return;
    const double most = *s_.hardness * kPascalOfVickers / kLeastConstraint;
    if (*s_.yield_strength <= most) return;
    complain(
        "hardness",
        fmt::format(" = {}: does not fit to yield_strength = {}, a material of this hardness yields at {:.0f} MPa "
                    "at most",
                    format_quantity(*s_.hardness, dimension::kHardness), pressure(*s_.yield_strength), 1e-6 * most),
        "correct one of them; hardness is about three times the yield strength");
  }

  template <class Row>
  void reach(const char* name, const std::vector<Row>& rows, double thickness) const {
    if (rows.empty() || rows.back().depth >= thickness - kRoundOff) return;
    complain(name, fmt::format(": ends at {}, the layer is {} thick", length(rows.back().depth), length(thickness)),
             fmt::format("add a row at {}", length(thickness)));
  }

  std::string table_;
  const StrengthSpec& s_;
  CaseSource& source_;
};

}  // namespace

void check_strengths(const CaseSpec& spec, CaseSource& source) {
  Rules("material.rail", spec.rail_material.strength, source).check();
  Rules("material.wheel", spec.wheel_material.strength, source).check();
  for (std::size_t i = 0; i < spec.layers.size(); ++i) {
    const Rules rules(fmt::format("layer.{}", i), spec.layers[i].material.strength, source);
    rules.check();
    rules.check_reach(spec.layers[i].thickness);
  }
}

}  // namespace railstrata
