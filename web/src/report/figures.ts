// Figures: a frame with title, plot, words and a button for the data. Every figure knows how to draw itself for a theme
// and a width, so that it can be drawn again when the theme changes or the page is printed.
import Plotly from "plotly.js/lib/core";
import heatmap from "plotly.js/lib/heatmap";

import {download, element} from "./dom";
import {plotText} from "./text";

Plotly.register([heatmap]);

export interface Theme {
  ink: string;
  soft: string;
  grid: string;
  paper: string;
  series: string[];   // runs, in order
  reference: string;  // theory
  stick: string;
  slip: string;
  size: number;  // of letters
}

// Okabe and Ito's colours, told apart with any colour vision; brighter on dark paper.
export const kLight: Theme = {
  ink: "#1b1f24",
  soft: "#59636e",
  grid: "#dfe3e8",
  paper: "#ffffff",
  reference: "#59636e",
  stick: "#0072b2",
  slip: "#e69f00",
  size: 12,
  series: ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#7a6400", "#56b4e9"],
};
export const kDark: Theme = {
  ink: "#e6e9ed",
  soft: "#a3adb8",
  grid: "#343b44",
  paper: "#16191d",
  reference: "#a3adb8",
  stick: "#3b9edb",
  slip: "#f0b22a",
  size: 12,
  series: ["#56b4e9", "#f28b3c", "#3fcf9f", "#e59bc5", "#d8c23f", "#9fd0f0"],
};

export interface Drawing {
  data: Record<string, unknown>[];
  layout: Record<string, unknown>;
}
export interface DataTable {
  names: string[];
  rows: (string|number|null)[][];
}
interface Framed {
  id: string;
  title: string;
  words?: (string|Node)[];
  wide?: boolean;
  table(): DataTable;
}
/// By Plotly.
export interface Plotted extends Framed {
  draw(theme: Theme, width: number): Drawing;
}
/// By hand, into its frame.
export interface Painted extends Framed {
  paint(plot: HTMLElement, theme: Theme, width: number): void;
}
export type Figure = Plotted|Painted;

const kFont = 'system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';

/// Axes, fonts and colours that all figures share.
export function baseLayout(theme: Theme, width: number, height: number): Record<string, unknown> {
  return {
    width,
    height,
    paper_bgcolor: theme.paper,
    plot_bgcolor: theme.paper,
    font: {family: kFont, size: theme.size, color: theme.ink},
    margin: {l: 58, r: 16, t: 12, b: 44},
    hoverlabel: {font: {family: kFont, size: 12}},
    legend: {orientation: "h", x: 0, y: 1.02, yanchor: "bottom", font: {size: theme.size}},
    modebar: {bgcolor: "rgba(0,0,0,0)", color: theme.soft, activecolor: theme.ink},
    showlegend: false,
  };
}

export function axis(theme: Theme, title: string, more: Record<string, unknown> = {}): Record<string, unknown> {
  return {
    title: {text: plotText(title), standoff: 6},
    gridcolor: theme.grid,
    zerolinecolor: theme.grid,
    linecolor: theme.soft,
    tickcolor: theme.soft,
    exponentformat: "power",
    ticks: "outside",
    ticklen: 4,
    showline: true,
    automargin: true,
    ...more,
  };
}

