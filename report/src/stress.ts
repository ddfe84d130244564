// Stresses below the surface: sections, depth lines, table of maxima.
import {measures, minus, numberText, percentText, runLabel, zones} from "./text";
import {rowsOf, unpack, type Run, type Section, type StressMaximum} from "./data";
import {table, type Cell} from "./dom";
import type {Figure, Theme} from "./figures";
import {linesFigure, type Series} from "./lines";
import {magnitudeColours, mapFigure, signedColours, commonWindow, type Line} from "./maps";
import {contactY} from "./patch";

export type Body = "rail"|"wheel";

/// Borders of cells from their centres; the first row begins at the surface.
function rowEdges(centres: number[]): number[] {
  const edges = [0];
  for (const c of centres) edges.push(2 * c - edges[edges.length - 1]);
  return edges;
}
function columnEdges(centres: number[]): number[] {
  const n = centres.length;
  const middle = centres.slice(1).map((c, i) => 0.5 * (c + centres[i]));
  return [1.5 * centres[0] - 0.5 * centres[1], ...middle, 1.5 * centres[n - 1] - 0.5 * centres[n - 2]];
}

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
  plane: "longitudinal"|"cross";
  centres: number[];
  x: number[];
  depth: number[];
  values: Record<"von_mises"|"sigma_1", (number | null)[][]>;
}

function cutOf(run: Run, body: Body, plane: "longitudinal"|"cross"): Cut|null {
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
    values: {von_mises: shape(section.von_mises), sigma_1: shape(section.sigma_1)}
  };
}

function extreme(cuts: Cut[], kind: "von_mises"|"sigma_1", ofSize: boolean): number {
  let top = 0;
  for (const cut of cuts)
    for (const row of cut.values[kind])
      for (const v of row) top = Math.max(top, ofSize ? Math.abs(v ?? 0) : (v ?? 0));
  return top || 1;
}

/// The largest value in the window that is drawn.
function place(cut: Cut, kind: "von_mises"|"sigma_1", windowX: [number, number], windowY: [number, number]):
    {x: number; y: number; value: number} {
  let best = {x: 0, y: 0, value: -Infinity};
  const inside = (v: number, [low, high]: [number, number]) => v > low && v < high;
  cut.values[kind].forEach(
      (row, r) => row.forEach((v, c) => {
        if (v !== null && v > best.value && inside(cut.centres[c], windowX) && inside(cut.section.depth[r], windowY))
          best = {x: cut.centres[c], y: cut.section.depth[r], value: v};
      }),
  );
  return best;
}

/// Von Mises stress and largest principal stress on both planes; one scale a quantity.
export function sectionMaps(runs: Run[], body: Body): Figure[] {
  const cuts = runs.flatMap((run) => (["longitudinal", "cross"] as const).map((plane) => cutOf(run, body, plane)))
                   .filter((cut) => cut !== null);
  if (!cuts.length) return [];
  const kinds = [
    {key: "von_mises" as const, name: "Von Mises stress", column: "von_mises_MPa", hover: "von Mises %{z:.1f} MPa"},
    {key: "sigma_1" as const, name: "Largest principal stress σ₁", column: "sigma_1_MPa", hover: "σ₁ %{z:.1f} MPa"},
  ];
  return (["longitudinal", "cross"] as const).flatMap((plane) => {
    const these = cuts.filter((cut) => cut.plane === plane);
    if (!these.length) return [];
    const windowX = commonWindow(these.map((cut) => cut.x));
    const windowY = commonWindow(these.map((cut) => cut.depth));
    const along = plane === "longitudinal" ? "x" : "y";
    return kinds.flatMap((kind) => {
      // of the principal stress the tension counts: compression deeper than its range takes the darkest blue
      const all = extreme(cuts, kind.key, true);
      const top = kind.key === "von_mises" ? all : Math.max(extreme(cuts, kind.key, false), 0.1 * all);
      return these.map((cut): Figure => {
        const best = place(cut, kind.key, windowX, windowY);
        const at = plane === "longitudinal" ? `plane y = ${minus((cut.section.at - contactY(cut.run)).toFixed(2))} mm`
                                            : `plane x = ${minus(cut.section.at.toFixed(2))} mm`;
        const borders = materialBorders(cut.section, cut.x, cut.depth);
        const where = `${along} ${minus(best.x.toFixed(2))}, depth ${best.y.toFixed(2)} mm`;
        return mapFigure({
          id: `section-${body}-${plane}-${kind.key}-${runs.indexOf(cut.run)}`,
          title: `${kind.name}, ${plane === "longitudinal" ? "longitudinal section" : "cross section"}${
              runs.length > 1 ? `, ${runLabel(cut.run)}` : ""}`,
          words: [`${body === "rail" ? "Rail" : "Wheel"}, ${at}. Circle: the largest shown, ${
              minus(best.value.toFixed(0))} MPa at ${where}.${borders.length ? " Dashed: border of the layer." : ""}`],
          x: cut.x,
          y: cut.depth,
          z: cut.values[kind.key],
          centresX: cut.centres,
          centresY: cut.section.depth,
          names: [`${along}_mm`, "depth_mm", kind.column],
          labels: [along === "x" ? "x, rolling direction [mm]" : "y, field side right [mm]", "depth [mm]"],
          hover: kind.hover,
          hoverY: "depth",
          bar: "MPa",
          floor: kind.key === "sigma_1" && top < all,
          range: kind.key === "von_mises" ? [0, top] : [-top, top],
          colours: kind.key === "von_mises" ? magnitudeColours : signedColours,
          reversed: body === "rail",
          windowX,
          windowY,
          lines: borders,
          marker:
              {x: best.x, y: best.y, text: `largest here: ${best.value.toFixed(1)} MPa<br>${where}`, symbol: "circle"},
        });
      });
    });
  });
}

