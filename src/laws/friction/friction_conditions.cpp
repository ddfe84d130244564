#include "friction/friction_conditions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numbers>
#include <string>

#include "core/faults.hpp"
#include "core/nearest_word.hpp"

namespace railstrata {
namespace {

constexpr std::string_view kPolach =
    "usual parameters of Polach's law [Polach2005]; the lower first slope of a wet rail is modelled by a film";
constexpr std::string_view kHou =
    "film measured in shear [HouKalousekMagel1997], as in CONTACT's examples, up to a shear of about 0.55 mm; the "
    "coefficient above it is not measured";

/// mu_0 (A + (1 - A) exp(-B v)), B in s/m.
FallingFriction polach(double limit_share, double rate) {
  return {FrictionForm::falling_exponential, limit_share, std::numbers::ln2 / rate, 0, 0};
}

/// A film of 20 um with shear modulus, yield stress and what softening leaves in MPa, hardening in MPa/mm.
FrictionCondition film(std::string_view name, double modulus, double yield, double hardening, double residual = 0) {
  return {name, Certainty::published,
          kHou, 0.7,
          0.7,  0.7,
          {},   {20e-6, modulus * 1e6, yield * 1e6, hardening * 1e9, residual * 1e6}};
}

}  // namespace

const std::vector<FrictionCondition>& friction_conditions() {
  static const std::vector<FrictionCondition> all{
      {"dry", Certainty::estimated, kPolach, 0.55, 0.4, 0.65, polach(0.4, 0.6), {}},
      {"wet", Certainty::estimated, kPolach, 0.30, 0.2, 0.4, polach(0.4, 0.2), {}},
      {"locomotive",
       Certainty::published,
       "fitted to the measured creep curve of locomotive 127 001 (Engel, Beck and Alders 1998), as in CONTACT's user "
       "guide",
       0.33,
       0.26,
       0.35,
       {FrictionForm::falling_exponential, 0.14 / 0.33, 1.25, 28e-6, 1e-3},
       {1e-3, 6.56e9, 0, 0, 0}},
      {"friction_modifier",
       Certainty::published,
       "target of drying top-of-rail products, 0.3 to 0.4; on a heavy locomotive 0.10 to 0.25 was measured (Lundberg "
       "et "
       "al. 2015)",
       0.35,
       0.1,
       0.4,
       {},
       {}},
      {"greased", Certainty::estimated, "usual aim of gauge-face lubrication", 0.15, 0.05, 0.25, {}, {}},
      film("magnetite", 176.63, 560, 0),
      film("clay", 106.25, 200, 435),
      film("sand", 176.63, 400, -195, 300),
      film("molybdenum_disulphide", 20.238, 20, 20.4)};
  return all;
}

const FrictionCondition& friction_condition(std::string_view name) {
  std::vector<std::string> names;
  for (const FrictionCondition& c : friction_conditions()) {
    if (c.name == name) return c;
    names.emplace_back(c.name);
  }
  const std::string near = nearest_word(std::string(name), names);
  throw CaseError(fmt::format("there is no friction condition called \"{}\"", name),
                  fmt::format("{}Known: {}", near.empty() ? "" : fmt::format("did you mean \"{}\"? ", near),
                              fmt::join(names, ", ")));
}

}  // namespace railstrata
