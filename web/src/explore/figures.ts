// The explorer's figures: patch, centre line, stresses below. Millimetres and MPa.
import {stepOf} from "../axes";
import type {Cells, Chart, Curve} from "../chart";
import {element} from "../dom";
import {columnEdges, rowEdges} from "../edges";
import {drawAll, type DataTable, type Figure} from "../figures";
import {magnitudeScale, signedScale, stateScale, type Scale} from "../scale";
import {fixedText, numberText} from "../text";
import {kLight, type Theme} from "../theme";
import type {Span, Values} from "../types";
import {numbersOf, type Answer, type SectionHead, type Slice} from "./types";

/// What the figures show: the state now, the one before the last change, the pinned one.
export interface Shown {
  now: Answer;
  before: Answer|null;
  pinned: Answer|null;
}

let shown: Shown|null = null;

/// Draws all figures anew.
export function show(state: Shown|null): void {
  shown = state;
  drawAll(kLight);
}

/// The next round number above, so that scales jump seldom.
function roundUp(value: number): number {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  return power * ([1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].find((f) => f * power >= value) ?? 10);
}

const scaled = (a: Answer, s: Slice, factor: number) => Array.from(numbersOf(a, s), (v) => factor * v);
const largest = (values: number[]) => values.reduce((a, b) => Math.max(a, b), 0);
const empty = (names: string[]): DataTable => ({names, rows: []});

// ---- the patch

/// A patch in millimetres: index column + columns * station.
interface Grid {
  x: number[];
  y: number[];
  of: (name: "p"|"q_x"|"q_y"|"slip_x"|"slip_y"|"state", factor?: number) => number[];
}

function gridOf(a: Answer|null|undefined): Grid|null {
  const head = a?.head.patch;
  if (!a || !head || head.stations === 0) return null;
  const {stations, columns} = head;
  const at = (slice: Slice, k: number) => 1e3 * (numbersOf(a, slice)[k] ?? 0);
  // evenly spaced: of single precision
  const spread = (n: number, low: number, high: number) =>
      Array.from({length: n}, (_, k) => low + (n > 1 ? k / (n - 1) : 0) * (high - low));
  return {
    x: spread(stations, at(head.x, 0), at(head.x, columns * (stations - 1))),
    y: spread(columns, at(head.y, 0), at(head.y, columns - 1)),
    of: (name, factor = 1) => scaled(a, head[name], factor),
  };
}

interface Window {
  x: Span;
  y: Span;
}

/// Around all of the patches, to round numbers: it jumps seldom.
function windowOf(grids: (Grid|null)[]): Window {
  const [low, high] = [[Infinity, Infinity], [-Infinity, -Infinity]];
  for (const g of grids)
    g?.of("p").forEach((p, k) => {
      if (!(p > 0)) return;
      const at = [g.x[Math.floor(k / g.y.length)], g.y[k % g.y.length]];
      at.forEach((v, n) => [low[n], high[n]] = [Math.min(low[n], v), Math.max(high[n], v)]);
    });
  if (!(low[0] < high[0])) return {x: [-10, 10], y: [-10, 10]};
  const span = (n: number): Span => {
    const half = 2 * Math.ceil((0.5 * (high[n] - low[n]) + 0.8) / 2);
    const middle = Math.round(0.5 * (high[n] + low[n]));
    return [middle - half, middle + half];
  };
  return {x: span(0), y: span(1)};
}

/// A row for each column of cells; nothing outside the contact.
function rowsOfPatch(g: Grid, values: number[], there: number[]): Values[] {
  const at = (i: number, j: number) => j + g.y.length * i;
  return g.y.map((_, j) => g.x.map((_x, i) => (there[at(i, j)] > 0 ? values[at(i, j)] : null)));
}

/// The border of what bears pressure, along the cells.
function outline(g: Grid, dash: Curve["dash"], theme: Theme): Curve {
  const p = g.of("p");
  const pressed = (i: number, j: number) =>
      i >= 0 && j >= 0 && i < g.x.length && j < g.y.length && p[j + g.y.length * i] > 0;
  const [ex, ey] = [columnEdges(g.x), columnEdges(g.y)];
  const x: Values = [];
  const y: Values = [];
  for (let i = 0; i <= g.x.length; ++i)
    for (let j = 0; j <= g.y.length; ++j) {
      if (j < g.y.length && pressed(i - 1, j) !== pressed(i, j)) {
        x.push(ex[i], ex[i], null);
        y.push(ey[j], ey[j + 1], null);
      }
      if (i < g.x.length && pressed(i, j - 1) !== pressed(i, j)) {
        x.push(ex[i], ex[i + 1], null);
        y.push(ey[j], ey[j], null);
      }
    }
  return {name: "", x, y, colour: theme.ink, width: 1.5, dash};
}

