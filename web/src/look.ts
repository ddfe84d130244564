// Looking at a chart: words under the pointer, a part drawn large, by mouse, fingers and keys.
import {placeIn, showWords, type Pixel, type Plane} from "./canvas";
import {cellReading, inside, pointReading, readingAt, type Drawn, type Look, type Reading} from "./chart";
import {element} from "./dom";
import type {Span} from "./types";

const kDrag = 5;        // px: less is a click
const kTwice = 350;     // ms between two taps of one
const kClosest = 1e-4;  // of the whole: nothing is drawn larger

type View = NonNullable<Look["view"]>;

const span =
    ([low, high]: Span, from: number, to: number): Span => [low + from * (high - low), low + to * (high - low)];

/// The part of what is seen between two shares of the plane's width and height (from below).
function part(p: Plane, x: Span, y: Span): View { return {x: span(p.x, ...x), y: span(p.y, ...y)}; }

/// A chart on the page that can be looked at. `draw` paints it anew with what `look` says.
export class Looker {
  readonly look: Look = {view: null, hidden: new Set()};
  pans = false;  // a drag moves the view; else it frames a part
  private reading: Reading|null = null;
  private from: Pixel|null = null;  // of a drag
  private start: Plane|null = null;
  private readonly fingers = new Map<number, Pixel>();
  private tapped = 0;
  private readonly box = element("div", {class: "box", hidden: ""});

  constructor(
      private readonly host: HTMLElement, private readonly drawn: () => Drawn | null,
      private readonly draw: () => void) {
    host.tabIndex = 0;
    host.addEventListener("pointerdown", (e) => this.down(e));
    host.addEventListener("pointermove", (e) => this.move(e));
    host.addEventListener("pointerup", (e) => this.up(e));
    host.addEventListener("pointercancel", (e) => this.lift(e));
    host.addEventListener("pointerleave", (e) => this.from || e.pointerType === "touch" || this.read(null));
    host.addEventListener("dblclick", () => this.whole());
    host.addEventListener("keydown", (e) => this.key(e));
    host.addEventListener("blur", () => this.read(null));
  }

  /// Takes the words away; after a change of what is drawn.
  forgetWords(): void { this.read(null); }

  whole(): void { this.show(null); }

  private show(view: View|null): void {
    this.look.view = view;
    this.host.classList.toggle("large", view !== null);  // a finger moves the view and not the page
    this.read(null);
    this.draw();
  }

  private read(reading: Reading|null): void {
    this.reading = reading;
    const spot = this.host.querySelector<HTMLElement>(".spot") ?? element("div", {class: "spot", hidden: ""});
    if (reading && !spot.isConnected) this.host.append(spot);
    spot.hidden = !reading || reading.curve < 0;
    if (reading) [spot.style.left, spot.style.top] = [`${reading.place[0]}px`, `${reading.place[1]}px`];
    showWords(this.host, reading?.words ?? null, reading?.place ?? [0, 0]);
  }

  private readAt(place: Pixel): void {
    const drawn = this.drawn();
    this.read(drawn && readingAt(drawn, this.look, place));
  }

  // ---- mouse and fingers

  private down(event: PointerEvent): void {
    const drawn = this.drawn();
    const place = placeIn(this.host, event);
    if (!drawn || event.button !== 0 || !inside(drawn.plane, place)) return;
    const finger = event.pointerType === "touch";
    if (finger) this.fingers.set(event.pointerId, place);
    this.start = drawn.plane;
    this.from = place;
    if (!finger || this.look.view) this.host.setPointerCapture(event.pointerId);
    if (!finger) event.preventDefault();  // no selection of text
    this.host.focus({preventScroll: true});
  }

  private move(event: PointerEvent): void {
    const place = placeIn(this.host, event);
    if (!this.from || !this.start) return this.readAt(place);
    if (this.fingers.has(event.pointerId)) return this.touch(event.pointerId, place);
    if (Math.hypot(place[0] - this.from[0], place[1] - this.from[1]) < kDrag) return;
    this.read(null);
    if (this.pans || event.shiftKey)
      this.moveView(this.from, place);
    else
      this.frame(this.from, place);
  }

