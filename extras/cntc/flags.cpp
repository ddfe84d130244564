#include "cntc/flags.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace railstrata::cntc {
namespace {

constexpr int kAny = 1 << 30;
constexpr const char* kOfWheel = "is of module 1";

struct Rule {
  int code;
  int standard;   ///< CONTACT's default
  int low, high;  ///< values that are offered
  const char* name;
  const char* else_;  ///< what the others are, or why the flag has no effect
};

constexpr Rule kRules[] = {
    {kConfiguration, 1, -kAny, kAny, "C1, CONFIG", kOfWheel},
    {kTime, 2, 0, 2, "P, PVTIME", "P = 0 (goes on from the case before) and 2 (starts) are offered"},
    {kBound, 0, 0, 3, "B, BOUND",
     "B = 0 is offered, the traction bound of the full solution; 2 and 3 with M = 3 and 5"},
    {kTang, 3, 0, 3, "T, TANG", "T = 0 to 3 are offered"},
    {kNorm, 1, 0, 1, "N, NORM", "N = 0 and 1 are offered"},
    {kForce, 0, 0, 3, "F, FORCE", "F = 0 to 2 (module 3), 0, 1 and 3 (module 1) are offered"},
    {kFrictionLaw, 0, 1, 0, "L, FRCLAW", "is set by cntc_setfrictionmethod"},
    {kDiscretisation, 2, -kAny, kAny, "D, DISCNS", kOfWheel},
    {kInfluence, 2, 0, 2, "C3, INFLCF",
     "C3 = 2 is offered, piecewise constant tractions on half-spaces, and 0 and 1, as before"},
    {kMaterialLaw, 0, 1, 0, "M, MATER", "is set by cntc_setmaterialparameters"},
    {kExtraSlip, 0, 0, 1, "E, EXRHS", "E = 0 (none) and 1 (as set by cntc_setextrarigidslip) are offered"},
    {kDebug, 0, -kAny, kAny, "X, XFLOW", "has no effect: there is no such output"},
    {kHeat, 0, 1, 0, "H, HEAT", "is set by cntc_settemperaturedata"},
    {kEstimate, 0, 0, 3, "I, IESTIM", "I = 0 to 3 are offered"},
    {kOutput, 2, -kAny, kAny, "O, OUTPUT", ""},
    {kFlow, 4, -kAny, kAny, "W, FLOW", ""},
    {kReturn, 1, 0, 3, "R, RETURN", "R = 0 to 3 are offered"},
    {kMatFile, 1, -kAny, kAny, "A, MATFIL", "has no effect: no .mat file is written"},
    {kSensitivities, 1, 0, 1, "S2, SENS", "sensitivities are not computed: take differences of two solutions"},
    {kInfluenceMethod, 0, -kAny, kAny, "IF_METH", "is of conformal contact"},
    {kInfluenceVariant, 4, -kAny, kAny, "IF_VER", "is of conformal contact"},
    {kBlockOutput, 1, -kAny, kAny, "O_s, OUTPUT_SUBS", ""},
    {kBlockFile, 1, -kAny, kAny, "A_s, MATFIL_SUBS", "has no effect: no .subs file is written"},
    {kMostCells, 20000, -kAny, kAny, "NPOMAX", kOfWheel},
    {kPrintLevel, 1, -kAny, kAny, "IDEBUG", ""},
    {kLicenceTrace, 1, -kAny, kAny, "LICDBG", ""},
    {kWriteInput, 0, -kAny, kAny, "WRTINP", "has no effect: no .inp file is written"},
    {kTimers, 0, -kAny, kAny, "TIMERS", ""},
    {kCaseNumber, 0, -kAny, kAny, "NCASE", ""},
};

const Rule* rule_of(int code) {
  const auto* at = std::find_if(std::begin(kRules), std::end(kRules), [&](const Rule& r) { return r.code == code; });
  return at == std::end(kRules) ? nullptr : at;
}

bool offered(const Rule& rule, int value) {
  return value >= rule.low && value <= rule.high && !((rule.code == kTime || rule.code == kBound) && value == 1);
}

}  // namespace

int flag(const Settings& settings, int code) {
  const auto at = settings.flags.find(code);
  if (at != settings.flags.end()) return at->second;
  const Rule* rule = rule_of(code);
  return rule ? rule->standard : -1;
}

std::string set_flag(Problem& problem, int code, int value) {
  if (code == kUnits) {
    problem.units = units_of(value);
    return "";
  }
  const Rule* rule = rule_of(code);
  if (!rule) return fmt::format("flag {} is not known: it has no effect", code);
  const bool of_other_module = code == kForce && value == (problem.of_wheel ? 2 : 3);
  if (!offered(*rule, value) || of_other_module)
    throw Refused(kOther, fmt::format("flag {} ({}) = {}: {}", code, rule->name, value, rule->else_));
  const bool as_before = code == kInfluence && value < 2;
  if (!as_before) problem.settings.flags[code] = value;
  if (code == kCaseNumber) problem.cases = std::max(0, value - 1);
  const bool used = problem.of_wheel && std::string_view(rule->else_) == kOfWheel;
  const bool idle = !used && rule->low == -kAny && value > 0 && rule->else_[0] != '\0';
  return idle ? fmt::format("flag {} ({}) = {} {}", code, rule->name, value, rule->else_) : "";
}

int get_flag(const Problem& problem, int code) {
  const Settings& s = problem.settings;
  if (code == kUnits) return problem.units.code;
  if (code == kCaseNumber) return problem.cases;
  if (code == kFrictionLaw) return s.friction ? s.friction->digit : 0;
  if (code == kHeat) return s.heat ? 3 : 0;
  if (code == kMaterialLaw && s.materials.viscosity) return 1;
  if (code == kMaterialLaw && s.materials.simplified) return s.materials.simplified->strips ? 5 : 3;
  if (code == kMaterialLaw) return s.materials.film.thickness > 0 ? 4 : 0;
  return flag(s, code);
}

}  // namespace railstrata::cntc
