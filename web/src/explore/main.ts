// The explorer: sliders at the side, the contact that follows them.
import {copy, download, element, embedded} from "../dom";
import {csvText, frame, type Figure} from "../figures";
import {controls} from "./controls";
import {Engine} from "./engine";
import {centreFigure, depthFigure, measureChoice, patchFigures, sectionFigure, show, type Shown} from "./figures";
import {lasting, numbersCsv, setWords, table, tiles} from "./numbers";
import {profiles, type Kind} from "./profiles";
import {reportedAnswer} from "./reported";
import {kAsked, State, written} from "./state";
import type {Answer, Fault, Request, Seed, Want} from "./types";

const kCoarse = 0.5e-3;  // m, cells while a slider moves
const kRest = 150;       // ms without a change before finer cells

const seed = JSON.parse(embedded("data")) as Seed;
// m, at rest: those of the command line or of the report among them
const kCells = [...new Set([0.5e-3, 0.25e-3, 0.125e-3, seed.cell])].sort((a, b) => b - a);
setWords(seed.words);
const state = new State(seed);
let cell = seed.cell;
const reported = reportedAnswer(seed);
let shown: Shown|null = null;
let settled: Answer|null = null;  // the last state in full, ghost of the next
let moving = false;
let timer = 0;
let frameAsked = false;
let begun = false;

const root = document.documentElement;
const status = element("p", {id: "status", role: "status"}, "starting the engine …");
const faultBox = element("div", {id: "faults", role: "alert"});
const tileBox = element("div", {class: "tiles"});
const numberBox = element("div", {class: "scroll"});
const lastBox = element("div", {id: "lasting"});
const noteBox = element("div", {});

const choice = measureChoice(() => draw());
const patches = patchFigures();
const lines = [centreFigure(), depthFigure(choice)];
const sections = [sectionFigure(choice, "section"), sectionFigure(choice, "cross")];

const engine = new Engine(seed, {answer: take, faults: showFaults, broken});

/// For tests and for whoever asks the page from outside: what is shown now.
function mark(what: string, a?: Answer): void {
  root.dataset["state"] = what;
  root.dataset["memory"] = String(engine.memory);
  root.dataset["answers"] = String(engine.answers);
  if (!a) return;
  root.dataset["pMax"] = String(a.head.summary.contact["p_max_Pa"]);
  root.dataset["cell"] = String(a.request.cell);
  root.dataset["milliseconds"] = String(a.head.milliseconds);
  root.dataset["command"] = state.command(cell);
  if (what === "settled") root.dataset["summary"] = JSON.stringify(a.head.summary);
}

function request(size: number, want: Want[]): Request {
  return {case: seed.case, file: "case.toml", set: state.forEngine(), cell: size, values: kAsked, want};
}

/// What comes after the contact itself, one after the other while nothing moves: each waits for the one before, so that
/// a slider has to wait for one at most.
const kStages: Want[][] = [
  ["patch"], ["patch", "section"], ["patch", "section", "stress", "case"],
  ["patch", "section", "stress", "case", "shakedown"]
];
/// The stage after that of an answer; null: it was the last one.
function nextStage(a: Answer): Want[]|null {
  const last = a.head.strengths ? 3 : 2;
  const at = kStages.findIndex((s) => s.length === a.request.want.length);
  return at < last ? kStages[at + 1]! : null;
}

function changed(): void {
  if (!moving && shown) shown.before = settled;
  moving = true;
  root.dataset["state"] = "moving";
  window.clearTimeout(timer);
  engine.ask(request(Math.max(kCoarse, cell), ["patch"]));
  if (cell < kCoarse) timer = window.setTimeout(() => engine.ask(request(cell, ["patch"])), kRest);
  link();
}

/// The address holds the state; a page from a file may have none to write to.
function link(): void {
  try {
    history.replaceState(null, "", `#${state.fragment()}`);
  } catch {
    // shown by "Copy link" all the same
  }
}

const sameState = (a: Answer) => JSON.stringify(a.request.set) === JSON.stringify(state.forEngine());

/// The state of the sliders has no answer: what is shown is of the one before, and there is no command that computes
/// it.
function refuse(refused: boolean): void {
  root.classList.toggle("refused", refused);
  commandButton.disabled = refused;
}

