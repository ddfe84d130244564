#pragma once
// Settings of the cntc_set calls, in the user's units. Each throws Refused, and then changes nothing, for a value that
// is not supported; a returned text is a remark.
#include <span>
#include <string>

#include "cntc/problem.hpp"

namespace railstrata::cntc {

using Numbers = std::span<const double>;

/// H = 0, 1 (as before) and 3, temperatures of steady rolling.
void set_heat(Problem& problem, int digit, Numbers values);
/// M = 0; viscoelastic bodies, 1; with an elastic or elastic-plastic film, 4; simplified theory, 3 and 5.
void set_materials(Problem& problem, int digit, Numbers values);
/// Layers on body 1 or 2, from the surface down.
void set_layers(Problem& problem, int body, int count, Numbers thickness, Numbers young, Numbers poisson);
/// L = 0 (the smaller of fstat and fkin), and the laws of friction/: 3 and 4 with one term, 5, 6.
std::string set_friction(Problem& problem, int method, Numbers values);
/// IPOTCN -1 to -3 and 1 to 4.
void set_hertz(Problem& problem, int number, Numbers values);
void set_potential_contact(Problem& problem, int number, Numbers values);
/// IBASE 1, 2, 3, 9.
void set_gap(Problem& problem, int number, Numbers values);
void set_load(Problem& problem, double force);
void set_approach(Problem& problem, double approach);
void set_creepages(Problem& problem, double x, double y, double spin);
void set_extra_slip(Problem& problem, Numbers x, Numbers y);
/// On body 1, over FSTAT FN. What friction cannot carry is refused by the solution.
void set_forces(Problem& problem, double x, double y);
void set_speed(Problem& problem, double speed);
void set_rolling_step(Problem& problem, double chi, double step);
void set_solver(Problem& problem, int digit, std::span<const int> ints, Numbers reals);

}  // namespace railstrata::cntc
