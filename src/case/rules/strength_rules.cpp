#include "rules/case_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/faults.hpp"
#include "material/plastic.hpp"
#include "material/steels.hpp"
#include "spec/case_spec.hpp"
#include "text/units.hpp"

namespace railstrata {
namespace {

constexpr double kRoundOff = 1e-9;              // m
constexpr double kPascalOfVickers = 9.80665e6;  // a hardness of 1 HV is 1 kgf/mm²
/// A ball or a pyramid is pressed in by a mean pressure of 2.5 to 3 times the yield strength [Johnson1985 6.3].
constexpr double kLeastConstraint = 2.5;

std::string pressure_text(double value) { return format_quantity(value, dimension::kPressure); }
std::string length_text(double value) { return format_quantity(value, dimension::kLength); }

/// A property with depth as the case gives it; a value that is the same everywhere is one row.
struct Said {
  std::string name;
  std::vector<DepthPoint> rows;
};

bool by_value(const DepthPoint& a, const DepthPoint& b) { return a.value < b.value; }

/// Linear between rows, the first and the last value beyond them.
double at_depth(const std::vector<DepthPoint>& rows, double depth) {
  std::size_t i = 0;
  while (i < rows.size() && rows[i].depth < depth) ++i;
  if (i == 0 || i == rows.size()) return rows[i == 0 ? 0 : i - 1].value;
  const DepthPoint &a = rows[i - 1], &b = rows[i];
  return a.value + (depth - a.depth) / (b.depth - a.depth) * (b.value - a.value);
}

class StrengthRules {
 public:
  StrengthRules(std::string table, const MaterialSpec& material, CaseSource& source)
      : table_(std::move(table)), material_(material), s_(material.strength), source_(source) {}

