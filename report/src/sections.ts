// Verdict, numbers, geometry, history and origin: the parts of the page around the patch and its stresses.
import {
  numberAt,
  option,
  type Check,
  type CheckWords,
  type Geometry,
  type Layer,
  type Quantity,
  type Report,
  type Run,
  type Span,
  type Values
} from "./data";
import {details, element, table, tableHead, type Cell} from "./dom";
import {axis, baseLayout, type Figure, type Theme} from "./figures";
import {linesFigure, type Series} from "./lines";
import {
  checkWords,
  countText,
  engineName,
  limitText,
  minus,
  numberText,
  percentText,
  plotText,
  quantityAt,
  runLabel,
  shownQuantities,
  unitText,
  zones
} from "./text";

/// Whose check it is, where the page shows several runs.
function whose(report: Report, check: Check): string {
  const [first] = check.runs;
  if (check.runs.length === 1 && report.runs.length > 1) return runLabel(report.runs[first]);
  if (check.runs.length < 2 || report.runs.length < 3) return "";
  return check.runs.map((k) => report.runs[k].name).join(" – ");
}

function limitWords(check: Check, words: CheckWords): string {
  if (!check.judged || check.limit === null) return "";
  return `${words.unit.shown.includes("|") ? "" : "at most "}${limitText(check.limit, words.unit)}`;
}

const kMarks = {
  ok: "✓ holds",
  failed: "✗ fails",
  remark: "· note",
};

function checkRow(report: Report, check: Check): HTMLElement {
  const words = checkWords(check.name);
  const judgement = check.ok ? "ok" : "failed";
  const state = check.judged ? judgement : "remark";
  const attributes = {
    class: state,
    "data-check": check.name,
    "data-runs": check.runs.join(","),
    "data-ok": String(check.ok),
    "data-judged": String(check.judged),
  };
  return element(
      "tr",
      attributes,
      element("td", {class: "mark"}, kMarks[state]),
      element("th", {scope: "row"}, words.name),
      element("td", {class: "value"}, unitText(check.value, words.unit, 3)),
      element("td", {class: "limit"}, limitWords(check, words)),
      element("td", {}, [words.what, whose(report, check), check.note].filter(Boolean).join("; ")),
  );
}

function checksTable(report: Report, checks: Check[]): HTMLElement {
  const head = tableHead(["", "check", "value", "limit", "what it says"]);
  const body = element("tbody", {}, ...checks.map((c) => checkRow(report, c)));
  return element("div", {class: "scroll"}, element("table", {class: "checks"}, head, body));
}

function verdictLine(judged: Check[], failed: Check[]): string {
  if (!judged.length) return "Nothing was checked.";
  if (!failed.length) return `All ${judged.length} checks hold.`;
  return `${failed.length} of ${judged.length} checks ${failed.length === 1 ? "fails" : "fail"}.`;
}

/// What to be careful about, if anything.
function warning(failed: Check[]): HTMLElement|null {
  if (!failed.length) return null;
  const names = new Set(failed.map((c) => checkWords(c.name).name));
  return element("p", {class: "failed"}, `Read the results with care: ${[...names].join(", ")}.`);
}

const kManyChecks = 40;

/// Green or red, in words, with every check and its limit; of a study: what failed first, the rest on demand.
export function verdict(report: Report): HTMLElement {
  const judged = report.checks.filter((c) => c.judged);
  const failed = judged.filter((c) => !c.ok);
  const holds = judged.filter((c) => c.ok);
  const notes = report.checks.filter((c) => !c.judged);
  const ok = judged.length > 0 && failed.length === 0;
  const tableOf = (checks: Check[]) => checksTable(report, checks);
  const heading = element("h2", {}, ok ? "✓ " : "✗ ", verdictLine(judged, failed));
  const attributes = {id: "verdict", class: ok ? "good" : "bad", "data-ok": String(ok)};
  if (report.checks.length <= kManyChecks)
    return element("section", attributes, heading, warning(failed), tableOf([...failed, ...holds, ...notes]));
  const summary = `${holds.length} checks that hold, ${notes.length} notes`;
  const rest = details(summary, tableOf([...holds, ...notes]));
  return element("section", attributes, heading, warning(failed), failed.length ? tableOf(failed) : null, rest);
}

