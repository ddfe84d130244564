#pragma once
// Creepages and spin of a contact in units of what its own creep stiffness and friction make of them.
//
//   rho = sqrt(k_x k_y) |v| / (3 f N),   psi = k_s phi / (f N)                                  [Kalker1990 ch. 2]
//
// with friction f, load N, creepages v = (v_x, v_y), spin phi (1/m), and k_x = |dF_x/dv_x|, k_y = |dF_y/dv_y|, k_s =
// |dF_y/dphi| about no creepage: G c² C11, G c² C22 and G c³ C23 on Hertz's ellipse, where c³ grows as N. There F/(f N)
// depends on these and the angle of v alone for any load, friction and modulus; of profiles and layers little is left
// to other axes.
//
// A place has three numbers: the angle of v, opposite to which a sliding patch pulls; arsinh(psi); and the size
// rho / sqrt(c² + rho²) with c = 1.25, even where the patch begins to slide and dense far from there, where the force
// follows the direction alone.
#include <array>
#include <string_view>

namespace railstrata {

/// What one creepage and one unit of spin are in rho and psi.
struct CreepUnits {
  double plane = 0, spin = 0;
};

/// Stiffnesses k_x / N^(2/3), k_y / N^(2/3), k_s / N: the same for every load on Hertz's ellipse.
using CreepStiffness = std::array<double, 3>;
CreepUnits creep_units(const CreepStiffness& stiffness, double load, double friction);

/// v_x, v_y and phi.
using Creepages = std::array<double, 3>;

struct ScaledPlace {
  double angle = 0;  ///< [-pi, pi]
  double spin = 0;   ///< arsinh(psi)
  double size = 0;   ///< [0, 1)
};
ScaledPlace scaled_place(const Creepages& creepages, const CreepUnits& units);
Creepages creepages_at(const ScaledPlace& place, const CreepUnits& units);

/// r² = rho² + psi²
double creep_radius(const ScaledPlace& place);

/// What a number of creep tables, by its name, grows with on Hertz's ellipse: a product of powers of friction, load (N)
/// and r. 1 of a number that is not known.
double growth_of(std::string_view number, double friction, double load, double radius);

}  // namespace railstrata
