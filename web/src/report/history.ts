// What happened on the way: charts of a history. Those of a transient stand in transient.ts.
import type {Dash} from "../chart";
import type {Figure} from "../figures";
import type {Span} from "../types";
import {option, type Run} from "./data";
import {linesFigure, type LinesSpec, type Series} from "./lines";
import {runLabel} from "./words";

export interface HistoryLine {
  column: string;
  name: string;
  scale?: number;
  hover: string;
}

export interface HistoryChart {
  id: string;
  title: string;
  label: string;
  column: string;
  words: string;
  lines: HistoryLine[];
  leastSpan?: number;
}

const kHistory: HistoryChart[] = [
  {
    id: "history-forces",
    title: "Forces on the wheel",
    label: "force [kN]",
    column: "force_kN",
    words: "F_z carries the weight, F_x drives.",
    lines: [
      {column: "F_z_N", name: "F_z", scale: 1e-3, hover: "F_z %{y:.2f} kN"},
      {column: "F_x_N", name: "F_x", scale: 1e-3, hover: "F_x %{y:.2f} kN"},
      {column: "F_y_N", name: "F_y", scale: 1e-3, hover: "F_y %{y:.2f} kN"},
    ],
  },
  {
    id: "history-p",
    title: "Largest pressure",
    label: "p_max [MPa]",
    column: "p_max_MPa",
    words: "Of the nodes, before the peak between them is interpolated: " +
        "it swings with every element that the wheel passes.",
    lines: [{column: "p_max_MPa", name: "p_max", hover: "p_max %{y:.1f} MPa"}],
    leastSpan: 0.2,
  },
  {
    id: "history-creepage",
    title: "Longitudinal creepage",
    label: "creepage [10⁻³]",
    column: "creepage_1e-3",
    words: "Negative while the wheel drives.",
    lines: [{column: "creepage", name: "creepage", scale: 1e3, hover: "creepage %{y:.3f} × 10⁻³"}],
  },
  {
    id: "history-energy",
    title: "Energies",
    label: "energy [J]",
    column: "energy_J",
    words: "Stored, lost and damped. The work of the torque and the kinetic energy it turns into are hundreds of " +
        "times larger; they are in history.csv.",
    lines: [
      {column: "strain_J", name: "strain", hover: "%{y:.3f} J"},
      {column: "friction_J", name: "friction", hover: "%{y:.3f} J"},
      {column: "run_up_damping_J", name: "run-up damping", hover: "%{y:.3f} J"},
      {column: "hourglass_J", name: "hourglass", hover: "%{y:.3f} J"},
      {column: "absorbed_J", name: "absorbed at the rail’s ends", hover: "%{y:.3f} J"},
    ],
  },
  {
    id: "history-closure",
    title: "Energy closure",
    label: "closure [mJ]",
    column: "closure_mJ",
    words: "Sum of all energies and works since the start; exact time steps would keep it zero.",
    lines: [{column: "closure_J", name: "closure", scale: 1e3, hover: "%{y:.4f} mJ"}],
  },
  {
    id: "history-penetration",
    title: "Penetration",
    label: "penetration [nm]",
    column: "penetration_nm",
    words: "Largest overlap of the two surfaces.",
    lines: [{column: "penetration_um", name: "penetration", scale: 1e3, hover: "%{y:.3f} nm"}],
  },
  {
    id: "history-patch",
    title: "Patch on its way",
    label: "size [mm]",
    column: "size_mm",
    words:
        "The longest chords along and across. Where the wheel bridges a hollow the length goes from the first part " +
        "of the patch to the last.",
    lines: [
      {column: "patch_length_mm", name: "length", hover: "length %{y:.2f} mm"},
      {column: "patch_width_mm", name: "width", hover: "width %{y:.2f} mm"},
    ],
  },
  {
    id: "history-stress",
    title: "Largest stress of the rail on its way",
    label: "von Mises [MPa]",
    column: "von_mises_MPa",
    words: "At the centres of the elements around the wheel; history.csv has its place.",
    lines: [{column: "von_mises_MPa", name: "von Mises", hover: "%{y:.0f} MPa"}],
  },
  {
    id: "history-interface",
    title: "A layer that has come off",
    label: "opening, slip [µm]",
    column: "interface_um",
    words:
        "The largest of the pairs of nodes on the unbonded interface: how far the layer has lifted, and how far it " +
        "has slid on its base.",
    lines: [
      {column: "interface_opening_um", name: "opening", hover: "opening %{y:.3f} µm"},
      {column: "interface_slip_um", name: "slip", hover: "slip %{y:.2f} µm"},
    ],
  },
];

/// What the charts of a history have along x, with its words for axis and table.
export interface Along {
  column: string;
  label: string;
  hover: string;
}

