// The page of `railstrata report`: reads the data the program has put in, builds the parts, draws the figures.
import type {Chart, Maps, Report, Run} from "./data";
import {element, part, table} from "./dom";
import {drawAll, forget, frame, kDark, kLight, setOrigin, type Figure, type Theme} from "./figures";
import {linesFigure} from "./lines";
import {centreLines, patchMaps} from "./patch";
import {geometryFigures, geometryTable, historyFigures, numbersTable, origin, tiles, verdict} from "./sections";
import {depthLines, maximaTable, sectionMaps} from "./stress";
import {engineName, numberText, plotText, runLabel, setWords} from "./text";

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

/// One row of maps; ids and titles are the row's, whatever the runs are called.
function mapsRow(m: Maps): HTMLElement[] {
  const runs = m.runs.map((k) => report.runs[k]);
  const figures = m.kind === "state"
      ? patchMaps(runs).filter((f) => f.id.startsWith("map-state-"))
      : sectionMaps(runs, "rail").filter((f) => f.id.startsWith(`section-rail-longitudinal-${m.kind}-`));
  return [
    element("h3", {class: "row"}, m.title),
    ...(m.note ? [element("p", {class: "note"}, m.note)] : []),
    grid(figures.map((f, n) => ({...f, id: `${m.id}-${n + 1}`, title: m.names[n]}))),
  ];
}

function studyParts(): HTMLElement[] {
  const out: HTMLElement[] = [];
  if (report.tables.length)
    out.push(part(
        "tables", "Answers",
        ...report.tables.flatMap(
            (t) =>
                [table(
                     t.title, t.columns,
                     t.rows.map((row) => row.map((v) => (typeof v === "number" ? numberText(v) : v ?? "–"))),
                     {class: "numbers study", id: `table-${t.id}`}),
                 t.note ? element("p", {class: "note"}, t.note) : element("span"),
    ])));
  if (report.charts.length)
    out.push(
        part(
            "charts", "Figures",
            grid(report.charts.map(
                (c) => linesFigure({
                  id: c.id,
                  title: c.title,
                  words: c.note ? [c.note] : undefined,
                  labels: [c.x, c.y],
                  names: [c.x, c.y],
                  window: touched(c),
                  series:
                      c.series.map((s, n) => ({
                                     name: s.name,
                                     x: s.x,
                                     y: s.y,
                                     markers: s.markers && s.x.length < 60,
                                     dash: s.dash,
                                     colour: (t: Theme) => t.series[(s.colour < 0 ? n : s.colour) % t.series.length],
                                     hover: `${plotText(c.x)} %{x:.4g}<br>${plotText(c.y)} %{y:.4g}`
                                   }))
                })))),
    );
  if (report.maps.length) out.push(part("maps", "Maps", ...report.maps.flatMap(mapsRow)));
  return out;
}

/// Of a line through the patch only where it touches, with a little room; everything of a trend.
function touched(c: Chart): [number, number]|undefined {
  if (!c.x.startsWith("x, rolling")) return undefined;
  const x = c.series.flatMap((s) => s.x.filter((_, i) => s.y[i] > 0));
  return x.length ? [Math.min(...x) - 2, Math.max(...x) + 2] : undefined;
}

/// Everything about the runs that are looked at: one, or two side by side.
function runParts(runs: Run[]): HTMLElement[] {
  const body = (name: "rail"|"wheel") => {
    const figures = sectionMaps(runs, name);
    return figures.length
        ? grid(figures)
        : element(
              "p", {class: "note"}, `No sections of the ${name} in this folder; write the results anew to have them.`);
  };
  const wheel =
      element("details", {id: "wheel"}, element("summary", {}, "The wheel"), maximaTable(runs, "wheel"), body("wheel"));
  wheel.addEventListener("toggle", () => drawAll(theme()));
  const history = historyFigures(runs);
  const axes =
      "x counts from the axle in the rolling direction, y from the rigid contact point to the field side, depth from the surface along its normal.";
  return [
    part("numbers", "Numbers", numbersTable(runs)),
    part(
        "geometry", "Geometry and placement", grid(geometryFigures(runs[0])),
        geometryTable(runs[0]) ??
            element("p", {class: "note"}, "No geometry in this folder; write the results anew to have it.")),
    part(
        "patch", "The patch", element("p", {class: "note"}, `${axes} The cross marks the rigid contact point.`),
        grid(patchMaps(runs)), grid(centreLines(runs))),
    part(
        "stress", "Below the surface", maximaTable(runs, "rail"),
        element("p", {class: "note"}, `Places: ${axes} Finite element sections show each element’s own value.`),
        body("rail"), grid(depthLines(runs)), wheel),
    ...(history.length ? [part("history", "On the way", grid(history))] : []),
    part("origin", "Origin", ...origin(runs)),
  ];
}

