// Charts of lines.
import type {Span, Values} from "./data";
import {axis, baseLayout, type DataTable, type Figure, type Theme} from "./figures";
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

function rangeOfY(c: LinesSpec): Span {
  const lines = c.series.map((s) => s.y);
  if (!c.downwards) return roomFor(lines, c.leastSpan);
  if (c.deepest) return [c.deepest, 0];
  return [1.02 * Math.max(...lines.flat().map((v) => v ?? 0)), 0];
}

function layoutOf(c: LinesSpec, theme: Theme, width: number): Record<string, unknown> {
  const band = c.band ? [shadedBand(c.band, theme)] : [];
  const levels = (c.levels ?? []).map((y) => dashedLevel(y, theme));
  return {
    ...baseLayout(theme, width, Math.min(c.height ?? 330, 0.75 * width + 40)),
    margin: {l: 62, r: 16, t: 30, b: 46},
    showlegend: c.series.length > 1,
    xaxis: axis(theme, c.labels[0], {range: c.window ?? roomFor(c.series.map((s) => s.x))}),
    yaxis: axis(theme, c.labels[1], {range: rangeOfY(c)}),
    shapes: [...band, ...levels],
  };
}

/// A row for each point: name of the series, x, y.
function rowsOfSeries(s: Series): (string|number|null)[][] {
  return s.x.map((x, i) => [s.name, x, s.y[i]]).filter(([, x, y]) => x !== null && y !== null);
}

export function linesFigure(c: LinesSpec): Figure {
  return {
    id: c.id,
    title: c.title,
    words: c.words,
    wide: c.wide,
    draw: (theme, width) => ({data: c.series.map((s) => trace(s, theme)), layout: layoutOf(c, theme, width)}),
    table: (): DataTable => ({names: ["series", ...c.names], rows: c.series.flatMap(rowsOfSeries)}),
  };
}
