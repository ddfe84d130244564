// Axes of a plane: where their marks stand, what they say, how much room they take.
import {px, py, type Plane} from "./canvas";
import {fixedText, minus, powerOfTen} from "./text";
import {letters, type Theme} from "./theme";
import type {Span} from "./types";

export interface Axis {
  title: string;
  range: Span;  // of a logarithmic axis exponents of ten; from high to low: it grows the other way
  log?: boolean;
  names?: string[];  // of the places 0, 1, 2, …
}

interface Mark {
  at: number;
  text: string;
}

/// 1, 2 or 5 times a power of ten: the first that is no shorter than a part of the length.
export function stepOf(length: number, parts: number): number {
  const rough = length / Math.max(1, parts);
  const power = 10 ** Math.floor(Math.log10(rough));
  return power * ([1, 2, 5, 10].find((f) => f * power >= rough * (1 - 1e-9)) ?? 10);
}

/// Values as the steps of an axis have them: all with the same decimals, of small and of large ones with one power.
function textsOf(values: number[], step: number): string[] {
  const size = Math.max(...values.map(Math.abs));
  const power = size >= 1e5 || size < 1e-3 ? Math.floor(Math.log10(size || 1)) : 0;
  const decimals = Math.max(0, power - Math.floor(Math.log10(step) + 1e-9));
  const text = (v: number) => (v === 0 ? "0" : `${fixedText(v / 10 ** power, decimals)} × ${powerOfTen(power)}`);
  return values.map(power ? text : (v) => fixedText(v, decimals));
}

function decadeMarks(low: number, high: number): Mark[] {
  const digits = high - low < 1.5 ? [1, 2, 3, 5] : [1];
  const first = Math.floor(low);
  const all = Array.from({length: Math.ceil(high) - first + 1}, (_, k) => first + k);
  const plain = (v: number) => minus(String(Number(v.toPrecision(1))));
  const text = (d: number, power: number) =>
      Math.abs(power) < 4 ? plain(d * 10 ** power) : `${d === 1 ? "" : `${d} × `}${powerOfTen(power)}`;
  return all.flatMap((power) => digits.map((d) => ({at: power + Math.log10(d), text: text(d, power)})));
}

/// `apart`: pixels from one mark to the next at least.
export function marksOf(axis: Axis, length: number, apart: number): Mark[] {
  const low = Math.min(...axis.range);
  const high = Math.max(...axis.range);
  const inside = ({at}: Mark) => at >= low - 1e-9 * (high - low) && at <= high + 1e-9 * (high - low);
  if (axis.names) return axis.names.map((text, at) => ({at, text})).filter(inside);
  if (axis.log) {
    const marks = decadeMarks(low, high).filter(inside);
    const every = Math.ceil((marks.length * apart) / Math.max(length, apart));
    return marks.filter((_, k) => k % every === 0);
  }
  const step = stepOf(high - low, length / apart);
  const first = Math.ceil(low / step - 1e-9);
  const values = Array.from({length: Math.floor(high / step + 1e-9) - first + 1}, (_, k) => step * (first + k));
  const texts = textsOf(values, step);
  return values.map((at, k) => ({at, text: texts[k]}));
}

const kApart: [x: number, y: number] = [62, 34];  // px

/// A title on two lines where one is longer than its axis: broken at a comma, or at a space near the middle.
export function linesOf(c: CanvasRenderingContext2D, title: string, room: number): string[] {
  if (c.measureText(title).width <= room) return [title];
  const middle = 0.5 * title.length;
  const places = [...title.matchAll(/, | /g)].map((m) => ({at: m.index + m[0].length, comma: m[0].length > 1}));
  const cost = (place: {at: number; comma: boolean}) => Math.abs(place.at - middle) - (place.comma ? 8 : 0);
  const best = places.sort((a, b) => cost(a) - cost(b))[0];
  return best ? [title.slice(0, best.at).trimEnd(), title.slice(best.at)] : [title];
}

/// Room that axes of so many pixels take on the left of a plane and below it, their letters of this size.
export function roomOf(
    c: CanvasRenderingContext2D, [x, y]: [Axis, Axis], [width, height]: [number, number],
    size: number): {left: number; below: number} {
  c.font = letters(size);
  const widest = Math.max(0, ...marksOf(y, height, kApart[1]).map(({text}) => c.measureText(text).width));
  const line = 1.2 * size;
  return {
    left: Math.ceil(12 + widest + line * linesOf(c, y.title, height).length),
    below: Math.ceil(8 + line * (1 + linesOf(c, x.title, width).length)),
  };
}

function drawTitles(c: CanvasRenderingContext2D, p: Plane, [x, y]: [Axis, Axis], size: number, widest: number): void {
  const line = 1.2 * size;
  c.textAlign = "center";
  c.textBaseline = "top";
  linesOf(c, x.title, p.width)
      .forEach((text, k) => c.fillText(text, p.left + 0.5 * p.width, p.top + p.height + 7 + line * (1 + k)));
  const lines = linesOf(c, y.title, p.height);
  c.save();
  c.translate(Math.max(p.left - 10 - widest - line * lines.length, 0), p.top + 0.5 * p.height);
  c.rotate(-0.5 * Math.PI);
  lines.forEach((text, k) => c.fillText(text, 0, line * k));
  c.restore();
}

/// Frame, marks and the names of both axes; `grid`: lines across the plane at the marks.
export function drawAxes(
    c: CanvasRenderingContext2D, p: Plane, theme: Theme, axes: [Axis, Axis], size = 11, grid = false): void {
  const [x, y] = [marksOf(axes[0], p.width, kApart[0]), marksOf(axes[1], p.height, kApart[1])];
  c.font = letters(size);
  c.lineWidth = 1;
  if (grid) {
    c.fillStyle = theme.grid;
    for (const {at} of x) c.fillRect(px(p, at) - 0.5, p.top, 1, p.height);
    for (const {at} of y) c.fillRect(p.left, py(p, at) - 0.5, p.width, 1);
  }
  c.strokeStyle = theme.soft;
  c.fillStyle = theme.soft;
  c.strokeRect(p.left, p.top, p.width, p.height);
  c.textAlign = "center";
  c.textBaseline = "top";
  for (const {at, text} of x) {
    c.fillRect(px(p, at) - 0.5, p.top + p.height, 1, 4);
    c.fillText(text, px(p, at), p.top + p.height + 6);
  }
  c.textAlign = "right";
  c.textBaseline = "middle";
  for (const {at, text} of y) {
    c.fillRect(p.left - 4, py(p, at) - 0.5, 4, 1);
    c.fillText(text, p.left - 7, py(p, at));
  }
  drawTitles(c, p, axes, size, Math.max(0, ...y.map(({text}) => c.measureText(text).width)));
}
