// Stresses below the surface: sections, depth lines, table of maxima.
import type {Dash} from "../chart";
import {table, type Cell} from "../dom";
import {columnEdges, rowEdges} from "../edges";
import type {Figure} from "../figures";
import {magnitudeScale, signedScale} from "../scale";
import {barText, fixedText, numberText, percentText, powerText} from "../text";
import type {BodyName, Span, StressMaximum, Values} from "../types";
import {numberAt, rowsOf, unpack, type Columns, type Run, type Section, type StressQuantity} from "./data";
import {linesFigure, type Series} from "./lines";
import {commonWindow, mapFigure, type Line, type MapSpec} from "./maps";
import {contactY} from "./patch";
import {measures, runLabel, zones} from "./words";

type Plane = "longitudinal"|"cross";
type Quantity = StressQuantity|"plastic_strain_accumulated";

/// Where the material changes: along rows and along columns.
function materialBorders(section: Section, x: number[], depth: number[]): Line[] {
  const material = rowsOf([...section.material], section.along.length);
  const line: Line = {x: [], y: []};
  const add = (x0: number, y0: number, x1: number, y1: number) => {
    const n = line.x.length;
    if (n > 1 && line.x[n - 2] === x0 && line.y[n - 2] === y0 && y0 === y1) {
      line.x.splice(n - 2, 1, x1);  // goes on
    } else {
      line.x.push(x0, x1, null);
      line.y.push(y0, y1, null);
    }
  };
  for (let r = 1; r < material.length; ++r)
    for (let c = 0; c < section.along.length; ++c)
      if (material[r][c] !== material[r - 1][c]) add(x[c], depth[r], x[c + 1], depth[r]);
  for (let c = 1; c < section.along.length; ++c)
    for (let r = 0; r < material.length; ++r)
      if (material[r][c] !== material[r][c - 1]) add(x[c], depth[r], x[c], depth[r + 1]);
  return line.x.length ? [line] : [];
}

interface Cut {
  run: Run;
  section: Section;
  plane: Plane;
  centres: number[];
  x: number[];
  depth: number[];
  values: Record<Quantity, Values[]>;
}

function cutOf(run: Run, body: BodyName, plane: Plane): Cut|null {
  const section = run.sections[body]?.[plane];
  if (!section) return null;
  const shift = plane === "cross" ? contactY(run) : 0;
  const centres = section.along.map((v) => v - shift);
  const shape = (packed: Section["von_mises"]) => rowsOf(unpack(packed), section.along.length);
  return {
    run,
    section,
    plane,
    centres,
    x: columnEdges(centres),
    depth: rowEdges(section.depth),
    values: {
      von_mises: shape(section.von_mises),
      sigma_1: shape(section.sigma_1),
      sigma_xz: shape(section.sigma_xz),
      tau_max: shape(section.tau_max),
      plastic_strain_accumulated: section.plastic_strain_accumulated ? shape(section.plastic_strain_accumulated) : [],
    },
  };
}

function extreme(cuts: Cut[], quantity: Quantity, ofSize: boolean): number {
  let top = 0;
  for (const v of cuts.flatMap((cut) => cut.values[quantity]).flat())
    top = Math.max(top, ofSize ? Math.abs(v ?? 0) : (v ?? 0));
  return top || 1;
}

interface Place {
  x: number;
  y: number;
  value: number;
}

/// The largest value in the window that is drawn; of a shear stress the largest size.
function place(cut: Cut, quantity: Quantity, windowX: Span, windowY: Span): Place {
  const size = (v: number) => (quantity === "sigma_xz" ? Math.abs(v) : v);
  let best = {x: 0, y: 0, value: quantity === "sigma_xz" ? 0 : -Infinity};
  const inside = (v: number, [low, high]: Span) => v > low && v < high;
  const columns = [...cut.centres.keys()].filter((c) => inside(cut.centres[c], windowX));
  const rows = [...cut.section.depth.keys()].filter((r) => inside(cut.section.depth[r], windowY));
  for (const r of rows)
    for (const c of columns) {
      const value = cut.values[quantity][r][c];
      if (value !== null && size(value) > size(best.value)) best = {x: cut.centres[c], y: cut.section.depth[r], value};
    }
  return best;
}

