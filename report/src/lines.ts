// Charts of lines.
import {axis, baseLayout, type DataTable, type Figure, type Theme} from "./figures";
import {plotText} from "./text";

export interface Series {
  name: string;
  x: (number|null)[];
  y: (number|null)[];
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
  downwards?: boolean;      // y grows downwards
  band?: [number, number];  // shaded range of x
  levels?: number[];        // dashed lines across at these y
  window?: [number, number];
  leastSpan?: number;  // of y, as a share of its largest value: small ripples stay small
  wide?: boolean;
}

/// A little more than the values take; lines do not run along the frame.
function roomFor(values: (number|null)[][], leastSpan = 0): [number, number] {
  let low = Infinity, high = -Infinity;
  for (const line of values)
    for (const v of line)
      if (v !== null && Number.isFinite(v)) low = Math.min(low, v), high = Math.max(high, v);
  if (low > high) return [0, 1];
  const size = Math.max(Math.abs(low), Math.abs(high));
  const span = Math.max(high - low, leastSpan * size) || 1;
  const middle = 0.5 * (low + high);
  return [middle - 0.54 * span, middle + 0.54 * span];
}

export function linesFigure(c: LinesSpec): Figure {
  return {
    id: c.id,
    title: c.title,
    words: c.words,
    wide: c.wide,
    draw: (theme, width) => ({
      data: c.series.map((s) => ({
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
                         })),
      layout: {
        ...baseLayout(theme, width, Math.min(c.height ?? 330, 0.75 * width + 40)),
        margin: {l: 62, r: 16, t: 30, b: 46},
        showlegend: c.series.length > 1,
        xaxis: axis(theme, c.labels[0], {range: c.window ?? roomFor(c.series.map((s) => s.x))}),
        yaxis: axis(theme, c.labels[1], {
          range: c.downwards ? [1.02 * Math.max(...c.series.flatMap((s) => s.y.map((v) => v ?? 0))), 0]
                             : roomFor(c.series.map((s) => s.y), c.leastSpan)
        }),
        shapes: [
          ...(c.band ? [{
            type: "rect",
            xref: "x",
            yref: "paper",
            x0: c.band[0],
            x1: c.band[1],
            y0: 0,
            y1: 1,
            fillcolor: theme.soft,
            opacity: 0.15,
            line: {width: 0}
          }]
                     : []),
          ...(c.levels ?? []).map((y) => ({
                                    type: "line",
                                    xref: "paper",
                                    yref: "y",
                                    x0: 0,
                                    x1: 1,
                                    y0: y,
                                    y1: y,
                                    line: {color: theme.ink, width: 1.4, dash: "dash"}
                                  })),
        ],
      },
    }),
    table: (): DataTable => ({
      names: ["series", ...c.names],
      rows:
          c.series.flatMap((s) => s.x.flatMap((x, i) => (x === null || s.y[i] === null ? [] : [[s.name, x, s.y[i]]]))),
    }),
  };
}
