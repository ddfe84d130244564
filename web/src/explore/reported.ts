// Inside a report: its own result as a state to compare with.
import type {Answer, SectionHead, Seed, Slice} from "./types";

/// As an answer that has a centre line, where the pressure is, and one stress a depth; null outside of a report.
export function reportedAnswer(seed: Seed): Answer|null {
  const r = seed.reported;
  if (!r) return null;
  const numbers: number[] = [];
  const put = (values: Iterable<number>): Slice => {
    const first = numbers.length;
    for (const v of values) numbers.push(v);
    return {first, count: numbers.length - first};
  };
  const none = {first: 0, count: 0};
  const {stations, columns} = r.patch ?? {stations: 0, columns: 0};
  const spread = (ends: [number, number], n: number, k: number) =>
      ends[0] + (n > 1 ? k / (n - 1) : 0) * (ends[1] - ends[0]);
  const cells = Array.from({length: stations * columns}, (_, k) => k);
  const patch = {
    stations,
    columns,
    slip_is_distance: false,
    centre_y: 0,
    x: r.patch ? put(cells.map((k) => spread(r.patch!.x, stations, Math.floor(k / columns)))) : none,
    y: r.patch ? put(cells.map((k) => spread(r.patch!.y, columns, k % columns))) : none,
    p: r.patch ? put([...r.patch.pressed].map(Number)) : none,
    q_x: none,
    q_y: none,
    slip_x: none,
    slip_y: none,
    state: none,
    centre_x: put(r.x),
    centre_p: put(r.p),
    centre_q_x: put(r.q_x)
  };
  const s = r.section;
  const section: SectionHead|undefined = s && {
    at: 0,
    along: put([0]),
    depth: put(s.depth),
    von_mises: put(s.von_mises),
    tau_xz: put(s.tau_xz),
    sigma_1: put(s.sigma_1)
  };
  return {
    name: "report",
    head: {
      ok: true,
      summary: r.summary,
      values: {},
      layers: [],
      strengths: false,
      doubts: [],
      notes: [],
      milliseconds: 0,
      patch,
      ...(section ? {section} : {})
    },
    numbers: Float32Array.from(numbers),
    request: {case: "", file: "", set: [], cell: 0, values: [], want: []}
  };
}