/// Of the traction on the rail, from the middle of every so many cells.
function arrows(g: Grid, top: number): Curve {
  const [q_x, q_y, p] = [g.of("q_x", 1e-6), g.of("q_y", 1e-6), g.of("p")];
  const dx = g.x.length > 1 ? Math.abs(g.x[1] - g.x[0]) : 1;
  const every = Math.max(1, Math.round(1.25 / dx));
  const length = (1.15 * every * dx) / top;
  const x: Values = [];
  const y: Values = [];
  for (let i = every >> 1; i < g.x.length; i += every)
    for (let j = every >> 1; j < g.y.length; j += every) {
      const k = j + g.y.length * i;
      const [u, v] = [q_x[k] * length, q_y[k] * length];
      if (!(p[k] > 0) || Math.hypot(u, v) < 0.1 * dx * every) continue;
      const [x1, y1] = [g.x[i] + 0.5 * u, g.y[j] + 0.5 * v];
      const head = (side: number) =>
          [x1 - 0.3 * (u * Math.cos(side) - v * Math.sin(side)), y1 - 0.3 * (v * Math.cos(side) + u * Math.sin(side))];
      const [left, right] = [head(0.5), head(-0.5)];
      x.push(x1 - u, x1, null, left[0], x1, right[0], null);
      y.push(y1 - v, y1, null, left[1], y1, right[1], null);
    }
  return {name: "", x, y, colour: "#ffffff", halo: "#1b1f24", width: 1.2};
}

function fieldTable(): DataTable {
  const names = ["x_m", "y_m", "p_Pa", "q_x_Pa", "q_y_Pa", "slip_x_m_per_s", "slip_y_m_per_s", "state"];
  const g = gridOf(shown?.now);
  if (!g) return empty(names);
  const fields = (["p", "q_x", "q_y", "slip_x", "slip_y", "state"] as const).map((name) => g.of(name));
  const row = (k: number) => [1e-3 * g.x[Math.floor(k / g.y.length)], 1e-3 * g.y[k % g.y.length]];
  return {names, rows: fields[0].map((_, k) => [...row(k), ...fields.map((f) => f[k])])};
}

/// What a map of the patch shows of it; with the state before for the scale.
interface PatchLook {
  values: (g: Grid) => number[];
  scale: (grids: Grid[]) => Scale;
  unit?: string;
  words: (v: number) => string;
  arrows?: boolean;
}

function patchFigure(id: string, title: string, words: (string|Node)[], look: PatchLook): Figure {
  const chart = (theme: Theme): Chart|null => {
    const g = gridOf(shown?.now);
    if (!g) return null;
    const [ghost, pinned] = [gridOf(shown!.before), gridOf(shown!.pinned)];
    const window = windowOf([g, ghost, pinned]);
    const z = rowsOfPatch(g, look.values(g), look.scale === states ? g.of("state") : g.of("p"));
    const scale = look.scale([g, ...(ghost ? [ghost] : [])]);
    const cells: Cells = {
      x: columnEdges(g.x),
      y: columnEdges(g.y),
      at: {x: g.x, y: g.y},
      z,
      scale,
      words: (i, j) => `x ${fixedText(g.x[i], 2)} mm, y ${fixedText(g.y[j], 2)} mm\n${look.words(z[j][i]!)}`,
    };
    return {
      x: {title: "x rolling → [mm]", range: window.x},
      y: {title: "y [mm]", range: window.y},
      height: 330,
      equal: true,
      cells,
      curves: [
        ...(look.arrows ? [arrows(g, scale.range[1])] : []),
        ...(ghost ? [outline(ghost, "solid", theme)] : []),
        ...(pinned ? [outline(pinned, "dot", theme)] : []),
      ],
      bar: look.unit ? {unit: look.unit} : undefined,
    };
  };
  return {id, title, words, chart, table: fieldTable};
}

const inMPa = (values: (g: Grid) => number[]) => ({
  values,
  scale: (grids: Grid[]) => magnitudeScale(roundUp(Math.max(...grids.map((g) => largest(values(g)))))),
  unit: "MPa",
});
const sizes = (g: Grid) => {
  const q_y = g.of("q_y", 1e-6);
  return g.of("q_x", 1e-6).map((v, k) => Math.hypot(v, q_y[k]));
};
const states = () => stateScale;

