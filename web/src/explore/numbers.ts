// The numbers of a state, with what they have changed by against the pinned one.
import {element} from "../dom";
import type {DataTable} from "../figures";
import {minus, numberText} from "../text";
import type {NumberWords, Quantity, Summary} from "../types";
import type {Answer} from "./types";

/// A number that is shown: of the program's list, or a stress of a zone.
interface Shown extends Pick<Quantity, "name"|"unit"|"digits"> {
  path: string;
  tile: boolean;
}

const kTiles = new Set([
  "contact/p_max_Pa",
  "contact/patch_area_m2",
  "contact/slip_area_fraction",
  "contact/creepage_x",
  "stress/rail/subsurface/von_mises_max/value_Pa",
  "shakedown/factors/wandering",
]);

const kPaths = [
  "contact/p_max_Pa",
  "contact/patch_area_m2",
  "contact/patch_length_m",
  "contact/patch_width_m",
  "contact/slip_area_fraction",
  "contact/creepage_x",
  "contact/creepage_y",
  "contact/spin_per_m",
  "contact/q_max_Pa",
  "contact/F_x_N",
  "contact/F_y_N",
  "contact/normal_force_N",
  "contact/approach_m",
  "contact/contact_angle_rad",
  "damage/t_gamma_N",
  "damage/temperature_rise_K",
  "stress/rail/subsurface/von_mises_max/value_Pa",
  "stress/rail/subsurface/von_mises_max/depth_m",
  "stress/rail/surface/von_mises_max/value_Pa",
  "stress/rail/surface/sigma1_max/value_Pa",
  "stress/rail/layer/von_mises_max/value_Pa",
  "stress/rail/layer/sigma1_max/value_Pa",
  "stress/rail/interface/von_mises_max/value_Pa",
  "stress/rail/matrix/von_mises_max/value_Pa",
  "stress/wheel/subsurface/von_mises_max/value_Pa",
  "shakedown/factors/wandering",
  "shakedown/factors/first_yield",
  "shakedown/factors/upper",
  "shakedown/factors/kinematic",
];

let numbers: Shown[] = [];

/// Set once, before anything is shown. The parts of a stress get their names from zone and measure; a path that the
/// program's list does not have is left out.
export function setWords(words: NumberWords): void {
  const at = (path: string) => words.numbers.find((n) => n.path === path);
  const stressAt = (path: string) => {
    const [group, body, zone, measure, what] = path.split("/");
    const like = at(what === "depth_m" ? "plastic/depth_m" : "contact/p_max_Pa");
    if (group !== "stress" || !like) return undefined;
    const named = (rows: {key: string; name: string}[], key?: string) => rows.find((r) => r.key === key)?.name ?? key;
    const name = `${named(words.measures, measure)} ${named(words.zones, zone)}, ${body}`;
    return {...like, name: what === "depth_m" ? `${name}: depth` : name};
  };
  numbers = kPaths.flatMap((path) => {
    const found = at(path) ?? stressAt(path);
    return found ? [{...found, path, tile: kTiles.has(path)}] : [];
  });
}

/// In SI; null where the summary has none.
function valueOf(n: Shown, s: Summary): number|null {
  let at: unknown = s;
  for (const key of n.path.split("/")) at = at && typeof at === "object" ? (at as Record<string, unknown>)[key] : null;
  return typeof at === "number" && Number.isFinite(at) ? at : null;
}

function shown(n: Shown, s: Summary): number|null {
  const value = valueOf(n, s);
  return value === null ? null : n.unit.factor * value;
}

/// As it is written: what is next to nothing beside other numbers is zero.
function text(value: number|null, digits: number): string {
  return value !== null && Math.abs(value) < 1e-9 ? "0" : numberText(value, digits);
}