  void check() const {
    check_name("grade", s_.grade, grade);
    check_hardening_name();
    check_hardening();
    check_elastic();
    check_pair();
    check_against_tensile();
    check_against_hardness();
    check_strain_life();
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

  /// A name in a table of steels.
  void check_name(const char* name, const std::string& value, const Steel& (*find)(std::string_view)) const {
    if (value.empty()) return;
    try {
      find(value);
    } catch (const CaseError& e) {
      complain(name, fmt::format(": {}", e.diagnostics.front().message), e.diagnostics.front().remedy);
    }
  }

  void check_hardening_name() const {
    if (s_.hardening != kEstimatedHardening)
      check_name("hardening", s_.hardening, hardening_set);
    else if (!s_.tensile_strength && !s_.hardness && s_.hardness_table.empty() && s_.grade.empty())
      complain("hardening", " = \"estimated\": needs tensile_strength, a grade or hardness",
               "add for example tensile_strength = \"880 MPa\"");
  }

  bool begins_to_yield() const {
    return s_.yield_strength || !s_.strength_table.empty() || !s_.grade.empty() || s_.hardness ||
           !s_.hardness_table.empty();
  }

  void check_hardening() const {
    const char* const given = s_.isotropic_hardening            ? "isotropic_hardening"
                              : !s_.kinematic_hardening.empty() ? "kinematic_hardening"
                                                                : nullptr;
    if (!given) return;
    if (!begins_to_yield())
      complain(given, ": gives how the material hardens, but not where it begins to yield",
               "add for example yield_strength = \"300 MPa\"");
    if (s_.kinematic_hardening.size() > kMostBackstresses)
      complain("kinematic_hardening",
               fmt::format(": has {} backstresses, at most {} are computed", s_.kinematic_hardening.size(),
                           kMostBackstresses),
               "keep four: `railstrata material --calibrate` fits as many as a test needs");
    if (s_.isotropic_hardening) check_softening(*s_.isotropic_hardening);
  }

  /// A softening material must keep some strength, and must not soften faster than it unloads.
  void check_softening(const IsotropicHardening& h) const {
    double least = s_.yield_strength.value_or(std::numeric_limits<double>::infinity());
    for (const DepthPoint& row : s_.strength_table) least = std::min(least, row.value);
    if (!(least + h.saturation > 0))
      complain("isotropic_hardening",
               fmt::format(": saturation = {} takes the whole yield strength of {} away", pressure_text(h.saturation),
                           pressure_text(least)),
               "the sum of both must be above zero");
    if (h.saturation != 0 && h.rate == 0)
      complain("isotropic_hardening",
               fmt::format(": saturation = {} is never reached at rate = 0", pressure_text(h.saturation)),
               "give the rate b of sigma = saturation (1 - exp(-b p)), 5 to 20 is usual, or leave both out");
    const double shear = material_.young / (2 * (1 + material_.poisson));
    if (!(3 * shear + h.saturation * h.rate > 0))
      complain("isotropic_hardening",
               fmt::format(": softens by saturation x rate = {}, faster than the material unloads, 3 G = {}",
                           pressure_text(-h.saturation * h.rate), pressure_text(3 * shear)),
               "lower the rate");
  }

  /// One number of a strain-life curve and an estimate of the others would be no curve.
  void check_strain_life() const {
    const FatigueSpec& f = s_.fatigue;
    const std::pair<const char*, bool> given[] = {
        {"fatigue_strength_coefficient", f.strength_coefficient.has_value()},
        {"fatigue_strength_exponent", f.strength_exponent.has_value()},
        {"fatigue_ductility_coefficient", f.ductility_coefficient.has_value()},
        {"fatigue_ductility_exponent", f.ductility_exponent.has_value()}};
    const auto* const some = std::find_if(std::begin(given), std::end(given), [](const auto& k) { return k.second; });
    const auto* const none = std::find_if(std::begin(given), std::end(given), [](const auto& k) { return !k.second; });
    if (some != std::end(given) && none != std::end(given))
      complain(some->first, fmt::format(": the strain-life curve needs {} too", none->first),
               "give all four numbers of the curve, or none: then it is estimated from the tensile strength");
  }

  void check_elastic() const {
    if (s_.elastic && (!s_.hardening.empty() || s_.isotropic_hardening || !s_.kinematic_hardening.empty()))
      complain("elastic", " = true: the material has a law of hardening too",
               "keep one of them: what is elastic on purpose does not harden");
  }

  void check_pair() const {
    if (s_.initial_stress.empty() || s_.initial_stress.size() == 2) return;
    complain("initial_stress",
             fmt::format(": has {} value{}, must have two: the longitudinal and the lateral stress",
                         s_.initial_stress.size(), s_.initial_stress.size() == 1 ? "" : "s"),
             R"(write e.g. ["-344 MPa", "-200 MPa"])");
  }

  /// The yield strength that the case gives, and under which name; a hardness is none.
  Said yield() const {
    if (s_.yield_strength) return {"yield_strength", {{0, *s_.yield_strength}}};
    if (!s_.strength_table.empty()) return {"strength_table", s_.strength_table};
    const Steel* known = find_grade(s_.grade);
    if (known && known->yield.known())
      return {fmt::format("the yield strength of {}", known->name), {{0, known->yield.low}}};
    return {};
  }

  Said hardness() const {
    if (s_.hardness) return {"hardness", {{0, *s_.hardness}}};
    return {"hardness_table", s_.hardness_table};
  }

  void check_against_tensile() const {
    const Said strength = yield();
    if (strength.rows.empty() || !s_.tensile_strength) return;
    const double most = std::max_element(strength.rows.begin(), strength.rows.end(), by_value)->value;
    if (most <= *s_.tensile_strength) return;
    complain("tensile_strength",
             fmt::format(" = {}: must be at least {} = {}", pressure_text(*s_.tensile_strength), strength.name,
                         pressure_text(most)),
             "a material does not yield beyond its tensile strength: correct one of them");
  }

  /// At every depth of one of the two.
  void check_against_hardness() const {
    const Said strength = yield(), hard = hardness();
    if (strength.rows.empty() || hard.rows.empty() || strength.name.starts_with("the ")) return;
    for (const std::vector<DepthPoint>* rows : {&hard.rows, &strength.rows})
      for (const DepthPoint& p : *rows) {
        const double value = at_depth(hard.rows, p.depth), there = at_depth(strength.rows, p.depth);
        const double most = value * kPascalOfVickers / kLeastConstraint;
        if (there <= most) continue;
        const bool everywhere = hard.rows.size() == 1 && strength.rows.size() == 1;
        const std::string depth = everywhere ? "" : fmt::format(" at a depth of {}", length_text(p.depth));
        complain(hard.name.c_str(),
                 fmt::format(" = {}{}: does not fit to {} = {}, a material of this hardness yields at {:.0f} MPa at "
                             "most",
                             format_quantity(value, dimension::kHardness), depth, strength.name, pressure_text(there),
                             1e-6 * most),
                 "correct one of them; hardness is about three times the yield strength");
        return;
      }
  }

  template <class Row>
  void reach(const char* name, const std::vector<Row>& rows, double thickness) const {
    if (rows.empty() || rows.back().depth >= thickness - kRoundOff) return;
    complain(name,
             fmt::format(": ends at {}, the layer is {} thick", length_text(rows.back().depth), length_text(thickness)),
             fmt::format("add a row at {}", length_text(thickness)));
  }

  std::string table_;
  const MaterialSpec& material_;
  const StrengthSpec& s_;
  CaseSource& source_;
};

}  // namespace

void check_strengths(const CaseSpec& spec, CaseSource& source) {
  StrengthRules("material.rail", spec.rail_material, source).check();
  StrengthRules("material.wheel", spec.wheel_material, source).check();
  for (std::size_t i = 0; i < spec.layers.size(); ++i) {
    const StrengthRules rules(fmt::format("layer.{}", i), spec.layers[i].material, source);
    rules.check();
    rules.check_reach(spec.layers[i].thickness);
  }
}

}  // namespace railstrata
