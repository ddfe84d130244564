// The contact patch: maps of pressure, traction, slip and state, and the centre line.
import {element, table} from "../dom";
import type {Figure} from "../figures";
import {magnitudeScale, signedScale, stateScale} from "../scale";
import {fixedText, numberText} from "../text";
import type {Span, Values} from "../types";
import {
  columnsOf,
  option,
  unpack,
  type CentreLine,
  type Geometry,
  type Grid,
  type LoadedContact,
  type Run
} from "./data";
import {contours} from "./contours";
import {linesFigure, type Series} from "./lines";
import {mapFigure, type Arrow, type MapSpec} from "./maps";
import {quantityAt, runLabel, withoutRoundOff} from "./words";

/// A patch of a run, y from its place as in the tables; nothing outside the contact.
export interface Patch {
  run: Run;
  number: number;  // of several from 1 on, else 0
  x: number[];
  y: number[];
  p: Values[];
  q: Values[];
  qX: Values[];  // on the rail
  qY: Values[];
  slip: Values[];
  state: Values[];
}

/// Of the place of the k-th patch [mm].
export function contactY(run: Run, k = 0): number {
  return 1e3 * (run.summary.patches?.[k]?.y_m ?? run.geometry?.contact.y_m ?? 0);
}

export function patchesOf(run: Run): Patch[] {
  return [run.patch, ...run.further_patches].map((g, k) => patchOf(run, g, k));
}

function patchOf(run: Run, g: Grid, k: number): Patch {
  const touching = (v: number|null, k: number) => (g.state[k] === "0" ? null : v);
  const size = (a: Values, b: Values) => a.map((v, k) => touching(Math.hypot(v ?? 0, b[k] ?? 0), k));
  const shape = (values: Values) => columnsOf(values, g.y.length);
  return {
    run,
    number: run.further_patches.length ? k + 1 : 0,
    x: g.x,
    y: g.y.map((y) => y - contactY(run, k)),
    p: shape(unpack(g.p).map(touching)),
    q: shape(size(unpack(g.q_x), unpack(g.q_y))),
    qX: shape(unpack(g.q_x).map(touching)),
    qY: shape(unpack(g.q_y).map(touching)),
    slip: shape(size(unpack(g.slip_x), unpack(g.slip_y))),
    state: shape([...g.state].map((c) => (c === "0" ? null : Number(c)))),
  };
}

/// The largest size of a quantity, 1 where it is zero everywhere.
export function largest(patches: Patch[], quantity: (p: Patch) => Values[]): number {
  let top = 0;
  for (const v of patches.flatMap(quantity).flat())
    if (v !== null && Math.abs(v) > top) top = Math.abs(v);
  return top || 1;
}

/// A static contact without friction has neither traction nor slip to be drawn.
export function hasTraction(runs: Run[]): boolean {
  return runs.some((run) => run.patch.q_x.high - run.patch.q_x.low > 0 || run.patch.q_y.high - run.patch.q_y.low > 0);
}

/// Around every contact, with room for half a cell and a millimetre.
function touchingWindow(patches: Patch[], at: (p: Patch) => number[], touches: (p: Patch, k: number) => boolean): Span {
  let low = Infinity;
  let high = -Infinity;
  for (const patch of patches) {
    const t = at(patch);
    const room = 1 + 0.5 * Math.abs(t[1] - t[0]);
    for (const v of t.filter((_, k) => touches(patch, k))) {
      low = Math.min(low, v - room);
      high = Math.max(high, v + room);
    }
  }
  return low < high ? [low, high] : [-10, 10];
}

/// What of x and y these patches cover.
export function patchWindow(patches: Patch[]): [x: Span, y: Span] {
  return [
    touchingWindow(patches, (p) => p.x, (p, i) => p.p.some((row) => row[i] !== null)),
    touchingWindow(patches, (p) => p.y, (p, j) => p.p[j].some((v) => v !== null)),
  ];
}

