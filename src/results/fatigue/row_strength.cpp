#include "fatigue/row_strength.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/material_strength.hpp"
#include "model/zone.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

/// A zone with what its depths count from.
struct Zone {
  const StrengthSpec& strength;
  std::string name, key;  ///< "rail", "material.rail"
  double top = 0;         ///< m, where depth 0 of its tables is
};

Zone zone_of(const CaseSpec& spec, BodyId body, int zone) {
  const StrengthSpec& strength = zone_material(spec, body, zone).strength;
  const std::string name = zone_name(spec, body, zone);
  const std::string key = zone_key(spec, body, zone);
  if (zone == 0) return {strength, name, key, 0};
  return {strength, name, key, layer_tops(spec.layers)[layers_on(spec, body)[zone - 1]]};
}

class ZoneStrength {
 public:
  explicit ZoneStrength(const Zone& zone)
      : s_(zone.strength),
        name_(zone.name),
        key_(zone.key),
        top_(zone.top),
        strength_(zone.strength, zone.name, zone.key) {}

  /// Pa, uniaxial; NaN where the case does not give it.
  double yield(double depth) const { return strength_.yield(depth - top_); }

  /// m, the depth where the table of the strength ends; infinite without one.
  double end() const { return top_ + strength_.end(); }

  StressPoint residual(double depth) const {
    StressPoint out = process_stress(s_, depth - top_, key_);
    out.depth = depth;
    return out;
  }

  /// How a strength that was not given is known, or that it is not; empty if it was given.
  std::string note() const {
    if (s_.elastic || !std::isnan(strength_.yield(0))) return strength_.note();
    return fmt::format("yield strength of {}: not known{}; it is taken to stay elastic and is not judged: give {}.{}",
                       name_, s_.grade.empty() ? "" : fmt::format(" of grade {}", s_.grade), key_, "yield_strength");
  }

 private:
  const StrengthSpec& s_;
  std::string name_, key_;
  double top_;
  MaterialStrength strength_;
};

}  // namespace

bool RowStrength::any() const {
  return std::any_of(shear.begin(), shear.end(), [](double k) { return std::isfinite(k); });
}

bool strength_given(const CaseSpec& spec, BodyId body) {
  const int layers = static_cast<int>(layers_on(spec, body).size());
  for (int zone = 0; zone <= layers; ++zone)
    if (has_strength(zone_material(spec, body, zone).strength)) return true;
  return false;
}

bool judged(const CaseSpec& spec, BodyId body) {
  return spec.run.judged != (body == BodyId::rail ? JudgedBodies::wheel : JudgedBodies::rail);
}

bool strength_to_judge(const CaseSpec& spec) {
  for (const BodyId body : {BodyId::rail, BodyId::wheel})
    if (judged(spec, body) && strength_given(spec, body)) return true;
  return false;
}

std::function<double(double, bool)> shear_strength_by_depth(const CaseSpec& spec, BodyId body) {
  const std::vector<double> tops = layer_tops(spec.layers);
  std::vector<double> bottoms;
  for (const std::size_t i : layers_on(spec, body)) bottoms.push_back(tops[i] + spec.layers[i].thickness);
  std::vector<ZoneStrength> zones;
  for (int zone = 0; zone <= static_cast<int>(bottoms.size()); ++zone) zones.emplace_back(zone_of(spec, body, zone));
  return [bottoms, zones](double depth, bool below) {
    constexpr double kRoundOff = 1e-9;
    std::size_t layer = 0;
    while (layer < bottoms.size() && depth > bottoms[layer] + (below ? -kRoundOff : kRoundOff)) ++layer;
    const ZoneStrength& zone = zones[layer < bottoms.size() ? layer + 1 : 0];
    return zone.yield(std::min(depth, zone.end())) / std::numbers::sqrt3;
  };
}

ProcessStress largest_process_stress(const CaseSpec& spec, BodyId body) {
  constexpr int kPieces = 50;
  constexpr double kOfBody = 50e-3;  // m, below its layers
  ProcessStress out;
  const std::vector<std::size_t> layers = layers_on(spec, body);
  double top = 0;
  for (std::size_t k = 0; k <= layers.size(); ++k) {
    const int number = k < layers.size() ? static_cast<int>(k) + 1 : 0;
    const ZoneStrength zone(zone_of(spec, body, number));
    const double thickness = number > 0 ? spec.layers[layers[k]].thickness : kOfBody;
    for (int i = 0; i <= kPieces; ++i) {
      const double depth = std::min(top + thickness * i / kPieces, zone.end());
      const StressPoint s = zone.residual(depth);
      const double von_mises =
                       std::sqrt(s.longitudinal * s.longitudinal + s.lateral * s.lateral - s.longitudinal * s.lateral),
                   share = von_mises / zone.yield(depth);
      if (share > out.share) out = {share, zone_name(spec, body, number)};
    }
    top += thickness;
  }
  return out;
}

RowStrength row_strength(const CaseSpec& spec, BodyId body, const StressHistory& rows) {
  std::vector<ZoneStrength> zones;
  const int layers = static_cast<int>(layers_on(spec, body).size());
  for (int zone = 0; zone <= layers; ++zone) zones.emplace_back(zone_of(spec, body, zone));
  RowStrength out;
  for (std::size_t r = 0; r < rows.depth.size(); ++r) {
    const ZoneStrength& zone = zones.at(rows.zone[r]);
    const StressPoint residual = zone.residual(rows.depth[r]);
    out.shear.push_back(zone.yield(rows.depth[r]) / std::numbers::sqrt3);
    const MaterialSpec& material = zone_material(spec, body, rows.zone[r]);
    out.young.push_back(material.young);
    out.fatigue_limit.push_back(material.strength.fatigue.limit.value_or(std::numeric_limits<double>::quiet_NaN()));
    out.residual_x.push_back(residual.longitudinal);
    out.residual_y.push_back(residual.lateral);
  }
  for (const ZoneStrength& zone : zones)
    if (std::string note = zone.note(); !note.empty()) out.notes.push_back(std::move(note));
  return out;
}

}  // namespace railstrata
