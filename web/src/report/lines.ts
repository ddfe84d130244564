// Charts of lines.
import type {Axis} from "../axes";
import type {Chart, Dash} from "../chart";
import type {DataTable, Plotted} from "../figures";
import {filled} from "../text";
import type {Theme} from "../theme";
import type {Span, Values} from "../types";

export interface Series {
  name: string;
  x: Values;
  y: Values;
  colour: (theme: Theme) => string;
  markers?: boolean;
  dash?: Dash;
  quiet?: boolean;  // not in the legend
  hover: string;    // with units: "x %{x:.2f} mm\np %{y:.1f} MPa"
}

export interface LinesSpec {
  id: string;
  title: string;
  words?: (string|Node)[];
  labels: [x: string, y: string];
  names: [x: string, y: string];  // of columns, with units
  series: Series[];
  height?: number;
  downwards?: boolean;  // y grows downwards
  band?: Span;          // shaded range of x
  levels?: number[];    // dashed lines across at these y
  window?: Span;
  deepest?: number;    // of y that grows downwards
  leastSpan?: number;  // of y, as a share of its largest value: small ripples stay small
  wide?: boolean;
  log?: "x"|"xy";   // logarithmic axes: values above zero alone
  bars?: string[];  // names of y = 0, 1, …: lines are bars there, over a logarithmic x
}

/// A little more than the values take; lines do not run along the frame.
function roomFor(values: Values[], leastSpan = 0): Span {
  let low = Infinity;
  let high = -Infinity;
  for (const v of values.flat()) {
    if (v === null || !Number.isFinite(v)) continue;
    low = Math.min(low, v);
    high = Math.max(high, v);
  }
  if (low > high) return [0, 1];
  const size = Math.max(Math.abs(low), Math.abs(high));
  const span = Math.max(high - low, leastSpan * size) || 1;
  const middle = 0.5 * (low + high);
  return [middle - 0.54 * span, middle + 0.54 * span];
}

/// Exponents of ten that hold the values; at least from 1 to 10.
function decades(values: Values[]): Span {
  const all = values.flat().filter((v): v is number => v !== null && v > 0).map(Math.log10);
  if (!all.length) return [0, 1];
  const low = Math.min(...all);
  return [low - 0.1, Math.max(Math.max(...all), low + 0.3) + 0.1];
}

function rangeOfY(c: LinesSpec): Span {
  const lines = c.series.map((s) => s.y);
  if (!c.downwards) return roomFor(lines, c.leastSpan);
  if (c.deepest) return [c.deepest, 0];
  return [1.02 * Math.max(...lines.flat().map((v) => v ?? 0)), 0];
}

function axesOf(c: LinesSpec): {x: Axis; y: Axis} {
  const bars = c.bars?.length ? c.bars : undefined;
  const [logX, logY] = [c.log !== undefined || bars !== undefined, c.log === "xy"];
  const rangeX = logX ? decades(c.series.map((s) => s.x)) : c.window ?? roomFor(c.series.map((s) => s.x));
  const rangeY: Span = bars ? [-0.6, bars.length - 0.4] : logY ? decades(c.series.map((s) => s.y)) : rangeOfY(c);
  return {
    x: {title: c.labels[0], range: rangeX, log: logX},
    y: {title: c.labels[1], range: rangeY, log: logY, names: bars},
  };
}

const kBar = 14;  // px

function chartOf(c: LinesSpec, theme: Theme, width: number): Chart {
  return {
    ...axesOf(c),
    height: Math.min((c.height ?? 330) - 76, 0.75 * width - 36),
    grid: true,
    legend: c.series.length > 1,
    band: c.band,
    levels: c.levels,
    curves: c.series.map((s) => ({
                           name: s.name,
                           x: s.x,
                           y: s.y,
                           colour: s.colour(theme),
                           dash: s.dash,
                           width: c.bars?.length ? kBar : undefined,
                           mark: !s.markers || c.bars?.length ? undefined
                               : s.x.length > 1               ? "dot"
                                                              : "circle",
                           quiet: s.quiet,
                           words: (x, y) => filled(s.hover, {x, y}),
                         })),
  };
}

/// A row for each point: name of the series, x, y.
function rowsOfSeries(s: Series): (string|number|null)[][] {
  return s.x.map((x, i) => [s.name, x, s.y[i]]).filter(([, x, y]) => x !== null && y !== null);
}

export function linesFigure(c: LinesSpec): Plotted {
  return {
    id: c.id,
    title: c.title,
    words: c.words,
    wide: c.wide,
    chart: (theme, width) => chartOf(c, theme, width),
    table: (): DataTable => ({names: ["series", ...c.names], rows: c.series.flatMap(rowsOfSeries)}),
  };
}
