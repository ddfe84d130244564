// Figures: a frame with title, plot, words and buttons for picture and data. Every figure knows how to draw itself for
// a theme and a width, so that it can be drawn again when the theme changes or the page is printed.
import {paintChart, type Chart, type Curve, type Drawn} from "./chart";
import {download, element} from "./dom";
import {Looker} from "./look";
import {kLight, letters, type Theme} from "./theme";

export interface DataTable {
  names: string[];
  rows: (string|number|null)[][];
}
interface Framed {
  id: string;
  title: string;
  words?: (string|Node)[];
  controls?: HTMLElement[];
  wide?: boolean;
  table(): DataTable;
}
/// A chart; null: there is nothing to be shown yet.
export interface Plotted extends Framed {
  chart(theme: Theme, width: number): Chart|null;
}
/// By hand, into its frame.
export interface Painted extends Framed {
  paint(plot: HTMLElement, theme: Theme, width: number): void;
}
export type Figure = Plotted|Painted;

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
  keys: HTMLElement;  // the legend
  looker: Looker|null;
  drawn: Drawn|null;
}
const shown = new Map<string, Shown>();
let origin: string[] = [];
let lastTheme: Theme = kLight;

/// Lines at the head of every downloaded table.
export function setOrigin(lines: string[]): void { origin = lines; }

function tool(words: string, title: string, act: () => void): HTMLButtonElement {
  const button = element("button", {type: "button", class: "tool", title}, words);
  button.addEventListener("click", act);
  return button;
}

export function frame(figure: Figure): HTMLElement {
  const role = "chart" in figure ? "application" : "img";
  const plot = element("div", {class: "plot", id: `plot-${figure.id}`, role, "aria-label": figure.title});
  const one: Shown = {figure, plot, keys: element("div", {class: "keys"}), looker: null, drawn: null};
  shown.set(figure.id, one);
  const csv = tool(
      "CSV", "Save the numbers of this figure",
      () => download(`${figure.id}.csv`, csvText(figure.table(), [...origin, figure.title])));
  csv.dataset["csv"] = figure.id;
  const png = tool("PNG", "Save this figure as a picture", () => savePicture(one));
  png.dataset["png"] = figure.id;
  const tools = [...("chart" in figure ? lookTools(one) : []), png, csv];
  return element(
      "figure",
      {id: figure.id, class: figure.wide ? "wide" : ""},
      element(
          "div", {class: "head"}, element("h3", {}, figure.title), ...(figure.controls ?? []),
          element("div", {class: "tools"}, ...tools)),
      one.keys,
      plot,
      figure.words ? element("figcaption", {}, ...figure.words) : null,
  );
}

/// What makes a chart one that can be looked at closely.
function lookTools(one: Shown): HTMLElement[] {
  const looker = one.looker = new Looker(one.plot, () => one.drawn, () => {
    for (const button of tools) button.hidden = !looker.look.view;
    draw(one, lastTheme, one.plot.clientWidth);
  });
  one.plot.setAttribute(
      "aria-description",
      "Drag: a part large, double click: the whole again. Keys: arrows from " +
          "point to point, + and −, 0 for the whole, shift and arrows to move it.");
  const pan = tool("move", "Drag moves what is drawn large, and does not frame a part", () => {
    looker.pans = !looker.pans;
    pan.setAttribute("aria-pressed", String(looker.pans));
    one.plot.classList.toggle("pans", looker.pans);
  });
  pan.setAttribute("aria-pressed", "false");
  const whole = tool("whole", "Show the whole again (double click)", () => looker.whole());
  const tools = [pan, whole];
  for (const button of tools) button.hidden = true;  // while the whole is shown
  return tools;
}

/// Drops the figures inside an element.
export function forget(inside: HTMLElement): void {
  for (const [id, {plot}] of shown)
    if (inside.contains(plot)) shown.delete(id);
}

const kStrokes = {
  solid: "solid",
  dash: "dashed",
  dot: "dotted",
  dashdot: "dashed"
};

/// A curve in the legend: pressed it is not drawn, pressed again it is.
function keyOf(one: Shown, curve: Curve, k: number): HTMLElement {
  const {hidden} = one.looker!.look;
  const swatch = element("span", {class: curve.width === 0 ? "ring" : "stroke"});
  swatch.style.borderColor = curve.colour;
  swatch.style.borderTopStyle = kStrokes[curve.dash ?? "solid"];
  const there = !hidden.has(k);
  const key = element(
      "button", {type: "button", class: "key", "aria-pressed": String(there), title: "show or hide"}, swatch,
      curve.name);
  key.addEventListener("click", () => {
    if (there)
      hidden.add(k);
    else
      hidden.delete(k);
    one.looker!.forgetWords();
    draw(one, lastTheme, one.plot.clientWidth);
    one.keys.querySelectorAll("button")[[...one.keys.children].indexOf(key)]?.focus();
  });
  return key;
}

