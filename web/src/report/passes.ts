// Passes over a rail that yields: the verdict, what every pass has done, maps of the section, profiles, loops.
import {details, element, note, part, table, type Child} from "../dom";
import {frame, type Figure} from "../figures";
import {kindScale, magnitudeScale, signedScale} from "../scale";
import {countText, numberText, powerText} from "../text";
import type {Theme} from "../theme";
import type {Span, Values} from "../types";
import {rowsOf, type Columns, type PassesStory, type PassesSummary} from "./data";
import {linesFigure, type Series} from "./lines";
import {mapFigure, type Line, type Marker} from "./maps";

/// What maps of a section take: of passes, or of a single run.
export interface SectionHistory {
  name: string;
  summary: Pick<PassesSummary, "zones"|"loops"|"points">;
  residual: Columns;
}

/// Of the classes in their order, from good to bad and not known: told apart with any colour vision.
const kClassFills = ["#0072b2", "#56b4e9", "#d55e00", "#b9bec5"];
const kClassScale = kindScale(0, kClassFills.length, () => kClassFills);
/// Words of the classes, by the number that residual.csv has: passes.json counts the points of each in their order.
function classesOf(s: SectionHistory): string[] {
  const words = Object.keys(s.summary.points ?? {});
  return kClassFills.map((_, k) => words[k] ?? `class ${k}`);
}
const several = (all: SectionHistory[]) => all.length > 1;
const called = (s: SectionHistory, all: SectionHistory[], words: string) =>
    (several(all) ? `${words}: ${s.name}` : words);
const strain = (v: number|null|undefined) => (v === 0 ? "0" : powerText(v));
/// " ± " and the error of a number of the last pass; nothing where it is not known.
const barText = (s: PassesSummary, column: string, text: (v: number) => string) => {
  const bar = s.error?.last_pass[column];
  return typeof bar === "number" ? ` ± ${text(bar)}` : "";
};
const depthText = (metres: number) => `${(1e3 * metres).toFixed(2)} mm`;

// ---- verdict

function shakedownWords(s: PassesSummary): string|null {
  const f = s.shakedown?.factors;
  if (!f) return null;
  const limits: [key: string, name: string][] = [
    ["first_yield", "first yield"], ["wandering", "wandering traffic"], ["single_track", "one track"],
    ["kinematic", "with kinematic hardening"]
  ];
  const flows = s.last_pass.accumulated_strain !== 0 && s.shakedown!.verdict === "stays elastic";
  const why = flows ? " The law of hardening begins to flow below that yield strength, so here it yields." : "";
  const said =
      limits.filter(([key]) => typeof f[key] === "number").map(([key, name]) => `${name} ${numberText(f[key]!, 3)}`);
  return `Shakedown factors of the elastic stress with the yield strength of the case: ${said.join(", ")}; so by ` +
      `theory it ${s.shakedown!.verdict}.${why}`;
}

/// Two digits: nobody knows more of so many passes.
const roughly = (passes: number) => countText(Number(passes.toPrecision(2)));

function ductilityWords(s: PassesSummary): string|null {
  const d = s.ductility;
  if (!d) return null;
  const said = `An equivalent strain of ${numberText(d.strain, 3)}`;
  const reached = `${numberText(d.reached, 2)} so far`;
  if (d.passes === null && d.latest === null && d.earliest === null)
    return `${said} is never reached as the passes go now (${reached}).`;
  const latest = d.latest === null ? "never" : roughly(d.latest);
  return `${said} (${reached}) is reached after about ${d.passes === null ? "–" : roughly(d.passes)} passes at the ` +
      `last rate; between ${d.earliest === null ? "–" : roughly(d.earliest)} and ${latest} by the rates and the ` +
      `trend so far.`;
}

/// What the grid leaves open beyond its bars.
function errorWords(s: PassesSummary): string|null {
  if (s.error === undefined) return null;
  if (s.error === null) return s.no_error ? `Error of the grid not known: ${s.no_error}.` : null;
  const other = s.error.classes_on_coarser_grids.find((kind) => kind !== s.class);
  const words = [
    s.error.not_converged.length ? `Not converged with the grid: ${s.error.not_converged.join(", ")}.` : "",
    other ? `The class depends on the grid: ${other} on a coarser one.` : "",
  ];
  return words.filter((w) => w).join(" ") || null;
}

