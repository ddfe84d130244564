#pragma once
// The temperature of the contact, cell by cell, for friction and films that depend on it.
//
//   T = T_0 + flash temperature,   T_0 = (e_r T_r + e_w T_w)/(e_r + e_w)
// T_0: of two half-spaces of the effusivities e that come together at the temperatures T_r and T_w, the same from the
// edge on. [CarslawJaeger1959 ch. 2.9] Flash temperature: of the heat that each particle has had on its way through the
// patch (damage/flash_temperature.hpp, with its layers and its range). Temperatures in K from the user's own zero.
#include <vector>

#include "bem/patch_grid.hpp"
#include "bem/plane_algebra.hpp"
#include "bem/tangential_problem.hpp"
#include "damage/flash_temperature.hpp"
#include "friction/friction_table.hpp"

namespace railstrata {

struct ContactHeat {
  ThermalBody rail, wheel;
  double rail_temperature = 0, wheel_temperature = 0;
  std::vector<TablePoint> friction, film;  ///< factors over temperature; empty: 1

  double before_sliding() const;  ///< T_0
};

/// Friction power per area in each cell [W/m²], at least 0.
Plane friction_flux(const TangentialSolution& s, double speed);

/// T of each cell, of the middle of its step of `step` [m], with the flux that friction of this T makes at the same
/// slip. flux: W/m², under friction of the temperature `made_at` [K], which is not yet that of the flux. `before`: flux
/// of the same particles one step earlier, two steps, …; steady rolling has none, its rows are the particles' way.
Plane contact_temperature(const ContactHeat& heat, const PatchGrid& grid, const Plane& flux, const Plane& made_at,
                          const std::vector<Plane>& before, bool steady, double step, double speed);

}  // namespace railstrata
