// Indices of src/laws/damage for numbers of the user's own.
#include <array>
#include <optional>
#include <stdexcept>
#include <vector>

#include "bridge/call.hpp"
#include "damage/brittle.hpp"
#include "damage/critical_plane.hpp"
#include "damage/dang_van.hpp"
#include "damage/wear.hpp"
#include "damage/wear_indices.hpp"
#include "material/steels.hpp"

namespace railstrata::bridge {
namespace {

Sym3 tensor(const double* s) { return {s[0], s[1], s[2], s[3], s[4], s[5]}; }

/// (n, 6) stresses of a point over the cycle.
std::vector<Sym3> cycle_of(const Call& call) {
  const Array stresses = call.array("cycle");
  if (stresses.shape.size() != 2 || stresses.shape[0] < 1 || stresses.shape[1] != 6)
    throw std::invalid_argument("cycle: an array of shape (samples, 6) is wanted, components xx, yy, zz, xy, yz, xz");
  std::vector<Sym3> out;
  for (std::size_t k = 0; k < stresses.shape[0]; ++k) out.push_back(tensor(stresses.data + 6 * k));
  return out;
}

Sym3 residual_of(const Call& call) {
  const Json& given = call.argument("residual");
  if (!given.is_array() || given.size() != 6)
    throw WrongType("residual: six stresses xx, yy, zz, xy, yz, xz are wanted");
  std::array<double, 6> s{};
  for (std::size_t k = 0; k < s.size(); ++k) s[k] = double_of(given[k]);
  return tensor(s.data());
}

void t_gamma_of(Call& call) {
  const TGamma t = t_gamma({call.number("force_x"), call.number("force_y"), call.number("moment"),
                            call.number("creepage_x"), call.number("creepage_y"), call.number("spin")});
  call.answer["value"] = {number(t.without_spin), number(t.with_spin), number(t.energy)};
}

RcfDamageFunction damage_function(const Call& call) {
  const Json& given = call.argument("function");
  if (given == "15") return rcf_damage_15();
  if (given == "15 clipped") return rcf_damage_15_clipped();
  if (given == "20") return rcf_damage_20();
  if (!given.is_array()) throw std::invalid_argument("function: \"15\", \"15 clipped\", \"20\", or break points");
  RcfDamageFunction out;
  out.wear_removes = call.flag("wear_removes");
  for (const Json& point : given) out.points.push_back({double_of(point.at(0)), double_of(point.at(1))});
  check(out);
  return out;
}

void rcf(Call& call) { call.answer["value"] = number(rcf_damage(damage_function(call), call.number("t_gamma"))); }

void wear_number(Call& call) {
  call.answer["value"] = number(brr_wear(call.number("t_gamma"), call.number("wheel_diameter")));
}

EllipticPatch elliptic_patch(const Call& call) {
  return {call.number("a"), call.number("b"), call.number("load"), call.number("utilised_friction")};
}

void surface_fatigue(Call& call) {
  call.answer["value"] = number(surface_fatigue_index(elliptic_patch(call), call.number("cyclic_shear_yield")));
}

void subsurface_fatigue(Call& call) {
  call.answer["value"] = number(subsurface_fatigue_index(elliptic_patch(call), call.number("dang_van_constant"),
                                                         call.number("residual_hydrostatic")));
}

/// The arrays of a row by their names, of one length; none: that of the first.
Streamline streamline_of(const Call& call, std::array<const char*, 5> names) {
  std::array<std::span<const double>, 5> all;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const Array numbers = call.array(names[k]);
    all[k] = numbers.all();
    if (numbers.shape.size() != 1 || all[k].size() != all[0].size())
      throw std::invalid_argument("the arrays of a row have one length");
  }
  const double dx = call.number("dx"), speed = call.number("speed");
  if (!(dx > 0) || !(speed > 0)) throw std::invalid_argument("dx and speed: positive numbers are wanted");
  return {all[0], all[1], all[2], all[3], all[4], dx, speed};
}

void wear_rate(Call& call) { call.answer["value"] = number(usfd_rate(call.number("t_gamma_per_area"))); }

void wear_depth(Call& call) {
  const Streamline line = streamline_of(call, {"q_x", "q_x", "q_y", "slip_x", "slip_y"});
  call.answer["value"] = number(usfd_depth(line, call.number("density")));
}

void archard(Call& call) {
  const Streamline line = streamline_of(call, {"p", "p", "p", "slip_x", "slip_y"});
  const double depth = archard_depth(line, laboratory_dry_archard(), call.number("hardness"), call.number("scale"));
  call.answer["value"] = number(depth);
}

void dang_van(Call& call) {
  const DangVanStress found = dang_van_stress(cycle_of(call), residual_of(call), call.number("c"));
  call.answer["value"] = {number(found.stress), number(found.amplitude), number(found.hydrostatic), found.sample};
}

Json plane_json(const std::optional<CriticalPlane>& found) {
  if (!found) return nullptr;
  const Vec3 n = found->normal;
  return {number(found->value), Json::array({n.x, n.y, n.z}), number(found->cycle.normal_max),
          number(found->cycle.normal_strain_range), number(found->cycle.shear_range)};
}

/// The three parameters of one point.
void critical_plane(Call& call) {
  StressHistory history;
  history.stress = cycle_of(call);
  for (std::size_t k = 0; k < history.stress.size(); ++k) history.x.push_back(static_cast<double>(k));
  history.y = {0};
  history.depth = {0};
  history.zone = {0};
  CriticalPlaneMaterial material{call.number("young"), call.number("poisson"), std::nullopt, std::nullopt};
  if (const Json& given = call.argument("fatemi_socie"); !given.is_null())
    material.fatemi_socie = FatemiSocieConstants{double_of(given.at(0)), double_of(given.at(1))};
  if (!call.argument("jiang_sehitoglu").is_null()) material.jiang_sehitoglu = call.number("jiang_sehitoglu");
  const std::vector<Sym3> rows{residual_of(call)};
  const CriticalPlaneRow row = critical_planes(history, rows, {&material, 1}).front();
  call.answer["value"] = {plane_json(row.smith_watson_topper), plane_json(row.fatemi_socie),
                          plane_json(row.jiang_sehitoglu)};
}

void flaw(Call& call) {
  call.answer["value"] = number(critical_flaw(call.number("toughness"), call.number("sigma_1")));
}

void grade_of(Call& call) {
  const Steel& found = grade(call.text("name"));
  Json& out = call.answer["value"] = {{"name", found.name}, {"use", found.use}};
  for (const auto& [key, range] :
       {std::pair{"yield_strength", found.yield}, std::pair{"tensile_strength", found.tensile},
        std::pair{"hardness_HBW", found.hardness}})
    out[key] = range.known() ? Json::array({range.low, range.high}) : Json(nullptr);
}

}  // namespace

Functions damage_functions() {
  return {{"t_gamma", t_gamma_of},
          {"rcf_damage", rcf},
          {"brr_wear", wear_number},
          {"surface_fatigue_index", surface_fatigue},
          {"subsurface_fatigue_index", subsurface_fatigue},
          {"usfd_rate", wear_rate},
          {"usfd_depth", wear_depth},
          {"archard_depth", archard},
          {"dang_van", dang_van},
          {"critical_plane", critical_plane},
          {"critical_flaw", flaw},
          {"grade", grade_of}};
}

}  // namespace railstrata::bridge
