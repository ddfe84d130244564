// The page's figures: patch, centre line, stresses below. Millimetres and MPa.
import {element} from "../dom";
import {colourAt, colourBar, Plot, prepare, roundUp, stepOf, theme, type Axis, type Theme} from "./canvas";
import {numbersOf, type Answer, type SectionHead, type Slice} from "./types";

const kStick = "#0072b2", kSlip = "#e69f00", kPressure = "#7a3b9a", kTraction = "#d55e00";

/// What a figure shows: the state now, the one before the last change, the pinned one.
export interface Shown {
  now: Answer;
  before: Answer|null;
  pinned: Answer|null;
}

export interface Figure {
  node: HTMLElement;
  draw(shown: Shown|null): void;
  /// Head and rows, of what is shown.
  table(answer: Answer): string[][];
}

/// A patch in millimetres: y from its middle column's cells, index column + columns * station.
interface Grid {
  x: Float64Array;
  y: Float64Array;
  dx: number;
  dy: number;
  stations: number;
  columns: number;
  of: (name: "p"|"q_x"|"q_y"|"slip_x"|"slip_y"|"state") => Float32Array;
}

function gridOf(a: Answer): Grid|null {
  const head = a.head.patch;
  if (!head || head.stations === 0) return null;
  const all = (s: Slice) => numbersOf(a, s);
  const first = (slice: Slice, k: number) => 1e3 * (all(slice)[k] ?? 0);
  // evenly spaced: single precision must leave no seams between cells
  const spread = (n: number, low: number, high: number): [Float64Array, number] => {
    const step = n > 1 ? (high - low) / (n - 1) : 1;
    return [Float64Array.from({length: n}, (_, k) => low + k * step), Math.abs(step)];
  };
  const last = head.columns * (head.stations - 1);
  const [x, dx] = spread(head.stations, first(head.x, 0), first(head.x, last));
  const [y, dy] = spread(head.columns, first(head.y, 0), first(head.y, head.columns - 1));
  return {x, y, dx, dy, stations: head.stations, columns: head.columns, of: (name) => all(head[name])};
}

interface Window {
  x: [number, number];
  y: [number, number];
}

/// Around all of the patches, to round numbers: it jumps seldom.
function windowOf(grids: Grid[]): Window {
  let low = [Infinity, Infinity], high = [-Infinity, -Infinity];
  for (const g of grids) {
    const p = g.of("p");
    for (let i = 0; i < g.stations; ++i)
      for (let j = 0; j < g.columns; ++j)
        if (p[j + g.columns * i]! > 0) {
          low = [Math.min(low[0]!, g.x[i]!), Math.min(low[1]!, g.y[j]!)];
          high = [Math.max(high[0]!, g.x[i]!), Math.max(high[1]!, g.y[j]!)];
        }
  }
  if (!(low[0]! < high[0]!)) return {x: [-10, 10], y: [-10, 10]};
  const half = (k: number) => 2 * Math.ceil((0.5 * (high[k]! - low[k]!) + 0.8) / 2);
  const middle = (k: number) => Math.round(0.5 * (high[k]! + low[k]!));
  const span = (k: number): [number, number] => [middle(k) - half(k), middle(k) + half(k)];
  return {x: span(0), y: span(1)};
}

function frame(title: string, caption: string, extra: HTMLElement[] = []): [HTMLElement, HTMLCanvasElement] {
  const canvas = element("canvas", {role: "img", "aria-label": title});
  const head = element("div", {class: "head"}, element("h3", {}, title), ...extra);
  return [
    element("figure", {}, head, element("div", {class: "place"}, canvas), element("figcaption", {}, caption)), canvas
  ];
}

/// A plot of the patch's plane: x rolling, y across, both to one scale as far as the width goes.
function patchPlot(canvas: HTMLCanvasElement, w: Window): Plot|null {
  const left = 56, right = 58, top = 8, bottom = 38;
  const place = canvas.parentElement?.clientWidth ?? 0;
  const wide = place - left - right;
  if (wide < 60) return null;
  const ratio = (w.y[1] - w.y[0]) / (w.x[1] - w.x[0]);
  const height = Math.min(Math.max(wide * ratio, 120), 330);
  const width = Math.min(wide, height / ratio);
  const g = prepare(canvas, height + top + bottom);
  if (!g) return null;
  const box = {left, top, width, height: Math.min(height, width * ratio)};
  return new Plot(
      g, box, {low: w.x[0], high: w.x[1], title: "x rolling → [mm]"}, {low: w.y[0], high: w.y[1], title: "y [mm]"},
      theme());
}

