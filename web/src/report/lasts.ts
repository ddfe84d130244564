// Does it last? Shakedown factors, the strength that depths ask for, and where most of it is used.
import type {Dash} from "../chart";
import {element, note, part, table, type Cell} from "../dom";
import {frame, type Figure} from "../figures";
import {magnitudeScale} from "../scale";
import {minus, numberText} from "../text";
import type {BodyName, Factors, PrincipalZone, Values, ZoneShakedown} from "../types";
import type {Columns, Run} from "./data";
import {linesFigure, type Series} from "./lines";
import {mapFigure} from "./maps";
import {runLabel, verdictWords} from "./words";

const kFactors: [key: keyof Factors, name: string][] = [
  ["first_yield", "first yield"],
  ["wandering", "shakedown, wandering traffic"],
  ["single_track", "shakedown, one track"],
  ["upper", "upper bound"],
  ["kinematic", "with hardening"],
];

function zoneRow(run: Run, runs: Run[], body: string, z: ZoneShakedown): (string|Cell)[] {
  const verdict = verdictWords(z.verdict);
  const name = z.zone === body ? body : `${body}, ${z.zone}`;
  return [
    runs.length > 1 ? `${name}, ${runLabel(run)}` : name,
    {text: verdict.words, attributes: {class: verdict.lasts ? "ok" : "failed", "data-verdict": verdict.words}},
    ...kFactors.map(([key]) => ({text: numberText(z.factors[key], 3)})),
    {text: z.depth_m === null ? "–" : (1e3 * z.depth_m).toFixed(2)},
    {text: verdict.means, attributes: {class: "words"}},
  ];
}

function factorsTable(runs: Run[]): HTMLElement {
  const rows = runs.flatMap(
      (run) => (run.summary.shakedown?.bodies ??
                []).flatMap((b) => (b.zones ?? []).map((z) => zoneRow(run, runs, b.body, z))));
  const head = ["zone", "verdict", ...kFactors.map(([, name]) => name), "decided at depth [mm]", "which means"];
  return table("Load factors", head, rows, {
    class: "numbers",
    id: "shakedown",
  });
}

/// One line of a table by depth, broken where the zone changes.
function byDepth(profile: Columns, column: string): {x: Values; y: Values} {
  const x: Values = [];
  const y: Values = [];
  profile[column].forEach((v, i) => {
    if (i > 0 && profile.zone[i] !== profile.zone[i - 1]) {
      x.push(null);
      y.push(null);
    }
    x.push(v);
    y.push(profile.depth_mm[i]);
  });
  return {x, y};
}

const kLines: [column: string, name: string, dash: Dash][] = [
  ["yield_strength_MPa", "available", "solid"],
  ["required_first_yield_MPa", "required to stay elastic", "dot"],
  ["required_wandering_MPa", "required to shake down, wandering traffic", "dash"],
  ["required_upper_MPa", "required (upper bound)", "dashdot"],
];

/// Where two zones of a table by depth meet [mm].
function borders(profile: Columns): number[] {
  const at = (k: number) => profile.depth_mm[k] ?? 0;
  return profile.zone.flatMap((zone, i) => (i > 0 && zone !== profile.zone[i - 1] ? [at(i)] : []));
}

/// Down to where something happens [mm]: what a depth asks for to stay elastic is a quarter of the most, and room below
/// the last border.
function eventful(profile: Columns): number {
  const asked = profile.required_first_yield_MPa.map((v) => v ?? 0);
  const depths = profile.depth_mm.map((v) => v ?? 0);
  const quarter = 0.25 * Math.max(...asked);
  const last = Math.max(...depths.filter((_, i) => asked[i] >= quarter));
  const room = 1.25 * Math.max(0, ...borders(profile));
  return Math.min(Math.max(1.1 * last, room), Math.max(...depths));
}

function strengthFigure(runs: Run[], body: BodyName): Figure|null {
  const given = runs.filter((run) => run.shakedown[body]);
  if (!given.length) return null;
  const series =
      given.flatMap((run, n) => kLines.map(([column, name, dash], k): Series => ({
                                             ...byDepth(run.shakedown[body]!.profile, column),
                                             name: given.length > 1 ? `${name}, ${runLabel(run)}` : name,
                                             dash,
                                             colour: (t) => t.series[(given.length > 1 ? n : k) % t.series.length],
                                             hover: `depth %{y:.2f} mm\n${name} %{x:.0f} MPa`,
                                           })));
  const levels = [...new Set(given.flatMap((run) => borders(run.shakedown[body]!.profile)))];
  return linesFigure({
    id: `strength-${body}`,
    title: `Yield strength against depth, ${body}`,
    words: [
      "Uniaxial yield strength. Where the solid line lies right of a broken one there is enough." +
          (levels.length ? " Lines across: where two materials meet." : "") +
          " Below the frame less is required; the table goes on.",
    ],
    labels: ["yield strength [MPa]", "depth [mm]"],
    names: ["yield_strength_MPa", "depth_mm"],
    downwards: true,
    deepest: Math.max(...given.map((run) => eventful(run.shakedown[body]!.profile))),
    levels,
    height: 420,
    series,
  });
}

