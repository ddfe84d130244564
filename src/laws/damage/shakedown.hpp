#pragma once
// Shakedown of a section under repeated rolling: by how much the elastic stress of a case may be multiplied until
// somewhere (1) the material yields at all, (2) it yields in every passage for ever.
//
// J2 plasticity without hardening, shear strength k. Melan [Melan1938]: there is no yielding in the long run if some
// residual stress rho that is in equilibrium with itself exists with |u(sigma) + u(rho)| <= k at every instant
// (u: damage/deviator.hpp). Under rolling rho is a function of y and depth alone. What rho may be decides the level:
//
//   wandering  rho = sigma_x(z), sigma_y(z): in equilibrium whatever they are. One ball for each depth, over all x *and
//              all y*, its centre free in u1, u2. Safe (a lower bound) for every traffic, and the limit itself where
//              the wheels' lateral positions scatter over more than the width of the patch: the mean of the residual
//              stress over such a band is of this kind. Print this one first.
//   upper      one ball for each point over x, its centre free in all five, at the free surface (depth 0) in u1, u2,
//              u4, because rho has no tractions there. No load above can shake down; not every one below will.
//   kinematic  one ball for each point, free in all five, the surface too: the limit with unlimited linear kinematic
//              hardening, whose back stress need not be in equilibrium.
//
// single_track/single_track.hpp has the level between the first two. For a line contact (one column) `wandering` is the
// exact limit. The residual stress of a process (cladding, heat treatment) is one more rho: it moves no limit of these,
// but first yield. [PonterHearleJohnson1985, Johnson1985 sec. 9.2]
#include <limits>
#include <vector>

#include "damage/stress_history.hpp"

namespace railstrata {

struct ShakedownInput {
  const StressHistory& elastic;
  /// Pa, in shear (yield stress in tension / sqrt 3), per row. NaN or infinite: what stays elastic and does not count.
  std::vector<double> shear_strength;
  /// Pa, stress of the process along x and y, per row; empty: none.
  std::vector<double> residual_x, residual_y;
};

/// A factor and the place that decides it.
struct LoadFactor {
  double value = std::numeric_limits<double>::infinity();  ///< what the elastic stress may be multiplied by
  double y = 0, depth = 0;  ///< m; of a ball the point among those that hold it that carries the most
  int zone = 0;
};

/// The four factors of one zone (layer) alone, the others taken for elastic.
struct ZoneFactors {
  int zone = 0;
  LoadFactor first_yield, wandering, upper, kinematic;
};

/// Pa, per row: the shear strength that the load as it is asks for at this depth. Rows without a strength too.
struct RequiredStrength {
  std::vector<double> first_yield, wandering, upper, kinematic;
};

struct Shakedown {
  LoadFactor first_yield;  ///< with the process's stress; 0 where that alone yields already
  LoadFactor wandering, upper, kinematic;
  std::vector<ZoneFactors> zones;  ///< as in the history, from the surface down, each once
  RequiredStrength required;
  /// Pa, per point [row * columns + column]: required shear strength for the upper bound.
  std::vector<double> pointwise;
};

/// All at once, in some milliseconds for a thousand points; parallel over rows, the same bits for any number of
/// threads. Errors: a strength that is not positive, vectors of other lengths than the history's (std::
/// invalid_argument); a stress that is no number (NumericalError). Errors of the samples are the caller's: a ball
/// misses what happens between them, by the square of their distance where the path is smooth.
Shakedown shakedown(const ShakedownInput& input);

}  // namespace railstrata
