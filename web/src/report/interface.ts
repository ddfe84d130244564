// An interface of the rail's layers that slides: its slip and shear below the patch.
import {element, note, part} from "../dom";

import {frame, type Figure} from "../figures";
import {numberText} from "../text";
import type {Run} from "./data";
import {linesFigure, type Series} from "./lines";
import {runLabel} from "./words";

const kWords =
    "Along the row that slips most, with the patch at 0. It rolls to the right: what lies to the left is left " +
    "behind. Slip is that of the lower side over the upper one, with what earlier passages left.";

const kPassages = ["last passage", "first passage"];

function passageFigure(run: Run, runs: Run[], symbol: string, title: string, unit: string): Figure {
  const of = run.interface!;
  return linesFigure({
    id: `interface-${symbol}-${runs.indexOf(run)}`,
    title: runs.length > 1 ? `${title}, ${runLabel(run)}` : title,
    words: [kWords],
    labels: ["x from the contact [mm]", `${symbol}_x [${unit}]`],
    names: ["x_mm", `${symbol}_x`],
    series: ["", "first_"].map((prefix, k): Series => ({
                                 name: kPassages[k],
                                 x: of.x_mm,
                                 y: of[`${prefix}${symbol}_x_${unit === "µm" ? "um" : unit}`],
                                 colour: (t) => t.series[k],
                                 hover: `x %{x:.1f} mm\n%{y:.2f} ${unit}`,
                               })),
  });
}

/// What the passages do to the interface, in a sentence.
function answer(run: Run, runs: Run[]): HTMLElement {
  const s = run.summary.interface!, who = runs.length > 1 ? `${runLabel(run)}: ` : "";
  const um = (v: number|null|undefined) => `${numberText(1e6 * (v ?? 0), 3)} µm`;
  return note(
      `${who}The first passage leaves ${um(s.first_slip_left_m)} of slip behind, passage number ${
          s.passages_followed} leaves ` +
      `another ${um(s.slip_left_m)}; friction of the interface then takes ` +
      `${numberText(s.work_J_per_m ?? 0, 3)} J/m.`);
}

/// The part of the page, where an interface of a run has a shear limit.
export function interfacePart(runs: Run[]): HTMLElement|null {
  const given = runs.filter((run) => run.interface && run.summary.interface);
  if (!given.length) return null;
  const figures = given.flatMap(
      (run) =>
          [passageFigure(run, given, "slip", "Slip of the interface over the passage", "µm"),
           passageFigure(run, given, "tau", "Shear of the interface over the passage", "MPa"),
  ]);
  return part(
      "interface",
      "The interface that slides",
      ...given.map((run) => answer(run, given)),
      element("div", {class: "grid"}, ...figures.map(frame)),
  );
}
