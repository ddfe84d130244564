#include "cntc/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace railstrata::cntc {
namespace {

constexpr double kLeastFriction = 1e-6;
constexpr double kNoThickness = 1e-12;  // m
constexpr double kNoStrength = 1e-2;    // of the strength at first: what softening leaves

void require_finite(Numbers values, int code, const char* what) {
  for (const double v : values)
    if (!std::isfinite(v)) throw Refused(code, fmt::format("{} has a number that is not finite", what));
}

void require_count(Numbers values, std::size_t count, int code, const std::string& what) {
  if (values.size() != count)
    throw Refused(code, fmt::format("{} takes {} numbers, {} were given", what, count, values.size()));
  require_finite(values, code, what.c_str());
}

HalfSpaceMaterial material(double poisson, double shear) {
  if (!(shear > 0) || !(poisson >= 0 && poisson <= 0.5))
    throw Refused(kOther, fmt::format("a shear modulus is above 0 and Poisson's ratio 0 to 0.5, not {:g} and {:g}",
                                      shear, poisson));
  return {2 * (1 + poisson) * shear, poisson};
}

void take_memory(double distance, double velocity, double unit, FallingFriction& law) {
  if (!(distance >= 0) || !(velocity >= 0))
    throw Refused(kFriction, fmt::format("MEMDST and MEM_S0 are 0 or more, not {:g} and {:g}", distance, velocity));
  law.memory_distance = distance * unit;
  law.memory_velocity = velocity * unit;
  law.implicit_memory = true;
}

/// One of the two terms of CONTACT's falling laws; the other has to be 0.
FallingFriction falling_law(int digit, Numbers v, double speed_unit) {
  if (v[3] != 0)
    throw Refused(kFriction, "of the falling laws L = 3 and 4 the first term is offered: give 0 for the second");
  FallingFriction out;
  out.form = digit == 3 ? FrictionForm::falling_rational : FrictionForm::falling_exponential;
  out.kinetic_share = v[0] / (v[0] + v[1]);
  out.half_velocity = v[2] * speed_unit;
  take_memory(v[5], v[6], speed_unit, out);
  return out;
}

/// L = 5: FSTAT, A, B of FSTAT (A + (1 - A) exp(-B v)).
FrictionLaw polach_law(Numbers v, double speed_unit) {
  if (!(v[0] > 0) || !(v[1] >= 0 && v[1] <= 1) || !(v[2] > 0))
    throw Refused(kFriction, "L = 5 has FSTAT > 0, POLACH_A from 0 to 1 and POLACH_B > 0");
  FrictionLaw law;
  law.at_rest = v[0];
  law.falling.form = FrictionForm::falling_exponential;
  law.falling.kinetic_share = v[1];
  law.falling.half_velocity = std::numbers::ln2 / v[2] * speed_unit;
  return law;
}

/// L = 6: FREF up to TREF, FREF + DFHEAT from TREF + DTHEAT on.
FrictionLaw warm_law(Numbers v) {
  if (!(v[0] > 0) || !(v[0] + v[2] >= 0) || !(v[3] > 0))
    throw Refused(kFriction, "L = 6 has FREF > 0, FREF + DFHEAT of 0 or more and DTHEAT > 0");
  if (v[4] != 0) throw Refused(kFriction, "friction by temperature has no memory here: give MEMDST = 0");
  FrictionLaw law;
  law.at_rest = v[0];
  law.by_temperature = {{v[1], 1}, {v[1] + v[3], 1 + v[2] / v[0]}};
  return law;
}

/// Numbers of cells, the first two values.
int cells(double value, const char* name) {
  if (!(value >= 1 && value <= 1e5))
    throw Refused(kGrid, fmt::format("{} = {:g} is no number of elements", name, value));
  return static_cast<int>(std::lround(value));
}

Parameters with_cells(int number, Numbers values) {
  Parameters out{number, cells(values[0], "MX"), cells(values[1], "MY"), {}};
  if (static_cast<double>(out.mx) * out.my > 4e6)
    throw Refused(kGrid, fmt::format("{} x {} elements are more than 4 million", out.mx, out.my));
  out.value.assign(values.begin() + 2, values.end());
  return out;
}

std::vector<double> in_si(Numbers values, std::initializer_list<int> powers_of_length, double length) {
  std::vector<double> out(values.begin(), values.end());
  auto power = powers_of_length.begin();
  for (double& v : out) v *= std::pow(length, *power++);
  return out;
}

}  // namespace

