#!/usr/bin/python3
"""Crack along the lower interface of a layer on a half-plane, its faces pressed apart, by CalculiX: the numbers of
level_crack_test.cpp.

    tests/crack/calculix_interface_crack.py

Half of the body (symmetry about the crack's middle), eight-node elements in plane strain that are small at the end, two
sets of nodes along the crack. G is the elastic energy that is gained under a fixed load from one crack length to the
next on the same mesh. Prints G Ē/(p² π a), Ē = E0/(1 - ν²), a half the length."""
import pathlib
import subprocess
import tempfile

import numpy

from calculix_edge_crack import E0, NU, graded

SIZE, LAYER = 60.0, 1.0   # mm


def energy(folder, x, z, half, ratio):
    """Elastic energy [N mm per mm] under 1 MPa on the faces of x < half."""
    nx, nz = len(x) - 1, len(z) - 1
    level = 2 * int(numpy.argmin(numpy.abs(z - LAYER)))
    number, lines = {}, ["*NODE, NSET=ALL"]
    def at(v, n):
        return v[n // 2] if n % 2 == 0 else 0.5 * (v[n // 2] + v[n // 2 + 1])
    for i in range(2 * nx + 1):
        for k in range(2 * nz + 1):
            if i % 2 and k % 2:
                continue
            for side in (0, 1) if k == level and at(x, i) < half - 1e-9 else (0,):
                number[i, k, side] = len(number) + 1
                lines.append(f"{number[i, k, side]}, {at(x, i):.10g}, {-at(z, k):.10g}, 0")
    def node(n, lower):
        return number.get((*n, 1), number[(*n, 0)]) if lower else number[(*n, 0)]
    sets = {"UPPER": [], "LOWER": []}
    pressed = []
    lines.append("*ELEMENT, TYPE=CPE8, ELSET=EALL")
    element = 0
    for i in range(nx):
        for k in range(nz):
            element += 1
            a, b, lower = 2 * i, 2 * k, 2 * k >= level
            nodes = [(a, b + 2), (a + 2, b + 2), (a + 2, b), (a, b), (a + 1, b + 2), (a + 2, b + 1), (a + 1, b),
                     (a, b + 1)]
            lines.append(f"{element}, " + ", ".join(str(node(n, lower)) for n in nodes))
            sets["LOWER" if lower else "UPPER"].append(element)
            if x[i + 1] <= half + 1e-9 and level in (b, b + 2):
                pressed.append(f"{element}, {'P3' if lower else 'P1'}, 1")
    for name, members in sets.items():
        lines.append(f"*ELSET, ELSET={name}")
        lines += [", ".join(map(str, members[i:i + 12])) for i in range(0, len(members), 12)]
    for name, modulus in (("UPPER", ratio * E0), ("LOWER", E0)):
        lines += [f"*MATERIAL, NAME=M{name}", "*ELASTIC", f"{modulus}, {NU}",
                  f"*SOLID SECTION, ELSET={name}, MATERIAL=M{name}", "1"]
    lines += ["*STEP", "*STATIC", "*BOUNDARY"]
    lines += [f"{n}, 1, 1, 0" for (i, k, side), n in number.items() if i in (0, 2 * nx)]
    lines += [f"{n}, 2, 2, 0" for (i, k, side), n in number.items() if k == 2 * nz]
    lines += ["*DLOAD", *pressed, "*EL PRINT, ELSET=EALL, TOTALS=ONLY", "ELSE", "*END STEP"]
    (folder / "job.inp").write_text("\n".join(lines) + "\n")
    subprocess.run(["ccx", "job"], cwd=folder, check=True, capture_output=True)
    return float((folder / "job.dat").read_text().split()[-1])


def release(half, ratio, fine):
    x, z = graded((0.0, half, SIZE), fine), graded((0.0, LAYER, SIZE), fine)
    tip = int(numpy.argmin(numpy.abs(x - half)))
    with tempfile.TemporaryDirectory() as name:
        shorter, longer = (energy(pathlib.Path(name), x, z, x[tip + step], ratio) for step in (-1, 1))
    modulus = E0 / (1 - NU * NU)
    return (longer - shorter) / (x[tip + 1] - x[tip - 1]) * modulus / (numpy.pi * half)


if __name__ == "__main__":
    for half, ratio in ((0.25, 1.0), (1.0, 1.0), (1.0, 0.5), (1.0, 2.0), (2.0, 2.0)):
        print(half, ratio, *(f"{release(half, ratio, half / cells):.4f}" for cells in (25, 50)), flush=True)