let looked: Run[] = report.runs.slice(0, 2);
const stage = element("div", {id: "stage"});
function showRuns(): void {
  forget(stage);
  stage.replaceChildren(tiles(looked[0], report.runs.length > 1), ...runParts(looked));
  drawAll(theme());
}

/// Which two of many runs are looked at.
function chooser(): HTMLElement|null {
  if (report.runs.length < 3) return null;
  const select = (n: number) => {
    const s = element(
        "select", {"aria-label": n === 0 ? "Run" : "beside it"},
        ...(n === 0 ? [] : [element("option", {value: ""}, "nothing beside")]),
        ...report.runs.map((r, k) => element("option", {value: String(k)}, runLabel(r))));
    s.value = looked[n] ? String(report.runs.indexOf(looked[n])) : "";
    s.addEventListener("change", () => {
      const picked = [first, second].map((x) => x.value).filter((v) => v !== "").map((v) => report.runs[Number(v)]);
      looked = picked.filter((r, k) => picked.indexOf(r) === k);
      showRuns();
    });
    return s;
  };
  const first = select(0), second = select(1);
  return element("div", {class: "chooser"}, "Run ", first, " beside ", second);
}

function header(): HTMLElement {
  const button = element("button", {type: "button", id: "theme"}, "light / dark");
  button.addEventListener("click", () => {
    chosen = isDark() ? "light" : "dark";
    applyTheme();
  });
  const run = report.runs[0];
  const where = report.runs.length < 3 && run.engine === "fem" && run.summary.position_m !== null
      ? `, wheel at ${numberText(1e3 * run.summary.position_m)} mm`
      : "";
  const links = [
    ["verdict", "verdict"], ...(report.tables.length ? [["tables", "answers"]] : []),
    ...(report.charts.length ? [["charts", "figures"]] : []), ...(report.maps.length ? [["maps", "maps"]] : []),
    ["numbers", "numbers"], ["geometry", "geometry"], ["patch", "patch"], ["stress", "stress"],
    ...(report.runs.some((r) => r.history) ? [["history", "history"]] : []), ["origin", "origin"]
  ];
  return element(
      "header",
      {},
      element("div", {class: "top"}, element("h1", {}, report.title), button),
      element(
          "p", {class: "sub"},
          report.runs.length > 2 ? `${report.runs.length} runs`
                                 : report.runs.map((r) => `${r.name}: ${engineName(r.engine)}`).join(" · "),
          `${where} · RailStrata ${report.program}`),
      element("nav", {}, ...links.map(([id, name]) => element("a", {href: `#${id}`}, name))),
  );
}

// ---- page
setOrigin([
  `RailStrata ${report.program}: ${report.title}`, ...report.runs.map((r) => `${r.folder} (${engineName(r.engine)})`),
  "maps and sections are rounded to 1/65534 of their range; the folder's own tables hold every digit"
]);
const licences = document.getElementById("licences") as HTMLTemplateElement | null;
const footer = element(
    "footer", {},
    element(
        "details", {}, element("summary", {}, "Software in this page"),
        ...(licences ? [licences.content.cloneNode(true)] : [])));
document.body.replaceChildren(element(
    "main", {}, header(), verdict(report), ...studyParts(), ...[chooser()].filter((e) => e !== null), stage, footer));
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
  drawAll({...kLight, size: 9}, (wide) => (wide ? 690 : 338));
});
window.addEventListener("afterprint", () => applyTheme());
document.documentElement.dataset.ready = "true";