void set_materials(Problem& p, int digit, Numbers v) {
  const bool simple = digit == 3 || digit == 5;
  if (digit != 0 && digit != 1 && digit != 4 && !simple)
    throw Refused(kOther, fmt::format("material M = {} is not offered: 0 (elastic), 1 (viscoelastic), 3 (FASTSIM), 4 "
                                      "(with an elastic film) and 5 (FaStrip) are",
                                      digit));
  require_count(v, digit == 0 ? 4 : simple ? 7 : 8, kOther, fmt::format("M = {}", digit));
  const double stress = 1 / p.units.area();
  Materials& m = p.settings.materials;
  const std::array<HalfSpaceMaterial, 2> bodies{material(v[0], v[2] * stress), material(v[1], v[3] * stress)};
  ThirdBody film;
  if (digit == 4) {
    if (!(v[4] > 0) || !(v[5] >= 0))
      throw Refused(kOther, "a film has a modulus GG3 above 0 and a thickness of 0 or more");
    film.shear_modulus = v[4] * stress;
    film.thickness = v[5] * p.units.length;
    if (v[6] > 0) {  // without a thickness, of no elastic shear
      film.thickness = std::max(film.thickness, kNoThickness);
      film.yield_shear = v[6] * stress;
      film.hardening = v[7] * stress / p.units.length;
      if (film.hardening < 0) film.residual = kNoStrength * film.yield_shear;
    }
  }
  if (simple && !(v[4] > 0 && v[4] <= 1 && v[5] >= 0 && v[5] <= 1 && v[6] >= 0))
    throw Refused(kOther, "M = 3 and 5 have K0_MF above 0 to 1, ALFAMF from 0 to 1 and BETAMF of 0 or more");
  if (digit == 1 && !(v[4] >= 0 && v[6] >= 0 && v[4] == v[5] && v[6] == v[7]))
    throw Refused(kOther, "M = 1 has FG and TC of 0 or more, the same ones for both bodies");
  m.body = bodies;
  m.film = film;
  m.viscosity.reset();
  if (digit == 1) m.viscosity = {v[4], v[6]};
  m.simplified.reset();
  if (simple) m.simplified = {v[4], v[5], v[6], digit == 5};
  p.settings.has_materials = true;
}

void set_heat(Problem& p, int digit, Numbers v) {
  if (digit == 1) return;
  if (digit == 0) {
    p.settings.heat.reset();
    return;
  }
  if (digit != 3) throw Refused(kOther, fmt::format("temperatures H = {} are not offered: 0, 1 and 3 are", digit));
  if (v.size() != 8 && v.size() != 9) throw Refused(kOther, "H = 3 takes 8 or 9 numbers");
  require_finite(v, kOther, "H = 3");
  const double length = p.units.length;
  const auto body = [&](std::size_t k) {
    if (!(v[k + 1] > 0) || !(v[k + 2] > 0) || !(v[k + 3] > 0))
      throw Refused(kOther, "heat capacities, conductivities and densities are above 0");
    ThermalBody out;
    out.base = {v[k + 2] / length, v[k + 3] / (length * length * length), v[k + 1]};
    return out;
  };
  p.settings.heat = ContactHeat{body(4), body(0), v[4], v[0], {}, {}};
}

void set_layers(Problem& p, int body, int count, Numbers thickness, Numbers young, Numbers poisson) {
  if (body != 1 && body != 2) throw Refused(kOther, fmt::format("layers are on body 1 or 2, not {}", body));
  for (const Numbers& v : {thickness, young, poisson})
    if (count < 0 || v.size() != static_cast<std::size_t>(count))
      throw Refused(kOther, fmt::format("{} layers, and {} numbers for them", count, v.size()));
  for (const Numbers& v : {thickness, young, poisson}) require_finite(v, kOther, "a layer");
  std::vector<HalfSpaceLayer> out;
  for (std::size_t k = 0; k < thickness.size(); ++k) {
    if (!(thickness[k] > 0) || !(young[k] > 0) || !(poisson[k] >= 0 && poisson[k] <= 0.5))
      throw Refused(
          kOther, fmt::format("layer {}: thickness and Young's modulus are above 0, Poisson's ratio 0 to 0.5", k + 1));
    HalfSpaceLayer layer;
    layer.thickness = thickness[k] * p.units.length;
    layer.material = {young[k] / p.units.area(), poisson[k]};
    out.push_back(layer);
  }
  p.settings.materials.layers[static_cast<std::size_t>(body - 1)] = std::move(out);
}

