// The wheel on the rail: profiles as placed, where they touch, layers and Hertz's estimate.
import type {Chart, Curve, Dash} from "../chart";
import {table} from "../dom";
import type {Figure} from "../figures";
import {fixedText, numberText} from "../text";
import type {Theme} from "../theme";
import {option, type Geometry, type Layer, type LoadedContact, type Run} from "./data";
import {withoutRoundOff} from "./words";

interface Line {
  name: string;
  line: {x: number[]; y: number[]};
  colour: (t: Theme) => string;
  dash: Dash;
}

function millimetres(points: [number, number][]): Line["line"] {
  return {x: points.map((p) => 1e3 * p[0]), y: points.map((p) => 1e3 * p[1])};
}

function curvesOf(g: Geometry): Line[] {
  const wheel = {name: `wheel ${g.wheel_profile}`, line: millimetres(g.wheel_m), colour: (t: Theme) => t.series[1]};
  const rail = {name: `rail ${g.rail_profile}`, line: millimetres(g.rail_m), colour: (t: Theme) => t.series[0]};
  const bottoms = g.layers.map((l): Line => {
    const line = millimetres(l.bottom_m);
    return {name: `bottom of ${l.name}`, line, colour: (t) => t.ink, dash: "dash"};
  });
  return [{...wheel, dash: "solid"}, {...rail, dash: "solid"}, ...bottoms];
}

function curveOf(c: Line, theme: Theme): Curve {
  const words = (y: number, z: number) => `y ${fixedText(y, 2)} mm\nz ${fixedText(z, 3)} mm`;
  return {name: c.name, ...c.line, colour: c.colour(theme), dash: c.dash, width: 2, words};
}

function contactCurve(contact: Point, theme: Theme): Curve {
  const words = (y: number, z: number) => `y ${fixedText(y, 3)} mm\nz ${fixedText(z, 3)} mm`;
  const mark = contact.patch > 1 ? "square" : "circle";
  return {name: contact.name, x: [contact.x], y: [contact.y], colour: theme.ink, width: 0, mark, words};
}

interface Point {
  name: string;
  x: number;
  y: number;
  slope: number;
  patch: number;  // of several from 1 on, else 0
}

interface View {
  middle: Point;
  halfWidth: number;  // mm
  ratio: number;      // heights are drawn so many times larger than widths
}

/// The places where the wheel touches, with the load and Hertz's ellipse of each.
function contactsOf(g: Geometry): LoadedContact[] {
  return g.patches ?? [{contact: g.contact, load_N: g.load_N, hertz: g.hertz}];
}

function pointsOf(g: Geometry): Point[] {
  const all = contactsOf(g);
  const pointOf = ({contact: c}: LoadedContact, k: number): Point => ({
    name: all.length > 1 ? `place of patch ${k + 1}` : "place of the patch",
    x: 1e3 * c.y_m,
    y: 1e3 * c.z_m,
    slope: Math.tan(c.angle_rad),
    patch: all.length > 1 ? k + 1 : 0,
  });
  return all.map(pointOf);
}

function chartOf({middle, halfWidth, ratio}: View, curves: Curve[], width: number): Chart {
  const wide = width - 80;
  const height = Math.min(Math.max(180, wide * 0.62), 380);
  const halfHeight = (halfWidth * height) / wide / ratio;
  return {
    x: {title: "y, field side right [mm]", range: [middle.x - halfWidth, middle.x + halfWidth]},
    y: {title: "z [mm]", range: [middle.y - halfHeight, middle.y + halfHeight]},
    height,
    equal: ratio === 1,
    grid: true,
    legend: true,
    curves,
  };
}

const kAboutProfiles = "Profiles as placed, before loading, seen against the rolling direction; equal scales. " +
    "Zero is the crown of the canted rail.";

/// Heights are drawn as much larger as leaves the profiles in the picture on both sides of a contact so steep.
function nearRatio(slope: number): number {
  const most = 0.6 / Math.max(Math.abs(slope), 0.01);
  return [10, 5, 2].find((ratio) => ratio <= most) ?? 1;
}

function nearView(point: Point): [id: string, title: string, words: string, view: View] {
  const ratio = nearRatio(point.slope);
  const title = `Near the contact point${point.patch ? ` of patch ${point.patch}` : ""}`;
  const id = point.patch > 1 ? `profiles-near-${point.patch}` : "profiles-near";
  const scale = ratio === 1 ? "in equal scales" : `heights drawn ${kTimes[ratio]} times larger than widths`;
  return [id, title, `The same, ${scale}.`, {middle: point, halfWidth: 20, ratio}];
}

const kTimes: Record<number, string> = {
  2: "two",
  5: "five",
  10: "ten"
};

