#include "model/material_strength.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/faults.hpp"
#include "damage/hardness.hpp"
#include "material/elastic.hpp"
#include "record/unit.hpp"
#include "text/units.hpp"

namespace railstrata {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kRoundOff = 1e-9;      // m
constexpr double kOtherModulus = 0.03;  // a set fitted with a modulus further off than this is worth a word

template <class Row>
double column_at(const std::vector<Row>& rows, double depth, double Row::*column, const std::string& key) {
  if (depth > rows.back().depth + kRoundOff)
    throw CaseError(fmt::format("{}: ends at {}, stresses are looked at down to {}", key,
                                format_quantity(rows.back().depth, dimension::kLength),
                                format_quantity(std::round(1e6 * depth) / 1e6, dimension::kLength)),
                    fmt::format("add a row at {} or deeper, with what the material has there",
                                format_quantity(std::ceil(1e3 * depth) / 1e3, dimension::kLength)));
  std::size_t i = 1;
  while (i + 1 < rows.size() && rows[i].depth < depth) ++i;
  const Row &a = rows[i - 1], &b = rows[i];
  const double t = std::clamp((depth - a.depth) / (b.depth - a.depth), 0.0, 1.0);
  return a.*column + t * (b.*column - a.*column);
}

/// The rows over a reference.
std::vector<DepthPoint> over(std::vector<DepthPoint> rows, double reference) {
  for (DepthPoint& row : rows) row.value /= reference;
  return rows;
}

/// Two rows of one factor, as a table; nothing of a factor of 1.
std::vector<DepthPoint> everywhere(double factor) {
  return factor == 1 ? std::vector<DepthPoint>() : std::vector<DepthPoint>{{0, factor}, {1, factor}};
}

class LawOf {
 public:
  LawOf(const MaterialSpec& material, const std::string& name, const std::string& key)
      : m_(material), s_(material.strength), name_(name), set_(hardening_name(s_)), strength_(s_, name, key) {}

  PlasticLaw law() {
    const Elastic e = elastic(m_.young, m_.poisson, m_.density);
    out_.top.lambda = e.lambda;
    if (set_.empty())
      given();
    else if (set_ == kEstimatedHardening)
      estimated();
    else
      ready(hardening_set(set_));
    out_.top.plastic.mu = e.mu;
    out_.top.plastic.power = s_.recall_power;
    if (s_.recall_power > 0 && !set_.empty())
      out_.notes.push_back(
          fmt::format("hardening of {}: the set was fitted with recall_power = 0; with {} its cycles are stiffer",
                      name_, s_.recall_power));
    if (s_.recall_power > 0 &&
        *std::max_element(out_.top.plastic.modulus, out_.top.plastic.modulus + kMostBackstresses) == 0)
      out_.notes.push_back(fmt::format(
          "recall_power of {} has no effect: it has no backstress; give hardening or kinematic_hardening", name_));
    return std::move(out_);
  }

 private:
  void given() {
    PlasticParameters<double>& p = out_.top.plastic;
    p.yield = strength_.yield(0);
    if (s_.isotropic_hardening) {
      p.saturation = s_.isotropic_hardening->saturation;
      p.rate = s_.isotropic_hardening->rate;
    }
    for (std::size_t k = 0; k < s_.kinematic_hardening.size(); ++k) {
      p.modulus[k] = s_.kinematic_hardening[k].modulus;
      p.recall[k] = s_.kinematic_hardening[k].recall;
    }
    if (std::string note = strength_.note(); !note.empty()) out_.notes.push_back(std::move(note));
    if (!s_.strength_table.empty())
      out_.factor = over(s_.strength_table, p.yield);
    else if (!s_.hardness_table.empty())
      out_.factor = over(s_.hardness_table, s_.hardness_table.front().value);
  }

  void estimated() {
    const double tensile = strength_.tensile();
    out_.top.plastic = estimated_hardening(tensile);
    scale_by_hardness(vickers_from_tensile(tensile));
    out_.notes.push_back(fmt::format(
        "hardening of {}: estimated from a tensile strength of {:.0f} MPa{} "
        "(FKM estimate of the cyclic curve, Wächter 2016)",
        name_, 1e-6 * tensile, s_.tensile_strength || !s_.grade.empty() ? "" : ", itself estimated from hardness"));
    note_start();
  }