interface Kind {
  key: Quantity;
  name: string;
  column: string;
  hover: string;
}

const kKinds: Kind[] = [
  {key: "von_mises", name: "Von Mises stress", column: "von_mises_MPa", hover: "von Mises %{z:.1f} MPa"},
  {key: "sigma_1", name: "Largest principal stress σ₁", column: "sigma_1_MPa", hover: "σ₁ %{z:.1f} MPa"},
  {key: "sigma_xz", name: "Shear stress τ_xz", column: "sigma_xz_MPa", hover: "τ_xz %{z:.1f} MPa"},
  {key: "tau_max", name: "Largest shear stress τ_max", column: "tau_max_MPa", hover: "τ_max %{z:.1f} MPa"},
  {
    key: "plastic_strain_accumulated",
    name: "Accumulated plastic strain p",
    column: "plastic_strain_accumulated",
    hover: "p %{z:.2e}"
  },
];
/// A value with its unit, to so many decimals of a stress.
const valueText = (kind: Kind, v: number, decimals: number) =>
    kind.key === "plastic_strain_accumulated" ? (v === 0 ? "0" : powerText(v)) : `${fixedText(v, decimals)} MPa`;
export const kNormal: StressQuantity[] = ["von_mises", "sigma_1"];
export const kShear: StressQuantity[] = ["sigma_xz", "tau_max"];

type Look = Pick<MapSpec, "floor"|"scale">;

/// Colours of one quantity on all sections.
function scaleOf(cuts: Cut[], kind: Kind): Look {
  const all = extreme(cuts, kind.key, true);
  if (kind.key === "von_mises" || kind.key === "tau_max" || kind.key === "plastic_strain_accumulated")
    return {scale: magnitudeScale(all)};
  if (kind.key === "sigma_xz") return {scale: signedScale(all)};
  // of the principal stress the tension counts: compression deeper than its range takes the darkest blue
  const top = Math.max(extreme(cuts, kind.key, false), 0.1 * all);
  return {floor: top < all, scale: signedScale(top)};
}

/// Along the section: the axis, its words, the name of the plane and where it lies.
function planeWords({plane, section, run}: Cut): {along: string; label: string; name: string; at: string} {
  if (plane === "longitudinal") {
    const at = `plane y = ${fixedText(section.at - contactY(run), 2)} mm`;
    return {along: "x", label: "x, rolling direction [mm]", name: "longitudinal section", at};
  }
  const at = `plane x = ${fixedText(section.at, 2)} mm`;
  return {along: "y", label: "y, field side right [mm]", name: "cross section", at};
}

