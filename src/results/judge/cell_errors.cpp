#include "judge/cell_errors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace railstrata {
namespace {

/// The largest second difference of the pressure along x or y, of a cell and those around it; 0 beyond the grid.
class Bends {
 public:
  explicit Bends(const ContactField& field) : f_(field) {}

  double around(int column, int station) const {
    double most = 0;
    for (int c = column - 1; c <= column + 1; ++c)
      for (int s = station - 1; s <= station + 1; ++s) most = std::max(most, at(c, s));
    return most;
  }

 private:
  double p(int column, int station) const {
    const bool inside = column >= 0 && column < f_.columns && station >= 0 && station < f_.stations;
    return inside ? f_.p[column + f_.columns * station] : 0;
  }
  double at(int column, int station) const {
    const double twice = 2 * p(column, station);
    return std::max(std::abs(twice - p(column - 1, station) - p(column + 1, station)),
                    std::abs(twice - p(column, station - 1) - p(column, station + 1)));
  }
  const ContactField& f_;
};

double pressure_error(const ContactField& f) {
  constexpr double kShare = 0.09;
  const Bends bends(f);
  double highest = 0, most = 0;
  for (int s = 0; s < f.stations; ++s)
    for (int c = 0; c < f.columns; ++c) {
      const double p = f.p[c + f.columns * s];
      if (!(p > 0)) continue;
      most = std::max(most, p);
      highest = std::max(highest, p + kShare * bends.around(c, s));
    }
  return highest - most;
}

/// Friction as the cases behind the laws had it: at most falling with slip, at most an elastic film.
bool knows_friction(const FrictionSpec& f, const ThirdBodySpec& film) {
  return f.lateral_table.empty() && !f.lateral_coefficient && f.temperature_table.empty() && f.memory_distance == 0 &&
         !film.yield_shear && film.modulus_by_pressure == 0 && film.temperature_table.empty();
}

double shear_compliance(const LayeredHalfSpace& body) { return 1 / body.substrate.shear(); }

}  // namespace

ContactErrors cell_errors(const CaseSpec& spec, const BemResult& r, const ContactSummary& c) {
  ContactErrors out;
  if (!r.further.empty() || r.grid.line || spec.vehicle.approach || spec.bem.leading_edge != LeadingEdge::sub_cell)
    return out;
  out.p_max = pressure_error(r.field);
  const double friction = spec.drive.friction_coefficient, cell = r.grid.dx, slip = c.patch.slip_area_fraction;
  if (!(friction > 0) || !knows_friction(spec.friction, spec.third_body)) return out;
  if (slip > 0)
    out.q_max = c.patch.q_max * (out.p_max / c.patch.p_max + 0.37 * std::pow(cell / (slip * c.patch.length), 1.4));
  out.slip_area_fraction = 0.22 * cell / (0.5 * shorter_axis(c.patch)) * std::sqrt(std::max(0.0, 1 - slip)) + 1e-3;
  const double of_radius = cell / std::sqrt(c.patch.area / std::numbers::pi);
  const double force = 0.08 * of_radius * friction * c.normal_force;
  const double of_saturation = 0.25 * friction * c.patch.p_max * (shear_compliance(r.wheel) + shear_compliance(r.rail));
  // Slip is a difference over a cell: the centre of its rotation is uncertain by half of one. Under Hertz's pressure,
  // where all slides, that is a lateral force of 3 pi/8 mu N d/a.
  const double turned = std::abs(c.spin_per_m) * std::sqrt(c.patch.area / std::numbers::pi),
               share = turned / (turned + of_saturation);
  const double spin_force = 3 * std::numbers::pi / 16 * of_radius * share * share * friction * c.normal_force;
  const auto creepage = [&](double value) { return 0.14 * of_radius * (std::abs(value) + of_saturation); };
  (spec.drive.traction() ? out.creepage_x : out.F_x) = spec.drive.traction() ? creepage(c.creepage_x) : force;
  const bool pushed = spec.drive.lateral_traction_coefficient.has_value();
  (pushed ? out.creepage_y : out.F_y) = pushed ? creepage(c.creepage_y) : force + spin_force;
  return out;
}

void add_stress_errors(const BemResult& r, const ContactSummary& c, StressSummary& stress) {
  for (std::optional<StressPair>* zone : {&stress.subsurface, &stress.layer, &stress.interface, &stress.matrix}) {
    if (!*zone) continue;
    StressMaximum& m = (*zone)->von_mises;
    const double x = r.grid.dx / m.depth;
    m.error = m.value * (c.error.p_max / c.patch.p_max + 0.04 * x * x * x / (1 + x * x));
  }
}

}  // namespace railstrata
