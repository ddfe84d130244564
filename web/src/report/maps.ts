// Coloured maps with millimetres of equal length on both axes.
import type {Cells, Chart, Curve, Dash} from "../chart";
import {columnEdges} from "../edges";
import type {DataTable, Plotted} from "../figures";
import type {Scale} from "../scale";
import {filled} from "../text";
import type {Theme} from "../theme";
import type {Span, Values} from "../types";

export interface Line {
  x: Values;
  y: Values;
  dash?: Dash;
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
  mark?: Curve["mark"];
}

export interface MapSpec {
  id: string;
  title: string;
  words?: (string|Node)[];
  x?: number[];  // borders of columns; none: in the middle between their centres
  y?: number[];
  z: Values[];         // a row for each y
  centresX: number[];  // for the data table
  centresY: number[];
  names: [x: string, y: string, z: string];  // of columns, with units
  labels: [x: string, y: string];            // of axes
  hover: string;                             // of the value: "p %{z:.1f} MPa"
  hoverY: string;                            // "y" or "depth"
  bar?: string;                              // unit beside the bar of colours; none: no bar
  floor?: boolean;                           // values below the range exist and take its lowest colour
  scale: Scale;
  reversed?: boolean;  // y grows downwards
  windowX: Span;
  windowY: Span;
  lines?: Line[];
  arrows?: Arrow[];
  marker?: Marker;
  valueWords?: string[];  // by value, instead of `hover`
}

function cellsOf(m: MapSpec): Cells {
  const across = m.labels[0].startsWith("y") ? "y" : "x";
  const words = (i: number, j: number) => {
    const v = m.z[j][i]!;
    const place = filled(`${across} %{x:.2f} mm, ${m.hoverY} %{y:.2f} mm`, {x: m.centresX[i], y: m.centresY[j]});
    return `${place}\n${m.valueWords ? m.valueWords[v] : filled(m.hover, {z: v})}`;
  };
  return {
    x: m.x ?? columnEdges(m.centresX),
    y: m.y ?? columnEdges(m.centresY),
    at: {x: m.centresX, y: m.centresY},
    z: m.z,
    scale: m.scale,
    words,
  };
}

/// White with a dark edge, to be seen on any colour.
function arrowCurve(arrows: Arrow[]): Curve {
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
  return {name: "", x, y, colour: "#ffffff", halo: "#1b1f24", width: 1.3};
}

/// Dark on light, to be seen on any colour.
function markerCurve(m: Marker): Curve {
  const mark = m.mark ?? "cross";
  return {name: "", x: [m.x], y: [m.y], colour: "#1b1f24", halo: "#ffffff", width: 0, mark, words: () => m.text};
}

function chartOf(m: MapSpec, theme: Theme): Chart {
  const [low, high] = m.windowY;
  const line = (b: Line): Curve => ({name: "", x: b.x, y: b.y, colour: theme.ink, width: 1.6, dash: b.dash ?? "dash"});
  return {
    x: {title: m.labels[0], range: m.windowX},
    y: {title: m.labels[1], range: m.reversed ? [high, low] : [low, high]},
    height: 400,
    equal: true,
    cells: cellsOf(m),
    curves: [
      ...(m.lines ?? []).map(line),
      ...(m.arrows ? [arrowCurve(m.arrows)] : []),
      ...(m.marker ? [markerCurve(m.marker)] : []),
    ],
    bar: m.bar === undefined ? undefined : {unit: m.bar, floor: m.floor},
  };
}

export function mapFigure(m: MapSpec): Plotted {
  return {
    id: m.id,
    title: m.title,
    words: m.words,
    chart: (theme) => chartOf(m, theme),
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