  private up(event: PointerEvent): void {
    const [from, place] = [this.from, placeIn(this.host, event)];
    const framed = !this.box.hidden;
    const moved = from ? Math.hypot(place[0] - from[0], place[1] - from[1]) : 0;
    this.lift(event);
    if (!from) return;
    if (framed) return this.zoomTo(from, place);
    if (moved >= kDrag) return;
    if (event.pointerType !== "touch") return;
    if (event.timeStamp - this.tapped < kTwice) return this.whole();
    this.tapped = event.timeStamp;
    this.readAt(place);
  }

  private lift(event: PointerEvent): void {
    this.fingers.delete(event.pointerId);
    if (this.fingers.size) return;
    this.from = this.start = null;
    this.box.hidden = true;
  }

  /// Two fingers draw larger, one moves what is drawn large.
  private touch(id: number, place: Pixel): void {
    const before = new Map(this.fingers);
    const drawn = this.drawn();
    this.fingers.set(id, place);
    if (!drawn) return;
    this.start = drawn.plane;
    if (this.fingers.size === 1) {
      if (this.look.view) this.moveView(before.get(id)!, place);
      return;
    }
    const [a, b] = [...before.values()];
    const [c, d] = [...this.fingers.values()];
    const apart = (p: Pixel, q: Pixel) => Math.max(Math.hypot(p[0] - q[0], p[1] - q[1]), 10);
    const middle: Pixel = [0.5 * (c[0] + d[0]), 0.5 * (c[1] + d[1])];
    this.moveView([0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])], middle);
    this.enlarge(apart(c, d) / apart(a, b), middle);
  }

  private moveView([x0, y0]: Pixel, [x1, y1]: Pixel): void {
    const p = this.start!;
    const [right, up] = [(x0 - x1) / p.width, (y1 - y0) / p.height];
    this.show(part(p, [right, 1 + right], [up, 1 + up]));
  }

  private frame([x0, y0]: Pixel, [x1, y1]: Pixel): void {
    const p = this.start!;
    const cut = (v: number, low: number, size: number) => Math.min(Math.max(v, low), low + size);
    const [left, right] = [x0, cut(x1, p.left, p.width)].sort((a, b) => a - b);
    const [top, bottom] = [y0, cut(y1, p.top, p.height)].sort((a, b) => a - b);
    if (!this.box.isConnected) this.host.append(this.box);
    this.box.hidden = false;
    Object.assign(this.box.style, {
      left: `${left}px`,
      top: `${top}px`,
      width: `${right - left}px`,
      height: `${bottom - top}px`,
    });
  }

  /// The part between two corners; where both axes have one unit as much more as keeps it.
  private zoomTo([x0, y0]: Pixel, [x1, y1]: Pixel): void {
    const drawn = this.drawn();
    if (!drawn) return;
    const p = drawn.plane;
    const share = (v: number) => Math.min(Math.max(v, 0), 1);
    const x = [share((x0 - p.left) / p.width), share((x1 - p.left) / p.width)].sort((a, b) => a - b) as Span;
    const y = [share(1 - (y0 - p.top) / p.height), share(1 - (y1 - p.top) / p.height)].sort((a, b) => a - b) as Span;
    const across = drawn.chart.equal ? false : true;
    // a frame as flat as a line is one of the other axis alone
    const [thinX, thinY] = [(x[1] - x[0]) * p.width < kDrag, (y[1] - y[0]) * p.height < kDrag];
    if (across) return this.seen(part(p, thinX ? [0, 1] : x, thinY ? [0, 1] : y));
    const size = Math.max(x[1] - x[0], y[1] - y[0], 0.01);
    const around = ([low, high]: Span): Span => [0.5 * (low + high - size), 0.5 * (low + high + size)];
    this.seen(part(p, around(x), around(y)));
  }

  /// So many times larger; what is at this place stays there.
  private enlarge(times: number, [x, y]: Pixel): void {
    const drawn = this.drawn();
    if (!drawn) return;
    const p = drawn.plane;
    const [u, v] = [(x - p.left) / p.width, 1 - (y - p.top) / p.height];
    const around = (share: number): Span => [share - share / times, share + (1 - share) / times];
    this.seen(part(p, around(u), around(v)));
  }

  private seen(view: View): void {
    const whole = this.drawn()?.chart;
    if (!whole) return;
    const share = Math.abs((view.x[1] - view.x[0]) / (whole.x.range[1] - whole.x.range[0]));
    if (share > kClosest) this.show(share < 1.5 ? view : null);
  }

  // ---- keys

  private key(event: KeyboardEvent): void {
    const drawn = this.drawn();
    if (!drawn || event.ctrlKey || event.metaKey || event.altKey || event.target !== this.host) return;
    const p = drawn.plane;
    const middle: Pixel = this.reading?.place ?? [p.left + 0.5 * p.width, p.top + 0.5 * p.height];
    const steps: Record<string, [number, number]> =
        {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    const step = steps[event.key];
    this.start = p;
    if (step && event.shiftKey)
      this.moveView([0, 0], [-40 * step[0], 40 * step[1]]);
    else if (step)
      this.read(this.next(drawn, step));
    else if (event.key === "+")
      this.enlarge(1.5, middle);
    else if (event.key === "-")
      this.enlarge(1 / 1.5, middle);
    else if (event.key === "0" || event.key === "Escape")
      this.whole();
    else
      return void (this.start = null);
    this.start = null;
    event.preventDefault();
  }

  /// The next point along a curve, or on the next curve; on a map the next cell. The first time where it begins.
  private next(drawn: Drawn, step: [right: number, up: number]): Reading|null {
    const {plane: p, chart} = drawn;
    const middle: Pixel = [p.left + 0.5 * p.width, p.top + 0.5 * p.height];
    if (!chart.cells) return nextPoint(drawn, this.look, this.reading, step, middle);
    const all: Look = {view: null, hidden: new Set(chart.curves.keys())};
    const cell = this.reading && this.reading.curve < 0 ? this.reading : readingAt(drawn, all, middle);
    if (!cell || cell !== this.reading) return cell;
    const {y} = chart.cells;
    const up = p.y[1] > p.y[0] === y[y.length - 1] > y[0] ? step[1] : -step[1];
    return cellReading(drawn, cell.point[0] + step[0], cell.point[1] + up) ?? cell;
  }
}

function nextPoint(drawn: Drawn, look: Look, last: Reading|null, [right, up]: [number, number], middle: Pixel): Reading|
    null {
  const curves = drawn.chart.curves.flatMap((curve, n) => (curve.words && !look.hidden.has(n) ? [n] : []));
  if (!curves.length) return null;
  if (!last) return nearest(drawn, look, curves[0], middle);
  if (up)
    return nearest(drawn, look, curves[(curves.indexOf(last.curve) - up + curves.length) % curves.length], last.place);
  const count = drawn.chart.curves[last.curve].x.length;
  for (let k = last.point[0] + right; k >= 0 && k < count; k += right) {
    const reading = pointReading(drawn, look, last.curve, k);
    if (reading) return reading;
  }
  return last;
}

/// Of a curve's points the one nearest to a place.
function nearest(drawn: Drawn, look: Look, curve: number, [x, y]: Pixel): Reading|null {
  const far = (reading: Reading) => Math.hypot(reading.place[0] - x, reading.place[1] - y);
  return drawn.chart.curves[curve].x.reduce<Reading|null>((best, _, k) => {
    const reading = pointReading(drawn, look, curve, k);
    return reading && (!best || far(reading) < far(best)) ? reading : best;
  }, null);
}