/// "+3.2 %"; of what was near zero the difference itself.
function change(now: number|null, before: number|null, digits: number): string {
  if (now === null || before === null) return "";
  if (Math.abs(before) < 1e-9) return now === before ? "" : minus((now - before).toPrecision(digits));
  const share = 100 * (now / before - 1);
  return Math.abs(share) < 0.005 ? "±0 %"
                                 : `${share > 0 ? "+" : ""}${minus(share.toFixed(Math.abs(share) < 10 ? 2 : 0))} %`;
}

/// The figures large at the top: they follow while a slider moves. What takes longer and is of the last state at rest
/// is left blank meanwhile.
export function tiles(a: Answer, against: Answer|null, last: Answer|null): HTMLElement[] {
  const s = a.head.summary;
  const known = (n: Shown) => shown(n, s) !== null || (last !== null && shown(n, last.head.summary) !== null);
  return numbers.filter((n) => n.tile && known(n)).map((n) => {
    const value = shown(n, s);
    const difference = against ? change(value, shown(n, against.head.summary), 3) : "";
    return element(
        "div", {class: "tile"}, element("span", {class: "name"}, n.name),
        element(
            "span", {class: "big"}, value === null ? "…" : text(value, n.digits),
            element("small", {}, ` ${n.unit.shown}`)),
        element("span", {class: "small"}, against ? `${difference || "–"} vs ${against.name ?? "pin"}` : "\u00a0"));
  });
}

export function table(a: Answer, pinned: Answer|null): HTMLElement {
  const head =
      ["", "now", ...(pinned ? [pinned.name ?? "pin", "change"] : [])].map((t) => element("th", {scope: "col"}, t));
  const rows = numbers.filter((n) => shown(n, a.head.summary) !== null).map((n) => {
    const now = shown(n, a.head.summary), then = pinned ? shown(n, pinned.head.summary) : null;
    const name =
        element("th", {scope: "row"}, n.name, n.unit.shown ? element("small", {}, ` [${n.unit.shown}]`) : null);
    const further = pinned ? [element("td", {}, text(then, n.digits)), element("td", {}, change(now, then, 3))] : [];
    return element("tr", {}, name, element("td", {}, text(now, n.digits)), ...further);
  });
  return element(
      "table", {class: "numbers"}, element("thead", {}, element("tr", {}, ...head)), element("tbody", {}, ...rows));
}

/// Does it last? The answer as `railstrata bem` prints it, then the factors by zone; nothing without strengths.
export function lasting(a: Answer): HTMLElement|null {
  const found = a.head.summary.shakedown;
  if (!found) return null;
  const percent = (v: number|null|undefined) =>
      (v === null || v === undefined ? "–" : `${v >= 1 ? "+" : ""}${minus((100 * (v - 1)).toFixed(0))} %`);
  const rows = found.bodies.flatMap(
      (b) => (b.zones ?? [])
                 .map(
                     (z) => element(
                         "tr", {}, element("th", {scope: "row"}, `${b.body}: ${z.zone}`),
                         element("td", {}, text(z.factors.wandering, 3)),
                         element("td", {}, percent(z.factors.wandering)), element("td", {}, z.verdict ?? "–"))));
  const titles = ["", "load factor", "reserve", "by the load factors"].map((t) => element("th", {scope: "col"}, t));
  const notes = found.bodies.flatMap((b) => b.notes).map((n) => element("p", {class: "note"}, n));
  const {answer} = found;
  const words = answer ? element("p", {class: `answer ${answer.tone}`}, `${answer.lasts}: ${answer.reason}`) : null;
  return element(
      "div", {}, words,
      element(
          "div", {class: "scroll"},
          element(
              "table", {class: "numbers"}, element("thead", {}, element("tr", {}, ...titles)),
              element("tbody", {}, ...rows))),
      ...notes);
}

/// All numbers as summary.json has them: by path, in SI.
export function numbersCsv(a: Answer): DataTable {
  const rows = numbers.flatMap((n) => {
    const value = valueOf(n, a.head.summary);
    return value === null ? [] : [[n.path, String(Number(value.toPrecision(12))), n.unit.si]];
  });
  return {names: ["number", "value", "unit"], rows};
}
