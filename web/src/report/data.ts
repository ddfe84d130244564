// What the program puts into the page: src/results/report/payload.cpp writes it, this file reads it. Millimetres, MPa,
// milliseconds and newtons, except in `summary`, which is summary.json as it stands (SI).
import type {Dash} from "../chart";
import type {BodyName, NumberWords, Summary, Unit, Values} from "../types";

/// Numbers to 1/65534 of their range: 16-bit steps in base64; 65535 is "no value".
interface PackedNumbers {
  low: number;
  high: number;
  u16: string;
}

export interface Grid {
  x: number[];
  y: number[];
  p: PackedNumbers;
  q_x: PackedNumbers;
  q_y: PackedNumbers;
  slip_x: PackedNumbers;
  slip_y: PackedNumbers;
  slip_unit: string;  // "mm/s"; of a shift "µm", over its last increment
  state: string;      // one digit a point: 0 separated, 1 stick, 2 slip
}

/// The patch on its way: states on one grid, index as in Grid; of finite elements each with its own x.
export interface Film {
  x: number[];
  y: number[];
  frames: {step: number; distance_mm: number; q: PackedNumbers; state: string; x?: number[]}[];
}

/// Values at cell centres, index along + along.length * row; rows go down from the surface.
export interface Section {
  at: number;
  along: number[];
  depth: number[];
  von_mises: PackedNumbers;
  sigma_1: PackedNumbers;
  sigma_xz: PackedNumbers;
  tau_max: PackedNumbers;
  plastic_strain_accumulated?: PackedNumbers;  // accumulated plastic strain, of runs with plasticity
  material: string;                            // one digit (base 36) a cell
}

export type StressQuantity = "von_mises"|"sigma_1"|"sigma_xz"|"tau_max";

/// Cross sections one behind the other: values index along + along.length * (row + rows * slice).
export interface Slices extends Record<StressQuantity, PackedNumbers> {
  at: number[];
  along: number[];
  depth: number[];
}

export interface BodySections {
  longitudinal: Section;
  cross: Section;
}

export type Columns = Record<string, number[]>;
/// Where the rail changes along the way: its stress against the wheel's position.
export interface WatchedPoint {
  x_mm: number;
  depth_mm: number;
  position_mm: number[];
  von_mises_MPa: number[];
}
export type CentreLine = Columns&{y: number[]};

export interface Layer {
  name: string;
  on: string;
  thickness_m: number;
  width_m: number;
  young_Pa: number;
  young_ratio: number;
  young_table?: [number, number][];  // depth [m] and modulus [Pa] of a graded layer; its young_Pa is the mean
  bottom_m: [number, number][];
}

/// A place where the wheel touches, with what it bears there.
export interface LoadedContact {
  contact: Record<string, number>;
  load_N: number;
  hertz: {a_m: number; b_m: number; p0_Pa: number; approach_m: number | null};  // a line contact has no approach
}

/// The contact is that of the rigid bodies; `patches`: where the loaded wheel touches at several places.
export interface Geometry extends LoadedContact {
  rail_profile: string;
  wheel_profile: string;
  profile_notes?: string[];                               // what reading the files has changed
  track?: {name: string, value: string, from: string}[];  // not in results of older versions
  patches?: LoadedContact[];
  rail_m: [number, number][];
  wheel_m: [number, number][];
  layers: Layer[];
  heights?: {x_mm: number[], rail_um: number[], wheel_um: number[]};  // below the axle, of an uneven way
}

export interface Run {
  name: string;
  folder: string;
  engine: string;
  title: string;
  summary: Summary;
  case: [table: string, key: string, value: string][];
  provenance: Record<string, unknown>;
  geometry: Geometry|null;
  patch: Grid;
  further_patches: Grid[];
  centre_line: CentreLine;
  further_centre_lines: CentreLine[];
  depth_line: Columns|null;
  wheel_depth_line: Columns|null;
  history: Columns|null;
  points: WatchedPoint[]|null;
  spectrum: Columns|null;
  film: Film|null;
  residual: Columns|null;  // of the rail's section when the wheel has gone
  sections: Partial<Record<BodyName, BodySections>>;
  slices: Partial<Record<BodyName, Slices|null>>;
  shakedown: Partial < Record < BodyName, {
    profile: Columns;
    map: Columns;
    sliding?: Columns
  }
  >> ;
  crack: {passage: Columns; depths: Columns | null}|null;
  interface: Columns|null;
}

export interface Check {
  name: string;
  runs: number[];   // one: the run's own; two: the first against the second; none: over all cases of a study
  judged: boolean;  // false: reported without a limit
  ok: boolean;
  value: number|null;
  limit: number|null;
  note: string;
}

/// A table for the study: text cells are shown as they stand, numbers to four digits.
export interface Table {
  id: string;
  title: string;
  note: string;
  columns: string[];
  rows: (string|number|null)[][];
}

