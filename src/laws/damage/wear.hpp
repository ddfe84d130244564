#pragma once
// Wear and friction's energy of one passage, cell by cell along the streamlines of a contact patch.
//
// Steady rolling: a point of the surface passes the cells of its row one after the other, dx each, dx/V long. What it
// loses is the sum over the row. Depth is positive into the body.
#include <optional>
#include <span>
#include <vector>

namespace railstrata {

/// A row of the patch along x, in any order of x. Tractions act on the rail, slip is the wheel's over the rail's
/// surface (docs/conventions.md): q·slip >= 0 where friction dissipates.
struct Streamline {
  std::span<const double> p, q_x, q_y;     ///< Pa
  std::span<const double> slip_x, slip_y;  ///< m/s
  double dx = 0;                           ///< m, length of a cell
  double speed = 0;                        ///< V [m/s], > 0
  /// W/m², q·slip and p |slip| where the means of the products are known; empty: the products of what is above.
  std::span<const double> power = {}, pressed = {};
};

/// q·s, W/m², of every cell; below zero only by a fault of the solution.
std::vector<double> friction_power(const Streamline& line);

/// J/m² per passage: the sum of q·s dx/V.
double friction_energy(const Streamline& line);

// -- University of Sheffield (USFD) -------------------------------------------------------------------------------

/// kg lost per m rolled and m² of a cell (1 µg/(m mm²) = 1e-3 kg/m³), from x = |q·s|/V [Pa], T-gamma over the area. In
/// µg/(m mm²) with x in N/mm²: 5.3 x below 10.4 (mild), 55.0 to 77.2 (severe), 61.9 x - 4723.68 beyond (catastrophic).
/// R8T wheel steel on UIC 900A rail steel, dry, twin discs. [LewisDwyerJoyce2004]
///
/// The last branch goes on from 55.0 at 77.2. In circulation is also the constant 4778.7, with which the rate falls to
/// zero there. At 10.4 the published branches differ by 0.2 % (55.12 and 55.0).
double usfd_rate(double t_gamma_per_area);
inline constexpr double kUsfdSevereFrom = 10.4e6, kUsfdCatastrophicFrom = 77.2e6;  // Pa

/// m worn off per passage; density kg/m³ (steel 7800: 1 µg/mm² = 128 nm).
double usfd_depth(const Streamline& line, double density);

// -- Archard with Jendel's map (KTH) ------------------------------------------------------------------------------

/// Wear coefficient over pressure and slip velocity: `seizure` where p > 0.8 H, H the hardness, else `slow` below
/// 0.2 m/s, `middle` up to 0.7 m/s and `fast` beyond. [Jendel2002]
struct ArchardMap {
  double slow = 0, middle = 0, fast = 0, seizure = 0;
};
/// 5e-4, 35e-4, 5e-4 and 350e-4, the middle of the published ranges (1 to 10, 30 to 40, 1 to 10 and 300 to 400e-4): dry
/// laboratory surfaces. Natural lubrication of a track divides them by some 5; the factor is uncertain: scale.
ArchardMap laboratory_dry_archard();
/// Where a map of dry steel turns to seizure, as a share of H; m/s, up to which slip its chart is drawn (some).
inline constexpr double kSeizurePressure = 0.8, kFastestOfMap = 1.0;
double archard_coefficient(const ArchardMap& map, double p, double slip_velocity, double hardness);

/// m worn off per passage, the sum of k p |s| (dx/V)/H; H [Pa] the hardness of what wears, as a pressure (HV 9.80665
/// MPa; 2.6 to 3 GPa of rails). `scale` multiplies every coefficient: lubrication, a layer's share of its rail's.
double archard_depth(const Streamline& line, const ArchardMap& map, double hardness, double scale = 1);

/// Parts of archard_depth that a map of coefficients has little behind: cells that seize, and others that slip faster
/// than its chart.
struct OutsideMap {
  double seized = 0, fast = 0;  ///< m
};
OutsideMap archard_outside(const Streamline& line, const ArchardMap& map, double hardness, double scale = 1);

// -- Local fatigue index ------------------------------------------------------------------------------------------

/// |q|/p - k/p of a cell: Ekberg's surface index without the patch's mean; k [Pa] the yield strength in cyclic shear.
/// > 0: more traction than the surface carries elastically. Cells with p <= 0 have none. [EkbergKaboAndersson2002]
/// The largest of a row; nothing for a row without contact.
std::optional<double> local_fatigue(const Streamline& line, double cyclic_shear_yield);

}  // namespace railstrata
