#pragma once
// Two half-spaces pressed together with a gap A x² + B y²: the setting of most tests here.
#include <algorithm>
#include <cmath>

#include "bem/normal_problem.hpp"
#include "bem/tangential_problem.hpp"
#include "halfspace/hertz.hpp"

namespace railstrata {

inline const HalfSpaceMaterial kSteel{210e9, 0.3};

inline SurfaceCompliance pair_of(const HalfSpaceMaterial& wheel, const HalfSpaceMaterial& rail) {
  return combined_compliance(homogeneous_compliance(wheel), homogeneous_compliance(rail));
}

inline Plane quadratic_gap(const PatchGrid& g, double A, double B) {
  Plane gap(g.size());
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) gap[g.index(i, j)] = A * g.x(i) * g.x(i) + B * g.y(j) * g.y(j);
  return gap;
}

inline double peak(const Plane& v) { return *std::max_element(v.begin(), v.end()); }

/// Grid with a cell centre at the origin around an ellipse, one ring of spare cells.
inline PatchGrid grid_around(double a, double b, double dx, double dy) {
  return centred_grid(static_cast<int>(a / dx) + 1, static_cast<int>(b / dy) + 1, dx, dy);
}

/// A solved normal problem of the reference cases: 84954.6 N, steel on steel.
struct ReferenceContact {
  static constexpr double kLoad = 84954.6, kFriction = 0.5;
  HertzContact hertz;
  PatchGrid grid;
  InfluenceOperator influence;
  NormalSolution normal;
  ReferenceContact(double A, double B, double dx)
      : hertz(hertz_contact(A, B, contact_modulus(kSteel, kSteel), kLoad)),
        grid(grid_around(hertz.a, hertz.b, dx, dx)),
        influence(pair_of(kSteel, kSteel), grid.nx, grid.ny, dx, dx),
        normal(solve_normal(influence, grid, quadratic_gap(grid, A, B), {.load = kLoad, .approach = {}})) {}
  TangentialProblem rolling() const {
    TangentialProblem p;
    p.traction_bound = normal.pressure;
    for (double& g : p.traction_bound) g *= kFriction;
    return p;
  }
};

/// From rest under no traction, `steps` cells of rolling later.
inline TangentialSolution rolled_from_rest(const InfluenceOperator& influence, const PatchGrid& grid,
                                           TangentialProblem problem, int steps) {
  TangentialSolution s;
  s.q_x.assign(grid.size(), 0.0);
  s.q_y = s.q_x;
  for (int step = 0; step < steps; ++step) {
    roll_on_one_cell(influence, grid, s, problem);
    s = solve_tangential(influence, grid, problem);
  }
  return s;
}

inline double largest_traction(const TangentialSolution& s) {
  double q = 0;
  for (std::size_t i = 0; i < s.q_x.size(); ++i) q = std::max(q, std::hypot(s.q_x[i], s.q_y[i]));
  return q;
}

}  // namespace railstrata