const mpa = (v: number|null) => (v === null ? "–" : (1e-6 * v).toFixed(0));
const mm = (v: number|null, digits = 2) => (v === null ? "–" : (1e3 * v).toFixed(digits));

/// What a layer's flaws may be: nothing is shown where K_Ic is not given.
function flawText(z: PrincipalZone): string {
  if (z.critical_flaw_m === null) return "–";
  const thickness = z.thickness_m ?? null;
  return thickness !== null && z.critical_flaw_m > thickness ? "none in its thickness" : mm(z.critical_flaw_m, 3);
}

/// A state that a limit decides; "–" where the case gives none.
function stateCell(value: number|null, fails: string, holds: string): Cell {
  if (value === null) return {text: "–"};
  const words = value >= 1 ? fails : holds;
  return {text: words, attributes: {class: value >= 1 ? "failed" : "ok", "data-verdict": words}};
}

const named = (name: string, run: Run, runs: Run[]) => (runs.length > 1 ? `${name}, ${runLabel(run)}` : name);

function layersTable(runs: Run[]): HTMLElement|null {
  const rows = runs.flatMap((run) => (run.summary.fatigue ?? []).flatMap((b) => {
    const layers = (b.zones ?? []).filter((z) => z.zone !== b.body);
    return layers.map(
        (z): (string|Cell)[] =>
            [named(`${b.body}, ${z.zone}`, run, runs),
             stateCell(z.share_of_tensile_strength, "brittle layer cracks", "holds"),
             {text: mpa(z.sigma1_max_Pa)},
             {text: mm(z.depth_m)},
             {text: numberText(z.share_of_tensile_strength, 3)},
             {text: flawText(z)},
    ]);
  }));
  if (!rows.length) return null;
  const head = [
    "layer",
    "verdict",
    "largest σ₁ [MPa]",
    "at depth [mm]",
    "σ₁ over tensile strength",
    "critical flaw depth [mm]",
  ];
  return table("Does a brittle layer crack?", head, rows, {class: "numbers", id: "brittle"});
}

function interfacesTable(runs: Run[]): HTMLElement|null {
  const rows = runs.flatMap((run) => (run.summary.fatigue ?? []).flatMap((b) => {
    return (b.interfaces ?? [])
        .map(
            (i): (string|Cell)[] =>
                [named(`${i.above} on ${i.below}`, run, runs),
                 stateCell(i.delamination, "interface shears", "holds"),
                 {text: mm(i.depth_m)},
                 {text: mpa(i.tension_Pa)},
                 {text: mpa(i.shear_Pa)},
                 {text: mpa(i.shear_range_Pa)},
                 {text: numberText(i.delamination, 3)},
    ]);
  }));
  if (!rows.length) return null;
  const head = [
    "interface",
    "verdict",
    "at depth [mm]",
    "tension [MPa]",
    "shear [MPa]",
    "range Δτ_xz [MPa]",
    "delamination index",
  ];
  return table("Does a layer come off?", head, rows, {class: "numbers", id: "interfaces"});
}

/// The answer of each run in a line; of a folder written before there were answers: none.
function answers(runs: Run[]): HTMLElement[] {
  return runs.flatMap((run) => {
    const answer = run.summary.shakedown!.answer;
    if (!answer) return [];
    const words = `${answer.title}: ${answer.reason}.`;
    return [element("p", {class: `answer ${answer.tone}`}, runs.length > 1 ? `${runLabel(run)}: ${words}` : words)];
  });
}

const kLayerWords = "σ₁ and tractions hold the residual stress of the process. A dash: the case gives no " +
    "tensile_strength, fracture_toughness, or bond_tension and bond_shear to hold them against. The index is " +
    "(tension over bond_tension)² + (shear over bond_shear)²; Δτ drives a crack along the interface.";

function edges(centres: number[]): number[] {
  const n = centres.length;
  const middle = centres.slice(1).map((c, i) => 0.5 * (c + centres[i]));
  return [centres[0], ...middle, centres[n - 1]];
}

