// The contact patch: maps of pressure, traction, slip and state, and the centre line.
import {columnsOf, option, unpack, type Run} from "./data";
import {element} from "./dom";
import type {Figure, Theme} from "./figures";
import {linesFigure, type Series} from "./lines";
import {magnitudeColours, mapFigure, type MapSpec} from "./maps";
import {runLabel} from "./text";

/// A run's patch, y from the rigid contact point as in the tables; nothing outside the contact.
interface Patch {
  run: Run;
  x: number[];
  y: number[];
  p: (number|null)[][];
  q: (number|null)[][];
  slip: (number|null)[][];
  state: (number|null)[][];
}

export function contactY(run: Run): number { return 1e3 * (run.geometry?.contact.y_m ?? 0); }

function patchOf(run: Run): Patch {
  const g = run.patch;
  const touching = (v: number|null, k: number) => (g.state[k] === "0" ? null : v);
  const size = (a: (number|null)[], b: (number|null)[]) => a.map((v, k) => touching(Math.hypot(v ?? 0, b[k] ?? 0), k));
  const shape = (values: (number|null)[]) => columnsOf(values, g.y.length);
  return {
    run,
    x: g.x,
    y: g.y.map((y) => y - contactY(run)),
    p: shape(unpack(g.p).map(touching)),
    q: shape(size(unpack(g.q_x), unpack(g.q_y))),
    slip: shape(size(unpack(g.slip_x), unpack(g.slip_y))),
    state: shape([...g.state].map((c) => (c === "0" ? null : Number(c)))),
  };
}

function largest(patches: Patch[], of: (p: Patch) => (number | null)[][]): number {
  let top = 0;
  for (const patch of patches)
    for (const row of of (patch))
      for (const v of row)
        if (v !== null && v > top) top = v;
  return top || 1;
}

/// A static contact without friction has neither traction nor slip to be drawn.
function hasTraction(runs: Run[]): boolean {
  return runs.some((run) => run.patch.q_x.high - run.patch.q_x.low > 0 || run.patch.q_y.high - run.patch.q_y.low > 0);
}

/// Around every contact, with room for half a cell and a millimetre.
function touchingWindow(
    patches: Patch[], at: (p: Patch) => number[], touches: (p: Patch, k: number) => boolean): [number, number] {
  let low = Infinity, high = -Infinity;
  for (const patch of patches) {
    const t = at(patch);
    const room = 1 + 0.5 * Math.abs(t[1] - t[0]);
    t.forEach((v, k) => {
      if (touches(patch, k)) low = Math.min(low, v - room), high = Math.max(high, v + room);
    });
  }
  return low < high ? [low, high] : [-10, 10];
}

export function stateLegend(): HTMLElement {
  return element(
      "span", {class: "legend"}, element("span", {class: "swatch stick"}), "stick ",
      element("span", {class: "swatch slip"}), "slip");
}

/// Four maps for each run, those of one quantity on one scale.
export function patchMaps(runs: Run[]): Figure[] {
  const patches = runs.map(patchOf);
  const windowX = touchingWindow(patches, (p) => p.x, (p, i) => p.p.some((row) => row[i] !== null));
  const windowY = touchingWindow(patches, (p) => p.y, (p, j) => p.p[j].some((v) => v !== null));
  const kinds:
      {id: string; name: string; of: (p: Patch) => (number | null)[][]; column: string; hover: string; bar: string}[] =
          [
            {id: "p", name: "Pressure p", of: (p) => p.p, column: "p_MPa", hover: "p %{z:.1f} MPa", bar: "MPa"},
            {id: "q", name: "Traction |q|", of: (p) => p.q, column: "q_MPa", hover: "|q| %{z:.1f} MPa", bar: "MPa"},
            {
              id: "slip",
              name: "Slip velocity",
              of: (p) => p.slip,
              column: "slip_mm_s",
              hover: "slip %{z:.2f} mm/s",
              bar: "mm/s"
            },
            {
              id: "state",
              name: "Stick and slip",
              of: (p) => p.state,
              column: "state_1stick_2slip",
              hover: "%{text}",
              bar: ""
            },
          ];
  return kinds.slice(0, hasTraction(runs) ? 4 : 1).flatMap((kind) => {
    const top = largest(patches, kind.of);
    return patches.map((patch, n): Figure => {
      const state = kind.id === "state";
      const spec: MapSpec = {
        id: `map-${kind.id}-${n}`,
        title: `${kind.name}${runs.length > 1 ? `, ${runLabel(patch.run)}` : ""}`,
        words: state ? [stateLegend()] : undefined,
        x: patch.x,
        y: patch.y,
        z: kind.of(patch),
        centresX: patch.x,
        centresY: patch.y,
        names: ["x_mm", "y_mm", kind.column],
        labels: ["x, rolling direction [mm]", "y, field side up [mm]"],
        hover: kind.hover,
        hoverY: "y",
        bar: kind.bar,
        range: state ? [0.5, 2.5] : [0, top],
        colours: state ? (t: Theme) => [[0, t.stick], [0.5, t.stick], [0.5, t.slip], [1, t.slip]] : magnitudeColours,
        discrete: state,
        valueWords: state ? ["separated", "stick", "slip"] : undefined,
        windowX,
        windowY,
        marker: {x: 0, y: 0, text: "rigid contact point"},
      };
      return mapFigure(spec);
    });
  });
}