/// These quantities on both planes; one scale a quantity.
export function sectionMaps(runs: Run[], body: BodyName, quantities: Quantity[] = kNormal): Figure[] {
  const planes: Plane[] = ["longitudinal", "cross"];
  const kinds = kKinds.filter((kind) => quantities.includes(kind.key));
  const cuts = runs.flatMap((run) => planes.map((plane) => cutOf(run, body, plane)))
                   .filter((cut) => cut !== null && kinds.every((kind) => cut.values[kind.key].length > 0)) as Cut[];
  const scales = kinds.map((kind) => scaleOf(cuts, kind));
  const mapOf = (cut: Cut, kind: Kind, scale: Look, windowX: Span, windowY: Span) => {
    const plane = planeWords(cut);
    const best = place(cut, kind.key, windowX, windowY);
    const where = `${plane.along} ${fixedText(best.x, 2)}, depth ${best.y.toFixed(2)} mm`;
    const borders = materialBorders(cut.section, cut.x, cut.depth);
    const words = [
      `${body === "rail" ? "Rail" : "Wheel"}, ${plane.at}.`,
      `Circle: the largest shown, ${valueText(kind, best.value, 0)} at ${where}.`,
      ...(borders.length ? ["Dashed: border of the layer."] : []),
    ];
    const largest = `largest here: ${valueText(kind, best.value, 1)}\n${where}`;
    return mapFigure({
      id: `section-${body}-${cut.plane}-${kind.key}-${runs.indexOf(cut.run)}`,
      title: [kind.name, plane.name, ...(runs.length > 1 ? [runLabel(cut.run)] : [])].join(", "),
      words: [words.join(" ")],
      x: cut.x,
      y: cut.depth,
      z: cut.values[kind.key],
      centresX: cut.centres,
      centresY: cut.section.depth,
      names: [`${plane.along}_mm`, "depth_mm", kind.column],
      labels: [plane.label, "depth [mm]"],
      hover: kind.hover,
      hoverY: "depth",
      bar: kind.key === "plastic_strain_accumulated" ? "p" : "MPa",
      ...scale,
      reversed: body === "rail",
      windowX,
      windowY,
      lines: borders,
      marker: {x: best.x, y: best.y, text: largest, mark: "circle"},
    });
  };
  return planes.flatMap((plane) => {
    const these = cuts.filter((cut) => cut.plane === plane);
    const windowX = commonWindow(these.map((cut) => cut.x));
    const windowY = commonWindow(these.map((cut) => cut.depth));
    return kinds.flatMap((kind, k) => these.map((cut) => mapOf(cut, kind, scales[k], windowX, windowY)));
  });
}

/// The line of a run's depth table, broken where the material changes.
function depthLine(line: Columns, column: string): {x: Values; y: Values} {
  const {depth_mm: depth, material, [column]: values} = line;
  const x: Values = [];
  const y: Values = [];
  values.forEach((v, i) => {
    if (i > 0 && material[i] !== material[i - 1]) {
      x.push(null);
      y.push(null);
    }
    x.push(v);
    y.push(depth[i]);
  });
  return {x, y};
}

type Component = [column: string, name: string];

function depthSeries(run: Run, line: Columns, [column, name]: Component, n: number, dash: Dash, quiet = false): Series {
  return {
    ...depthLine(line, column),
    name: `${name}, ${runLabel(run)}`,
    dash,
    quiet,
    markers: line.depth_mm.length < 40,
    colour: (t) => t.series[n % t.series.length],
    hover: `depth %{y:.2f} mm\n${name} %{x:.1f} MPa`,
  };
}

/// Where a run's depth line stands.
function placeWords(run: Run, body: BodyName): string {
  const whose = runLabel(run);
  const sections = run.sections.wheel;
  if (body === "wheel")
    return sections ? `${whose}: x ${fixedText(sections.cross.at, 2)}, y ${
                          fixedText(sections.longitudinal.at - contactY(run), 2)} mm`
                    : whose;
  const m = run.summary.stress.rail.subsurface?.von_mises_max;
  if (!m) return whose;
  const mm = (v: number|null) => fixedText(1e3 * (v ?? 0), 2);
  return `${whose}: x ${mm(m.x_m)}, y ${mm(m.y_m)} mm`;
}

/// Depths of the bottoms of a body's layers, mm.
function layerBottoms(runs: Run[], body: BodyName): number[] {
  const layers = runs.find((run) => run.geometry)?.geometry?.layers ?? [];
  let sum = 0;
  return layers.filter((layer) => layer.on === body).map((layer) => (sum += 1e3 * layer.thickness_m));
}

const lineOf = (run: Run, body: BodyName) => (body === "rail" ? run.depth_line : run.wheel_depth_line);

const kComponents: Component[] = [
  ["sigma_xx_MPa", "σ_xx"],
  ["sigma_yy_MPa", "σ_yy"],
  ["sigma_zz_MPa", "σ_zz"],
  ["sigma_xz_MPa", "τ_xz"],
];

const kBelow: Record<BodyName, string> = {
  rail: "Below the largest von Mises stress under the surface",
  wheel: "Where the two sections of the wheel cross",
};

