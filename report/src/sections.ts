// Verdict, numbers, geometry, history and origin: the parts of the page around the patch and its stresses.
import {numberAt, option, type Check, type Layer, type Report, type Run} from "./data";
import {element, table, type Cell} from "./dom";
import {axis, baseLayout, type Figure, type Theme} from "./figures";
import {linesFigure, type Series} from "./lines";
import {
  checkWords,
  engineName,
  limitText,
  minus,
  numberText,
  percentText,
  plotText,
  quantityAt,
  runLabel,
  countText,
  shownQuantities,
  unitText,
  zones
} from "./text";

function checkRow(report: Report, check: Check): HTMLElement {
  const words = checkWords(check.name);
  const number = (v: number|null) => unitText(v, words.unit, 3);
  const limit = `${words.unit.shown.includes("|") ? "" : "at most "}${limitText(check.limit, words.unit)}`;
  const state = !check.judged ? "remark" : check.ok ? "ok" : "failed";
  const attributes = {
    class: state,
    "data-check": check.name,
    "data-runs": check.runs.join(","),
    "data-ok": String(check.ok),
    "data-judged": String(check.judged)
  };
  const whose = report.runs.length > 1 && check.runs.length === 1 ? runLabel(report.runs[check.runs[0]])
      : check.runs.length > 1 && report.runs.length > 2 ? check.runs.map((k) => report.runs[k].name).join(" – ")
                                                        : "";
  return element(
      "tr",
      attributes,
      element(
          "td", {class: "mark"},
          state === "ok"           ? "✓ holds"
              : state === "failed" ? "✗ fails"
                                   : "· note"),
      element("th", {scope: "row"}, words.name),
      element("td", {class: "value"}, number(check.value)),
      element("td", {class: "limit"}, check.judged && check.limit !== null ? limit : ""),
      element("td", {}, [words.what, whose, check.note].filter(Boolean).join("; ")),
  );
}

const kManyChecks = 40;

/// Green or red, in words, with every check and its limit.
export function verdict(report: Report): HTMLElement {
  const judged = report.checks.filter((c) => c.judged);
  const failed = judged.filter((c) => !c.ok);
  const ok = judged.length > 0 && failed.length === 0;
  const line = !judged.length ? "Nothing was checked."
      : ok                    ? `All ${judged.length} checks hold.`
                              : `${failed.length} of ${judged.length} checks ${failed.length === 1 ? "fails" : "fail"                   }.`;
  const holds = judged.filter((c) => c.ok);
  const notes = report.checks.filter((c) => !c.judged);
  const head = () => element(
      "thead", {},
      element(
          "tr", {}, ...["", "check", "value", "limit", "what it says"].map((h) => element("th", {scope: "col"}, h))));
  const checks = (rows: Check[]) => element(
      "div", {class: "scroll"},
      element("table", {class: "checks"}, head(), element("tbody", {}, ...rows.map((c) => checkRow(report, c)))));
  const many = report.checks.length > kManyChecks;  // of a study: what failed first, the rest on demand
  return element(
      "section",
      {id: "verdict", class: ok ? "good" : "bad", "data-ok": String(ok)},
      element("h2", {}, ok ? "✓ " : "✗ ", line),
      failed.length
          ? element(
                "p", {class: "failed"},
                `Read the results with care: ${[...new Set(failed.map((c) => checkWords(c.name).name))].join(", ")}.`)
          : null,
      many ? (failed.length ? checks(failed) : null) : checks([...failed, ...holds, ...notes]),
      many ? element(
                 "details", {}, element("summary", {}, `${holds.length} checks that hold, ${notes.length} notes`),
                 checks([...holds, ...notes]))
           : null,
  );
}

function largestBelowSurface(run: Run): {value_Pa: number; depth_m: number; zone: string}|null {
  let best: {value_Pa: number; depth_m: number; zone: string}|null = null;
  for (const {key: zone, name} of zones()) {
    const m = zone === "surface" ? null : run.summary.stress.rail?.[zone]?.von_mises_max;
    if (m && (!best || m.value_Pa > best.value_Pa)) best = {value_Pa: m.value_Pa, depth_m: m.depth_m ?? 0, zone: name};
  }
  return best && best.zone === "below the surface" ? {...best, zone: "largest"} : best;
}

