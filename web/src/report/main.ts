// The page of `railstrata report`: reads the data the program has put in, builds the parts, draws the figures.
import {paintFor} from "../canvas";
import {details, element, note, part, table} from "../dom";
import {drawAll, forget, frame, setOrigin, type Figure} from "../figures";
import {numberText} from "../text";
import {kDark, kLight, type Theme} from "../theme";
import type {BodyName, Span} from "../types";
import {crackPart} from "./crack";
import type {ChartData, ChartSeries, Maps, Report, Run, Table} from "./data";
import {geometryFigures, geometryTable} from "./geometry";
import {gridsRow} from "./grids";
import {hero} from "./hero";
import {historyFigures} from "./history";
import {interfacePart} from "./interface";
import {lastsPart} from "./lasts";
import {linesFigure, type Series} from "./lines";
import {passesContents, passesParts} from "./passes";
import {centreLines, patchesTable, patchMaps} from "./patch";
import {numbersTable, origin, tiles, verdict} from "./sections";
import {slicesParts} from "./slices";
import {spaceParts} from "./space";
import {depthLines, kShear, maximaTable, sectionMaps} from "./stress";
import {filmParts, transientFigures} from "./transient";
import {hasHeights, wayPart} from "./way";
import {hasWhatIf, whatIfPart} from "./whatif";
import {engineName, isOneResult, runLabel, setWords} from "./words";
import {yieldedPart} from "./yielded";

const report = JSON.parse(document.getElementById("data")!.textContent!) as Report;
setWords(report.words);

// ---- theme
const wantsDark = window.matchMedia("(prefers-color-scheme: dark)");
let chosen: "light"|"dark"|null = null;
const isDark = () => (chosen ? chosen === "dark" : wantsDark.matches);
const theme = (): Theme => (isDark() ? kDark : kLight);
function applyTheme(): void {
  document.documentElement.dataset.theme = isDark() ? "dark" : "light";
  drawAll(theme());
}

// ---- parts
const grid = (figures: Figure[]) => element("div", {class: "grid"}, ...figures.map(frame));

function mapsOf(m: Maps): Figure[] {
  const runs = m.runs.map((k) => report.runs[k]);
  const first = runs.map((run) => ({...run, further_patches: []}));
  const all = m.kind === "state" ? patchMaps(first) : sectionMaps(runs, "rail");
  const wanted = m.kind === "state" ? "map-state-" : `section-rail-longitudinal-${m.kind}-`;
  return all.filter((f) => f.id.startsWith(wanted));
}

/// One row of maps; ids and titles are the row's, whatever the runs are called.
function mapsRow(m: Maps): HTMLElement[] {
  const figures = mapsOf(m).map((f, n) => ({...f, id: `${m.id}-${n + 1}`, title: m.names[n]}));
  return [element("h3", {class: "row"}, m.title), ...(m.note ? [note(m.note)] : []), grid(figures)];
}

const kManyRows = 20;  // a longer table is folded

function studyTable(t: Table): HTMLElement[] {
  const text = (v: string|number|null) => (typeof v === "number" ? numberText(v) : v ?? "–");
  const rows = t.rows.map((row) => row.map(text));
  const attributes = {class: "numbers study", id: `table-${t.id}`};
  const shown = [table(t.title, t.columns, rows, attributes), t.note ? note(t.note) : element("span")];
  return rows.length > kManyRows ? [details(`${t.title}: ${rows.length} rows`, ...shown)] : shown;
}

function chartFigure(c: ChartData): Figure {
  const hover = `${c.x} %{x:.4g}\n${c.y} %{y:.4g}`;
  const seriesOf = (s: ChartSeries, n: number): Series => ({
    name: s.name,
    x: s.x,
    y: s.y,
    markers: s.markers && s.x.length < 60,
    dash: s.colour < 0 && n >= kLight.series.length ? "dash" : s.dash,  // colours begin again
    colour: (t) => t.series[(s.colour < 0 ? n : s.colour) % t.series.length],
    hover,
  });
  return linesFigure({
    id: c.id,
    title: c.title,
    words: c.note ? [c.note] : undefined,
    labels: [c.x, c.y],
    names: [c.x, c.y],
    window: touched(c),
    series: c.series.map(seriesOf),
    wide: c.wide,
    bars: c.bars,
    log: c.log || undefined,
    height: c.bars?.length ? 120 + 34 * c.bars.length : undefined,
  });
}

/// Over all cases, the figures first.
function studyParts(): HTMLElement[] {
  const lasts = report.grids.length ? [part("grids", "What lasts", ...report.grids.flatMap(gridsRow))] : [];
  const answers = report.tables.length ? [part("tables", "Answers", ...report.tables.flatMap(studyTable))] : [];
  const charts = report.charts.length ? [part("charts", "Figures", grid(report.charts.map(chartFigure)))] : [];
  const maps = report.maps.length ? [part("maps", "Maps", ...report.maps.flatMap(mapsRow))] : [];
  return [...lasts, ...charts, ...maps, ...answers];
}