const inLegend = ({chart}: Drawn) =>
    (chart.legend ? chart.curves.flatMap((c, k) => (c.quiet ? [] : [[c, k] as const])) : []);

function draw(one: Shown, theme: Theme, space: number): void {
  const {figure, plot} = one;
  if (space <= 0) return;  // folded away: drawn when it is opened
  if ("paint" in figure) return figure.paint(plot, theme, space);
  const chart = figure.chart(theme, space);
  if (!chart) return;
  one.drawn = paintChart(plot, chart, theme, space, one.looker!.look);
  (plot as HTMLElement & {drawn?: Drawn}).drawn = one.drawn;  // for who asks the page from outside
  const focused = [...one.keys.children].indexOf(document.activeElement!);
  one.keys.replaceChildren(...inLegend(one.drawn).map(([curve, k]) => keyOf(one, curve, k)));
  if (focused >= 0) (one.keys.children[focused] as HTMLElement | undefined)?.focus();
}

/// Draws everything on the page; `width` for print, else what the frame offers.
export function drawAll(theme: Theme, width?: (wide: boolean) => number): void {
  lastTheme = theme;
  for (const one of shown.values()) {
    one.looker?.forgetWords();
    // where it is folded away print has no room for it either
    const space = one.plot.clientWidth;
    draw(one, theme, space > 0 && width ? width(one.figure.wide ?? false) : space);
  }
}

/// Draws a figure again whose values have changed.
export function redraw(id: string): void {
  const one = shown.get(id);
  if (one) draw(one, lastTheme, one.plot.clientWidth);
}

// ---- pictures

/// Words on lines that fit into a width.
function wrapped(c: CanvasRenderingContext2D, texts: string[], apart: string, width: number): string[][] {
  const lines: string[][] = [[]];
  for (const text of texts) {
    const line = lines[lines.length - 1];
    if (line.length && c.measureText([...line, text].join(apart)).width > width)
      lines.push([text]);
    else
      line.push(text);
  }
  return lines;
}

/// The figure with its title and legend on paper, twice as fine as the page.
function picture(one: Shown): HTMLCanvasElement {
  const plot = one.plot.querySelector("canvas")!;
  const width = parseFloat(plot.style.width);
  const out = element("canvas");
  const c = out.getContext("2d")!;
  const dense = plot.width / width;
  const keys = one.drawn ? inLegend(one.drawn).filter(([, k]) => !one.looker!.look.hidden.has(k)) : [];
  c.font = letters(14, "600");
  const title = wrapped(c, one.figure.title.split(" "), " ", width - 20);
  c.font = letters(12);
  const legend = wrapped(c, keys.map(([curve]) => curve.name), "          ", width - 30);
  const top = 12 + 19 * title.length + (keys.length ? 18 * legend.length : 0);
  [out.width, out.height] = [plot.width, Math.round(dense * top) + plot.height];
  c.setTransform(dense, 0, 0, dense, 0, 0);
  c.fillStyle = lastTheme.paper;
  c.fillRect(0, 0, width, out.height / dense);
  c.fillStyle = lastTheme.ink;
  c.textBaseline = "middle";
  c.font = letters(14, "600");
  title.forEach((words, k) => c.fillText(words.join(" "), 10, 16 + 19 * k));
  c.font = letters(12);
  let next = 0;
  legend.forEach((names, row) => {
    let x = 10;
    for (const name of names) {
      const y = 14 + 19 * title.length + 18 * row;
      c.fillStyle = keys[next++][0].colour;
      c.fillRect(x, y - 1, 16, 2.5);
      c.fillStyle = lastTheme.ink;
      c.fillText(name, x + 21, y);
      x += 21 + c.measureText(`${name}     `).width;
    }
  });
  c.setTransform(1, 0, 0, 1, 0, 0);
  c.drawImage(plot, 0, Math.round(dense * top));
  return out;
}

function savePicture(one: Shown): void {
  if (!one.plot.querySelector("canvas")) return;
  picture(one).toBlob((blob) => blob && download(`${one.figure.id}.png`, blob), "image/png");
}