function cells(p: Plot, g: Grid, colour: (k: number) => string | null): void {
  const w = p.box.width / (p.x.high - p.x.low) * g.dx, h = p.box.height / (p.y.high - p.y.low) * g.dy;
  p.clip(() => {
    for (let i = 0; i < g.stations; ++i)
      for (let j = 0; j < g.columns; ++j) {
        const c = colour(j + g.columns * i);
        if (c === null) continue;
        const x = p.atX(g.x[i]!), y = p.atY(g.y[j]!);
        p.fill(c, x - w / 2, y - h / 2, x + w / 2, y + h / 2);
      }
  });
}

/// The border of what bears pressure, along the cells.
function outline(p: Plot, g: Grid, colour: string, dash: number[] = []): void {
  const pressed = (i: number, j: number) =>
      i >= 0 && j >= 0 && i < g.stations && j < g.columns && g.of("p")[j + g.columns * i]! > 0;
  const hx = 0.5 * g.dx, hy = 0.5 * g.dy;
  p.clip(() => {
    p.g.strokeStyle = colour;
    p.g.lineWidth = 1.5;
    p.g.setLineDash(dash);
    p.g.beginPath();
    const side = (x0: number, y0: number, x1: number, y1: number) => {
      p.g.moveTo(p.atX(x0), p.atY(y0));
      p.g.lineTo(p.atX(x1), p.atY(y1));
    };
    for (let i = -1; i < g.stations; ++i)
      for (let j = -1; j < g.columns; ++j) {
        const x = i < 0 ? g.x[0]! : g.x[i]!, y = j < 0 ? g.y[0]! : g.y[j]!;
        const here = pressed(i, j);
        if (j >= 0 && here !== pressed(i + 1, j)) side(x + hx, y - hy, x + hx, y + hy);
        if (i >= 0 && here !== pressed(i, j + 1)) side(x - hx, y + hy, x + hx, y + hy);
      }
    p.g.stroke();
  });
}

function arrows(p: Plot, g: Grid, top: number): void {
  const q_x = g.of("q_x"), q_y = g.of("q_y"), pressure = g.of("p");
  const every = Math.max(1, Math.round(1.25 / g.dx));
  const length = p.box.width / (p.x.high - p.x.low) * 1.15 * every * g.dx / top;
  p.clip(() => {
    p.g.strokeStyle = "rgba(255,255,255,0.9)";
    p.g.lineWidth = 1.2;
    for (let i = every >> 1; i < g.stations; i += every)
      for (let j = every >> 1; j < g.columns; j += every) {
        const k = j + g.columns * i;
        const u = q_x[k]! * length, v = -q_y[k]! * length;
        if (!(pressure[k]! > 0) || Math.hypot(u, v) < 2) continue;
        const x = p.atX(g.x[i]!) - u / 2, y = p.atY(g.y[j]!) - v / 2;
        const size = Math.min(4, 0.4 * Math.hypot(u, v)), angle = Math.atan2(v, u);
        p.g.beginPath();
        p.g.moveTo(x, y);
        p.g.lineTo(x + u, y + v);
        for (const turn of [2.6, -2.6]) {
          p.g.moveTo(x + u, y + v);
          p.g.lineTo(x + u + size * Math.cos(angle + turn), y + v + size * Math.sin(angle + turn));
        }
        p.g.stroke();
      }
  });
}