const kPosition: Along = {
  column: "position_mm",
  label: "position of the wheel [mm]",
  hover: "wheel at %{x:.1f} mm"
};

/// One run: a colour a line; two: a colour a run, dots for all lines but the first.
function historySeries(runs: Run[], lines: HistoryLine[], along: Along): Series[] {
  const several = runs.length > 1;
  const seriesOf = (run: Run, n: number, {column, name, scale = 1, hover}: HistoryLine, k: number): Series => ({
    name: several ? `${name}, ${runLabel(run)}` : name,
    x: run.history![along.column],
    y: run.history![column].map((v) => (v === null ? null : scale * v)),
    colour: (t) => t.series[(several ? n : k) % t.series.length],
    dash: several && k > 0 ? "dot" : "solid",
    hover: `${along.hover}\n${hover}`,
  });
  return runs.flatMap((run, n) => lines.map((line, k) => seriesOf(run, n, line, k)));
}

export function historyFigure(runs: Run[], along: Along, chart: HistoryChart, more: Partial<LinesSpec> = {}): Figure {
  return linesFigure({
    id: chart.id,
    title: chart.title,
    labels: [along.label, chart.label],
    names: [along.column, chart.column],
    leastSpan: chart.leastSpan,
    words: [chart.words],
    series: historySeries(runs, chart.lines, along),
    ...more,
  });
}

/// The window over which the results are averaged, mm.
function averagedOver(run: Run): Span|undefined {
  const position = 1e3 * (run.summary.position_m ?? NaN);
  const half = 0.5 * parseFloat(option(run, "run", "window") ?? "NaN");
  return Number.isFinite(position) && half > 0 ? [position - half, position + half] : undefined;
}

/// What happened on the way: forces, pressure, creepage, energy.
export function historyFigures(runs: Run[]): Figure[] {
  const given = runs.filter((run) => run.history);
  if (!given.length || !given[0].history!.position_mm) return [];
  const band = averagedOver(given[0]);
  const shaded = band ? " Shaded: the window over which the results are averaged." : "";
  const figure = (chart: HistoryChart, n: number) =>
      historyFigure(given, kPosition, chart, {band, words: [chart.words + (n === 0 ? shaded : "")]});
  const has = (chart: HistoryChart) => given.every((run) => run.history![chart.lines[0].column]);
  return [
    ...kHistory.filter(has).map(figure), ...spectrumFigures(given.filter((run) => run.spectrum)),
    ...given.flatMap((run) => run.points ? [pointsFigure(run, given)] : [])
  ];
}

/// The wheel force by frequency.
function spectrumFigures(runs: Run[]): Figure[] {
  if (!runs.length) return [];
  const series = runs.map((run, n): Series => ({
                            name: runs.length > 1 ? runLabel(run) : "F_z",
                            x: run.spectrum!.frequency_Hz,
                            y: run.spectrum!.F_z_amplitude_kN,
                            colour: (t) => t.series[n % t.series.length],
                            hover: "%{x:.0f} Hz\n%{y:.2f} kN",
                          }));
  return [linesFigure({
    id: "force-spectrum",
    title: "Wheel force by frequency",
    labels: ["frequency [Hz]", "amplitude of F_z [kN]"],
    names: ["frequency_Hz", "F_z_amplitude_kN"],
    words: ["From the end of the run-up on, with Hann\u2019s weights; force_spectrum.csv has the wavelengths."],
    series,
  })];
}

const kColours = 6;
const kDashes: Dash[] = ["solid", "dash", "dot"];

/// Stress at the points where the rail changes, while the wheel passes them.
function pointsFigure(run: Run, given: Run[]): Figure {
  const series = run.points!.map((p, k): Series => ({
                                   name: `x ${p.x_mm.toFixed(1)} mm, ${p.depth_mm.toFixed(1)} mm deep`,
                                   x: p.position_mm,
                                   y: p.von_mises_MPa,
                                   colour: (t) => t.series[k % t.series.length],
                                   dash: kDashes[Math.floor(k / kColours) % kDashes.length],
                                   hover: `${kPosition.hover}\n%{y:.0f} MPa`,
                                 }));
  return linesFigure({
    id: given.length > 1 ? `history-points-${given.indexOf(run)}` : "history-points",
    title: given.length > 1 ? `Where the rail changes, ${runLabel(run)}` : "Where the rail changes",
    labels: [kPosition.label, "von Mises [MPa]"],
    names: [kPosition.column, "von_mises_MPa"],
    words:
        ["At the centres of elements beside the ends of layers, at stretches and irregularities, under the " +
         "middle of the wheel\u2019s strip; points_history.csv has all components."],
    series,
  });
}
