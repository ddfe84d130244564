// The bodies in space: the rail with the pressure on it as colour and as a hill, the wheel as lines. A drag turns them.
import {canvasIn, drawArrow, drawPath, type Pixel} from "../canvas";
import {element} from "../dom";
import {frame, redraw, type Painted} from "../figures";
import {magnitudeScale, rgb} from "../scale";
import {letters, type Theme} from "../theme";
import type {Span, Values} from "../types";
import type {Geometry, Run} from "./data";
import {contactY, largest, patchesOf, patchWindow, type Patch} from "./patch";
import {outlines} from "./profile";

type Point = [x: number, y: number, z: number];  // mm, model frame

/// How it is looked at: turned about the vertical, then tilted.
interface View {
  turn: number;  // rad
  tilt: number;
}
const kFromTheTrack: View = {
  turn: 0.65,
  tilt: 0.62
};

/// Points on the screen, farther ones with a larger third number.
class Projection {
  private readonly c: number;
  private readonly s: number;
  private readonly up: number;
  private readonly flat: number;
  constructor(view: View, private readonly middle: Point, private readonly scale: number, private readonly at: Pixel) {
    [this.c, this.s] = [Math.cos(view.turn), Math.sin(view.turn)];
    [this.up, this.flat] = [Math.sin(view.tilt), Math.cos(view.tilt)];
  }

  /// Seen from the track (y to the back) where nothing is turned: x to the right.
  of([x, y, z]: Point): [x: number, y: number, far: number] {
    const [dx, dy, dz] = [x - this.middle[0], y - this.middle[1], z - this.middle[2]];
    const right = this.c * dx + this.s * dy;
    const back = -this.s * dx + this.c * dy;
    return [
      this.at[0] + this.scale * right,
      this.at[1] - this.scale * (dz * this.flat + back * this.up),
      back * this.flat - dz * this.up,
    ];
  }
}

/// A flat piece with its colour.
interface Face {
  corners: Point[];
  colour: string;
  edge?: string;
}

/// Height of the rail at y, where it has one.
function railHeight(g: Geometry): (y: number) => number | null {
  const rail = outlines(g).rail;
  return (y) => rail.at(y, 0)?.[1] ?? null;
}

/// Of the patches: x and y in the model frame, and the highest pressure is a hill so many mm high.
interface Hill {
  patches: Patch[];
  top: number;  // MPa
  height: number;
}

function hillFaces(hill: Hill, run: Run, height: (y: number) => number | null, theme: Theme): Face[] {
  const scale = magnitudeScale(hill.top);
  return hill.patches.flatMap((patch, n) => {
    const shift = contactY(run, n);
    const z = (i: number, j: number) =>
        (height(patch.y[j] + shift) ?? 0) + 0.02 + (hill.height * (patch.p[j]?.[i] ?? 0)) / hill.top;
    const corner = (i: number, j: number): Point => [patch.x[i], patch.y[j] + shift, z(i, j)];
    const out: Face[] = [];
    for (let j = 0; j + 1 < patch.y.length; ++j)
      for (let i = 0; i + 1 < patch.x.length; ++i) {
        const four = [patch.p[j][i], patch.p[j][i + 1], patch.p[j + 1][i + 1], patch.p[j + 1][i]];
        if (four.every((v) => v === null)) continue;
        const mean = four.reduce((sum: number, v) => sum + (v ?? 0), 0) / 4;
        out.push({
          corners: [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)],
          colour: rgb(scale.colour(mean, theme)),
        });
      }
    return out;
  });
}

const steps = ([low, high]: Span, n: number) => Array.from({length: n + 1}, (_, k) => low + ((high - low) * k) / n);

/// The rail's running surface around the contact, lighter where it faces up; its front cut shows the layers.
function railFaces(height: (y: number) => number | null, x: Span, y: Span, theme: Theme, bottom: number): Face[] {
  const dark = theme.paper !== "#ffffff";
  const shade = (slope: number) => {
    const light = (dark ? 0.5 : 1) / Math.hypot(1, slope);
    return rgb([178, 186, 194], 0.55 + 0.45 * light);
  };
  const across = steps(y, 44).filter((v) => height(v) !== null);
  const along = steps(x, 10);
  const cut = rgb([150, 158, 168], dark ? 0.7 : 1);
  const out: Face[] = [];
  for (const side of [across[0], across[across.length - 1]])
    for (let i = 0; i + 1 < along.length; ++i) {
      const z = height(side)!;
      const [left, right] = [along[i], along[i + 1]];
      out.push(
          {corners: [[left, side, z], [right, side, z], [right, side, bottom], [left, side, bottom]], colour: cut});
    }
  for (let j = 0; j + 1 < across.length; ++j) {
    const [a, b] = [across[j], across[j + 1]];
    const [za, zb] = [height(a)!, height(b)!];
    for (let i = 0; i + 1 < along.length; ++i)
      out.push({
        corners: [[along[i], a, za], [along[i + 1], a, za], [along[i + 1], b, zb], [along[i], b, zb]],
        colour: shade((zb - za) / (b - a)),
      });
    for (const end of x)
      out.push({
        corners: [[end, a, za], [end, b, zb], [end, b, bottom], [end, a, bottom]],
        colour: cut,
      });
  }
  return out;
}