function csvCell(v: string|number|null): string {
  if (v === null) return "";
  if (typeof v === "number") return String(Number(v.toPrecision(7)));
  return /[",\n]/.test(v) ? `"${v.replace(/"/g, '""')}"` : v;
}

export function csvText(table: DataTable, head: string[]): string {
  const comments = head.map((h) => `# ${h}`);
  const rows = table.rows.map((row) => row.map(csvCell).join(","));
  return [...comments, table.names.join(","), ...rows].join("\n") + "\n";
}

interface Shown {
  figure: Figure;
  plot: HTMLElement;
}
const shown = new Map<string, Shown>();
let origin: string[] = [];

/// Lines at the head of every downloaded table.
export function setOrigin(lines: string[]): void { origin = lines; }

export function frame(figure: Figure): HTMLElement {
  const plot = element("div", {class: "plot", id: `plot-${figure.id}`, role: "img", "aria-label": figure.title});
  const attributes = {type: "button", class: "csv", title: "Save the numbers of this figure", "data-csv": figure.id};
  const button = element("button", attributes, "CSV");
  const save = () => download(`${figure.id}.csv`, csvText(figure.table(), [...origin, figure.title]));
  button.addEventListener("click", save);
  shown.set(figure.id, {figure, plot});
  return element(
      "figure",
      {id: figure.id, class: figure.wide ? "wide" : ""},
      element("div", {class: "head"}, element("h3", {}, figure.title), button),
      plot,
      figure.words ? element("figcaption", {}, ...figure.words) : null,
  );
}

/// Drops the figures inside an element.
export function forget(inside: HTMLElement): void {
  for (const [id, {figure, plot}] of shown) {
    if (!inside.contains(plot)) continue;
    if ("draw" in figure) Plotly.purge(plot as never);
    shown.delete(id);
  }
}

/// An axis title on two lines where one is longer than its axis: broken at a comma, or at a space near the middle.
function brokenTitle(text: string, room: number): string {
  const letter = 6.3;  // px, of the mean letter of a title
  if (letter * text.length <= room || text.includes("<br>")) return text;
  const middle = 0.5 * text.length;
  const places = [...text.matchAll(/, | /g)].map((m) => ({at: m.index + m[0].length, comma: m[0].length > 1}));
  const cost = (place: {at: number; comma: boolean}) => Math.abs(place.at - middle) - (place.comma ? 8 : 0);
  const best = places.sort((a, b) => cost(a) - cost(b))[0];
  return best ? `${text.slice(0, best.at).trimEnd()}<br>${text.slice(best.at)}` : text;
}

type Titled = {
  title?: {text: string}
}|undefined;

/// Long titles of axes on a narrow page.
function fitTitles(layout: Record<string, unknown>): void {
  const margin = {l: 58, r: 16, t: 12, b: 44, ...(layout.margin as Record<string, number>)};
  const room = {
    xaxis: (layout.width as number) - margin.l - margin.r,
    yaxis: (layout.height as number) - margin.t - margin.b
  };
  for (const name of ["xaxis", "yaxis"] as const) {
    const title = (layout[name] as Titled)?.title;
    if (!title) continue;
    const text = brokenTitle(title.text, room[name]);
    if (text === title.text) continue;
    title.text = text;
    layout.margin = {...margin, ...(name === "xaxis" ? {b: margin.b + 16} : {l: margin.l + 14})};
    if (name === "xaxis") layout.height = (layout.height as number) + 16;
  }
}

function draw({figure, plot}: Shown, theme: Theme, space: number): void {
  if (space <= 0) return;  // folded away: drawn when it is opened
  if ("paint" in figure) return figure.paint(plot, theme, space);
  const {data, layout} = figure.draw(theme, space);
  fitTitles(layout);
  void Plotly.react(plot as never, data as never, layout as never, {
    displaylogo: false,
    showSendToCloud: false,
    plotlyServerURL: "",
    modeBarButtons: [["zoom2d", "pan2d", "resetScale2d", "toImage"]],
    toImageButtonOptions: {format: "png", scale: 2, filename: figure.id},
  } as never);
}

let lastTheme: Theme = kLight;

/// Draws everything on the page; `width` for print, else what the frame offers.
export function drawAll(theme: Theme, width?: (wide: boolean) => number): void {
  lastTheme = theme;
  for (const one of shown.values()) draw(one, theme, width ? width(one.figure.wide ?? false) : one.plot.clientWidth);
}

/// Draws a figure again whose values have changed.
export function redraw(id: string): void {
  const one = shown.get(id);
  if (one) draw(one, lastTheme, one.plot.clientWidth);
}
