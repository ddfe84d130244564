#pragma once
// Quadrature of a straight crack's integral equation.
//
// The jump g of displacement across a crack of length c is that of dislocations with density B = -dg/dr, r along the
// crack, whose tractions are
//   T(r) = integral of [C/(r - r') + K(r, r')] B(r') dr',
// K that of the surface's image: smooth but near a mouth, where it is nearly singular too.
// At a tip B is singular as 1/sqrt(distance); at a mouth on the free surface it is finite. Both rules integrate such
// densities times polynomials exactly, also with Cauchy's kernel at their collocation points:
// - mouth: with r/c = 1 - w² the crack is the half 0 < w < 1 of Gauss and Legendre's rule of 2n points, collocated
//   at the zeros of Legendre's function Q_2n of the second kind; images by panels that halve towards the mouth;
// - inside: Gauss and Chebyshev's, with a closed jump. [HillsKellyDaiKorsunsky1996]
#include <Eigen/Core>

#include "crack/crack_line.hpp"

namespace railstrata {

/// Places as shares of the length, from the crack's start (its mouth); the end is a tip.
struct CrackRule {
  Eigen::VectorXd node;           ///< integral of B F dr = c Σ weight φ(node) F(node), φ the density's regular part
  Eigen::VectorXd point;          ///< of collocation, where tractions are met
  Eigen::MatrixXd density;        ///< weight φ at the nodes from g/c at the points
  Eigen::VectorXd image_node;     ///< where images are summed
  Eigen::MatrixXd image_density;  ///< weight φ there from g/c at the points
  Eigen::RowVectorXd end;         ///< φ at the tip, from g/c: g = φ sqrt(c d) at the distance d before it
  Eigen::RowVectorXd start;       ///< the same at the start of a crack inside; empty: a mouth
};

/// n >= 4 points (inside: n - 1). Rules are kept: one of each size.
const CrackRule& crack_rule(CrackKind kind, int n);

}  // namespace railstrata
