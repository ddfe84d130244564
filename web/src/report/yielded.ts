// What has yielded in a run with plasticity: in words, on the profiles, and along the rail; elastic and yielding runs
// beside each other.
import {element, note, part} from "../dom";
import {frame, type Figure, type Painted} from "../figures";
import {magnitudeScale, type Scale} from "../scale";
import {countText, fixedText, numberText, powerText} from "../text";
import type {BodyName, PlasticNumbers} from "../types";
import {rowsOf, unpack, type Run} from "./data";
import {cellsBelow, layerWords, paintSection, type SectionCell} from "./profile";
import {residualOf} from "./residual";
import {sectionMaps} from "./stress";
import {runLabel} from "./words";

const kHighest = 300;  // px, of a picture's plane
const kBodies: BodyName[] = ["rail", "wheel"];

const named = (run: Run, runs: Run[]) => (runs.length > 1 ? `${runLabel(run)}: ` : "");
const label = (run: Run, runs: Run[], words: string) => (runs.length > 1 ? `${words}: ${runLabel(run)}` : words);

// ---- words

function placeWords(run: Run, p: PlasticNumbers): string {
  const mm = (v: number|null) => fixedText(1e3 * (v ?? 0), 2);
  const where = p.zone === p.body ? `in the ${p.body}` : `in ${p.zone} on the ${p.body}`;
  const across = `${mm(p.depth_m)} mm deep, y ${mm(p.y_m)} mm`;
  if (p.x_m === null) return `${where}, ${across}`;
  const start = Math.abs(p.x_m) < (run.summary.contact.patch_length_m ?? 0);
  const along = start ? `x ${mm(p.x_m)} mm, near where the wheel was put on` : `x ${mm(p.x_m)} mm along the rail`;
  return `${where}, ${across}, ${along}`;
}

function words(run: Run): string {
  const p = run.summary.plastic;
  if (!p) return "The case has no plasticity: every stress is elastic.";
  if (!p.body || !p.accumulated) return "Nothing has yielded.";
  const times = p.strain && p.accumulated > 1.05 * p.strain
      ? ` (the strain itself ${powerText(p.strain)}: the rest went to and fro)`
      : "";
  const work = p.work_J ? ` Plastic work ${numberText(p.work_J, 3)} J, ${
                              numberText(p.dissipated_J, 3)} J of it heat, the rest held by hardening.`
                        : "";
  return `${countText(p.elements)} elements have yielded. Most of all ${placeWords(run, p)}: accumulated plastic ` +
      `strain ${powerText(p.accumulated)}${times}.${work}`;
}

// ---- pictures

type Packed = "von_mises"|"plastic_strain_accumulated";

function cellsOf(run: Run, quantity: Packed): SectionCell[] {
  return kBodies.flatMap((body) => {
    const section = run.sections[body]?.cross;
    const packed = section?.[quantity];
    if (!run.geometry || !section || !packed) return [];
    const cells =
        cellsBelow(run.geometry, body, section.along, section.depth, rowsOf(unpack(packed), section.along.length));
    return quantity === "plastic_strain_accumulated" ? cells.filter((cell) => cell.value > 0) : cells;
  });
}

interface Look {
  quantity: Packed;
  title: string;
  name: string;
  unit: string;
  column: string;
  text: (v: number) => string;
  about: string;
}

const kStress: Look = {
  quantity: "von_mises",
  title: "Von Mises stress",
  name: "von Mises",
  unit: "MPa",
  column: "von_mises_MPa",
  text: (v) => `${fixedText(v, 1)} MPa`,
  about: "",
};
const kStrain: Look = {
  quantity: "plastic_strain_accumulated",
  title: "Accumulated plastic strain",
  name: "p",
  unit: "",
  column: "plastic_strain_accumulated",
  text: powerText,
  about: " Without colour: not yielded.",
};

function picture(run: Run, runs: Run[], look: Look, cells: SectionCell[], scale: Scale): Painted {
  const g = run.geometry!;
  const at = fixedText(run.sections.rail!.cross.at, 2);
  return {
    id: `yielded-${look.quantity === "plastic_strain_accumulated" ? "strain" : "stress"}-${runs.indexOf(run) + 1}`,
    title: label(run, runs, look.title),
    words: [`On the profiles, rail at x = ${at} mm, seen against the rolling direction.${layerWords(g)}${look.about}`],
    paint: (host, theme, width) => paintSection(
        host, run, g, {cells, name: look.name, scale, highest: kHighest, unit: look.unit, text: look.text}, theme,
        width),
    table: () => ({
      names: ["body", "y_mm", "depth_mm", look.column],
      rows: cells.map((cell) => [cell.body, cell.y, cell.depth, cell.value]),
    }),
  };
}

/// One quantity of all runs that have it, on one scale.
function pictures(runs: Run[], look: Look): Painted[] {
  const all = runs.filter((run) => run.geometry).map((run) => ({run, cells: cellsOf(run, look.quantity)}));
  const there = all.filter(({cells}) => cells.length > 0);
  const top = Math.max(...there.flatMap(({cells}) => cells.map((cell) => cell.value)), 1e-9);
  return there.map(({run, cells}) => picture(run, runs, look, cells, magnitudeScale(top)));
}

/// None where no run asks for plasticity.
export function yieldedPart(runs: Run[]): HTMLElement|null {
  if (!runs.some((run) => run.summary.plastic)) return null;
  const told = runs.map((run) => element("p", {class: "yielded"}, named(run, runs), words(run)));
  const bodies =
      kBodies.filter((body) => runs.some((run) => run.sections[body]?.longitudinal.plastic_strain_accumulated));
  const along = bodies.flatMap((body) => sectionMaps(runs, body, ["plastic_strain_accumulated"]))
                    .filter((figure) => figure.id.includes("longitudinal"));
  const [strain, stress] = [pictures(runs, kStrain), pictures(runs, kStress)];
  const figures: Figure[] = runs.length > 1 ? [...stress, ...strain, ...along] : [...strain, ...stress, ...along];
  const about =
      "Accumulated plastic strain p = ∫ √(2/3) |dE^p|: means over an element at this position of the wheel. " +
      "The words describe the largest point anywhere at the end of the rolling.";
  const left = residualOf(runs);
  const grid = (all: Figure[]) => element("div", {class: "grid"}, ...all.map(frame));
  return part(
      "yielded", "What yielded", ...told, note(about), grid(figures), ...left.told,
      ...(left.figures.length ? [grid(left.figures)] : []));
}