/// Pressure and traction along x through the largest pressure, all runs and Hertz's.
export function centreLines(runs: Run[]): Figure[] {
  const series = (of: (run: Run) => number[], unit: string): Series[] =>
      runs.map((run, n) => ({
                 name: runLabel(run),
                 x: run.centre_line.x_mm,
                 y: of(run),
                 markers: run.centre_line.x_mm.length < 60,
                 colour: (t: Theme) => t.series[n % t.series.length],
                 hover: `x %{x:.2f} mm<br>${unit} %{y:.1f} MPa`,
               }));
  const pressure = series((r) => r.centre_line.p_MPa, "p");
  const traction = series(
      (r) => r.centre_line.p_MPa.map((_, i) => Math.hypot(r.centre_line.q_x_MPa[i], r.centre_line.q_y_MPa[i])), "|q|");
  const geometry = runs.find((r) => r.geometry)?.geometry;
  const friction = Number(option(runs[0], "drive", "friction_coefficient") ?? NaN);
  if (geometry) {
    const {a_m, p0_Pa} = geometry.hertz;
    const x = Array.from({length: 121}, (_, i) => 1e3 * a_m * -Math.cos((Math.PI * i) / 120));
    const p = x.map((v) => 1e-6 * p0_Pa * Math.sqrt(Math.max(0, 1 - (v / (1e3 * a_m)) ** 2)));
    const reference = (t: Theme) => t.reference;
    pressure.push(
        {name: "Hertz, no layer", x, y: p, colour: reference, dash: "dot", hover: "x %{x:.2f} mm<br>p %{y:.1f} MPa"});
  }
  if (Number.isFinite(friction) && friction > 0) {
    const run = runs[0];
    traction.push({
      name: `limit f p, f = ${friction}`,
      x: run.centre_line.x_mm,
      y: run.centre_line.p_MPa.map((v) => friction * v),
      colour: (t) => t.reference,
      dash: "dash",
      hover: "x %{x:.2f} mm<br>f p %{y:.1f} MPa",
    });
  }
  const touching = runs.flatMap((r) => r.centre_line.x_mm.filter((_, i) => r.centre_line.p_MPa[i] > 0));
  const window: [number, number] = [Math.min(...touching) - 2, Math.max(...touching) + 2];
  const at = runs.map((r) => `${(r.centre_line.y[0] - contactY(r)).toFixed(2).replace("-", "−")} mm`).join(" and ");
  const line = `Along the rolling direction through the largest pressure, at y = ${
      at} from the rigid contact point; the leading edge is on the right.`;
  return [
    linesFigure({
      id: "centre-p",
      title: "Pressure on the centre line",
      labels: ["x, rolling direction [mm]", "p [MPa]"],
      names: ["x_mm", "p_MPa"],
      series: pressure,
      window,
      words: [`${line}${
          geometry
              ? " Hertz’s ellipse takes the curvatures at the rigid contact point and knows no layer: a reference, not a target."
              : ""}`],
    }),
    ...(hasTraction(runs) ? [linesFigure({
      id: "centre-q",
      title: "Traction on the centre line",
      labels: ["x, rolling direction [mm]", "|q| [MPa]"],
      names: ["x_mm", "q_MPa"],
      series: traction,
      window,
      words: [
        "Magnitude of the tangential traction on the rail. Where it meets the limit f p (of the first run) the surfaces slip."
      ],
    })]
                          : []),
  ];
}
