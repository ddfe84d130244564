// What the sliders say, as overrides of the case: the page, the command line and a link say the same.
import type {Head, Seed} from "./types";

/// A number that can be moved: its key, its unit and where a slider ends.
export interface Knob {
  id: string;     // in links, and of the control
  key: string;    // of the case; of a layer below "layer.<k>."
  layer: number;  // slot of a layer, -1: none
  name: string;
  unit: string;    // as in a case file
  factor: number;  // shown = factor * SI
  low: number;     // shown
  high: number;
  step: number;
  log?: boolean;
  preset?: number;      // shown, where the case has no value
  zeroIsNone?: string;  // what zero means
  rivals?: string[];    // keys that say the same in another way
  group: string;
}

const kLoads = ["vehicle.sprung_mass", "vehicle.wheel_load", "vehicle.axle_load", "vehicle.approach"];
const kTractions = ["drive.traction_coefficient", "drive.tractive_force", "drive.creepage"];
export const kSlots = 2;
const kByTable = "the layer's young_table gives thickness and stiffness";

function layerKnobs(k: number): Knob[] {
  const group = k === 0 ? "Layer" : "Second layer";
  const of = {layer: k, group};
  return [
    {
      ...of,
      id: `h${k + 1}`,
      key: "thickness",
      name: "Thickness",
      unit: "mm",
      factor: 1e3,
      low: 0,
      high: 6,
      step: 0.05,
      preset: 0,
      zeroIsNone: "no layer"
    },
    {
      ...of,
      id: `e${k + 1}`,
      key: "young_ratio",
      name: "Stiffness E/E₀",
      unit: "",
      factor: 1,
      low: 0.25,
      high: 4,
      step: 0.01,
      log: true,
      preset: 1
    },
    {
      ...of,
      id: `n${k + 1}`,
      key: "poisson",
      name: "Poisson's ratio",
      unit: "",
      factor: 1,
      low: 0,
      high: 0.49,
      step: 0.01,
      preset: 0.3
    },
  ];
}

const plain = (group: string) => ({layer: -1, group});
const strength = (layer: number, id: string, key: string, name: string): Knob => ({
  layer,
  id,
  key,
  name,
  group: "Strength",
  unit: "MPa",
  factor: 1e-6,
  low: 0,
  high: 1500,
  step: 10,
  preset: 0,
  zeroIsNone: "as in the case"
});

export const kKnobs: Knob[] = [
  ...layerKnobs(0),
  ...layerKnobs(1),
  {
    ...plain("Load and drive"),
    id: "load",
    key: "vehicle.wheel_load",
    name: "Wheel load",
    unit: "kN",
    factor: 1e-3,
    low: 10,
    high: 200,
    step: 1,
    rivals: kLoads
  },
  {
    ...plain("Load and drive"),
    id: "t",
    key: "drive.traction_coefficient",
    name: "Traction F_x/G",
    unit: "",
    factor: 1,
    low: -0.5,
    high: 0.5,
    step: 0.005,
    preset: 0,
    rivals: kTractions
  },
  {
    ...plain("Load and drive"),
    id: "f",
    key: "drive.friction_coefficient",
    name: "Friction",
    unit: "",
    factor: 1,
    low: 0,
    high: 0.8,
    step: 0.01
  },
  {
    ...plain("Load and drive"),
    id: "v",
    key: "drive.speed",
    name: "Speed",
    unit: "m/s",
    factor: 1,
    low: 1,
    high: 100,
    step: 1
  },
  {
    ...plain("Place"),
    id: "y",
    key: "geometry.lateral_shift",
    name: "Lateral shift",
    unit: "mm",
    factor: 1e3,
    low: -10,
    high: 10,
    step: 0.1
  },
  strength(-1, "sr", "material.rail.yield_strength", "Yield, rail"),
  strength(0, "s1", "yield_strength", "Yield, layer"),
  strength(1, "s2", "yield_strength", "Yield, second layer"),
];

/// The keys whose values the page wants to know at the start.
export const kAsked = kKnobs.map((k) => (k.layer < 0 ? k.key : `layer.${k.layer}.${k.key}`));

/// A number as a case file has it: no more digits than a slider means.
export const written = (value: number) => String(Number(value.toPrecision(10)));