/// Each from a cell's centre, as long as the traction on the rail is large; some fourteen across the window. The
/// longest, of the traction `top`, reaches a little beyond the next.
export function tractionArrows(patch: Patch, [x, y]: [Span, Span], top: number): Arrow[] {
  const spacing = Math.max(x[1] - x[0], y[1] - y[0]) / 14;
  const cell = (at: number[]) => (at.length > 1 ? Math.abs(at[1] - at[0]) : spacing);
  const [stepX, stepY] = [patch.x, patch.y].map((at) => Math.max(1, Math.round(spacing / cell(at))));
  const scale = (1.25 * Math.max(spacing, cell(patch.x))) / top;
  const out: Arrow[] = [];
  for (let j = Math.floor(stepY / 2); j < patch.y.length; j += stepY)
    for (let i = Math.floor(stepX / 2); i < patch.x.length; i += stepX) {
      const [qX, qY] = [patch.qX[j][i], patch.qY[j][i]];
      if (qX === null || qY === null || Math.hypot(qX, qY) < 0.02 * top) continue;
      out.push({x: patch.x[i], y: patch.y[j], alongX: scale * qX, alongY: scale * qY});
    }
  return out;
}

/// The states of a map that occur in it: 1 stick, 2 slip.
export function stateLegend(states: Values[]): HTMLElement {
  const there = ["stick", "slip"].filter((_, k) => states.some((row) => row.includes(k + 1)));
  return element(
      "span", {class: "legend"},
      ...there.flatMap((state) => [element("span", {class: `swatch ${state}`}), `${state} `]));
}

/// What a map shows.
interface Kind {
  id: string;
  name: string;
  values: (p: Patch) => Values[];
  column: string;
  hover: string;
  bar: string;
  state?: boolean;
  signed?: boolean;
  arrows?: boolean;
}

const kKinds: Kind[] = [
  {id: "p", name: "Pressure p", values: (p) => p.p, column: "p_MPa", hover: "p %{z:.1f} MPa", bar: "MPa"},
  {
    id: "q",
    name: "Traction |q|",
    values: (p) => p.q,
    column: "q_MPa",
    hover: "|q| %{z:.1f} MPa",
    bar: "MPa",
    arrows: true,
  },
  {
    id: "qx",
    name: "Traction q_x along the rail",
    values: (p) => p.qX,
    column: "q_x_MPa",
    hover: "q_x %{z:.1f} MPa",
    bar: "MPa",
    signed: true,
  },
  {
    id: "qy",
    name: "Traction q_y across the rail",
    values: (p) => p.qY,
    column: "q_y_MPa",
    hover: "q_y %{z:.1f} MPa",
    bar: "MPa",
    signed: true,
  },
  {
    id: "slip",
    name: "Slip velocity",
    values: (p) => p.slip,
    column: "slip_mm_s",
    hover: "slip %{z:.2f} mm/s",
    bar: "mm/s",
  },
  {
    id: "state",
    name: "Stick and slip",
    values: (p) => p.state,
    column: "state_1stick_2slip",
    hover: "%{text}",
    bar: "",
    state: true,
  },
];

export const kAboutArrows = "Arrows: the traction on the rail; on the wheel it is the opposite.";
const kAboutSigns: Record<string, string> = {
  qx: "On the rail, positive in the rolling direction: a driving wheel pushes the rail backwards.",
  qy: "On the rail in the contact plane, positive to the field side.",
};

/// What a map of states has other than one of numbers up to `top`.
function scaleOf(kind: Kind, top: number, patch: Patch): Pick<MapSpec, "words"|"scale"|"bar"|"valueWords"> {
  const words = kind.arrows ? [kAboutArrows] : kind.signed ? [kAboutSigns[kind.id]] : undefined;
  if (kind.signed) return {scale: signedScale(top), bar: kind.bar, words};
  if (!kind.state) return {scale: magnitudeScale(top), bar: kind.bar, words};
  const valueWords = ["separated", "stick", "slip"];
  return {words: [stateLegend(patch.state)], scale: stateScale, valueWords};
}

/// What a map is called: by its run where there are several, by its patch likewise.
function mapTitle(kind: Kind, patch: Patch, several: boolean): string {
  const whose = several ? `, ${runLabel(patch.run)}` : "";
  return `${kind.name}${whose}${patch.number ? `, patch ${patch.number}` : ""}`;
}

