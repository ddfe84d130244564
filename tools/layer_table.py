#!/usr/bin/env python3
"""The table of what a layer does, in README.md, from the recorded study.

usage: layer_table.py [--write] [ROOT]

Prints the table from cases/paper/recorded/study/study.csv: finite elements, in brackets half-spaces. --write puts it
between the markers of README.md; tests/program/recorded_study_test.py compares both.
"""
import pathlib
import sys

import engine_agreement

BEGIN, END = "<!-- table of tools/layer_table.py -->", "<!-- end of table -->"
WITHOUT = ("base", "traction_coefficient 0.2")
THICKNESSES = ("0.2 mm", "1 mm", "3 mm", "6 mm")
CASES = {"no layer": WITHOUT} | {h: ("layers", f"thickness {h}, young_ratio 4") for h in THICKNESSES}
# what a row is called, column of the study, factor, format
ROWS = [("largest pressure [MPa]", "p_max_MPa", 1, ".0f"),
        ("area of the patch [mm²]", "patch_area_mm2", 1, ".1f"),
        ("share of it that slips [%]", "slip_area_fraction", 100, ".1f"),
        ("longitudinal creepage [10⁻³]", "creepage_x", 1000, ".3f"),
        ("von Mises stress at the layer's border [MPa]", "rail_interface_von_mises_MPa", 1, ".0f")]
BELOW = "rail_subsurface_von_mises_MPa"  # without a layer, the largest below the surface


def value(row, column, factor, form):
    return format(factor * float(row[column] or row[BELOW]), form)


def table(study):
    out = ["| | " + " | ".join(CASES) + " |", "|---" * (len(CASES) + 1) + "|"]
    for name, *what in ROWS:
        pairs = [[value(study[*case, engine], *what) for engine in ("fem", "bem")] for case in CASES.values()]
        cells = [f"{elements} ({half_spaces})" for elements, half_spaces in pairs]
        out.append(f"| {name} | " + " | ".join(cells) + " |")
    return "\n".join(out)


def of_page(text):
    """The table that the page has, and the page around it."""
    before, rest = text.split(BEGIN + "\n")
    shown, after = rest.split("\n" + END)
    return shown, (before + BEGIN + "\n", "\n" + END + after)


def main():
    words = [word for word in sys.argv[1:] if word != "--write"]
    root = pathlib.Path(words[0]) if words else pathlib.Path(__file__).resolve().parent.parent
    made = table(engine_agreement.rows(root / "cases/paper/recorded/study/study.csv"))
    if "--write" in sys.argv[1:]:
        page = root / "README.md"
        before, after = of_page(page.read_text())[1]
        page.write_text(before + made + after)
    else:
        print(made)


if __name__ == "__main__":
    main()
