// Charts: cells in colour, lines and marks in a plane with axes. What they say of a place; where they are hidden.
import {drawAxes, roomOf, type Axis} from "./axes";
import {canvasIn, drawBar, kAbove, px, py, type Pixel, type Plane} from "./canvas";
import {pixelsOf, rgb, type Scale} from "./scale";
import {letters, type Theme} from "./theme";
import type {Span, Values} from "./types";

export type Dash = "solid"|"dash"|"dot"|"dashdot";
const kDashes: Record<Dash, number[]> = {
  solid: [],
  dash: [7, 4],
  dot: [2, 3],
  dashdot: [7, 3, 2, 3]
};

/// A line with gaps where a value is missing, or marks alone.
export interface Curve {
  name: string;
  x: Values;
  y: Values;
  colour: string;
  width?: number;  // of the line, px; 0: marks alone
  dash?: Dash;
  mark?: "dot"|"circle"|"square"|"cross";
  halo?: string;                             // below it and broader, to be seen on any colour
  quiet?: boolean;                           // not in the legend
  words?: (x: number, y: number) => string;  // of a point; none: it says nothing
}

/// Coloured cells between these borders, a row for each y.
export interface Cells {
  x: number[];
  y: number[];
  at: {x: number[]; y: number[]};  // their middles
  z: Values[];
  scale: Scale;
  gap?: number;  // px, between them
  words: (column: number, row: number) => string;
  letters?: (column: number, row: number) => {
    lines: string[];
    colour: string
  } | null;
}

export interface Chart {
  x: Axis;
  y: Axis;
  height: number;   // of the plane, px; with equal units the most
  equal?: boolean;  // units of both axes are of one length
  grid?: boolean;
  cells?: Cells;
  curves: Curve[];
  legend?: boolean;
  band?: Span;        // shaded range of x
  levels?: number[];  // dashed lines across at these y
  bar?: {unit: string; floor?: boolean};
}

/// What of a chart is looked at: a part of its plane, without some of its curves.
export interface Look {
  view: {x: Span; y: Span}|null;
  hidden: Set<number>;
}

/// A chart as it stands on the page.
export interface Drawn {
  chart: Chart;
  plane: Plane;
  data: (Cells|Curve)[];
  width: number;
  paper: string;
}

const at = (axis: Axis, v: number) => (axis.log ? Math.log10(v) : v);

/// The place of a point; null where there is none.
export function placeOf({chart, plane}: Drawn, curve: Curve, k: number): Pixel|null {
  const [x, y] = [curve.x[k], curve.y[k]];
  if (x === null || y === null || !Number.isFinite(x) || !Number.isFinite(y)) return null;
  return [px(plane, at(chart.x, x)), py(plane, at(chart.y, y))];
}

// ---- layout

function planeOf(c: CanvasRenderingContext2D, chart: Chart, width: number, size: number, look: Look): Plane {
  const [x, y] = [look.view?.x ?? chart.x.range, look.view?.y ?? chart.y.range];
  const axes: [Axis, Axis] = [{...chart.x, range: x}, {...chart.y, range: y}];
  const length = (span: Span) => Math.abs(span[1] - span[0]);
  const room = roomOf(c, axes, [width - 60, chart.height], size);
  const wide = width - room.left - 14;
  const top = chart.bar ? kAbove : 10;
  if (!chart.equal) return {left: room.left, top, width: wide, height: chart.height, x, y};
  const scale = Math.min(wide / length(chart.x.range), chart.height / length(chart.y.range));
  const box = {width: scale * length(chart.x.range), height: scale * length(chart.y.range)};
  return {left: room.left + 0.5 * (wide - box.width), top, ...box, x, y};
}

// ---- painting

/// Cells as pixels of the screen: each takes the colour of the cell that its middle is in.
function paintCells(c: CanvasRenderingContext2D, p: Plane, cells: Cells, theme: Theme): void {
  const dense = c.getTransform().a;
  const [wide, high] = [Math.round(dense * p.width), Math.round(dense * p.height)];
  const image = new ImageData(wide, high);
  const pixels = new Uint32Array(image.data.buffer);
  const colours = pixelsOf(cells.scale, theme);
  const [low, top] = cells.scale.range;
  const columns =
      Array.from({length: wide}, (_, i) => cellAt(cells.x, p.x[0] + ((i + 0.5) / wide) * (p.x[1] - p.x[0])));
  for (let j = 0; j < high; ++j) {
    const row = cells.z[cellAt(cells.y, p.y[1] + ((j + 0.5) / high) * (p.y[0] - p.y[1]))];
    if (!row) continue;
    for (let i = 0; i < wide; ++i) {
      const v = row[columns[i]] ?? null;
      if (v === null) continue;
      const k = Math.floor((256 * (v - low)) / (top - low));
      pixels[i + wide * j] = colours[k < 0 ? 0 : k > 255 ? 255 : k];
    }
  }
  const picture = document.createElement("canvas");
  [picture.width, picture.height] = [wide, high];
  picture.getContext("2d")!.putImageData(image, 0, 0);
  c.drawImage(picture, p.left, p.top, p.width, p.height);
}

