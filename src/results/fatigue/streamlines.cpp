#include "fatigue/streamlines.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "damage/flash_temperature.hpp"
#include "damage/hardness.hpp"
#include "damage/wear.hpp"
#include "fatigue/row_strength.hpp"
#include "fatigue/steel_wear.hpp"
#include "material/steels.hpp"
#include "model/thermal_body.hpp"
#include "model/zone.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

constexpr double kPascalOfVickers = 9.80665e6;

/// A column's cells along x, copied so that they stand next to each other.
struct Cells {
  std::vector<double> x, p, q_x, q_y, slip_x, slip_y;
  std::vector<double> power, pressed;
  double area = 0;
};

Cells cells_of(const ContactField& f, int column) {
  Cells out;
  for (int s = 0; s < f.stations; ++s) {
    const std::size_t i = static_cast<std::size_t>(s) * f.columns + column;
    out.x.push_back(f.x[i]);
    out.p.push_back(f.p[i]);
    out.q_x.push_back(f.q_x[i]);
    out.q_y.push_back(f.q_y[i]);
    out.slip_x.push_back(f.p[i] > 0 ? f.slip_x[i] : 0);
    out.slip_y.push_back(f.p[i] > 0 ? f.slip_y[i] : 0);
    if (!f.friction_power.empty()) {
      out.power.push_back(f.friction_power[i]);
      out.pressed.push_back(f.pressed_slip[i]);
    }
    out.area = std::max(out.area, f.area[i]);
  }
  return out;
}

/// The zone of a body's running surface: its first layer, or the body itself.
int surface_zone(const CaseSpec& spec, BodyId body) { return layers_on(spec, body).empty() ? 0 : 1; }

const MaterialSpec& surface_material(const CaseSpec& spec, BodyId body) {
  return zone_material(spec, body, surface_zone(spec, body));
}

/// Pa, as a pressure; NaN where the case does not give it.
double hardness_of(const StrengthSpec& s) {
  if (s.hardness) return kPascalOfVickers * *s.hardness;
  if (!s.hardness_table.empty()) return kPascalOfVickers * s.hardness_table.front().value;
  if (s.grade.empty() || !grade(s.grade).hardness.known()) return kNotApplicable;
  return kPascalOfVickers * vickers_from_brinell(grade(s.grade).hardness.low);
}

/// Pa, in shear, of the rail's running surface.
double surface_shear_strength(const CaseSpec& spec) {
  StressHistory top;
  top.depth = {0};
  top.zone = {surface_zone(spec, BodyId::rail)};
  return row_strength(spec, BodyId::rail, top).shear.front();
}

/// Data of a surface for wear.
struct WearData {
  double density = 0, hardness = kNotApplicable;
  std::optional<double> coefficient;
  double usfd_factor = 1, kth_factor = 1;  ///< of the steel; KTH's has its hardness, so only one that is given
};

/// The data of a case that every streamline needs.
struct SurfaceData {
  ThermalBody rail, wheel;
  WearData rail_wear, wheel_wear;
  double shear_strength = kNotApplicable;
};

WearData wear_data(const CaseSpec& spec, BodyId body) {
  const MaterialSpec& m = surface_material(spec, body);
  return {m.density, hardness_of(m.strength), m.strength.wear_coefficient, steel_wear(spec, body).factor,
          m.strength.wear_factor.value_or(1)};
}

SurfaceData surface_data(const CaseSpec& spec) {
  return {thermal_body(spec, BodyId::rail), thermal_body(spec, BodyId::wheel), wear_data(spec, BodyId::rail),
          wear_data(spec, BodyId::wheel), surface_shear_strength(spec)};
}

struct WearDepths {
  double usfd = kNotApplicable, archard = kNotApplicable, kth = kNotApplicable;  ///< m
  OutsideMap outside;                                                            ///< of kth
};

/// Wear of a surface point in one passage of the patch; Archard's law needs a hardness.
WearDepths wear_depths(const Streamline& line, const WearData& data) {
  WearDepths out;
  out.usfd = data.usfd_factor * usfd_depth(line, data.density);
  if (!std::isfinite(data.hardness)) return out;
  out.kth = archard_depth(line, laboratory_dry_archard(), data.hardness, data.kth_factor);
  out.outside = archard_outside(line, laboratory_dry_archard(), data.hardness, data.kth_factor);
  if (const auto k = data.coefficient) out.archard = archard_depth(line, {*k, *k, *k, *k}, data.hardness);
  return out;
}

void heat(const SurfaceData& data, const Streamline& line, StreamlineRow& row) {
  std::vector<double> flux = friction_power(line);
  std::reverse(flux.begin(), flux.end());  // the leading edge comes first
  for (double& q : flux) q = std::max(q, 0.0);
  const HeatedLine heated{flux, line.dx, line.speed};
  row.temperature_rise = row.rise_lower = row.rise_upper = flash_temperature(heated, data.rail, data.wheel).max;
  if (data.rail.layer_thickness > 0 || data.wheel.layer_thickness > 0) {
    const FlashBounds bounds = flash_bounds(heated, data.rail, data.wheel);
    row.rise_lower = bounds.lower;
    row.rise_upper = bounds.upper;
  }
}

