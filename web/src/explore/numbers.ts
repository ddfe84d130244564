// The numbers of a state, with what they have changed by against the pinned one.
import {element} from "../dom";
import type {Answer, StressMaximum, Summary} from "./types";

interface Number_ {
  name: string;
  unit: string;
  factor: number;
  digits: number;
  of: (s: Summary) => number | null | undefined;
  tile?: boolean;
}

const contact = (name: string, key: string, unit: string, factor: number, digits = 4, tile = false): Number_ =>
    ({name, unit, factor, digits, of: (s) => s.contact[key], tile});
const stress = (name: string, zone: string, what: "von_mises_max"|"sigma1_max", body = "rail", tile = false): Number_ =>
    ({name, unit: "MPa", factor: 1e-6, digits: 4, tile, of: (s) => s.stress[body]?.[zone]?.[what]?.value_Pa});
const depth = (name: string, zone: string): Number_ => ({
  name,
  unit: "mm",
  factor: 1e3,
  digits: 3,
  of: (s) => (s.stress["rail"]?.[zone]?.von_mises_max as StressMaximum | null | undefined)?.depth_m
});
const factor = (name: string, key: string, tile = false): Number_ =>
    ({name, unit: "", factor: 1, digits: 3, of: (s) => s.shakedown?.factors[key], tile});

export const kNumbers: Number_[] = [
  contact("Largest pressure", "p_max_Pa", "MPa", 1e-6, 4, true),
  contact("Contact area", "patch_area_m2", "mm²", 1e6, 4, true),
  contact("Length", "patch_length_m", "mm", 1e3, 4),
  contact("Width", "patch_width_m", "mm", 1e3, 4),
  contact("Slip area", "slip_area_fraction", "%", 100, 3, true),
  contact("Creepage ξ_x", "creepage_x", "‰", 1e3, 4, true),
  contact("Creepage ξ_y", "creepage_y", "‰", 1e3, 4),
  contact("Spin", "spin_per_m", "1/m", 1, 4),
  contact("Largest traction", "q_max_Pa", "MPa", 1e-6, 4),
  contact("F_x on the wheel", "F_x_N", "kN", 1e-3, 4),
  contact("F_y on the wheel", "F_y_N", "kN", 1e-3, 4),
  contact("Normal force", "normal_force_N", "kN", 1e-3, 4),
  contact("Approach", "approach_m", "µm", 1e6, 4),
  contact("Contact angle", "contact_angle_rad", "mrad", 1e3, 4),
  {name: "T-gamma", unit: "N", factor: 1, digits: 3, of: (s) => s.damage["t_gamma_N"]},
  {name: "Flash temperature", unit: "K", factor: 1, digits: 3, of: (s) => s.damage["temperature_rise_K"]},
  stress("von Mises below, rail", "subsurface", "von_mises_max", "rail", true),
  depth("in the depth", "subsurface"),
  stress("von Mises at the surface, rail", "surface", "von_mises_max"),
  stress("σ₁ at the surface, rail", "surface", "sigma1_max"),
  stress("von Mises in the layer", "layer", "von_mises_max"),
  stress("σ₁ in the layer", "layer", "sigma1_max"),
  stress("von Mises at the interface", "interface", "von_mises_max"),
  stress("von Mises under the layer", "matrix", "von_mises_max"),
  stress("von Mises below, wheel", "subsurface", "von_mises_max", "wheel"),
  factor("Shakedown, wandering traffic", "wandering", true),
  factor("First yield", "first_yield"),
  factor("Shakedown, upper bound", "upper"),
  factor("Kinematic hardening", "kinematic"),
];

const minus = (text: string) => text.replace("-", "−");

function shown(n: Number_, s: Summary): number|null {
  const value = n.of(s);
  return value === null || value === undefined || !Number.isFinite(value) ? null : n.factor * value;
}

export function text(value: number|null, digits: number): string {
  if (value === null) return "–";
  if (Math.abs(value) < 1e-9) return "0";
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(Math.abs(value))));
  return minus(value.toFixed(Math.min(decimals, 6)));
}