/// Lines of the wheel's tread: its profile in planes through the axle.
function wheelLines(g: Geometry, y: Span, x: Span): Point[][] {
  const radius = 1e3 * g.contact.rolling_radius_m;
  const axle = 1e3 * g.contact.z_m + radius;
  const profile = g.wheel_m.map(([a, b]): Pixel => [1e3 * a, 1e3 * b]).filter(([a]) => a >= y[0] && a <= y[1]);
  const at =
      ([a, b]: Pixel, angle: number): Point => [(axle - b) * Math.sin(angle), a, axle - (axle - b) * Math.cos(angle)];
  const angles = steps([x[0] / radius, x[1] / radius], 12);
  const rings = profile.filter((_, k) => k % 12 === 0 || k === profile.length - 1);
  return [
    ...angles.map((angle) => profile.map((p) => at(p, angle))),
    ...rings.map((p) => angles.map((angle) => at(p, angle))),
  ];
}

interface Scene {
  faces: Face[];
  lines: Point[][];
  layers: Point[][];
  middle: Point;
}

function sceneOf(run: Run, g: Geometry, hill: Hill, theme: Theme, withWheel: boolean): Scene {
  const [patchX] = patchWindow(hill.patches);
  const x: Span = [Math.min(patchX[0] - 6, -16), Math.max(patchX[1] + 6, 16)];
  const middleY = 1e3 * g.contact.y_m;
  const y: Span = [middleY - 24, middleY + 24];
  const height = railHeight(g);
  const bottom = 1e3 * g.contact.z_m - 16;
  const layers = g.layers.filter((l) => l.on === "rail").flatMap((l) => {
    const points = l.bottom_m.map(([a, b]): Pixel => [1e3 * a, 1e3 * b]).filter(([a]) => a >= y[0] && a <= y[1]);
    return x.map((end) => points.map(([a, b]): Point => [end, a, Math.max(b, bottom)]));
  });
  return {
    faces: [...railFaces(height, x, y, theme, bottom), ...hillFaces(hill, run, height, theme)],
    lines: withWheel ? wheelLines(g, [y[0], y[1]], [x[0] * 1.6, x[1] * 1.6]) : [],
    layers,
    middle: [0, middleY, 1e3 * g.contact.z_m - 2],
  };
}

function paintScene(c: CanvasRenderingContext2D, scene: Scene, projection: Projection, theme: Theme, view: View): void {
  const faces = scene.faces.map((face) => {
    const corners = face.corners.map((p) => projection.of(p));
    return {face, corners, far: corners.reduce((sum, p) => sum + p[2], 0) / corners.length};
  });
  faces.sort((a, b) => b.far - a.far);
  c.lineWidth = 0.7;
  for (const {face, corners} of faces) {
    drawPath(c, corners.map(([a, b]): Pixel => [a, b]), true);
    c.fillStyle = c.strokeStyle = face.colour;
    c.fill();
    c.stroke();
  }
  const seen = Math.sin(view.turn) > 0 ? 1 : 0;  // which end faces the eye
  c.strokeStyle = theme.ink;
  c.lineWidth = 1.2;
  c.setLineDash([5, 3]);
  scene.layers.forEach((line, k) => {
    if (k % 2 !== seen) return;
    drawPath(c, line.map((p) => projection.of(p)).map(([a, b]): Pixel => [a, b]));
    c.stroke();
  });
  c.setLineDash([]);
  c.strokeStyle = theme.series[1];
  c.globalAlpha = 0.45;
  c.lineWidth = 0.8;
  for (const line of scene.lines) {
    drawPath(c, line.map((p) => projection.of(p)).map(([a, b]): Pixel => [a, b]));
    c.stroke();
  }
  c.globalAlpha = 1;
}

