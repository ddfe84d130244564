#include "fatigue/section_fatigue.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "damage/brittle.hpp"
#include "damage/critical_plane.hpp"
#include "damage/dang_van.hpp"
#include "damage/interface_damage.hpp"
#include "model/zone.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

const StrengthSpec& strength_of_row(const CaseSpec& spec, BodyId body, const StressHistory& history, int row) {
  return zone_material(spec, body, history.zone[row]).strength;
}

bool any_zone(const CaseSpec& spec, BodyId body, const std::function<bool(const StrengthSpec&)>& says) {
  if (says(zone_material(spec, body, 0).strength)) return true;
  return std::any_of(spec.layers.begin(), spec.layers.end(),
                     [&](const LayerSpec& layer) { return layer.on == body && says(layer.material.strength); });
}

bool has_dang_van(const StrengthSpec& s) { return s.fatigue.limit && s.fatigue.dang_van; }

/// Rows without a limit do not count.
std::vector<DangVanLimit> dang_van_limits(const CaseSpec& spec, BodyId body, const StressHistory& history,
                                          const RowStrength& strength) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  std::vector<DangVanLimit> out;
  for (int r = 0; r < history.rows(); ++r) {
    const StrengthSpec& s = strength_of_row(spec, body, history, r);
    out.push_back(has_dang_van(s) ? DangVanLimit{*s.fatigue.dang_van, strength.fatigue_limit[r]}
                                  : DangVanLimit{0, kNever});
  }
  return out;
}

FatigueValue place(const CaseSpec& spec, BodyId body, const StressHistory& history, int row, int column, double value) {
  return {value, history.depth[row], history.y[column], zone_name(spec, body, history.zone[row])};
}

void add_dang_van(const CaseSpec& spec, BodyId body, const StressHistory& history, const RowStrength& strength,
                  ResidualRows residual, BodyFatigue& out) {
  if (!any_zone(spec, body, has_dang_van)) return;
  const std::vector<DangVanLimit> limits = dang_van_limits(spec, body, history, strength);
  const DangVanSection found = dang_van(history, residual, limits);
  if (!found.row) return;
  for (std::size_t p = 0; p < found.point.size(); ++p)
    out.dang_van_used.push_back(found.point[p].stress / limits[p / history.y.size()].limit);
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
  for (const LayerSpec& layer : spec.layers) {
    if (layer.on != body) continue;
    const StrengthSpec& s = layer.material.strength;
    if (!s.bond_tension || !s.bond_shear) return {};
    out.push_back({*s.bond_tension, *s.bond_shear});
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

bool fatigue_given(const CaseSpec& spec, BodyId body) {
  return any_zone(spec, body, [](const StrengthSpec& s) {
    return s.fatigue.limit || s.fracture_toughness || s.tensile_strength || s.bond_shear || s.bond_tension ||
           s.fatigue.fatemi_socie || s.fatigue.jiang_sehitoglu;
  });
}

BodyFatigue section_fatigue(const CaseSpec& spec, BodyId body, const StressHistory& history,
                            const RowStrength& strength) {
  const std::vector<Sym3> residual = residual_rows(strength.residual_x, strength.residual_y);
  BodyFatigue out;
  out.body = std::string(body_word(body));
  add_dang_van(spec, body, history, strength, residual, out);
  add_critical_planes(spec, body, history, strength, residual, out);
  add_zones(spec, body, history, residual, out);
  add_interfaces(spec, body, history, residual, out);
  return out;
}

}  // namespace railstrata