/// Place between borders that rise or fall; -1 outside.
function cellAt(borders: number[], v: number): number {
  const n = borders.length - 1;
  const up = borders[n] > borders[0];
  let [low, high] = [0, n];
  const before = (k: number) => (up ? v < borders[k] : v > borders[k]);
  if (before(0) || !before(n)) return v === borders[n] ? n - 1 : -1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (before(middle))
      high = middle;
    else
      low = middle;
  }
  return low;
}

/// Cells one by one, with what stands in them.
function paintTiles(c: CanvasRenderingContext2D, p: Plane, cells: Cells, theme: Theme): void {
  const half = 0.5 * (cells.gap ?? 0);
  c.font = letters(theme.size + 1);
  c.textAlign = "center";
  c.textBaseline = "middle";
  cells.z.forEach((row, j) => row.forEach((v, i) => {
    if (v === null) return;
    const [left, right] = [px(p, cells.x[i]), px(p, cells.x[i + 1])].sort((a, b) => a - b);
    const [top, bottom] = [py(p, cells.y[j]), py(p, cells.y[j + 1])].sort((a, b) => a - b);
    c.fillStyle = rgb(cells.scale.colour(v, theme));
    c.fillRect(left + half, top + half, right - left - 2 * half, bottom - top - 2 * half);
    const words = cells.letters?.(i, j);
    if (!words) return;
    c.fillStyle = words.colour;
    const line = 1.2 * theme.size;
    words.lines.forEach(
        (text, k) =>
            c.fillText(text, 0.5 * (left + right), 0.5 * (top + bottom) + line * (k - 0.5 * (words.lines.length - 1))));
  }));
}

function paintMark(c: CanvasRenderingContext2D, mark: NonNullable<Curve["mark"]>, [x, y]: Pixel): void {
  c.beginPath();
  if (mark === "dot" || mark === "circle") c.arc(x, y, mark === "dot" ? 2.6 : 5.5, 0, 2 * Math.PI);
  if (mark === "square") c.rect(x - 5, y - 5, 10, 10);
  if (mark === "cross")
    for (const [dx, dy] of [[5.5, 0], [0, 5.5]]) {
      c.moveTo(x - dx, y - dy);
      c.lineTo(x + dx, y + dy);
    }
  if (mark === "dot")
    c.fill();
  else
    c.stroke();
}

/// Of marks alone those whose middle is in the plane, all of them.
function paintCurve(c: CanvasRenderingContext2D, drawn: Drawn, curve: Curve): void {
  const width = curve.width ?? 1.8;
  const places =
      curve.x.map((_, k) => placeOf(drawn, curve, k)).map((p) => (p && (width || inside(drawn.plane, p)) ? p : null));
  const strokes: [string, number][] =
      [...(curve.halo ? [[curve.halo, 1.9] as [string, number]] : []), [curve.colour, 0]];
  for (const [colour, more] of strokes) {
    c.strokeStyle = c.fillStyle = colour;
    c.lineJoin = "round";
    c.lineWidth = width + more;
    c.setLineDash(kDashes[curve.dash ?? "solid"]);
    c.beginPath();
    places.forEach((place, k) => place && (places[k - 1] ? c.lineTo(...place) : c.moveTo(...place)));
    if (width) c.stroke();
    c.setLineDash([]);
    c.lineWidth = (width || 1.8) + more;
    for (const place of places)
      if (curve.mark && place) paintMark(c, curve.mark, place);
  }
}

function paintInside(c: CanvasRenderingContext2D, drawn: Drawn, theme: Theme, look: Look): void {
  const {chart, plane: p} = drawn;
  if (chart.cells) (chart.cells.gap ? paintTiles : paintCells)(c, p, chart.cells, theme);
  c.strokeStyle = theme.ink;
  c.lineWidth = 1.4;
  c.setLineDash(kDashes.dash);
  for (const y of chart.levels ?? []) {
    c.beginPath();
    c.moveTo(p.left, py(p, at(chart.y, y)));
    c.lineTo(p.left + p.width, py(p, at(chart.y, y)));
    c.stroke();
  }
  c.setLineDash([]);
  chart.curves.forEach((curve, k) => look.hidden.has(k) || curve.width === 0 || paintCurve(c, drawn, curve));
}