interface Inside {
  value_Pa: number;
  depth_m: number;
  zone: string;
}

function largestBelowSurface(run: Run): Inside|null {
  let best: Inside|null = null;
  for (const {key: zone, name} of zones()) {
    const m = zone === "surface" ? null : run.summary.stress.rail?.[zone]?.von_mises_max;
    if (m && (!best || m.value_Pa > best.value_Pa)) best = {value_Pa: m.value_Pa, depth_m: m.depth_m ?? 0, zone: name};
  }
  return best && best.zone === "below the surface" ? {...best, zone: "largest"} : best;
}

/// A number as its quantity's unit shows it.
function digits(run: Run, path: string, most: number): string {
  const value = numberAt(run, path);
  return numberText(value === null ? null : quantityAt(path).unit.factor * value, most);
}

function tile(name: string, text: string, unit: string, small = ""): HTMLElement {
  return element(
      "div",
      {class: "tile"},
      element("span", {class: "name"}, name),
      element("span", {class: "big"}, text, unit ? element("small", {}, ` ${unit}`) : null),
      small ? element("span", {class: "small"}, small) : null,
  );
}

function numberTile(run: Run, path: string, most = 4): HTMLElement {
  const {name, unit} = quantityAt(path);
  return tile(name, digits(run, path, most), unit.shown);
}

function patchTile(run: Run): HTMLElement {
  const [length, width] = ["contact/patch_length_m", "contact/patch_width_m"];
  const text = `${digits(run, length, 3)} × ${digits(run, width, 3)}`;
  return tile("Patch", text, quantityAt(length).unit.shown, "length along x × width");
}

function tractionTile(run: Run): HTMLElement {
  const fx = numberAt(run, "contact/F_x_N");
  const fz = numberAt(run, "contact/F_z_N");
  const wanted = `wanted ${option(run, "drive", "traction_coefficient") ?? "–"}`;
  return tile("Traction F_x / F_z", numberText(fx !== null && fz ? fx / fz : null), "", run.summary.state ?? wanted);
}

function insideTile(run: Run): HTMLElement {
  const inside = largestBelowSurface(run);
  const name = "Rail, von Mises below the surface";
  if (!inside) return tile(name, "–", "MPa");
  const place = `${inside.zone}, ${(1e3 * inside.depth_m).toFixed(2)} mm deep`;
  return tile(name, numberText(1e-6 * inside.value_Pa), "MPa", place);
}

/// One run's numbers large; `named`: with its name above them, where the page shows others too.
export function tiles(run: Run, named: boolean): HTMLElement {
  const name = `Numbers of ${runLabel(run)}; all runs beside each other in the table below.`;
  const cards = element(
      "div",
      {class: "tiles"},
      numberTile(run, "contact/p_max_Pa"),
      numberTile(run, "contact/q_max_Pa"),
      patchTile(run),
      numberTile(run, "contact/slip_area_fraction", 3),
      tractionTile(run),
      insideTile(run),
  );
  return element("div", {}, named ? element("p", {class: "note", id: "tiles-of"}, name) : null, cards);
}

function numberCell(q: Quantity, value: number|null): Cell {
  const text = numberText(value === null ? null : q.unit.factor * value, q.digits);
  return {text, attributes: {"data-path": q.path, "data-value": String(value)}};
}

function differenceText(q: Quantity, [a, b]: Values): string {
  return q.comparable && a !== null && b ? percentText((a - b) / Math.abs(b)) : "–";
}

export function numbersTable(runs: Run[]): HTMLElement {
  const pair = runs.length === 2;
  const rows: (string|Cell)[][] = [];
  for (const q of shownQuantities()) {
    const values = runs.map((run) => numberAt(run, q.path));
    if (values.every((v) => v === null)) continue;
    const difference = pair ? [differenceText(q, values)] : [];
    rows.push([q.name, q.unit.shown, ...values.map((v) => numberCell(q, v)), ...difference]);
  }
  const head = ["quantity", "unit", ...runs.map(runLabel), ...(pair ? ["difference"] : [])];
  return table("Contact", head, rows, {class: "numbers", id: "contact-numbers"});
}

// ---- geometry

interface Curve {
  name: string;
  line: {x: number[]; y: number[]};
  colour: (t: Theme) => string;
  dash: string;
}