function take(a: Answer): void {
  if (!begun) return begin(a);
  root.classList.remove("waiting");
  refuse(false);
  faultBox.replaceChildren();
  state.take(a.head);
  side.refresh();
  const last = shown?.now;
  // stresses of before stay until those of now are there
  if (!a.head.section && last?.head.section) keepStresses(a, last);
  shown = {now: a, before: shown?.before ?? null, pinned: shown ? shown.pinned : reported};
  const fine = a.request.cell === cell && sameState(a);
  const next = fine ? nextStage(a) : null;
  const full = fine && !next;
  root.classList.toggle("coarse", !a.request.want.includes("section"));
  if (next && !engine.busy) engine.ask(request(cell, next));
  if (full) {
    moving = false;
    settled = a;
  }
  mark(full ? "settled" : "moving", a);
  tell(a, full);
  askFrame();
}

/// Stresses take longer: until they are there those of the last state stay, dimmed.
function keepStresses(a: Answer, last: Answer): void {
  const offset = a.numbers.length;
  const moved = <T extends object>(head: T): T =>
      Object.fromEntries(Object.entries(head).map(
          ([k,
            v]) => [k, typeof v === "object" && v !== null && "first" in v ? {...v, first: v.first + offset} : v])) as
      T;
  const {section, cross} = last.head;
  if (!section || !cross) return;
  const old = last.numbers;
  const joined = new Float32Array(offset + old.length);
  joined.set(a.numbers);
  joined.set(old, offset);
  a.numbers = joined;
  a.head.section = moved(section);
  a.head.cross = moved(cross);
}

function tell(a: Answer, full: boolean): void {
  const time = `${a.head.milliseconds.toFixed(0)} ms`;
  const size = `${written(1e3 * a.request.cell)} mm`;
  status.textContent = full ? `cells of ${size}, stresses included` : `cells of ${size}: ${time}`;
  if (a.request.want.length === 1) root.dataset["contactMilliseconds"] = String(a.head.milliseconds);
}

/// The case as it is given: sliders begin there.
function begin(a: Answer): void {
  begun = true;
  state.learn(a.head);
  state.takeFragment(location.hash);
  side.refresh();
  root.dataset["ready"] = "true";
  engine.ask(request(cell, ["patch"]));
}

function askFrame(): void {
  if (frameAsked) return;
  frameAsked = true;
  requestAnimationFrame(() => {
    frameAsked = false;
    draw();
  });
}

function draw(): void {
  show(shown);
  if (!shown) return;
  const {now, pinned} = shown;
  tileBox.replaceChildren(...tiles(now, pinned, settled));
  if (now.request.want.includes("stress")) drawInFull(now, pinned);
}

function drawInFull(now: Answer, pinned: Answer|null): void {
  numberBox.replaceChildren(table(now, pinned));
  const found = lasting(now);
  const hint = element(
      "p", {class: "note"}, "With yield strengths (below “Strength”, or in the case) the page shows ",
      "whether rail and layers shake down, and with what reserve.");
  lastBox.replaceChildren(found ?? hint);
  const words = [...now.head.doubts, ...now.head.notes];
  noteBox.replaceChildren(...words.map((w) => element("p", {class: "note"}, w)));
}

function showFaults(faults: Fault[]): void {
  mark("refused");
  const text = (f: Fault) => element(
      "p", {}, element("b", {}, f.message), f.where ? element("small", {}, ` (${f.where})`) : null,
      f.remedy ? element("span", {class: "remedy"}, `What to do: ${f.remedy}`) : null);
  faultBox.replaceChildren(...faults.map(text));
  status.textContent =
      shown ? "no answer for this state; the dimmed figures show the last one" : "no answer for this case";
  root.classList.remove("waiting");
  refuse(true);
}

function broken(message: string): void {
  mark("broken");
  root.classList.remove("waiting");
  faultBox.replaceChildren(element(
      "p", {}, element("b", {}, `The engine has stopped: ${message}`),
      element(
          "span", {class: "remedy"},
          "What to do: move a slider back, or take larger cells; an old browser may lack " +
              "WebAssembly with exceptions (Chrome 95, Firefox 100, Safari 15.2)")));
}

function takeProfile(kind: Kind, name: string, text: string): void {
  const file = `${kind}/${name}`;
  engine.put(file, text);
  state.profiles.set(`geometry.${kind}_profile`, file);
  profileBox.name(kind, name);
  changed();
}

const profileBox = profiles(takeProfile, (words) => faultBox.replaceChildren(element("p", {}, words)));
const side = controls(state, changed);

function button(words: string, what: string, act: () => void): HTMLButtonElement {
  const b =
      element("button", {type: "button", title: what, id: `b-${words.toLowerCase().replace(/\W+/g, "-")}`}, words);
  b.onclick = act;
  return b;
}

const say = (words: string) => {
  status.textContent = words;
};

const commandButton = button(
    "Command", "copy the command line that computes this state",
    () => void copy(state.command(cell), say, "Command line"));

