#include <fmt/format.h>

#include <cmath>

#include "cntc/module_one.hpp"
#include "cntc/settings.hpp"

namespace railstrata::cntc {
namespace {

void require(Numbers values, std::size_t least, std::size_t most, const std::string& what) {
  if (values.size() < least || values.size() > most)
    throw Refused(kOther, least == most ? fmt::format("{} takes {} numbers, {} were given", what, least, values.size())
                                        : fmt::format("{} takes {} to {} numbers, {} were given", what, least, most,
                                                      values.size()));
  for (const double v : values)
    if (!std::isfinite(v)) throw Refused(kOther, what + " has a number that is not finite");
}

OutlineOptions options_of(const Problem& base, std::span<const int> ints, Numbers reals) {
  const auto whole = [&](std::size_t k) { return ints.size() > k ? ints[k] : 0; };
  const auto number = [&](std::size_t k) { return reals.size() > k ? reals[k] : 0.0; };
  const int spline = whole(5);
  if (number(1) > 0 && spline > 1)
    throw Refused(kProfile, fmt::format("ISMOOTH = {} is not offered: 0 and 1 are", spline));
  OutlineOptions out;
  out.smoothing.amount = number(1);
  out.smoothing.weighted = spline == 1;
  if (reals.size() > 3) out.smoothing.zigzag = number(3);
  if (reals.size() > 4) out.smoothing.kink = number(4);
  out.smoothing.beside = reals.size() > 5 ? number(5) : out.smoothing.kink / 5;
  if (reals.size() > 6) out.smoothing.width = 1e3 * base.units.length * number(6);
  out.mirror_y = whole(2) == 1;
  out.mirror_z = whole(3);
  // As in CONTACT: the factor makes millimetres of a profile, whatever the units are.
  out.scale = number(0) > 5e-4 ? number(0) : 1e3 * base.units.length;
  return out;
}

void take(ModuleOne& one, Outline outline) {
  (outline.profile().kind() == ProfileKind::wheel ? one.wheel : one.rail) = std::move(outline);
}

void take_design(ModuleOne& one, double length, Numbers v) {
  TrackPlace t;
  t.gauge_depth = v[0] * length;
  if (v[0] > 0) {
    t.gauge = v[2] * length;
  } else {
    t.y = v[1] * length;
    t.z = v[2] * length;
  }
  t.cant = v[3];
  t.roller_radius = v[4] * length;
  t.curvature = v.size() > 5 ? v[5] / length : 0;
  one.track = t;
  one.has_track = true;
}

void take_shift(ModuleOne& one, double length, Numbers v) {
  const double unit[] = {length, length, 1, length, length, 1};
  for (std::size_t k = 0; k < 6; ++k) one.rail_shift[k] = unit[k] * v[k];
}

void take_support(ModuleOne& one, double length, Numbers v) {
  require(v, 4, 5, "Z = 32 and 33");
  if (v[0] < 0 || v[2] < 0) throw Refused(kOther, "KYRAIL and KZRAIL, the rail's stiffness, are not below 0");
  RailSupport& s = one.forces.rail;
  for (std::size_t k = 0; k < 2; ++k) {
    s.stiffness[k] = v[2 * k] / length;
    s.force[k] = v[2 * k + 1];
  }
  s.first_step = (v.size() > 4 ? v[4] : 1e-3 / length) * length;
}

std::array<double, 6> six(Numbers v, double length) {
  return {v[0] * length, v[1] * length, v[2] * length, v[3], v[4], v[5]};
}

void require_wheel_digit(int digit, int least) {
  if (digit < least || digit > 5) throw Refused(kOther, fmt::format("E = {} does not exist here", digit));
}

}  // namespace

double side_of(const Problem& base) {
  const int config = flag(base.settings, kConfiguration);
  return config == 0 || config == 4 ? -1 : 1;
}

bool on_roller(const Problem& base) { return flag(base.settings, kConfiguration) >= 4; }

bool profile_is_of_wheel(const std::string& file, std::span<const int> ints) {
  if (!ints.empty() && (ints[0] == 0 || ints[0] == 1)) return ints[0] == 1;
  return kind_of_file(file) == ProfileKind::wheel;
}

void set_profile(ModuleOne& one, const Problem& base, const std::string& file, std::span<const int> ints,
                 Numbers reals) {
  const ProfileKind kind = profile_is_of_wheel(file, ints) ? ProfileKind::wheel : ProfileKind::rail;
  take(one, read_outline(kind, file, options_of(base, ints, reals)));
}

void set_profile(ModuleOne& one, const Problem& base, Numbers values, std::span<const int> ints, Numbers reals) {
  const ProfileKind kind = !ints.empty() && ints[0] <= 0 ? ProfileKind::rail : ProfileKind::wheel;
  take(one, outline_of(kind, values, options_of(base, ints, reals)));
}

void set_track(ModuleOne& one, const Problem& base, int digit, Numbers v) {
  const double length = base.units.length;
  if (digit == 32 || digit == 33) return take_support(one, base.units.length, v);
  if (digit < 0 || digit > 3) throw Refused(kOther, fmt::format("Z = {} does not exist", digit));
  if (digit == 0) return require(v, 0, 0, "Z = 0");
  if (digit == 1) {
    require(v, 5, 6, "Z = 1");
    return take_design(one, length, v);
  }
  require(v, digit == 2 ? 6 : 11, digit == 2 ? 6 : 12, fmt::format("Z = {}", digit));
  if (digit == 3) take_design(one, length, v.first(v.size() - 6));
  take_shift(one, length, v.last(6));
}

void set_wheelset(ModuleOne& one, const Problem& base, int digit, Numbers v) {
  require_wheel_digit(digit, 0);
  if (digit != 3 && digit != 5) return require(v, 0, 0, fmt::format("E = {}", digit));
  require(v, 3, 4, fmt::format("E = {}", digit));
  if (!(v[2] > 0)) throw Refused(kOther, "NOMRAD, the wheel's radius, is above 0");
  const double length = base.units.length;
  one.flange_distance = v[0] * length;
  one.flange_place = v[1] * length;
  one.wheel_radius = v[2] * length;
  one.tape_y.reset();
  if (v.size() > 3 && std::abs(v[3]) * length < 0.999) one.tape_y = v[3] * length;
  one.has_wheelset = true;
}

void set_position(ModuleOne& one, const Problem& base, int digit, Numbers v) {
  require_wheel_digit(digit, 1);
  require(v, 6, 6, "a position");
  one.wheelset.at = six(v, base.units.length);
}

void set_velocity(ModuleOne& one, const Problem& base, int digit, Numbers v) {
  require_wheel_digit(digit, 1);
  if (digit == 1 && v.empty()) return;
  require(v, 6, 6, "a velocity");
  one.wheelset.rate = six(v, base.units.length);
  one.pitch_rate_of_roller = 0;
  if (!on_roller(base)) return;
  one.pitch_rate_of_roller = v[0];
  one.wheelset.rate[0] = 0;
}

void set_flexibility(ModuleOne& one, const Problem& base, int digit, Numbers v) {
  require_wheel_digit(digit, 1);
  if (digit <= 3) {
    require(v, 0, 1, fmt::format("E = {}", digit));
    one.flexibility = {};
    return;
  }
  require(v, 12, 12, fmt::format("E = {}", digit));
  one.flexibility = {six(v.first(6), base.units.length), six(v.last(6), base.units.length)};
}

void set_vertical_force(ModuleOne& one, Problem& base, double force) {
  if (!(force > 0) || !std::isfinite(force))
    throw Refused(kOther, fmt::format("a vertical force is above 0, not {:g}", force));
  base.settings.flags[kNorm] = 1;
  one.forces.load = force;
}

void set_force_along(ModuleOne& one, double force) {
  if (!std::isfinite(force)) throw Refused(kTotalForce, "a force along the track is finite");
  one.forces.along = force;
}

void set_search(ModuleOne& one, const Problem& base, int number, Numbers v) {
  if (number != 0 && number != -1)
    throw Refused(kGrid, fmt::format("IPOTCN = {}: wheel on rail (icp = -1) has -1 and 0", number));
  require(v, number == 0 ? 3 : 5, number == 0 ? 3 : 7, fmt::format("IPOTCN = {}", number));
  if (!(v[0] > 0) || !(v[1] > 0)) throw Refused(kGrid, "DX and DS are above 0");
  if (v.size() > 6 && v[6] > 0) throw Refused(kGrid, "G_MISS, patches that nearly touch, is not offered above 0");
  const double length = base.units.length;
  one.steps.dx = v[0] * length;
  one.steps.ds = v[1] * length;
  if (number == 0) return;
  one.steps.angle = std::max(0.0, v[2]);
  one.steps.separate = std::max(0.0, v[3]) * length;
  one.steps.combine = std::max(0.0, v[4]) * length;
  one.steps.turn = v.size() > 5 ? std::max(0.0, v[5]) * length : 2 * one.steps.separate - one.steps.combine;
}

void set_relative_step(ModuleOne& one, double step) {
  if (!(step > 0) || !std::isfinite(step)) throw Refused(kGrid, fmt::format("DQREL = {:g} is not above 0", step));
  one.relative_step = step;
}

std::string set_wheel_friction(ModuleOne& one, Problem& base, int method, Numbers v) {
  const int digit = method % 10, varies = method / 10;
  if (digit == 1) return "";
  if (method < 10) {
    std::string remark = set_friction(base, method, v);
    one.varies = 0;
    one.slices.clear();
    return remark;
  }
  if (varies > 2) throw Refused(kFriction, fmt::format("V = {} does not exist", varies));
  const auto count = v.empty() ? 0 : static_cast<std::size_t>(std::max(0.0, v[0]));
  if (count < 1 || v.size() < 3 || (v.size() - 1) % count != 0)
    throw Refused(kFriction, fmt::format("V = {} begins with NVF, the number of its slices", varies));
  const std::size_t each = (v.size() - 1) / count;
  std::vector<FrictionSlice> slices;
  for (std::size_t k = 0; k < count; ++k) {
    const Numbers of = v.subspan(1 + k * each, each);
    slices.push_back({of[0] * (varies == 2 ? base.units.length : 1), {of.begin() + 1, of.end()}});
    if (k > 0 && !(slices[k].at > slices[k - 1].at)) throw Refused(kFriction, "the slices of friction do not rise");
    set_friction(base, digit, slices.back().numbers);
  }
  one.slices = std::move(slices);
  one.varies = varies;
  one.friction_digit = digit;
  return "";
}

}  // namespace railstrata::cntc