export function patchFigures(): Figure[] {
  const pressure = {...inMPa((g) => g.of("p", 1e-6)), words: (v: number) => `p ${fixedText(v, 1)} MPa`};
  const traction = {...inMPa(sizes), words: (v: number) => `|q| ${fixedText(v, 1)} MPa`, arrows: true};
  const state = {values: (g: Grid) => g.of("state"), scale: states, words: (v: number) => (v === 2 ? "slip" : "stick")};
  const entry = (kind: string) => element("span", {class: "entry"}, element("span", {class: `swatch ${kind}`}), kind);
  return [
    patchFigure(
        "pressure", "Pressure", ["Line: the border of the patch before the last change; dotted: of the pin."],
        pressure),
    patchFigure("traction", "Traction on the rail", ["Colour: size; arrows: direction."], traction),
    patchFigure("state", "Stick and slip", [entry("stick"), entry("slip")], state),
  ];
}

// ---- the centre line

interface Line {
  x: number[];
  p: number[];
  q: number[];
}

function centreOf(a: Answer|null|undefined): Line|null {
  const head = a?.head.patch;
  if (!a || !head) return null;
  return {x: scaled(a, head.centre_x, 1e3), p: scaled(a, head.centre_p, 1e-6), q: scaled(a, head.centre_q_x, 1e-6)};
}

function centreCurves(now: Line, theme: Theme): Curve[] {
  const words = (name: string) => (x: number, y: number) => `x ${fixedText(x, 2)} mm\n${name} ${fixedText(y, 1)} MPa`;
  const friction = shown!.now.head.values["drive.friction_coefficient"] ?? 0;
  const [before, pinned] = [centreOf(shown!.before), centreOf(shown!.pinned)];
  const size = (l: Line) => l.q.map(Math.abs);
  const quiet = {colour: theme.soft, width: 1.5};
  const both = (l: Line|null, dash: "dash"|"dot", name: string): Curve[] => (l ? [
    {...quiet, name, x: l.x, y: l.p, dash, words: words(`p, ${name}`)},
    {...quiet, name, x: l.x, y: size(l), dash, quiet: true, words: words(`|q_x|, ${name}`)},
  ] : []);
  const others = [...both(before, "dash", "before"), ...both(pinned, "dot", shown!.pinned?.name ?? "pin")];
  return [
    ...others,
    {name: "f p", x: now.x, y: now.p.map((v) => friction * v), colour: theme.soft, width: 1, dash: "dot"},
    {name: "pressure", x: now.x, y: now.p, colour: "#7a3b9a", width: 2, words: words("p")},
    {name: "|q_x|", x: now.x, y: size(now), colour: "#d55e00", width: 2, words: words("|q_x|")},
  ];
}

export function centreFigure(): Figure {
  const chart = (theme: Theme): Chart|null => {
    const now = centreOf(shown?.now);
    if (!now) return null;
    const all = [now, centreOf(shown!.before), centreOf(shown!.pinned)].filter((l): l is Line => l !== null);
    const reach = all.flatMap((l) => l.x.filter((_, k) => l.p[k] > 0)).map(Math.abs);
    const end = 2 * Math.ceil((Math.max(1, largest(reach)) + 0.6) / 2);
    return {
      x: {title: "x rolling → [mm]", range: [-end, end]},
      y: {title: "MPa", range: [0, roundUp(1.02 * Math.max(...all.map((l) => largest(l.p))))]},
      height: 202,
      grid: true,
      legend: true,
      curves: centreCurves(now, theme),
    };
  };
  const table = (): DataTable => {
    const l = centreOf(shown?.now);
    const names = ["x_mm", "p_MPa", "q_x_MPa"];
    return l ? {names, rows: l.x.map((x, k) => [x, l.p[k], l.q[k]])} : empty(names);
  };
  return {id: "centre-line", title: "Centre line", chart, table};
}

// ---- stresses below

type Measure = "von_mises"|"tau_xz"|"sigma_1";
const kMeasures: Record<Measure, string> = {
  von_mises: "von Mises",
  tau_xz: "shear τ_xz",
  sigma_1: "largest principal σ₁"
};

export interface Choice {
  node: HTMLSelectElement;
  value(): Measure;
}
export function measureChoice(changed: () => void): Choice {
  const options = Object.entries(kMeasures).map(([value, words]) => element("option", {value}, words));
  const node = element("select", {"aria-label": "stress that is shown"}, ...options);
  node.onchange = changed;
  return {node, value: () => node.value as Measure};
}

interface Below {
  along: number[];
  depth: number[];
  rows: number[][];
}
function belowOf(a: Answer|null|undefined, which: "section"|"cross", measure: Measure): Below|null {
  const head: SectionHead|undefined = a?.head[which];
  if (!a || !head) return null;
  const [along, depth, values] =
      [scaled(a, head.along, 1e3), scaled(a, head.depth, 1e3), scaled(a, head[measure], 1e-6)];
  return {along, depth, rows: depth.map((_, r) => values.slice(r * along.length, (r + 1) * along.length))};
}