function verdictCard(s: PassesStory, all: PassesStory[]): HTMLElement {
  const {summary} = s;
  const bad = summary.class === "ratchetting" && !(summary.doubts ?? []).length;
  const doubted = (summary.doubts ?? []).length > 0;
  const open = doubted || summary.class.startsWith("transient") || summary.class === "plastic shakedown";
  const words = [
    `After ${countText(summary.passes)} ${summary.passes === 1 ? "pass" : "passes"}. Class: ${summary.class}.`,
    summary.law ? `What the law allows in the long run – ${summary.law}.` : null,
    shakedownWords(summary),
    ductilityWords(summary),
    errorWords(summary),
  ];
  const title = summary.verdict ?? summary.class;
  return element(
      "section", {
        class: `passes-verdict ${
            bad        ? "bad"
                : open ? "open"
                       : "good"}`,
        ...(all[0] === s ? {id: "verdict-of-passes"} : {}),
      },
      element("h2", {}, several(all) ? `${s.name}: ${title}` : title),
      ...words.filter((w): w is string => w !== null).map((w) => element("p", {}, w)));
}

function factsTable(all: PassesStory[]): HTMLElement {
  const rows: [string, (s: PassesSummary) => string][] = [
    ["class", (s) => s.class],
    ["passes", (s) => countText(s.passes)],
    [
      "net strain per pass, mean of a round of wheels",
      (s) => strain(s.net_strain_per_pass) + barText(s, "cycle_net", (v) => strain(v / (s.passes_per_cycle ?? 1)))
    ],
    [
      "accumulated in the last pass",
      (s) => strain(s.last_pass.accumulated_strain) + barText(s, "accumulated_strain", strain)
    ],
    [
      "where, depth [mm]",
      (s) => numberText(s.last_pass.net_depth_mm, 3) + barText(s, "net_depth_mm", (v) => numberText(v, 2))
    ],
    [
      "most compressive σ_x [MPa]",
      (s) => numberText(s.last_pass.sigma_x_min_MPa, 3) + barText(s, "sigma_x_min_MPa", (v) => numberText(v, 2))
    ],
    [
      "most compressive σ_y [MPa]",
      (s) => numberText(s.last_pass.sigma_y_min_MPa, 3) + barText(s, "sigma_y_min_MPa", (v) => numberText(v, 2))
    ],
    ["shakedown factor, wandering traffic", (s) => numberText(s.shakedown?.factors.wandering, 3)],
    ["shakedown factor, one track", (s) => numberText(s.shakedown?.factors.single_track, 3)],
    ["by these factors it", (s) => s.shakedown?.verdict ?? "–"],
  ];
  const head = ["", ...all.map((s) => (several(all) ? s.name : "last pass"))];
  const body = rows.map(([name, text]) => [name, ...all.map((s) => text(s.summary))]);
  return table("", head, body, {class: "numbers", id: "passes-facts"});
}

// ---- maps of the section

interface Section {
  y: number[];
  depth: number[];
  width: number;
  rows: (values: Values) => Values[];  // a row for each depth; null where there is no point
}

function sectionOf(s: SectionHistory): Section {
  if (s.residual.row) return elementSection(s.residual);
  const depth = s.residual.depth_mm;
  let width = 0;
  while (width < depth.length && depth[width] === depth[0]) ++width;
  return {
    width,
    y: s.residual.y_mm.slice(0, width),
    depth: rowsOf(depth, width).map((row) => row[0]),
    rows: (values) => rowsOf(values, width),
  };
}

