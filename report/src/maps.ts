// Coloured maps with millimetres of equal length on both axes.
import {axis, baseLayout, type DataTable, type Drawing, type Figure, type Theme} from "./figures";

export interface Line {
  x: (number|null)[];
  y: (number|null)[];
  dash?: string;
}

export interface MapSpec {
  id: string;
  title: string;
  words?: (string|Node)[];
  x: number[];  // centres, or one more edge than columns
  y: number[];
  z: (number|null)[][];  // a row for each y
  centresX: number[];    // what the data table says
  centresY: number[];
  names: [x: string, y: string, z: string];  // of columns, with units
  labels: [x: string, y: string];            // of axes
  hover: string;                             // of the value: "p %{z:.1f} MPa"
  hoverY: string;                            // "y" or "depth"
  bar: string;                               // title of the colour bar
  floor?: boolean;                           // values below the range exist and take its lowest colour
  range: [number, number];
  colours: (theme: Theme) => unknown;
  reversed?: boolean;  // y grows downwards
  discrete?: boolean;  // no colour bar
  smooth?: boolean;    // between points; cells keep their colour otherwise
  windowX: [number, number];
  windowY: [number, number];
  lines?: Line[];
  marker?: {x: number; y: number; text: string; symbol?: string};
  valueWords?: string[];  // hover text by value, for states
}

export function mapFigure(m: MapSpec): Figure {
  return {
    id: m.id,
    title: m.title,
    words: m.words,
    draw: (theme: Theme, width: number): Drawing => {
      const right = 100;
      const aspect = (m.windowY[1] - m.windowY[0]) / (m.windowX[1] - m.windowX[0]);
      const height = Math.round(Math.min(Math.max((width - 60 - right) * aspect, 90), 420) + 76);
      const hoverXY = `x %{x:.2f} mm, ${m.hoverY} %{y:.2f} mm`.replace(/^x/, m.labels[0].startsWith("y") ? "y" : "x");
      const ticks = m.floor ? {
        tickmode: "array",
        tickvals: [-1, -0.5, 0, 0.5, 1].map((v) => v * m.range[1]),
        ticktext:
            [-1, -0.5, 0, 0.5, 1].map((v) => `${v === -1 ? "≤ " : ""}${(v * m.range[1]).toFixed(0).replace("-", "−")}`)
      }
                            : {};
      const data: Record<string, unknown>[] = [
        {
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
          colorbar: {
            title: {text: m.bar, side: "top"},
            thickness: 12,
            len: 1,
            outlinewidth: 0,
            tickcolor: theme.soft,
            ...ticks
          },
          ...(m.valueWords ? {text: m.z.map((row) => row.map((v) => (v === null ? "" : m.valueWords![v])))} : {}),
          hovertemplate: `${hoverXY}<br><b>${m.hover}</b><extra></extra>`,
        },
      ];
      for (const line of m.lines ?? [])
        data.push({
          type: "scatter",
          mode: "lines",
          x: line.x,
          y: line.y,
          hoverinfo: "skip",
          line: {color: theme.ink, width: 1.6, dash: line.dash ?? "dash"}
        });
      // dark on light, to be seen on any colour
      for (const [color, line] of m.marker ? [["#ffffff", 4], ["#1b1f24", 1.6]] : [])
        data.push({
          type: "scatter",
          mode: "markers",
          x: [m.marker!.x],
          y: [m.marker!.y],
          hovertemplate: `${m.marker!.text}<extra></extra>`,
          cliponaxis: false,
          marker:
              {symbol: m.marker!.symbol ?? "cross-thin", size: 11, color: "rgba(0,0,0,0)", line: {color, width: line}},
        });
      const [low, high] = m.windowY;
      const layout = {
        ...baseLayout(theme, width, height),
        margin: {l: 58, r: right, t: 30, b: 46},
        xaxis: axis(theme, m.labels[0], {range: m.windowX, constrain: "domain", showgrid: false, zeroline: false}),
        yaxis: axis(theme, m.labels[1], {
          range: m.reversed ? [high, low] : [low, high],
          scaleanchor: "x",
          scaleratio: 1,
          constrain: "domain",
          showgrid: false,
          zeroline: false
        }),
      };
      return {data, layout};
    },
    table: (): DataTable => ({
      names: m.names,
      rows: m.centresY.flatMap((y, j) => m.centresX.map((x, i) => [x, y, m.z[j][i]])),
    }),
  };
}

/// What all of them cover: pictures of several runs show the same piece of the body.
export function commonWindow(all: number[][]): [number, number] {
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