/// Of a line through the patch only where it touches, with a little room; everything of a trend.
function touched(c: ChartData): Span|undefined {
  if (!c.x.startsWith("x, rolling")) return undefined;
  const x = c.series.flatMap((s) => s.x.filter((_, i) => s.y[i] > 0));
  return x.length ? [Math.min(...x) - 2, Math.max(...x) + 2] : undefined;
}

function sections(runs: Run[], body: BodyName): HTMLElement[] {
  const figures = sectionMaps(runs, body);
  if (!figures.length) return [note(`No sections of the ${body} in this folder; write the results anew to have them.`)];
  const shear = details("Shear stresses τ_xz and τ_max", grid(sectionMaps(runs, body, kShear)));
  shear.id = `shear-${body}`;
  shear.addEventListener("toggle", () => drawAll(theme()));
  return [grid(figures), shear];
}

const kAxes = "x counts from the axle in the rolling direction, y from the place of the patch to the field side, " +
    "depth from the surface along its normal.";

function geometryPart(run: Run): HTMLElement {
  const none = "No geometry in this folder; write the results anew to have it.";
  return part("geometry", "Geometry and placement", grid(geometryFigures(run)), geometryTable(run) ?? note(none));
}

function patchPart(runs: Run[]): HTMLElement {
  const words = note(`${kAxes} The cross marks the place of the patch, the weighted middle of the overlap.`);
  return part(
      "patch", "The patch", words, patchesTable(runs), grid(patchMaps(runs)), grid(centreLines(runs)),
      ...spaceParts(runs));
}

const hasLayer = (runs: Run[], body: BodyName) => runs.some((run) => run.geometry?.layers.some((l) => l.on === body));

/// The wheel like the rail where it has a layer, folded otherwise.
function stressPart(runs: Run[]): HTMLElement {
  const words = note(`Places: ${kAxes} Finite element sections show each element’s own value.`);
  const bodyParts = (body: BodyName) =>
      [maximaTable(runs, body), ...(body === "rail" ? [words, ...slicesParts(runs)] : []), ...sections(runs, body),
       grid(depthLines(runs, body))];
  const wheel = details("The wheel", ...bodyParts("wheel"));
  wheel.id = "wheel";
  wheel.open = hasLayer(runs, "wheel");
  wheel.addEventListener("toggle", () => drawAll(theme()));
  const all = [...bodyParts("rail"), wheel];
  return part("stress", "Below the surface", ...all);
}

/// Everything about the runs that are looked at: one, or two side by side.
function runParts(runs: Run[]): HTMLElement[] {
  const history = [...historyFigures(runs), ...transientFigures(runs)];
  const yielded = yieldedPart(runs);
  const lasts = lastsPart(runs), crack = crackPart(runs), slip = interfacePart(runs);
  const way = [...filmParts(runs), ...(history.length ? [grid(history)] : [])];
  return [
    part("numbers", "Numbers", ...numbersTable(isOneResult(report.runs) ? report.runs : runs)),
    geometryPart(runs[0]),
    patchPart(runs),
    stressPart(runs),
    ...(yielded ? [yielded] : []),
    ...(lasts ? [lasts] : []),
    ...(crack ? [crack] : []),
    ...(slip ? [slip] : []),
    ...(way.length ? [part("history", "The whole history", ...way)] : []),
    part("origin", "Origin", ...origin(runs)),
  ];
}

let looked: Run[] = report.runs.slice(0, 2);
const stage = element("div", {id: "stage"});
const glance = element("div");
const heroOf = (run: Run) => note(`The pictures are those of ${runLabel(run)}.`);
function showRuns(): void {
  if (!looked.length) return drawAll(theme());
  forget(stage);
  forget(glance);
  const named = report.runs.length > 1 || report.tables.length > 0;
  const way = wayPart(looked);
  glance.replaceChildren(...(way ? [way] : []), hero(looked[0]), ...(named ? [heroOf(looked[0])] : []));
  stage.replaceChildren(tiles(looked, named), ...runParts(looked));
  drawAll(theme());
}

/// The runs of these lists, each once.
function pickedRuns(lists: HTMLSelectElement[]): Run[] {
  const picked = lists.map((list) => list.value).filter((v) => v !== "").map((v) => report.runs[Number(v)]);
  return picked.filter((r, k) => picked.indexOf(r) === k);
}

/// Which two of many runs are looked at.
function chooser(): HTMLElement|null {
  if (report.runs.length < 3) return null;
  const lists = [0, 1].map((n) => {
    const choice = (value: string, text: string) => element("option", {value}, text);
    const none = n === 0 ? [] : [choice("", "nothing beside")];
    const runs = report.runs.map((r, k) => choice(String(k), runLabel(r)));
    const list = element("select", {"aria-label": n === 0 ? "Run" : "beside it"}, ...none, ...runs);
    list.value = looked[n] ? String(report.runs.indexOf(looked[n])) : "";
    return list;
  });
  for (const list of lists)
    list.addEventListener("change", () => {
      looked = pickedRuns(lists);
      showRuns();
    });
  return element("div", {class: "chooser"}, "Run ", lists[0], " beside ", lists[1]);
}

