#pragma once
// Vehicle, drive and friction of a case, in SI units.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "friction/falling_friction.hpp"
#include "friction/friction_table.hpp"

namespace railstrata {

/// Acceleration of gravity, m/s²: of every load that is given as a mass.
inline constexpr double kGravity = 9.81;

struct VehicleSpec {
  double wheel_mass = 660.0, sprung_mass = 8000.0;
  double suspension_stiffness = 0.95e6, suspension_damping = 10.4e3;
  std::optional<double> approach;  ///< m, of the bodies along the contact normal: then the load is a result
  bool couple_sprung_mass = true;  ///< the sprung mass rides along with the axle in x (else it only moves vertically
                                   ///< and does not add inertia to it)
  /// N, of the wheel on the rail at rest, G = (wheel_mass + sprung_mass) kGravity.
  double load() const { return (wheel_mass + sprung_mass) * kGravity; }
  /// N, by the sprung mass that makes it; instead of an approach.
  void set_load(double force) {
    sprung_mass = force / kGravity - wheel_mass;
    approach.reset();
  }
};

/// What the creepages of a case are of.
enum class CreepageOf {
  contact,  ///< the contact that touches first, in its plane
  wheel     ///< the wheel: longitudinal of its tape circle, lateral of the wheel sideways, level
};

/// Each direction is driven by a force or by a creepage. Forces act on the wheel, creepages are rigid slips of the
/// wheel over the rail divided by the speed; lateral ones lie in the contact plane.
struct DriveSpec {
  double speed = 27.78;
  double traction_coefficient = 0.2;                                     ///< F_T / G, unless a creepage is given
  std::optional<double> creepage;                                        ///< longitudinal: negative drives
  std::optional<double> lateral_creepage, lateral_traction_coefficient;  ///< at most one; neither: no lateral creepage
  std::optional<double> spin;                                            ///< 1/m; if not given, of the geometry
  CreepageOf creepage_of = CreepageOf::contact;
  double friction_coefficient = 0.5;
  double torque_ramp = 4e-3;  ///< s, smooth rise of the torque; a shorter one overshoots the wanted traction
  double rolling_share = 1;   ///< V over the speed that creepages are of: of rows that roll on their own radii; no key
  double creepage_start = 0.0;  ///< longitudinal creepage at the start, (V - omega r)/V: negative drives
  /// The longitudinal force on the wheel over the load G, if it is given.
  std::optional<double> traction() const {
    return creepage ? std::optional<double>() : std::optional<double>(traction_coefficient);
  }
};

inline std::array<double*, 2> columns(TablePoint& p) { return {&p.at, &p.value}; }

/// Friction at rest is drive.friction_coefficient.
struct FrictionSpec {
  std::string condition = {};                      ///< a set of friction_conditions.hpp; empty: none
  std::vector<TablePoint> lateral_table = {};      ///< coefficient at rest over y [m] of the rail's profile
  std::optional<double> lateral_coefficient = {};  ///< across rolling; none: as along
  std::vector<TablePoint> temperature_table = {};  ///< factor of the coefficient over temperature [K]
  std::optional<double> rail_temperature = {},
                        wheel_temperature = {};  ///< K, as they come into the contact; zero as the table's
  FrictionForm law = FrictionForm::coulomb;
  std::optional<double> kinetic_coefficient;  ///< limit of fast slip; with a falling law
  std::optional<double> half_velocity;        ///< m/s, where half of the fall is done; with a falling law
  double memory_distance = 0;                 ///< m, slid until the coefficient has followed; 0: at once
  double memory_velocity = 1e-3;              ///< m/s, at least, by which it follows: at rest too
};

/// A layer of wear debris, sand, … between wheel and rail; none without a thickness.
struct ThirdBodySpec {
  std::optional<double> thickness, shear_modulus;
  std::optional<double> yield_shear;               ///< Pa; none: elastic
  double hardening = 0;                            ///< Pa/m, by plastic shear; < 0: it softens
  std::optional<double> residual_shear;            ///< Pa, what softening leaves
  double yield_by_pressure = 0;                    ///< rise of yield_shear by the pressure
  double modulus_by_pressure = 0;                  ///< the same of shear_modulus
  std::vector<TablePoint> temperature_table = {};  ///< factor of both over temperature [K]
};

}  // namespace railstrata
