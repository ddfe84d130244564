// A crack under the wheel: stress intensities over the passage, and what it grows by at every depth.
import {element, note, part} from "../dom";

import {frame, type Figure} from "../figures";
import {numberText} from "../text";
import type {Run} from "./data";
import {linesFigure, type Series} from "./lines";
import {runLabel} from "./words";

const kLimits =
    "Linear fracture mechanics of a straight crack in one vertical plane: below some grains of steel (0.1 to " +
    "0.2 mm) it does not hold; branches, neighbours, mode III along the front, the wheel's dynamics and plastic " +
    "strain at the tip are not in it.";

const kWheel = "wheel from the crack's beginning [mm]";

const titled = (text: string, run: Run, runs: Run[]) => runs.length > 1 ? `${text}, ${runLabel(run)}` : text;

/// K_I and K_II over the wheel's place.
function passageFigure(run: Run, runs: Run[]): Figure {
  const passage = run.crack!.passage;
  const lines: [column: string, name: string][] = [["K_I_MPa_sqrt_m", "K_I"], ["K_II_MPa_sqrt_m", "K_II"]];
  return linesFigure({
    id: `crack-passage-${runs.indexOf(run)}`,
    title: titled("Stress intensities over the passage", run, runs),
    words: [
      "At the crack's end. The wheel comes from the left; at 0 it stands over the crack's beginning. K_I opens the " +
          "crack, K_II shears its faces.",
    ],
    labels: [kWheel, "K [MPa √m]"],
    names: ["wheel_mm", "K_MPa_sqrt_m"],
    series: lines.map(([column, name], k): Series => ({
                        name,
                        x: passage.wheel_mm,
                        y: passage[column],
                        colour: (t) => t.series[k],
                        hover: `wheel at %{x:.1f} mm\n${name} %{y:.2f} MPa √m`,
                      })),
  });
}

/// A crack along an interface has no growth.
const level = (run: Run) => run.summary.crack!.growth_m === null;

/// The energy release rate of one over the wheel's place.
function releaseFigure(run: Run, runs: Run[]): Figure|null {
  if (!level(run)) return null;
  const passage = run.crack!.passage;
  return linesFigure({
    id: `crack-release-${runs.indexOf(run)}`,
    title: titled("Energy release rate over the passage", run, runs),
    words: ["Of the end where it is larger."],
    labels: [kWheel, "G [J/m²]"],
    names: ["wheel_mm", "G_J_per_m2"],
    series: [{
      name: "G",
      x: passage.wheel_mm,
      y: passage.energy_release_J_per_m2,
      colour: (t) => t.series[0],
      hover: "wheel at %{x:.1f} mm\nG %{y:.3g} J/m²",
    }],
  });
}

/// Growth of the same crack, from shallow to deep.
function depthFigure(run: Run, runs: Run[]): Figure|null {
  const depths = run.crack!.depths;
  if (!depths) return null;
  const series: Series[] = [{
    name: "growth a wheel",
    x: depths.depth_mm,
    y: depths.growth_nm,
    colour: (t) => t.series[0],
    hover: "%{x:.2f} mm deep\n%{y:.3g} nm a wheel",
  }];
  const {growth_m: growth, depth_m: depth} = run.summary.crack!;
  if (growth !== null && depth !== null)
    series.push({
      name: "this case",
      x: [1e3 * depth],
      y: [1e9 * growth],
      markers: true,
      colour: (t) => t.ink,
      hover: "%{x:.2f} mm deep\n%{y:.3g} nm a wheel",
    });
  return linesFigure({
    id: `crack-depths-${runs.indexOf(run)}`,
    title: titled("Growth over the crack's depth", run, runs),
    words:
        ["Of a crack in the same direction that is shallower or deeper, along its own direction, by each such wheel."],
    labels: ["depth of the crack [mm]", "growth [nm a wheel]"],
    names: ["depth_mm", "growth_nm"],
    series,
  });
}

/// What a passage does to the crack, in a sentence.
function answer(run: Run, runs: Run[]): HTMLElement {
  const c = run.summary.crack!;
  const who = runs.length > 1 ? `${runLabel(run)}: ` : "";
  const ranges = `ΔK_I ${numberText(1e-6 * (c.K_I_range_Pa_sqrt_m ?? 0), 3)}, ΔK_II ` +
      `${numberText(1e-6 * (c.K_II_range_Pa_sqrt_m ?? 0), 3)} MPa √m`;
  const depth = `${numberText(1e3 * (c.depth_m ?? 0), 3)} mm deep`;
  if (level(run))
    return note(
        `${who}A crack along the interface ${depth} releases up to ${numberText(c.energy_release_J_per_m2 ?? 0, 3)} ` +
        `J/m² at a phase angle of ${numberText(180 / Math.PI * (c.phase_rad ?? 0), 3)}° (${ranges}).`);
  const grows = c.growth_m ? `grows by ${numberText(1e9 * c.growth_m, 3)} nm with each such wheel`
                           : "does not grow under such wheels";
  const down = `${numberText(180 / Math.PI * (c.azimuth_rad ?? 0), 3)}° from the direction of rolling`;
  return note(`${who}A crack ${depth} ${grows} (${ranges}); it goes down ${down}.`);
}

/// The part of the page, where a run's case has a crack.
export function crackPart(runs: Run[]): HTMLElement|null {
  const given = runs.filter((run) => run.crack && run.summary.crack);
  if (!given.length) return null;
  const figures = given.flatMap(
      (run) =>
          [passageFigure(run, given),
           releaseFigure(run, given),
           depthFigure(run, given),
  ]);
  return part(
      "crack",
      "The crack",
      ...given.map((run) => answer(run, given)),
      element("div", {class: "grid"}, ...figures.filter((f) => f !== null).map(frame)),
      note(kLimits),
  );
}
