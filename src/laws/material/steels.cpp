#include "material/steels.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/faults.hpp"
#include "core/nearest_word.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

constexpr double kYoung = 206e9;

/// The least squares fit of relative stress at 60 amplitudes, geometrically spaced, over K': the curve of one exponent
/// is one curve times K' (extras/calibrate/tests/calibrate_test.cpp repeats the fit).
struct Term {
  double modulus, recall;
};
constexpr double kYieldShare = 0.150199;
constexpr std::array<Term, 4> kFlowTerms{{{230.112, 4000}, {55.7830, 700}, {14.7029, 120}, {3.42482, 8}}};

constexpr std::string_view kRail = "EN 13674-1, minimum";
constexpr std::string_view kRailHardness = "EN 13674-1, range of the running surface";
constexpr std::string_view kRailYield = "usual Rp0.2; EN 13674-1 asks for none";
constexpr std::string_view kWheel = "EN 13262, minimum of the rim";
constexpr std::string_view kWheelTensile = "EN 13262, range of the rim";
constexpr std::string_view kHadfield = "usual values, cast, not hardened";
constexpr std::string_view kBainitic = "usual values";
constexpr std::string_view kReference = "the steel of the tests of the USFD function, Lewis 2004";
constexpr std::string_view kSofterWear = "a country's network measured twice, Vernaillen 2024";
constexpr std::string_view kHarderWear = "trials in tracks, a third of 900A, Girsch and Heyder, Railway Gazette";
constexpr std::string_view kEstimate = "FKM estimate of the cyclic curve from tensile strength (Wächter 2016)";
constexpr std::string_view kRollover =
    "example settings of a public rollover simulation (KnutAM/AbaqusRolloverSimulation), not a named grade";
constexpr std::string_view kStored =
    "stored sets of a public transformation-plasticity model (ElasticPlasticTransformMaterial)";

SteelNumber standard(double low, double high, double unit, std::string_view source) {
  return {low * unit, high * unit, Certainty::standard_minimum, source};
}
SteelNumber estimated(double low, double high, double unit, std::string_view source) {
  return {low * unit, high * unit, Certainty::estimated, source};
}

/// With hardening estimated from its tensile strength.
Steel hardening(Steel steel) {
  steel.hardening = {Certainty::estimated, kEstimate, estimated_hardening(steel.tensile.low), kYoung};
  return steel;
}

/// Usual yield strengths (0: not known), least tensile strength, range of hardness.
Steel rail(std::string_view name, double yield_low, double yield_high, double tensile, double soft, double hard) {
  Steel out = hardening({name,
                         "rail",
                         yield_low > 0 ? estimated(yield_low, yield_high, kMega, kRailYield) : SteelNumber{},
                         standard(tensile, tensile, kMega, kRail),
                         standard(soft, hard, 1, kRailHardness),
                         {}});
  out.pearlite = true;
  return out;
}
/// Least yield strength, range of tensile strength, least hardness.
Steel wheel(std::string_view name, double yield, double tensile_low, double tensile_high, double hardness) {
  Steel out = hardening({name,
                         "wheel",
                         standard(yield, yield, kMega, kWheel),
                         standard(tensile_low, tensile_high, kMega, kWheelTensile),
                         standard(hardness, hardness, 1, kWheel),
                         {}});
  out.pearlite = true;
  return out;
}
Steel wearing(Steel steel, double over_reference, std::string_view source) {
  steel.wear = {over_reference, over_reference, Certainty::published, source};
  return steel;
}

PlasticParameters<double> law(double yield, double saturation, double rate, std::initializer_list<Term> terms) {
  PlasticParameters<double> out{0, yield * kMega, saturation * kMega, rate, {}, {}};
  int k = 0;
  for (const Term& t : terms) {
    out.modulus[k] = t.modulus * kMega;
    out.recall[k++] = t.recall;
  }
  return out;
}

/// A set of hardening that can be traced to a source, of a steel whose strengths are not known.
Steel published(std::string_view name, std::string_view source, std::string_view use, double young,
                const PlasticParameters<double>& p) {
  return {name, use, {}, {}, {}, {Certainty::published, source, p, young * 1e9}};
}

