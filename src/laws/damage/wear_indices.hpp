#pragma once
// Indices of wear and rolling contact fatigue of a whole patch, from its forces and creepages.
#include <vector>

namespace railstrata {

/// Forces act on the wheel, creepages are the rigid slip of the wheel over the rail over V (docs/conventions.md): each
/// friction force is against its creepage. The moment is about the normal of the contact plane, in the sense of the
/// spin.
struct PatchCreep {
  double force_x = 0, force_y = 0;  ///< N
  double moment_z = 0;              ///< N m
  double creepage_x = 0, creepage_y = 0;
  double spin = 0;  ///< 1/m
};

/// J per m rolled, the same as N.
struct TGamma {
  double without_spin = 0;  ///< |F_x xi| + |F_y eta|: what the damage functions below were fitted with
  double with_spin = 0;     ///< |F_x xi| + |F_y eta| + |M_z phi|
  /// -(F_x xi + F_y eta + M_z phi): the energy that friction takes. Times V it is the sum of q·s over the patch, of
  /// steady rolling of bodies of one elasticity. Below with_spin where a term drives: with spin and little lateral
  /// creepage the lateral force may act along eta.
  double energy = 0;
};
TGamma t_gamma(const PatchCreep& patch);

/// Damage per axle passage over T-gamma, linear between break points; 1 is a crack of visible size. [Burstow2004]
struct DamagePoint {
  double t_gamma = 0;  ///< N
  double damage = 0;
};
struct RcfDamageFunction {
  std::vector<DamagePoint> points;  ///< T-gamma ascending; below the first its damage
  bool wear_removes = true;         ///< beyond the last point: on with the last slope (negative); else its damage
};

/// Break points 15, 65 and 175 N with 1e-5 at 65 N, negative beyond 175 N: R260 and its like. [Burstow2004]
RcfDamageFunction rcf_damage_15();
/// The same, 0 beyond 175 N.
RcfDamageFunction rcf_damage_15_clipped();
/// Break points 20, 65 and 175 N, 0 beyond: a variant in use.
RcfDamageFunction rcf_damage_20();

/// Throws CaseError unless there are two points or more, T-gamma ascends from 0 or more and all numbers are finite.
void check(const RcfDamageFunction& function);
double rcf_damage(const RcfDamageFunction& function, double t_gamma);

/// British Rail Research's wear number: area of the profile worn off per distance rolled, m²/m (1 mm²/km = 1e-9), from
/// T-gamma [N] and the wheel's diameter D [m]. In mm²/km with D in mm: 0.25 T/D below 100 N, 25/D to 200 N, (1.19 T -
/// 154)/D beyond. It jumps at 200 N from 25/D to 84/D, and is meant to. [PearceSherratt1991]
double brr_wear(double t_gamma, double wheel_diameter);

/// Ekberg, Kabo and Andersson's indices for an elliptic patch with semi-axes a, b [m], load F_z [N], mu the friction
/// force over the load. [EkbergKaboAndersson2002]
struct EllipticPatch {
  double a = 0, b = 0;  ///< m
  double load = 0;      ///< N, > 0
  double utilised_friction = 0;
};
/// FI_surf = mu - 2 pi a b k/(3 F_z) = mu - k/p0; k [Pa] the yield strength in cyclic shear. > 0: surface fatigue.
double surface_fatigue_index(const EllipticPatch& patch, double cyclic_shear_yield);
/// FI_sub = F_z (1 + mu²)/(4 pi a b) + c sigma_h, Pa; c Dang Van's constant, sigma_h [Pa] the hydrostatic residual
/// stress (compression < 0). Fatigue below the surface where it exceeds the limit of the wheel's steel. c has no
/// default: 0.3 to 0.4 for wheel steel.
double subsurface_fatigue_index(const EllipticPatch& patch, double dang_van_constant, double residual_hydrostatic);

}  // namespace railstrata