function broken(depth: number[], material: number[], values: number[]): {x: (number|null)[]; y: (number | null)[]} {
  const x: (number|null)[] = [];
  const y: (number|null)[] = [];
  values.forEach((v, i) => {
    if (i > 0 && material[i] !== material[i - 1]) x.push(null), y.push(null);
    x.push(v), y.push(depth[i]);
  });
  return {x, y};
}

/// Stress against depth in the rail, below each run's largest von Mises stress.
export function depthLines(runs: Run[]): Figure[] {
  const given = runs.filter((run) => run.depth_line);
  if (!given.length) return [];
  const bottom = Math.max(...given.map((run) => Math.max(...run.depth_line!.depth_mm)));
  const layers = (given.find((run) => run.geometry)?.geometry?.layers ?? []).filter((layer) => layer.on === "rail");
  let sum = 0;
  const levels = layers.map((layer) => (sum += 1e3 * layer.thickness_m)).filter((d) => d < bottom);
  const series = (column: string, name: string, n: number, run: Run, dash: string, quiet = false): Series => ({
    ...broken(run.depth_line!.depth_mm, run.depth_line!.material, run.depth_line![column]),
    name: `${name}, ${runLabel(run)}`,
    dash,
    quiet,
    markers: run.depth_line!.depth_mm.length < 40,
    colour: (t: Theme) => t.series[n % t.series.length],
    hover: `depth %{y:.2f} mm<br>${name} %{x:.1f} MPa`,
  });
  const places = given.map((run) => {
    const m = run.summary.stress.rail.subsurface?.von_mises_max;
    return m ? `${runLabel(run)}: x ${minus((1e3 * (m.x_m ?? 0)).toFixed(2))}, y ${
                   minus((1e3 * (m.y_m ?? 0)).toFixed(2))} mm`
             : runLabel(run);
  });
  const border = levels.length ? " Dashed: bottom of the layer." : "";
  const components: [string, string][] =
      [["sigma_xx_MPa", "σ_xx"], ["sigma_yy_MPa", "σ_yy"], ["sigma_zz_MPa", "σ_zz"], ["sigma_xz_MPa", "σ_xz"]];
  return [
    linesFigure({
      id: "depth",
      title: "Von Mises and σ₁ against depth, rail",
      labels: ["stress [MPa]", "depth [mm]"],
      names: ["stress_MPa", "depth_mm"],
      downwards: true,
      height: 420,
      levels,
      series: given.flatMap(
          (run,
           n) => [series("von_mises_MPa", "von Mises", n, run, "solid"), series("sigma_1_MPa", "σ₁", n, run, "dot")]),
      words: [`Below the largest von Mises stress under the surface (${places.join("; ")}).${border}`],
    }),
    linesFigure({
      id: "depth-components",
      title: "Stress components against depth, rail",
      labels: ["stress [MPa]", "depth [mm]"],
      names: ["stress_MPa", "depth_mm"],
      downwards: true,
      height: 420,
      levels,
      series: given.flatMap(
          (run, n) =>
              components.map(([column, name], k) => series(column, name, k, run, n === 0 ? "solid" : "dash", n > 0))),
      words: [`The same line; tension is positive.${
          given.length > 1 ? ` Solid: ${runLabel(given[0])}; dashed: the other.` : ""}${border}`],
    }),
  ];
}

function maximumCells(m: StressMaximum|null|undefined): Cell[] {
  if (!m) return [{text: "–"}, {text: ""}];
  const mm = (v: number|null) => (v === null ? "–" : minus((1e3 * v).toFixed(2)));
  return [
    {text: numberText(1e-6 * m.value_Pa), attributes: {"data-value": String(m.value_Pa)}},
    {text: `${mm(m.x_m)}, ${mm(m.y_m)}, ${mm(m.depth_m)}`, attributes: {class: "place"}},
  ];
}

/// Largest stresses with their places, by zone.
export function maximaTable(runs: Run[], body: Body): HTMLElement {
  const pair = runs.length === 2;
  const head = [
    "zone", "stress",
    ...runs.flatMap((run) => [`${runs.length > 1 ? `${runLabel(run)} ` : ""}[MPa]`, "at x, y, depth [mm]"]),
    ...(pair ? ["difference"] : [])
  ];
  const rows = zones().flatMap(
      ({key: zone, name}) => measures().flatMap(({key: kind, name: stress}) => {
        const found = runs.map((run) => run.summary.stress[body]?.[zone]?.[kind]);
        if (!found.some(Boolean)) return [];
        const [a, b] = found;
        const cells: (string|Cell)[] = [name, stress, ...found.flatMap(maximumCells)];
        if (pair) cells.push(a && b ? percentText((a.value_Pa - b.value_Pa) / Math.abs(b.value_Pa), 1) : "–");
        return [cells];
      }),
  );
  return table(`Largest stresses in the ${body}`, head, rows, {class: "numbers", id: `maxima-${body}`});
}
