#pragma once
// Units and their factors, here alone: in summary.json (SI), in the columns of tables, and for people.
#include <numbers>
#include <string_view>

namespace railstrata {

/// SI prefixes, and the factors by which SI numbers are shown: 2 * kMilli is 2 mm in m; kToMilli * x is x m in mm.
inline constexpr double kMilli = 1e-3, kMega = 1e6;
inline constexpr double kToMilli = 1e3, kToMicro = 1e6, kToMega = 1e-6, kToPercent = 100;

struct Unit {
  std::string_view key_ending;     ///< of a key of summary.json: "_Pa"
  std::string_view column_ending;  ///< of a column's name: "_MPa"
  double column_factor = 1;        ///< SI to the column
  std::string_view shown;          ///< on the page and the screen: "MPa", "%"; empty: a plain number
  double factor = 1;               ///< SI to what is shown
  bool whole = false;              ///< a count: JSON has it without a decimal point

  /// In SI: "Pa"; empty for a plain number.
  constexpr std::string_view si() const {
    if (key_ending == "_per_m") return "1/m";
    if (key_ending == "_per_s") return "1/s";
    if (key_ending == "_N_m") return "N m";
    if (key_ending == "_J_per_m") return "J/m";
    if (key_ending == "_m_per_N") return "m/N";
    if (key_ending == "_Pa_sqrt_m") return "Pa √m";
    return key_ending.empty() ? key_ending : key_ending == "_m2" ? "m²" : key_ending.substr(1);
  }
};

namespace unit {
/// The same unit in tables and on screen.
constexpr Unit both(std::string_view key_ending, std::string_view column_ending, double factor,
                    std::string_view shown) {
  return {key_ending, column_ending, factor, shown, factor};
}
constexpr Unit si(std::string_view ending, std::string_view shown) { return both(ending, ending, 1, shown); }

inline constexpr Unit kNone = si("", "");
inline constexpr Unit kCount{"", "", 1, "", 1, true};
/// Shares are written as fractions of one and shown in per cent.
inline constexpr Unit kShare{"", "", 1, "%", kToPercent};
inline constexpr Unit kPerMille{"", "", 1, "10⁻³", kToMilli};
inline constexpr Unit kInside = si("", "inside|outside");  ///< 0 or 1, shown as one of two words
inline constexpr Unit kMPa = both("_Pa", "_MPa", kToMega, "MPa");
inline constexpr Unit kRootMetres = both("_Pa_sqrt_m", "_MPa_sqrt_m", kToMega, "MPa √m");
/// Million gross tonnes of traffic.
inline constexpr Unit kMGT = both("_kg", "_MGT", 1e-9, "MGT");
/// Depth by gross traffic.
inline constexpr Unit kMillimetresPerMGT = both("_m_per_kg", "_mm_per_MGT", 1e12, "mm/MGT");
inline constexpr Unit kMillimetres = both("_m", "_mm", kToMilli, "mm");
inline constexpr Unit kMicrometres = both("_m", "_um", kToMicro, "µm");
inline constexpr Unit kNanometres = both("_m", "_nm", 1e9, "nm");
inline constexpr Unit kSquareMillimetres = both("_m2", "_mm2", 1e6, "mm²");
inline constexpr Unit kWornArea = both("_m", "_mm2_per_km", 1e9, "mm²/km");  ///< m² per m
inline constexpr Unit kWearRate = both("_m_per_m", "_um_per_1000_km", 1e12, "µm per 1000 km");
inline constexpr Unit kPerMetre = si("_per_m", "1/m");
inline constexpr Unit kKilonewtons = both("_N", "_kN", kMilli, "kN");
inline constexpr Unit kNewtons = si("_N", "N");
inline constexpr Unit kNewtonMetres = si("_N_m", "N m");
inline constexpr Unit kJoules = si("_J", "J");
inline constexpr Unit kJoulesPerMetre = si("_J_per_m", "J/m");
inline constexpr Unit kJoulesPerSquareMetre = si("_J_per_m2", "J/m²");
inline constexpr Unit kSurfaceEnergy{"_J_per_m2", "_J_m2", 1, "J/mm²", 1e-6};  ///< of a collective
inline constexpr Unit kWatts = si("_W", "W");
inline constexpr Unit kKelvins = si("_K", "K");
inline constexpr Unit kDegrees = both("_rad", "_deg", 180 / std::numbers::pi, "°");
inline constexpr Unit kSeconds = si("_s", "s");
inline constexpr Unit kMilliseconds = both("_s", "_ms", kToMilli, "ms");
inline constexpr Unit kNanoseconds = both("_s", "_ns", 1e9, "ns");
inline constexpr Unit kPerSecond = si("_per_s", "1/s");
inline constexpr Unit kHertz = si("_Hz", "Hz");
inline constexpr Unit kNanometresPerNewton = both("_m_per_N", "_nm_per_N", 1e9, "nm/N");
inline constexpr Unit kMetresPerSecond = si("_m_s", "m/s");
inline constexpr Unit kMillimetresPerSecond = both("_m_s", "_mm_s", kToMilli, "mm/s");
inline constexpr Unit kRadiansPerSecond = si("_rad_s", "rad/s");
inline constexpr Unit kKilograms = si("_kg", "kg");
inline constexpr Unit kMegabytes = both("_bytes", "_MB", 1e-6, "MB");
}  // namespace unit

}  // namespace railstrata