/// Slip of a shift is a distance.
function kindOf(kind: Kind, run: Run): Kind {
  const unit = run.patch.slip_unit;
  if (kind.id !== "slip" || unit === "mm/s") return kind;
  return {...kind, name: "Slip of the last increment", column: "slip_um", hover: `slip %{z:.4f} ${unit}`, bar: unit};
}

/// Lines of equal value over the coloured cells.
const kLevels = [0.05, 0.2, 0.4, 0.6, 0.8, 0.95];  // of the largest

export function levelsOf(top: number, signed = false): number[] {
  const levels = kLevels.map((share) => share * top);
  return signed ? [...levels.map((l) => -l), ...levels] : levels;
}

/// Six maps for each patch of each run, those of one quantity in one unit on one scale.
export function patchMaps(runs: Run[]): Figure[] {
  const patches = runs.flatMap(patchesOf);
  const [windowX, windowY] = patchWindow(patches);
  const mapOf = (kind: Kind, top: number, patch: Patch, n: number) => mapFigure({
    id: `map-${kind.id}-${n}`,
    title: mapTitle(kind, patch, runs.length > 1),
    z: kind.values(patch),
    centresX: patch.x,
    centresY: patch.y,
    names: ["x_mm", "y_mm", kind.column],
    labels: ["x, rolling direction [mm]", "y, field side up [mm]"],
    hover: kind.hover,
    hoverY: "y",
    ...scaleOf(kind, top, patch),
    windowX,
    windowY,
    lines: kind.state ? undefined : contours(patch.x, patch.y, kind.values(patch), levelsOf(top, kind.signed)),
    arrows: kind.arrows ? tractionArrows(patch, [windowX, windowY], top) : undefined,
    marker: {x: 0, y: 0, text: "place of the patch"},
  });
  return kKinds.slice(0, hasTraction(runs) ? kKinds.length : 1).flatMap((kind) => patches.map((patch, n) => {
    const own = kindOf(kind, patch.run);
    const alike = patches.filter((p) => kindOf(kind, p.run).bar === own.bar);
    return mapOf(own, largest(alike, kind.values), patch, n);
  }));
}

/// The centre lines of a run's patches, the first has the largest pressure.
function linesOf(run: Run): CentreLine[] { return [run.centre_line, ...run.further_centre_lines]; }

/// ", patch 2" where there are several.
function ofPatch(run: Run, k: number): string { return run.further_centre_lines.length ? `, patch ${k + 1}` : ""; }

/// A line of each run and patch along x.
function runLines(runs: Run[], values: (line: CentreLine) => number[], symbol: string): Series[] {
  const hover = `x %{x:.2f} mm\n${symbol} %{y:.1f} MPa`;
  return runs.flatMap((run, n) => linesOf(run).map((line, k): Series => ({
                                                     name: runLabel(run) + ofPatch(run, k),
                                                     x: line.x_mm,
                                                     y: values(line),
                                                     markers: line.x_mm.length < 60,
                                                     colour: (t) => t.series[(n + runs.length * k) % t.series.length],
                                                     hover,
                                                   })));
}

function tractionOf(line: CentreLine): number[] {
  return line.p_MPa.map((_, i) => Math.hypot(line.q_x_MPa[i], line.q_y_MPa[i]));
}

function hertzLine({a_m, p0_Pa}: LoadedContact["hertz"], name: string): Series {
  const x = Array.from({length: 121}, (_, i) => 1e3 * a_m * -Math.cos((Math.PI * i) / 120));
  const y = x.map((v) => 1e-6 * p0_Pa * Math.sqrt(Math.max(0, 1 - (v / (1e3 * a_m)) ** 2)));
  const hover = "x %{x:.2f} mm\np %{y:.1f} MPa";
  return {name, x, y, colour: (t) => t.reference, dash: name.endsWith("2") ? "dashdot" : "dot", hover};
}

