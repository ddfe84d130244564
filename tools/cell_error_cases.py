#!/usr/bin/python3
"""Cases and fine-cell references behind the error bars of half-space results (docs/bem-verification.md):

    tools/cell_error_cases.py draw CASES.csv --seed 20 --number 150 [--program build/railstrata-bin]
    tools/cell_error_cases.py cover CASES.csv [--program build/railstrata-bin]

`draw` draws cases at random (profiles, load, drive, spin, yaw, layers, materials, film, falling friction, cell of 0.25
to 1.5 mm), leaves out those that are refused, touch at several places or fail a check, and solves each on cells of a
quarter, not below 0.08 mm. A row is written as soon as it is there; a file that exists is gone on with. Some seconds a
case. `cover` solves every row on its cell and prints by column how many references lie within the bars, percentiles of
error over bar, and the median bar. bench/results/cell_errors.csv (seed 20, 150 cases) gave the constants of
src/results/judge/cell_errors.hpp: the 98th percentile is 1 or a little less.
tests/data/reference/cell_errors.csv (seed 21, 50
cases) are those that the test holds them against.
"""
import argparse
import csv
import math
import pathlib
import random
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
# columns of a sweep; the bar of each has "_error" before the unit
NUMBERS = {"p_max": "_MPa", "q_max": "_MPa", "slip_area_fraction": "", "F_x": "_kN", "F_y": "_kN", "creepage_x": "",
           "creepage_y": "", **{f"rail_{zone}_von_mises": "_MPa" for zone in ("subsurface", "layer", "interface",
                                                                             "matrix")}}
FINEST = 0.08


def drawn(chance):
    """Settings of a case, and its cell [mm]."""
    def pick(least, most):
        return f"{chance.uniform(least, most):.4g}"

    def pick_log(least, most):
        return f"{math.exp(chance.uniform(math.log(least), math.log(most))):.3g}"

    def happens(share):
        return chance.random() < share

    rail = chance.choice(["CN60", "UIC60", "UIC54", f"arc:R={pick_log(80, 600)} mm"])
    wheel = chance.choice(["LMA", "S1002", "flat", f"arc:R={pick_log(150, 900)} mm"])
    friction = float(pick(0.1, 0.6))
    settings = {"geometry.track": "CN", "geometry.rail_profile": rail, "geometry.wheel_profile": wheel,
                "geometry.wheel_radius": f"{pick(300, 550)} mm", "geometry.lateral_shift": f"{pick(-3, 3)} mm",
                "geometry.cant": chance.choice(["0.025", "0.05", "0"]), "vehicle.wheel_mass": "1000 kg",
                "vehicle.wheel_load": f"{pick(30, 140)} kN", "drive.speed": f"{pick(10, 60)} m/s",
                "drive.friction_coefficient": f"{friction}"}
    sign = chance.choice([-1, 1])
    if happens(0.5):
        settings["drive.traction_coefficient"] = f"{sign * friction * chance.uniform(0.05, 0.95):.4g}"
    else:
        settings["drive.creepage"] = f"{sign * float(pick_log(1e-4, 1e-2))}"
    if happens(0.3):
        settings["geometry.yaw"] = f"{pick(-8, 8)} mrad"
    if happens(0.25):
        settings["drive.lateral_creepage"] = f"{chance.choice([-1, 1]) * float(pick_log(1e-4, 1e-2))}"
    elif happens(0.2):
        settings["drive.lateral_traction_coefficient"] = f"{friction * chance.uniform(-0.3, 0.3):.4g}"
    if happens(0.3):
        settings["drive.spin"] = f"{pick(-1, 1)} 1/m"
    if happens(0.25):
        settings["material.rail.young"] = f"{pick_log(70, 400)} GPa"
    for k in range(chance.choice([0, 0, 0, 1, 1, 2])):
        settings[f"layer.{k}.thickness"] = f"{pick_log(0.2, 4)} mm"
        settings[f"layer.{k}.young_ratio"] = pick_log(0.25, 4)
        if happens(0.2):
            settings[f"layer.{k}.on"] = "wheel"
    if happens(0.15):
        settings["third_body.thickness"] = f"{pick_log(0.01, 0.1)} mm"
        settings["third_body.shear_modulus"] = f"{pick_log(0.5, 20)} GPa"
    elif happens(0.12):
        settings["friction.law"] = chance.choice(["falling_exponential", "falling_rational"])
        settings["friction.kinetic_coefficient"] = f"{friction * chance.uniform(0.5, 0.9):.4g}"
        settings["friction.half_velocity"] = f"{pick_log(0.5, 5)} m/s"
    return [f"{key}={value}" for key, value in settings.items()], float(pick_log(0.25, 1.5))


