// Colours of values: viridis for sizes, blue over the paper's shade to red for signs, steps for kinds.
import type {Theme} from "./theme";
import type {Span} from "./types";

export type Colour = readonly [red: number, green: number, blue: number];

/// Viridis: its lightness grows evenly, in grey and for any colour vision.
const kViridis: Colour[] = [
  [68, 1, 84],
  [72, 40, 120],
  [62, 73, 137],
  [49, 104, 142],
  [38, 130, 142],
  [31, 158, 137],
  [53, 183, 121],
  [110, 206, 88],
  [181, 222, 43],
  [253, 231, 37],
];

export const rgb = ([r, g, b]: Colour, light = 1) =>
    `rgb(${[r, g, b].map((v) => Math.round(Math.min(255, light * v))).join(",")})`;

/// Of a share from 0 to 1 along these colours.
function between(colours: Colour[], share: number): Colour {
  const t = Math.min(Math.max(share, 0), 1) * (colours.length - 1);
  const k = Math.min(Math.floor(t), colours.length - 2);
  const mixed = (n: 0|1|2) => Math.round(colours[k][n] + (t - k) * (colours[k + 1][n] - colours[k][n]));
  return [mixed(0), mixed(1), mixed(2)];
}

/// Colours of a range of values; beyond its ends those of the ends.
export interface Scale {
  range: Span;
  colour: (v: number, theme: Theme) => Colour;
}

/// Of pressure, traction, slip and von Mises stress.
export const magnitudeScale = (top: number): Scale => ({range: [0, top], colour: (v) => between(kViridis, v / top)});

/// Compression blue, tension red, zero the paper's shade.
export function signedScale(top: number): Scale {
  const colour = (v: number, theme: Theme) => {
    const paper: Colour = theme.paper === "#ffffff" ? [247, 247, 247] : [42, 47, 54];
    const colours: Colour[] = [[33, 102, 172], [103, 169, 207], paper, [239, 138, 98], [178, 24, 43]];
    return between(colours, 0.5 + (0.5 * v) / top);
  };
  return {range: [-top, top], colour};
}

const hex = (text: string) => [1, 3, 5].map((k) => parseInt(text.slice(k, k + 2), 16)) as unknown as Colour;

/// Kinds numbered from `first` on, each with its colour "#rrggbb".
export function kindScale(first: number, count: number, colours: (theme: Theme) => string[]): Scale {
  const colour = (v: number, theme: Theme) =>
      hex(colours(theme)[Math.min(Math.max(Math.round(v - first), 0), count - 1)]);
  return {range: [first - 0.5, first + count - 0.5], colour};
}

/// Of the states 1 and 2 of a patch.
export const stateScale = kindScale(1, 2, (theme) => [theme.stick, theme.slip]);

/// A scale's colours as the pixels of a picture (ABGR), evenly over its range.
export function pixelsOf(scale: Scale, theme: Theme): Uint32Array {
  const [low, high] = scale.range;
  return Uint32Array.from({length: 256}, (_, k) => {
    const [r, g, b] = scale.colour(low + ((k + 0.5) / 256) * (high - low), theme);
    return ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0;
  });
}