/// One run's numbers large; `named`: with its name above them, where the page shows others too.
export function tiles(run: Run, named: boolean): HTMLElement {
  const digits = (path: string, most: number) => {
    const q = quantityAt(path);
    const value = numberAt(run, path);
    return numberText(value === null ? null : q.unit.factor * value, most);
  };
  const [fx, fz] = [numberAt(run, "contact/F_x_N"), numberAt(run, "contact/F_z_N")];
  const inside = largestBelowSurface(run);
  const tile = (name: string, text: string, unit: string, small = "") => element(
      "div", {class: "tile"}, element("span", {class: "name"}, name),
      element("span", {class: "big"}, text, unit ? element("small", {}, ` ${unit}`) : null),
      small ? element("span", {class: "small"}, small) : null);
  const number = (path: string, most = 4) =>
      tile(quantityAt(path).name, digits(path, most), quantityAt(path).unit.shown);
  const [length, width] = ["contact/patch_length_m", "contact/patch_width_m"];
  const cards = element(
      "div",
      {class: "tiles"},
      number("contact/p_max_Pa"),
      number("contact/q_max_Pa"),
      tile(
          "Patch", `${digits(length, 3)} × ${digits(width, 3)}`, quantityAt(length).unit.shown,
          "length along x × width"),
      number("contact/slip_area_fraction", 3),
      tile(
          "Traction F_x / F_z", numberText(fx !== null && fz ? fx / fz : null), "",
          `wanted ${option(run, "drive", "traction_coefficient") ?? "–"}`),
      tile(
          "Rail, von Mises below the surface", inside ? numberText(1e-6 * inside.value_Pa) : "–", "MPa",
          inside ? `${inside.zone}, ${(1e3 * inside.depth_m).toFixed(2)} mm deep` : ""),
  );
  return element(
      "div", {},
      named ? element(
                  "p", {class: "note", id: "tiles-of"},
                  `Numbers of ${runLabel(run)}; all runs beside each other in the table below.`)
            : null,
      cards);
}

export function numbersTable(runs: Run[]): HTMLElement {
  const pair = runs.length === 2;
  const rows = shownQuantities().flatMap((q) => {
    const values = runs.map((run) => numberAt(run, q.path));
    if (values.every((v) => v === null)) return [];
    const cells: (string|Cell)[] = [
      q.name, q.unit.shown, ...values.map((v) => ({
                                            text: numberText(v === null ? null : q.unit.factor * v, q.digits),
                                            attributes: {"data-path": q.path, "data-value": String(v)}
                                          }))
    ];
    if (pair)
      cells.push(
          q.comparable && values[0] !== null && values[1] ? percentText((values[0] - values[1]) / Math.abs(values[1]))
                                                          : "–");
    return [cells];
  });
  return table(
      "Contact", ["quantity", "unit", ...runs.map(runLabel), ...(pair ? ["difference"] : [])], rows,
      {class: "numbers", id: "contact-numbers"});
}

/// Profiles where they stand, whole and near the contact.
export function geometryFigures(run: Run): Figure[] {
  const g = run.geometry;
  if (!g) return [];
  const mm = (points: [number, number][]) => ({x: points.map((p) => 1e3 * p[0]), y: points.map((p) => 1e3 * p[1])});
  const contact = {x: 1e3 * g.contact.y_m, y: 1e3 * g.contact.z_m};
  const curves: {name: string; line: {x: number[]; y: number[]}; colour: (t: Theme) => string; dash: string}[] = [
    {name: `wheel ${g.wheel_profile}`, line: mm(g.wheel_m), colour: (t) => t.series[1], dash: "solid"},
    {name: `rail ${g.rail_profile}`, line: mm(g.rail_m), colour: (t) => t.series[0], dash: "solid"},
    ...g.layers.map(
        (l) => ({name: `bottom of ${l.name}`, line: mm(l.bottom_m), colour: (t: Theme) => t.ink, dash: "dash"})),
  ];
  const figure = (id: string, title: string, words: string, halfWidth: number, ratio: number): Figure => ({
    id,
    title,
    words: [words],
    draw: (theme, width) => {
      const window = {x: [contact.x - halfWidth, contact.x + halfWidth], y: [] as number[]};
      const plotHeight = Math.min(Math.max(180, (width - 80) * 0.62), 380);
      const halfHeight = (halfWidth * plotHeight) / (width - 80) / ratio;
      window.y = [contact.y - halfHeight, contact.y + halfHeight];
      return {
        data: [
          ...curves.map((c) => ({
                          type: "scatter",
                          mode: "lines",
                          name: plotText(c.name),
                          ...c.line,
                          line: {color: c.colour(theme), dash: c.dash, width: 2},
                          hovertemplate: `y %{x:.2f} mm<br>z %{y:.3f} mm<extra>${plotText(c.name)}</extra>`
                        })),
          {
            type: "scatter",
            mode: "markers",
            name: "rigid contact point",
            x: [contact.x],
            y: [contact.y],
            marker: {size: 10, symbol: "circle-open", color: theme.ink, line: {width: 2}},
            hovertemplate: "y %{x:.3f} mm<br>z %{y:.3f} mm<extra>rigid contact point</extra>"
          },
        ],
        layout: {
          ...baseLayout(theme, width, plotHeight + 90),
          margin: {l: 58, r: 16, t: 30, b: 46},
          showlegend: true,
          xaxis: axis(theme, "y, field side right [mm]", {range: window.x, constrain: "domain"}),
          yaxis:
              axis(theme, "z [mm]", {range: window.y, ...(ratio === 1 ? {scaleanchor: "x"} : {}), constrain: "domain"}),
        },
      };
    },
    table: () => ({
      names: ["curve", "y_mm", "z_mm"],
      rows: [
        ...curves.flatMap((c) => c.line.x.map((x, i) => [c.name, x, c.line.y[i]])),
        ["rigid contact point", contact.x, contact.y]
      ],
    }),
  });
  return [
    figure(
        "profiles", "Wheel on rail",
        "Profiles as placed, before loading, seen against the rolling direction; equal scales. Zero is the crown of the canted rail.",
        75, 1),
    figure("profiles-near", "Near the contact point", "The same, heights drawn ten times larger than widths.", 20, 10),
  ];
}

