#include "cntc/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cntc/discretise.hpp"
#include "cntc/marker.hpp"
#include "cntc/simplified.hpp"

namespace railstrata::cntc {
namespace {

/// The element of a cell: x fastest, y rising as the caller sees it.
std::size_t element(const PatchGrid& g, double side, int i, int j) {
  return static_cast<std::size_t>(i + g.nx * (side > 0 ? j : g.ny - 1 - j));
}

/// From cells with y fastest to elements, times a factor.
std::vector<double> in_order(const PatchGrid& g, double side, const Plane& cells, double factor) {
  std::vector<double> out(g.size());
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) out[element(g, side, i, j)] = factor * cells[g.index(i, j)];
  return out;
}

/// Body 2 minus body 1, tangential.
PlanePair tangential_displacement(const Solved& s) {
  const PatchGrid& g = s.on.grid;
  const TangentialSolution& t = s.rolling.tangential;
  PlanePair out{Plane(g.size()), Plane(g.size())};
  if (s.flexibility[0] > 0) {
    add_scaled(out.x, s.flexibility[0], t.q_x);
    add_scaled(out.y, s.flexibility[1], t.q_y);
    return out;
  }
  s.influence->tangential(t.q_x.data(), t.q_y.data(), out.x.data(), out.y.data(), g.nx);
  if (!s.late[0].empty()) {
    add_scaled(out.x, 1, s.late[1]);
    add_scaled(out.y, 1, s.late[2]);
  }
  if (!s.influence->couples()) return out;
  const PlanePair by_pressure = s.influence->tangential_from_pressure(s.rolling.normal.pressure, g.nx);
  add_scaled(out.x, 1, by_pressure.x);
  add_scaled(out.y, 1, by_pressure.y);
  return out;
}

Plane normal_displacement(const Solved& s) {
  const std::size_t n = s.on.grid.size();
  const TangentialSolution& t = s.rolling.tangential;
  Plane out(n);
  s.influence->normal(s.rolling.normal.pressure.data(), out.data());
  if (!s.late[0].empty()) add_scaled(out, 1, s.late[0]);
  if (!s.influence->couples()) return out;
  add_scaled(out, 1, s.influence->normal_from_traction(t.q_x, t.q_y));
  return out;
}

Plane friction_field(const Solved& s) {
  const TangentialSolution& t = s.rolling.tangential;
  Plane out = s.local_friction.empty() ? Plane(s.on.grid.size(), s.friction.at_rest) : s.local_friction;
  if (!s.friction.by_temperature.empty() && !s.temperature.empty())
    for (std::size_t k = 0; k < out.size(); ++k) out[k] *= over_table(s.friction.by_temperature, s.temperature[k]);
  if (!t.lost_friction.empty())
    for (std::size_t k = 0; k < out.size(); ++k) out[k] *= 1 - t.lost_friction[k];
  if (!s.friction.falling.falls() || !t.lost_friction.empty()) return out;
  for (std::size_t k = 0; k < out.size(); ++k)
    out[k] *= friction_share(s.friction.falling, s.speed * std::hypot(t.slip.x[k], t.slip.y[k])).value;
  return out;
}

/// What the film of an element bears, Pa.
double film_strength(const Solved& s, std::size_t k) {
  const Plane& plastic = s.rolling.tangential.plastic;
  return s.film.strength(plastic.empty() ? 0.0 : plastic[k]);
}

/// Of an element that slips: it is the film that gives way, not friction.
bool yields(const Solved& s, std::size_t k) {
  constexpr double kNear = 1 - 1e-6;
  const TangentialSolution& t = s.rolling.tangential;
  return s.film.yields() && !t.plastic.empty() && t.plastic[k] > 0 &&
         std::hypot(t.q_x[k], t.q_y[k]) >= kNear * film_strength(s, k);
}

const Plane& temperatures(const Solved& s) {
  if (s.temperature.empty())
    throw Refused(kOther, "there are no temperatures: cntc_settemperaturedata with H = 3, and T = 2 or 3");
  return s.temperature;
}

std::vector<double> material_numbers(const Problem& p) {
  const Materials& m = p.settings.materials;
  const double g1 = m.body[0].shear(), g2 = m.body[1].shear(), n1 = m.body[0].poisson, n2 = m.body[1].poisson;
  const auto [shear, poisson] = pair_moduli(m);
  const double unit = p.units.area();
  const double difference = 0.25 * shear * ((1 - 2 * n1) / g1 - (1 - 2 * n2) / g2);
  std::vector<double> out{g1 * unit, g2 * unit, shear * unit, n1, n2, poisson, difference};
  out.resize(22, 0.0);
  if (m.simplified) {
    const SimplifiedTheory& t = *m.simplified;
    std::copy_n(std::array{t.k0, t.alpha, t.beta}.begin(), 3, out.begin() + 10);
    if (p.solved) out[13] = p.solved->reduction;
  }
  out[14] = m.film.shear_modulus * unit;
  out[15] = m.film.thickness / p.units.length;
  return out;
}

std::vector<double> friction_numbers(const Problem& p) {
  const FrictionLaw law = p.settings.friction.value_or(FrictionLaw{});
  return {static_cast<double>(law.digit), 1, 0, 0, 0, law.at_rest, law.at_rest * law.falling.kinetic_share};
}

}  // namespace