function usedFigure(run: Run, runs: Run[], body: BodyName): Figure|null {
  const map = run.shakedown[body]?.map;
  if (!map) return null;
  const {y_mm: y, depth_mm: depth, used} = map;
  let width = 1;
  while (width < y.length && y[width] > y[width - 1]) ++width;
  const across = y.slice(0, width);
  const down: number[] = [];
  const z: Values[] = [];
  let best = {x: 0, y: 0, value: -Infinity};
  for (let i = 0; i + width <= used.length; i += width) {
    down.push(depth[i]);
    z.push(used.slice(i, i + width).map((v) => (Number.isFinite(v) && v !== null ? v : null)));
    z[z.length - 1].forEach((v, k) => {
      if (v !== null && v > best.value) best = {x: across[k], y: depth[i], value: v};
    });
  }
  if (best.value === -Infinity) return null;
  const where = `y ${minus(best.x.toFixed(2))}, depth ${best.y.toFixed(2)} mm`;
  const rowEdges = edges(down);
  return mapFigure({
    id: `strength-used-${body}-${runs.indexOf(run)}`,
    title: ["Share of the strength that is used", body, ...(runs.length > 1 ? [runLabel(run)] : [])].join(", "),
    words: [
      "Of the strength that shakedown asks for at best (upper bound), in the section across the track. Circle: the " +
          `largest, ${best.value.toFixed(2)} at ${where}. Beyond 1 no residual stress can help.`,
    ],
    x: edges(across),
    y: rowEdges,
    z,
    centresX: across,
    centresY: down,
    names: ["y_mm", "depth_mm", "used"],
    labels: ["y, field side right [mm]", "depth [mm]"],
    hover: "used %{z:.2f}",
    hoverY: "depth",
    bar: "used",
    scale: magnitudeScale(best.value),
    reversed: body === "rail",
    windowX: [across[0], across[width - 1]],
    windowY: [0, down[down.length - 1]],
    marker: {x: best.x, y: best.y, text: `used ${best.value.toFixed(2)}\n${where}`, mark: "circle"},
  });
}

const kLimits: [column: string, name: string, dash: Dash][] = [
  ["p_max_first_yield_MPa", "first yield", "dot"],
  ["p_max_wandering_MPa", "shakedown, wandering traffic", "solid"],
  ["p_max_upper_MPa", "upper bound", "dashdot"],
];

/// Limit pressure over traction for the run's own patch and layers, and where the run stands.
function slidingFigure(run: Run, runs: Run[], body: BodyName): Figure|null {
  const map = run.shakedown[body]?.sliding;
  if (!map) return null;
  const series = kLimits.map(([column, name, dash], k): Series => ({
                               name,
                               x: map.traction_coefficient,
                               y: map[column],
                               dash,
                               colour: (t) => t.series[k],
                               hover: `q/p %{x:.2f}\n${name} at %{y:.0f} MPa`,
                             }));
  const {p_max_Pa: p, F_x_N: force, normal_force_N: load} = run.summary.contact;
  if (p && load && force !== null)
    series.push({
      name: "this case",
      x: [Math.abs(force / load)],
      y: [1e-6 * p],
      markers: true,
      colour: (t) => t.ink,
      hover: "F_x/F_n %{x:.2f}\np_max %{y:.0f} MPa",
    });
  return linesFigure({
    id: `strength-sliding-${body}-${runs.indexOf(run)}`,
    title: ["Limit pressure against traction", body, ...(runs.length > 1 ? [runLabel(run)] : [])].join(", "),
    words: [
      "Largest pressure at each limit for the shape of this patch, these layers and these strengths, if it slid " +
          "everywhere with q = traction times p. Above the solid line wandering traffic does not shake down. This " +
          "case sticks in part of its patch: its own factors are in the table.",
    ],
    labels: ["traction coefficient q/p", "p_max [MPa]"],
    names: ["traction_coefficient", "p_max_MPa"],
    series,
  });
}

/// Strengths that are estimates, each once.
function notes(runs: Run[]): HTMLElement[] {
  const all = runs.flatMap((run) => (run.summary.shakedown?.bodies ?? []).flatMap((b) => b.notes));
  return [...new Set(all)].map((text) => note(text));
}

/// The part of the page, where a run's case gives a strength.
export function lastsPart(runs: Run[]): HTMLElement|null {
  const given = runs.filter((run) => run.summary.shakedown);
  if (!given.length) return null;
  const bodies: BodyName[] = ["rail", "wheel"];
  const figures = bodies.flatMap(
      (body) =>
          [strengthFigure(given, body),
           ...given.map((run) => usedFigure(run, given, body)),
           ...given.map((run) => slidingFigure(run, given, body)),
  ]);
  const words = note(
      "A factor of 1.2 says: 20 % more stress of this contact can be borne, its patch and friction staying as they " +
      "are. The steel yields in the first passages beyond the factor of first yield; residual stresses that build up " +
      "then may stop it (shakedown). Computed on elastic stresses; see docs/damage.md.");
  const tables = [layersTable(given), interfacesTable(given)].filter((t) => t !== null);
  const layers = tables.length ? [...tables, note(kLayerWords)] : [];
  return part(
      "lasts",
      "Does it last?",
      ...answers(given),
      factorsTable(given),
      words,
      ...layers,
      ...notes(given),
      element("div", {class: "grid"}, ...figures.filter((f) => f !== null).map(frame)),
  );
}
