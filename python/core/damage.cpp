// Indices of src/damage for numbers of the user's own.
#include <array>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "damage/brittle.hpp"
#include "damage/critical_plane.hpp"
#include "damage/dang_van.hpp"
#include "damage/grades.hpp"
#include "damage/wear.hpp"
#include "damage/wear_indices.hpp"
#include "python/core/bind.hpp"

namespace railstrata::python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Six = std::array<double, 6>;

Sym3 tensor(const double* s) { return {s[0], s[1], s[2], s[3], s[4], s[5]}; }

/// (n, 6) stresses of a point over the cycle.
std::vector<Sym3> cycle_of(const Numbers& stresses) {
  if (stresses.ndim() != 2 || stresses.shape(0) < 1 || stresses.shape(1) != 6)
    throw py::value_error("cycle: an array of shape (samples, 6) is wanted, components xx, yy, zz, xy, yz, xz");
  std::vector<Sym3> out;
  for (py::ssize_t k = 0; k < stresses.shape(0); ++k) out.push_back(tensor(stresses.data() + 6 * k));
  return out;
}

py::tuple t_gamma_of(double force_x, double force_y, double creepage_x, double creepage_y, double moment, double spin) {
  const TGamma t = t_gamma({force_x, force_y, moment, creepage_x, creepage_y, spin});
  return py::make_tuple(t.without_spin, t.with_spin, t.energy);
}

double rcf(double t, const std::vector<std::pair<double, double>>& points, bool wear_removes) {
  RcfDamageFunction function;
  function.wear_removes = wear_removes;
  for (const auto& [at, damage] : points) function.points.push_back({at, damage});
  check(function);
  return rcf_damage(function, t);
}

py::tuple rcf_preset(const std::string& name) {
  const RcfDamageFunction function = name == "15"           ? rcf_damage_15()
                                     : name == "15 clipped" ? rcf_damage_15_clipped()
                                     : name == "20"         ? rcf_damage_20()
                                                            : throw py::value_error(
                                                                  "function: \"15\", \"15 clipped\", "
                                                                          "\"20\", or break points");
  py::list points;
  for (const DamagePoint& point : function.points) points.append(py::make_tuple(point.t_gamma, point.damage));
  return py::make_tuple(points, function.wear_removes);
}

/// The arrays of a row, of one length.
class Row {
 public:
  Row(Numbers p, Numbers q_x, Numbers q_y, Numbers slip_x, Numbers slip_y, double dx, double speed)
      : all_{std::move(p), std::move(q_x), std::move(q_y), std::move(slip_x), std::move(slip_y)}, dx_(dx), v_(speed) {
    for (const Numbers& numbers : all_)
      if (numbers.ndim() != 1 || numbers.size() != all_[0].size())
        throw py::value_error("the arrays of a row have one length");
    if (!(dx > 0) || !(speed > 0)) throw py::value_error("dx and speed: positive numbers are wanted");
  }
  Streamline line() const { return {of(0), of(1), of(2), of(3), of(4), dx_, v_}; }

 private:
  std::span<const double> of(std::size_t k) const { return {all_[k].data(), static_cast<std::size_t>(all_[k].size())}; }
  std::array<Numbers, 5> all_;
  double dx_, v_;
};

py::tuple dang_van_of(const Numbers& stresses, double c, const Six& residual) {
  const DangVanStress found = dang_van_stress(cycle_of(stresses), tensor(residual.data()), c);
  return py::make_tuple(found.stress, found.amplitude, found.hydrostatic, found.sample);
}

py::object plane_tuple(const std::optional<CriticalPlane>& found) {
  if (!found) return py::none();
  const Vec3 n = found->normal;
  return py::make_tuple(found->value, py::make_tuple(n.x, n.y, n.z), found->cycle.normal_max,
                        found->cycle.normal_strain_range, found->cycle.shear_range);
}

/// The three parameters of one point.
py::tuple critical_plane_of(const Numbers& stresses, double young, double poisson,
                            const std::optional<std::pair<double, double>>& fatemi_socie,
                            const std::optional<double>& jiang_sehitoglu, const Six& residual) {
  StressHistory history;
  history.stress = cycle_of(stresses);
  for (std::size_t k = 0; k < history.stress.size(); ++k) history.x.push_back(static_cast<double>(k));
  history.y = {0};
  history.depth = {0};
  history.zone = {0};
  CriticalPlaneMaterial material{young, poisson, std::nullopt, jiang_sehitoglu};
  if (fatemi_socie) material.fatemi_socie = FatemiSocieConstants{fatemi_socie->first, fatemi_socie->second};
  const std::vector<Sym3> rows{tensor(residual.data())};
  const CriticalPlaneRow row = critical_planes(history, rows, {&material, 1}).front();
  return py::make_tuple(plane_tuple(row.smith_watson_topper), plane_tuple(row.fatemi_socie),
                        plane_tuple(row.jiang_sehitoglu));
}

py::dict grade_of(const std::string& name) {
  const Grade& found = grade(name);
  py::dict out;
  out["name"] = std::string(found.name);
  out["use"] = std::string(found.use);
  for (const auto& [key, number] :
       {std::pair{"yield_strength", found.yield}, std::pair{"tensile_strength", found.tensile},
        std::pair{"hardness_HBW", found.hardness}})
    out[key] = number.known() ? py::object(py::make_tuple(number.low, number.high)) : py::object(py::none());
  return out;
}

void bind_rows(py::module_& m) {
  m.def("usfd_rate", &usfd_rate);
  m.def("usfd_depth", [](const Numbers& q_x, const Numbers& q_y, const Numbers& slip_x, const Numbers& slip_y,
                         double dx, double speed, double density) {
    return usfd_depth(Row(q_x, q_x, q_y, slip_x, slip_y, dx, speed).line(), density);
  });
  m.def("archard_depth", [](const Numbers& p, const Numbers& slip_x, const Numbers& slip_y, double dx, double speed,
                            double hardness, double scale) {
    return archard_depth(Row(p, p, p, slip_x, slip_y, dx, speed).line(), laboratory_dry_archard(), hardness, scale);
  });
}

}  // namespace

void bind_damage(py::module_& module) {
  py::module_ m = module.def_submodule("damage");
  m.def("t_gamma", &t_gamma_of);
  m.def("rcf_damage", &rcf);
  m.def("rcf_preset", &rcf_preset);
  m.def("brr_wear", &brr_wear);
  m.def("surface_fatigue_index", [](double a, double b, double load, double utilised_friction, double k) {
    return surface_fatigue_index({a, b, load, utilised_friction}, k);
  });
  m.def("subsurface_fatigue_index", [](double a, double b, double load, double utilised_friction, double c, double s) {
    return subsurface_fatigue_index({a, b, load, utilised_friction}, c, s);
  });
  bind_rows(m);
  m.def("dang_van", &dang_van_of);
  m.def("critical_plane", &critical_plane_of);
  m.def("critical_flaw", &critical_flaw);
  m.def("grade", &grade_of);
}

}  // namespace railstrata::python
