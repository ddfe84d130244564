#pragma once
// Displacements, strains and stresses inside a half-space under tractions on its surface.
//
// Depth z points into the body (for the rail: down), p presses it along z, q acts on it. The state at a depth is what
// is continuous across bonded interfaces: the strains in plan and the tractions on the plane z = const. The stresses
// follow with the material of whichever side is asked for.
#include <array>
#include <vector>

#include "core/vec.hpp"
#include "halfspace/hertz.hpp"

namespace railstrata {

/// Strains in plan and tractions on z = const [Pa], axes x, y, z into the body; tension positive.
struct InteriorState {
  double e_xx = 0, e_yy = 0, e_xy = 0;
  double s_xz = 0, s_yz = 0, s_zz = 0;
};

/// All six stresses of a material in that state: sigma_ab = 2 G (e_ab + nu/(1 - nu) e_cc delta_ab) + nu/(1 - nu) s_zz
/// delta_ab.
Sym3 stress_of(const InteriorState& state, const HalfSpaceMaterial& material);

/// State at a point, offset from the centre of a rectangle dx x dy under unit p, unit q_x, unit q_y (index 0, 1, 2), of
/// a homogeneous half-space: Boussinesq's and Cerruti's solutions integrated in closed form. z >= 0; on the surface not
/// on the rectangle's edges. [Love1929, Johnson1985 sec. 3.2]
using InteriorInfluence = std::array<InteriorState, 3>;
InteriorInfluence rectangle_interior(const HalfSpaceMaterial& material, double x, double y, double z, double dx,
                                     double dy);

/// Table for offsets (i dx, j dy), indexed as in rectangle_influence_table.
std::vector<InteriorInfluence> rectangle_interior_table(const HalfSpaceMaterial& material, double z, int nx, int ny,
                                                        double dx, double dy);

/// Displacement [m/Pa], z into the body, in the same setting; z >= 0. On the surface it is that of rectangle_influence.
using InteriorDisplacement = std::array<Vec3, 3>;
InteriorDisplacement rectangle_displacement(const HalfSpaceMaterial& material, double x, double y, double z, double dx,
                                            double dy);
std::vector<InteriorDisplacement> rectangle_displacement_table(const HalfSpaceMaterial& material, double z, int nx,
                                                               int ny, double dx, double dy);

}  // namespace railstrata