def solved(program, settings, cell, stresses=True):
    """The row of a sweep over one case; None where it has faults, several patches, or a check that fails."""
    with tempfile.TemporaryDirectory() as folder:
        case, out = pathlib.Path(folder) / "case.toml", pathlib.Path(folder) / "sweep"
        case.write_text("[case]\ntitle = \"drawn\"\n", encoding="utf-8")
        friction = next(word for word in settings if word.startswith("drive.friction_coefficient="))
        subprocess.run([program, "sweep", case, "--cell", f"{cell} mm", "--out", out, "--no-report", "--threads", "1",
                        *(["--stresses"] if stresses else []), *(w for s in settings for w in ("--set", s)),
                        "--vary", friction], check=False, capture_output=True)
        if not (out / "sweep.csv").exists():
            return None
        with open(out / "sweep.csv", newline="", encoding="utf-8") as file:
            row = next(csv.DictReader(line for line in file if not line.startswith("#")))
    return row if not row["fault"] and row["patches"] == "1" and row["checks"] == "ok" else None


def rows_of(table):
    with open(table, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def rounded(text):
    return f"{float(text):.7g}" if text else ""


def draw(options):
    columns = [name + unit for name, unit in NUMBERS.items()]
    done = len(rows_of(options.table)) if options.table.exists() else 0
    chance = random.Random(options.seed)
    with open(options.table, "a", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, ["case", "cell_mm", *columns], lineterminator="\n")
        if not done:
            writer.writeheader()
        found = 0
        while found < options.number:
            settings, cell = drawn(chance)
            if solved(options.program, settings, cell, stresses=False) is None:
                continue
            found += 1
            if found <= done:
                continue
            fine = solved(options.program, settings, max(cell / 4, FINEST))
            numbers = {c: rounded(fine[c]) for c in columns if fine}
            writer.writerow({"case": "; ".join(settings), "cell_mm": cell, **numbers})
            file.flush()


def percentile(values, share):
    return sorted(values)[math.ceil(share * len(values)) - 1]


def cover(options):
    found = {name: [] for name in NUMBERS}
    for reference in rows_of(options.table):
        row = solved(options.program, reference["case"].split("; "), float(reference["cell_mm"]))
        for name, unit in NUMBERS.items():
            bar, value, fine = (text and float(text) for text in (row[f"{name}_error{unit}"], row[name + unit],
                                                                  reference[name + unit]))
            if "" not in (bar, value, fine):
                found[name].append((abs(value - fine) / bar, bar / abs(value) if value else math.inf))
    print("| number | cases | within | error over bar: median | 95 % | 98 % | largest | median bar |")
    print("|---" * 8 + "|")
    for name, pairs in found.items():
        ratios, bars = zip(*pairs)
        print(f"| {name} | {len(ratios)} | {sum(r <= 1 for r in ratios)} | "
              + " | ".join(f"{percentile(ratios, share):.2f}" for share in (0.5, 0.95, 0.98, 1))
              + f" | {100 * percentile(bars, 0.5):.2g} % |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["draw", "cover"])
    parser.add_argument("table", type=pathlib.Path)
    parser.add_argument("--number", type=int, default=150)
    parser.add_argument("--seed", type=int, default=20)
    parser.add_argument("--program", default=ROOT / "build" / "railstrata-bin")
    options = parser.parse_args()
    draw(options) if options.what == "draw" else cover(options)


if __name__ == "__main__":
    main()
