// Grids of verdicts: which of a study's cases last.
import type {Axis} from "../axes";
import type {Chart} from "../chart";
import {element, note} from "../dom";
import {frame, type DataTable, type Figure} from "../figures";
import {kindScale, magnitudeScale, type Scale} from "../scale";
import {numberText} from "../text";
import type {Theme} from "../theme";
import type {GridCell, Grids, VerdictGrid} from "./data";
import {allVerdicts} from "./words";

/// From the best verdict to the worst, told apart with any colour vision; the letters on them.
const kFills = ["#0072b2", "#56b4e9", "#f0e442", "#e6c27a", "#d55e00", "#7a1020", "#cc79a7", "#8a8f98"];
const kLetters = ["#ffffff", "#1b1f24", "#1b1f24", "#1b1f24", "#ffffff", "#ffffff", "#1b1f24", "#1b1f24"];
/// The last words of a verdict stand below the factor where a layer ends.
const kMarks: Record<string, string> = {
  "brittle layer cracks": "cracks",
  "interface shears": "shears"
};

const place = (c: GridCell) => allVerdicts().findIndex((v) => v.words === c.verdict);

/// The factor, and below it what else ends the layer.
function cellLines(c: GridCell): string[] {
  const marks = c.fails_by.flatMap((words) => (kMarks[words] ? [kMarks[words]] : []));
  return [numberText(c.factor, 3), ...marks];
}

const hasMarks = (g: VerdictGrid) => g.cells.some((c) => c && c.fails_by.some((words) => kMarks[words]));

/// One value for all grids of a row has one colour.
function rangeOf(m: Grids): [number, number] {
  const all = m.grids.flatMap((g) => g.cells.flatMap((c) => (c && c.factor !== null ? [c.factor] : [])));
  return [Math.min(0, ...all), Math.max(...all)];
}

/// What a picture of cells takes from each: its number on a scale, its text, the colour of that, the words over it.
interface CellLook {
  z: (c: GridCell) => number | null;
  scale: Scale;
  lines: (c: GridCell) => string[];
  letters: (c: GridCell) => string;
  words: (c: GridCell) => string;
}

/// Values on one scale for all grids of a row.
function lookOfValues(m: Grids): CellLook {
  const [low, high] = rangeOf(m);
  const {colour} = magnitudeScale(1);
  const share = (v: number) => (v - low) / (high - low || 1);
  return {
    z: (c) => c.factor,
    scale: {range: [low, high], colour: (v, theme) => colour(share(v), theme)},
    lines: (c) => [numberText(c.factor, 3)],
    letters: (c) => (c.factor !== null && share(c.factor) > 0.6 ? "#1b1f24" : "#ffffff"),
    words: (c) => `${m.value} ${numberText(c.factor, 3)}`,
  };
}

function lookOfVerdicts(theme: Theme): CellLook {
  return {
    z: place,
    scale: kindScale(0, kFills.length, () => kFills),
    lines: cellLines,
    letters: (c) => kLetters[place(c)] ?? theme.ink,
    words: (c) => {
      const why = [c.verdict, ...c.fails_by.filter((words) => words !== c.verdict)].join("; ");
      return `${why}\nfactor ${numberText(c.factor, 3)}`;
    },
  };
}

function chartOf(m: Grids, g: VerdictGrid, look: CellLook): Chart {
  const cell = (i: number, j: number) => g.cells[i + g.x.length * j];
  const axis = (title: string, names: string[]): Axis => ({title, names, range: [-0.5, names.length - 0.5]});
  const places = (names: string[]) => names.map((_, k) => k);
  return {
    x: axis(m.x, g.x),
    y: axis(m.y, g.y),
    height: 34 + (hasMarks(g) ? 48 : 34) * g.y.length,
    curves: [],
    cells: {
      x: [-0.5, ...places(g.x).map((k) => k + 0.5)],
      y: [-0.5, ...places(g.y).map((k) => k + 0.5)],
      at: {x: places(g.x), y: places(g.y)},
      z: g.y.map((_, j) => g.x.map((_x, i) => {
        const c = cell(i, j);
        return c ? look.z(c) : null;
      })),
      scale: look.scale,
      gap: 2,
      words: (i, j) => `${g.x[i]}, ${g.y[j]}\n${look.words(cell(i, j)!)}`,
      letters: (i, j) => {
        const c = cell(i, j);
        return c && {lines: look.lines(c), colour: look.letters(c)};
      },
    },
  };
}

function tableOf(m: Grids, g: VerdictGrid): DataTable {
  const rows = g.y.flatMap((y, j) => g.x.flatMap((x, i) => {
    const c = g.cells[i + g.x.length * j];
    return c ? [[x, y, c.fails_by.join("; ") || c.verdict, c.factor]] : [];
  }));
  if (m.value) return {names: [m.x, m.y, m.value], rows: rows.map(([x, y, , v]) => [x, y, v])};
  return {names: [m.x, m.y, "verdict", "shakedown_wandering"], rows};
}

function gridFigure(m: Grids, g: VerdictGrid, n: number): Figure {
  return {
    id: `${m.id}-${n + 1}`,
    title: g.name,
    chart: (theme) => chartOf(m, g, m.value ? lookOfValues(m) : lookOfVerdicts(theme)),
    table: () => tableOf(m, g),
  };
}

/// The verdicts that a row has, with their colours.
function legend(m: Grids): HTMLElement {
  const seen = new Set(m.grids.flatMap((g) => g.cells.flatMap((c) => (c ? [c.verdict] : []))));
  const words = allVerdicts().flatMap((v, k) => {
    if (!seen.has(v.words)) return [];
    const swatch = element("span", {class: "swatch", style: `background: ${kFills[k]}`});
    return [element("span", {class: "entry", title: v.means}, swatch, v.words)];
  });
  return element("p", {class: "note legend"}, ...words);
}

export function gridsRow(m: Grids): HTMLElement[] {
  const figures = m.grids.map((g, n) => frame(gridFigure(m, g, n)));
  const words = m.note ? [note(m.note)] : [];
  const row = element("h3", {class: "row"}, m.title);
  const key = m.value ? note(`In the cells: ${m.value}.`) : legend(m);
  return [row, ...words, key, element("div", {class: "grid small"}, ...figures)];
}
