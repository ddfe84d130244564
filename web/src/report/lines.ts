// Charts of lines.
import type {Span, Values} from "./data";
import {axis, baseLayout, type DataTable, type Plotted, type Theme} from "./figures";
import {plotText} from "./text";

export interface Series {
  name: string;
  x: Values;
  y: Values;
  colour: (theme: Theme) => string;
  markers?: boolean;
  dash?: string;
  quiet?: boolean;  // not in the legend
  hover: string;    // with units: "x %{x:.2f} mm<br>p %{y:.1f} MPa"
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
  log?: "xy";  // logarithmic axes: values above zero alone
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

function trace(s: Series, theme: Theme): Record<string, unknown> {
  return {
    type: "scatter",
    mode: s.markers ? "lines+markers" : "lines",
    name: plotText(s.name),
    showlegend: !s.quiet,
    x: s.x,
    y: s.y,
    connectgaps: false,
    line: {color: s.colour(theme), width: 1.8, dash: s.dash ?? "solid"},
    marker: {size: 5, color: s.colour(theme)},
    hovertemplate: `${s.hover}<extra>${plotText(s.name)}</extra>`,
  };
}

function shadedBand([x0, x1]: Span, theme: Theme): Record<string, unknown> {
  const place = {xref: "x", yref: "paper", x0, x1, y0: 0, y1: 1};
  return {type: "rect", ...place, fillcolor: theme.soft, opacity: 0.15, line: {width: 0}};
}

function dashedLevel(y: number, theme: Theme): Record<string, unknown> {
  const place = {xref: "paper", yref: "y", x0: 0, x1: 1, y0: y, y1: y};
  return {type: "line", ...place, line: {color: theme.ink, width: 1.4, dash: "dash"}};
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

/// Rows of the legend above the plot: its entries are as wide as the longest.
function legendRows(c: LinesSpec, theme: Theme, width: number): number {
  const named = c.series.filter((s) => !s.quiet);
  if (c.series.length < 2) return 0;
  const entry = 50 + 0.52 * theme.size * Math.max(...named.map((s) => s.name.length));
  return Math.ceil(named.length / Math.max(1, Math.floor((width - 78) / entry)));
}

function axesOf(c: LinesSpec, theme: Theme): Record<string, unknown> {
  const [x, y] = c.labels;
  if (c.log) {
    const log = (title: string, values: Values[]) => axis(theme, title, {type: "log", range: decades(values)});
    return {xaxis: log(x, c.series.map((s) => s.x)), yaxis: log(y, c.series.map((s) => s.y))};
  }
  return {
    xaxis: axis(theme, x, {range: c.window ?? roomFor(c.series.map((s) => s.x))}),
    yaxis: axis(theme, y, {range: rangeOfY(c)}),
  };
}

function layoutOf(c: LinesSpec, theme: Theme, width: number): Record<string, unknown> {
  const band = c.band ? [shadedBand(c.band, theme)] : [];
  const levels = (c.levels ?? []).map((y) => dashedLevel(y, theme));
  const legend = 19 * Math.max(0, legendRows(c, theme, width) - 1);  // the plot keeps its height below it
  const base = baseLayout(theme, width, Math.min(c.height ?? 330, 0.75 * width + 40) + legend);
  return {
    ...base,
    legend: {...(base.legend as object), maxheight: 600},
    margin: {l: 62, r: 16, t: 30 + legend, b: 46},
    showlegend: c.series.length > 1,
    ...axesOf(c, theme),
    shapes: [...band, ...levels],
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
    draw: (theme, width) => ({data: c.series.map((s) => trace(s, theme)), layout: layoutOf(c, theme, width)}),
    table: (): DataTable => ({names: ["series", ...c.names], rows: c.series.flatMap(rowsOfSeries)}),
  };
}
