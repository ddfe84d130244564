// Grids of verdicts: which of a study's cases last.
import type {GridCell, Grids, VerdictGrid} from "./data";
import {element, note} from "./dom";
import {axis, baseLayout, frame, type DataTable, type Figure, type Theme} from "./figures";
import {magnitudeColours} from "./maps";
import {allVerdicts, numberText, plotText} from "./text";

/// From the best verdict to the worst, told apart with any colour vision; the letters on them.
const kFills = ["#0072b2", "#56b4e9", "#f0e442", "#e6c27a", "#d55e00", "#7a1020", "#cc79a7", "#8a8f98"];
const kLetters = ["#ffffff", "#1b1f24", "#1b1f24", "#1b1f24", "#ffffff", "#ffffff", "#1b1f24", "#1b1f24"];
/// The last words of a verdict stand below the factor where a layer ends.
const kMarks: Record<string, string> = {
  "brittle layer cracks": "cracks",
  "interface shears": "shears"
};

const place = (c: GridCell) => allVerdicts().findIndex((v) => v.words === c.verdict);

/// Each colour as long as one step of the scale.
function scale(): [number, string][] {
  const n = kFills.length;
  return kFills.flatMap((c, k): [number, string][] => [[k / n, c], [(k + 1) / n, c]]);
}

/// The factor, and below it what else ends the layer.
function cellText(c: GridCell): string {
  const marks = c.fails_by.flatMap((words) => (kMarks[words] ? [kMarks[words]] : []));
  return [numberText(c.factor, 3), ...marks].join("<br>");
}

const hasMarks = (g: VerdictGrid) => g.cells.some((c) => c && c.fails_by.some((words) => kMarks[words]));

const shownCells = (g: VerdictGrid) => g.y.flatMap((_, j) => g.x.flatMap((_x, i) => {
  const c = g.cells[i + g.x.length * j];
  return c ? [{c, i, j}] : [];
}));

/// One value for all grids of a row has one colour.
function rangeOf(m: Grids): [number, number] {
  const all = m.grids.flatMap((g) => g.cells.flatMap((c) => (c && c.factor !== null ? [c.factor] : [])));
  return [Math.min(0, ...all), Math.max(...all)];
}

/// What a picture of cells takes from each: its number on a scale, its text, the colour of that, the words over it.
interface CellLook {
  z: (c: GridCell) => number | null;
  range: [low: number, high: number];
  colours: unknown;
  text: (c: GridCell) => string;
  letters: (c: GridCell) => string;
  words: (c: GridCell) => string;
}

/// Values on one scale for all grids of a row.
function lookOfValues(m: Grids): CellLook {
  const [low, high] = rangeOf(m);
  const light = (v: number|null) => v !== null && v > low + 0.6 * (high - low);
  return {
    z: (c) => c.factor,
    range: [low, high],
    colours: magnitudeColours(),
    text: (c) => numberText(c.factor, 3),
    letters: (c) => (light(c.factor) ? "#1b1f24" : "#ffffff"),
    words: (c) => `${plotText(m.value)} ${numberText(c.factor, 3)}`,
  };
}

function lookOfVerdicts(theme: Theme): CellLook {
  return {
    z: place,
    range: [-0.5, kFills.length - 0.5],
    colours: scale(),
    text: cellText,
    letters: (c) => kLetters[place(c)] ?? theme.ink,
    words: (c) => {
      const why = [c.verdict, ...c.fails_by.filter((words) => words !== c.verdict)].join("; ");
      return `<b>${why}</b><br>factor ${numberText(c.factor, 3)}`;
    },
  };
}

function dataOf(g: VerdictGrid, look: CellLook, theme: Theme): Record<string, unknown>[] {
  const shown = shownCells(g);
  const valueOf = (c: GridCell|null) => (c ? look.z(c) : null);
  return [
    {
      type: "heatmap",
      x: g.x.map((_, i) => i),
      y: g.y.map((_, j) => j),
      z: g.y.map((_, j) => g.x.map((_x, i) => valueOf(g.cells[i + g.x.length * j]))),
      zmin: look.range[0],
      zmax: look.range[1],
      colorscale: look.colours,
      showscale: false,
      xgap: 2,
      ygap: 2,
      hoverinfo: "skip",
    },
    {
      type: "scatter",
      mode: "text",
      x: shown.map(({i}) => i),
      y: shown.map(({j}) => j),
      text: shown.map(({c}) => look.text(c)),
      textfont: {color: shown.map(({c}) => look.letters(c)), size: theme.size + 1},
      customdata: shown.map(({c, i, j}) => `${plotText(g.x[i])}, ${plotText(g.y[j])}<br>${look.words(c)}`),
      hovertemplate: "%{customdata}<extra></extra>",
    },
  ];
}

function layoutOf(m: Grids, g: VerdictGrid, theme: Theme, width: number): Record<string, unknown> {
  const along = (title: string, values: string[]) => axis(theme, title, {
    tickmode: "array",
    tickvals: values.map((_, i) => i),
    ticktext: values.map(plotText),
    range: [-0.5, values.length - 0.5],
    showgrid: false,
    zeroline: false,
  });
  return {
    ...baseLayout(theme, width, Math.round(110 + (hasMarks(g) ? 48 : 34) * g.y.length)),
    margin: {l: 58, r: 12, t: 30, b: 46},
    xaxis: along(m.x, g.x),
    yaxis: along(m.y, g.y),
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
    draw: (theme, width) => ({
      data: dataOf(g, m.value ? lookOfValues(m) : lookOfVerdicts(theme), theme),
      layout: layoutOf(m, g, theme, width),
    }),
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
