#pragma once
// Strength of a case's materials. Nothing of it enters a contact solution: shakedown, fatigue, wear and
// heat are computed from what is given, and what would need more is left out.
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace railstrata {

/// A strength or a hardness at a depth; linear between two of them.
struct DepthPoint {
  double depth = 0, value = 0;
  friend bool operator==(const DepthPoint&, const DepthPoint&) = default;
};

/// Residual stress of the process at a depth, tension positive; linear between two of them.
struct StressPoint {
  double depth = 0, longitudinal = 0, lateral = 0;
  friend bool operator==(const StressPoint&, const StressPoint&) = default;
};

/// Voce's isotropic hardening, Q (1 - exp(-b p)), and a backstress of Armstrong and Frederick (material/plastic.hpp).
struct IsotropicHardening {
  double saturation = 0, rate = 0;  ///< Q [Pa], b
  friend bool operator==(const IsotropicHardening&, const IsotropicHardening&) = default;
};
struct KinematicHardening {
  double modulus = 0, recall = 0;  ///< C [Pa], gamma
  friend bool operator==(const KinematicHardening&, const KinematicHardening&) = default;
};

/// The numbers of a row, in the order in which a case file writes them.
inline std::array<double*, 2> columns(DepthPoint& p) { return {&p.depth, &p.value}; }
inline std::array<double*, 3> columns(StressPoint& p) { return {&p.depth, &p.longitudinal, &p.lateral}; }
inline std::array<double*, 2> columns(IsotropicHardening& h) { return {&h.saturation, &h.rate}; }
inline std::array<double*, 2> columns(KinematicHardening& h) { return {&h.modulus, &h.recall}; }

/// The word of StrengthSpec::hardening for a set from the tensile strength.
inline constexpr std::string_view kEstimatedHardening = "estimated";

/// Constants of the fatigue criteria; what is not given leaves its criterion out.
struct FatigueSpec {
  std::optional<double> limit;            ///< Pa, of Dang Van: in alternating shear
  std::optional<double> exponent;         ///< k of N = cycles (limit/stress)^k
  double cycles = 1e6;                    ///< that the limit bears
  std::optional<double> dang_van;         ///< weight of the hydrostatic stress
  std::optional<double> fatemi_socie;     ///< k of the term k sigma_n / yield strength
  std::optional<double> jiang_sehitoglu;  ///< J
  // Of the strain-life curve (damage/strain_life.hpp): all four or none.
  std::optional<double> strength_coefficient;   ///< s_f, Pa
  std::optional<double> strength_exponent;      ///< b, negative
  std::optional<double> ductility_coefficient;  ///< e_f
  std::optional<double> ductility_exponent;     ///< c, negative
};

struct BondSpec {
  std::optional<double> tension, shear;  ///< Pa
};

struct HeatSpec {
  double conductivity = 50;                    ///< W/(m K)
  double capacity = 460;                       ///< J/(kg K)
  std::optional<double> austenitisation_rise;  ///< K, from the surface before the wheel to austenite
};

/// Depths of a layer's tables count from its top, those of rail and wheel from the running surface.
struct StrengthSpec {
  std::string grade;                     ///< a name of material/steels.hpp; it gives what is not given otherwise
  std::optional<double> yield_strength;  ///< Pa, uniaxial; that in pure shear is a sqrt(3)-th of it
  std::vector<DepthPoint> strength_table;
  std::string hardening;  ///< a name of material/steels.hpp, or "estimated": of the tensile strength
  std::optional<IsotropicHardening> isotropic_hardening;
  std::vector<KinematicHardening> kinematic_hardening;
  int recall_power = 0;            ///< m of Ohno and Wang; 0: Armstrong and Frederick
  bool elastic = false;            ///< on purpose, whatever its strength: a brittle layer
  double yield_to_tensile = 0.55;  ///< of a strength that is estimated from hardness
  std::optional<double> hardness;  ///< HV
  std::vector<DepthPoint> hardness_table;
  std::vector<double> initial_stress;             ///< Pa, longitudinal and lateral; empty: none
  std::vector<StressPoint> initial_stress_table;  ///< instead
  std::optional<double> tensile_strength;         ///< Pa
  std::optional<double> fracture_toughness;       ///< Pa √m, K_Ic
  FatigueSpec fatigue;
  std::optional<double> wear_coefficient;  ///< Archard's k, volume = k force distance / hardness
  std::optional<double> wear_factor;       ///< over the steel of the wear law's tests (fatigue/steel_wear.hpp)
  BondSpec bond;                           ///< of a layer's lower interface
  HeatSpec heat;
};

}  // namespace railstrata
