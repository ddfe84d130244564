// A transient of half-spaces: charts of its history and the film of its patch.
import {element, note} from "../dom";
import {frame, redraw, type Figure} from "../figures";
import {magnitudeScale, stateScale} from "../scale";
import {fixedText} from "../text";
import type {Theme} from "../theme";
import type {Span, Values} from "../types";
import {columnsOf, unpack, type Columns, type Film, type Run} from "./data";
import {historyFigure, type Along, type HistoryChart, type HistoryLine} from "./history";
import {linesFigure, type Series} from "./lines";
import {mapFigure, type MapSpec} from "./maps";
import {contactY, stateLegend} from "./patch";
import {hasHeights, placesOf} from "./way";
import {runLabel} from "./words";

const kDistance: Along = {
  column: "distance_mm",
  label: "rolled distance [mm]",
  hover: "after %{x:.2f} mm"
};
const kStep: Along = {
  column: "step",
  label: "increment",
  hover: "increment %{x}"
};

function line(column: string, name: string, scale: number, unit: string): HistoryLine {
  return {column, name, scale, hover: `${name} %{y:.4g} ${unit}`};
}

const forces: HistoryChart = {
  id: "transient-forces",
  title: "Forces on the wheel",
  label: "force [kN]",
  column: "force_kN",
  words: "F_z carries the load, F_x drives; the lateral force lies in the contact plane.",
  lines: [
    line("F_z_N", "F_z", 1e-3, "kN"),
    line("F_x_N", "F_x", 1e-3, "kN"),
    line("lateral_force_N", "lateral force", 1e-3, "kN"),
  ],
};
const creepages: HistoryChart = {
  id: "transient-creepage",
  title: "Creepage",
  label: "creepage [10⁻³]",
  column: "creepage_1e-3",
  words: "Over each step; negative along the rail while the wheel drives. The beginning at rest has none.",
  lines: [
    line("creepage", "longitudinal", 1e3, "× 10⁻³"),
    line("lateral_creepage", "lateral", 1e3, "× 10⁻³"),
  ],
};
const stresses: HistoryChart = {
  id: "transient-stress",
  title: "Largest pressure and shear",
  label: "[MPa]",
  column: "stress_MPa",
  words: "The shear is that at the front of slip.",
  lines: [
    line("p_max_MPa", "p_max", 1, "MPa"),
    line("q_max_MPa", "q_max", 1, "MPa"),
  ],
};
const areas: HistoryChart = {
  id: "transient-areas",
  title: "Contact, stick and slip",
  label: "area [mm²]",
  column: "area_mm2",
  words: "Areas of the cells in each state.",
  lines: [
    line("contact_area_mm2", "contact", 1, "mm²"),
    line("stick_area_mm2", "stick", 1, "mm²"),
    line("slip_area_mm2", "slip", 1, "mm²"),
  ],
};
const work: HistoryChart = {
  id: "transient-work",
  title: "Friction work",
  label: "work [J]",
  column: "work_J",
  words: "Since the start.",
  lines: [line("friction_work_J", "friction work", 1, "J")],
};

const largest = (values: Values) => Math.max(0, ...values.map((v) => Math.abs(v ?? 0)));

/// More than round-off of what it is compared with.
const changes = (values: Values, scale = 0) => largest(values) > 1e-6 * scale;

/// Force against displacement: what the wheel exerts on the rail, so that both have one sign.
function loop(runs: Run[], id: string, title: string, displacement: string, force: string): Figure[] {
  const moving = runs.filter((run) => changes(run.history![displacement]));
  if (!moving.length) return [];
  const series = moving.map((run, n): Series => ({
                              name: runLabel(run),
                              x: run.history![displacement],
                              y: run.history![force].map((v) => -1e-3 * v),
                              colour: (t) => t.series[n % t.series.length],
                              hover: "displacement %{x:.3f} µm\nforce %{y:.3f} kN",
                            }));
  return [linesFigure({
    id,
    title,
    labels: ["displacement of the wheel [µm]", "force on the rail [kN]"],
    names: ["displacement_um", "force_kN"],
    words: ["What the wheel exerts on the rail. The area of a closed loop is the friction work of a cycle."],
    series,
  })];
}

/// The load would be a flat line far above the forces of a shift.
const sideways: HistoryChart = {
  ...forces,
  words: "F_x in the rolling direction, the lateral force in the contact plane.",
  lines: forces.lines.filter((l) => l.column !== "F_z_N"),
};

/// A line of nothing but round-off says nothing.
function withoutZeros(runs: Run[], chart: HistoryChart): HistoryChart {
  const top = Math.max(...runs.flatMap((run) => chart.lines.map((l) => largest(run.history![l.column]))));
  const lines = chart.lines.filter((l) => runs.some((run) => changes(run.history![l.column], top)));
  return {...chart, lines: lines.length ? lines : chart.lines.slice(0, 1)};
}

const isTransient = (run: Run) => run.history !== null && run.history.step !== undefined;
const rolls = (history: Columns) => history.distance_mm !== undefined;

/// What happened on the way of a transient: of several runs those of the first one's kind.
export function transientFigures(runs: Run[]): Figure[] {
  const all = runs.filter(isTransient);
  if (!all.length) return [];
  const rolling = rolls(all[0].history!);
  const given = all.filter((run) => rolls(run.history!) === rolling);
  const along = rolling ? kDistance : kStep;
  const figure = (chart: HistoryChart) => historyFigure(given, along, withoutZeros(given, chart));
  if (rolling) return [forces, creepages, stresses, areas, work].map(figure);
  return [
    ...loop(given, "loop-x", "Force against displacement, rolling direction", "displacement_um", "F_x_N"),
    ...loop(given, "loop-y", "Force against displacement, lateral", "lateral_displacement_um", "lateral_force_N"),
    ...[sideways, stresses, areas, work].map(figure),
  ];
}

