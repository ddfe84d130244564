// Words: what checks and quantities are called.
import {minus, numberText} from "../text";
import type {Quantity, Unit} from "../types";
import type {CheckWords, Run, VerdictWords, Words} from "./data";

export function engineName(engine: string): string {
  if (engine === "fem") return "finite elements";
  return engine === "bem" ? "half-space" : engine;
}

/// Runs of one name: a result with its references on other engines.
export function isOneResult(runs: Run[]): boolean {
  return runs.length > 0 && runs.every((run) => run.name === runs[0].name);
}

export function runLabel(run: Run): string { return `${run.name} (${engineName(run.engine)})`; }

// The program's tables of results give names and units; set once, before anything is built.
let words: Words = {numbers: [], zones: [], measures: [], checks: [], verdicts: []};
const kPlain: Unit = {
  si: "",
  shown: "",
  factor: 1
};

export function setWords(given: Words): void { words = given; }

/// The words of a check; its key where the program does not know it (a result of another version).
export function checkWords(key: string): CheckWords {
  const unknown = {key, name: key.replace(/_/g, " "), what: "", unit: kPlain};
  return words.checks.find((c) => c.key === key) ?? unknown;
}

/// What a verdict means; of a folder written before there were verdicts: a dash.
export function verdictWords(given: string|undefined): VerdictWords {
  return words.verdicts.find((v) => v.words === given) ?? {words: given ?? "–", means: "", lasts: true};
}
export function allVerdicts(): VerdictWords[] { return words.verdicts; }

/// A value in SI as people read it: "931 MPa", "4.02 %", "inside".
export function unitText(value: number|null, unit: Unit, digits = 4): string {
  return inUnit(value, unit, (v) => numberText(v, digits));
}

/// A limit, without zeros at its end: "4 %".
export function limitText(limit: number|null, unit: Unit): string {
  return inUnit(limit, unit, (v) => minus(String(Number(v.toPrecision(6)))));
}

function inUnit(value: number|null, unit: Unit, text: (shown: number) => string): string {
  if (value === null) return "–";
  const states = unit.shown.split("|");
  if (states.length === 2) return states[value === 0 ? 0 : 1];
  return `${text(unit.factor * value)}${unit.shown ? ` ${unit.shown}` : ""}`;
}

/// The numbers that the page shows, in the order of summary.json.
export function shownQuantities(): Quantity[] { return words.numbers.filter((q) => q.shown); }

export function quantityAt(path: string): Quantity {
  const unknown =
      {path, name: path, label: path, unit: kPlain, digits: 4, shown: true, comparable: false, round_off: null};
  return words.numbers.find((q) => q.path === path) ?? unknown;
}

/// A number by its path for people: 0 where it is what round-off leaves beside others of the same result.
export function withoutRoundOff(path: string, value: number|null, numberOf: (path: string) => number | null): number|
    null {
  const rule = quantityAt(path).round_off;
  if (value === null || !rule) return value;
  const size = rule.of.reduce((product, other) => product * Math.abs(numberOf(other) ?? 0), rule.share);
  return Math.abs(value) <= size ? 0 : value;
}

/// The value of a check for people: 0 where it is below a millionth of its limit.
export function shownBesideLimit(value: number|null, limit: number|null): number|null {
  return value !== null && limit !== null && Math.abs(value) < 1e-6 * limit ? 0 : value;
}

/// Where stresses are looked for: key and name of each zone, of each measure.
export const zones = () => words.zones;
export const measures = () => words.measures;
