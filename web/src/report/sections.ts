// Verdict, numbers and origin: the parts of the page around the patch and its stresses.
import {details, element, note, table, tableHead, type Cell} from "../dom";
import {barText, countText, numberText, percentText} from "../text";
import type {BodyName, Quantity, Values} from "../types";
import {numberAt, option, type Answer, type Check, type CheckWords, type Report, type Run} from "./data";
import {
  checkWords,
  engineName,
  limitText,
  quantityAt,
  isOneResult,
  runLabel,
  shownBesideLimit,
  shownQuantities,
  unitText,
  withoutRoundOff,
  zones
} from "./words";

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
      element("td", {class: "value"}, unitText(shownBesideLimit(check.value, check.limit), words.unit, 3)),
      element("td", {class: "limit"}, limitWords(check, words)),
      element("td", {}, [words.what, whose(report, check), check.note].filter(Boolean).join("; ")),
  );
}

function checksTable(report: Report, checks: Check[]): HTMLElement {
  const head = tableHead(["", "check", "value", "limit", "what it says"]);
  const body = element("tbody", {}, ...checks.map((c) => checkRow(report, c)));
  return element("div", {class: "scroll"}, element("table", {class: "checks"}, head, body));
}

const kToneMarks: Record<string, string> = {
  good: "✓ ",
  open: "! ",
  bad: "✗ "
};

/// Answers, the worst first: their tone is the banner's. Where none judges the first is the heading.
function answerLines(answers: Answer[]): HTMLElement[] {
  const judges = answers.some((a) => a.tone !== "plain");
  return answers.map((a, k) => {
    const tag = a.tone === "plain" && (judges || k > 0) ? "p" : "h2";
    return element(
        tag, {class: a.tone, "data-tone": a.tone},
        `${kToneMarks[a.tone] ?? ""}${[a.title, a.text].filter((s) => s).join(": ")}.`);
  });
}