/// Profiles where they stand, whole and near each contact.
export function geometryFigures(run: Run): Figure[] {
  const g = run.geometry;
  if (!g) return [];
  const points = pointsOf(g);
  const curves = curvesOf(g);
  const rows = curves.flatMap((c) => c.line.x.map((x, i) => [c.name, x, c.line.y[i]]));
  const figure = (id: string, title: string, words: string, view: View): Figure => ({
    id,
    title,
    words: [words],
    chart: (theme, width) => {
      const all = [...curves.map((c) => curveOf(c, theme)), ...points.map((p) => contactCurve(p, theme))];
      return chartOf(view, all, width);
    },
    table: () => ({names: ["curve", "y_mm", "z_mm"], rows: [...rows, ...points.map((p) => [p.name, p.x, p.y])]}),
  });
  return [
    figure("profiles", "Wheel on rail", kAboutProfiles, {middle: points[0], halfWidth: 75, ratio: 1}),
    ...points.map((p) => figure(...nearView(p))),
  ];
}

function layerModulus(l: Layer): string {
  if (!l.young_table) return `E ${numberText(1e-9 * l.young_Pa)} GPa = ${numberText(l.young_ratio, 3)} E₀`;
  const at = ([depth, young]: [number, number]) =>
      `${numberText(1e-9 * young)} GPa at ${numberText(1e3 * depth, 3)} mm`;
  return `graded: E ${l.young_table.map(at).join(", ")}`;
}

function layerRow(l: Layer): string[] {
  const size = `${numberText(1e3 * l.thickness_m, 3)} mm thick, ${numberText(1e3 * l.width_m, 3)} mm wide`;
  return [`layer “${l.name}” on the ${l.on}`, `${size}, ${layerModulus(l)}`];
}

function hertzWords({a_m, b_m, p0_Pa, approach_m}: Geometry["hertz"]): string {
  const a = `a ${numberText(1e3 * a_m, 3)}`;
  if (approach_m === null)
    return `${a} mm, p₀ ${numberText(1e-6 * p0_Pa)} MPa, a line of ${numberText(2e3 * b_m, 3)} mm`;
  const axes = `${a}, b ${numberText(1e3 * b_m, 3)} mm`;
  return `${axes}, p₀ ${numberText(1e-6 * p0_Pa)} MPa, approach ${numberText(1e6 * approach_m, 3)} µm`;
}

function radiusText(curvature: number): string {
  return Math.abs(curvature) < 1e-9 ? "straight" : `${numberText(1e3 / curvature)} mm`;
}

/// Which load geometry.json has: the case's, or what stands for it.
function loadWords(run: Run): string {
  const approach = option(run, "vehicle", "approach");
  if (approach) return `load by Hertz for the given approach of ${approach}`;
  return run.summary.state ? "load at the end" : "static load";
}

const mm = (metres: number) => `${fixedText(1e3 * metres, 3)} mm`;

/// A row for each number of a contact, a cell for each of the places.
function contactRows(contacts: LoadedContact[]): string[][] {
  const row = (name: string, text: (c: LoadedContact) => string) => [name, ...contacts.map(text)];
  const angle = (c: LoadedContact) => withoutRoundOff("contact/contact_angle_rad", c.contact.angle_rad, () => null);
  const curvatures = ["curvature_wheel_lateral_per_m", "curvature_rail_lateral_per_m"];
  const radii = (c: LoadedContact) => curvatures.map((key) => radiusText(c.contact[key])).join(", ");
  const load = row("normal force", (c) => `${numberText(1e-3 * c.load_N)} kN`);
  return [
    row("contact point on the rail", ({contact: c}) => `y ${mm(c.y_m)}, z ${mm(c.z_m)}`),
    row("contact point on the wheel, from the tape circle", ({contact: c}) => `y ${mm(c.wheel_y_m)}`),
    row("contact angle", (c) => `${numberText(1e3 * (angle(c) ?? 0))} mrad`),
    row("rolling radius", ({contact: c}) => `${(1e3 * c.rolling_radius_m).toFixed(3)} mm`),
    row("lateral radius of wheel, of rail (convex positive)", radii),
    ...(contacts.length > 1 ? [load] : []),
    row(contacts[0].hertz.approach_m === null ? "Hertz, no layer" : "Hertz’s ellipse, no layer",
        (c) => hertzWords(c.hertz)),
  ];
}

export function geometryTable(run: Run): HTMLElement|null {
  const g = run.geometry;
  if (!g) return null;
  const contacts = contactsOf(g);
  const places = contacts.map((_, k) => `patch ${k + 1}`);
  const roll = option(run, "geometry", "roll");
  const rows: string[][] = [
    ["wheel on rail", `${g.wheel_profile} on ${g.rail_profile}`],
    ...(g.profile_notes ?? []).map((note) => ["profile read", note]),
    ["lateral shift of the wheel", option(run, "geometry", "lateral_shift") ?? "–"],
    ...(g.track?.map((t) => [t.name, `${t.value} (${t.from})`]) ??
        [["cant of the rail", option(run, "geometry", "cant") ?? "–"]]),
    ...(roll && Number(roll) !== 0 ? [["roll of the wheelset, field side up", roll]] : []),
    [loadWords(run), `${numberText(1e-3 * g.load_N, 5)} kN`],
    ...(contacts.length > 1 ? [["", ...places]] : []),
    ...contactRows(contacts),
    ...g.layers.map(layerRow),
  ];
  return table("Placement", ["", ...places.map(() => "")], rows, {class: "facts"});
}
