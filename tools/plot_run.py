#!/usr/bin/python3
"""Draws a finished run as one picture: pressure, traction, stick and slip, the centre line, and von Mises and the first
principal stress on the longitudinal section.

    tools/plot_run.py results/base [picture.png]

Needs Debian's python3-matplotlib, python3-numpy and python3-vtk9. Reads patch.csv, rail.vtu and summary.json of the
run's folder."""
import csv
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


def read_table(path):
    with open(path) as stream:
        rows = [row for row in csv.reader(line for line in stream if not line.startswith("#"))]
    return {name: np.array([float(row[k]) for row in rows[1:]]) for k, name in enumerate(rows[0])}


def section(path, field, y):
    """Cell values of the slab of elements at the lateral position y: x from the wheel [mm], z [mm], values on a
    grid."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    points = vtk_to_numpy(grid.GetPoints().GetData())
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 8)
    values = vtk_to_numpy(grid.GetCellData().GetArray(field) or grid.GetCellData().GetArray("sigma1_MPa"))  # 0.3
    corners = points[cells]
    low, high = corners[:, :, 1].min(axis=1) * 1e3, corners[:, :, 1].max(axis=1) * 1e3
    chosen = (low <= y) & (y < high)
    return corners[chosen][:, :, [0, 2]] * 1e3, values[chosen]


def draw_cells(axis, polygons, values, label, limits=None):
    from matplotlib.collections import PolyCollection

    # corners 0..3 lie on one station, 4..7 on the next: the outline in (x, z)
    outline = []
    for cell in polygons:
        z0, z1 = cell[:, 1].min(), cell[:, 1].max()
        x0, x1 = cell[:, 0].min(), cell[:, 0].max()
        outline.append([(x0, z0), (x1, z0), (x1, z1), (x0, z1)])
    collection = PolyCollection(outline, array=values, cmap="turbo", edgecolors="none")
    if limits:
        collection.set_clim(*limits)
    axis.add_collection(collection)
    axis.autoscale_view()
    axis.set_aspect("equal")
    axis.set_xlabel("x [mm]")
    axis.set_ylabel("z [mm]")
    plt.colorbar(collection, ax=axis, label=label, shrink=0.9)


def main():
    folder = pathlib.Path(sys.argv[1])
    target = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else folder / "run.png"
    summary = json.loads((folder / "summary.json").read_text())
    patch = read_table(folder / "patch.csv")
    x, y = patch["x_mm"], patch["y_mm"]
    columns = len(np.unique(np.round(y, 9)))
    shape = (-1, columns)
    grid = {name: values.reshape(shape) for name, values in patch.items()}
    shear = np.hypot(grid["q_x_MPa"], grid["q_y_MPa"])

    figure, axes = plt.subplots(2, 3, figsize=(15, 7.6), constrained_layout=True)
    inside = np.abs(x) < 14
    limits = (x[inside].min(), x[inside].max())
    for axis, data, label, cmap in ((axes[0, 0], grid["p_MPa"], "pressure p [MPa]", "turbo"),
                                    (axes[0, 1], shear, "shear |q| [MPa]", "turbo")):
        image = axis.pcolormesh(grid["x_mm"], grid["y_mm"], data, shading="gouraud", cmap=cmap)
        plt.colorbar(image, ax=axis, label=label, shrink=0.9)
        axis.set(xlabel="x, rolling direction [mm]", ylabel="y, to the field side [mm]", xlim=limits, aspect="equal")
    state = grid["state_0separated_1stick_2slip"]
    axes[0, 2].pcolormesh(grid["x_mm"], grid["y_mm"], np.ma.masked_equal(state, 0), shading="nearest", cmap="coolwarm",
                          vmin=1, vmax=2)
    axes[0, 2].set(xlabel="x, rolling direction [mm]", ylabel="y, to the field side [mm]", xlim=limits, aspect="equal",
                   title="stick (blue) and slip (red)")
    column = np.unravel_index(np.argmax(grid["p_MPa"]), grid["p_MPa"].shape)[1]
    axes[1, 0].plot(grid["x_mm"][:, column], grid["p_MPa"][:, column], "k.-", label="p")
    axes[1, 0].plot(grid["x_mm"][:, column], shear[:, column], "r.-", label="|q|")
    axes[1, 0].set(xlabel="x, rolling direction [mm]", ylabel="MPa", xlim=limits, title="centre line")
    axes[1, 0].legend()
    axes[1, 0].grid(alpha=0.3)
    lateral = grid["y_mm"][0, column] + 1e-3
    for axis, field, label in ((axes[1, 1], "von_mises_MPa", "von Mises [MPa]"),
                               (axes[1, 2], "sigma_1_MPa", "first principal stress [MPa]")):
        polygons, values = section(folder / "rail.vtu", field, lateral)
        draw_cells(axis, polygons, values, label)
        axis.set_title("rail, longitudinal section")
    contact = summary["contact"]
    figure.suptitle(
        f"{summary['title']}: p_max {contact['p_max_Pa'] / 1e6:.0f} MPa, patch {contact['patch_length_m'] * 1e3:.1f} "
        f"x {contact['patch_width_m'] * 1e3:.1f} mm, "
                    f"F_x/F_z {contact['F_x_N'] / contact['F_z_N']:.3f}")
    figure.savefig(target, dpi=110)
    print(target)


if __name__ == "__main__":
    main()