/// A page without runs (a wear loop, a sweep) has nothing to judge but its answers.
const judged = () => report.checks.length > 0 || report.runs.length > 0 || (report.answers ?? []).length > 0;

/// Names of the parts that this page has, in order, and their words in the contents line.
function contents(): [id: string, name: string][] {
  const runs = report.runs.length > 0;
  if (report.passes) return passesContents(report.passes);
  type Entry = [id: string, name: string, there: boolean];
  const answers: Entry = ["tables", "answers", report.tables.length > 0];
  const figures: Entry = ["charts", "figures", report.charts.length > 0];
  const all: Entry[] = [
    ["verdict", "verdict", judged()],
    ["way", "on the way", report.runs.some(hasHeights)],
    ["grids", "what lasts", report.grids.length > 0],
    figures,
    ["maps", "maps", report.maps.length > 0],
    answers,
    ["numbers", "numbers", runs],
    ["geometry", "geometry", runs],
    ["patch", "patch", runs],
    ["stress", "stress", runs],
    ["yielded", "what yielded", report.runs.some((r) => r.summary.plastic)],
    ["lasts", "does it last?", report.runs.some((r) => r.summary.shakedown)],
    ["crack", "the crack", report.runs.some((r) => r.crack)],
    ["interface", "the interface", report.runs.some((r) => r.interface)],
    ["history", "history", report.runs.some((r) => r.history)],
    ["origin", "origin", runs],
    ["what-if", "what if?", hasWhatIf()],
  ];
  return all.filter(([, , there]) => there).map(([id, name]) => [id, name]);
}

/// What the page is about, below its title.
function subtitle(): HTMLElement {
  const {runs, program} = report;
  const engines = runs.map((r) => `${r.name}: ${engineName(r.engine)}`).join(" · ");
  const ofOne = isOneResult(runs);
  const position = (ofOne || runs.length === 2) && runs[0].engine === "fem" ? runs[0].summary.position_m : null;
  const where = position === null ? "" : `, wheel at ${numberText(1e3 * position)} mm`;
  const state = runs.length === 1 && runs[0].summary.state ? `, ${runs[0].summary.state}` : "";
  const what = runs.length > 2 && !ofOne ? `${runs.length} runs` : engines;
  const told = [`${what}${where}${state}`, `RailStrata ${program}`].filter((text) => text !== "");
  return element("p", {class: "sub"}, told.join(" · "));
}

function header(): HTMLElement {
  const button = element("button", {type: "button", id: "theme"}, "light / dark");
  button.addEventListener("click", () => {
    chosen = isDark() ? "light" : "dark";
    applyTheme();
  });
  const top = element("div", {class: "top"}, element("h1", {}, report.title), button);
  const links = contents().map(([id, name]) => element("a", {href: `#${id}`}, name));
  return element("header", {}, top, subtitle(), element("nav", {}, ...links));
}

// ---- page
setOrigin([
  `RailStrata ${report.program}: ${report.title}`,
  ...report.runs.map((r) => `${r.folder} (${engineName(r.engine)})`),
  "maps and sections are rounded to 1/65534 of their range; the folder's own tables hold every digit",
]);
const judgement = judged() ? [verdict(report)] : [];
const passes = report.passes ? passesParts(report.passes) : [];
// the pictures of a run that others or answers stand beside come with it; an answer stands before all pictures
const few = (report.runs.length < 3 || isOneResult(report.runs)) && !report.tables.length;
const beside = few && !report.answers?.length ? [glance, ...judgement] : [...judgement, ...(few ? [glance] : [])];
const first = [header(), ...beside];
const rest = few ? [] : [glance];
const main = element("main", {}, ...first, ...passes, ...studyParts(), chooser(), ...rest, stage, ...whatIfPart());
document.body.replaceChildren(main);
document.documentElement.dataset.theme = isDark() ? "dark" : "light";
showRuns();

let pending = 0;
window.addEventListener("resize", () => {
  clearTimeout(pending);
  pending = window.setTimeout(() => drawAll(theme()), 150);
});
wantsDark.addEventListener("change", () => applyTheme());
// On A4 with 12 mm margins two figures stand side by side.
window.addEventListener("beforeprint", () => {
  document.documentElement.dataset.theme = "light";
  for (const folded of document.querySelectorAll<HTMLDetailsElement>("#verdict details")) folded.open = true;
  paintFor("print");
  drawAll({...kLight, size: 9}, (wide) => (wide ? 690 : 338));
});
window.addEventListener("afterprint", () => {
  paintFor("screen");
  applyTheme();
});
document.documentElement.dataset.ready = "true";
