// Drawing on a canvas: axes, maps, lines. Sharp on any screen, in the page's own colours.

export interface Theme {
  ink: string;
  soft: string;
  line: string;
  paper: string;
}

export function theme(): Theme {
  const style = getComputedStyle(document.documentElement);
  const of = (name: string) => style.getPropertyValue(name).trim();
  return {ink: of("--ink"), soft: of("--soft"), line: of("--line"), paper: of("--paper")};
}

export interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

/// A canvas of this height over the width of its place; null while it is not shown.
export function prepare(canvas: HTMLCanvasElement, height: number): CanvasRenderingContext2D|null {
  const width = canvas.parentElement?.clientWidth ?? 0;
  if (width < 40) return null;
  const scale = window.devicePixelRatio || 1;
  const pixels = [Math.round(width * scale), Math.round(height * scale)] as const;
  if (canvas.width !== pixels[0] || canvas.height !== pixels[1]) [canvas.width, canvas.height] = pixels;
  canvas.style.width = `${width}px`;
  canvas.style.height = `${height}px`;
  const g = canvas.getContext("2d");
  if (!g) return null;
  g.setTransform(scale, 0, 0, scale, 0, 0);
  g.clearRect(0, 0, width, height);
  g.font = `12px ${getComputedStyle(document.body).fontFamily}`;
  return g;
}

export interface Axis {
  low: number;
  high: number;
  title: string;
}

/// A round step for about so many ticks.
export function stepOf(span: number, about: number): number {
  const rough = span / Math.max(1, about);
  const power = 10 ** Math.floor(Math.log10(rough));
  return power * ([1, 2, 5, 10].find((f) => f * power >= rough) ?? 10);
}

/// The next round number above, so that scales jump seldom.
export function roundUp(value: number): number {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  return power * ([1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].find((f) => f * power >= value) ?? 10);
}

export class Plot {
  constructor(
      readonly g: CanvasRenderingContext2D, readonly box: Box, readonly x: Axis, readonly y: Axis,
      readonly colours: Theme) {}

  atX(v: number): number { return this.box.left + (v - this.x.low) / (this.x.high - this.x.low) * this.box.width; }
  atY(v: number): number {
    return this.box.top + this.box.height - (v - this.y.low) / (this.y.high - this.y.low) * this.box.height;
  }

  clip(draw: () => void): void {
    this.g.save();
    this.g.beginPath();
    this.g.rect(this.box.left, this.box.top, this.box.width, this.box.height);
    this.g.clip();
    draw();
    this.g.restore();
  }

  private static text(v: number, step: number): string {
    const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    return v.toFixed(decimals).replace(/^-0(\.0*)?$/, "0$1").replace("-", "−");
  }

  private ticks(axis: Axis, pixels: number): [number[], number] {
    const low = Math.min(axis.low, axis.high);
    const high = Math.max(axis.low, axis.high);
    const step = stepOf(high - low, pixels / 60);
    const out: number[] = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) out.push(k * step);
    return [out, step];
  }

  axes(): void {
    const {g, box, colours} = this;
    g.lineWidth = 1;
    g.strokeStyle = colours.line;
    g.fillStyle = colours.soft;
    const [xs, dx] = this.ticks(this.x, box.width);
    const [ys, dy] = this.ticks(this.y, box.height);
    g.textAlign = "center";
    g.textBaseline = "top";
    for (const v of xs) {
      this.segment(this.atX(v), box.top, this.atX(v), box.top + box.height);
      g.fillText(Plot.text(v, dx), this.atX(v), box.top + box.height + 4);
    }
    g.textAlign = "right";
    g.textBaseline = "middle";
    for (const v of ys) {
      this.segment(box.left, this.atY(v), box.left + box.width, this.atY(v));
      g.fillText(Plot.text(v, dy), box.left - 5, this.atY(v));
    }
    this.titles();
  }

  private titles(): void {
    const {g, box} = this;
    g.textAlign = "center";
    g.textBaseline = "bottom";
    g.fillText(this.x.title, box.left + box.width / 2, box.top + box.height + 34);
    g.save();
    g.translate(box.left - 38, box.top + box.height / 2);
    g.rotate(-Math.PI / 2);
    g.fillText(this.y.title, 0, 0);
    g.restore();
  }

  segment(x0: number, y0: number, x1: number, y1: number): void {
    this.g.beginPath();
    this.g.moveTo(Math.round(x0) + 0.5, Math.round(y0) + 0.5);
    this.g.lineTo(Math.round(x1) + 0.5, Math.round(y1) + 0.5);
    this.g.stroke();
  }

  /// To whole pixels of the screen: neighbours leave no seam.
  fill(colour: string, x0: number, y0: number, x1: number, y1: number): void {
    const scale = window.devicePixelRatio || 1;
    const whole = (v: number) => Math.round(v * scale) / scale;
    this.g.fillStyle = colour;
    this.g.fillRect(whole(x0), whole(y0), whole(x1) - whole(x0), whole(y1) - whole(y0));
  }

  line(x: ArrayLike<number>, y: ArrayLike<number>, colour: string, width = 2, dash: number[] = []): void {
    const {g} = this;
    this.clip(() => {
      g.strokeStyle = colour;
      g.lineWidth = width;
      g.lineJoin = "round";
      g.setLineDash(dash);
      g.beginPath();
      for (let k = 0; k < x.length; ++k) g.lineTo(this.atX(x[k]!), this.atY(y[k]!));
      g.stroke();
    });
  }
}

/// Anchors of a scale from dark to light that keeps its order in grey and for any colour vision.
const kMagnitude = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
const kSigned = [[33, 102, 172], [103, 169, 207], [247, 247, 247], [239, 138, 98], [178, 24, 43]];

export function colourAt(share: number, signed = false): string {
  const anchors = signed ? kSigned : kMagnitude;
  const at = Math.min(Math.max(share, 0), 1) * (anchors.length - 1);
  const k = Math.min(Math.floor(at), anchors.length - 2);
  const mixed = anchors[k]!.map((c, n) => Math.round(c + (at - k) * (anchors[k + 1]![n]! - c)));
  return `rgb(${mixed.join(",")})`;
}

/// A bar that tells what the colours mean, right of a plot.
export function colourBar(p: Plot, low: number, high: number, unit: string, signed = false): void {
  const {g, box} = p;
  const x = box.left + box.width + 8;
  const steps = 64;
  for (let k = 0; k < steps; ++k) {
    g.fillStyle = colourAt((k + 0.5) / steps, signed);
    g.fillRect(x, box.top + box.height * (1 - (k + 1) / steps), 10, box.height / steps + 1);
  }
  g.fillStyle = p.colours.soft;
  g.textAlign = "left";
  g.textBaseline = "top";
  g.fillText(String(Number(high.toPrecision(4))).replace("-", "−"), x + 14, box.top);
  g.textBaseline = "bottom";
  g.fillText(String(Number(low.toPrecision(4))).replace("-", "−"), x + 14, box.top + box.height);
  g.textBaseline = "middle";
  g.fillText(unit, x + 14, box.top + box.height / 2);
}
