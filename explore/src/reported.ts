// Inside a report: its own result as a state to compare with.
import type {Answer, Seed, Summary} from "./types";

/// Numbers and centre line of a result, SI (src/explore/page.cpp).
export interface Reported {
  summary: Summary;
  x: number[];
  p: number[];
  q_x: number[];
}

/// As an answer that has a centre line alone; null outside of a report.
export function reportedAnswer(seed: Seed): Answer|null {
  const r = seed.reported;
  if (!r) return null;
  const n = r.x.length;
  const none = {first: 0, count: 0};
  const at = (k: number) => ({first: k * n, count: n});
  const patch = {
    stations: 0,
    columns: 0,
    slip_is_distance: false,
    centre_y: 0,
    x: none,
    y: none,
    p: none,
    q_x: none,
    q_y: none,
    slip_x: none,
    slip_y: none,
    state: none,
    centre_x: at(0),
    centre_p: at(1),
    centre_q_x: at(2)
  };
  return {
    name: "report",
    head: {ok: true, summary: r.summary, values: {}, layers: [], strengths: false, notes: [], milliseconds: 0, patch},
    numbers: Float32Array.from([...r.x, ...r.p, ...r.q_x]),
    request: {case: "", file: "", set: [], cell: 0, values: [], want: []}
  };
}
