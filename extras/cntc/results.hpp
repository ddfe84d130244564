#pragma once
// Results that the cntc_get… calls return, in the user's units and on the user's body. Those that need a solution throw
// Refused without one.
#include <array>
#include <vector>

#include "cntc/problem.hpp"
#include "core/vec.hpp"

namespace railstrata::cntc {

const Solved& solution(const Problem& problem);

/// On body 1, in the plane's axes about the point of forces, SI.
struct Resultant {
  Vec3 force, moment;
};
Resultant resultant(const Problem& problem);

struct Grid {
  int mx = 0, my = 0;
  double x = 0, y = 0, dx = 0, dy = 0;  ///< centre of the first element, sides
};
Grid grid_of(const Problem& problem);

/// fn, tx, ty, mz.
std::array<double, 4> forces(const Problem& problem);
/// vx, vy, phi.
std::array<double, 3> creepages(const Problem& problem);
double approach(const Problem& problem);
/// Contact, adhesion, slip.
std::array<double, 3> areas(const Problem& problem);
/// 0 exterior, 1 adhesion, 2 slip, in the order of the elements.
std::vector<int> division(const Problem& problem);
double largest_pressure(const Problem& problem);
double largest_traction(const Problem& problem);
/// Of both surfaces, which touch and are as warm.
double largest_temperature(const Problem& problem);
/// A field by CONTACT's number, in the order of the elements. Throws Refused for those that are not offered.
std::vector<double> field(const Problem& problem, int number);
/// A1, B1, AA, BB, RHO, CP, SCALE, BNEG, BPOS, AOB.
std::array<double, 10> hertz(const Problem& problem);
/// itask 1 kinematics, 2 materials, 3 friction.
std::vector<double> parameters(const Problem& problem, int task);

}  // namespace railstrata::cntc