/// Depths of the rail's interfaces, mm.
function interfaces(a: Answer): number[] {
  let depth = 0;
  return a.head.layers.filter((l) => l.on === "rail").map((l) => (depth += 1e3 * l.thickness));
}

/// Of the rail, through the patch's centre line or across it.
export function sectionFigure(choice: Choice, which: "section"|"cross"): Figure {
  const along = which === "section";
  const chart = (): Chart|null => {
    const b = belowOf(shown?.now, which, choice.value());
    if (!b) return null;
    const window = windowOf([gridOf(shown!.now)]);
    const span = along ? window.x : window.y;
    const y = rowEdges(b.depth);
    const signed = choice.value() !== "von_mises";
    const top = roundUp(largest(b.rows.flat().map(Math.abs)));
    const place = (i: number, j: number) =>
        `${along ? "x" : "y"} ${fixedText(b.along[i], 2)} mm, depth ${fixedText(b.depth[j], 2)} mm`;
    return {
      x: {title: along ? "x rolling → [mm]" : "y [mm]", range: span},
      y: {title: "depth [mm]", range: [Math.min(y[y.length - 1], span[1] - span[0]), 0]},
      height: 202,
      cells: {
        x: columnEdges(b.along),
        y,
        at: {x: b.along, y: b.depth},
        z: b.rows,
        scale: signed ? signedScale(top) : magnitudeScale(top),
        words: (i, j) => `${place(i, j)}\n${kMeasures[choice.value()]} ${fixedText(b.rows[j][i], 1)} MPa`,
      },
      curves: interfaces(shown!.now).map((d) => ({
                                           name: "",
                                           x: span,
                                           y: [d, d],
                                           colour: signed ? "#1b1f24" : "#ffffff",
                                           width: 1,
                                         })),
      bar: {unit: "MPa"},
    };
  };
  const table = (): DataTable => {
    const names = [along ? "x_mm" : "y_mm", "depth_mm", `${choice.value()}_MPa`];
    const b = belowOf(shown?.now, which, choice.value());
    return b ? {names, rows: b.rows.flatMap((row, j) => row.map((v, i) => [b.along[i], b.depth[j], v]))} : empty(names);
  };
  const [id, title] =
      along ? ["section", "Stress below, along the rail"] : ["cross-section", "Stress below, across the rail"];
  return {id, title, words: ["Lines: where a layer ends."], controls: along ? [choice.node] : [], chart, table};
}

/// The largest of each depth.
const overDepth = (b: Below) => b.rows.map((row) => row.reduce((top, v) => (Math.abs(v) > Math.abs(top) ? v : top), 0));

export function depthFigure(choice: Choice): Figure {
  const of = (a: Answer|null|undefined) => {
    const b = belowOf(a, "section", choice.value());
    return b && {depth: b.depth, top: overDepth(b)};
  };
  const chart = (theme: Theme): Chart|null => {
    const now = of(shown?.now);
    if (!now) return null;
    const others = ([[shown!.before, "dash"], [shown!.pinned, "dot"]] as const).flatMap(([a, dash]) => {
      const line = of(a);
      return line ? [{...line, dash}] : [];
    });
    const values = [now, ...others].flatMap((l) => l.top);
    const least = Math.min(0, ...values);
    const words = (v: number, depth: number) =>
        `depth ${fixedText(depth, 2)} mm\n${kMeasures[choice.value()]} ${numberText(v)} MPa`;
    const quiet = {name: "", colour: theme.soft, width: 1.5};
    return {
      x: {
        title: `${kMeasures[choice.value()]} [MPa]`,
        range: [least < 0 ? -roundUp(-least) : 0, roundUp(largest(values))]
      },
      y: {title: "depth [mm]", range: [4 * stepOf(Math.max(...now.depth), 4), 0]},
      height: 202,
      grid: true,
      levels: interfaces(shown!.now),
      curves: [
        ...others.map(({depth, top, dash}): Curve => ({...quiet, x: top, y: depth, dash, words})),
        {name: "", x: now.top, y: now.depth, colour: "#7a3b9a", width: 2, words},
      ],
    };
  };
  const table = (): DataTable => {
    const now = of(shown?.now);
    const names = ["depth_mm", `${choice.value()}_MPa`];
    return now ? {names, rows: now.depth.map((d, k) => [d, now.top[k]])} : empty(names);
  };
  const words =
      ["Largest in the section along the rail. Dashed: before; dotted: pin; lines across: where a layer ends."];
  return {id: "depth", title: "Stress over depth", words, chart, table};
}