function fieldTable(a: Answer): string[][] {
  const g = gridOf(a);
  if (!g) return [];
  const names = ["p", "q_x", "q_y", "slip_x", "slip_y", "state"] as const;
  const fields = names.map((n) => g.of(n));
  const rows = [["x_m", "y_m", "p_Pa", "q_x_Pa", "q_y_Pa", "slip_x_m_per_s", "slip_y_m_per_s", "state"]];
  for (let i = 0; i < g.stations; ++i)
    for (let j = 0; j < g.columns; ++j) {
      const k = j + g.columns * i;
      const at = [1e-3 * g.x[i]!, 1e-3 * g.y[j]!].map((v) => String(Number(v.toPrecision(6))));
      rows.push([...at, ...fields.map((f) => String(Number(f[k]!.toPrecision(7))))]);
    }
  return rows;
}

type Paint = (p: Plot, g: Grid, all: Grid[], colours: Theme) => void;

function patchFigure(title: string, caption: string, paint: Paint): Figure {
  const [node, canvas] = frame(title, caption);
  const draw = (s: Shown|null) => {
    const g = s && gridOf(s.now);
    if (!s || !g) return;
    const ghost = s.before && gridOf(s.before), pinned = s.pinned && gridOf(s.pinned);
    const all = [g, ...(ghost ? [ghost] : [])];
    const p = patchPlot(canvas, windowOf([...all, ...(pinned ? [pinned] : [])]));
    if (!p) return;
    p.axes();
    paint(p, g, all, p.colours);
    if (ghost) outline(p, ghost, p.colours.ink);
    if (pinned) outline(p, pinned, p.colours.ink, [2, 3]);
  };
  return {node, draw, table: fieldTable};
}

const largest = (values: Float32Array) => values.reduce((a, b) => Math.max(a, b), 0);

export function pressureMap(): Figure {
  return patchFigure(
      "Pressure", "Line: the border of the patch before the last change; dotted: of the pin.", (p, g, all) => {
        const top = roundUp(1e-6 * Math.max(...all.map((one) => largest(one.of("p")))));
        const values = g.of("p");
        cells(p, g, (k) => (values[k]! > 0 ? colourAt(1e-6 * values[k]! / top) : null));
        colourBar(p, 0, top, "MPa");
      });
}

const sizes = (g: Grid) => {
  const q_x = g.of("q_x"), q_y = g.of("q_y");
  return q_x.map((v, k) => Math.hypot(v, q_y[k]!));
};

export function tractionMap(): Figure {
  return patchFigure("Traction on the rail", "Colour: size; arrows: direction.", (p, g, all) => {
    const top = roundUp(1e-6 * Math.max(...all.map((one) => largest(sizes(one)))));
    const values = sizes(g), pressure = g.of("p");
    cells(p, g, (k) => (pressure[k]! > 0 ? colourAt(1e-6 * values[k]! / top) : null));
    arrows(p, g, 1e6 * top);
    colourBar(p, 0, top, "MPa");
  });
}

export function stateMap(): Figure {
  const figure = patchFigure("Stick and slip", "", (p, g) => {
    const state = g.of("state");
    cells(p, g, (k) => (state[k] === 0 ? null : state[k] === 1 ? kStick : kSlip));
  });
  const entry = (kind: string, words: string) =>
      element("span", {class: "entry"}, element("span", {class: `swatch ${kind}`}), words);
  figure.node.querySelector("figcaption")!.replaceChildren(entry("stick", "stick"), entry("slip", "slip"));
  return figure;
}

interface Line {
  x: Float32Array;
  p: Float32Array;
  q: Float32Array;
}
function centreOf(a: Answer): Line|null {
  const head = a.head.patch;
  if (!head) return null;
  const of = (s: Slice, factor: number) => numbersOf(a, s).map((v) => factor * v);
  return {x: of(head.centre_x, 1e3), p: of(head.centre_p, 1e-6), q: of(head.centre_q_x, 1e-6)};
}

function lineAxes(canvas: HTMLCanvasElement, x: Axis, y: Axis, height = 250): Plot|null {
  const g = prepare(canvas, height);
  if (!g) return null;
  const width = canvas.parentElement!.clientWidth;
  return new Plot(g, {left: 56, top: 8, width: width - 78, height: height - 48}, x, y, theme());
}