/// Directions of the axes, ten millimetres each, in the lower left corner.
function paintAxes(c: CanvasRenderingContext2D, view: View, scale: number, at: Pixel, theme: Theme): void {
  const projection = new Projection(view, [0, 0, 0], scale, at);
  const axes: [Point, string][] = [[[10, 0, 0], "x rolling"], [[0, 10, 0], "y field side"], [[0, 0, 10], "z up"]];
  c.font = letters(11);
  c.textBaseline = "middle";
  for (const [end, name] of axes) {
    const [x, y] = projection.of(end);
    drawArrow(c, at, [x, y], theme.ink, 1.4);
    c.fillStyle = theme.soft;
    c.textAlign = x < at[0] - 2 ? "right" : "left";
    c.fillText(name, x + (x < at[0] - 2 ? -4 : 4), y - (Math.abs(x - at[0]) < 6 ? 6 : 0));
  }
}

const kReach = 37;  // mm, from the middle to the border of the picture

class Space {
  private view = {...kFromTheTrack};
  private withWheel = true;
  private readonly hill: Hill;

  constructor(private readonly run: Run, private readonly g: Geometry) {
    const patches = patchesOf(run);
    this.hill = {patches, top: largest(patches, (p) => p.p), height: 12};
  }

  control(): HTMLElement {
    const from = element("button", {type: "button", id: "space-reset"}, "view from the track");
    from.addEventListener("click", () => this.turnTo({...kFromTheTrack}));
    const above = element("button", {type: "button", id: "space-above"}, "from above");
    above.addEventListener("click", () => this.turnTo({turn: 0, tilt: 1.5}));
    const front = element("button", {type: "button", id: "space-front"}, "against the rolling");
    front.addEventListener("click", () => this.turnTo({turn: 0.5 * Math.PI, tilt: 0.15}));
    const wheel = element("input", {type: "checkbox", id: "space-wheel", checked: ""});
    wheel.addEventListener("change", () => {
      this.withWheel = wheel.checked;
      redraw("space");
    });
    return element("div", {class: "film"}, from, above, front, element("label", {}, wheel, " wheel"));
  }

  figure(): Painted {
    return {
      id: "space",
      title: "Pressure on the rail, in space",
      wide: true,
      words: [
        "Colour and height: pressure. The rail is cut on both sides of the patch; dashed: layers; lines: the wheel’s " +
            "tread as placed. Drag to turn.",
      ],
      paint: (host, theme, width) => this.paint(host, theme, width),
      table: () => ({
        names: ["x_mm", "y_mm", "p_MPa"],
        rows: this.hill.patches.flatMap((p) => p.y.flatMap((y, j) => p.x.map((x, i): Values => [x, y, p.p[j][i]]))),
      }),
    };
  }

  private turnTo(view: View): void {
    this.view = view;
    redraw("space");
  }

  private paint(host: HTMLElement, theme: Theme, width: number): void {
    const height = Math.round(Math.min(Math.max(0.62 * width, 260), 460));
    const c = canvasIn(host, width, height);
    const scene = sceneOf(this.run, this.g, this.hill, theme, this.withWheel);
    const scale = Math.min(width, 1.5 * height) / (2 * kReach);
    paintScene(
        c, scene, new Projection(this.view, scene.middle, scale, [0.5 * width, 0.47 * height]), theme, this.view);
    paintAxes(c, this.view, Math.min(scale, 4), [70, height - 40], theme);
    this.bar(c, width, theme);
    host.style.touchAction = "pan-y";
    host.style.cursor = "grab";
    host.onpointerdown = (down) => this.drag(host, down);
  }

  private bar(c: CanvasRenderingContext2D, width: number, theme: Theme): void {
    const {colour} = magnitudeScale(1);
    for (let k = 0; k < 120; ++k) {
      c.fillStyle = rgb(colour(k / 120, theme));
      c.fillRect(width - 140 + k, 8, 1.5, 8);
    }
    c.fillStyle = theme.soft;
    c.font = letters(11);
    c.textBaseline = "top";
    c.textAlign = "left";
    c.fillText("0", width - 140, 18);
    c.textAlign = "right";
    c.fillText(`p ${this.hill.top.toFixed(0)} MPa`, width - 20, 18);
  }

  private drag(host: HTMLElement, down: PointerEvent): void {
    const {turn, tilt} = this.view;
    host.setPointerCapture(down.pointerId);
    host.onpointermove = (move) => {
      const tilted = tilt + (move.clientY - down.clientY) / 150;
      this.turnTo({turn: turn + (move.clientX - down.clientX) / 150, tilt: Math.min(Math.max(tilted, 0.02), 1.55)});
    };
    host.onpointerup = host.onpointercancel = () => (host.onpointermove = null);
  }
}

/// Of the first run that has a geometry.
export function spaceParts(runs: Run[]): HTMLElement[] {
  const run = runs.find((r) => r.geometry);
  if (!run?.geometry) return [];
  const space = new Space(run, run.geometry);
  return [space.control(), element("div", {class: "grid"}, frame(space.figure()))];
}
