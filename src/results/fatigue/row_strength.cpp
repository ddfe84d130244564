#include "fatigue/row_strength.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "damage/brittle.hpp"
#include "damage/critical_plane.hpp"
#include "damage/dang_van.hpp"
#include "damage/interface_damage.hpp"
#include "model/material_strength.hpp"
#include "model/zone.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

/// A zone: 0 the body, then its layers from the surface down.
class ZoneStrength {
 public:
  ZoneStrength(const CaseSpec& spec, BodyId body, int zone)
      : s_(zone_material(spec, body, zone).strength),
        name_(zone_name(spec, body, zone)),
        key_(zone_key(spec, body, zone)),
        top_(zone == 0 ? 0 : layer_tops(spec.layers)[layers_on(spec, body)[zone - 1]]),
        strength_(s_, name_, key_) {}

  /// Pa, uniaxial; NaN where the case does not give it.
  double yield(double depth) const { return strength_.yield(depth - top_); }

  /// m, the depth where the table of the strength ends; infinite without one.
  double end() const { return top_ + strength_.end(); }

  /// Of Dang Van; infinite where it is not known.
  DangVanLimit endurance() const {
    const EstimatedEndurance known = strength_.endurance();
    return {known.weight, std::isnan(known.limit) ? std::numeric_limits<double>::infinity() : known.limit};
  }
  std::string endurance_note() const { return strength_.endurance_note(); }

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
  std::string name_, key_;  ///< "rail", "material.rail"
  double top_;              ///< m, where depth 0 of its tables is
  MaterialStrength strength_;
};

std::vector<ZoneStrength> zones_of(const CaseSpec& spec, BodyId body) {
  std::vector<ZoneStrength> out;
  const int layers = static_cast<int>(layers_on(spec, body).size());
  for (int zone = 0; zone <= layers; ++zone) out.emplace_back(spec, body, zone);
  return out;
}

FatigueValue place(const CaseSpec& spec, BodyId body, const StressHistory& history, int row, int column, double value) {
  return {value, history.depth[row], history.y[column], zone_name(spec, body, history.zone[row])};
}

void add_dang_van(const CaseSpec& spec, BodyId body, const StressHistory& history, const RowStrength& strength,
                  ResidualRows residual, BodyFatigue& out) {
  if (std::all_of(strength.endurance.begin(), strength.endurance.end(),
                  [](const DangVanLimit& l) { return std::isinf(l.limit); }))
    return;
  const DangVanSection found = dang_van(history, residual, strength.endurance);
  if (!found.row) return;
  for (std::size_t p = 0; p < found.point.size(); ++p)
    out.dang_van_used.push_back(found.point[p].stress / strength.endurance[p / history.y.size()].limit);
  out.dang_van = place(spec, body, history, *found.row, found.column, found.utilisation);
}

std::vector<CriticalPlaneMaterial> plane_materials(const CaseSpec& spec, BodyId body, const StressHistory& history,
                                                   const RowStrength& strength) {
  std::vector<CriticalPlaneMaterial> out;
  for (int r = 0; r < history.rows(); ++r) {
    const MaterialSpec& m = zone_material(spec, body, history.zone[r]);
    const StrengthSpec& s = m.strength;
    CriticalPlaneMaterial row;
    row.young = strength.young[r];
    row.poisson = m.poisson;
    if (s.fatigue.fatemi_socie && std::isfinite(strength.shear[r]))
      row.fatemi_socie = FatemiSocieConstants{*s.fatigue.fatemi_socie, std::numbers::sqrt3 * strength.shear[r]};
    row.jiang_sehitoglu = s.fatigue.jiang_sehitoglu;
    out.push_back(row);
  }
  return out;
}

/// The largest of all rows that have it.
template <class Of>
std::optional<FatigueValue> largest(const CaseSpec& spec, BodyId body, const StressHistory& history,
                                    const std::vector<CriticalPlaneRow>& rows, Of&& of) {
  std::optional<FatigueValue> out;
  for (int r = 0; r < history.rows(); ++r) {
    const CriticalPlane* plane = of(rows[r]);
    if (plane && plane->column >= 0 && (!out || plane->value > out->value))
      out = place(spec, body, history, r, plane->column, plane->value);
  }
  return out;
}

void add_critical_planes(const CaseSpec& spec, BodyId body, const StressHistory& history, const RowStrength& strength,
                         ResidualRows residual, BodyFatigue& out) {
  const std::vector<CriticalPlaneRow> rows =
      critical_planes(history, residual, plane_materials(spec, body, history, strength));
  out.smith_watson_topper =
      largest(spec, body, history, rows, [](const CriticalPlaneRow& r) { return &r.smith_watson_topper; });
  out.fatemi_socie = largest(spec, body, history, rows,
                             [](const CriticalPlaneRow& r) { return r.fatemi_socie ? &*r.fatemi_socie : nullptr; });
  out.jiang_sehitoglu = largest(spec, body, history, rows, [](const CriticalPlaneRow& r) {
    return r.jiang_sehitoglu ? &*r.jiang_sehitoglu : nullptr;
  });
}