/// Of finite elements those of the fine zone that have come near yielding, in its rows and columns. A column stands
/// where its uppermost element does, a row as deep as its element nearest to the middle.
function elementSection(residual: Columns): Section {
  const {row, column, y_mm, depth_mm} = residual;
  const present = (numbers: number[]) => [...new Set(numbers.filter((n) => n >= 0))].sort((a, b) => a - b);
  const [rows, columns] = [present(row), present(column)];
  const best = (at: number[], wanted: number, size: (i: number) => number) =>
      at.flatMap((n, i) => (n === wanted ? [i] : [])).reduce((a, b) => (size(b) < size(a) ? b : a));
  const at = new Map(row.map((r, i) => [`${r} ${column[i]}`, i]));
  return {
    width: columns.length,
    y: columns.map((c) => y_mm[best(column, c, (i) => depth_mm[i])]),
    depth: rows.map((r) => depth_mm[best(row, r, (i) => Math.abs(y_mm[i]))]),
    rows: (values) => rows.map((r) => columns.map((c) => values[at.get(`${r} ${c}`) ?? -1] ?? null)),
  };
}

/// Lower borders of layers [mm].
function borders(s: SectionHistory): number[] { return (s.summary.zones ?? []).slice(1).map((z) => 1e3 * z.top_m); }

const largest = (values: Values) => values.reduce<number>((m, v) => Math.max(m, Math.abs(v ?? 0)), 0);

/// Across, where the rail has yielded or keeps a quarter of the largest change of stress, with room to either side.
function windowOf(s: SectionHistory, section: Section): Span {
  const {residual} = s;
  const p = 0.02 * largest(residual.plastic_strain_accumulated);
  // of the process at the side of the section
  const aside = (i: number) => (residual.row ? 0 : residual.sigma_xx_MPa[i - (i % section.width)]);
  const change = residual.sigma_xx_MPa.map((v, i) => v - aside(i)), stress = 0.25 * largest(change);
  const reach = residual.y_mm.filter(
      (_, i) => residual.plastic_strain_accumulated[i] > p || (stress > 0 && Math.abs(change[i]) > stress));
  const deepest = Math.max(...section.depth);
  const half = residual.row && section.y.length > 1 ? 0.5 * Math.abs(section.y[1] - section.y[0]) : 0;  // of an element
  const all: Span = [Math.min(...section.y) - half, Math.max(...section.y) + half];
  const from = reach.length ? Math.min(...reach) : 0.5 * (all[0] + all[1]);
  const to = reach.length ? Math.max(...reach) : from;
  return [Math.max(all[0], from - 0.4 * deepest), Math.min(all[1], to + 0.4 * deepest)];
}

interface Quantity {
  id?: string;  // of the figure, before the column's name
  column: string;
  title: string;
  bar: string;
  hover: string;
  unit: string;
  words: string[];
  signed?: boolean;
  classes?: boolean;
}

const kMaps: Quantity[] = [
  {
    column: "sigma_xx_MPa",
    title: "Residual stress along the rail, σ_x",
    bar: "MPa",
    hover: "σ_x %{z:.0f} MPa",
    unit: "sigma_xx_MPa",
    words: ["Blue: compression, red: tension. What the passes have left when no wheel is near."],
    signed: true,
  },
  {
    column: "sigma_yy_MPa",
    title: "Residual stress across the rail, σ_y",
    bar: "MPa",
    hover: "σ_y %{z:.0f} MPa",
    unit: "sigma_yy_MPa",
    words: ["On the scale of σ_x."],
    signed: true,
  },
  {
    column: "plastic_strain_accumulated",
    title: "Plastic strain, accumulated over all passes",
    bar: "p",
    hover: "p %{z:.3g}",
    unit: "plastic_strain_accumulated",
    words: ["p adds up every plastic strain increment, so it grows in closed cycles too."],
  },
  {
    column: "class",
    title: "Class of each point",
    bar: "",
    hover: "%{text}",
    unit: "class",
    words: ["Blank: it has never yielded."],
    classes: true,
  },
];

function marker(s: SectionHistory): Marker|undefined {
  const at = s.summary.loops?.[0];
  if (!at) return undefined;
  return {x: 1e3 * at.y_m, y: 1e3 * at.depth_m, text: `governing point, ${depthText(at.depth_m)} deep`};
}

/// What all sections show, so that they can be compared: across as wide as the widest, as deep as the shallowest.
interface Frame {
  across: Span;
  foot: number;
}

