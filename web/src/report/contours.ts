// Lines of equal value of a field that is bilinear between the points of a grid; nothing (null) is zero.
import type {Values} from "../types";
import type {Line} from "./maps";

type Point = [x: number, y: number];

const kParts = 4;  // of a square of the grid, in either direction: bilinear lines are curved

/// Where the value is `level` on the way from a to b.
function crossing([a, atA]: [number, Point], [b, atB]: [number, Point], level: number): Point {
  const t = (level - a) / (b - a);
  return [atA[0] + t * (atB[0] - atA[0]), atA[1] + t * (atB[1] - atA[1])];
}

/// The pieces of a line in one small square, corners in turn; at a saddle by the mean of the corners.
function piecesIn(corners: [number, Point][], level: number): Point[] {
  const crossings: Point[] = [];
  for (let k = 0; k < 4; ++k) {
    const [from, to] = [corners[k], corners[(k + 1) % 4]];
    if ((from[0] < level) !== (to[0] < level)) crossings.push(crossing(from, to, level));
  }
  const middle = corners.reduce((sum, [v]) => sum + v, 0) / 4;
  const turned = crossings.length === 4 && (middle < level) === (corners[0][0] < level);
  return turned ? [crossings[1], crossings[2], crossings[3], crossings[0]] : crossings;
}

/// z: a row for each y.
export function contours(x: number[], y: number[], z: Values[], levels: number[]): Line[] {
  const line: Line = {x: [], y: [], dash: "solid"};
  for (let j = 0; j + 1 < y.length; ++j)
    for (let i = 0; i + 1 < x.length; ++i) {
      const [a, b, c, d] = [z[j][i], z[j][i + 1], z[j + 1][i + 1], z[j + 1][i]].map((v) => v ?? 0);
      const value = (s: number, t: number) => (1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * d + s * c);
      const corner = (s: number, t: number):
          [number, Point] => [value(s, t), [x[i] + s * (x[i + 1] - x[i]), y[j] + t * (y[j + 1] - y[j])]];
      const crossed = levels.filter((l) => Math.min(a, b, c, d) < l && l <= Math.max(a, b, c, d));
      for (const level of crossed)
        for (let t = 0; t < kParts; ++t)
          for (let s = 0; s < kParts; ++s) {
            const [low, high, left, right] = [t, t + 1, s, s + 1].map((v) => v / kParts);
            const pieces =
                piecesIn([corner(left, low), corner(right, low), corner(right, high), corner(left, high)], level);
            for (let k = 0; k + 1 < pieces.length; k += 2) {
              line.x.push(pieces[k][0], pieces[k + 1][0], null);
              line.y.push(pieces[k][1], pieces[k + 1][1], null);
            }
          }
    }
  return [line];
}
