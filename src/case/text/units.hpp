#pragma once
// Quantities as people write them: "210 GPa", "0.2 mm", "100 km/h", "10.4 kN s/m", "7800 kg/m³", "1:40", "20 %",
// "15 MPa √m", "380 HV".
//
// A text is a decimal number and a unit: symbols with SI prefixes, multiplied by a blank, * or ·, at most one / before
// the last symbol or a bracket, powers as ^3 or ³. Its value is rounded once: "0.2 mm" is exactly the double 0.2e-3.
#include <array>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace railstrata {

/// Exponents of kilogram, metre, second, plane angle, kelvin, square root of a metre, hardness number and decibel. All
/// zero: a plain number.
struct Dimension {
  std::array<int, 8> exponents{};
  friend bool operator==(const Dimension&, const Dimension&) = default;
};

namespace dimension {
inline constexpr Dimension kNumber{};
inline constexpr Dimension kLength{0, 1, 0, 0}, kMass{1, 0, 0, 0}, kTime{0, 0, 1, 0};
inline constexpr Dimension kSpeed{0, 1, -1, 0}, kRate{0, 0, -1, 0};
inline constexpr Dimension kPressure{1, -1, -2, 0}, kDensity{1, -3, 0, 0};
inline constexpr Dimension kStiffness{1, 0, -2, 0}, kDamping{1, 0, -1, 0};
inline constexpr Dimension kForce{1, 1, -2, 0};
inline constexpr Dimension kPressureGradient{1, -2, -2, 0};
inline constexpr Dimension kSpin{0, -1, 0, 0};              ///< rotation over rolled distance; "rad/m" is "1/m"
inline constexpr Dimension kToughness{1, -1, -2, 0, 0, 1};  ///< "15 MPa √m"
inline constexpr Dimension kConductivity{1, 1, -3, 0, -1}, kHeatCapacity{0, 2, -2, 0, -1}, kTemperature{0, 0, 0, 0, 1};
/// Vickers hardness, in HV; "300 HBW" is 300 / 0.95 HV, good to 5 % up to 450 HV. [ISO18265]
inline constexpr Dimension kHardness{0, 0, 0, 0, 0, 0, 1};
/// Of a roughness over 1 µm, in dB. [EN15610]
inline constexpr Dimension kLevel{0, 0, 0, 0, 0, 0, 0, 1};
/// Displacement, velocity and acceleration over force.
inline constexpr Dimension kReceptance{-1, 0, 2, 0}, kMobility{-1, 0, 1, 0}, kAccelerance{-1, 0, 0, 0};
inline constexpr Dimension kRotation{0, 0, -1, 1};  ///< of a spindle
/// An inclination, kept as its tangent; written "1:40", "1/40", "25 mrad", "1.4 deg" or as the bare tangent.
inline constexpr Dimension kSlope{0, 0, 0, 1};
/// A direction, kept in rad; written "25 deg" or "0.4 rad".
inline constexpr Dimension kAngle{0, 0, 0, 2};
}  // namespace dimension

/// A fault of the text of a quantity, and what to write instead.
struct UnitError : std::runtime_error {
  UnitError(const std::string& rule, std::string remedy_) : std::runtime_error(rule), remedy(std::move(remedy_)) {}
  std::string remedy;
};

/// Value in SI units. Throws UnitError: no number, no unit, unknown unit, another dimension than `expected`.
double parse_quantity(std::string_view text, const Dimension& expected);

/// The shortest text in the customary unit of the dimension (mm, GPa, m/s, …) that parse_quantity reads back to the
/// very same double.
std::string format_quantity(double value, const Dimension& dimension);

/// "a length, e.g. \"0.2 mm\"": for messages, schema and reference page.
std::string describe(const Dimension& dimension);

/// The SI unit as names of columns and tables have it: "N", "kg/m3"; "" of a plain number.
std::string si_unit(const Dimension& dimension);

/// A text like `text` with another prefix or unit of the same dimension whose value is allowed ("210 MPa" ->
/// "210 GPa"), but never in micrometres or microseconds; empty if there is none, and for zero, which no unit changes.
std::string suggest_quantity(std::string_view text, const Dimension& dimension,
                             const std::function<bool(double)>& allowed);

}  // namespace railstrata