const Solved& solution(const Problem& p) {
  if (!p.solved) throw Refused(kOther, "there is no solution: cntc_calculate comes first");
  return *p.solved;
}

Resultant resultant(const Problem& p) {
  const Solved& s = solution(p);
  const PatchGrid& g = s.on.grid;
  const TangentialSolution& t = s.rolling.tangential;
  Resultant out;
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) {
      const std::size_t k = g.index(i, j);
      Vec3 traction{-t.q_x[k], -t.q_y[k], s.rolling.normal.pressure[k]};
      Vec3 place{g.x(i) - p.origin_x, g.y(j) - p.origin_y, 0};
      if (!p.rows.empty()) {
        const CurvedRow& row = p.rows[static_cast<std::size_t>(j)];
        traction = marker({}, row.turn).turned(traction);
        place = {place.x, row.s, row.n};
      }
      out.force += traction;
      out.moment += cross(place, traction);
    }
  return {g.cell_area() * out.force, g.cell_area() * out.moment};
}

Grid grid_of(const Problem& p) {
  const PatchGrid g = p.solved ? p.solved->on.grid : discretise(p.settings).grid;
  const double length = p.units.length;
  const double y = p.side > 0 ? g.y0 : -g.y(g.ny - 1);
  return {g.nx, g.ny, g.x0 / length, y / length, g.dx / length, g.dy / length};
}

std::array<double, 4> forces(const Problem& p) {
  const Resultant r = resultant(p);
  const double body = p.units.body;
  const double normal = p.rows.empty() ? solution(p).rolling.normal.load : r.force.z;
  return {normal, body * r.force.x, body * p.side * r.force.y, body * p.side * r.moment.z / p.units.length};
}

std::array<double, 3> creepages(const Problem& p) {
  const Solved& s = solution(p);
  const double body = p.units.body, length = p.units.length, unit = s.shift ? 1 / length : 1;
  const TangentialSolution& t = s.rolling.tangential;
  return {body * unit * (t.creepage_x - s.spin * p.origin_y),
          body * p.side * unit * (t.creepage_y + s.spin * p.origin_x), body * p.side * s.spin * (s.shift ? 1 : length)};
}

double approach(const Problem& p) { return solution(p).rolling.normal.approach / p.units.length; }

std::vector<int> division(const Problem& p) {
  const Solved& s = solution(p);
  const PatchGrid& g = s.on.grid;
  std::vector<int> out(g.size());
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) {
      const std::size_t k = g.index(i, j);
      const TangentialSolution& t = s.rolling.tangential;
      const bool slips = t.state[k] == ContactState::slip && (!s.film.yields() || t.slip.x[k] != 0 || t.slip.y[k] != 0);
      const int in_contact = slips ? (yields(s, k) ? 3 : 2) : 1;
      out[element(g, p.side, i, j)] = s.rolling.normal.pressure[k] > 0 ? in_contact : 0;
    }
  return out;
}

