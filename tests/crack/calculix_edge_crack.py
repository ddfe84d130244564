#!/usr/bin/python3
"""Edge crack normal to the surface of a layer on a half-plane, by CalculiX: the numbers of crack_layers_test.cpp.

    tests/crack/calculix_edge_crack.py

Half of the body (symmetry), eight-node elements in plane strain that are small at the tip, the far side pulled by one
displacement, so that the layer bears sigma E1/E0 and the body below sigma. G is the elastic energy that is given up
from one crack length to the next on the same mesh, K_I = sqrt(E1' G). Prints K_I over sigma sqrt(pi c)."""
import pathlib
import subprocess
import sys
import tempfile

import numpy

E0, NU, WIDTH, DEPTH = 210e3, 0.3, 60.0, 60.0   # MPa, mm


def graded(points, fine, growth=1.15):
    """Borders from the first to the last point, `fine` wide around the second."""
    start, tip, end = points
    def away(length):
        out, step = [0.0], fine
        while out[-1] < length:
            out.append(out[-1] + step)
            step *= growth
        scale = length / out[-1]
        return numpy.array(out) * scale
    down, up = tip + away(end - tip), tip - away(tip - start)
    return numpy.unique(numpy.round(numpy.concatenate([up, down]), 9))


def energy(folder, z, x, cracked_nodes, layer, ratio):
    """Elastic energy [N mm per mm], the crack open over the first nodes of x = 0."""
    nz, nx = len(z) - 1, len(x) - 1
    number, lines = {}, ["*NODE, NSET=ALL"]
    for i in range(2 * nx + 1):
        for k in range(2 * nz + 1):
            if i % 2 and k % 2:
                continue
            number[i, k] = len(number) + 1
            at = lambda v, n: v[n // 2] if n % 2 == 0 else 0.5 * (v[n // 2] + v[n // 2 + 1])
            lines.append(f"{number[i, k]}, {at(x, i):.10g}, {-at(z, k):.10g}, 0")
    sets = {"UPPER": [], "LOWER": []}
    lines.append("*ELEMENT, TYPE=CPE8, ELSET=EALL")
    element = 0
    for i in range(nx):
        for k in range(nz):
            element += 1
            a, b = 2 * i, 2 * k
            corners = [(a, b + 2), (a + 2, b + 2), (a + 2, b), (a, b)]
            sides = [(a + 1, b + 2), (a + 2, b + 1), (a + 1, b), (a, b + 1)]
            lines.append(f"{element}, " + ", ".join(str(number[n]) for n in corners + sides))
            sets["UPPER" if z[k + 1] <= layer + 1e-9 else "LOWER"].append(element)
    for name, members in sets.items():
        lines.append(f"*ELSET, ELSET={name}")
        lines += [", ".join(map(str, members[i:i + 12])) for i in range(0, len(members), 12)]
    for name, modulus in (("UPPER", ratio * E0), ("LOWER", E0)):
        lines += [f"*MATERIAL, NAME=M{name}", "*ELASTIC", f"{modulus}, {NU}",
                  f"*SOLID SECTION, ELSET={name}, MATERIAL=M{name}", "1"]
    strain = (1 - NU * NU) / E0   # of 1 MPa below
    held = [number[0, k] for k in range(cracked_nodes, 2 * nz + 1)]
    pulled = [number[2 * nx, k] for k in range(2 * nz + 1)]
    lines += ["*STEP", "*STATIC", "*BOUNDARY"]
    lines += [f"{n}, 1, 1, 0" for n in held] + [f"{n}, 1, 1, {strain * WIDTH:.12g}" for n in pulled]
    lines += [f"{number[2 * nx, 2 * nz]}, 2, 2, 0", "*EL PRINT, ELSET=EALL, TOTALS=ONLY", "ELSE", "*END STEP"]
    (folder / "job.inp").write_text("\n".join(lines) + "\n")
    subprocess.run(["ccx", "job"], cwd=folder, check=True, capture_output=True)
    return float((folder / "job.dat").read_text().split()[-1])


def intensity(length, layer, ratio, fine):
    """K_I / (sigma sqrt(pi c)), sigma = 1 MPa in the body below; layer: mm."""
    z = graded((0.0, length, DEPTH), fine)
    if length > layer:
        z = z[numpy.abs(z - layer) > fine]
    z = numpy.unique(numpy.concatenate([z, [layer]]))
    x = graded((-1.0, 0.0, WIDTH), fine)
    x = x[x > -1e-9]
    tip = 2 * int(numpy.argmin(numpy.abs(z - length)))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        shorter, longer = (energy(folder, z, x, tip + step, layer, ratio) for step in (-2, 2))
    growth = z[tip // 2 + 1] - z[tip // 2 - 1]
    release = 2 * (shorter - longer) / growth
    modulus = (ratio if length <= layer else 1) * E0 / (1 - NU * NU)
    return numpy.sqrt(modulus * release / (numpy.pi * length))


if __name__ == "__main__":
    for length, ratio in ((1.0, 1.0), (0.5, 0.5), (0.5, 2.0), (0.9, 2.0), (1.5, 1.2), (1.5, 2.0)):
        print(length, ratio, *(f"{intensity(length, 1.0, ratio, length / cells):.4f}" for cells in (50, 100)))
        sys.stdout.flush()
