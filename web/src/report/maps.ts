// Coloured maps with millimetres of equal length on both axes.
import type {Span, Values} from "./data";
import {axis, baseLayout, type DataTable, type Drawing, type Plotted, type Theme} from "./figures";
import {fixedText} from "./text";

export interface Line {
  x: Values;
  y: Values;
  dash?: string;
}

export interface Arrow {
  x: number;
  y: number;
  alongX: number;
  alongY: number;
}

export interface Marker {
  x: number;
  y: number;
  text: string;
  symbol?: string;
}

export interface MapSpec {
  id: string;
  title: string;
  words?: (string|Node)[];
  x: number[];  // centres, or one more edge than columns
  y: number[];
  z: Values[];         // a row for each y
  centresX: number[];  // what the data table says
  centresY: number[];
  names: [x: string, y: string, z: string];  // of columns, with units
  labels: [x: string, y: string];            // of axes
  hover: string;                             // of the value: "p %{z:.1f} MPa"
  hoverY: string;                            // "y" or "depth"
  bar: string;                               // title of the colour bar
  floor?: boolean;                           // values below the range exist and take its lowest colour
  range: Span;
  colours: (theme: Theme) => unknown;
  reversed?: boolean;  // y grows downwards
  discrete?: boolean;  // no colour bar
  smooth?: boolean;    // between points; cells keep their colour otherwise
  windowX: Span;
  windowY: Span;
  lines?: Line[];
  arrows?: Arrow[];
  marker?: Marker;
  valueWords?: string[];  // hover text by value, for states
}

const kRight = 100;  // margin, room for the colour bar

/// Marks of the colour bar where values below its range exist: its lowest says so.
function floorTicks(m: MapSpec): Record<string, unknown> {
  const shares = [-1, -0.5, 0, 0.5, 1];
  const text = (share: number) => `${share === -1 ? "≤ " : ""}${fixedText(share * m.range[1], 0)}`;
  return {tickmode: "array", tickvals: shares.map((share) => share * m.range[1]), ticktext: shares.map(text)};
}

function colourBar(m: MapSpec, theme: Theme): Record<string, unknown> {
  const ticks = m.floor ? floorTicks(m) : {};
  const title = {text: m.bar, side: "top"};
  return {title, thickness: 12, len: 1, outlinewidth: 0, tickcolor: theme.soft, ...ticks};
}

function heatmap(m: MapSpec, theme: Theme): Record<string, unknown> {
  const across = m.labels[0].startsWith("y") ? "y" : "x";
  const words = m.valueWords;
  const text = words ? {text: m.z.map((row) => row.map((v) => (v === null ? "" : words[v])))} : {};
  return {
    type: "heatmap",
    x: m.x,
    y: m.y,
    z: m.z,
    zmin: m.range[0],
    zmax: m.range[1],
    colorscale: m.colours(theme),
    zsmooth: m.smooth ? "best" : false,
    hoverongaps: false,
    showscale: !m.discrete,
    colorbar: colourBar(m, theme),
    ...text,
    hovertemplate: `${across} %{x:.2f} mm, ${m.hoverY} %{y:.2f} mm<br><b>${m.hover}</b><extra></extra>`,
  };
}

function borderTrace(b: Line, theme: Theme): Record<string, unknown> {
  const line = {color: theme.ink, width: 1.6, dash: b.dash ?? "dash"};
  return {type: "scatter", mode: "lines", x: b.x, y: b.y, hoverinfo: "skip", line};
}

/// White with a dark edge, to be seen on any colour.
function arrowTraces(arrows: Arrow[]): Record<string, unknown>[] {
  const x: Values = [];
  const y: Values = [];
  for (const a of arrows) {
    const [endX, endY] = [a.x + a.alongX, a.y + a.alongY];
    const head = (side: number): [number, number] =>
        [endX - 0.3 * (a.alongX * Math.cos(side) - a.alongY * Math.sin(side)),
         endY - 0.3 * (a.alongY * Math.cos(side) + a.alongX * Math.sin(side)),
    ];
    const [left, right] = [head(0.5), head(-0.5)];
    x.push(a.x, endX, null, left[0], endX, right[0], null);
    y.push(a.y, endY, null, left[1], endY, right[1], null);
  }
  const edge = {color: "#1b1f24", width: 3};
  const core = {color: "#ffffff", width: 1.3};
  return [edge, core].map((line) => ({type: "scatter", mode: "lines", x, y, hoverinfo: "skip", line}));
}

/// Dark on light, to be seen on any colour.
function markerTraces(m: Marker): Record<string, unknown>[] {
  const symbol = m.symbol ?? "cross-thin";
  return [{color: "#ffffff", width: 4}, {color: "#1b1f24", width: 1.6}].map(
      (line) => ({
        type: "scatter",
        mode: "markers",
        x: [m.x],
        y: [m.y],
        hovertemplate: `${m.text}<extra></extra>`,
        cliponaxis: false,
        marker: {symbol, size: 11, color: "rgba(0,0,0,0)", line},
      }));
}

function layoutOf(m: MapSpec, theme: Theme, width: number): Record<string, unknown> {
  const [low, high] = m.windowY;
  const aspect = (high - low) / (m.windowX[1] - m.windowX[0]);
  const height = Math.round(Math.min(Math.max((width - 60 - kRight) * aspect, 90), 420) + 76);
  const bare = {constrain: "domain", showgrid: false, zeroline: false};
  const y = {range: m.reversed ? [high, low] : [low, high], scaleanchor: "x", scaleratio: 1, ...bare};
  return {
    ...baseLayout(theme, width, height),
    margin: {l: 58, r: kRight, t: 30, b: 46},
    xaxis: axis(theme, m.labels[0], {range: m.windowX, ...bare}),
    yaxis: axis(theme, m.labels[1], y),
  };
}

export function mapFigure(m: MapSpec): Plotted {
  return {
    id: m.id,
    title: m.title,
    words: m.words,
    draw: (theme: Theme, width: number): Drawing => {
      const borders = (m.lines ?? []).map((line) => borderTrace(line, theme));
      const markers = m.marker ? markerTraces(m.marker) : [];
      return {
        data: [heatmap(m, theme), ...borders, ...arrowTraces(m.arrows ?? []), ...markers],
        layout: layoutOf(m, theme, width)
      };
    },
    table: (): DataTable => ({
      names: m.names,
      rows: m.centresY.flatMap((y, j) => m.centresX.map((x, i) => [x, y, m.z[j][i]])),
    }),
  };
}

/// What all of them cover: pictures of several runs show the same piece of the body.
export function commonWindow(all: number[][]): Span {
  return [Math.max(...all.map((v) => Math.min(...v))), Math.min(...all.map((v) => Math.max(...v)))];
}

/// Of pressure, traction, slip and von Mises stress: Viridis, whose lightness grows evenly.
export const magnitudeColours = () => "Viridis";
/// Of the principal stress: compression blue, tension red, zero the paper's shade.
export const signedColours = (theme: Theme) => [
    [0, "#2166ac"],
    [0.25, "#67a9cf"],
    [0.5, theme.paper === "#ffffff" ? "#f7f7f7" : "#2a2f36"],
    [0.75, "#ef8a62"],
    [1, "#b2182b"],
];