/// Lines "key = value" of every [[layer]] of a resolved case.
function layerLines(text: string): [string, string][][] {
  return text.split(/^\[\[layer\]\]\n/m).slice(1).map((block) => block.split(/^\[/m)[0]!.split("\n").flatMap((line): [
    string, string
  ][] => {
    const at = line.indexOf(" = ");
    return at < 0 ? [] : [[line.slice(0, at), line.slice(at + 3)]];
  }));
}

export class State {
  /// Shown numbers that differ from the case, by id.
  readonly moved = new Map<string, number>();
  /// Profiles that were dropped, by key.
  readonly profiles = new Map<string, string>();
  private initial = new Map<string, number>();
  private present = 0;  // layers of the case
  private lines: [string, string][][] = [];
  /// Keys of the case without effect, and why: by the engine's answer and the page's own knowledge.
  private excluded: Record<string, string> = {};

  constructor(private readonly seed: Seed) {}

  /// What the case as given says.
  learn(head: Head): void {
    this.present = head.layers.length;
    this.lines = layerLines(head.case ?? "");
    this.take(head);
    kKnobs.forEach((knob, k) => {
      const value = head.values[kAsked[k]!];
      const shown = value === null || value === undefined ? knob.preset : value * knob.factor;
      if (shown !== undefined) this.initial.set(knob.id, Number(shown.toPrecision(10)));
    });
  }

  /// What an answer says of the state that it answers.
  take(head: Head): void {
    const tables = head.layers.flatMap(
        (l, k) => (l.graded ? ["thickness", "young_ratio"].map((key) => [`layer.${k}.${key}`, kByTable]) : []));
    this.excluded = {...Object.fromEntries(tables), ...head.excluded};
  }

  first(knob: Knob): number { return this.initial.get(knob.id) ?? knob.preset ?? knob.low; }
  value(knob: Knob): number { return this.moved.get(knob.id) ?? this.first(knob); }

  set(knob: Knob, shown: number): void {
    if (shown === this.first(knob))
      this.moved.delete(knob.id);
    else
      this.moved.set(knob.id, shown);
  }

  private knob(id: string): Knob { return kKnobs.find((k) => k.id === id)!; }

  /// Why a number has no effect in this state; null: it has.
  excludedBy(knob: Knob): string|null {
    const before = [...Array(Math.max(knob.layer, 0)).keys()].filter((k) => this.has(k)).length;
    return this.excluded[knob.layer < 0 ? knob.key : `layer.${before}.${knob.key}`] ?? null;
  }

  /// Whether a slot of a layer has one. A thickness below zero is no way to say "none": the engine reports its range.
  has(slot: number): boolean { return this.value(this.knob(`h${slot + 1}`)) !== 0; }

  private quantity(knob: Knob): string {
    const number = written(this.value(knob));
    return knob.unit ? `${number} ${knob.unit}` : number;
  }

  /// What is moved of a slot, as key and value; all of it for a layer that the case does not have.
  private ofSlot(slot: number, all: boolean): [string, string][] {
    return kKnobs.filter((k) => k.layer === slot).flatMap((k): [string, string][] => {
      if (k.zeroIsNone && this.value(k) === 0) return [];
      if (!all && !this.moved.has(k.id)) return [];
      if (k.key !== "young_ratio" || this.seed.ratioKeys[slot] !== false) return [[k.key, this.quantity(k)]];
      return this.modulus(slot, this.value(k));
    });
  }

  /// A ratio where the case gives a modulus: that times what the ratio has changed by.
  private modulus(slot: number, ratio: number): [string, string][] {
    const line = this.lines[slot]?.find(([key]) => key === "young");
    const found = line && /^"([-+.\de]+) (\S+)"$/.exec(line[1]);
    if (!found) return [];
    const before = this.first(this.knob(`e${slot + 1}`));
    return [["young", `${written(Number(found[1]) * ratio / before)} ${found[2]}`]];
  }

  private layers(): string[] {
    const slots = [...Array(kSlots).keys()];
    const gone = slots.some((k) => k < this.present && !this.has(k));
    const out = gone ? ["layer=[]"] : [];
    let next = 0;
    for (let k = 0; k < Math.max(this.present, kSlots); ++k) {
      const fresh = k >= this.present;
      if (k < kSlots && !this.has(k)) continue;
      if (fresh || k < kSlots || gone)
        for (const [key, value] of this.merged(k, gone && !fresh, fresh)) out.push(`layer.${next}.${key}=${value}`);
      ++next;
    }
    return out;
  }

  /// What is to be said of a layer: of one that was taken out of the case with others, all that the case said of it.
  private merged(slot: number, again: boolean, fresh: boolean): [string, string][] {
    const moved = slot < kSlots ? this.ofSlot(slot, fresh) : [];
    if (!again) return moved;
    const keys = new Set(moved.map(([key]) => (key === "young_ratio" ? "young" : key)));
    return [...(this.lines[slot] ?? []).filter(([key]) => !keys.has(key)), ...moved];
  }

  /// Overrides as the command line has them, those of the case's own --set first.
  overrides(): string[] {
    const rivals = kKnobs.filter((k) => this.moved.has(k.id)).flatMap((k) => [k.key, ...(k.rivals ?? [])]);
    const kept = this.seed.overrides.filter((o) => !rivals.includes(o.slice(0, o.indexOf("="))));
    const own = kKnobs.filter((k) => k.layer < 0 && this.moved.has(k.id) && !(k.zeroIsNone && this.value(k) === 0));
    return [
      ...kept, ...this.layers(), ...own.map((k) => `${k.key}=${this.quantity(k)}`),
      ...[...this.profiles].map(([key, name]) => `${key}=${name}`)
    ];
  }

  /// The same for the engine, which has the case's files in a folder of its own.
  forEngine(): string[] {
    const dropped = this.seed.placed.filter((o) => !this.profiles.has(o.slice(0, o.indexOf("="))));
    return [...dropped, ...this.overrides()];
  }

  command(cell: number): string {
    const word = (text: string) => (/^[\w.,:=/+-]+$/.test(text) ? text : `'${text.replace(/'/g, `'\\''`)}'`);
    const sets = this.overrides().map((o) => ` --set ${word(o)}`).join("");
    return `railstrata bem ${word(this.seed.file)} --cell '${written(1e3 * cell)} mm'${sets}`;
  }

  /// In the part of an address that no server sees.
  fragment(): string { return [...this.moved].map(([id, value]) => `${id}=${written(value)}`).join("&"); }

  /// Numbers of a link; others are left alone.
  takeFragment(text: string): void {
    this.moved.clear();
    for (const part of text.replace(/^#/, "").split("&")) {
      const [id, value] = part.split("=");
      const knob = kKnobs.find((k) => k.id === id);
      if (knob && value !== undefined && value !== "" && Number.isFinite(Number(value))) this.set(knob, Number(value));
    }
  }

  reset(): void { this.moved.clear(); }
}
