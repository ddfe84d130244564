#!/usr/bin/python3
"""Error of half-space results against the time they take, by cell and leading edge (docs/bem-verification.md):

    tools/half_space_error.py CASE [--cells 1,0.5,0.25,0.125] [--reference 0.0625] [--repeats 3] [--csv error.csv]
                              [--program build/railstrata-bin] [--set KEY=VALUE ...]

Solves the case on each cell [mm] with bem.leading_edge = "whole_cell" and "sub_cell" and once, "sub_cell", on the cell
of reference. Errors are relative to that, of the slip area in points. Times are the engine's own (run.wall_s: contact
alone, without stresses and files), one thread, the best of the repeats. Stripes: rms second difference of |q| across
rows over its mean, where cells stick with a tenth of the patch's length of stick ahead and behind. Prints a Markdown
table.
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCHEMES = ("whole_cell", "sub_cell")
NUMBERS = {"p_max": "p_max_Pa", "q_max": "q_max_Pa", "q_max_point": "q_max_point_Pa", "creepage": "creepage_x",
           "slip_area": "slip_area_fraction"}


def stripes(table, margin):
    """Of patch.csv, with `margin` [mm] of stick around each cell that counts."""
    with open(table, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    xs, ys = (sorted({float(r[key]) for r in rows}) for key in ("x_mm", "y_mm"))
    at = {(xs.index(float(r["x_mm"])), ys.index(float(r["y_mm"]))): r for r in rows}
    reach = math.ceil(margin / (xs[1] - xs[0]))

    def sticks(i, j):
        return all((row := at.get((i + k, j))) is not None and row["state_0separated_1stick_2slip"] == "1"
                   for k in range(-reach, reach + 1))

    def shear(i, j):
        return math.hypot(float(at[i, j]["q_x_MPa"]), float(at[i, j]["q_y_MPa"]))

    inside = {(i, j) for i in range(len(xs)) for j in range(len(ys)) if sticks(i, j)}
    counted = [(i, j) for i, j in inside if (i, j - 1) in inside and (i, j + 1) in inside]
    if not counted:
        return math.nan
    bends = [shear(i, j - 1) - 2 * shear(i, j) + shear(i, j + 1) for i, j in counted]
    mean = sum(shear(i, j) for i, j in counted) / len(counted)
    return math.sqrt(sum(b * b for b in bends) / len(bends)) / mean


def solve(options, scheme, cell, repeats):
    """Numbers of one solution, its stripes and its best time."""
    best = math.inf
    for _ in range(repeats):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "result"
            subprocess.run([options.program, "bem", options.case, "--cell", f"{cell} mm", "--out", out, "--no-report",
                            "--threads", "1", "--set", f"bem.leading_edge=\"{scheme}\"",
                            *(word for value in options.set for word in ("--set", value))],
                           check=True, capture_output=True)
            summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
            best = min(best, summary["run"]["wall_s"])
            numbers = {name: summary["contact"][key] for name, key in NUMBERS.items()}
            numbers["stripes"] = stripes(out / "patch.csv", 1e3 * 0.1 * summary["contact"]["patch_length_m"])
    return numbers | {"wall_s": best}


def error(numbers, reference, name):
    """Per cent of the reference; of the slip area, points."""
    if name == "slip_area":
        return 100 * (numbers[name] - reference[name])
    return 100 * (numbers[name] / reference[name] - 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case")
    parser.add_argument("--cells", default="1,0.5,0.25,0.125")
    parser.add_argument("--reference", type=float, default=0.0625)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--csv")
    parser.add_argument("--program", default=ROOT / "build" / "railstrata-bin")
    parser.add_argument("--set", action="append", default=[])
    options = parser.parse_args()
    reference = solve(options, "sub_cell", options.reference, 1)
    names = list(NUMBERS)
    rows = []
    for cell in map(float, options.cells.split(",")):
        for scheme in SCHEMES:
            numbers = solve(options, scheme, cell, options.repeats)
            rows.append({"cell_mm": cell, "leading_edge": scheme, "wall_ms": 1e3 * numbers["wall_s"],
                         **{f"{name}_error": error(numbers, reference, name) for name in names},
                         "stripes": 100 * numbers["stripes"]})
    print("| cell [mm] | leading edge | ms | " + " | ".join(f"{n} [%]" for n in [*names, "stripes"]) + " |")
    print("|---" * (len(names) + 4) + "|")
    for row in rows:
        print(f"| {row['cell_mm']:g} | {row['leading_edge']} | {row['wall_ms']:.0f} | "
              + " | ".join(f"{row[name + '_error']:+.2f}" for name in names) + f" | {row['stripes']:.1f} |")
    if options.csv:
        with open(options.csv, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, list(rows[0]))
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()