  void ready(const Steel& steel) {
    const HardeningSet& set = steel.hardening;
    out_.top.plastic = set.law;
    if (steel.tensile.known())
      scale_by_hardness(vickers_from_tensile(steel.tensile.low));
    else if (!s_.hardness_table.empty())
      out_.factor = over(s_.hardness_table, s_.hardness_table.front().value);
    out_.notes.push_back(
        fmt::format("hardening of {}: set {}, {} ({})", name_, steel.name, certainty_text(set.certainty), set.source));
    if (std::abs(m_.young / set.young - 1) > kOtherModulus)
      out_.notes.push_back(fmt::format("hardening of {}: set {} was fitted with a modulus of {}, the material has {}",
                                       name_, steel.name, format_quantity(set.young, dimension::kPressure),
                                       format_quantity(m_.young, dimension::kPressure)));
    note_start();
  }

  void scale_by_hardness(double reference) {
    if (!s_.hardness_table.empty())
      out_.factor = over(s_.hardness_table, reference);
    else if (s_.hardness)
      out_.factor = everywhere(*s_.hardness / reference);
    else
      return;
    out_.notes.push_back(fmt::format("hardening of {}: scaled by hardness over the {:.0f} HV that the set stands for",
                                     name_, reference));
  }

  /// The proof stress of a case and the beginning of yielding of a cyclic law are two numbers.
  void note_start() {
    if (s_.yield_strength || !s_.strength_table.empty())
      out_.notes.push_back(
          fmt::format("hardening of {}: the set begins to yield at {:.0f} MPa; the yield strength "
                      "given serves shakedown and fatigue alone",
                      name_, 1e-6 * out_.at(0).plastic.yield));
  }

  const MaterialSpec& m_;
  const StrengthSpec& s_;
  const std::string& name_;
  std::string_view set_;
  MaterialStrength strength_;
  PlasticLaw out_;
};

}  // namespace

double at_depth(const std::vector<DepthPoint>& rows, double depth, const std::string& key) {
  return column_at(rows, depth, &DepthPoint::value, key);
}

StressPoint process_stress(const StrengthSpec& strength, double depth, const std::string& key) {
  if (!strength.initial_stress.empty()) return {depth, strength.initial_stress[0], strength.initial_stress[1]};
  const std::vector<StressPoint>& rows = strength.initial_stress_table;
  if (rows.empty()) return {depth, 0, 0};
  const double known = std::min(depth, rows.back().depth);
  const std::string table = key + ".initial_stress_table";
  return {depth, column_at(rows, known, &StressPoint::longitudinal, table),
          column_at(rows, known, &StressPoint::lateral, table)};
}

MaterialStrength::MaterialStrength(const StrengthSpec& strength, std::string name, std::string key)
    : s_(strength), name_(std::move(name)), key_(std::move(key)) {
  if (!s_.grade.empty()) grade_ = grade(s_.grade);
}

double MaterialStrength::hardness(double depth) const {
  if (!s_.hardness_table.empty()) return at_depth(s_.hardness_table, depth, key_ + ".hardness_table");
  return s_.hardness.value_or(kUnknown);
}

double MaterialStrength::yield(double depth) const {
  if (s_.yield_strength) return *s_.yield_strength;
  if (!s_.strength_table.empty()) return at_depth(s_.strength_table, depth, key_ + ".strength_table");
  if (grade_ && grade_->yield.known()) return grade_->yield.low;
  const double vickers = hardness(depth);
  return std::isnan(vickers) ? kUnknown : yield_from_vickers(vickers, s_.yield_to_tensile);
}

double MaterialStrength::tensile() const {
  if (s_.tensile_strength) return *s_.tensile_strength;
  if (grade_ && grade_->tensile.known()) return grade_->tensile.low;
  const double vickers = hardness(0);
  return std::isnan(vickers) ? kUnknown : tensile_from_vickers(vickers);
}

