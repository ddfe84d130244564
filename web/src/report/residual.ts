// What the wheel of a run leaves behind in a rail that yields: in words, over the section, with depth.
import {element, note} from "../dom";
import type {Figure} from "../figures";
import {fixedText, numberText} from "../text";
import type {Theme} from "../theme";
import type {Columns, Run} from "./data";
import {linesFigure, type Series} from "./lines";
import {residualMaps, type SectionHistory} from "./passes";
import {runLabel} from "./words";

const named = (run: Run, runs: Run[], words: string) => (runs.length > 1 ? `${runLabel(run)}: ${words}` : words);

/// Of the rail's layers, from the surface down.
function historyOf(run: Run, residual: Columns): SectionHistory {
  const layers = (run.geometry?.layers ?? []).filter((layer) => layer.on === "rail");
  const tops = [0];
  for (const layer of layers) tops.push(tops[tops.length - 1] + layer.thickness_m);
  const zones = tops.map((top_m, n) => ({name: layers[n]?.name ?? "rail", zone: n, top_m}));
  return {name: runLabel(run), residual, summary: {zones}};
}

function words(run: Run): string {
  const r = run.summary.residual;
  if (!r) return "";
  if (r.none) return `Residual stress not available: ${r.none}.`;
  const mpa = (v: number|undefined) => `${fixedText(1e-6 * (v ?? 0), 0)} MPa`;
  return `When the wheel has gone, the rail keeps residual stress: ${mpa(r.sigma_x_min_Pa)} along and ` +
      `${mpa(r.sigma_y_min_Pa)} across at the most compressive places. Along the stations that this is taken from, ` +
      `plastic strain differs by ${numberText(100 * (r.uneven ?? 0), 2)} % of its largest.`;
}

/// The column of elements with the largest plastic strain, from the surface down.
function columnOf({row, column, plastic_strain_accumulated}: Columns): number[] {
  const inZone = row.flatMap((r, i) => (r >= 0 ? [i] : []));
  if (!inZone.length) return [];
  const most = inZone.reduce((a, b) => (plastic_strain_accumulated[b] > plastic_strain_accumulated[a] ? b : a));
  return inZone.filter((i) => column[i] === column[most]).sort((a, b) => row[a] - row[b]);
}

const kLines: [column: string, name: string][] =
    [["sigma_xx_MPa", "σ_x"], ["sigma_yy_MPa", "σ_y"], ["sigma_xz_MPa", "τ_xz"]];

function profile(stories: SectionHistory[]): Figure {
  const several = stories.length > 1;
  const series = stories.flatMap((s, n) => {
    const at = columnOf(s.residual);
    return kLines.map(([column, name], k): Series => ({
                        x: at.map((i) => s.residual[column][i]),
                        y: at.map((i) => s.residual.depth_mm[i]),
                        name: several ? `${name}: ${s.name}` : name,
                        dash: several && k > 0 ? (k > 1 ? "dot" : "dash") : "solid",
                        colour: (t: Theme) => t.series[(several ? n : k) % t.series.length],
                        hover: `depth %{y:.2f} mm\n${name} %{x:.1f} MPa`,
                      }));
  });
  return linesFigure({
    id: "residual-profile",
    title: "Residual stress with depth",
    words: ["In the column of elements with the largest plastic strain. Lines across: borders of layers."],
    labels: ["residual stress [MPa]", "depth [mm]"],
    names: ["residual stress [MPa]", "depth_mm"],
    downwards: true,
    levels: [...new Set(stories.flatMap((s) => s.summary.zones!.slice(1).map((z) => 1e3 * z.top_m)))],
    height: 400,
    series,
  });
}

/// Sentences and figures; none of runs that are elastic or older.
export function residualOf(runs: Run[]): {told: HTMLElement[]; figures: Figure[]} {
  const yielding = runs.filter((run) => run.summary.plastic);
  const told = yielding.flatMap((run) => {
    const said = words(run);
    return said ? [element("p", {class: "residual"}, named(run, runs, said))] : [];
  });
  const stories = yielding.flatMap((run) => (run.residual ? [historyOf(run, run.residual)] : []));
  if (!stories.length) return {told, figures: []};
  const axes = note(
      "Residual stress: of an endless rail with the plastic strain of the steady stations behind the wheel, at rest. " +
      "y from the contact point to the field side, depth from the surface.");
  return {told: [...told, axes], figures: [...residualMaps(stories), profile(stories)]};
}
