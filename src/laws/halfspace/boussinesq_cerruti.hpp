#pragma once
// Surface displacements under tractions spread evenly over a rectangle.
//
// One body: depth z' points into it, p presses it (along z'), q = (q_x, q_y) acts on it. Any transversely
// isotropic-in-plan half-space (homogeneous or layered) has four scalar compliances of the wave number k = |k| [1/m];
// with k^ = k/|k| and for tractions ~ exp(i k·x)
//   u_z' = zz(k)/k p  - i (k^·q) rz(k)/k            (u_z' positive into the body)
//   u    = i k^ rz(k)/k p + k^ (k^·q) rr(k)/k + (q - k^ (k^·q)) tt(k)/k.
// Homogeneous: zz = rr = (1 - nu)/G, rz = (1 - 2 nu)/(2G), tt = 1/G: Boussinesq's and Cerruti's solutions. [Johnson1985
// sec. 3.2, 3.6; Love1929] Layered: sums of exp(-k d): "images" at depths d, see layered.hpp. Each image has a closed
// rectangle integral, so there is no periodic grid and no truncation.
#include <vector>

#include "halfspace/hertz.hpp"

namespace railstrata {

/// The four compliances at one wave number (times k), 1/Pa.
struct CompliancePoint {
  double zz = 0, rz = 0, rr = 0, tt = 0;
};

/// One term c exp(-k depth).
struct ComplianceImage {
  double depth = 0;  ///< m
  CompliancePoint c;
};
using SurfaceCompliance = std::vector<ComplianceImage>;

/// A homogeneous half-space: one image at depth 0.
SurfaceCompliance homogeneous_compliance(const HalfSpaceMaterial& material);

/// Two bodies pressed together. p >= 0 presses both, q acts on the rail and -q on the wheel; then
///   normal elastic displacement   u_n = u_z'(rail) + u_z'(wheel) = nn p + nx q_x + ny q_y,
///   rail minus wheel              u_x = xx q_x + xy q_y + xn p,   u_y = yx q_x + yy q_y + yn p,
/// where the coupling rz is the rail's minus the wheel's: it vanishes for equal bodies.
SurfaceCompliance combined_compliance(const SurfaceCompliance& wheel, const SurfaceCompliance& rail);

/// Displacement at an offset from the centre of a rectangle under unit traction, m/Pa. Symmetric: yx = xy;
/// antisymmetric: xn = -nx, yn = -ny.
struct RectangleInfluence {
  double nn = 0, xx = 0, xy = 0, yy = 0;
  double nx = 0, ny = 0;  ///< of u_n, by q_x and q_y
};
RectangleInfluence rectangle_influence(const SurfaceCompliance& compliance, double x, double y, double dx, double dy);

/// The same for offsets (i dx, j dy), i = 0 … nx-1, j = 0 … ny-1 (index j + ny i); other signs follow from the
/// symmetries nn, xx, yy even in x and y, xy odd in both, nx odd in x, ny odd in y. Shares the corners between
/// neighbours: about four times cheaper than rectangle_influence in a loop.
std::vector<RectangleInfluence> rectangle_influence_table(const SurfaceCompliance& compliance, int nx, int ny,
                                                          double dx, double dy);

}  // namespace railstrata