/// Hertz's pressure of each contact, under the load that it bears.
function hertzLines(g: Geometry): Series[] {
  if (!g.patches) return [hertzLine(g.hertz, "Hertz, no layer")];
  return g.patches.map((p, k) => hertzLine(p.hertz, `Hertz, no layer, patch ${k + 1}`));
}

function limitLine(run: Run, line: CentreLine, k: number, friction: number): Series {
  const y = line.p_MPa.map((v) => friction * v);
  const hover = "x %{x:.2f} mm\nf p %{y:.1f} MPa";
  const name = `limit f p, f = ${friction}${ofPatch(run, k)}`;
  return {name, x: line.x_mm, y, colour: (t) => t.reference, dash: k === 0 ? "dash" : "dashdot", hover};
}

const kAboutHertz = " Hertz’s ellipse takes the curvatures at the rigid contact point and knows no layer: " +
    "a reference, not a target.";
const kAboutTraction = "Magnitude of the tangential traction on the rail. " +
    "Where it meets the limit f p (of the first run) the surfaces slip.";

/// Pressure and traction along x through the largest pressure, all runs and Hertz's.
export function centreLines(runs: Run[]): Figure[] {
  const pressure = runLines(runs, (line) => line.p_MPa, "p");
  const traction = runLines(runs, tractionOf, "|q|");
  const geometry = runs.find((r) => r.geometry)?.geometry;
  if (geometry) pressure.push(...hertzLines(geometry));
  const friction = Number(option(runs[0], "drive", "friction_coefficient") ?? NaN);
  if (Number.isFinite(friction) && friction > 0)
    traction.push(...linesOf(runs[0]).map((line, k) => limitLine(runs[0], line, k, friction)));
  const touching = runs.flatMap(linesOf).flatMap((line) => line.x_mm.filter((_, i) => line.p_MPa[i] > 0));
  const window: Span = [Math.min(...touching) - 2, Math.max(...touching) + 2];
  const placesOf = (r: Run) => linesOf(r).map((line, k) => `${fixedText(line.y[0] - contactY(r, k), 2)} mm`);
  const at = runs.flatMap(placesOf).join(" and ");
  const line = `Along the rolling direction through the largest pressure, at y = ${at} from the place of the patch; ` +
      "the leading edge is on the right.";
  const pressureFigure = linesFigure({
    id: "centre-p",
    title: "Pressure on the centre line",
    labels: ["x, rolling direction [mm]", "p [MPa]"],
    names: ["x_mm", "p_MPa"],
    series: pressure,
    window,
    words: [line + (geometry ? kAboutHertz : "")],
  });
  if (!hasTraction(runs)) return [pressureFigure];
  const tractionFigure = linesFigure({
    id: "centre-q",
    title: "Traction on the centre line",
    labels: ["x, rolling direction [mm]", "|q| [MPa]"],
    names: ["x_mm", "q_MPa"],
    series: traction,
    window,
    words: [kAboutTraction],
  });
  return [pressureFigure, tractionFigure];
}

/// The patches of wheels that touch at several places, a row each.
export function patchesTable(runs: Run[]): HTMLElement|null {
  const keys = ["contact_angle_rad", "F_x_N", "F_y_N", "F_z_N", "p_max_Pa", "patch_area_m2", "spin_per_m"];
  const columns = keys.map((key) => quantityAt(`contact/${key}`));
  const rows = runs.flatMap((run) => (run.summary.patches ?? []).map((patch, k) => {
    const numberOf = (path: string) => patch[path.replace("contact/", "")] ?? null;
    const numbers = columns.map(({path, unit}) => {
      const value = withoutRoundOff(path, numberOf(path), numberOf);
      return numberText(value === null ? null : unit.factor * value);
    });
    const name = `${runs.length > 1 ? `${runLabel(run)}, ` : ""}${k + 1}`;
    return [name, numberText(patch.rail_y_m === null ? null : 1e3 * patch.rail_y_m), ...numbers];
  }));
  if (!rows.length) return null;
  const names = columns.map(({label, unit}) => `${label} [${unit.shown}]`);
  const head = ["patch", "y of the rail [mm]", ...names];
  return table("The patches share the load", head, rows, {class: "numbers", id: "patches"});
}