std::array<double, 3> areas(const Problem& p) {
  const std::vector<int> all = division(p);
  const double cell = solution(p).on.grid.cell_area() / p.units.area();
  const auto stick = static_cast<double>(std::count(all.begin(), all.end(), 1));
  const auto slip = static_cast<double>(std::count_if(all.begin(), all.end(), [](int kind) { return kind >= 2; }));
  return {(stick + slip) * cell, stick * cell, slip * cell};
}

double largest_pressure(const Problem& p) {
  const Plane& all = solution(p).rolling.normal.pressure;
  return *std::max_element(all.begin(), all.end()) * p.units.area();
}

double largest_temperature(const Problem& p) {
  const Plane& all = temperatures(solution(p));
  return *std::max_element(all.begin(), all.end());
}

double largest_traction(const Problem& p) {
  const TangentialSolution& t = solution(p).rolling.tangential;
  double largest = 0;
  for (std::size_t k = 0; k < t.q_x.size(); ++k) largest = std::max(largest, std::hypot(t.q_x[k], t.q_y[k]));
  return largest * p.units.area();
}

std::vector<double> field(const Problem& p, int number) {
  const Solved& s = solution(p);
  const PatchGrid& g = s.on.grid;
  const TangentialSolution& t = s.rolling.tangential;
  const double stress = p.units.area(), length = 1 / p.units.length, body = p.units.body;
  // CONTACT divides the slip by its rolling step, which in a shift is 1 mm, whatever the units are.
  const double slip = body * (s.shift ? 1e3 : 1);
  switch (number) {
    case kGap:
      return in_order(g, p.side, s.on.gap, length);
    case kFrictionField:
      return in_order(g, p.side, friction_field(s), 1);
    case kTractionX:
      return in_order(g, p.side, t.q_x, -body * stress);
    case kTractionY:
      return in_order(g, p.side, t.q_y, -p.side * body * stress);
    case kPressure:
      return in_order(g, p.side, s.rolling.normal.pressure, stress);
    case kDisplacementX:
      return in_order(g, p.side, tangential_displacement(s).x, -length);
    case kDisplacementY:
      return in_order(g, p.side, tangential_displacement(s).y, -p.side * length);
    case kDisplacementN:
      return in_order(g, p.side, normal_displacement(s), length);
    case kFilmStrength: {
      if (!s.film.yields()) throw Refused(kOther, "field 11 is of a film that yields");
      Plane strength(g.size());
      for (std::size_t k = 0; k < strength.size(); ++k) strength[k] = film_strength(s, k);
      return in_order(g, p.side, strength, stress);
    }
    case kTemperature1:
    case kTemperature2:
      return in_order(g, p.side, temperatures(s), 1);
    case kSlipX:
      return in_order(g, p.side, t.slip.x, slip);
    case kSlipY:
      return in_order(g, p.side, t.slip.y, p.side * slip);
    default:
      throw Refused(kOther, fmt::format("field {} is not offered: 1 to 5, 7 to 9, 11, 15, 16, 20 and 21 are", number));
  }
}

std::array<double, 10> hertz(const Problem& p) {
  if (p.settings.grid.number >= 0) throw Refused(kOther, "the contact is not set as a Hertzian one");
  const Hertz h = p.solved ? p.solved->on.hertz : discretise(p.settings).hertz;
  const double length = p.units.length, a = h.a / length, b = h.b / length;
  return {h.A * length, h.B * length, a, b, 2 / ((h.A + h.B) * length), std::sqrt(a * b), h.scale, b, b, a / b};
}

std::vector<double> parameters(const Problem& p, int task) {
  const Settings& s = p.settings;
  if (task == 1) {
    const double step = p.solved ? p.solved->on.grid.dx : s.step.value_or(std::numeric_limits<double>::quiet_NaN());
    return {s.speed / p.units.length, s.chi, step / p.units.length, 0, 0, 0};
  }
  if (task == 2) return material_numbers(p);
  if (task == 3) return friction_numbers(p);
  throw Refused(kOther, fmt::format("cntc_getparameters: task {} does not exist", task));
}

}  // namespace railstrata::cntc