export function centreLine(): Figure {
  const [node, canvas] = frame("Centre line", "");
  const entry = (style: string, words: string) =>
      element("span", {class: "entry"}, element("span", {class: `stroke ${style}`}), words);
  const pin = element("span", {}, "pin");
  const pinEntry = element("span", {class: "entry"}, element("span", {class: "stroke pin"}), pin);
  node.querySelector("figcaption")!.replaceChildren(
      entry("p", "pressure"), entry("q", "|q_x|"), entry("bound", "f p"), entry("ghost", "before"), pinEntry);
  const draw = (s: Shown|null) => {
    const now = s && centreOf(s.now);
    if (!s || !now) return;
    pin.textContent = s.pinned?.name ?? "pin";
    const before = s.before && centreOf(s.before), pinned = s.pinned && centreOf(s.pinned);
    const all = [now, before, pinned].filter((l): l is Line => l !== null);
    const reach = all.map((l) => l.x.filter((_, k) => l.p[k]! > 0)).filter((x) => x.length > 0);
    const end = 2 * Math.ceil((Math.max(1, ...reach.map((x) => Math.max(-Math.min(...x), Math.max(...x)))) + 0.6) / 2);
    const p = lineAxes(
        canvas, {low: -end, high: end, title: "x rolling → [mm]"},
        {low: 0, high: roundUp(1.02 * Math.max(...all.map((l) => largest(l.p)))), title: "MPa"});
    if (!p) return;
    p.axes();
    const size = (l: Line) => l.q.map(Math.abs);
    const friction = s.now.head.values["drive.friction_coefficient"] ?? 0;
    for (const [l, dash] of [[before, [5, 4]], [pinned, [2, 3]]] as const)
      if (l) {
        p.line(l.x, l.p, p.colours.soft, 1.5, [...dash]);
        p.line(l.x, size(l), p.colours.soft, 1.5, [...dash]);
      }
    p.line(now.x, now.p.map((v) => friction * v), p.colours.soft, 1, [1, 2]);
    p.line(now.x, now.p, kPressure);
    p.line(now.x, size(now), kTraction);
  };
  const table = (a: Answer) => {
    const l = centreOf(a);
    const rows = l ? [...l.x].map((x, k) => [x, l.p[k]!, l.q[k]!].map((v) => String(Number(v.toPrecision(7))))) : [];
    return [["x_mm", "p_MPa", "q_x_MPa"], ...rows];
  };
  return {node, draw, table};
}

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

/// Borders of rows from their centres: the first begins at the surface.
function borders(depth: Float32Array): number[] {
  const out = [0];
  for (const d of depth) out.push(2 * d - out[out.length - 1]!);
  return out;
}

interface Below {
  along: Float32Array;
  depth: Float32Array;
  values: Float32Array;
}
function belowOf(a: Answer, head: SectionHead|undefined, measure: Measure): Below|null {
  if (!head) return null;
  const of = (s: Slice, factor: number) => numbersOf(a, s).map((v) => factor * v);
  return {along: of(head.along, 1e3), depth: of(head.depth, 1e3), values: of(head[measure], 1e-6)};
}

/// Depths of the rail's interfaces, mm.
function interfaces(a: Answer): number[] {
  let depth = 0;
  return a.head.layers.filter((l) => l.on === "rail").map((l) => (depth += 1e3 * l.thickness));
}

function paintBelow(p: Plot, b: Below, top: number, signed: boolean): void {
  const edge = borders(b.depth);
  const n = b.along.length;
  const dx = Math.abs(b.along[n - 1]! - b.along[0]!) / Math.max(1, n - 1);
  const w = p.box.width / (p.x.high - p.x.low) * dx;
  p.clip(() => {
    for (let r = 0; r < b.depth.length; ++r)
      for (let i = 0; i < b.along.length; ++i) {
        const v = b.values[i + b.along.length * r]! / top;
        const x = p.atX(Math.min(b.along[0]!, b.along[n - 1]!) + dx * (b.along[0]! <= b.along[n - 1]!? i : n - 1 - i));
        p.fill(
            colourAt(signed ? 0.5 + 0.5 * v : v, signed), x - w / 2, p.atY(edge[r]!), x + w / 2, p.atY(edge[r + 1]!));
      }
  });
}