function millimetres(points: [number, number][]): Curve["line"] {
  return {x: points.map((p) => 1e3 * p[0]), y: points.map((p) => 1e3 * p[1])};
}

function curvesOf(g: Geometry): Curve[] {
  const wheel = {name: `wheel ${g.wheel_profile}`, line: millimetres(g.wheel_m), colour: (t: Theme) => t.series[1]};
  const rail = {name: `rail ${g.rail_profile}`, line: millimetres(g.rail_m), colour: (t: Theme) => t.series[0]};
  const bottoms = g.layers.map((l): Curve => {
    const line = millimetres(l.bottom_m);
    return {name: `bottom of ${l.name}`, line, colour: (t) => t.ink, dash: "dash"};
  });
  return [{...wheel, dash: "solid"}, {...rail, dash: "solid"}, ...bottoms];
}

function curveTrace(c: Curve, theme: Theme): Record<string, unknown> {
  return {
    type: "scatter",
    mode: "lines",
    name: plotText(c.name),
    ...c.line,
    line: {color: c.colour(theme), dash: c.dash, width: 2},
    hovertemplate: `y %{x:.2f} mm<br>z %{y:.3f} mm<extra>${plotText(c.name)}</extra>`,
  };
}

function contactTrace(contact: Point, theme: Theme): Record<string, unknown> {
  return {
    type: "scatter",
    mode: "markers",
    name: "rigid contact point",
    x: [contact.x],
    y: [contact.y],
    marker: {size: 10, symbol: "circle-open", color: theme.ink, line: {width: 2}},
    hovertemplate: "y %{x:.3f} mm<br>z %{y:.3f} mm<extra>rigid contact point</extra>",
  };
}

interface Point {
  x: number;
  y: number;
}

interface View {
  halfWidth: number;  // mm
  ratio: number;      // heights are drawn so many times larger than widths
}

function viewLayout({halfWidth, ratio}: View, contact: Point, theme: Theme, width: number): Record<string, unknown> {
  const plotHeight = Math.min(Math.max(180, (width - 80) * 0.62), 380);
  const halfHeight = (halfWidth * plotHeight) / (width - 80) / ratio;
  const rangeX = [contact.x - halfWidth, contact.x + halfWidth];
  const rangeY = [contact.y - halfHeight, contact.y + halfHeight];
  const anchor = ratio === 1 ? {scaleanchor: "x"} : {};
  return {
    ...baseLayout(theme, width, plotHeight + 90),
    margin: {l: 58, r: 16, t: 30, b: 46},
    showlegend: true,
    xaxis: axis(theme, "y, field side right [mm]", {range: rangeX, constrain: "domain"}),
    yaxis: axis(theme, "z [mm]", {range: rangeY, ...anchor, constrain: "domain"}),
  };
}

const kAboutProfiles = "Profiles as placed, before loading, seen against the rolling direction; equal scales. " +
    "Zero is the crown of the canted rail.";

