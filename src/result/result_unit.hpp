#pragma once
// The units of results: in summary.json (SI), in the columns of tables, and for people.
#include <numbers>
#include <string_view>

namespace railstrata {

struct ResultUnit {
  std::string_view key_ending;     ///< of a key of summary.json: "_Pa"
  std::string_view column_ending;  ///< of a column's name: "_MPa"
  double column_factor = 1;        ///< SI to the column
  std::string_view shown;          ///< on the page and the screen: "MPa", "%"; empty: a plain number
  double factor = 1;               ///< SI to what is shown

  /// In SI: "Pa"; empty for a plain number.
  constexpr std::string_view si() const {
    if (key_ending == "_per_m") return "1/m";
    if (key_ending == "_per_s") return "1/s";
    if (key_ending == "_N_m") return "N m";
    if (key_ending == "_J_per_m") return "J/m";
    return key_ending.empty() ? key_ending : key_ending == "_m2" ? "m²" : key_ending.substr(1);
  }
};

/// Shares are written as fractions of one and shown in per cent.
namespace result_unit {
inline constexpr ResultUnit kNone{"", "", 1, "", 1};
inline constexpr ResultUnit kInside{"", "", 1, "inside|outside", 1};  ///< 0 or 1, shown as one of two words
inline constexpr ResultUnit kShare{"", "", 1, "%", 100};
inline constexpr ResultUnit kPerMille{"", "", 1, "10⁻³", 1e3};
inline constexpr ResultUnit kMPa{"_Pa", "_MPa", 1e-6, "MPa", 1e-6};
inline constexpr ResultUnit kMillimetres{"_m", "_mm", 1e3, "mm", 1e3};
inline constexpr ResultUnit kSquareMillimetres{"_m2", "_mm2", 1e6, "mm²", 1e6};
inline constexpr ResultUnit kMicrometres{"_m", "_um", 1e6, "µm", 1e6};
inline constexpr ResultUnit kNanometres{"_m", "_nm", 1e9, "nm", 1e9};
inline constexpr ResultUnit kKilonewtons{"_N", "_kN", 1e-3, "kN", 1e-3};
inline constexpr ResultUnit kNewtonMetres{"_N_m", "_N_m", 1, "N m", 1};
inline constexpr ResultUnit kJoules{"_J", "_J", 1, "J", 1};
inline constexpr ResultUnit kNewtons{"_N", "_N", 1, "N", 1};
inline constexpr ResultUnit kJoulesPerMetre{"_J_per_m", "_J_per_m", 1, "J/m", 1};
inline constexpr ResultUnit kKelvins{"_K", "_K", 1, "K", 1};
inline constexpr ResultUnit kWornArea{"_m", "_mm2_per_km", 1e9, "mm²/km", 1e9};  ///< m² per m
inline constexpr ResultUnit kWatts{"_W", "_W", 1, "W", 1};
inline constexpr ResultUnit kDegrees{"_rad", "_deg", 180 / std::numbers::pi, "°", 180 / std::numbers::pi};
inline constexpr ResultUnit kPerMetre{"_per_m", "_per_m", 1, "1/m", 1};
inline constexpr ResultUnit kPerSecond{"_per_s", "_per_s", 1, "1/s", 1};
inline constexpr ResultUnit kSeconds{"_s", "_s", 1, "s", 1};
inline constexpr ResultUnit kNanoseconds{"_s", "_ns", 1e9, "ns", 1e9};
inline constexpr ResultUnit kKilograms{"_kg", "_kg", 1, "kg", 1};
inline constexpr ResultUnit kMegabytes{"_bytes", "_MB", 1e-6, "MB", 1e-6};
}  // namespace result_unit

}  // namespace railstrata