function toneOf(answers: Answer[], ok: boolean): string {
  const tones = answers.map((a) => a.tone);
  if (!tones.some((t) => t !== "plain")) return ok ? "good" : "bad";
  return (["bad", "open"] as const).find((t) => tones.includes(t)) ?? "good";
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

/// Notes beside the verdict, each once with its largest value.
function mind(notes: Check[]): HTMLElement|null {
  if (!notes.length) return null;
  const worst = new Map<string, Check>();
  for (const c of notes)
    if (!worst.has(c.name) || (c.value ?? 0) > (worst.get(c.name)!.value ?? 0)) worst.set(c.name, c);
  const text = (c: Check) => {
    const {name, unit} = checkWords(c.name);
    return c.value === null ? name : `${name} (${unitText(c.value, unit, 3)})`;
  };
  return element("p", {class: "minded"}, `Notes: ${[...worst.values()].map(text).join("; ")}.`);
}

/// The answers, in green, amber or red, the checks below them in a line; without an answer the checks alone. What
/// failed stands open, the checks that hold and the notes on demand.
export function verdict(report: Report): HTMLElement {
  const judged = report.checks.filter((c) => c.judged);
  const failed = judged.filter((c) => !c.ok);
  const holds = judged.filter((c) => c.ok);
  const notes = report.checks.filter((c) => !c.judged);
  const ok = judged.length > 0 && failed.length === 0;
  const answers = answerLines(report.answers ?? []);
  const banner = answers.length > 0;
  const line = verdictLine(judged, failed);
  const checks = banner ? element("p", {class: failed.length ? "failed" : "held"}, `Numerical checks: ${line}`)
                        : element("h2", {}, ok ? "✓ " : "✗ ", line);
  const heading = answers.length && !report.checks.length && !report.runs.length ? null : checks;
  const judges = (report.answers ?? []).some((a) => a.tone !== "plain");
  const tone = judges || heading ? toneOf(report.answers ?? [], ok) : "plain";
  const attributes = {id: "verdict", class: tone, "data-ok": String(ok), "data-tone": tone};
  const count = (n: number, one: string, more: string) => (n ? [`${n} ${n === 1 ? one : more}`] : []);
  const folded = [
    ...count(holds.length, "check that holds", "checks that hold"),
    ...count(notes.length, "note", "notes"),
  ];
  const rest = folded.length ? details(folded.join(", "), checksTable(report, [...holds, ...notes])) : null;
  const open = failed.length ? checksTable(report, failed) : null;
  return element("section", attributes, ...answers, heading, warning(failed), open, mind(notes), rest);
}

interface Inside {
  value_Pa: number;
  error_Pa?: number|null;
  depth_m: number;
  zone: string;
}

/// The body whose stresses stand first: the wheel where only it has layers.
export function layeredBody(run: Run): BodyName {
  const layers = run.geometry?.layers ?? [];
  return layers.some((l) => l.on === "wheel") && !layers.some((l) => l.on === "rail") ? "wheel" : "rail";
}

function largestBelowSurface(run: Run, body: BodyName): Inside|null {
  let best: Inside|null = null;
  for (const {key: zone, name} of zones()) {
    const m = zone === "surface" ? null : run.summary.stress[body]?.[zone]?.von_mises_max;
    if (m && (!best || m.value_Pa > best.value_Pa)) best = {...m, depth_m: m.depth_m ?? 0, zone: name};
  }
  return best && best.zone === "below the surface" ? {...best, zone: "largest"} : best;
}

/// A number of a run for people: 0 where it is round-off.
function shownAt(run: Run, path: string): number|null {
  return withoutRoundOff(path, numberAt(run, path), (other) => numberAt(run, other));
}

/// A number as its quantity's unit shows it.
function digits(run: Run, path: string, most: number): string {
  const value = shownAt(run, path);
  return numberText(value === null ? null : quantityAt(path).unit.factor * value, most);
}

/// The error bar of a number, in its quantity's unit.
function barOf(q: Quantity, run: Run): string {
  const error = q.error_bar ? numberAt(run, q.error_bar) : null;
  return barText(error === null ? null : q.unit.factor * error);
}

/// One number large, and small what is to be said of it.
function tile(name: string, text: string, unit: string, small: string[]): HTMLElement {
  return element(
      "div",
      {class: "tile"},
      element("span", {class: "name"}, name),
      element("span", {class: "big"}, text, unit ? element("small", {}, ` ${unit}`) : null),
      ...small.filter((words) => words !== "").map((words) => element("span", {class: "small"}, words)),
  );
}

/// Differences of a run from the first.
function besideName(run: Run, runs: Run[]): string {
  return run.name === runs[0].name && run.engine !== runs[0].engine ? engineName(run.engine) : runLabel(run);
}

/// A number of the first run, that of a second below it.
function cardOf(
    runs: Run[], name: string, unit: string, text: (run: Run) => string,
    about: (run: Run) => string = () => ""): HTMLElement {
  const besides = runs.slice(1).map((run) => {
    const words = about(run);
    return `${besideName(run, runs)}: ${text(run)}${unit ? ` ${unit}` : ""}${
        words && words !== about(runs[0]) ? `, ${words}` : ""}`;
  });
  return tile(name, text(runs[0]), unit, [about(runs[0]), ...besides]);
}

function numberTile(runs: Run[], path: string, most = 4): HTMLElement {
  const q = quantityAt(path);
  const about = (run: Run) => barOf(q, run) && `${barOf(q, run)} ${q.unit.shown}`.trim();
  return cardOf(runs, q.name, q.unit.shown, (run) => digits(run, path, most), about);
}

function patchTile(runs: Run[]): HTMLElement {
  const [length, width] = ["contact/patch_length_m", "contact/patch_width_m"];
  const text = (run: Run) => `${digits(run, length, 3)} × ${digits(run, width, 3)}`;
  return cardOf(runs, "Patch", quantityAt(length).unit.shown, text, () => "length along x × width");
}

function tractionTile(runs: Run[]): HTMLElement {
  const text = (run: Run) => {
    const fx = shownAt(run, "contact/F_x_N");
    const fz = numberAt(run, "contact/F_z_N");
    return numberText(fx !== null && fz ? fx / fz : null);
  };
  const wanted = (run: Run) => run.summary.state ?? `wanted ${option(run, "drive", "traction_coefficient") ?? "–"}`;
  return cardOf(runs, "Traction F_x / F_z", "", text, wanted);
}

/// Of the body that has layers: the rail, unless only the wheel has one.
function insideTile(runs: Run[]): HTMLElement {
  const body = layeredBody(runs[0]);
  const text = (run: Run) => numberText(1e-6 * (largestBelowSurface(run, body)?.value_Pa ?? NaN));
  const about = (run: Run) => {
    const inside = largestBelowSurface(run, body);
    if (!inside) return "";
    const bar = barText(1e-6 * (inside.error_Pa ?? NaN));
    return `${bar && `${bar} MPa, `}${inside.zone}, ${(1e3 * inside.depth_m).toFixed(2)} mm deep`.trim();
  };
  const name = `${body === "rail" ? "Rail" : "Wheel"}, von Mises below the surface`;
  return cardOf(runs, name, "MPa", text, about);
}

/// The numbers of the first run large, those of a second below them; `named`: with whose they are.
export function tiles(runs: Run[], named: boolean): HTMLElement {
  const beside = runs.length > 1 ? `, small: ${besideName(runs[1], runs)}` : "";
  const name = `Numbers of ${runLabel(runs[0])}${beside}.`;
  const cards = element(
      "div",
      {class: "tiles"},
      numberTile(runs, "contact/p_max_Pa"),
      numberTile(runs, "contact/q_max_Pa"),
      patchTile(runs),
      numberTile(runs, "contact/slip_area_fraction", 3),
      tractionTile(runs),
      insideTile(runs),
  );
  const patches = patchesNote(runs);
  const about = patches ? element("p", {class: "note", id: "tiles-patches"}, patches) : null;
  return element("div", {}, named ? element("p", {class: "note", id: "tiles-of"}, name) : null, about, cards);
}

function numberCell(q: Quantity, run: Run): Cell {
  const value = shownAt(run, q.path);
  const text = numberText(value === null ? null : q.unit.factor * value, q.digits);
  return {text: text + barOf(q, run), attributes: {"data-path": q.path, "data-value": String(numberAt(run, q.path))}};
}

/// None where the second is zero or round-off.
function differenceText(q: Quantity, [a, b]: Values): string {
  return q.comparable && a !== null && b ? percentText((a - b) / Math.abs(b)) : "–";
}

/// What the numbers of a wheel that touches at several places are of.
function patchesNote(runs: Run[]): string|null {
  const several = runs.filter((run) => (run.summary.patches?.length ?? 0) > 1);
  if (!several.length) return null;
  const whose = runs.length > 1 ? `Of ${several.map(runLabel).join(" and ")}: ` : "";
  const text =
      "the wheel touches at several places. The numbers are those of patch 1, which has the largest pressure, " +
      "the stresses those below it; F_x, F_y and F_z are of all patches.";
  return whose ? whose + text : text[0].toUpperCase() + text.slice(1);
}

export function numbersTable(runs: Run[]): HTMLElement[] {
  const differs = runs.length === 2 || isOneResult(runs);
  const rows: (string|Cell)[][] = [];
  for (const q of shownQuantities()) {
    const values = runs.map((run) => numberAt(run, q.path));
    if (values.every((v) => v === null)) continue;
    const difference = (run: Run) => differs ? [differenceText(q, [runs[0], run].map((r) => shownAt(r, q.path)))] : [];
    const others = runs.slice(1).flatMap((run) => [numberCell(q, run), ...difference(run)]);
    rows.push([q.name, q.unit.shown, numberCell(q, runs[0]), ...others]);
  }
  const others = runs.slice(1).flatMap((run) => [runLabel(run), ...(differs ? ["difference"] : [])]);
  const head = ["quantity", "unit", runLabel(runs[0]), ...others];
  const barred = shownQuantities().some((q) => runs.some((run) => barOf(q, run)));
  const bars = barred
      ? "±: of half-spaces what the size of their cells leaves uncertain, of finite elements the change from one " +
          "measuring window to the next."
      : null;
  const notes = [runs.length > 1 ? patchesNote(runs) : null, bars].flatMap((text) => (text ? [note(text)] : []));
  return [...notes, table("Contact", head, rows, {class: "numbers", id: "contact-numbers"})];
}

// ---- origin

function provenanceText(value: unknown): string {
  if (value === undefined || value === null) return "–";
  return Array.isArray(value) ? value.join(" ") : String(value);
}

/// Cells, or elements and steps.
function sizeText(run: Run): string {
  const elements = countText(numberAt(run, "run/elements"));
  if (run.engine !== "fem") return `${elements} cells`;
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
