// A wheel over heights of the rail or its own: first what it rolled over, then what that did.
import {element, note, part} from "../dom";

import {frame, type Figure} from "../figures";
import type {Span, Values} from "../types";
import type {Run} from "./data";
import {historyFigure, type HistoryChart} from "./history";
import {linesFigure, type Series} from "./lines";
import {runLabel} from "./words";

export const hasHeights = (run: Run): boolean => !!run.geometry?.heights && !!run.history;

const kBefore = 50;  // mm of the way before the first height

const placesColumn = (run: Run) => (run.history!.position_mm ? "position_mm" : "distance_mm");
export const placesOf = (run: Run): Values => run.history![placesColumn(run)];

/// From a little before the first height to the end.
function windowOf(run: Run): Span {
  const {x_mm, rail_um, wheel_um} = run.geometry!.heights!;
  const first = x_mm.findIndex((_, k) => rail_um[k] !== 0 || wheel_um[k] !== 0);
  return [Math.max(0, x_mm[Math.max(0, first)] - kBefore), x_mm[x_mm.length - 1]];
}

const several = (runs: Run[], run: Run, name: string) => (runs.length > 1 ? `${name}, ${runLabel(run)}` : name);
const kLabel = "position of the wheel [mm]";

function heights(runs: Run[], window: Span): Figure {
  const lineOf = (run: Run, name: string, y: number[], n: number): Series[] => y.some((v) => v !== 0) ? [{
    name: several(runs, run, name),
    x: run.geometry!.heights!.x_mm,
    y,
    colour: (t) => t.series[n % t.series.length],
    hover: "at %{x:.1f} mm\n%{y:.1f} µm",
  }]
                                                                                                      : [];
  const series = runs.flatMap((run, k) => {
    const h = run.geometry!.heights!;
    return [...lineOf(run, "rail", h.rail_um, 2 * k), ...lineOf(run, "wheel", h.wheel_um, 2 * k + 1)];
  });
  return linesFigure({
    id: "way-heights",
    title: "Heights below the axle",
    labels: [kLabel, "height [µm]"],
    names: ["x_mm", "height_um"],
    words: ["Positive out of the body; both close the gap between wheel and rail."],
    window,
    series,
    wide: true,
  });
}

const kForce: HistoryChart = {
  id: "way-force",
  title: "Vertical force F_z",
  label: "Vertical force F_z [kN]",
  column: "F_z_N",
  words: "On the wheel.",
  lines: [{column: "F_z_N", name: "Vertical force F_z", scale: 1e-3, hover: "%{y:.4g} kN"}],
};
const kPressure: HistoryChart = {
  id: "way-pressure",
  title: "Largest pressure",
  label: "Largest pressure [MPa]",
  column: "p_max_MPa",
  words: "Finite elements: of the nodes; it swings with every element that the wheel passes.",
  lines: [{column: "p_max_MPa", name: "Largest pressure", hover: "%{y:.4g} MPa"}],
};

/// Null of runs over even ways.
export function wayPart(runs: Run[]): HTMLElement|null {
  const given = runs.filter(hasHeights);
  if (!given.length) return null;
  const window = windowOf(given[0]);
  const forces = given.flatMap((run) => run.history!.F_z_N.map((v) => v ?? 0));
  const changes = Math.max(...forces) - Math.min(...forces) > 1e-3 * Math.max(...forces);
  const along = {column: placesColumn(given[0]), label: kLabel, hover: "wheel at %{x:.1f} mm"};
  const charts = [...(changes ? [kForce] : []), kPressure];
  const figures =
      [heights(given, window), ...charts.map((chart) => historyFigure(given, along, chart, {window, wide: true}))];
  return part(
      "way", "On the way", note("The pictures below are those of the wheel at the end of its way."),
      element("div", {class: "grid"}, ...figures.map(frame)));
}