function commonFrame(all: SectionHistory[]): Frame {
  const windows = all.map((s) => windowOf(s, sectionOf(s)));
  const feet = all.map((s) => {
    const {depth} = sectionOf(s);
    const last = depth.length - 1;
    return depth[last] + 0.5 * (depth[last] - (depth[last - 1] ?? 0));
  });
  const across: Span = [Math.min(...windows.map(([from]) => from)), Math.max(...windows.map(([, to]) => to))];
  return {across, foot: Math.min(...feet)};
}

function sectionMap(s: SectionHistory, all: SectionHistory[], q: Quantity, scale: number, shown: Frame): Figure {
  const section = sectionOf(s);
  const yielded = (v: number, i: number) => (q.classes && s.residual.plastic_strain_accumulated[i] === 0 ? null : v);
  const values = section.rows(s.residual[q.column].map(yielded));
  const across = (depth: number): Line => ({x: shown.across, y: [depth, depth]});
  return mapFigure({
    id: `${q.id ?? "passes"}-${q.column.replace("_MPa", "").replace(/_/g, "-")}-${all.indexOf(s) + 1}`,
    title: called(s, all, q.title),
    words: q.classes ? [classLegend(s), ...q.words] : q.words,
    z: values,
    centresX: section.y,
    centresY: section.depth,
    names: ["y_mm", "depth_mm", q.unit],
    labels: ["y across the rail [mm]", "depth [mm]"],
    hover: q.hover,
    hoverY: "depth",
    bar: q.classes ? undefined : q.bar,
    scale: q.classes ? kClassScale
        : q.signed   ? signedScale(scale)
                     : magnitudeScale(scale),
    valueWords: q.classes ? classesOf(s) : undefined,
    reversed: true,
    windowX: shown.across,
    windowY: [0, shown.foot],
    lines: borders(s).map(across),
    marker: marker(s),
  });
}

function classLegend(s: SectionHistory): HTMLElement {
  const yielded = s.residual.class.filter((_, i) => s.residual.plastic_strain_accumulated[i] !== 0);
  const there = classesOf(s).flatMap((name, k) => {
    if (!yielded.includes(k)) return [];
    const swatch = element("span", {class: "swatch", style: `background: ${kClassFills[k]}`});
    return [element("span", {class: "entry"}, swatch, name)];
  });
  return element("span", {class: "legend"}, ...there, element("br"));
}

function sectionMaps(all: SectionHistory[], quantities: Quantity[]): Figure[] {
  const wide = all.filter((s) => sectionOf(s).width > 1);
  const shown = commonFrame(wide);
  return quantities.flatMap((q) => {
    const columns = q.signed ? ["sigma_xx_MPa", "sigma_yy_MPa"] : [q.column];
    const scale = Math.max(1e-12, ...wide.flatMap((s) => columns.map((c) => largest(s.residual[c]))));
    return wide.map((s) => sectionMap(s, all, q, scale, shown));
  });
}

/// Residual stress of single runs, which have made one pass.
export function residualMaps(all: SectionHistory[]): Figure[] {
  const [along, across] = kMaps;
  const words = ["Blue: compression, red: tension. What the wheel leaves behind."];
  return sectionMaps(all, [{...along, id: "residual", words}, {...across, id: "residual"}]);
}

// ---- lines

function profileFigure(
    all: PassesStory[], id: string, title: string, unit: string, lines: [column: string, name: string][]): Figure {
  const series =
      all.flatMap((s, n) => lines.map(([column, name], k): Series => ({
                                        x: s.profile[column],
                                        y: s.profile.depth_mm,
                                        name: called(s, all, name),
                                        dash: several(all) && k > 0 ? "dash" : "solid",
                                        colour: (t: Theme) => t.series[(several(all) ? n : k) % t.series.length],
                                        hover: `depth %{y:.2f} mm\n${name} %{x:.4g}`,
                                      })));
  return linesFigure({
    id,
    title,
    words: ["In the column with the largest plastic strain. Lines across: where two materials meet."],
    labels: [unit, "depth [mm]"],
    names: [unit, "depth_mm"],
    downwards: true,
    levels: [...new Set(all.flatMap(borders))],
    height: 400,
    series,
  });
}

