// Words: what checks and quantities are called, how numbers are written.
import type { Run } from "./data";

export function engineName(engine: string): string {
  return engine === "fem" ? "finite elements" : engine === "bem" ? "half-space" : engine;
}

export function runLabel(run: Run): string {
  return `${run.name} (${engineName(run.engine)})`;
}

/// Four significant digits, no exponent where it can be avoided; "–" for no number.
export function numberText(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e7) {
    const [mantissa, power] = value.toExponential(digits - 1).split("e");
    return `${minus(mantissa.replace(/\.?0+$/, ""))} × 10${superscript(Number(power))}`;
  }
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  return minus(value.toFixed(Math.min(decimals, 8)));
}

/// A whole number in groups of three.
export function countText(value: number | null): string {
  return value === null ? "–" : String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, "\u202f");
}

export function minus(text: string): string {
  return text.replace("-", "−");
}

function superscript(n: number): string {
  return String(n)
    .split("")
    .map((c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)]))
    .join("");
}

export function percentText(fraction: number | null, digits = 2): string {
  if (fraction === null || !Number.isFinite(fraction)) return "–";
  const text = (100 * fraction).toFixed(digits);
  if (Number(text) === 0) return `${text.replace("-", "")} %`;
  return `${fraction > 0 ? "+" : ""}${minus(text)} %`;
}

/// How a check of summary.json reads: its name, what it says, and how its numbers are shown.
export interface CheckWords {
  name: string;
  what: string;
  scale: number;
  unit: string;
}
const kChecks: Record<string, CheckWords> = {
  preload_residual: { name: "Static equilibrium", what: "residual of the preload, relative to the load", scale: 1, unit: "" },
  F_z_relative_to_weight: { name: "Vertical load", what: "F_z of the contact against the weight on the wheel", scale: 100, unit: "%" },
  traction_coefficient_reached: { name: "Traction", what: "F_x/F_z reached against the wanted traction coefficient", scale: 100, unit: "%" },
  penetration_over_approach: { name: "Penetration", what: "largest overlap of the bodies against Hertz’s approach", scale: 100, unit: "%" },
  energy_closure: { name: "Energy closure", what: "energy gained or lost by the time steps, of the largest energy turned over", scale: 100, unit: "%" },
  hourglass_share: { name: "Hourglass energy", what: "energy of the elements’ hourglass modes, of the strain energy", scale: 100, unit: "%" },
  p_max_scatter: { name: "Scatter of p_max", what: "standard deviation over the window, of the mean", scale: 100, unit: "%" },
  patch_reaches_edge_of_fine_zone: { name: "Patch inside the fine mesh", what: "1 if the patch touches the border of the fine zone", scale: 1, unit: "" },
  patch_reaches_edge_of_grid: { name: "Patch inside the grid", what: "1 if the patch touches the border of the grid", scale: 1, unit: "" },
  p_max: { name: "Largest pressure", what: "finite elements against half-space", scale: 100, unit: "%" },
  patch_length: { name: "Patch length", what: "finite elements against half-space", scale: 100, unit: "%" },
  q_max: { name: "Largest shear", what: "finite elements against half-space", scale: 100, unit: "%" },
  cases_differ: { name: "Different cases", what: "their options differ", scale: 1, unit: "" },
  von_mises_below_surface: { name: "Largest von Mises stress below the surface", what: "rail, finite elements against half-space", scale: 100, unit: "%" },
};

export function checkWords(name: string): CheckWords {
  return kChecks[name] ?? { name: name.replace(/_/g, " "), what: "", scale: 1, unit: "" };
}

export interface Quantity {
  path: string;
  name: string;
  unit: string;
  scale: number; // SI to unit
  alone?: boolean; // a small remainder, or another thing in the other engine: no difference is told
}
export const kQuantities: Quantity[] = [
  { path: "contact/p_max_Pa", name: "Largest pressure p", unit: "MPa", scale: 1e-6 },
  { path: "contact/q_max_Pa", name: "Largest shear |q|", unit: "MPa", scale: 1e-6 },
  { path: "contact/patch_length_m", name: "Patch length (along x)", unit: "mm", scale: 1e3 },
  { path: "contact/patch_width_m", name: "Patch width (along y)", unit: "mm", scale: 1e3 },
  { path: "contact/patch_area_m2", name: "Patch area", unit: "mm²", scale: 1e6 },
  { path: "contact/slip_area_fraction", name: "Slip area / patch area", unit: "%", scale: 100 },
  { path: "contact/F_x_N", name: "F_x on the wheel", unit: "kN", scale: 1e-3 },
  { path: "contact/F_y_N", name: "F_y on the wheel", unit: "kN", scale: 1e-3, alone: true },
  { path: "contact/F_z_N", name: "F_z on the wheel", unit: "kN", scale: 1e-3 },
  { path: "contact/normal_force_N", name: "Normal force in the contact plane", unit: "kN", scale: 1e-3 },
  { path: "contact/lateral_force_N", name: "Lateral force in the contact plane", unit: "kN", scale: 1e-3, alone: true },
  { path: "contact/creepage_x", name: "Longitudinal creepage (negative: driving)", unit: "10⁻³", scale: 1e3 },
  { path: "contact/creepage_y", name: "Lateral creepage", unit: "10⁻³", scale: 1e3, alone: true },
  { path: "contact/spin_per_m", name: "Spin", unit: "1/m", scale: 1 },
  { path: "contact/approach_m", name: "Approach (finite elements: with the bending of rail and wheel)", unit: "µm", scale: 1e6, alone: true },
  { path: "contact/penetration_max_m", name: "Largest penetration", unit: "nm", scale: 1e9, alone: true },
];

export const kZones: [key: string, name: string][] = [
  ["surface", "at the surface"],
  ["subsurface", "below the surface"],
  ["layer", "in the layers"],
  ["interface", "at the interfaces"],
  ["matrix", "in the matrix"],
];