EstimatedEndurance MaterialStrength::endurance() const {
  EstimatedEndurance out{kUnknown, 0};
  if (grade_) out = estimated_endurance(tensile());
  out.limit = s_.fatigue.limit.value_or(out.limit);
  if (s_.fatigue.dang_van)
    out.weight = *s_.fatigue.dang_van;
  else if (!grade_)
    out.limit = kUnknown;
  return out;
}

double MaterialStrength::end() const {
  const std::vector<DepthPoint>& table = !s_.strength_table.empty() ? s_.strength_table : s_.hardness_table;
  return table.empty() ? std::numeric_limits<double>::infinity() : table.back().depth;
}

std::string MaterialStrength::note() const {
  if (s_.yield_strength || !s_.strength_table.empty()) return {};
  if (grade_ && grade_->yield.known())
    return fmt::format("yield strength of {}: {:.0f} MPa of grade {}, {} ({})", name_, 1e-6 * grade_->yield.low,
                       grade_->name, certainty_text(grade_->yield.certainty), grade_->yield.source);
  if (s_.hardness || !s_.hardness_table.empty())
    return fmt::format("yield strength of {}: estimated from hardness as {:g} x 3.2 MPa x HV", name_,
                       s_.yield_to_tensile);
  return {};
}

std::string MaterialStrength::endurance_note() const {
  if (!grade_ || (s_.fatigue.limit && s_.fatigue.dang_van)) return {};
  return fmt::format(
      "endurance of {} (Dang Van): {:.0f} MPa and {:.3f}, estimated from a tensile strength of {:.0f} MPa "
      "(FKM guideline); {}.fatigue_limit and dang_van_coefficient give those of a test",
      name_, kToMega * endurance().limit, endurance().weight, kToMega * tensile(), key_);
}

std::optional<StrainLifeOfMaterial> strain_life_of(const MaterialSpec& material, const std::string& name,
                                                   const std::string& key) {
  if (const FatigueSpec& f = material.strength.fatigue; f.strength_coefficient) {
    const StrainLife given{*f.strength_coefficient, f.strength_exponent.value(), f.ductility_coefficient.value(),
                           f.ductility_exponent.value()};
    return StrainLifeOfMaterial{given, given, {}};
  }
  const double tensile = MaterialStrength(material.strength, name, key).tensile();
  if (std::isnan(tensile)) return std::nullopt;
  const std::optional<StrainLife> law = uniform_material_law(tensile, material.young);
  if (!law) return std::nullopt;
  return StrainLifeOfMaterial{
      *law, median_strain_life(tensile),
      fmt::format("strain-life curve of {}: two estimates from a tensile strength of {:.0f} MPa "
                  "({}.fatigue_strength_coefficient and its neighbours: that of a test)",
                  name, kToMega * tensile, key)};
}

std::string_view hardening_name(const StrengthSpec& s) {
  if (!s.hardening.empty() || s.yield_strength || !s.strength_table.empty() || s.isotropic_hardening ||
      !s.kinematic_hardening.empty())
    return s.hardening;
  const Steel* const steel = find_grade(s.grade);
  return steel && steel->hardening.known() ? steel->name : std::string_view();
}

bool has_strength(const StrengthSpec& s) {
  return s.yield_strength || s.hardness || !s.strength_table.empty() || !s.hardness_table.empty() || !s.grade.empty();
}

PlasticMaterial PlasticLaw::at(double depth) const {
  if (factor.empty()) return top;
  PlasticMaterial out = top;
  out.plastic = scaled(top.plastic, at_depth(factor, std::min(depth, factor.back().depth), "factor"));
  return out;
}

std::optional<PlasticLaw> plastic_law(const MaterialSpec& material, const std::string& name, const std::string& key) {
  const StrengthSpec& s = material.strength;
  if (s.elastic) return std::nullopt;
  if (hardening_name(s).empty() && std::isnan(MaterialStrength(s, name, key).yield(0))) return std::nullopt;
  return LawOf(material, name, key).law();
}

}  // namespace railstrata