function layerModulus(l: Layer): string {
  if (!l.young_table) return `E ${numberText(1e-9 * l.young_Pa)} GPa = ${numberText(l.young_ratio, 3)} E₀`;
  return `graded: E ${
      l.young_table.map(([depth, young]) => `${numberText(1e-9 * young)} GPa at ${numberText(1e3 * depth, 3)} mm`)
          .join(", ")}`;
}

export function geometryTable(run: Run): HTMLElement|null {
  const g = run.geometry;
  if (!g) return null;
  const c = g.contact;
  const radius = (k: number) => (Math.abs(k) < 1e-9 ? "straight" : `${numberText(1e3 / k)} mm`);
  const rows: string[][] = [
    ["wheel on rail", `${g.wheel_profile} on ${g.rail_profile}`],
    ["lateral shift of the wheel", option(run, "geometry", "lateral_shift") ?? "–"],
    ["cant of the rail", option(run, "geometry", "cant") ?? "–"],
    ["contact point on the rail", `y ${minus((1e3 * c.y_m).toFixed(3))} mm, z ${minus((1e3 * c.z_m).toFixed(3))} mm`],
    ["contact point on the wheel, from the tape circle", `y ${minus((1e3 * c.wheel_y_m).toFixed(3))} mm`],
    ["contact angle", `${numberText(1e3 * c.angle_rad)} mrad`],
    ["rolling radius", `${(1e3 * c.rolling_radius_m).toFixed(3)} mm`],
    [
      "lateral radius of wheel, of rail (convex positive)",
      `${radius(c.curvature_wheel_lateral_per_m)}, ${radius(c.curvature_rail_lateral_per_m)}`
    ],
    ["static load", `${numberText(1e-3 * g.load_N, 5)} kN`],
    [
      "Hertz’s ellipse, no layer",
      `a ${numberText(1e3 * g.hertz.a_m, 3)}, b ${numberText(1e3 * g.hertz.b_m, 3)} mm, p₀ ${
          numberText(1e-6 * g.hertz.p0_Pa)} MPa, approach ${numberText(1e6 * g.hertz.approach_m, 3)} µm`
    ],
    ...g.layers.map(
        (l) =>
            [`layer “${l.name}” on the ${l.on}`,
             `${numberText(1e3 * l.thickness_m, 3)} mm thick, ${numberText(1e3 * l.width_m, 3)} mm wide, ${
                 layerModulus(l)}`]),
  ];
  return table("Placement", ["", ""], rows, {class: "facts"});
}