export interface ChartSeries {
  name: string;
  x: number[];
  y: number[];
  markers: boolean;
  colour: number;  // place among the page's; -1: the series' own
  dash: Dash;
}

/// A chart of lines for the study.
export interface ChartData {
  id: string;
  title: string;
  note: string;
  x: string;
  y: string;
  series: ChartSeries[];
  bars?: string[];  // names of y = 0, 1, … where lines are bars; x is logarithmic then
  log?: ""|"x"|"xy";
  wide?: boolean;
}

/// A row of maps of one quantity, one a run, on one scale.
export interface Maps {
  id: string;
  title: string;
  note: string;
  kind: "state"|"von_mises"|"sigma_1";
  runs: number[];
  names: string[];
}

/// Which layer lasts: a row of grids of verdicts over two keys, a grid for each value of a third.
export interface GridCell {
  verdict: string;
  factor: number|null;  // to shakedown under wandering traffic; of a grid of values the value
  fails_by: string[];   // all that ends it
}
export interface VerdictGrid {
  name: string;
  x: string[];  // values of the key along x, in order
  y: string[];
  cells: (GridCell|null)[];  // index x + x.length * y; null: no result
}
export interface Grids {
  id: string;
  title: string;
  note: string;
  x: string;  // axes
  y: string;
  value: string;  // with its unit; empty: verdicts
  grids: VerdictGrid[];
}

export interface CheckWords {
  key: string;
  name: string;
  what: string;
  unit: Unit;
}

/// Of a rail that yields, a point whose path through the load is recorded.
export interface WayPoint {
  name: string;
  y_m: number;
  depth_m: number;
}

/// passes.json as it stands.
export interface PassesSummary {
  title: string;
  method?: string;
  passes: number;
  verdict?: string;
  law?: string;
  doubts?: string[];
  class: string;
  points?: Record<string, number>;  // of each class, in their order
  passes_per_cycle?: number;
  net_strain_per_pass: number|null;
  trend?: number|null;
  last_pass: Record<string, number|null>;
  error?: {last_pass: Record<string, number>; classes_on_coarser_grids: string[]; not_converged: string[]}|null;
  no_error?: string;
  ductility?: {strain: number; reached: number; passes: number | null; earliest: number | null; latest: number | null};
  shakedown?: {factors: Record<string, number|null>; verdict: string};
  zones?: {name: string; zone: number; top_m: number}[];
  loops?: WayPoint[];
  assumptions?: string[];
  notes?: string[];
}

/// A folder of passes.
export interface PassesStory {
  name: string;
  summary: PassesSummary;
  passes: Columns;
  residual: Columns;
  profile: Columns;
  loops: Columns|null;
  along: Columns|null;
}

/// What becomes of a zone, from the best to the worst.
export interface VerdictWords {
  words: string;
  means: string;
  lasts: boolean;
}

/// The words for results, from the program's tables (src/results/result/result_table.cpp,
/// src/results/judge/check_limits.hpp).
export interface Words extends NumberWords {
  checks: CheckWords[];
  verdicts: VerdictWords[];
}

/// An answer of the page's banner; tone "plain": a number beside them.
export interface Answer {
  tone: "good"|"open"|"bad"|"plain";
  title: string;
  text: string;
}

export interface Report {
  answers?: Answer[];
  title: string;
  program: string;
  words: Words;
  checks: Check[];
  runs: Run[];
  tables: Table[];
  charts: ChartData[];
  maps: Maps[];
  grids: Grids[];
  passes?: PassesStory[];  // over rails that yield
}

export function unpack(packed: PackedNumbers): Values {
  const bytes = atob(packed.u16);
  const out: Values = [];
  const step = (packed.high - packed.low) / 65534;
  for (let i = 0; i + 1 < bytes.length; i += 2) {
    const k = bytes.charCodeAt(i) + 256 * bytes.charCodeAt(i + 1);
    out.push(k === 65535 ? null : packed.low + step * k);
  }
  return out;
}

/// Rows of `width` values.
export function rowsOf<T>(values: readonly T[], width: number): T[][] {
  const rows: T[][] = [];
  for (let i = 0; i < values.length; i += width) rows.push(values.slice(i, i + width));
  return rows;
}

export function columnsOf<T>(values: readonly T[], height: number): T[][] {
  const rows = rowsOf(values, height);
  return Array.from({length: height}, (_, j) => rows.map((row) => row[j]));
}

/// A number of summary.json by its path, "contact/p_max_Pa"; null if it is not there.
export function numberAt(run: Run, path: string): number|null {
  let at: unknown = run.summary;
  for (const key of path.split("/")) at = at && typeof at === "object" ? (at as Record<string, unknown>)[key] : null;
  return typeof at === "number" ? at : null;
}

/// Value of an option of the resolved case.
export function option(run: Run, table: string, key: string): string|null {
  return run.case.find(([t, k]) => t === table && k === key)?.[2] ?? null;
}
