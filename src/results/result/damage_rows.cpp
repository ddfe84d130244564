#include "result/result_rows.hpp"

#include <cmath>

namespace railstrata::result_rows {

using namespace unit;

template <auto Member>
double shakedown_number(const Summary& s) {
  return s.shakedown.least(Member);
}

/// Left out of summary.json, and of tables, where no strength is known.
std::vector<ResultNumber> shakedown_numbers() {
  using F = ShakedownFactors;
  return {
      row("first_yield", kNone, shakedown_number<&F::first_yield>, "first_yield", "Load factor to first yield",
          "Factor on the elastic stress at which the first point yields, with the residual stress of manufacture",
          kMain),
      row("wandering", kNone, shakedown_number<&F::wandering>, "wandering",
          "Load factor to shakedown, wandering traffic",
          "Elastic shakedown with residual stresses that vary with depth only: safe for every traffic, and the exact "
          "limit where wheels wander laterally over more than the patch",
          kMain),
      row("single_track", kNone, shakedown_number<&F::single_track>, "single_track",
          "Load factor to shakedown, one track",
          "Elastic shakedown where every wheel runs in the same place; null if not requested", kMain),
      row("upper", kNone, shakedown_number<&F::upper>, "upper", "Upper bound of shakedown",
          "No higher load can shake down elastically, whatever the residual stress", kMain),
      row("kinematic", kNone, shakedown_number<&F::kinematic>, "kinematic", "Load factor to ratchetting with hardening",
          "Elastic shakedown for unlimited linear kinematic hardening", kMain)};
}

template <auto Member>
double of_layers(const Summary& s) {
  return layer_worst(s).*Member;
}

/// Left out of summary.json where there is no layer, or where nothing asks for its stress.
std::vector<ResultNumber> layer_numbers() {
  using L = LayerWorst;
  return {
      row("sigma_1", kMPa, of_layers<&L::sigma_1>, "layer σ₁", "Largest principal stress of the layers",
          "Including the residual stress of manufacture", kMain),
      row("share_of_tensile", kNone, of_layers<&L::share_of_tensile>, "layer σ₁/R_m", "Share of tensile strength",
          "Largest principal stress divided by the layer's tensile strength; at 1 a brittle layer cracks", kMain),
      row("critical_flaw", kMillimetres, of_layers<&L::critical_flaw>, "critical flaw", "Critical flaw of the layers",
          "Depth of the smallest edge crack that grows under that stress, from K_Ic; valid while it is small compared "
          "with the layer's thickness",
          kMain),
      row("interface_tension", kMPa, of_layers<&L::interface_tension>, "interface tension", "Tension at the interfaces",
          "Largest normal traction", kMain),
      row("interface_shear", kMPa, of_layers<&L::interface_shear>, "interface shear", "Shear at the interfaces",
          "Largest shear traction", kMain),
      row("interface_shear_range", kMPa, of_layers<&L::shear_range>, "interface Δτ", "Range of shear at the interfaces",
          "Range of tau_xz over a passage; it drives a crack along the interface", kMain),
      row("delamination", kNone, of_layers<&L::delamination>, "delamination", "Delamination index",
          "(tension / bond_tension)² + (shear / bond_shear)²; at 1 the bond fails", kMain)};
}

template <auto Member>
constexpr auto damage = &at<&Summary::damage, Member>;

double kth_outside(const Summary& s) { return s.damage.kth_of_map.outside(); }

std::vector<ResultNumber> damage_numbers() {
  using D = DamageSummary;
  return {
      row("t_gamma", kNewtons, damage<&D::t_gamma>, "T-gamma", "T-gamma",
          "|F_x creepage_x| + |F_y creepage_y|, summed over the patches; J per m rolled", kMain, kOfTGamma),
      row("t_gamma_with_spin", kNewtons, damage<&D::t_gamma_with_spin>, "with spin", "T-gamma with spin",
          "T-gamma plus |M_z spin|", kShown | kCompared, kOfTGamma),
      row("friction_energy", kJoulesPerMetre, damage<&D::friction_energy>, "friction energy",
          "Friction energy per distance", "Sum over the points of traction times slip times area, divided by the speed",
          kCompared),
      row("motion_energy", kJoulesPerMetre, damage<&D::motion_energy>, "energy by motion",
          "Energy of the rigid motion per distance",
          "Tractions times the rigid slip of the cells, divided by the speed. It equals T-gamma with spin plus the "
          "effect of the rolling radii of the rows. In steady rolling it equals the friction energy. Half-spaces only",
          kCompared),
      row("rcf_damage", kNone, damage<&D::rcf_damage>, "RCF damage", "RCF damage of a passage",
          "Burstow's function of T-gamma for R260, the largest of the patches; break points 15, 65 and 175 N; 1: a "
          "visible crack; below zero: wear removes the damage",
          kCompared),
      row("brr_wear", kWornArea, damage<&D::brr_wear>, "BRR wear", "BRR wear",
          "Worn area over distance, from T-gamma and the wheel's diameter", kCompared),
      row("usfd_depth", kNanometres, damage<&D::usfd_depth>, "USFD wear", "Wear of a passage, USFD",
          "Largest depth, R8T wheel on 900A rail, dry laboratory surfaces, times the wear factor of the rail's steel",
          kMain),
      row("wear_factor", kNone, &at<&Summary::damage, &D::rail_steel, &SteelWear::factor>, "wear factor",
          "Wear of the rail's steel",
          "Over that of R260, the factor of the USFD depth; wear_of_steels names its source", kCompared),
      row("kth_depth", kNanometres, damage<&D::kth_depth>, "KTH wear", "Wear of a passage, KTH map",
          "Largest depth, Jendel's map for dry laboratory surfaces with the rail's hardness", kCompared),
      row("kth_outside", kNone, &kth_outside, "KTH, outside", "Share of the KTH wear outside its map",
          "From cells that seize (p > 0.8 H) or slip faster than 1 m/s, over the worn area of the patch", kCompared),
      row("archard_depth", kNanometres, damage<&D::archard_depth>, "Archard wear", "Wear of a passage, Archard",
          "Largest depth, from the rail's wear_coefficient and hardness", kCompared),
      row("temperature_rise", kKelvins, damage<&D::temperature_rise>, "flash temperature", "Flash temperature",
          "Largest rise of the surfaces' temperature in the patch", kMain),
      row("surface_fatigue", kNone, damage<&D::surface_fatigue>, "FI_surf", "Surface fatigue index",
          "Utilised friction minus k / p_max; surface fatigue is expected above zero", kCompared),
      row("local_fatigue", kNone, damage<&D::local_fatigue>, "local FI", "Local fatigue index",
          "Largest |q|/p - k/p of all points", kCompared),
      row("temperature_rise_lower", kKelvins, damage<&D::temperature_rise_lower>, "flash temperature, at least",
          "Flash temperature, lower bound", "Bodies taken as half-spaces of their most effusive material"),
      row("temperature_rise_upper", kKelvins, damage<&D::temperature_rise_upper>, "flash temperature, at most",
          "Flash temperature, upper bound",
          "Bodies taken as half-spaces of their least effusive material, whichever layer that is"),
      row("austenitisation", kNone, damage<&D::austenitisation>, "austenitisation", "Share of austenitisation",
          "Flash temperature divided by the austenitisation_rise of the rail's running surface; from 1 on "
          "martensite can form; null where the case does not give it",
          kShown)};
}

template <auto Member>
constexpr auto life = &at<&Summary::life, Member>;

/// Left out of summary.json where the case does not ask for a life.
std::vector<ResultNumber> life_numbers() {
  using L = LifeSummary;
  return {
      row("best", kMGT, life<&L::best>, "life", "Life of the rail",
          "Gross traffic of such wheels until the first zone of the rail reaches its end of life, best estimate; "
          "inf: no end within life.until; null, in a table empty: not known",
          kColumn),
      row("low", kMGT, life<&L::low>, "life, low", "Life of the rail, low", "Lower end of the life's range", kColumn),
      row("high", kMGT, life<&L::high>, "life, high", "Life of the rail, high", "Upper end of the life's range",
          kColumn)};
}

template <auto Member>
constexpr auto crack = &at<&Summary::crack, Member>;

/// Left out of summary.json where the case has no crack.
std::vector<ResultNumber> crack_numbers() {
  using K = CrackSummary;
  return {
      row("depth", kMillimetres, crack<&K::depth>, "crack", "Crack, depth", "Depth of its lower end", kShown),
      row("K_I_range", kRootMetres, crack<&K::K_I_range>, "ΔK_I", "Crack, range of K_I",
          "Range of K_I over a passage, closed faces counted as 0", kMain),
      row("K_II_range", kRootMetres, crack<&K::K_II_range>, "ΔK_II", "Crack, range of K_II",
          "Range of the stress intensity of shear over a passage", kMain),
      row("equivalent_range", kRootMetres, crack<&K::equivalent_range>, "ΔK_eq", "Crack, equivalent range",
          "Range that crack.law counts with; null: along an interface", kMain),
      row("energy_release", kJoulesPerSquareMetre, crack<&K::release>, "G", "Crack, energy release rate",
          "Largest energy release rate of a passage, of a crack inside at either end", kMain),
      row("phase", kDegrees, crack<&K::phase>, "phase", "Crack, phase angle",
          "atan2(K_II, K_I) there; 90 degrees or -90: shear of closed faces", kShown),
      row("growth", kNanometres, crack<&K::growth>, "growth", "Crack growth a wheel",
          "Along its direction in one passage, by crack.law; null: along an interface", kMain),
      row("life", kMGT, crack<&K::life>, "to allowable", "Crack, traffic to crack.allowable",
          "Gross traffic of such wheels without wear; inf: never; null: the crack is inside, or deeper already", kMain),
      row("azimuth", kDegrees, crack<&K::azimuth>, "azimuth", "Crack, direction",
          "As of crack.azimuth; not given: the direction in which it grows fastest", kShown),
      row("kink_range", kRootMetres, crack<&K::kink_range>, "Δk_I of a kink", "Crack, opening of a kink",
          "Largest range of the opening stress intensity of a small kink at the crack's end", kShown),
      row("kink_angle", kDegrees, crack<&K::kink_angle>, "kink", "Crack, direction of the kink",
          "Direction of that kink from the surface, in the sense of crack.angle", kShown),
      row("slipping", kShare, crack<&K::slipping>, "slipping faces", "Crack, slipping faces",
          "Largest share of the crack's length whose closed faces slip", kShown)};
}

template <auto Member>
constexpr auto interface = &at<&Summary::interface_slip, Member>;

/// Left out of summary.json where no interface has a shear limit.
std::vector<ResultNumber> interface_numbers() {
  using I = SlidingSummary;
  return {
      row("passages_followed", kCount, interface<&I::passages>, "passages", "Interface, passages",
          "Passages that were followed, from a fresh interface on, until each leaves as much slip behind as the one "
          "before",
          kShown),
      row("largest_slip", kMicrometres, interface<&I::slip>, "slip", "Interface, slip",
          "Largest slip anywhere below the patch, of the last passage", kMain),
      row("slip_left", kMicrometres, interface<&I::left>, "slip left", "Interface, slip left",
          "Largest slip that the last passage leaves behind; near 0: slip dies out", kMain),
      row("first_slip", kMicrometres, interface<&I::first_slip>, "first slip", "Interface, first slip",
          "Largest slip of the first passage", kShown),
      row("first_slip_left", kMicrometres, interface<&I::first_left>, "first slip left", "Interface, first slip left",
          "Largest slip that the first passage leaves behind", kShown),
      row("area", kSquareMillimetres, interface<&I::area>, "slip area", "Interface, slip area",
          "Area that slips at one time, by more than a tenth of the fastest place, in the last passage", kMain),
      row("work", kJoulesPerMetre, interface<&I::work>, "friction work", "Interface, friction work",
          "Work of friction at the interface over the way, of the last passage", kMain),
      row("first_work", kJoulesPerMetre, interface<&I::first_work>, "first friction work",
          "Interface, first friction work", "The same of the first passage", kShown),
      row("shear", kMPa, interface<&I::shear>, "shear", "Interface, shear",
          "Largest shear of the interface, of the last passage", kMain)};
}

}  // namespace railstrata::result_rows