std::string set_friction(Problem& p, int method, Numbers v) {
  const int digit = method % 10;
  if (method < 0 || method > 9)
    throw Refused(kFriction, fmt::format("friction V = {} is of module 1: 0 is offered", method / 10));
  if (digit == 1) return "";  // as before
  FrictionLaw law;
  if (digit == 0) {
    require_count(v, 2, kFriction, "L = 0");
    if (!(v[0] >= 0) || !(v[1] >= 0))
      throw Refused(kFriction, fmt::format("FSTAT and FKIN are 0 or more, not {:g} and {:g}", v[0], v[1]));
    law.at_rest = std::min(v[0], v[1]);
  } else if (digit == 3 || digit == 4) {
    require_count(v, 7, kFriction, fmt::format("L = {}", digit));
    law.at_rest = v[0] + v[1];
    if (!(v[0] > 0) || !(v[1] >= 0) || !(v[2] > 0))
      throw Refused(kFriction, "falling friction has FKIN > 0, a first term of 0 or more and SABSH1 > 0");
    law.falling = falling_law(digit, v, p.units.length);
  } else if (digit == 5) {
    require_count(v, 3, kFriction, "L = 5");
    law = polach_law(v, p.units.length);
  } else if (digit == 6) {
    require_count(v, 6, kFriction, "L = 6");
    law = warm_law(v);
  } else {
    throw Refused(kFriction, fmt::format("friction L = {} is not offered: 0 and 3 to 6 are", digit));
  }
  law.digit = digit;
  const bool raised = law.at_rest < kLeastFriction;
  if (raised) law.at_rest = kLeastFriction;
  p.settings.friction = law;
  return raised ? fmt::format("friction below {0:g} is taken as {0:g}; without friction: T = 0", kLeastFriction) : "";
}

void set_hertz(Problem& p, int number, Numbers v) {
  if (number < -3 || number > -1)
    throw Refused(kGrid, fmt::format("IPOTCN = {} is not offered: -1, -2 and -3 are Hertzian ellipses", number));
  require_count(v, 5, kGrid, fmt::format("IPOTCN = {}", number));
  Parameters grid = with_cells(number, v);
  const double length = p.units.length;
  grid.value[0] *= number == -3 ? length : 1 / length;
  grid.value[1] *= number == -3 ? length : number == -1 ? 1 / length : 1;
  for (const double value : grid.value)
    if (!(value > 0)) throw Refused(kGrid, fmt::format("the numbers of IPOTCN = {} are above 0", number));
  p.settings.grid = std::move(grid);
}

void set_potential_contact(Problem& p, int number, Numbers v) {
  if (number < 1 || number > 4) throw Refused(kGrid, fmt::format("IPOTCN = {} is not offered: 1 to 4 are", number));
  require_count(v, 6, kGrid, fmt::format("IPOTCN = {}", number));
  Parameters grid = with_cells(number, v);
  for (double& value : grid.value) value *= p.units.length;
  const bool steps = number == 1 || number == 3;
  const double dx = steps ? grid.value[2] : grid.value[2] - grid.value[0];
  const double dy = steps ? grid.value[3] : grid.value[3] - grid.value[1];
  if (!(dx > 0) || !(dy > 0) || (number == 4 && (grid.mx == 1 || grid.my == 1)))
    throw Refused(kGrid, fmt::format("IPOTCN = {} gives elements without a size", number));
  p.settings.grid = std::move(grid);
}

