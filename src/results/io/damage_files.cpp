#include "io/damage_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "judge/judgement.hpp"
#include "record/csv.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"
#include "record/unit.hpp"
#include "result/result_table.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

Columns<ShakedownFactors> factor_columns() {
  using F = ShakedownFactors;
  return {{"first_yield", unit::kNone, &F::first_yield},
          {"wandering", unit::kNone, &F::wandering},
          {"single_track", unit::kNone, &F::single_track},
          {"upper", unit::kNone, &F::upper},
          {"kinematic", unit::kNone, &F::kinematic}};
}

Json factors_json(const ShakedownFactors& f) { return json_record(f, factor_columns()); }

Json governing_json(const BodyShakedown& b) {
  return {{"body", b.body}, {"zone", b.zone}, {"depth_m", json_number(b.depth)}, {"y_m", json_number(b.y)}};
}

Json body_json(const BodyShakedown& b) {
  Json out{{"body", b.body},
           {"factors", factors_json(b.factors)},
           {"verdict", verdict_text(verdict_of(b.factors))},
           {"governing", governing_json(b)}};
  for (const ZoneShakedown& z : b.zones)
    out["zones"].push_back({{"zone", z.zone},
                            {"depth_m", json_number(z.depth)},
                            {"factors", factors_json(z.factors)},
                            {"verdict", verdict_text(verdict_of(z.factors))}});
  out["notes"] = b.notes;
  return out;
}

Json answer_json(const Judgement& a) {
  const LastsRow& row = lasts_row(a.lasts);
  return {{"lasts", row.word},    {"title", row.title}, {"tone", row.tone},  {"zone", a.zone},
          {"decides", a.decides}, {"reason", a.reason}, {"doubts", a.doubts}};
}

Json value_json(const std::optional<FatigueValue>& v, const char* key) {
  if (!v) return nullptr;
  Json out{
      {key, json_number(v->value)}, {"zone", v->zone}, {"depth_m", json_number(v->depth)}, {"y_m", json_number(v->y)}};
  if (std::isfinite(v->x)) out["x_m"] = v->x;
  return out;
}

Json brittle_json(const BrittleSummary& brittle) {
  using B = BrittleSummary;
  static const Columns<B> columns{{"sigma1_max", unit::kMPa, &B::sigma1},
                                  {"depth", unit::kMillimetres, &B::depth},
                                  {"share_of_tensile_strength", unit::kNone, &B::share_of_tensile},
                                  {"critical_flaw", unit::kMillimetres, &B::critical_flaw},
                                  {"thickness", unit::kMillimetres, &B::thickness}};
  Json out{{"zone", brittle.zone}};
  out.update(json_record(brittle, columns));
  return out;
}

Json interface_json(const InterfaceSummary& interface) {
  using I = InterfaceSummary;
  static const Columns<I> columns{{"depth", unit::kMillimetres, &I::depth},
                                  {"tension", unit::kMPa, &I::tension},
                                  {"shear", unit::kMPa, &I::shear},
                                  {"shear_range", unit::kMPa, &I::shear_range},
                                  {"sigma_xx_range_above", unit::kMPa, &I::sigma_xx_range_above},
                                  {"sigma_xx_range_below", unit::kMPa, &I::sigma_xx_range_below},
                                  {"delamination", unit::kNone, &I::delamination}};
  Json out{{"above", interface.above}, {"below", interface.below}};
  out.update(json_record(interface, columns));
  return out;
}

/// A point of a section, or a row of it: what is there and what is asked for.
struct StrengthPoint {
  double y = 0, depth = 0;
  int zone = 0;
  double shear = 0, residual_x = 0, residual_y = 0;                 ///< Pa
  double first_yield = 0, wandering = 0, upper = 0, kinematic = 0;  ///< Pa, shear strengths that the limits ask for
};

constexpr double kUniaxial = std::numbers::sqrt3 * kToMega;  ///< of pure shear, in MPa

Columns<StrengthPoint> strength_columns() {
  using S = StrengthPoint;
  const auto uniaxial = [](const char* symbol, double S::*shear) {
    return Column<S>{symbol, unit::both("_Pa", "_MPa", kUniaxial, "MPa"), shear};
  };
  return {{"y", unit::kMillimetres, &S::y},
          {"depth", unit::kMillimetres, &S::depth},
          {"zone", unit::kCount, &S::zone},
          uniaxial("yield_strength", &S::shear),
          {"initial_stress_x", unit::kMPa, &S::residual_x},
          {"initial_stress_y", unit::kMPa, &S::residual_y},
          uniaxial("required_first_yield", &S::first_yield),
          uniaxial("required_wandering", &S::wandering),
          uniaxial("required_upper", &S::upper),
          uniaxial("required_kinematic", &S::kinematic),
          {"used", unit::kNone, [](const S& s) { return kUniaxial * s.upper / (kUniaxial * s.shear); }}};
}