/// Steels with something, and what their users call it.
struct Shelf {
  bool (*holds)(const Steel&);
  const char *word, *otherwise;

  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const Steel& s : steels())
      if (holds(s)) out.emplace_back(s.name);
    return out;
  }
  const Steel* find(std::string_view name) const {
    for (const Steel& s : steels())
      if (holds(s) && edit_distance(s.name, name) == 0) return &s;
    return nullptr;
  }
  const Steel& required(std::string_view name) const {
    if (const Steel* found = find(name)) return *found;
    const std::vector<std::string> known = names();
    const std::string near = nearest_word(name, known);
    throw CaseError(
        fmt::format("no {} \"{}\"", word, name),
        fmt::format("{}Known are {}; for any other steel give {}",
                    near.empty() ? "" : fmt::format("did you mean \"{}\"? ", near), fmt::join(known, ", "), otherwise));
  }
};
constexpr Shelf kGrades{[](const Steel& s) { return s.tensile.known(); }, "grade", "yield_strength and hardness"};
constexpr Shelf kSets{[](const Steel& s) { return s.hardening.known(); }, "hardening set",
                      "isotropic_hardening and kinematic_hardening, or tensile_strength with hardening = "
                      "\"estimated\""};

}  // namespace

const std::vector<Steel>& steels() {
  static const std::vector<Steel> all{
      wearing(rail("R200", 0, 0, 680, 200, 240), 1.34, kSofterWear),
      rail("R220", 430, 460, 770, 220, 260),
      wearing(rail("R260", 470, 500, 880, 260, 300), 1, kReference),
      wearing(rail("R350HT", 760, 820, 1175, 350, 390), 1.0 / 3, kHarderWear),
      rail("R400HT", 850, 950, 1280, 400, 440),
      hardening({"B320", "rail", {}, estimated(1100, 1100, kMega, kBainitic), estimated(320, 360, 1, kBainitic), {}}),
      wheel("ER7", 520, 820, 940, 235),
      wearing(wheel("ER8", 540, 860, 980, 245), 1, kReference),
      wheel("ER9", 580, 900, 1050, 255),
      {"Hadfield",
       "crossing",
       estimated(360, 400, kMega, kHadfield),
       estimated(1000, 1000, kMega, kHadfield),
       estimated(200, 200, 1, kHadfield),
       {}},
      published("meyer_example", kRollover, "example", 210, law(500, 100, 4, {{20000, 400}, {10, 0}})),
      published("case_martensite_SS2506", kStored, "hard layer", 200,
                law(963.8, 0, 0, {{34568, 41.72}, {165655, 305.7}, {511479, 758.7}})),
      published("carburised_4320_NeuSehitoglu", kStored, "hard layer", 203.3,
                law(675.5, 0, 0, {{335485, 1016.5}, {245783, 185}, {6853, 0}})),
      published("bearing_martensite_Hazar", kStored, "hard layer", 200.5,
                law(884.9, 180, 100, {{135000, 950}, {700000, 500}, {50000, 50}}))};
  return all;
}

const Steel& grade(std::string_view name) { return kGrades.required(name); }
const Steel* find_grade(std::string_view name) { return kGrades.find(name); }
std::vector<std::string> grade_names() { return kGrades.names(); }

const Steel& hardening_set(std::string_view name) { return kSets.required(name); }
std::vector<std::string> hardening_set_names() { return kSets.names(); }

double cyclic_strength_coefficient(double tensile) {
  const double rm = tensile / kMega, ductility = std::min(0.338, 1033 * std::pow(rm, -1.235));
  return 3.1148 * kMega * std::pow(rm, 0.897) / std::pow(ductility, kCyclicExponent);
}

EstimatedEndurance estimated_endurance(double tensile) {
  constexpr double kInTension = 0.45, kShearOverTension = 0.577;
  return {kShearOverTension * kInTension * tensile, 3 * (kShearOverTension - 0.5)};
}

PlasticParameters<double> estimated_hardening(double tensile) {
  const double k = cyclic_strength_coefficient(tensile);
  PlasticParameters<double> out{0, kYieldShare * k, 0, 0, {}, {}};
  for (std::size_t i = 0; i < kFlowTerms.size(); ++i) {
    out.modulus[i] = kFlowTerms[i].modulus * k;
    out.recall[i] = kFlowTerms[i].recall;
  }
  return out;
}

}  // namespace railstrata
