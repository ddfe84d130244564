// Written by columns.py from `railstrata schema --results`: numbers of summary.json, how they are shown.
// clang-format off

export interface Column {
  path: string;  // "contact/p_max_Pa"
  name: string;
  label: string;                                       // short
  unit: {si: string; shown: string; factor: number};  // factor: from SI to what is shown
  digits: number;
}

const column = (
    path: string, name: string, label: string, [si, shown, factor]: [string, string, number],
    digits: number): Column => ({path, name, label, unit: {si, shown, factor}, digits});

export const kColumns: Column[] = [
  column("position_m", "Position of the wheel", "position", ["m", "mm", 1000.0], 4),
  column("contact/p_max_Pa", "Largest pressure p", "p_max", ["Pa", "MPa", 1e-06], 4),
  column("contact/q_max_Pa", "Largest shear |q|", "q_max", ["Pa", "MPa", 1e-06], 4),
  column("contact/q_max_point_Pa", "Largest shear |q| of a point", "q_max of a point", ["Pa", "MPa", 1e-06], 4),
  column("contact/patch_length_m", "Patch length (along x)", "length", ["m", "mm", 1000.0], 4),
  column("contact/patch_width_m", "Patch width (along y)", "width", ["m", "mm", 1000.0], 4),
  column("contact/patch_area_m2", "Patch area", "area", ["m²", "mm²", 1000000.0], 4),
  column("contact/slip_area_fraction", "Slip area / patch area", "slip area", ["", "%", 100.0], 4),
  column("contact/F_x_N", "F_x on the wheel", "F_x", ["N", "kN", 0.001], 4),
  column("contact/F_y_N", "F_y on the wheel", "F_y", ["N", "kN", 0.001], 4),
  column("contact/F_z_N", "F_z on the wheel", "F_z", ["N", "kN", 0.001], 4),
  column("contact/contact_angle_rad", "Contact angle", "contact angle", ["rad", "°", 57.29577951308232], 4),
  column("contact/normal_force_N", "Normal force in the contact plane", "normal force", ["N", "kN", 0.001], 4),
  column("contact/lateral_force_N", "Lateral force in the contact plane", "lateral force", ["N", "kN", 0.001], 4),
  column("contact/spin_moment_N_m", "Moment about the contact normal", "spin moment", ["N m", "N m", 1.0], 4),
  column("contact/creepage_x", "Longitudinal creepage (negative: driving)", "creepage", ["", "10⁻³", 1000.0], 4),
  column("contact/creepage_y", "Lateral creepage", "lateral creepage", ["", "10⁻³", 1000.0], 4),
  column("contact/spin_per_m", "Spin", "spin", ["1/m", "1/m", 1.0], 4),
  column(
      "contact/approach_m", "Approach (finite elements: with the bending of rail and wheel)", "approach",
      ["m", "µm", 1000000.0], 4),
  column("contact/penetration_max_m", "Largest penetration", "penetration", ["m", "nm", 1000000000.0], 4),
  column("contact/p_max_scatter", "Scatter of p_max", "scatter of p_max", ["", "%", 100.0], 4),
  column(
      "contact/displacement_x_m", "Displacement of the wheel over the rail", "displacement",
      ["m", "µm", 1000000.0], 4),
  column(
      "contact/displacement_y_m", "Lateral displacement of the wheel over the rail", "lateral displ.",
      ["m", "µm", 1000000.0], 4),
  column("contact/friction_work_J", "Friction work since the start", "friction work", ["J", "J", 1.0], 4),
  column("contact/p_max_error_Pa", "Error bar of the largest pressure", "± p_max", ["Pa", "MPa", 1e-06], 4),
  column("contact/q_max_error_Pa", "Error bar of the largest shear", "± q_max", ["Pa", "MPa", 1e-06], 4),
  column("contact/slip_area_fraction_error", "Error bar of the slip area", "± slip area", ["", "%", 100.0], 4),
  column("contact/F_x_error_N", "Error bar of F_x", "± F_x", ["N", "kN", 0.001], 4),
  column("contact/F_y_error_N", "Error bar of F_y", "± F_y", ["N", "kN", 0.001], 4),
  column("contact/creepage_x_error", "Error bar of the longitudinal creepage", "± creepage", ["", "10⁻³", 1000.0], 4),
  column(
      "contact/creepage_y_error", "Error bar of the lateral creepage", "± lateral creepage",
      ["", "10⁻³", 1000.0], 4),
  column("damage/t_gamma_N", "T-gamma", "T-gamma", ["N", "N", 1.0], 4),
  column("damage/t_gamma_with_spin_N", "T-gamma with spin", "with spin", ["N", "N", 1.0], 4),
  column("damage/friction_energy_J_per_m", "Friction energy per distance", "friction energy", ["J/m", "J/m", 1.0], 4),
  column(
      "damage/motion_energy_J_per_m", "Energy of the rigid motion per distance", "energy by motion",
      ["J/m", "J/m", 1.0], 4),
  column("damage/rcf_damage", "RCF damage of a passage", "RCF damage", ["", "", 1.0], 4),
  column("damage/brr_wear_m", "BRR wear", "BRR wear", ["m", "mm²/km", 1000000000.0], 4),
  column("damage/usfd_depth_m", "Wear of a passage, USFD", "USFD wear", ["m", "nm", 1000000000.0], 4),
  column("damage/kth_depth_m", "Wear of a passage, KTH map", "KTH wear", ["m", "nm", 1000000000.0], 4),
  column("damage/archard_depth_m", "Wear of a passage, Archard", "Archard wear", ["m", "nm", 1000000000.0], 4),
  column("damage/temperature_rise_K", "Flash temperature", "flash temperature", ["K", "K", 1.0], 4),
  column("damage/surface_fatigue", "Surface fatigue index", "FI_surf", ["", "", 1.0], 4),
  column("damage/local_fatigue", "Local fatigue index", "local FI", ["", "", 1.0], 4),
  column(
      "damage/temperature_rise_lower_K", "Flash temperature, lower bound", "flash temperature, at least",
      ["K", "K", 1.0], 4),
  column(
      "damage/temperature_rise_upper_K", "Flash temperature, upper bound", "flash temperature, at most",
      ["K", "K", 1.0], 4),
  column("damage/austenitisation", "Share of austenitisation", "austenitisation", ["", "", 1.0], 4),
  column("shakedown/factors/first_yield", "Load factor to first yield", "first_yield", ["", "", 1.0], 4),
  column("shakedown/factors/wandering", "Load factor to shakedown, wandering traffic", "wandering", ["", "", 1.0], 4),
  column("shakedown/factors/single_track", "Load factor to shakedown, one track", "single_track", ["", "", 1.0], 4),
  column("shakedown/factors/upper", "Upper bound of shakedown", "upper", ["", "", 1.0], 4),
  column("shakedown/factors/kinematic", "Load factor to ratchetting with hardening", "kinematic", ["", "", 1.0], 4),
  column("layers/sigma_1_Pa", "Largest principal stress of the layers", "layer σ₁", ["Pa", "MPa", 1e-06], 4),
  column("layers/share_of_tensile", "Share of tensile strength", "layer σ₁/R_m", ["", "", 1.0], 4),
  column("layers/critical_flaw_m", "Critical flaw of the layers", "critical flaw", ["m", "mm", 1000.0], 4),
  column("layers/interface_tension_Pa", "Tension at the interfaces", "interface tension", ["Pa", "MPa", 1e-06], 4),
  column("layers/interface_shear_Pa", "Shear at the interfaces", "interface shear", ["Pa", "MPa", 1e-06], 4),
  column(
      "layers/interface_shear_range_Pa", "Range of shear at the interfaces", "interface Δτ",
      ["Pa", "MPa", 1e-06], 4),
  column("layers/delamination", "Delamination index", "delamination", ["", "", 1.0], 4),
  column("life/best_kg", "Life of the rail", "life", ["kg", "MGT", 1e-09], 4),
  column("life/low_kg", "Life of the rail, low", "life, low", ["kg", "MGT", 1e-09], 4),
  column("life/high_kg", "Life of the rail, high", "life, high", ["kg", "MGT", 1e-09], 4),
  column("passage/F_z_max_N", "Largest wheel force on the way", "F_z, largest", ["N", "kN", 0.001], 4),
  column(
      "passage/F_z_max_position_m", "Position of the wheel at its largest wheel force", "at position",
      ["m", "mm", 1000.0], 4),
  column("passage/F_z_min_N", "Smallest wheel force on the way", "F_z, smallest", ["N", "kN", 0.001], 4),
  column(
      "passage/F_z_min_position_m", "Position of the wheel at its smallest wheel force", "at position",
      ["m", "mm", 1000.0], 4),
  column("passage/p_max_on_way_Pa", "Largest pressure on the way", "p_max on the way", ["Pa", "MPa", 1e-06], 4),
  column(
      "passage/p_max_position_m", "Position of the wheel at the largest pressure", "at position",
      ["m", "mm", 1000.0], 4),
  column("passage/patch_parts", "Most parts of the patch on the way", "parts of the patch", ["", "", 1.0], 4),
  column(
      "passage/von_mises_on_way_Pa", "Largest von Mises stress of the rail on the way", "von Mises on the way",
      ["Pa", "MPa", 1e-06], 4),
  column("passage/von_mises_x_m", "Its place along the rail", "at x", ["m", "mm", 1000.0], 4),
  column("passage/von_mises_depth_m", "Its depth", "at depth", ["m", "mm", 1000.0], 4),
  column("passage/P1_N", "Largest force within 2 ms of a dip's tip", "P1", ["N", "kN", 0.001], 4),
  column("passage/P2_N", "Largest mean of 2 ms, from 2.2 ms after the tip on", "P2", ["N", "kN", 0.001], 4),
  column(
      "passage/P1_jenkins_low_N", "P1 by Jenkins' formula with 0.4 m of rail", "P1 by Jenkins, low",
      ["N", "kN", 0.001], 4),
  column(
      "passage/P1_jenkins_high_N", "P1 by Jenkins' formula with 1 m of rail", "P1 by Jenkins, high",
      ["N", "kN", 0.001], 4),
  column(
      "passage/P2_jenkins_low_N", "P2 by Jenkins' formula less its errors", "P2 by Jenkins, low",
      ["N", "kN", 0.001], 4),
  column(
      "passage/P2_jenkins_high_N", "P2 by Jenkins' formula with its errors", "P2 by Jenkins, high",
      ["N", "kN", 0.001], 4),
  column(
      "passage/passing_frequency_Hz", "Speed over the length of waves of rail or wheel", "passing frequency",
      ["Hz", "Hz", 1.0], 4),
  column(
      "passage/F_z_passing_N", "Amplitude of the wheel force at the passing frequency", "F_z at it",
      ["N", "kN", 0.001], 4),
  column(
      "passage/interface_opening_max_m", "Largest opening of an unbonded interface on the way", "interface opening",
      ["m", "µm", 1000000.0], 4),
  column(
      "passage/interface_slip_max_m", "Largest shift along an unbonded interface on the way", "interface slip",
      ["m", "µm", 1000000.0], 4),
  column("plastic/strain", "Plastic strain", "plastic strain", ["", "%", 100.0], 4),
  column("plastic/accumulated", "Accumulated plastic strain", "accumulated plastic strain", ["", "%", 100.0], 4),
  column("plastic/elements", "Elements that yielded", "yielded elements", ["", "", 1.0], 4),
  column("plastic/work_J", "Plastic work", "plastic work", ["J", "J", 1.0], 4),
  column("plastic/dissipated_J", "Dissipated plastic work", "dissipated", ["J", "J", 1.0], 4),
  column("plastic/x_m", "Largest accumulated plastic strain, x", "yielded at x", ["m", "mm", 1000.0], 4),
  column("plastic/y_m", "Largest accumulated plastic strain, y", "yielded at y", ["m", "mm", 1000.0], 4),
  column("plastic/depth_m", "Largest accumulated plastic strain, depth", "yielded at depth", ["m", "mm", 1000.0], 4),
  column("energy/closure", "Energy closure", "energy closure", ["", "%", 100.0], 4),
  column("energy/hourglass_share", "Hourglass energy", "hourglass energy", ["", "%", 100.0], 4),
  column("run/wall_s", "Wall time", "wall time", ["s", "s", 1.0], 4),
  column("run/preload_wall_s", "Wall time of the preload", "preload", ["s", "s", 1.0], 4),
  column("run/output_wall_s", "Wall time of the output", "output", ["s", "s", 1.0], 4),
  column("run/elements", "Elements", "elements", ["", "", 1.0], 4),
  column("run/nodes", "Nodes", "nodes", ["", "", 1.0], 4),
  column("run/steps", "Time steps", "steps", ["", "", 1.0], 4),
  column("run/dt_s", "Time step", "time step", ["s", "ns", 1000000000.0], 4),
  column("run/stable_step_s", "Stable step", "stable step", ["s", "ns", 1000000000.0], 4),
  column("run/unscaled_step_s", "Stable step of the real masses", "unscaled step", ["s", "ns", 1000000000.0], 4),
  column("run/added_mass_kg", "Added mass", "added mass", ["kg", "kg", 1.0], 4),
  column("run/local_stages", "Stages of local steps", "stages", ["", "", 1.0], 4),
  column("run/fine_elements", "Elements in local steps", "fine elements", ["", "", 1.0], 4),
  column("run/element_steps_per_s", "Element steps per second", "element steps", ["1/s", "1/s", 1.0], 4),
  column("run/threads", "Threads", "threads", ["", "", 1.0], 4),
  column("run/peak_memory_bytes", "Largest memory", "memory", ["bytes", "MB", 1e-06], 4),
];

export const kZones: Record<string, string> = {
  surface: "at the surface",
  subsurface: "below the surface",
  layer: "in the layers",
  interface: "at the interfaces",
  matrix: "in the matrix",
};

export const kMeasures: Record<string, string> = {
  von_mises_max: "von Mises",
  sigma1_max: "σ₁",
};