void write_profile(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                   const SectionShakedown& s) {
  const RequiredStrength& r = s.found.required;
  std::vector<StrengthPoint> rows;
  for (std::size_t i = 0; i < s.depth.size(); ++i)
    rows.push_back({0, s.depth[i], s.zone[i], s.strength.shear[i], s.strength.residual_x[i], s.strength.residual_y[i],
                    r.first_yield[i], r.wandering[i], r.upper[i], r.kinematic[i]});
  write_csv(file, provenance, rows,
            select(strength_columns(),
                   {"depth", "zone", "yield_strength", "initial_stress_x", "initial_stress_y", "required_first_yield",
                    "required_wandering", "required_upper", "required_kinematic"}));
}

void write_map(const std::filesystem::path& file, const std::vector<std::string>& provenance,
               const SectionShakedown& s) {
  std::vector<StrengthPoint> points;
  for (std::size_t r = 0; r < s.depth.size(); ++r)
    for (std::size_t c = 0; c < s.y.size(); ++c) {
      StrengthPoint& point = points.emplace_back();
      point = {.y = s.y[c], .depth = s.depth[r], .zone = s.zone[r], .shear = s.strength.shear[r]};
      point.upper = s.found.pointwise[r * s.y.size() + c];
    }
  write_csv(file, provenance, points, select(strength_columns(), {"y", "depth", "zone", "required_upper", "used"}));
}

}  // namespace

void write_streamlines(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                       const std::vector<StreamlineRow>& rows) {
  using R = StreamlineRow;
  if (rows.empty()) return;
  write_csv(file, provenance, rows,
            Columns<R>{{"y", unit::kMillimetres, &R::y},
                       {"width", unit::kMillimetres, &R::width},
                       {"friction_energy", unit::kJoulesPerSquareMetre, &R::friction_energy},
                       {"wear_usfd", unit::kNanometres, &R::usfd_depth},
                       {"wear_kth", unit::kNanometres, &R::kth_depth},
                       {"wear_archard", unit::kNanometres, &R::archard_depth},
                       {"wheel_wear_usfd", unit::kNanometres, &R::wheel_usfd_depth},
                       {"wheel_wear_kth", unit::kNanometres, &R::wheel_kth_depth},
                       {"wheel_wear_archard", unit::kNanometres, &R::wheel_archard_depth},
                       {"temperature_rise", unit::kKelvins, &R::temperature_rise},
                       {"local_fatigue", unit::kNone, &R::local_fatigue}});
}

Json shakedown_json(const Summary& summary) {
  const BodyShakedown* governing = summary.shakedown.governing();
  if (!governing) return nullptr;
  Json out;
  for (const ResultNumber& n : result_numbers())
    if (n.group == kShakedownGroup) out["factors"][n.key()] = json_number(n.value(summary));
  out["verdict"] = verdict_text(verdict_of(summary.shakedown));
  out["fails_by"] = Json::array();
  for (const Verdict v : fails_by(summary)) out["fails_by"].push_back(verdict_text(v));
  if (const std::optional<Judgement> answer = judgement_of(summary)) out["answer"] = answer_json(*answer);
  out["governing"] = governing_json(*governing);
  for (const BodyShakedown& b : summary.shakedown.bodies) out["bodies"].push_back(body_json(b));
  return out;
}

Json fatigue_json(const Summary& summary) {
  Json out = Json::array();
  for (const BodyFatigue& b : summary.fatigue) {
    Json body{{"body", b.body},
              {"dang_van", value_json(b.dang_van, "utilisation")},
              {"smith_watson_topper", value_json(b.smith_watson_topper, "value_Pa")},
              {"fatemi_socie", value_json(b.fatemi_socie, "value")},
              {"jiang_sehitoglu", value_json(b.jiang_sehitoglu, "value_Pa")}};
    for (const BrittleSummary& z : b.brittle) body["zones"].push_back(brittle_json(z));
    for (const InterfaceSummary& i : b.interfaces) body["interfaces"].push_back(interface_json(i));
    out.push_back(std::move(body));
  }
  return out;
}

