// The first pictures of a page: what presses, what drags, what slips, and what it does to the bodies in their own
// shape.
import {drawAxes} from "../axes";
import {
  canvasIn,
  drawArrow,
  drawBar,
  drawCross,
  drawRolling,
  paintPieces,
  planeFor,
  px,
  py,
  wordsAt,
  wordsUnderPointer,
  type Piece,
  type Plane
} from "../canvas";
import {element} from "../dom";
import {columnEdges} from "../edges";
import {frame, type DataTable, type Painted} from "../figures";
import {magnitudeScale, rgb, stateScale, type Scale} from "../scale";
import {fixedText} from "../text";
import type {Theme} from "../theme";
import type {BodyName, Values} from "../types";
import {contours} from "./contours";
import {rowsOf, unpack, type Run} from "./data";
import {
  contactY,
  hasTraction,
  kAboutArrows,
  largest,
  levelsOf,
  patchesOf,
  patchWindow,
  stateLegend,
  tractionArrows,
  type Patch
} from "./patch";
import {cellsBelow, layerWords, paintSection} from "./profile";

const kHighest = 300;  // px, of a picture's plane

// ---- the patch

function cellsOf(
    p: Plane, patch: Patch, values: Values[], colour: (v: number) => string, words: (v: number) => string): Piece[] {
  const [x, y] = [columnEdges(patch.x), columnEdges(patch.y)];
  return values.flatMap((row, j) => row.flatMap((v, i): Piece[] => {
    if (v === null) return [];
    const [left, right, low, high] = [px(p, x[i]), px(p, x[i + 1]), py(p, y[j]), py(p, y[j + 1])];
    const place = `x ${fixedText(patch.x[i], 2)}, y ${fixedText(patch.y[j], 2)} mm`;
    return [{
      corners: [[left, low], [right, low], [right, high], [left, high]],
      colour: colour(v),
      words: `${place}: ${words(v)}`,
    }];
  }));
}

interface PatchPicture {
  id: string;
  title: string;
  column: string;
  values: (p: Patch) => Values[];
  scale: Scale;
  bar?: string;  // unit
  words: (v: number) => string;
  levels?: number[];  // of lines of equal value
  arrows?: number;    // of the largest traction
  about: (string|Node)[];
}

/// Lines of equal value over the coloured cells.
function drawContours(
    c: CanvasRenderingContext2D, p: Plane, patch: Patch, values: Values[], levels: number[], theme: Theme): void {
  c.strokeStyle = theme.ink;
  c.lineWidth = 1.2;
  c.beginPath();
  for (const line of contours(patch.x, patch.y, values, levels))
    for (let k = 0; k + 1 < line.x.length; ++k) {
      const [[x0, y0], [x1, y1]] = [k, k + 1].map((i) => [line.x[i], line.y[i]]);
      if (x0 === null || y0 === null || x1 === null || y1 === null) continue;
      c.moveTo(px(p, x0), py(p, y0));
      c.lineTo(px(p, x1), py(p, y1));
    }
  c.stroke();
}

function patchPicture(patches: Patch[], what: PatchPicture): Painted {
  const [x, y] = patchWindow(patches);
  const paint = (host: HTMLElement, theme: Theme, width: number) => {
    const {plane, height} = planeFor(width, x, y, kHighest);
    const c = canvasIn(host, width, height);
    const pieces = patches.flatMap(
        (patch) => cellsOf(plane, patch, what.values(patch), (v) => rgb(what.scale.colour(v, theme)), what.words));
    paintPieces(c, pieces);
    const levels = what.levels;
    if (levels) patches.forEach((patch) => drawContours(c, plane, patch, what.values(patch), levels, theme));
    if (what.arrows)
      for (const a of patches.flatMap((patch) => tractionArrows(patch, [x, y], what.arrows!)))
        drawArrow(
            c, [px(plane, a.x), py(plane, a.y)], [px(plane, a.x + a.alongX), py(plane, a.y + a.alongY)], "#ffffff", 1.3,
            "#1b1f24");
    patches.forEach((patch, k) => drawCross(c, px(plane, 0), py(plane, contactY(patch.run, k) - contactY(patch.run))));
    drawAxes(c, plane, theme, [{title: "x [mm]", range: x}, {title: "y, field side up [mm]", range: y}]);
    drawRolling(c, plane, theme);
    if (what.bar) drawBar(c, plane, theme, what.scale, what.bar);
    wordsUnderPointer(host, (place) => wordsAt(pieces, place));
  };
  const rows =
      patches.flatMap((p) => p.y.flatMap((y, j) => p.x.map((x, i): (number|null)[] => [x, y, what.values(p)[j][i]])));
  const table = (): DataTable => ({names: ["x_mm", "y_mm", what.column], rows});
  return {id: what.id, title: what.title, words: what.about, paint, table};
}