export function paintChart(host: HTMLElement, chart: Chart, theme: Theme, width: number, look: Look): Drawn {
  const plane = planeOf(measuring(), chart, width, theme.size, look);
  const room = roomOf(measuring(), [chart.x, chart.y], [plane.width, plane.height], theme.size);
  const c = canvasIn(host, width, plane.top + plane.height + room.below + 4);
  c.fillStyle = theme.paper;
  c.fillRect(0, 0, width, plane.top + plane.height + room.below + 4);
  const data = [...(chart.cells ? [chart.cells] : []), ...chart.curves];
  const drawn = {chart, plane, data, width, paper: theme.paper};
  const clipped = (paint: () => void) => {
    c.save();
    c.beginPath();
    c.rect(plane.left, plane.top, plane.width, plane.height);
    c.clip();
    paint();
    c.restore();
  };
  const {band} = chart;
  clipped(() => {
    if (!band) return;
    c.globalAlpha = 0.15;
    c.fillStyle = theme.soft;
    c.fillRect(px(plane, band[0]), plane.top, px(plane, band[1]) - px(plane, band[0]), plane.height);
  });
  drawAxes(c, plane, theme, [{...chart.x, range: plane.x}, {...chart.y, range: plane.y}], theme.size, chart.grid);
  clipped(() => paintInside(c, drawn, theme, look));
  chart.curves.forEach((curve, k) => look.hidden.has(k) || curve.width !== 0 || paintCurve(c, drawn, curve));
  if (chart.cells && chart.bar) drawBar(c, plane, theme, chart.cells.scale, chart.bar.unit, chart.bar.floor);
  return drawn;
}

let ruler: CanvasRenderingContext2D|null = null;
/// To measure letters with.
function measuring(): CanvasRenderingContext2D { return ruler ??= document.createElement("canvas").getContext("2d")!; }

// ---- words

/// A place with what there is to be said of it.
export interface Reading {
  words: string;
  place: Pixel;
  curve: number;            // -1: a cell
  point: [number, number];  // of the curve; column and row of the cell
}

/// Of a point of a curve; null where it is missing, hidden or out of sight.
export function pointReading(drawn: Drawn, look: Look, curve: number, k: number): Reading|null {
  const line = drawn.chart.curves[curve];
  const place = look.hidden.has(curve) || !line.words ? null : placeOf(drawn, line, k);
  if (!place || !inside(drawn.plane, place)) return null;
  const name = drawn.chart.legend && line.name ? `\n${line.name}` : "";
  return {words: line.words!(line.x[k]!, line.y[k]!) + name, place, curve, point: [k, 0]};
}

export function cellReading({chart, plane}: Drawn, column: number, row: number): Reading|null {
  const {cells} = chart;
  if (!cells || (cells.z[row]?.[column] ?? null) === null) return null;
  const place: Pixel = [px(plane, cells.at.x[column]), py(plane, cells.at.y[row])];
  return {words: cells.words(column, row), place, curve: -1, point: [column, row]};
}

export function inside(p: Plane, [x, y]: Pixel): boolean {
  const near = 0.5;
  return x >= p.left - near && x <= p.left + p.width + near && y >= p.top - near && y <= p.top + p.height + near;
}

const kReach = 24;   // px, from a pointer to a point of a line
const kReachOn = 8;  // where cells are below it

/// What is nearest to a pointer: a point of a curve, else the cell below it.
export function readingAt(drawn: Drawn, look: Look, pointer: Pixel): Reading|null {
  const {chart, plane} = drawn;
  let best: Reading|null = null;
  let reach = chart.cells ? kReachOn : kReach;
  chart.curves.forEach((curve, n) => {
    if (!curve.words || look.hidden.has(n)) return;
    curve.x.forEach((_, k) => {
      const place = placeOf(drawn, curve, k);
      const far = place ? Math.hypot(place[0] - pointer[0], place[1] - pointer[1]) : Infinity;
      if (far >= reach) return;
      const reading = pointReading(drawn, look, n, k);
      if (reading) [best, reach] = [reading, far];
    });
  });
  if (best || !chart.cells || !inside(plane, pointer)) return best;
  const x = plane.x[0] + ((pointer[0] - plane.left) / plane.width) * (plane.x[1] - plane.x[0]);
  const y = plane.y[1] + ((pointer[1] - plane.top) / plane.height) * (plane.y[0] - plane.y[1]);
  const reading = cellReading(drawn, cellAt(chart.cells.x, x), cellAt(chart.cells.y, y));
  return reading && {...reading, place: pointer};
}
