// Painting on a canvas: planes with their axes, colours of values, arrows, pieces. Sharp on any screen and in print.
import {element} from "./dom";
import {rgb, type Scale} from "./scale";
import {fixedText, numberText} from "./text";
import {letters, type Theme} from "./theme";
import type {Span} from "./types";

let finest = 2;  // pixels of a canvas in one of the page, at least

/// For print as fine as a printer has it, else as a screen.
export function paintFor(medium: "print"|"screen"): void { finest = medium === "print" ? 3 : 2; }

/// A blank canvas as wide as its frame, its pixels those of the screen or finer; what stood in the frame goes.
export function canvasIn(host: HTMLElement, width: number, height: number): CanvasRenderingContext2D {
  const dense = Math.max(finest, window.devicePixelRatio);
  const canvas = host.querySelector("canvas") ?? element("canvas");
  if (!canvas.isConnected) host.replaceChildren(canvas);
  canvas.width = Math.round(dense * width);
  canvas.height = Math.round(dense * height);
  canvas.style.width = `${width}px`;
  canvas.style.height = `${height}px`;
  const c = canvas.getContext("2d")!;
  c.setTransform(dense, 0, 0, dense, 0, 0);
  c.clearRect(0, 0, width, height);
  return c;
}

/// Words beside a place of a frame; null: none.
export function showWords(host: HTMLElement, text: string|null, [x, y]: Pixel): void {
  const words =
      host.querySelector<HTMLElement>(".under") ?? element("div", {class: "under", hidden: "", "aria-live": "polite"});
  if (!words.isConnected) host.append(words);
  words.hidden = text === null;
  words.textContent = text;
  const right = x > 0.5 * host.clientWidth;
  words.style.left = right ? "auto" : `${x + 12}px`;
  words.style.right = right ? `${host.clientWidth - x + 12}px` : "auto";
  words.style.top = `${y + 14}px`;
}

/// Where a pointer is in a frame.
export function placeIn(host: HTMLElement, event: {clientX: number; clientY: number}): Pixel {
  const box = host.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

/// Shows words beside the pointer where there are any.
export function wordsUnderPointer(host: HTMLElement, at: (place: Pixel) => string | null): void {
  host.onpointerleave = (event) => event.pointerType === "touch" || showWords(host, null, [0, 0]);
  host.onpointerdown = host.onpointermove = (event) => {
    const place = placeIn(host, event);
    showWords(host, at(place), place);
  };
}

/// A part of a plane on the canvas.
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

const kLeft = 44;  // px, around the plane
export const kAbove = 34;
const kBelow = 34;

/// The plane that fits these spans into a width: no higher than `highest`, in the middle of what is left.
export function planeFor(width: number, x: Span, y: Span, highest: number): {plane: Plane; height: number} {
  const scale = Math.min((width - kLeft - 8) / (x[1] - x[0]), highest / (y[1] - y[0]));
  const size = {width: scale * (x[1] - x[0]), height: scale * (y[1] - y[0])};
  const left = kLeft + 0.5 * (width - kLeft - 8 - size.width);
  return {plane: {left, top: kAbove, ...size, x, y}, height: size.height + kAbove + kBelow};
}

/// A bar of these colours above the plane, on the right. `floor`: values below its range exist and have its lowest.
export function drawBar(
    c: CanvasRenderingContext2D, p: Plane, theme: Theme, {range, colour}: Scale, unit: string, floor = false): void {
  const [low, high] = range;
  const right = Math.max(p.left + p.width, Math.min(parseFloat(c.canvas.style.width) - 8, p.left + 220));
  const width = Math.min(150, 0.55 * (right - kLeft));
  const left = right - width;
  const y = p.top - 26;
  for (let k = 0; k < width; ++k) {
    c.fillStyle = rgb(colour(low + (k / width) * (high - low), theme));
    c.fillRect(left + k, y, Math.min(1.5, width - k), 8);
  }
  const text = (v: number) => (Math.abs(v) >= 100 ? fixedText(v, 0) : numberText(v, 3));
  c.fillStyle = theme.soft;
  c.font = letters(11);
  c.textBaseline = "top";
  c.textAlign = "left";
  c.fillText((floor ? "≤ " : "") + text(low), left, y + 10);
  if (low < 0) {
    c.textAlign = "center";
    c.fillText("0", left + 0.5 * width, y + 10);
  }
  c.textAlign = "right";
  c.fillText(`${text(high)} ${unit}`.trim(), left + width, y + 10);
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
