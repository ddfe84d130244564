#include "material/hardening_sets.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>

#include "core/faults.hpp"
#include "core/nearest_word.hpp"

#include "record/unit.hpp"

namespace railstrata {
namespace {

constexpr double kSteel = 206e9;

/// The least squares fit of relative stress at 60 amplitudes, geometrically spaced, over K': the curve of one exponent
/// is one curve times K' (tests/material/calibrate_test.cpp repeats the fit).
struct Term {
  double modulus, recall;
};
constexpr double kYieldShare = 0.150199;
constexpr std::array<Term, 4> kFlowTerms{{{230.112, 4000}, {55.7830, 700}, {14.7029, 120}, {3.42482, 8}}};

constexpr std::string_view kEstimate = "FKM estimate of the cyclic curve from tensile strength (Wächter 2016)";
constexpr std::string_view kRollover =
    "example settings of a public rollover simulation (KnutAM/AbaqusRolloverSimulation), not a named grade";
constexpr std::string_view kStored =
    "stored sets of a public transformation-plasticity model (ElasticPlasticTransformMaterial)";

PlasticParameters<double> law(double yield, double saturation, double rate, std::initializer_list<Term> terms) {
  PlasticParameters<double> out{0, yield * kMega, saturation * kMega, rate, {}, {}};
  int k = 0;
  for (const Term& t : terms) {
    out.modulus[k] = t.modulus * kMega;
    out.recall[k++] = t.recall;
  }
  return out;
}

HardeningSet estimated(std::string_view name, std::string_view use, double tensile) {
  return {name, Certainty::estimated, kEstimate, use, estimated_hardening(tensile * kMega), tensile * kMega, kSteel};
}

HardeningSet published(std::string_view name, std::string_view source, std::string_view use, double young,
                       const PlasticParameters<double>& p) {
  return {name, Certainty::published, source, use, p, 0, young * 1e9};
}

std::string capitals(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::toupper(c); });
  return out;
}

}  // namespace

double cyclic_strength_coefficient(double tensile) {
  const double rm = tensile / kMega, ductility = std::min(0.338, 1033 * std::pow(rm, -1.235));
  return 3.1148 * kMega * std::pow(rm, 0.897) / std::pow(ductility, kCyclicExponent);
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

const std::vector<HardeningSet>& hardening_sets() {
  static const std::vector<HardeningSet> all{
      estimated("R220", "rail", 770),
      estimated("R260", "rail", 880),
      estimated("R350HT", "rail", 1175),
      estimated("R400HT", "rail", 1280),
      estimated("B320", "rail", 1100),
      estimated("ER7", "wheel", 820),
      estimated("ER8", "wheel", 860),
      estimated("ER9", "wheel", 900),
      published("meyer_example", kRollover, "example", 210, law(500, 100, 4, {{20000, 400}, {10, 0}})),
      published("case_martensite_SS2506", kStored, "hard layer", 200,
                law(963.8, 0, 0, {{34568, 41.72}, {165655, 305.7}, {511479, 758.7}})),
      published("carburised_4320_NeuSehitoglu", kStored, "hard layer", 203.3,
                law(675.5, 0, 0, {{335485, 1016.5}, {245783, 185}, {6853, 0}})),
      published("bearing_martensite_Hazar", kStored, "hard layer", 200.5,
                law(884.9, 180, 100, {{135000, 950}, {700000, 500}, {50000, 50}}))};
  return all;
}

const HardeningSet& hardening_set(std::string_view name) {
  const std::string wanted = capitals(name);
  std::vector<std::string> names;
  std::string list;
  for (const HardeningSet& set : hardening_sets()) {
    if (capitals(set.name) == wanted) return set;
    names.emplace_back(set.name);
    list += (list.empty() ? "" : ", ") + names.back();
  }
  const std::string near = nearest_word(name, names);
  throw CaseError("no hardening set \"" + std::string(name) + "\"",
                  (near.empty() ? "" : "did you mean \"" + near + "\"? ") + "Known are " + list +
                      "; for any other steel give isotropic_hardening and kinematic_hardening, or tensile_strength "
                      "with hardening = \"estimated\"");
}

}  // namespace railstrata