/// What happened on the way: forces, pressure, creepage, energy.
export function historyFigures(runs: Run[]): Figure[] {
  const given = runs.filter((run) => run.history);
  if (!given.length) return [];
  const run = given[0];
  const h = run.history!;
  const position = 1e3 * (run.summary.position_m ?? NaN);
  const half = 0.5 * parseFloat(option(run, "run", "window") ?? "NaN");
  const band: [number, number]|undefined =
      Number.isFinite(position) && Number.isFinite(half) ? [position - half, position + half] : undefined;
  const series = (columns: [string, string, number, string, string?][]): Series[] =>
    given.flatMap((r, n) =>
      columns.map(([column, name, scale, hover, dash], k): Series => ({
        name: given.length > 1 ? `${name}, ${runLabel(r)}` : name, x: r.history!.position_mm, y: r.history![column].map((v) => scale * v),
        colour: (t) => t.series[(given.length > 1 ? n : k) % t.series.length], dash: dash ?? (given.length > 1 && k > 0 ? "dot" : "solid"), hover: `wheel at %{x:.1f} mm<br>${hover}`,
      })),
    );
  const label = "position of the wheel [mm]";
  const shaded = band ? " Shaded: the window over which the results are averaged." : "";
  const figures = [
    linesFigure({
      id: "history-forces",
      title: "Forces on the wheel",
      labels: [label, "force [kN]"],
      names: ["position_mm", "force_kN"],
      band,
      words: [`F_z carries the weight, F_x drives.${shaded}`],
      series: series([
        ["F_z_N", "F_z", 1e-3, "F_z %{y:.2f} kN"], ["F_x_N", "F_x", 1e-3, "F_x %{y:.2f} kN"],
        ["F_y_N", "F_y", 1e-3, "F_y %{y:.2f} kN"]
      ])
    }),
    linesFigure({
      id: "history-p",
      title: "Largest pressure",
      labels: [label, "p_max [MPa]"],
      names: ["position_mm", "p_max_MPa"],
      band,
      leastSpan: 0.2,
      words: [
        "Of the nodes, before the peak between them is interpolated: it swings with every element that the wheel passes."
      ],
      series: series([["p_max_MPa", "p_max", 1, "p_max %{y:.1f} MPa"]])
    }),
    linesFigure({
      id: "history-creepage",
      title: "Longitudinal creepage",
      labels: [label, "creepage [10⁻³]"],
      names: ["position_mm", "creepage_1e-3"],
      band,
      words: ["Negative while the wheel drives."],
      series: series([["creepage", "creepage", 1e3, "creepage %{y:.3f} × 10⁻³"]])
    }),
    linesFigure({
      id: "history-energy",
      title: "Energies",
      labels: [label, "energy [J]"],
      names: ["position_mm", "energy_J"],
      band,
      words: [
        "Stored, lost and damped. The work of the torque and the kinetic energy it turns into are hundreds of times larger; they are in history.csv."
      ],
      series: series([
        ["strain_J", "strain", 1, "%{y:.3f} J"], ["friction_J", "friction", 1, "%{y:.3f} J"],
        ["run_up_damping_J", "run-up damping", 1, "%{y:.3f} J"], ["hourglass_J", "hourglass", 1, "%{y:.3f} J"],
        ["absorbed_J", "absorbed at the rail’s ends", 1, "%{y:.3f} J"]
      ])
    }),
    linesFigure({
      id: "history-closure",
      title: "Energy closure",
      labels: [label, "closure [mJ]"],
      names: ["position_mm", "closure_mJ"],
      band,
      words: ["Sum of all energies and works since the start; exact time steps would keep it zero."],
      series: series([["closure_J", "closure", 1e3, "%{y:.4f} mJ"]])
    }),
    linesFigure({
      id: "history-penetration",
      title: "Penetration",
      labels: [label, "penetration [nm]"],
      names: ["position_mm", "penetration_nm"],
      band,
      words: ["Largest overlap of the two surfaces."],
      series: series([["penetration_um", "penetration", 1e3, "%{y:.3f} nm"]])
    }),
  ];
  const known = new Set(Object.keys(h));
  return known.has("position_mm") ? figures : [];
}

/// Where the numbers come from, and the case in full.
export function origin(runs: Run[]): HTMLElement[] {
  return runs.map((run) => {
    const p = run.provenance;
    const text = (key: string) =>
        (p[key] === undefined || p[key] === null ? "–"
             : Array.isArray(p[key])             ? (p[key] as unknown[]).join(" ")
                                                 : String(p[key]));
    const wall = numberAt(run, "run/wall_s");
    const rows: string[][] = [
      ["folder", run.folder],
      ["engine", engineName(run.engine)],
      [
        "program", `RailStrata ${text("version")}, commit ${text("commit")}${p.dirty === true ? " (with changes)" : ""}`
      ],
      ["computed", text("time_utc")],
      ["command", text("command_line")],
      ["threads", `${text("threads")}, ${text("isa")}`],
      ["compiler", `${text("compiler")} ${text("flags")}`],
      [
        "size",
        `${countText(numberAt(run, "run/elements"))} ${
            run.engine === "bem"
                ? "cells"
                : `elements, ${countText(numberAt(run, "run/steps"))} steps`}, ${numberText(wall, 3)} s`
      ],
    ];
    const inputs = Array.isArray(p.inputs)
        ? (p.inputs as Record<string, string>[]).map((i) => [`input ${i.file}`, `SHA-256 ${i.sha256}`])
        : [];
    return element(
        "div",
        {class: "origin"},
        table(runs.length > 1 ? runLabel(run) : "", ["", ""], [...rows, ...inputs], {class: "facts"}),
        element(
            "details", {}, element("summary", {}, "Every option of the case"),
            table("", ["table", "key", "value"], run.case, {class: "case"})),
    );
  });
}