StreamlineRow streamline_row(const SurfaceData& data, const Cells& cells, double speed) {
  const double dx = (cells.x.back() - cells.x.front()) / static_cast<double>(cells.x.size() - 1);
  const Streamline line{cells.p, cells.q_x, cells.q_y,   cells.slip_x, cells.slip_y,
                        dx,      speed,     cells.power, cells.pressed};
  StreamlineRow row;
  row.width = cells.area / dx;
  row.friction_energy = friction_energy(line);
  const WearDepths rail = wear_depths(line, data.rail_wear), wheel = wear_depths(line, data.wheel_wear);
  row.usfd_depth = rail.usfd;
  row.archard_depth = rail.archard;
  row.kth_depth = rail.kth;
  row.kth_seized = rail.outside.seized;
  row.kth_fast = rail.outside.fast;
  row.wheel_usfd_depth = wheel.usfd;
  row.wheel_archard_depth = wheel.archard;
  row.wheel_kth_depth = wheel.kth;
  heat(data, line, row);
  if (std::isfinite(data.shear_strength)) row.local_fatigue = local_fatigue(line, data.shear_strength).value_or(0);
  return row;
}

double largest(const std::vector<StreamlineRow>& rows, double StreamlineRow::*member) {
  double out = kNotApplicable;
  for (const StreamlineRow& r : rows)
    if (std::isfinite(r.*member) && !(r.*member <= out)) out = r.*member;
  return out;
}

/// Adds the numbers that follow from forces and creepages of the patches.
void add_patches(const CaseSpec& spec, const Summary& summary, DamageSummary& out) {
  const double strength = surface_shear_strength(spec);
  std::vector<ContactSummary> patches;
  for (const PatchSummary& p : summary.patches) patches.push_back(p.contact);
  if (patches.empty()) patches.push_back(summary.contact);
  out.t_gamma = out.t_gamma_with_spin = out.motion_energy = 0;
  for (const ContactSummary& c : patches) {
    const PatchMeasures& m = c.patch;
    const TGamma t = t_gamma(c);
    out.t_gamma += t.without_spin;
    const double damage = rcf_damage(rcf_damage_15(), t.without_spin);
    if (!(damage <= out.rcf_damage)) out.rcf_damage = damage;
    out.t_gamma_with_spin += t.with_spin;
    out.motion_energy += c.motion_power / spec.drive.speed;
    const double index = std::hypot(m.force_x, m.force_y) / m.force_z - strength / m.p_max;
    if (std::isfinite(index) && !(index <= out.surface_fatigue)) out.surface_fatigue = index;
  }
  out.brr_wear = brr_wear(out.t_gamma, 2 * spec.geometry.wheel_radius);
}

}  // namespace

TGamma t_gamma(const ContactSummary& c) {
  const PatchMeasures& m = c.patch;
  return t_gamma(PatchCreep{m.force_x, m.force_y, c.spin_moment, c.creepage_x, c.creepage_y, c.spin_per_m});
}

std::vector<StreamlineRow> streamlines(const CaseSpec& spec, const ContactField& f) {
  std::vector<StreamlineRow> out;
  if (f.slip_is_distance || f.stations < 2 || !(spec.drive.speed > 0)) return out;
  const SurfaceData data = surface_data(spec);
  for (int c = 0; c < f.columns; ++c) {
    const Cells cells = cells_of(f, c);
    if (std::none_of(cells.p.begin(), cells.p.end(), [](double p) { return p > 0; })) continue;
    out.push_back(streamline_row(data, cells, spec.drive.speed));
    out.back().y = f.y[c];
    out.back().z = f.z[c];
  }
  return out;
}

DamageSummary damage_summary(const CaseSpec& spec, const Summary& summary, const std::vector<StreamlineRow>& rows) {
  DamageSummary out;
  if (rows.empty() || !std::isfinite(summary.contact.creepage_x)) return out;
  add_patches(spec, summary, out);
  out.friction_energy = 0;
  for (const StreamlineRow& r : rows) out.friction_energy += r.friction_energy * r.width;
  out.usfd_depth = largest(rows, &StreamlineRow::usfd_depth);
  out.rail_steel = steel_wear(spec, BodyId::rail);
  out.wheel_steel = steel_wear(spec, BodyId::wheel);
  out.archard_depth = largest(rows, &StreamlineRow::archard_depth);
  out.kth_depth = largest(rows, &StreamlineRow::kth_depth);
  for (const StreamlineRow& r : rows) out.kth_of_map.add(r.width, r.kth_depth, r.kth_seized, r.kth_fast);
  out.temperature_rise = largest(rows, &StreamlineRow::temperature_rise);
  out.temperature_rise_lower = largest(rows, &StreamlineRow::rise_lower);
  out.temperature_rise_upper = largest(rows, &StreamlineRow::rise_upper);
  if (const auto& rise = surface_material(spec, BodyId::rail).strength.heat.austenitisation_rise)
    out.austenitisation = out.temperature_rise / *rise;
  out.local_fatigue = largest(rows, &StreamlineRow::local_fatigue);
  return out;
}

}  // namespace railstrata