/// Of what can be drawn on a logarithmic axis.
const positive = (values: Values) => values.map((v) => (v !== null && v > 0 ? v : null));

function strainFigure(all: PassesStory[]): Figure {
  const lines: [column: string, name: string][] =
      [["accumulated_strain", "accumulated, Δp"], ["net_strain", "net, of the pass alone"]];
  const series =
      all.flatMap((s, n) => lines.map(([column, name], k): Series => ({
                                        x: s.passes.pass,
                                        y: positive(s.passes[column]),
                                        name: called(s, all, name),
                                        markers: s.passes.pass.length < 60,
                                        dash: several(all) && k > 0 ? "dash" : "solid",
                                        colour: (t: Theme) => t.series[(several(all) ? n : k) % t.series.length],
                                        hover: `pass %{x}\n${name} %{y:.3g}`,
                                      })));
  return linesFigure({
    id: "passes-strain",
    title: "Plastic strain of each pass",
    words: [
      "The largest of all points. Constant net strain: ratchetting. Net strain that falls while Δp stays: closed " +
          "cycles. Below 10⁻⁶ nothing counts as flow; passes without any are left out.",
    ],
    labels: ["pass", "strain in the pass"],
    names: ["pass", "strain"],
    log: "xy",
    series,
  });
}

function overPasses(
    all: PassesStory[], id: string, title: string, unit: string, lines: [column: string, name: string][],
    words: string): Figure {
  const series =
      all.flatMap((s, n) => lines.map(([column, name], k): Series => ({
                                        x: s.passes.pass,
                                        y: s.passes[column],
                                        name: called(s, all, name),
                                        markers: s.passes.pass.length < 60,
                                        dash: several(all) && k > 0 ? "dash" : "solid",
                                        colour: (t: Theme) => t.series[(several(all) ? n : k) % t.series.length],
                                        hover: `pass %{x}\n${name} %{y:.4g}`,
                                      })));
  return linesFigure({id, title, words: [words], labels: ["pass", unit], names: ["pass", unit], series});
}

// ---- loops

const kLoops: [id: string, title: string, strain: string, stress: string, factor: number][] = [
  ["x", "Stress along the rail against strain, σ_x and ε_x", "strain_xx", "sigma_xx_MPa", 1],
  ["xz", "Shear stress against shear strain, τ_xz and γ_xz", "strain_xz", "sigma_xz_MPa", 2],
];

function loopFigures(s: PassesStory, all: PassesStory[]): Figure[] {
  const {loops} = s;
  const points = s.summary.loops ?? [];
  if (!loops || !points.length) return [];
  return kLoops.map(([id, title, strainColumn, stressColumn, factor]) => {
    const series = points.map((p, k): Series => {
      const mine = loops.point.flatMap((v, i) => (v === k ? [i] : []));
      return {
        name: `${p.name}, ${depthText(p.depth_m)}`,
        x: mine.map((i) => 1e3 * factor * loops[strainColumn][i]),
        y: mine.map((i) => loops[stressColumn][i]),
        colour: (t: Theme) => t.series[k % t.series.length],
        hover: "%{x:.3f} × 10⁻³\n%{y:.0f} MPa",
      };
    });
    const axis = id === "x" ? "ε_x [10⁻³]" : "γ_xz [10⁻³]";
    return linesFigure({
      id: `passes-loop-${id}-${all.indexOf(s) + 1}`,
      title: called(s, all, title),
      words:
          ["The last pass at points of one column. A line: elastic. A loop that closes: flow to and fro. " +
           "One that ends elsewhere than it began: net strain."],
      labels: [axis, id === "x" ? "σ_x [MPa]" : "τ_xz [MPa]"],
      names: [axis, stressColumn],
      series,
    });
  });
}

// ---- elastic against yielding

