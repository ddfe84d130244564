// What the program puts into the page (src/doors/explore/page.cpp), and what the engine answers
// (src/doors/explore/solve.hpp).
import type {NumberWords, Summary} from "../types";

/// Numbers, centre line, border of the patch and largest stresses over depth of a result, SI
/// (src/doors/explore/page.cpp).
export interface Reported {
  summary: Summary;
  x: number[];
  p: number[];
  q_x: number[];
  patch?: {stations: number; columns: number; x: [number, number]; y: [number, number]; pressed: string};
  section?: Record<"depth"|"von_mises"|"tau_xz"|"sigma_1", number[]>;
}

export interface Seed {
  case: string;                   // text of the case file
  file: string;                   // its name as the command line had it
  folder: string;                 // where the engine's files lie, a folder of its own memory
  name: string;                   // of the case's file without folders
  overrides: string[];            // --set, as given
  placed: string[];               // overrides that lead to the files below; not in what the page hands out
  files: Record<string, string>;  // that the case reads, by the name below the folder
  ratioKeys: boolean[];           // of each layer: it takes young_ratio; else young
  cell: number;                   // m
  version: string;                // of the program that wrote the page
  engine: string;                 // of the program that the engine was compiled from
  words: NumberWords;             // names and units of the numbers
  reported?: Reported;            // inside a report: its own result
}

export interface Fault {
  where: string;
  message: string;
  remedy: string;
}

/// A place among the answer's numbers.
export interface Slice {
  first: number;
  count: number;
}

export interface PatchHead {
  stations: number;
  columns: number;
  slip_is_distance: boolean;
  centre_y: number;
  x: Slice;
  y: Slice;
  p: Slice;
  q_x: Slice;
  q_y: Slice;
  slip_x: Slice;
  slip_y: Slice;
  state: Slice;
  centre_x: Slice;
  centre_p: Slice;
  centre_q_x: Slice;
}

export interface SectionHead {
  at: number;
  along: Slice;
  depth: Slice;
  von_mises: Slice;
  sigma_1: Slice;
  tau_xz: Slice;
}

export interface LayerHead {
  name: string;
  on: string;
  thickness: number;
  graded: boolean;
}

export interface Head {
  ok: true;
  summary: Summary;
  values: Record<string, number|null>;
  layers: LayerHead[];
  strengths: boolean;
  excluded?: Record<string, string>;  // keys without effect in this case: why
  doubts: string[];
  notes: string[];
  milliseconds: number;
  case?: string;
  patch?: PatchHead;
  section?: SectionHead;
  cross?: SectionHead;
}

/// An answer with its arrays, and what it answers.
export interface Answer {
  name?: string;  // of what stands in for an answer to compare with; a pinned state has none
  head: Head;
  numbers: Float32Array;
  request: Request;
}

export type Want = "patch"|"stress"|"section"|"shakedown"|"case";

export interface Request {
  case: string;
  file: string;
  set: string[];
  cell: number;
  values: string[];
  want: Want[];
}

export const numbersOf = (a: Answer, s: Slice) => a.numbers.subarray(s.first, s.first + s.count);

// Between the page and its worker.
export type ToWorker = {
  kind: "start"; wasm: ArrayBuffer; folder: string; files: Record<string, string>
}|{
  kind: "file";
  name: string;
  text: string
}
|{
  kind: "solve";
  request: Request
};
export type FromWorker = {
  kind: "ready"
}|{
  kind: "failed";
  message: string
}
|{
  kind: "answer";
  head: string;
  numbers: Float32Array;
  memory: number
};
