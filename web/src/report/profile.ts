// Cross sections in the bodies' own shape: cells below the profiles, layers, rail and wheel.
import {drawAxes} from "../axes";
import {
  canvasIn,
  drawBar,
  drawPath,
  paintPieces,
  planeFor,
  px,
  py,
  wordsAt,
  wordsUnderPointer,
  type Piece,
  type Pixel,
  type Plane
} from "../canvas";
import {columnEdges, rowEdges} from "../edges";
import {rgb, type Scale} from "../scale";
import {fixedText} from "../text";
import {letters, type Theme} from "../theme";
import type {BodyName, Span, Values} from "../types";
import type {Geometry, Run} from "./data";

/// A profile as a line over y, with the direction into its body.
class Outline {
  private readonly points: Pixel[];
  constructor(metres: [number, number][], private readonly inwards: 1|- 1) {
    this.points = metres.map(([y, z]) => [1e3 * y, 1e3 * z]);
    if (this.points[0][0] > this.points[this.points.length - 1][0]) this.points.reverse();
  }

  line(): Pixel[] { return this.points; }

  /// So deep below the surface along its normal; null beside the profile.
  at(y: number, depth: number): Pixel|null {
    const k = this.points.findIndex((p, i) => i > 0 && p[0] >= y && this.points[i - 1][0] <= y);
    if (k < 0) return null;
    const [a, b] = [this.points[k - 1], this.points[k]];
    const [dy, dz] = [b[0] - a[0], b[1] - a[1]];
    const length = Math.hypot(dy, dz) || 1;
    const share = dy ? (y - a[0]) / dy : 0;
    const up: Pixel = [-dz / length, dy / length];
    return [y + this.inwards * depth * up[0], a[1] + share * dz + this.inwards * depth * up[1]];
  }
}

export const outlines = (g: Geometry): Record<BodyName, Outline> =>
    ({rail: new Outline(g.rail_m, -1), wheel: new Outline(g.wheel_m, 1)});

/// A cell of a cross section in its body's shape.
export interface SectionCell {
  corners: [y: number, z: number][];
  y: number;
  depth: number;
  body: BodyName;
  value: number;
}

/// Whether the corners go round against the clock. Normals cross below the centre of a sharp curve: cells beyond it
/// would be inside out.
function turned(corners: Pixel[]): boolean {
  const area = corners.reduce((sum, [y, z], k) => {
    const [nextY, nextZ] = corners[(k + 1) % corners.length];
    return sum + y * nextZ - nextY * z;
  }, 0);
  return area > 0;
}

/// The cells of a cross section: a row of values for each depth.
export function cellsBelow(
    g: Geometry, body: BodyName, along: number[], depths: number[], values: Values[]): SectionCell[] {
  const outline = outlines(g)[body];
  const [y, depth] = [columnEdges(along), rowEdges(depths)];
  const out: SectionCell[] = [];
  values.forEach((row, j) => row.forEach((value, i) => {
    const places: [number, number][] =
        [[y[i], depth[j]], [y[i + 1], depth[j]], [y[i + 1], depth[j + 1]], [y[i], depth[j + 1]]];
    const corners = places.map(([a, d]) => outline.at(a, d)).filter((c) => c !== null);
    if (value === null || corners.length < 4 || turned(corners) !== (body === "wheel")) return;
    out.push({corners, y: along[i], depth: depths[j], body, value});
  }));
  return out;
}

const kDeepest = 14;  // mm, of the picture, unless a layer is thicker

function sectionWindow(run: Run, g: Geometry): [y: Span, z: Span] {
  const contact: Pixel = [1e3 * g.contact.y_m, 1e3 * g.contact.z_m];
  const width = 1e3 * (run.summary.contact.patch_width_m ?? 0.014);
  const half = Math.min(Math.max(0.5 * width + 8, 19), 28);
  const sum = (on: BodyName) => g.layers.reduce((t, l) => t + (l.on === on ? 1e3 * l.thickness_m : 0), 0);
  const deep = Math.max(kDeepest, Math.min(1.3 * sum("rail"), 30));
  const high = Math.max(0.55 * kDeepest, Math.min(1.3 * sum("wheel"), 30));
  return [[contact[0] - half, contact[0] + half], [contact[1] - deep, contact[1] + high]];
}