/// Stress against depth: in the rail below each run's largest von Mises stress, in the wheel where its sections cross.
export function depthLines(runs: Run[], body: BodyName): Figure[] {
  const given = runs.flatMap((run, n) => {
    const line = lineOf(run, body);
    return line && line.depth_mm.length > 1 ? [{run, n, line}] : [];
  });
  if (!given.length) return [];
  const bottom = Math.max(...given.map(({line}) => Math.max(...line.depth_mm)));
  const levels = layerBottoms(given.map(({run}) => run), body).filter((d) => d < bottom);
  const border = levels.length ? " Dashed: bottom of the layer." : "";
  const suffix = body === "rail" ? "" : "-wheel";
  const figure = (id: string, title: string, series: Series[], words: string) => linesFigure({
    id: `${id}${suffix}`,
    title: `${title}, ${body}`,
    labels: ["stress [MPa]", "depth [mm]"],
    names: ["stress_MPa", "depth_mm"],
    downwards: true,
    height: 420,
    levels,
    series,
    words: [words + border],
  });
  const main = given.flatMap(({run, n, line}) => {
    const vonMises = depthSeries(run, line, ["von_mises_MPa", "von Mises"], n, "solid");
    return [vonMises, depthSeries(run, line, ["sigma_1_MPa", "σ₁"], n, "dot")];
  });
  const below = `${kBelow[body]} (${given.map(({run}) => placeWords(run, body)).join("; ")}).`;
  const components = given.flatMap(({run, n, line}) => {
    const dash = n === 0 ? "solid" : "dash";
    return kComponents.map((component, k) => depthSeries(run, line, component, k, dash, n > 0));
  });
  const whose = given.length > 1 ? ` Solid: ${runLabel(given[0].run)}; dashed: the other.` : "";
  return [
    figure("depth", "Von Mises and σ₁ against depth", main, below),
    figure(
        "depth-components", "Stress components against depth", components,
        `The same line; tension is positive.${whose}`),
  ];
}

function maximumCells(m: StressMaximum|null|undefined): Cell[] {
  if (!m) return [{text: "–"}, {text: ""}];
  const mm = (v: number|null) => (v === null ? "–" : fixedText(1e3 * v, 2));
  return [
    {
      text: numberText(1e-6 * m.value_Pa) + barText(1e-6 * (m.error_Pa ?? NaN)),
      attributes: {"data-value": String(m.value_Pa)}
    },
    {text: `${mm(m.x_m)}, ${mm(m.y_m)}, ${mm(m.depth_m)}`, attributes: {class: "place"}},
  ];
}

function differenceText(a: StressMaximum|null|undefined, b: StressMaximum|null|undefined): string {
  return a && b ? percentText((a.value_Pa - b.value_Pa) / Math.abs(b.value_Pa), 1) : "–";
}

/// Largest stresses with their places, by zone.
export function maximaTable(runs: Run[], body: BodyName): HTMLElement {
  const pair = runs.length === 2;
  const stressOf = (run: Run) => (runs.length > 1 ? `${runLabel(run)} [MPa]` : "[MPa]");
  const columns = runs.flatMap((run) => [stressOf(run), "at x, y, depth [mm]"]);
  const head = ["zone", "stress", ...columns, ...(pair ? ["difference"] : [])];
  const rows: (string|Cell)[][] = [];
  // the layers' σ₁ stands once, with surface and residual stress, under "Does it last?" where that part is there
  const elsewhere = runs.every((run) => typeof numberAt(run, "layers/sigma_1_Pa") === "number");
  for (const zone of zones())
    for (const measure of measures()) {
      if (elsewhere && zone.key === "layer" && measure.key === "sigma1_max") continue;
      const found = runs.map((run) => run.summary.stress[body]?.[zone.key]?.[measure.key]);
      if (!found.some(Boolean)) continue;
      const difference = pair ? [differenceText(found[0], found[1])] : [];
      rows.push([zone.name, measure.name, ...found.flatMap(maximumCells), ...difference]);
    }
  return table(
      `Largest stresses of the contact alone in the ${body}`, head, rows, {class: "numbers", id: `maxima-${body}`});
}