/// "+3.2 %"; of what was near zero the difference itself.
function change(now: number|null, before: number|null, digits: number): string {
  if (now === null || before === null) return "";
  if (Math.abs(before) < 1e-9) return now === before ? "" : minus((now - before).toPrecision(digits));
  const share = 100 * (now / before - 1);
  return Math.abs(share) < 0.005 ? "±0 %"
                                 : `${share > 0 ? "+" : ""}${minus(share.toFixed(Math.abs(share) < 10 ? 2 : 0))} %`;
}

/// The figures large at the top: they follow while a slider moves. What takes longer and is of the last state at rest
/// is left blank meanwhile.
export function tiles(a: Answer, against: Answer|null, last: Answer|null): HTMLElement[] {
  const s = a.head.summary;
  const known = (n: Number_) => shown(n, s) !== null || (last !== null && shown(n, last.head.summary) !== null);
  return kNumbers.filter((n) => n.tile && known(n)).map((n) => {
    const value = shown(n, s);
    const difference = against ? change(value, shown(n, against.head.summary), 3) : "";
    return element(
        "div", {class: "tile"}, element("span", {class: "name"}, n.name),
        element(
            "span", {class: "big"}, value === null ? "…" : text(value, n.digits), element("small", {}, ` ${n.unit}`)),
        element("span", {class: "small"}, against ? `${difference || "–"} vs ${against.name ?? "pin"}` : "\u00a0"));
  });
}

export function table(a: Answer, pinned: Answer|null): HTMLElement {
  const head =
      ["", "now", ...(pinned ? [pinned.name ?? "pin", "change"] : [])].map((t) => element("th", {scope: "col"}, t));
  const rows = kNumbers.filter((n) => shown(n, a.head.summary) !== null).map((n) => {
    const now = shown(n, a.head.summary), then = pinned ? shown(n, pinned.head.summary) : null;
    const name = element("th", {scope: "row"}, n.name, n.unit ? element("small", {}, ` [${n.unit}]`) : null);
    const further = pinned ? [element("td", {}, text(then, n.digits)), element("td", {}, change(now, then, 3))] : [];
    return element("tr", {}, name, element("td", {}, text(now, n.digits)), ...further);
  });
  return element(
      "table", {class: "numbers"}, element("thead", {}, element("tr", {}, ...head)), element("tbody", {}, ...rows));
}

/// Does it last? By zone; nothing without strengths.
export function lasting(a: Answer): HTMLElement|null {
  const found = a.head.summary.shakedown;
  if (!found) return null;
  const percent = (v: number|null|undefined) =>
      (v === null || v === undefined ? "–" : `${v >= 1 ? "+" : ""}${minus((100 * (v - 1)).toFixed(0))} %`);
  const rows = found.bodies.flatMap(
      (b) => b.zones.map(
          (z) => element(
              "tr", {}, element("th", {scope: "row"}, `${b.body}: ${z.zone}`),
              element("td", {}, text(z.factors["wandering"] ?? null, 3)),
              element("td", {}, percent(z.factors["wandering"])), element("td", {}, z.verdict))));
  const titles = ["", "factor", "reserve", "verdict"].map((t) => element("th", {scope: "col"}, t));
  const notes = found.bodies.flatMap((b) => b.notes).map((n) => element("p", {class: "note"}, n));
  return element(
      "div", {}, element("p", {class: "answer"}, `Under any traffic: ${found.verdict}`),
      element(
          "div", {class: "scroll"},
          element(
              "table", {class: "numbers"}, element("thead", {}, element("tr", {}, ...titles)),
              element("tbody", {}, ...rows))),
      ...notes);
}

/// All numbers in SI as CSV.
export function numbersCsv(a: Answer): string[][] {
  const s = a.head.summary;
  return [
    ["name", "value", "unit"], ...kNumbers.flatMap((n) => {
      const value = shown(n, s);
      return value === null ? [] : [[n.name, String(Number(value.toPrecision(12))), n.unit]];
    })
  ];
}