// ---- film

function span(at: number[]): Span {
  const room = at.length > 2 ? 1 + 0.5 * Math.abs(at[1] - at[0]) : 2;
  return [Math.min(...at) - room, Math.max(...at) + room];
}

function frameWords(run: Run, film: Film, k: number): string {
  const {step, distance_mm} = film.frames[k];
  if (run.engine === "fem") return `wheel at ${fixedText(distance_mm, 1)} mm`;
  return rolls(run.history!) ? `after ${fixedText(distance_mm, 2)} mm` : `increment ${step}`;
}

/// The frame next to the largest pressure of an uneven way; else the last.
function worstFrame(run: Run, film: Film): number {
  const last = film.frames.length - 1;
  if (!hasHeights(run)) return last;
  const pressure = run.history!.p_max_MPa.map((v) => v ?? 0);
  const place = placesOf(run)[pressure.indexOf(Math.max(...pressure))] ?? 0;
  const away = film.frames.map((f) => Math.abs(f.distance_mm - place));
  return away.indexOf(Math.min(...away));
}

/// Two maps that show one frame, and the slider that chooses it.
class Player {
  shown: number;
  private readonly traction: Values[][];
  private readonly states: Values[][];
  private readonly top: number;
  private readonly slider: HTMLInputElement;
  private readonly words = element("output", {id: "film-at"});
  private readonly button = element("button", {type: "button", id: "film-play"}, "play");
  private timer = 0;

  constructor(private readonly run: Run, private readonly film: Film) {
    const shape = (values: Values) => columnsOf(values, film.y.length);
    this.traction = film.frames.map((f) => shape(unpack(f.q)));
    this.states = film.frames.map((f) => shape([...f.state].map((c) => (c === "0" ? null : Number(c)))));
    this.top = Math.max(...film.frames.map((f) => f.q.high)) || 1;
    this.shown = worstFrame(run, film);
    const [max, value] = [String(film.frames.length - 1), String(this.shown)];
    const range = {type: "range", min: "0", max, value, id: "film-slider"};
    this.slider = element("input", {...range, "aria-label": "state of the film"});
    this.slider.addEventListener("input", () => this.show(Number(this.slider.value)));
    this.button.addEventListener("click", () => this.play());
    this.words.textContent = frameWords(run, film, this.shown);
  }

  control(): HTMLElement { return element("div", {class: "film"}, this.button, this.slider, this.words); }

  figures(): Figure[] {
    const traction = {scale: magnitudeScale(this.top), bar: "MPa"};
    const valueWords = ["separated", "stick", "slip"];
    return [
      this.figure("film-q", "Traction |q| on the way", "q_MPa", "|q| %{z:.1f} MPa", () => this.traction, traction),
      this.figure(
          "film-state", "Stick and slip on the way", "state_1stick_2slip", "%{text}", () => this.states,
          {scale: stateScale, valueWords, words: [stateLegend(this.states.flat())]}),
    ];
  }

  private figure(
      id: string, title: string, column: string, hover: string, values: () => Values[][],
      look: Pick<MapSpec, "scale"|"bar"|"valueWords"|"words">): Figure {
    const whole = this.film.x;
    const y = this.film.y.map((v) => v - contactY(this.run));
    const now = () => mapFigure({
      id,
      title,
      z: values()[this.shown],
      centresX: this.film.frames[this.shown].x ?? whole,
      centresY: y,
      names: ["x_mm", "y_mm", column],
      labels: ["x, rolling direction [mm]", "y, field side up [mm]"],
      hover,
      hoverY: "y",
      ...look,
      windowX: span(whole),
      windowY: span(y),
      marker: {x: 0, y: 0, text: "place of the patch"},
    });
    return {...now(), chart: (theme: Theme, width: number) => now().chart(theme, width), table: () => now().table()};
  }

  private show(k: number): void {
    this.shown = k;
    this.slider.value = String(k);
    this.words.textContent = frameWords(this.run, this.film, k);
    redraw("film-q");
    redraw("film-state");
  }

  private play(): void {
    if (this.timer) return this.pause();
    if (this.shown === this.film.frames.length - 1) this.show(0);
    this.button.textContent = "pause";
    this.timer = window.setInterval(() => {
      if (!this.slider.isConnected || this.shown === this.film.frames.length - 1) return this.pause();
      this.show(this.shown + 1);
    }, 250);
  }

  private pause(): void {
    clearInterval(this.timer);
    this.timer = 0;
    this.button.textContent = "play";
  }
}

/// The patch on its way, of the first run that has it.
export function filmParts(runs: Run[]): HTMLElement[] {
  const run = runs.find((r) => r.film && r.film.frames.length && r.history);
  if (!run || !run.film) return [];
  const player = new Player(run, run.film);
  const whose = runs.length > 1 ? `Of ${runLabel(run)}. ` : "";
  const about =
      note(`${whose}Below the slider the patch in the state that it names; patch.pvd has the same for ParaView.`);
  return [about, player.control(), element("div", {class: "grid"}, ...player.figures().map(frame))];
}