void set_gap(Problem& p, int number, Numbers v) {
  const double length = p.units.length;
  Parameters gap;
  gap.number = number;
  if (number == 1) {
    require_count(v, 6, kOther, "IBASE = 1");
    gap.value = in_si(v, {-1, -1, -1, 0, 0, 1}, length);
  } else if (number == 2) {
    if (v.empty() || !(v[0] >= 2 && v[0] <= 1e6))
      throw Refused(kOther, "IBASE = 2 begins with its number of heights, 2 or more");
    require_count(v, 5 + static_cast<std::size_t>(std::lround(v[0])), kOther, "IBASE = 2");
    if (!(v[2] != 0) || !(v[4] > 0)) throw Refused(kOther, "IBASE = 2: RM is not 0 and DY1 above 0");
    gap.value.assign(v.begin() + 1, v.end());
    for (double& value : gap.value) value *= length;
  } else if (number == 3) {
    require_count(v, 8, kOther, "IBASE = 3");
    gap.value = in_si(v, {1, -1, 1, 1, -1, 1, 1, 1}, length);
  } else if (number == 9) {
    require_finite(v, kOther, "IBASE = 9");
    gap.value.assign(v.begin(), v.end());
    for (double& value : gap.value) value *= length;
  } else {
    throw Refused(kOther, fmt::format("IBASE = {} does not exist: 1, 2, 3 and 9 do", number));
  }
  p.settings.gap = std::move(gap);
}

void set_load(Problem& p, double force) {
  if (!(force > 0) || !std::isfinite(force))
    throw Refused(kOther, fmt::format("a normal force is above 0, not {:g}", force));
  p.settings.flags[kNorm] = 1;
  p.settings.load = force;
}

void set_approach(Problem& p, double approach) {
  if (!std::isfinite(approach)) throw Refused(kOther, "the approach is not finite");
  p.settings.flags[kNorm] = 0;
  p.settings.approach = approach * p.units.length;
}

void set_creepages(Problem& p, double x, double y, double spin) {
  const double all[] = {x, y, spin};
  require_finite(all, kOther, "creepages");
  p.settings.creepages = {x, y, spin, p.units.length};
}

void set_extra_slip(Problem& p, Numbers x, Numbers y) {
  require_finite(x, kOther, "the extra rigid slip");
  require_finite(y, kOther, "the extra rigid slip");
  p.settings.flags[kExtraSlip] = 1;
  p.settings.extra_x.assign(x.begin(), x.end());
  p.settings.extra_y.assign(y.begin(), y.end());
}

void set_forces(Problem& p, double x, double y) {
  const double both[] = {x, y};
  require_finite(both, kTotalForce, "tangential forces");
  p.settings.relative_x = x;
  p.settings.relative_y = y;
}

void set_speed(Problem& p, double speed) {
  if (!(speed > 0) || !std::isfinite(speed))
    throw Refused(kOther, fmt::format("a rolling velocity is above 0, not {:g}: chi has its direction", speed));
  p.settings.speed = speed * p.units.length;
}

void set_rolling_step(Problem& p, double chi, double step) {
  constexpr double kNear = 0.01;
  if (!(std::abs(chi) < kNear) && !(std::abs(std::abs(chi) - std::numbers::pi) < kNear))
    throw Refused(kGrid, fmt::format("a rolling direction of {:g} rad is not offered: 0 and pi are", chi));
  if (!(step > 0) || !std::isfinite(step)) throw Refused(kGrid, fmt::format("a rolling step of {:g}", step));
  p.settings.chi = std::abs(chi) < kNear ? 0.0 : std::numbers::pi;
  p.settings.step = step * p.units.length;
}

void set_solver(Problem& p, int digit, std::span<const int> ints, Numbers reals) {
  constexpr std::size_t kInts[] = {4, 0, 5, 5, 5, 5, 1}, kReals[] = {1, 0, 4, 4, 2, 8, 1};
  if (digit < 0 || digit > 6) throw Refused(kOther, fmt::format("solver G = {} does not exist", digit));
  if (ints.size() != kInts[digit] || reals.size() != kReals[digit])
    throw Refused(kOther,
                  fmt::format("G = {} takes {} whole numbers and {} others", digit, kInts[digit], kReals[digit]));
  require_finite(reals, kOther, fmt::format("G = {}", digit).c_str());
  if (digit == 1 || digit == 6) return;
  if (!(reals[0] > 0)) throw Refused(kOther, fmt::format("EPS is above 0, not {:g}", reals[0]));
  // Never looser than the engine's own, which costs little: Newton's method.
  constexpr double kSharpest = 1e-9, kStandard = 1e-5;
  p.settings.tolerance = std::clamp(reals[0], kSharpest, kStandard);
  if (digit >= 2 && digit <= 4) p.settings.first_slip = ints[4];
}

}  // namespace railstrata::cntc