function alongMaps(s: PassesStory, all: PassesStory[]): Figure[] {
  const {along} = s;
  if (!along) return [];
  const depths = along.depth_mm;
  let width = 0;
  while (width < depths.length && depths[width] === depths[0]) ++width;
  const x = along.x_mm.slice(0, width);
  const depth = rowsOf(depths, width).map((row) => row[0]);
  const scale = Math.max(largest(along.von_mises_elastic_MPa), largest(along.von_mises_MPa));
  const windowX: Span = [Math.min(...x), Math.max(...x)];
  const kinds: [column: string, title: string][] = [
    ["von_mises_elastic_MPa", "Von Mises stress under the wheel, elastic"],
    ["von_mises_MPa", "With the rail yielding, last pass"],
  ];
  return kinds.map(
      ([column, title]) => mapFigure({
        id: `passes-${column === "von_mises_MPa" ? "yielding" : "elastic"}-${all.indexOf(s) + 1}`,
        title: called(s, all, title),
        words: [`y = ${numberText(along.y_mm[0], 3)} mm. The wheel travels to the right; one scale for both.`],
        z: rowsOf<number|null>(along[column], width),
        centresX: x,
        centresY: depth,
        names: ["x_mm", "depth_mm", column],
        labels: ["x along the rail [mm]", "depth [mm]"],
        hover: "von Mises %{z:.0f} MPa",
        hoverY: "depth",
        bar: "MPa",
        scale: magnitudeScale(scale),
        reversed: true,
        windowX,
        windowY: [0, Math.max(...depth)],
        lines: borders(s).map((d): Line => ({x: windowX, y: [d, d]})),
      }));
}

// ---- page

const grid = (figures: Figure[]) => element("div", {class: "grid"}, ...figures.map(frame));

function assumptions(all: PassesStory[]): Child[] {
  return all.map((s) => {
    const lines = [...(s.summary.assumptions ?? []), ...(s.summary.notes ?? [])];
    const list = element("ul", {class: "note"}, ...lines.map((line) => element("li", {}, line)));
    return lines.length ? details(called(s, all, "What it assumes"), list) : null;
  });
}

/// The whole page of passes, below its header.
export function passesParts(all: PassesStory[]): HTMLElement[] {
  const stress: [string, string][] = [["sigma_xx_MPa", "σ_x"], ["sigma_yy_MPa", "σ_y"]];
  const maps = sectionMaps(all, kMaps);
  const loops = all.flatMap((s) => loopFigures(s, all));
  const along = all.flatMap((s) => alongMaps(s, all));
  const axes = note(
      "x along the travel of the load, y from the contact point to the field side, depth from the surface. The " +
      "cross: the governing point, where the net strain is largest; dashed: the border of a layer.");
  const profiles = [
    profileFigure(all, "passes-profile-stress", "Residual stress with depth", "residual stress [MPa]", stress),
    profileFigure(
        all, "passes-profile-strain", "Plastic strain with depth", "plastic strain",
        [["plastic_strain_accumulated", "accumulated, p"], ["plastic_xz", "shear, ε_xz"]]),
  ];
  const history = [
    strainFigure(all),
    overPasses(
        all, "passes-stress", "Most compressive residual stress", "stress [MPa]",
        [["sigma_x_min_MPa", "σ_x"], ["sigma_y_min_MPa", "σ_y"]], "Anywhere in the section, after each pass."),
  ];
  return [
    ...all.map((s) => verdictCard(s, all)),
    part("section", "The section after the last pass", axes, ...(maps.length ? [grid(maps)] : []), grid(profiles)),
    part("numbers", "Numbers", factsTable(all), ...assumptions(all)),
    part("history", "Pass after pass", grid(history)),
    ...(loops.length ? [part("loops", "Loops of the last pass", grid(loops))] : []),
    ...(along.length ? [part("along", "Elastic and yielding", grid(along))] : []),
  ];
}

/// Names of the parts in the contents line.
export function passesContents(all: PassesStory[]): [id: string, name: string][] {
  const there = (has: boolean, id: string, name: string): [string, string][] => (has ? [[id, name]] : []);
  return [
    ["verdict-of-passes", "verdict"],
    ["section", "section"],
    ["numbers", "numbers"],
    ["history", "pass after pass"],
    ...there(all.some((s) => s.loops !== null && (s.summary.loops ?? []).length > 0), "loops", "loops"),
    ...there(all.some((s) => s.along !== null), "along", "elastic and yielding"),
  ];
}