void write_shakedown(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                     const Summary& summary, const std::vector<SectionShakedown>& sections) {
  if (sections.empty()) return;
  for (const SectionShakedown& s : sections) {
    const std::string name = fmt::format("shakedown_{}", body_word(s.body));
    write_profile(folder / (name + ".csv"), provenance, s);
    write_map(folder / (name + "_map.csv"), provenance, s);
  }
  write_whole_file(folder / "shakedown.json", shakedown_json(summary).dump(2) + "\n");
}

void write_sliding_maps(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                        const std::vector<SlidingMap>& maps) {
  using L = SlidingLimit;
  for (const SlidingMap& map : maps) {
    Columns<L> columns{{"traction_coefficient", unit::kNone, &L::traction}}, pressures;
    for (const Column<ShakedownFactors>& f : factor_columns()) {
      if (f.symbol == "single_track") continue;
      const auto factor = [f](const L& limit) { return f.value(limit.factors); };
      columns.push_back({f.symbol, unit::kNone, factor});
      pressures.push_back({"p_max_" + f.symbol, unit::both("_Pa", "_MPa", kToMega * map.p_max, "MPa"), factor});
    }
    append(columns, pressures);
    write_csv(folder / fmt::format("shakedown_{}_sliding.csv", body_word(map.body)), provenance, map.limits, columns);
  }
}

void write_crack(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                 const CrackResult& crack) {
  const CrackPassage& p = crack.passage;
  std::vector<std::size_t> places(p.place.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  using Place = std::size_t;
  Columns<Place> columns{{"wheel", unit::kMillimetres, [&p](Place i) { return p.place[i]; }},
                         {"K_I", unit::kRootMetres, [&p](Place i) { return p.end[i].I; }},
                         {"K_II", unit::kRootMetres, [&p](Place i) { return p.end[i].II; }}};
  if (!p.start.empty())
    append(columns, {{"K_I_top", unit::kRootMetres, [&p](Place i) { return p.start[i].I; }},
                     {"K_II_top", unit::kRootMetres, [&p](Place i) { return p.start[i].II; }}});
  append(columns, {{"energy_release", unit::kJoulesPerSquareMetre, [&p](Place i) { return release_at(p, i).rate; }},
                   {"phase", unit::kDegrees, [&p](Place i) { return release_at(p, i).phase; }},
                   {"open", unit::kNone, [&p](Place i) { return p.open[i]; }},
                   {"slipping", unit::kNone, [&p](Place i) { return p.slipping[i]; }},
                   {"fluid", unit::kMPa, [&p](Place i) { return p.fluid[i]; }}});
  write_csv(folder / "crack.csv", provenance, places, columns);
  if (crack.depths.empty()) return;
  using S = CrackState;
  write_csv(folder / "crack_depths.csv", provenance, crack.depths,
            Columns<S>{{"depth", unit::kMillimetres, &S::depth},
                       {"K_I_range", unit::kRootMetres, [](const S& s) { return s.range.I; }},
                       {"K_II_range", unit::kRootMetres, [](const S& s) { return s.range.II; }},
                       {"equivalent_range", unit::kRootMetres, &S::equivalent},
                       {"growth", unit::kNanometres, &S::growth},
                       {"kink_range", unit::kRootMetres, [](const S& s) { return s.kink.range; }},
                       {"kink_turn", unit::kDegrees, [](const S& s) { return s.kink.angle; }}});
}

void write_interface_slip(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                          const InterfaceSlip& slip) {
  std::vector<std::size_t> places(std::min(slip.first.size(), slip.last.size()));
  std::iota(places.begin(), places.end(), std::size_t{0});
  using Place = std::size_t;
  Columns<Place> columns{{"x", unit::kMillimetres, [&](Place i) { return slip.last[i].x; }}};
  const auto add = [&](const std::string& prefix, const std::vector<InterfacePlace>& of) {
    append(columns, {{prefix + "slip_x", unit::kMicrometres, [&of](Place i) { return of[i].slip_x; }},
                     {prefix + "slip_y", unit::kMicrometres, [&of](Place i) { return of[i].slip_y; }},
                     {prefix + "tau_x", unit::kMPa, [&of](Place i) { return of[i].shear_x; }},
                     {prefix + "tau_y", unit::kMPa, [&of](Place i) { return of[i].shear_y; }}});
  };
  add("", slip.last);
  add("first_", slip.first);
  write_csv(folder / "interface_slip.csv", provenance, places, columns);
}

}  // namespace railstrata