function paintBodies(
    c: CanvasRenderingContext2D, p: Plane, g: Geometry, lines: Record<BodyName, Outline>, theme: Theme) {
  const at = ([y, z]: Pixel): Pixel => [px(p, y), py(p, z)];
  const fill = (body: BodyName, end: number) => {
    const line = lines[body].line();
    drawPath(c, [...line.map(at), [px(p, line[line.length - 1][0]), end], [px(p, line[0][0]), end]], true);
    c.fillStyle = theme.grid;
    c.fill();
  };
  fill("rail", p.top + p.height + 2);
  fill("wheel", p.top - 2);
  for (const layer of g.layers) {
    const surface = lines[layer.on as BodyName].line();
    const bottom = layer.bottom_m.map(([y, z]): Pixel => [1e3 * y, 1e3 * z]);
    if (bottom.length < 2) continue;
    const [first, last] = [bottom[0][0], bottom[bottom.length - 1][0]].sort((a, b) => a - b);
    const above = surface.filter(([y]) => y >= first - 3 && y <= last + 3);
    if (bottom[0][0] > bottom[bottom.length - 1][0]) bottom.reverse();
    drawPath(c, [...above.map(at), ...[...bottom].reverse().map(at)], true);
    c.fillStyle = theme.series[2];
    c.globalAlpha = 0.3;
    c.fill();
    c.globalAlpha = 1;
  }
}

function paintBorders(
    c: CanvasRenderingContext2D, p: Plane, g: Geometry, lines: Record<BodyName, Outline>, theme: Theme) {
  const at = ([y, z]: Pixel): Pixel => [px(p, y), py(p, z)];
  c.strokeStyle = theme.ink;
  c.lineWidth = 1.3;
  c.setLineDash([5, 3]);
  for (const layer of g.layers) {
    drawPath(c, layer.bottom_m.map(([y, z]) => at([1e3 * y, 1e3 * z])));
    c.stroke();
  }
  c.setLineDash([]);
  for (const body of ["rail", "wheel"] as const) {
    drawPath(c, lines[body].line().map(at));
    c.stroke();
  }
  c.fillStyle = theme.ink;
  c.font = letters(11, "600");
  c.textAlign = "left";
  c.textBaseline = "bottom";
  c.fillText("rail", p.left + 5, p.top + p.height - 4);
  c.textBaseline = "top";
  c.fillText("wheel", p.left + 5, p.top + 4);
}


/// What a picture of a section shows.
export interface SectionPicture {
  cells: SectionCell[];
  name: string;  // of the value
  scale: Scale;
  highest: number;  // px, of the plane
  unit: string;     // of the bar
  text: (v: number) => string;
}

/// Paints rail and wheel with these cells in them.
export function paintSection(
    host: HTMLElement, run: Run, g: Geometry, picture: SectionPicture, theme: Theme, width: number): void {
  const lines = outlines(g);
  const [y, z] = sectionWindow(run, g);
  const {plane, height} = planeFor(width, y, z, picture.highest);
  const c = canvasIn(host, width, height);
  const inside = (cell: SectionCell) => cell.corners.some(([a, b]) => a > y[0] && a < y[1] && b > z[0] && b < z[1]);
  const pieces = picture.cells.filter(inside).map((cell): Piece => {
    const place = `${cell.body}, y ${fixedText(cell.y, 2)}, depth ${cell.depth.toFixed(2)} mm`;
    return {
      corners: cell.corners.map(([a, b]) => [px(plane, a), py(plane, b)]),
      colour: rgb(picture.scale.colour(cell.value, theme)),
      words: `${place}: ${picture.name} ${picture.text(cell.value)}`,
    };
  });
  c.save();
  c.beginPath();
  c.rect(plane.left, plane.top, plane.width, plane.height);
  c.clip();
  paintBodies(c, plane, g, lines, theme);
  paintPieces(c, pieces);
  paintBorders(c, plane, g, lines, theme);
  c.restore();
  drawAxes(c, plane, theme, [{title: "y, field side right [mm]", range: y}, {title: "z [mm]", range: z}]);
  drawBar(c, plane, theme, picture.scale, picture.unit);
  wordsUnderPointer(host, (place) => wordsAt(pieces, place));
}

/// "Green, dashed: cladding on the rail."
export function layerWords(g: Geometry): string {
  return g.layers.length ? ` Green, dashed: ${g.layers.map((l) => `${l.name} on the ${l.on}`).join(", ")}.` : "";
}