function pin(): void {
  if (!shown || !settled) return;
  shown.pinned = settled;
  draw();
  say("pinned: changes are shown against this state");
}

function unpin(): void {
  if (shown) shown.pinned = reported;
  draw();
}

function reset(): void {
  state.reset();
  state.profiles.clear();
  profileBox.name("rail", "of the case");
  profileBox.name("wheel", "of the case");
  side.refresh();
  changed();
}

/// The case with what the sliders say, every option written out.
function caseFile(): void {
  if (settled?.head.case && sameState(settled))
    copyCase(settled.head.case);
  else
    say("not computed to the end yet: press it again in a moment");
}

function copyCase(text: string): void {
  const clean = text.split(`${seed.folder}/`).join("");
  download(`${seed.name || "case"}-explored.toml`, new Blob([clean], {type: "text/plain;charset=utf-8"}));
  void copy(clean, say, "Case file");
}

function csv(): void {
  if (!shown) return;
  const numbers = numbersCsv(shown.now);
  const parts = [
    csvText(numbers, ["numbers"]),
    ...[patches[0], ...lines, ...sections].map((f) => csvText(f.table(), [f.id === "pressure" ? "patch" : f.id]))
  ];
  const head = `# RailStrata ${seed.version}: ${state.command(shown.now.request.cell)}\n`;
  download(`${seed.name || "case"}-explored.csv`, head + parts.join("\n"));
}

function address(): void {
  const lost = state.profiles.size ? " (without the profiles that were dropped)" : "";
  void copy(`${location.href.split("#")[0]}#${state.fragment()}`, say, `Link${lost}`);
}

function cellChoice(): HTMLElement {
  const options = kCells.map((c) => element("option", {value: String(c)}, `${written(1e3 * c)} mm`));
  const select = element("select", {id: "cell", "aria-label": "cells"}, ...options);
  select.value = String(cell);
  select.onchange = () => {
    cell = Number(select.value);
    changed();
  };
  return element("label", {class: "cell"}, "Cells at rest ", select);
}

function build(): void {
  const title = element(
      "div", {}, element("h1", {}, "What if?"),
      element("p", {class: "sub"}, `RailStrata: wheel on rail, beginning with the case “${seed.name}”`));
  const buttons = element(
      "div", {class: "buttons"}, button("Pin", "compare what follows with this state", pin),
      button("Unpin", reported ? "compare with the report again" : "compare with nothing", unpin),
      button("Reset", "the case as it was given", reset),
      button("Case file", "copy and save the case with every option", caseFile), commandButton,
      button("CSV", "numbers, patch, lines and sections", csv),
      reported ? null : button("Link", "copy a link to this state", address));
  const grid = (kind: string, all: Figure[]) => element("div", {class: `grid ${kind}`}, ...all.map(frame));
  const aside = element("aside", {}, cellChoice(), side.node, profileBox.node);
  const head = element("div", {class: "first"}, tileBox, faultBox);
  const results = element(
      "div", {class: "results"}, grid("three", patches), grid("two", lines), grid("two", sections),
      element("h2", {}, "Does it last?"), lastBox, element("h2", {}, "Numbers"), numberBox, noteBox);
  const about = element(
      "p", {class: "note"}, `RailStrata ${seed.version}: the program's half-space engine runs in this page, `,
      "nothing is sent anywhere. ", ...engineWords());
  document.body.append(element(
      "main", {}, element("header", {}, title, buttons, status), element("div", {class: "both"}, aside, head, results),
      element("footer", {}, about, licences())));
}

/// Whose numbers these are: the engine is compiled at a release, the page is written by any program since.
function engineWords(): (string|HTMLElement)[] {
  const command = element("code", {}, "railstrata bem");
  if (seed.engine === seed.version) return ["The numbers are those of ", command, "."];
  const release = (text: string) => text.split(" ")[0];
  const here = element("span", {id: "engine-version"}, seed.engine);
  if (release(seed.engine) === release(seed.version))
    return ["The engine was compiled from ", here, ": the numbers are those of ", command, " at that commit."];
  return [
    "The engine is older than the program: it was compiled from ", here, ", and its numbers are those of ", command,
    " of that version."
  ];
}

function licences(): HTMLElement {
  return element("details", {}, element("summary", {}, "Software inside"), element("pre", {}, embedded("licences")));
}

root.classList.add("waiting");
build();
addEventListener("resize", askFrame);
addEventListener("hashchange", () => {
  state.takeFragment(location.hash);
  side.refresh();
  changed();
});
engine.ask({...request(kCoarse, ["case"]), set: [...seed.placed, ...seed.overrides]});