const kAboutSeveral = "Crosses: the places of the patches, the weighted middles of the overlaps; " +
    "y counts from that of patch 1, the largest pressure’s.";

/// All in one frame: y from the place of the first patch.
function patchesTogether(run: Run): Patch[] {
  return patchesOf(run).map((patch, k) => {
    const shift = contactY(run, k) - contactY(run);
    return {...patch, y: patch.y.map((y) => y + shift)};
  });
}

function patchPictures(run: Run): Painted[] {
  const patches = patchesTogether(run);
  const [p, q] = [largest(patches, (patch) => patch.p), largest(patches, (patch) => patch.q)];
  const pressure = patchPicture(patches, {
    id: "hero-p",
    title: "Pressure",
    column: "p_MPa",
    values: (patch) => patch.p,
    scale: magnitudeScale(p),
    levels: levelsOf(p),
    bar: "MPa",
    words: (v) => `p ${v.toFixed(1)} MPa`,
    about:
        [patches.length > 1 ? kAboutSeveral
                            : "The cross marks the place of the patch, the weighted middle of the overlap."],
  });
  if (!hasTraction([run])) return [pressure];
  const traction = patchPicture(patches, {
    id: "hero-q",
    title: "Traction",
    column: "q_MPa",
    values: (patch) => patch.q,
    scale: magnitudeScale(q),
    levels: levelsOf(q),
    bar: "MPa",
    words: (v) => `|q| ${v.toFixed(1)} MPa`,
    arrows: q,
    about: [kAboutArrows],
  });
  const states = patchPicture(patches, {
    id: "hero-state",
    title: "Stick and slip",
    column: "state_1stick_2slip",
    values: (patch) => patch.state,
    scale: stateScale,
    words: (v) => (v === 2 ? "slip" : "stick"),
    about: [stateLegend(patches.flatMap((patch) => patch.state))],
  });
  return [pressure, traction, states];
}

// ---- the section on the profiles

function planeWords(run: Run): string {
  const x = (body: BodyName) => fixedText(run.sections[body]?.cross.at ?? 0, 2);
  if (!run.sections.wheel) return `Rail at x = ${x("rail")} mm`;
  return x("rail") === x("wheel") ? `At x = ${x("rail")} mm`
                                  : `Rail at x = ${x("rail")}, wheel at x = ${x("wheel")} mm`;
}

const kStressLook = {
  name: "von Mises",
  highest: kHighest,
  unit: "MPa",
  text: (v: number) => `${fixedText(v, 1)} MPa`,
};

/// Von Mises stress across the track, where it is.
function sectionPicture(run: Run): Painted|null {
  const g = run.geometry;
  if (!g || !run.sections.rail) return null;
  const cells = (["rail", "wheel"] as const).flatMap((body) => {
    const section = run.sections[body]?.cross;
    if (!section) return [];
    const values = rowsOf(unpack(section.von_mises), section.along.length);
    return cellsBelow(g, body, section.along, section.depth, values);
  });
  const scale = magnitudeScale(Math.max(...cells.map((cell) => cell.value), 1));
  return {
    id: "hero-section",
    title: "Von Mises stress",
    words: [`On the profiles. ${planeWords(run)}, seen against the rolling direction.${layerWords(g)}`],
    paint: (host, theme, width) => paintSection(host, run, g, {cells, scale, ...kStressLook}, theme, width),
    table: () => ({
      names: ["body", "y_mm", "depth_mm", "von_mises_MPa"],
      rows: cells.map((cell) => [cell.body, cell.y, cell.depth, cell.value]),
    }),
  };
}

/// One run at a glance.
export function hero(run: Run): HTMLElement {
  const section = sectionPicture(run);
  const pictures = [...patchPictures(run), ...(section ? [section] : [])];
  return element("section", {id: "glance", class: "hero"}, ...pictures.map(frame));
}
