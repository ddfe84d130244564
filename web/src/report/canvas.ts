// Pictures painted by hand, where a chart library has nothing: bodies in their own shape, arrows, views in space. Sharp
// on any screen, with the words for the place under the pointer.
import type {Span} from "./data";
import {element} from "./dom";
import type {Theme} from "./figures";
import {fixedText, numberText} from "./text";

type Colour = [red: number, green: number, blue: number];

/// Viridis, the colours of the maps.
const kViridis: Colour[] = [
  [68, 1, 84],
  [72, 40, 120],
  [62, 73, 137],
  [49, 104, 142],
  [38, 130, 142],
  [31, 158, 137],
  [53, 183, 121],
  [110, 206, 88],
  [181, 222, 43],
  [253, 231, 37],
];

/// Of a share from 0 to 1.
export function viridis(share: number): Colour {
  const t = Math.min(Math.max(share, 0), 1) * (kViridis.length - 1);
  const k = Math.min(Math.floor(t), kViridis.length - 2);
  return kViridis[k].map((low, n) => Math.round(low + (t - k) * (kViridis[k + 1][n] - low))) as Colour;
}

export const rgb = ([r, g, b]: Colour, light = 1) =>
    `rgb(${[r, g, b].map((v) => Math.round(Math.min(255, light * v))).join(",")})`;

const kFont = 'system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';
export const letters = (size: number, weight = "") => `${weight} ${size}px ${kFont}`.trim();

/// A canvas as wide as its frame, its pixels those of the screen or finer; what stood in the frame goes.
export function canvasIn(host: HTMLElement, width: number, height: number): CanvasRenderingContext2D {
  const dense = Math.max(2, window.devicePixelRatio);
  const canvas = host.querySelector("canvas") ?? element("canvas");
  if (!canvas.isConnected) host.replaceChildren(canvas);
  canvas.width = Math.round(dense * width);
  canvas.height = Math.round(dense * height);
  canvas.style.width = `${width}px`;
  canvas.style.height = `${height}px`;
  const c = canvas.getContext("2d")!;
  c.setTransform(dense, 0, 0, dense, 0, 0);
  return c;
}

/// Shows words beside the pointer where there are any.
export function wordsUnderPointer(host: HTMLElement, at: (px: number, py: number) => string | null): void {
  const words = host.querySelector<HTMLElement>(".under") ?? element("div", {class: "under", hidden: ""});
  host.append(words);
  host.onpointerleave = () => (words.hidden = true);
  host.onpointermove = (event) => {
    const box = host.getBoundingClientRect();
    const [px, py] = [event.clientX - box.left, event.clientY - box.top];
    const text = at(px, py);
    words.hidden = text === null;
    words.textContent = text;
    const right = px > 0.5 * box.width;
    words.style.left = right ? "auto" : `${px + 12}px`;
    words.style.right = right ? `${box.width - px + 12}px` : "auto";
    words.style.top = `${py + 14}px`;
  };
}

/// A part of a plane on the canvas, millimetres of equal length on both axes.
export interface Plane {
  left: number;
  top: number;
  width: number;
  height: number;
  x: Span;
  y: Span;  // upwards
}

export const px = (p: Plane, x: number) => p.left + (p.width * (x - p.x[0])) / (p.x[1] - p.x[0]);
export const py = (p: Plane, y: number) => p.top + (p.height * (p.y[1] - y)) / (p.y[1] - p.y[0]);

const kLeft = 44;
const kAbove = 34;
const kBelow = 34;

/// The plane that fits these spans into a width: no higher than `highest`, in the middle of what is left.
export function planeFor(width: number, x: Span, y: Span, highest: number): {plane: Plane; height: number} {
  const scale = Math.min((width - kLeft - 8) / (x[1] - x[0]), highest / (y[1] - y[0]));
  const size = {width: scale * (x[1] - x[0]), height: scale * (y[1] - y[0])};
  const left = kLeft + 0.5 * (width - kLeft - 8 - size.width);
  return {plane: {left, top: kAbove, ...size, x, y}, height: size.height + kAbove + kBelow};
}

/// 1, 2 or 5 times a power of ten: some five of them fill the length.
export function tickStep(length: number): number {
  const power = 10 ** Math.floor(Math.log10(length / 5));
  return [1, 2, 5, 10].map((m) => m * power).find((step) => length / step <= 6)!;
}

function ticks([low, high]: Span): number[] {
  const step = tickStep(high - low);
  const first = Math.ceil(low / step - 1e-9);
  return Array.from({length: Math.floor(high / step + 1e-9) - first + 1}, (_, k) => step * (first + k));
}

export const tickText = (v: number) => String(Number(v.toPrecision(6))).replace("-", "−");

/// Frame, ticks and the names of both axes. `depth`: names of y count downwards.
export function drawAxes(
    c: CanvasRenderingContext2D, p: Plane, theme: Theme, [along, up]: [x: string, y: string], yText = tickText): void {
  c.strokeStyle = theme.soft;
  c.fillStyle = theme.soft;
  c.lineWidth = 1;
  c.strokeRect(p.left, p.top, p.width, p.height);
  c.font = letters(11);
  c.textAlign = "center";
  c.textBaseline = "top";
  for (const x of ticks(p.x)) {
    c.fillRect(px(p, x), p.top + p.height, 1, 4);
    c.fillText(tickText(x), px(p, x), p.top + p.height + 5);
  }
  c.fillText(along, p.left + 0.5 * p.width, p.top + p.height + 19);
  c.textAlign = "right";
  c.textBaseline = "middle";
  for (const y of ticks(p.y)) {
    c.fillRect(p.left - 4, py(p, y), 4, 1);
    c.fillText(yText(y), p.left - 6, py(p, y));
  }
  c.save();
  c.translate(p.left - 34, p.top + 0.5 * p.height);
  c.rotate(-0.5 * Math.PI);
  c.textAlign = "center";
  c.fillText(up, 0, 0);
  c.restore();
}