/// Profiles where they stand, whole and near the contact.
export function geometryFigures(run: Run): Figure[] {
  const g = run.geometry;
  if (!g) return [];
  const contact = {x: 1e3 * g.contact.y_m, y: 1e3 * g.contact.z_m};
  const curves = curvesOf(g);
  const rows = curves.flatMap((c) => c.line.x.map((x, i) => [c.name, x, c.line.y[i]]));
  const figure = (id: string, title: string, words: string, view: View): Figure => ({
    id,
    title,
    words: [words],
    draw: (theme, width) => ({
      data: [...curves.map((c) => curveTrace(c, theme)), contactTrace(contact, theme)],
      layout: viewLayout(view, contact, theme, width),
    }),
    table: () => ({
      names: ["curve", "y_mm", "z_mm"],
      rows: [...rows, ["rigid contact point", contact.x, contact.y]],
    }),
  });
  const near = "The same, heights drawn ten times larger than widths.";
  return [
    figure("profiles", "Wheel on rail", kAboutProfiles, {halfWidth: 75, ratio: 1}),
    figure("profiles-near", "Near the contact point", near, {halfWidth: 20, ratio: 10}),
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

export function geometryTable(run: Run): HTMLElement|null {
  const g = run.geometry;
  if (!g) return null;
  const c = g.contact;
  const mm = (metres: number) => `${minus((1e3 * metres).toFixed(3))} mm`;
  const roll = option(run, "geometry", "roll");
  const radii = [c.curvature_wheel_lateral_per_m, c.curvature_rail_lateral_per_m].map(radiusText).join(", ");
  const rows: string[][] = [
    ["wheel on rail", `${g.wheel_profile} on ${g.rail_profile}`],
    ["lateral shift of the wheel", option(run, "geometry", "lateral_shift") ?? "–"],
    ["cant of the rail", option(run, "geometry", "cant") ?? "–"],
    ...(roll && Number(roll) !== 0 ? [["roll of the wheelset, field side up", roll]] : []),
    ["contact point on the rail", `y ${mm(c.y_m)}, z ${mm(c.z_m)}`],
    ["contact point on the wheel, from the tape circle", `y ${mm(c.wheel_y_m)}`],
    ["contact angle", `${numberText(1e3 * c.angle_rad)} mrad`],
    ["rolling radius", `${(1e3 * c.rolling_radius_m).toFixed(3)} mm`],
    ["lateral radius of wheel, of rail (convex positive)", radii],
    [loadWords(run), `${numberText(1e-3 * g.load_N, 5)} kN`],
    [g.hertz.approach_m === null ? "Hertz, no layer" : "Hertz’s ellipse, no layer", hertzWords(g.hertz)],
    ...g.layers.map(layerRow),
  ];
  return table("Placement", ["", ""], rows, {class: "facts"});
}

// ---- history

export interface HistoryLine {
  column: string;
  name: string;
  scale?: number;
  hover: string;
}

interface HistoryFigure {
  id: string;
  title: string;
  label: string;
  column: string;
  words: string;
  lines: HistoryLine[];
  leastSpan?: number;
}

const kHistory: HistoryFigure[] = [
  {
    id: "history-forces",
    title: "Forces on the wheel",
    label: "force [kN]",
    column: "force_kN",
    words: "F_z carries the weight, F_x drives.",
    lines: [
      {column: "F_z_N", name: "F_z", scale: 1e-3, hover: "F_z %{y:.2f} kN"},
      {column: "F_x_N", name: "F_x", scale: 1e-3, hover: "F_x %{y:.2f} kN"},
      {column: "F_y_N", name: "F_y", scale: 1e-3, hover: "F_y %{y:.2f} kN"},
    ],
  },
  {
    id: "history-p",
    title: "Largest pressure",
    label: "p_max [MPa]",
    column: "p_max_MPa",
    words: "Of the nodes, before the peak between them is interpolated: " +
        "it swings with every element that the wheel passes.",
    lines: [{column: "p_max_MPa", name: "p_max", hover: "p_max %{y:.1f} MPa"}],
    leastSpan: 0.2,
  },
  {
    id: "history-creepage",
    title: "Longitudinal creepage",
    label: "creepage [10⁻³]",
    column: "creepage_1e-3",
    words: "Negative while the wheel drives.",
    lines: [{column: "creepage", name: "creepage", scale: 1e3, hover: "creepage %{y:.3f} × 10⁻³"}],
  },
  {
    id: "history-energy",
    title: "Energies",
    label: "energy [J]",
    column: "energy_J",
    words: "Stored, lost and damped. The work of the torque and the kinetic energy it turns into are hundreds of " +
        "times larger; they are in history.csv.",
    lines: [
      {column: "strain_J", name: "strain", hover: "%{y:.3f} J"},
      {column: "friction_J", name: "friction", hover: "%{y:.3f} J"},
      {column: "run_up_damping_J", name: "run-up damping", hover: "%{y:.3f} J"},
      {column: "hourglass_J", name: "hourglass", hover: "%{y:.3f} J"},
      {column: "absorbed_J", name: "absorbed at the rail’s ends", hover: "%{y:.3f} J"},
    ],
  },
  {
    id: "history-closure",
    title: "Energy closure",
    label: "closure [mJ]",
    column: "closure_mJ",
    words: "Sum of all energies and works since the start; exact time steps would keep it zero.",
    lines: [{column: "closure_J", name: "closure", scale: 1e3, hover: "%{y:.4f} mJ"}],
  },
  {
    id: "history-penetration",
    title: "Penetration",
    label: "penetration [nm]",
    column: "penetration_nm",
    words: "Largest overlap of the two surfaces.",
    lines: [{column: "penetration_um", name: "penetration", scale: 1e3, hover: "%{y:.3f} nm"}],
  },
];

/// What the charts of a history have along x.
export interface Along {
  column: string;
  hover: string;
}

/// One run: a colour a line; two: a colour a run, dots for all lines but the first.
export function historySeries(runs: Run[], lines: HistoryLine[], along: Along): Series[] {
  const several = runs.length > 1;
  const seriesOf = (run: Run, n: number, {column, name, scale = 1, hover}: HistoryLine, k: number): Series => ({
    name: several ? `${name}, ${runLabel(run)}` : name,
    x: run.history![along.column],
    y: run.history![column].map((v) => (v === null ? null : scale * v)),
    colour: (t) => t.series[(several ? n : k) % t.series.length],
    dash: several && k > 0 ? "dot" : "solid",
    hover: `${along.hover}<br>${hover}`,
  });
  return runs.flatMap((run, n) => lines.map((line, k) => seriesOf(run, n, line, k)));
}

/// The window over which the results are averaged, mm.
function averagedOver(run: Run): Span|undefined {
  const position = 1e3 * (run.summary.position_m ?? NaN);
  const half = 0.5 * parseFloat(option(run, "run", "window") ?? "NaN");
  return Number.isFinite(position) && Number.isFinite(half) ? [position - half, position + half] : undefined;
}

/// What happened on the way: forces, pressure, creepage, energy.
export function historyFigures(runs: Run[]): Figure[] {
  const given = runs.filter((run) => run.history);
  if (!given.length || !given[0].history!.position_mm) return [];
  const band = averagedOver(given[0]);
  const shaded = band ? " Shaded: the window over which the results are averaged." : "";
  const figure = (f: HistoryFigure, n: number) => linesFigure({
    id: f.id,
    title: f.title,
    labels: ["position of the wheel [mm]", f.label],
    names: ["position_mm", f.column],
    band,
    leastSpan: f.leastSpan,
    words: [f.words + (n === 0 ? shaded : "")],
    series: historySeries(given, f.lines, {column: "position_mm", hover: "wheel at %{x:.1f} mm"}),
  });
  return kHistory.map(figure);
}

// ---- origin

function provenanceText(value: unknown): string {
  if (value === undefined || value === null) return "–";
  return Array.isArray(value) ? value.join(" ") : String(value);
}

/// Cells, or elements and steps.
function sizeText(run: Run): string {
  const elements = countText(numberAt(run, "run/elements"));
  if (run.engine === "bem") return `${elements} cells`;
  return `${elements} elements, ${countText(numberAt(run, "run/steps"))} steps`;
}

function originTable(run: Run, caption: string): HTMLElement {
  const p = run.provenance;
  const text = (key: string) => provenanceText(p[key]);
  const changes = p.dirty === true ? " (with changes)" : "";
  const inputs = Array.isArray(p.inputs) ? (p.inputs as Record<string, string>[]) : [];
  const rows: string[][] = [
    ["folder", run.folder],
    ["engine", engineName(run.engine)],
    ["program", `RailStrata ${text("version")}, commit ${text("commit")}${changes}`],
    ["computed", text("time_utc")],
    ["command", text("command_line")],
    ["threads", `${text("threads")}, ${text("isa")}`],
    ["compiler", `${text("compiler")} ${text("flags")}`],
    ["size", `${sizeText(run)}, ${numberText(numberAt(run, "run/wall_s"), 3)} s`],
    ...inputs.map((i) => [`input ${i.file}`, `SHA-256 ${i.sha256}`]),
  ];
  return table(caption, ["", ""], rows, {class: "facts"});
}

/// Where the numbers come from, and the case in full.
export function origin(runs: Run[]): HTMLElement[] {
  return runs.map((run) => {
    const caption = runs.length > 1 ? runLabel(run) : "";
    const options = table("", ["table", "key", "value"], run.case, {class: "case"});
    const all = details("Every option of the case", options);
    return element("div", {class: "origin"}, originTable(run, caption), all);
  });
}
