#!/usr/bin/python3
"""Draws the study of elastic layers as one picture: pressure and shear on the centre line, largest pressure and largest
von Mises stress against the layer's thickness.

    tools/plot_study.py cases/paper/recorded/study [picture.png]

Needs Debian's python3-matplotlib. Reads study.csv and centre_lines.csv (tools/record_study.py)."""
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

STIFFEST = "4"
COLOURS = {"none": "#444444", "0.2 mm": "#d55e00", "1 mm": "#e69f00", "3 mm": "#009e73", "6 mm": "#0072b2"}
RATIOS = {"1.67": "#56b4e9", "2": "#e69f00", "4": "#cc3311"}
STYLES = {"fem": "-", "bem": "--"}


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def centre_lines(axis, lines, value, label):
    cases = {"none": ("base", "traction_coefficient 0.2")} | {h: ("layers", f"thickness {h}, young_ratio {STIFFEST}")
                                                              for h in COLOURS if h != "none"}
    for h, case in cases.items():
        for engine, style in STYLES.items():
            rows = [r for r in lines if (r["group"], r["case"]) == case and r["engine"] == engine]
            name = ("no layer" if h == "none" else f"{h}, {STIFFEST} $E_0$") if engine == "fem" else None
            axis.plot([float(r["x_mm"]) for r in rows], [abs(float(r[value])) for r in rows], style, color=COLOURS[h],
                      label=name, linewidth=1.6 if engine == "fem" else 1.0)
    axis.set_xlim(-9, 9)
    axis.set_xlabel("x from the axle, rolling direction [mm]")
    axis.set_ylabel(label)


def trend(axis, rows, column, label, ratios=RATIOS):
    base = {engine: next(float(r[column]) for r in rows if r["group"] == "base" and r["engine"] == engine)
            for engine in STYLES}
    for ratio, colour in ratios.items():
        for engine, style in STYLES.items():
            chosen = [r for r in rows if r["group"] == "layers" and r["engine"] == engine
                      and r["layer.0.young_ratio"] == ratio and r[column]]
            axis.plot([float(r["layer.0.thickness"].split()[0]) for r in chosen], [float(r[column]) for r in chosen],
                      style, color=colour, marker="o" if engine == "fem" else None, markersize=4,
                      label=f"{ratio} $E_0$" if engine == "fem" else None)
    axis.axhline(base["fem"], color=COLOURS["none"], linewidth=0.8)
    axis.axhline(base["bem"], color=COLOURS["none"], linewidth=0.8, linestyle="--")
    axis.set_xlabel("thickness of the layer [mm]")
    axis.set_ylabel(label)


def main():
    folder = pathlib.Path(sys.argv[1])
    out = sys.argv[2] if len(sys.argv) > 2 else folder / "study.png"
    rows, lines = table(folder / "study.csv"), table(folder / "centre_lines.csv")
    rows = [r for r in rows if r["state"] == "done" and r["drive.traction_coefficient"] == "0.2"]
    figure, axes = plt.subplots(2, 2, figsize=(12, 8), constrained_layout=True)
    centre_lines(axes[0, 0], lines, "p_MPa", "pressure [MPa]")
    centre_lines(axes[0, 1], lines, "q_x_MPa", "shear [MPa]")
    axes[0, 0].legend(frameon=False)
    trend(axes[1, 0], rows, "p_max_MPa", "largest pressure [MPa]")
    trend(axes[1, 1], rows, "rail_von_mises_MPa", "largest von Mises stress of the rail [MPa]")
    axes[1, 0].legend(frameon=False)
    for axis in axes.flat:
        axis.grid(alpha=0.25)
        axis.spines[["top", "right"]].set_visible(False)
    figure.suptitle(
        "LMA on CN60, 85 kN, $F_T/F_z$ = 0.2: solid, finite elements; dashed, layered half-spaces; grey, no layer")
    figure.savefig(out, dpi=110)


if __name__ == "__main__":
    main()
