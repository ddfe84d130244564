// Through the body along the rail: a slider moves the cross section.
import {element, note} from "../dom";
import {frame, redraw, type Painted} from "../figures";
import {magnitudeScale, signedScale, type Scale} from "../scale";
import {fixedText} from "../text";
import type {BodyName, Values} from "../types";
import {rowsOf, unpack, type Run, type Slices, type StressQuantity} from "./data";
import {cellsBelow, layerWords, paintSection, type SectionCell} from "./profile";
import {runLabel} from "./words";

const kNames: [key: StressQuantity, name: string, short: string][] = [
  ["von_mises", "von Mises stress", "von Mises"],
  ["tau_max", "largest shear stress τ_max", "τ_max"],
  ["sigma_xz", "shear stress τ_xz", "τ_xz"],
  ["sigma_1", "largest principal stress σ₁", "σ₁"],
];

const isSigned = (key: StressQuantity) => key === "sigma_xz" || key === "sigma_1";

/// One scale for all places; of the principal stress tension counts, deeper compression takes the darkest blue.
function scaleOf(key: StressQuantity, values: Values[][]): Scale {
  const numbers = values.flat(2).filter((v) => v !== null);
  const size = numbers.reduce((top, v) => Math.max(top, Math.abs(v)), 0) || 1;
  if (!isSigned(key)) return magnitudeScale(size);
  const tension = numbers.reduce((top, v) => Math.max(top, v), 0);
  return signedScale(key === "sigma_1" ? Math.max(tension, 0.1 * size) : size);
}

class Looker {
  private shown: number;
  private key: StressQuantity = "von_mises";
  private readonly bodies: [BodyName, Slices][];
  private readonly values = new Map<string, Values[][]>();
  private readonly slider: HTMLInputElement;
  private readonly list: HTMLSelectElement;
  private readonly words = element("output", {id: "slices-at"});

  constructor(private readonly run: Run) {
    this.bodies = (["rail", "wheel"] as const).flatMap((body): [BodyName, Slices][] => {
      const slices = run.slices[body];
      return slices ? [[body, slices]] : [];
    });
    const at = this.bodies[0][1].at;
    this.shown = at.reduce((best, x, k) => (Math.abs(x) < Math.abs(at[best]) ? k : best), 0);
    const range = {type: "range", min: "0", max: String(at.length - 1), value: String(this.shown), id: "slices-slider"};
    this.slider = element("input", {...range, "aria-label": "place of the section"});
    this.slider.addEventListener("input", () => {
      this.shown = Number(this.slider.value);
      this.show();
    });
    const choices = kNames.map(([key, name]) => element("option", {value: key}, name));
    this.list = element("select", {id: "slices-quantity", "aria-label": "stress"}, ...choices);
    this.list.addEventListener("change", () => {
      this.key = this.list.value as StressQuantity;
      this.show();
    });
    this.tell();
  }

  control(): HTMLElement { return element("div", {class: "film"}, this.list, this.slider, this.words); }

  figure(): Painted {
    const g = this.run.geometry!;
    return {
      id: "slices",
      title: `Stress through ${this.bodies.map(([body]) => body).join(" and ")}`,
      wide: true,
      words: [`Cross section at the place of the slider, seen against the rolling direction.${layerWords(g)}`],
      paint: (host, theme, width) => {
        const cells = this.cells();
        const name = kNames.find(([key]) => key === this.key)![2];
        const scale = scaleOf(this.key, this.bodies.flatMap(([body, s]) => this.valuesOf(body, s)));
        const text = (v: number) => `${fixedText(v, 1)} MPa`;
        paintSection(host, this.run, g, {cells, name, scale, highest: 420, unit: "MPa", text}, theme, width);
      },
      table: () => ({
        names: ["body", "y_mm", "depth_mm", `${this.key}_MPa`],
        rows: this.cells().map((cell) => [cell.body, cell.y, cell.depth, cell.value]),
      }),
    };
  }

  /// The rows of every slice.
  private valuesOf(body: BodyName, slices: Slices): Values[][] {
    const name = `${body} ${this.key}`;
    const known = this.values.get(name);
    if (known) return known;
    const rows = rowsOf(unpack(slices[this.key]), slices.along.length);
    const shaped = rowsOf(rows, slices.depth.length);
    this.values.set(name, shaped);
    return shaped;
  }

  /// The wheel's slice is the one nearest to the rail's.
  private cells(): SectionCell[] {
    const x = this.bodies[0][1].at[this.shown];
    return this.bodies.flatMap(([body, slices]) => {
      const k = slices.at.reduce((best, v, i) => (Math.abs(v - x) < Math.abs(slices.at[best] - x) ? i : best), 0);
      return cellsBelow(this.run.geometry!, body, slices.along, slices.depth, this.valuesOf(body, slices)[k]);
    });
  }

  private tell(): void { this.words.textContent = `x = ${fixedText(this.bodies[0][1].at[this.shown], 2)} mm`; }

  private show(): void {
    this.tell();
    redraw("slices");
  }
}

/// Of the first run that has slices and a geometry.
export function slicesParts(runs: Run[]): HTMLElement[] {
  const run = runs.find((r) => r.geometry && r.slices.rail);
  if (!run) return [];
  const looker = new Looker(run);
  const whose = runs.length > 1 ? [note(`Of ${runLabel(run)}.`)] : [];
  return [...whose, looker.control(), element("div", {class: "grid"}, frame(looker.figure()))];
}
