#!/usr/bin/env python3
"""Draws the pictures of docs/bem.md and docs/finite-elements.md from the program's own meshes and solutions.

usage: ./railstrata python tools/draw_theory.py PROGRAM [FOLDER]     (default: docs/images)
"""
import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import railstrata as rs
from matplotlib.collections import PolyCollection

ROOT = pathlib.Path(__file__).resolve().parent.parent
MM, MPA = 1e3, 1e-6
STEEL, LAYER, WHEEL = "#c9d3da", "#e0a458", "#e9edf0"
plt.rcParams.update({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "svg.fonttype": "none"})


def solved(thickness):
    layer = f'[[layer]]\nthickness = "{thickness} mm"\nyoung_ratio = 2.0\n' if thickness else ""
    changes = {"drive.traction_coefficient": 0.2, "drive.friction_coefficient": 0.5}
    return rs.bem(rs.Case.from_text(layer, changes=changes), cell=0.5e-3)


def cells_of(axes, result):
    """Pressure of every cell as a column on the layered body, in a view along the rail's side."""
    patch, line = result.patch, {"arrowstyle": "-", "lw": 0.6}
    row = int(np.argmax(patch.p.max(axis=0)))
    x, p = MM * np.asarray(patch.x)[:, row], MPA * np.asarray(patch.p)[:, row]
    axes.bar(x, p / 200, width=0.46, color="#33658a")
    for depth, height, colour in ((0, 2, LAYER), (2, 6, STEEL)):
        axes.add_patch(plt.Rectangle((-11, -depth - height), 22, height, color=colour, lw=0))
    axes.plot([-11, 11], [0, 0], color="black", lw=0.8)
    for k in np.arange(-10, 10.1, 0.5):
        axes.plot([k, k], [0, -0.25], color="black", lw=0.4)
    axes.annotate("layer: E, ν, thickness", (-10.5, -1.3))
    axes.annotate("half-space: E, ν", (-10.5, -5))
    axes.annotate("cells of the\npotential\ncontact area", (-8.2, 0), (-10.9, 1.3), arrowprops=line)
    axes.annotate("", (10.5, 7.2), (5.5, 7.2), arrowprops={"arrowstyle": "->"})
    axes.annotate("rolling direction x", (4.6, 7.6))
    axes.annotate("pressure p of a cell", (-3.5, 4.5), (-10, 6.4), arrowprops=line)
    axes.set(xlim=(-11, 11), ylim=(-8, 8.6), aspect="equal", yticks=[], xlabel="x [mm]")
    axes.spines["left"].set_visible(False)


def half_spaces(folder):
    plain, layered = solved(0), solved(2)
    figure, axes = plt.subplots(1, 3, figsize=(11, 3.4), gridspec_kw={"width_ratios": [1.5, 1.1, 1]})
    cells_of(axes[0], layered)
    depths = np.linspace(0, 8e-3, 81)
    for result, colour, name in ((plain, "#666666", "no layer"), (layered, "#d1495b", "2 mm, twice the modulus")):
        patch = result.patch
        row = int(np.argmax(np.asarray(patch.p).max(axis=0)))
        x = MM * np.asarray(patch.x)[:, row]
        axes[1].plot(x, MPA * np.asarray(patch.p)[:, row], color=colour, label=f"{name}")
        axes[1].plot(x, MPA * np.hypot(patch.q_x, patch.q_y)[:, row], color=colour, ls="--")
        y = float(np.asarray(patch.y)[0, row])
        points = [[0, y, depth] for depth in depths]
        axes[2].plot(MPA * rs.von_mises(result.rail.at(points)), MM * depths, color=colour, label=name)
    axes[1].set(xlabel="x [mm]", ylabel="pressure; dashed: shear [MPa]", xlim=(-8, 8))
    axes[2].set(xlabel="von Mises stress below the middle [MPa]", ylabel="depth [mm]", ylim=(8, 0), xlim=(0, None))
    axes[2].legend(frameon=False, fontsize=8, loc="lower left")
    save(figure, folder / "half_spaces.png")


def hexahedra(file):
    """(cells, 8, 3) corners in mm, (cells,) the material's number."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    grid = reader.GetOutput()
    points = MM * vtk_to_numpy(grid.GetPoints().GetData())
    corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 8)
    data = grid.GetCellData()
    names = [data.GetArrayName(k) for k in range(data.GetNumberOfArrays())]
    material = next((name for name in names if name in ("material", "layer", "region")), None)
    if material is None:
        raise SystemExit(f"{file}: no material among {names}")
    return points[corners], vtk_to_numpy(data.GetArray(material))


def draw_cut(axes, cells, material, axis, place, colours):
    """Quadrilaterals of the elements that a plane axis = place goes through, seen along that axis."""
    low, high = cells[:, :, axis].min(axis=1), cells[:, :, axis].max(axis=1)
    cut = (low <= place) & (place < high)
    other = [k for k in range(3) if k != axis]
    polygons = []
    for cell in cells[cut]:
        face = cell[np.argsort(np.abs(cell[:, axis] - cell[:, axis].min()), kind="stable")[:4]][:, other]
        middle = face.mean(axis=0)
        polygons.append(face[np.argsort(np.arctan2(*(face - middle).T))])
    shown = [colours[min(int(m), 1)] for m in material[cut]]
    axes.add_collection(PolyCollection(polygons, facecolors=shown, edgecolors="#37474f", linewidths=0.35))


def finite_elements(program, folder):
    with tempfile.TemporaryDirectory() as scratch:
        out = pathlib.Path(scratch) / "mesh"
        subprocess.run([program, "check", ROOT / "cases/quick", "--set", "mesh.element_size=2 mm", "--mesh", "--out",
                        out, "--quiet"], check=True, stdout=subprocess.DEVNULL)
        bodies = [(hexahedra(out / f"{name}.vtu"), colours)
                  for name, colours in (("rail", (STEEL, LAYER)), ("wheel", (WHEEL, LAYER)))]
    top = bodies[0][0][0][:, :, 2].max()
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.3))
    for (cells, material), colours in bodies:
        draw_cut(axes[0], cells, material, 0, 0.1, colours)
        draw_cut(axes[1], cells, material, 1, 0.1, colours)
    axes[0].set(xlim=(-45, 45), ylim=(top - 45, top + 20), aspect="equal", xlabel="y, across [mm]",
                ylabel="z [mm]", title="section: fine cap, coarser shells, hanging nodes")
    axes[1].set(xlim=(-60, 60), ylim=(top - 45, top + 42), aspect="equal", xlabel="x, rolling direction [mm]",
                title="along the rail: stations of equal spacing")
    save(figure, folder / "finite_elements.png")


def save(figure, file):
    figure.tight_layout()
    figure.savefig(file, dpi=100)
    plt.close(figure)


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    folder = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else ROOT / "docs/images"
    half_spaces(folder)
    finite_elements(program, folder)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main()