/// Of the rail, through the patch's centre line or across it.
export function sectionFigure(choice: Choice, which: "section"|"cross"): Figure {
  const along = which === "section";
  const title = along ? "Stress below, along the rail" : "Stress below, across the rail";
  const [node, canvas] = frame(title, "Lines: where a layer ends.", along ? [choice.node] : []);
  const draw = (s: Shown|null) => {
    const b = s && belowOf(s.now, s.now.head[which], choice.value());
    if (!s || !b) return;
    const edge = borders(b.depth), deepest = edge[edge.length - 1]!;
    const window = windowOf([gridOf(s.now)].filter((g): g is Grid => g !== null));
    const span = along ? window.x : window.y;
    const p = lineAxes(
        canvas, {low: span[0], high: span[1], title: along ? "x rolling → [mm]" : "y [mm]"},
        {low: Math.min(deepest, span[1] - span[0]), high: 0, title: "depth [mm]"});
    if (!p) return;
    p.box.width -= 38;
    const signed = choice.value() !== "von_mises";
    const top = roundUp(b.values.reduce((m, v) => Math.max(m, Math.abs(v)), 0));
    p.axes();
    paintBelow(p, b, top, signed);
    p.g.strokeStyle = signed ? "#1b1f24" : "#ffffff";
    for (const d of interfaces(s.now))
      p.clip(() => p.segment(p.box.left, p.atY(d), p.box.left + p.box.width, p.atY(d)));
    colourBar(p, signed ? -top : 0, top, "MPa", signed);
  };
  const table = (a: Answer) => {
    const b = belowOf(a, a.head[which], choice.value());
    if (!b) return [];
    const rows = [[along ? "x_mm" : "y_mm", "depth_mm", `${choice.value()}_MPa`]];
    b.values.forEach((v, k) => rows.push([
      b.along[k % b.along.length]!, b.depth[Math.floor(k / b.along.length)]!, v
    ].map((n) => String(Number(n.toPrecision(6))))));
    return rows;
  };
  return {node, draw, table};
}

/// The largest of each depth of the section along the rail.
function overDepth(b: Below): Float32Array {
  const n = b.along.length;
  return b.depth.map((_, r) => {
    let top = 0;
    for (let i = 0; i < n; ++i) {
      const v = b.values[i + n * r]!;
      if (Math.abs(v) > Math.abs(top)) top = v;
    }
    return top;
  });
}

export function depthFigure(choice: Choice): Figure {
  const [node, canvas] =
      frame("Stress over depth", "Largest in the section along the rail. Dashed: before; dotted: pin.");
  const draw = (s: Shown|null) => {
    const now = s && belowOf(s.now, s.now.head.section, choice.value());
    if (!s || !now) return;
    const others = [s.before, s.pinned].map((a) => a && belowOf(a, a.head.section, choice.value()));
    const all =
        [now, ...others].filter((b): b is Below => b !== null).map((b) => ({depth: b.depth, top: overDepth(b)}));
    const most = roundUp(Math.max(...all.map((l) => l.top.reduce((m, v) => Math.max(m, v), 0))));
    const least = Math.min(0, ...all.map((l) => l.top.reduce((m, v) => Math.min(m, v), 0)));
    const p = lineAxes(
        canvas, {low: least < 0 ? -roundUp(-least) : 0, high: most, title: `${kMeasures[choice.value()]} [MPa]`},
        {low: stepOf(Math.max(...now.depth), 4) * 4, high: 0, title: "depth [mm]"});
    if (!p) return;
    p.axes();
    p.g.strokeStyle = p.colours.soft;
    for (const d of interfaces(s.now))
      p.clip(() => p.segment(p.box.left, p.atY(d), p.box.left + p.box.width, p.atY(d)));
    others.forEach((b, k) => b && p.line(overDepth(b), b.depth, p.colours.soft, 1.5, k === 0 ? [5, 4] : [2, 3]));
    p.line(overDepth(now), now.depth, kPressure);
  };
  const table = (a: Answer) => {
    const b = belowOf(a, a.head.section, choice.value());
    const top = b ? overDepth(b) : null;
    return [
      ["depth_mm", `${choice.value()}_MPa`],
      ...(b && top ? [...b.depth].map((d, k) => [d, top[k]!].map((v) => String(Number(v.toPrecision(6))))) : [])
    ];
  };
  return {node, draw, table};
}
