#include "io/damage_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/si_prefix.hpp"
#include "io/csv.hpp"
#include "io/json_text.hpp"
#include "io/output_file.hpp"
#include "judge/verdict.hpp"
#include "result/result_table.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

struct Factor {
  const char* key;
  double ShakedownFactors::*member;
};
constexpr Factor kFactors[] = {{"first_yield", &ShakedownFactors::first_yield},
                               {"wandering", &ShakedownFactors::wandering},
                               {"single_track", &ShakedownFactors::single_track},
                               {"upper", &ShakedownFactors::upper},
                               {"kinematic", &ShakedownFactors::kinematic}};

Json factors_json(const ShakedownFactors& f) {
  Json out;
  for (const Factor& factor : kFactors) out[factor.key] = json_number(f.*factor.member);
  return out;
}

Json governing_json(const BodyShakedown& b) {
  return {{"body", b.body}, {"zone", b.zone}, {"depth_m", json_number(b.depth)}, {"y_m", json_number(b.y)}};
}

Json body_json(const BodyShakedown& b) {
  Json out{{"body", b.body},
           {"factors", factors_json(b.factors)},
           {"verdict", words_of(verdict_of(b.factors)).words},
           {"governing", governing_json(b)}};
  for (const ZoneShakedown& z : b.zones)
    out["zones"].push_back({{"zone", z.zone},
                            {"depth_m", json_number(z.depth)},
                            {"factors", factors_json(z.factors)},
                            {"verdict", words_of(verdict_of(z.factors)).words}});
  out["notes"] = b.notes;
  return out;
}

Json value_json(const std::optional<FatigueValue>& v, const char* key) {
  if (!v) return nullptr;
  return {
      {key, json_number(v->value)}, {"zone", v->zone}, {"depth_m", json_number(v->depth)}, {"y_m", json_number(v->y)}};
}

Json brittle_json(const BrittleSummary& z) {
  return {{"zone", z.zone},
          {"sigma1_max_Pa", json_number(z.sigma1)},
          {"depth_m", json_number(z.depth)},
          {"share_of_tensile_strength", json_number(z.share_of_tensile)},
          {"critical_flaw_m", json_number(z.critical_flaw)},
          {"thickness_m", json_number(z.thickness)}};
}

Json interface_json(const InterfaceSummary& i) {
  return {{"above", i.above},
          {"below", i.below},
          {"depth_m", json_number(i.depth)},
          {"tension_Pa", json_number(i.tension)},
          {"shear_Pa", json_number(i.shear)},
          {"shear_range_Pa", json_number(i.shear_range)},
          {"sigma_xx_range_above_Pa", json_number(i.sigma_xx_range_above)},
          {"sigma_xx_range_below_Pa", json_number(i.sigma_xx_range_below)},
          {"delamination", json_number(i.delamination)}};
}

/// Of pure shear to uniaxial, in MPa.
std::vector<double> uniaxial(const std::vector<double>& shear) {
  std::vector<double> out(shear);
  for (double& k : out) k *= std::numbers::sqrt3 * kToMega;
  return out;
}

void write_profile(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                   const SectionShakedown& s) {
  const std::vector<double> zone(s.zone.begin(), s.zone.end());
  const RequiredStrength& r = s.found.required;
  write_csv(file, provenance,
            {{"depth_mm", scaled(s.depth, kToMilli)},
             {"zone", zone},
             {"yield_strength_MPa", uniaxial(s.strength.shear)},
             {"initial_stress_x_MPa", scaled(s.strength.residual_x, kToMega)},
             {"initial_stress_y_MPa", scaled(s.strength.residual_y, kToMega)},
             {"required_first_yield_MPa", uniaxial(r.first_yield)},
             {"required_wandering_MPa", uniaxial(r.wandering)},
             {"required_upper_MPa", uniaxial(r.upper)},
             {"required_kinematic_MPa", uniaxial(r.kinematic)}});
}

void write_map(const std::filesystem::path& file, const std::vector<std::string>& provenance,
               const SectionShakedown& s) {
  std::vector<CsvColumn> columns{
      {"y_mm", {}}, {"depth_mm", {}}, {"zone", {}}, {"required_upper_MPa", {}}, {"used", {}}};
  const std::vector<double> required = uniaxial(s.found.pointwise), there = uniaxial(s.strength.shear);
  for (std::size_t r = 0; r < s.depth.size(); ++r)
    for (std::size_t c = 0; c < s.y.size(); ++c) {
      const double asked = required[r * s.y.size() + c];
      const double row[] = {kToMilli * s.y[c], kToMilli * s.depth[r], static_cast<double>(s.zone[r]), asked,
                            asked / there[r]};
      for (std::size_t k = 0; k < columns.size(); ++k) columns[k].values.push_back(row[k]);
    }
  write_csv(file, provenance, columns);
}

}  // namespace

void write_streamlines(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                       const std::vector<StreamlineRow>& rows) {
  if (rows.empty()) return;
  std::vector<CsvColumn> columns;
  const auto add = [&](const char* name, double StreamlineRow::*member, double factor) {
    columns.push_back({name, {}});
    for (const StreamlineRow& r : rows) columns.back().values.push_back(factor * r.*member);
  };
  add("y_mm", &StreamlineRow::y, kToMilli);
  add("width_mm", &StreamlineRow::width, kToMilli);
  add("friction_energy_J_per_m2", &StreamlineRow::friction_energy, 1);
  add("wear_usfd_nm", &StreamlineRow::usfd_depth, 1e9);
  add("wear_kth_nm", &StreamlineRow::kth_depth, 1e9);
  add("wear_archard_nm", &StreamlineRow::archard_depth, 1e9);
  add("wheel_wear_usfd_nm", &StreamlineRow::wheel_usfd_depth, 1e9);
  add("wheel_wear_kth_nm", &StreamlineRow::wheel_kth_depth, 1e9);
  add("wheel_wear_archard_nm", &StreamlineRow::wheel_archard_depth, 1e9);
  add("temperature_rise_K", &StreamlineRow::temperature_rise, 1);
  add("local_fatigue", &StreamlineRow::local_fatigue, 1);
  write_csv(file, provenance, columns);
}

Json shakedown_json(const Summary& summary) {
  const BodyShakedown* governing = summary.shakedown.governing();
  if (!governing) return nullptr;
  Json out;
  for (const ResultNumber& n : result_numbers())
    if (n.group == kShakedownGroup) out["factors"][n.key()] = json_number(std::get<double>(n.value(summary)));
  out["verdict"] = words_of(verdict_of(summary.shakedown)).words;
  out["fails_by"] = Json::array();
  for (const Verdict v : fails_by(summary)) out["fails_by"].push_back(words_of(v).words);
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
  for (const SlidingMap& map : maps) {
    std::vector<CsvColumn> columns{{"traction_coefficient", {}}};
    for (const SlidingLimit& l : map.limits) columns[0].values.push_back(l.traction);
    const auto add = [&](const std::string& name, double ShakedownFactors::*member, double factor) {
      columns.push_back({name, {}});
      for (const SlidingLimit& l : map.limits) columns.back().values.push_back(factor * l.factors.*member);
    };
    for (const Factor& f : kFactors)
      if (f.member != &ShakedownFactors::single_track) add(f.key, f.member, 1);
    for (const Factor& f : kFactors)
      if (f.member != &ShakedownFactors::single_track)
        add(fmt::format("p_max_{}_MPa", f.key), f.member, kToMega * map.p_max);
    write_csv(folder / fmt::format("shakedown_{}_sliding.csv", body_word(map.body)), provenance, columns);
  }
}

}  // namespace railstrata