void add_zones(const CaseSpec& spec, BodyId body, const StressHistory& history, ResidualRows residual,
               BodyFatigue& out) {
  for (const BrittleZone& z : principal_peaks(history, residual)) {
    const StrengthSpec& s = zone_material(spec, body, z.zone).strength;
    BrittleSummary b;
    b.zone = zone_name(spec, body, z.zone);
    b.sigma1 = z.stress;
    b.depth = history.depth[z.row];
    if (z.zone > 0) b.thickness = z.thickness;
    if (s.tensile_strength) b.share_of_tensile = b.sigma1 / *s.tensile_strength;
    if (s.fracture_toughness) b.critical_flaw = critical_flaw(*s.fracture_toughness, b.sigma1);
    out.brittle.push_back(b);
  }
}

/// The bonds of a body's layers; empty unless all have theirs.
std::vector<BondStrength> bonds_of(const CaseSpec& spec, BodyId body) {
  std::vector<BondStrength> out;
  for (const std::size_t layer : layers_on(spec, body)) {
    const StrengthSpec& s = spec.layers[layer].material.strength;
    if (!s.bond.tension || !s.bond.shear) return {};
    out.push_back({*s.bond.tension, *s.bond.shear});
  }
  return out;
}

void add_interfaces(const CaseSpec& spec, BodyId body, const StressHistory& history, ResidualRows residual,
                    BodyFatigue& out) {
  const std::vector<BondStrength> bonds = bonds_of(spec, body);
  for (const Interface& i : interface_damage(history, residual, bonds)) {
    InterfaceSummary s;
    s.above = zone_name(spec, body, history.zone[i.row_above]);
    s.below = zone_name(spec, body, history.zone[i.row_above + 1]);
    s.depth = i.depth;
    s.tension = i.tension;
    s.shear = i.shear;
    s.shear_range = i.shear_range;
    s.sigma_xx_range_above = i.xx_range[0];
    s.sigma_xx_range_below = i.xx_range[1];
    if (!bonds.empty()) s.delamination = i.delamination;
    out.interfaces.push_back(s);
  }
}

}  // namespace

bool RowStrength::any() const {
  return std::any_of(shear.begin(), shear.end(), [](double k) { return std::isfinite(k); });
}

bool any_zone(const CaseSpec& spec, BodyId body, const std::function<bool(const StrengthSpec&)>& says) {
  const int layers = static_cast<int>(layers_on(spec, body).size());
  for (int zone = 0; zone <= layers; ++zone)
    if (says(zone_material(spec, body, zone).strength)) return true;
  return false;
}

bool strength_given(const CaseSpec& spec, BodyId body) { return any_zone(spec, body, has_strength); }

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
  return [bottoms, zones = zones_of(spec, body)](double depth, bool below) {
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
    const ZoneStrength zone(spec, body, number);
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
  const std::vector<ZoneStrength> zones = zones_of(spec, body);
  RowStrength out;
  for (std::size_t r = 0; r < rows.depth.size(); ++r) {
    const ZoneStrength& zone = zones.at(rows.zone[r]);
    const StressPoint residual = zone.residual(rows.depth[r]);
    out.shear.push_back(zone.yield(rows.depth[r]) / std::numbers::sqrt3);
    const MaterialSpec& material = zone_material(spec, body, rows.zone[r]);
    out.young.push_back(material.young);
    out.endurance.push_back(zone.endurance());
    out.residual_x.push_back(residual.longitudinal);
    out.residual_y.push_back(residual.lateral);
  }
  for (const ZoneStrength& zone : zones)
    if (std::string note = zone.note(); !note.empty()) out.notes.push_back(std::move(note));
  for (const ZoneStrength& zone : zones)
    if (std::string note = zone.endurance_note(); !note.empty()) out.endurance_notes.push_back(std::move(note));
  return out;
}

bool fatigue_given(const CaseSpec& spec, BodyId body) {
  return any_zone(spec, body, [](const StrengthSpec& s) {
    return s.fatigue.limit || s.fracture_toughness || s.tensile_strength || s.bond.shear || s.bond.tension ||
           s.fatigue.fatemi_socie || s.fatigue.jiang_sehitoglu;
  });
}

BodyFatigue section_fatigue(const CaseSpec& spec, BodyId body, const StressHistory& history,
                            const RowStrength& strength, bool planes) {
  const std::vector<Sym3> residual = residual_rows(strength.residual_x, strength.residual_y);
  BodyFatigue out;
  out.body = std::string(body_word(body));
  const bool endurance_given = any_zone(spec, body, [](const StrengthSpec& s) { return s.fatigue.limit.has_value(); });
  if (planes || endurance_given) add_dang_van(spec, body, history, strength, residual, out);
  if (planes) add_critical_planes(spec, body, history, strength, residual, out);
  add_zones(spec, body, history, residual, out);
  add_interfaces(spec, body, history, residual, out);
  return out;
}

}  // namespace railstrata