/// Colours of a range of values.
export interface Scale {
  range: Span;
  colour: (v: number, theme: Theme) => string;
}

export const magnitudeScale = (top: number): Scale => ({range: [0, top], colour: (v) => rgb(viridis(v / top))});

const kBlue: Colour = [33, 102, 172];
const kRed: Colour = [178, 24, 43];

/// Compression blue, tension red, zero the paper's shade.
export function signedScale(top: number): Scale {
  const colour = (v: number, theme: Theme) => {
    const paper: Colour = theme.paper === "#ffffff" ? [247, 247, 247] : [42, 47, 54];
    const share = Math.min(Math.abs(v) / top, 1);
    const end = v < 0 ? kBlue : kRed;
    return rgb(paper.map((low, n) => Math.round(low + share * (end[n] - low))) as Colour);
  };
  return {range: [-top, top], colour};
}

/// A bar of these colours above the plane, on the right.
export function drawBar(
    c: CanvasRenderingContext2D, p: Plane, theme: Theme, {range, colour}: Scale, unit: string): void {
  const right = Math.max(p.left + p.width, Math.min(parseFloat(c.canvas.style.width) - 8, p.left + 220));
  const width = Math.min(130, 0.5 * (right - 44));
  const left = right - width;
  const y = p.top - 26;
  for (let k = 0; k < width; ++k) {
    c.fillStyle = colour(range[0] + (k / width) * (range[1] - range[0]), theme);
    c.fillRect(left + k, y, 1.5, 8);
  }
  const text = (v: number) => (Math.abs(v) >= 100 ? fixedText(v, 0) : numberText(v, 3));
  c.fillStyle = theme.soft;
  c.font = letters(11);
  c.textBaseline = "top";
  c.textAlign = "left";
  c.fillText(text(range[0]), left, y + 10);
  c.textAlign = "right";
  c.fillText(`${text(range[1])} ${unit}`, left + width, y + 10);
}

/// The way the wheel rolls, above the plane on the left.
export function drawRolling(c: CanvasRenderingContext2D, p: Plane, theme: Theme): void {
  const left = Math.min(p.left, 44);
  drawArrow(c, [left, p.top - 20], [left + 26, p.top - 20], theme.ink, 1.4);
  c.fillStyle = theme.soft;
  c.font = letters(11);
  c.textAlign = "left";
  c.textBaseline = "middle";
  c.fillText("rolling", left + 31, p.top - 20);
}

function arrowPath(c: CanvasRenderingContext2D, [x0, y0]: Pixel, [x1, y1]: Pixel): void {
  const length = Math.hypot(x1 - x0, y1 - y0);
  const head = Math.min(5, 0.45 * length);
  const way = Math.atan2(y1 - y0, x1 - x0);
  c.beginPath();
  c.moveTo(x0, y0);
  c.lineTo(x1, y1);
  for (const side of [-0.5, 0.5]) {
    c.moveTo(x1, y1);
    c.lineTo(x1 - head * Math.cos(way + side), y1 - head * Math.sin(way + side));
  }
}

/// `halo`: around it, to be seen on any colour.
export function drawArrow(
    c: CanvasRenderingContext2D, from: Pixel, to: Pixel, colour: string, width: number, halo = ""): void {
  arrowPath(c, from, to);
  c.lineCap = "round";
  if (halo) {
    c.strokeStyle = halo;
    c.lineWidth = width + 1.8;
    c.stroke();
  }
  c.strokeStyle = colour;
  c.lineWidth = width;
  c.stroke();
}

export function drawCross(c: CanvasRenderingContext2D, x: number, y: number): void {
  for (const [colour, width] of [["#ffffff", 3.6], ["#1b1f24", 1.4]] as const) {
    c.strokeStyle = colour;
    c.lineWidth = width;
    c.beginPath();
    c.moveTo(x - 5, y);
    c.lineTo(x + 5, y);
    c.moveTo(x, y - 5);
    c.lineTo(x, y + 5);
    c.stroke();
  }
}

export function drawPath(c: CanvasRenderingContext2D, points: Pixel[], close = false): void {
  c.beginPath();
  points.forEach(([x, y], k) => (k === 0 ? c.moveTo(x, y) : c.lineTo(x, y)));
  if (close) c.closePath();
}

export type Pixel = [x: number, y: number];

/// A coloured piece of a picture.
export interface Piece {
  corners: Pixel[];
  colour: string;
  words: string;
}

export function paintPieces(c: CanvasRenderingContext2D, pieces: Piece[]): void {
  c.lineWidth = 0.6;
  for (const {corners, colour} of pieces) {
    drawPath(c, corners, true);
    c.fillStyle = c.strokeStyle = colour;
    c.fill();
    c.stroke();  // no seams
  }
}

/// The words of the piece whose middle is nearest, if it is there.
export function wordsAt(pieces: Piece[], [x, y]: Pixel): string|null {
  let best: {words: string; far: number}|null = null;
  for (const {corners, words} of pieces) {
    const xs = corners.map((p) => p[0]);
    const ys = corners.map((p) => p[1]);
    const [left, right, top, bottom] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
    if (x < left || x > right || y < top || y > bottom) continue;
    const far = Math.hypot(x - 0.5 * (left + right), y - 0.5 * (top + bottom));
    if (!best || far < best.far) best = {words, far};
  }
  return best?.words ?? null;
}
