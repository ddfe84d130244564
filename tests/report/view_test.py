#!/usr/bin/env python3
"""view.py of a run shows wheel, rail, layer and stress. Under xvfb, with Debian's python3-vtk9. usage: view_test.py
RESULTS"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from selected import main, slow  # noqa: E402
from tables import read_table, row_borders

try:
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError as missing:
    print(f"SKIPPED: {missing} (Debian package python3-vtk9)")
    sys.exit(77)
if not shutil.which("xvfb-run") or not shutil.which("xauth"):
    print("SKIPPED: no xvfb-run (Debian packages xvfb, xauth)")
    sys.exit(77)

RESULTS = pathlib.Path(sys.argv[1]).resolve()


def picture(folder, *words):
    """The picture as rows of RGB, from the top."""
    with tempfile.TemporaryDirectory() as place:
        file = pathlib.Path(place) / "view.png"
        done = subprocess.run(["xvfb-run", "-a", sys.executable, folder / "view.py", "--png", file, *words],
                              capture_output=True, text=True, timeout=120, cwd=place)
        assert done.returncode == 0 and file.exists() and "ERR" not in done.stderr, done.stdout + done.stderr
        reader = vtkPNGReader()
        reader.SetFileName(str(file))
        reader.Update()
        width, height, _ = reader.GetOutput().GetDimensions()
        return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(height, width,
                                                                                    -1)[::-1, :, :3].astype(int)


def points(file):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPoints().GetData())


def share(image, colour, within=14):
    return (np.abs(image - colour).max(axis=2) <= within).mean()


YELLOW, RED, BLUE = (253, 231, 36), (179, 23, 43), (33, 102, 171)
PIXEL = 2 * 0.026 / 1000  # m: HALF_HEIGHT of view.py over half the picture's height
SIGHT = np.array([0.12, -0.5, 0.131]) / np.linalg.norm([0.12, -0.5, 0.131])  # from the contact to the eye
RISE = np.hypot(SIGHT[0], SIGHT[1])  # of a vertical length in the picture


def coloured(image):
    """Pixels of the scale, not of grey steel, black lines or white ground."""
    return np.ptp(image, axis=2) > 40


def section_size(folder, body):
    """Length and depth of the longitudinal section, m."""
    table = read_table(folder / f"{body}_longitudinal_section.csv")
    x, depth = sorted(set(table["x_mm"])), sorted(set(table["depth_mm"]))
    return 1e-3 * (x[-1] - x[0]) * len(x) / (len(x) - 1), 1e-3 * row_borders(depth)[-1]


class View(unittest.TestCase):
    def test_a_run_shows_its_stresses_at_the_size_of_its_sections(self):
        bodies = picture(RESULTS / "fem")[:, :1180]  # without the scale
        front = sum(np.prod(section_size(RESULTS / "fem", body))
                    for body in ("rail", "wheel")) * abs(SIGHT[1]) / PIXEL**2
        self.assertGreater(coloured(bodies).sum(), 0.9 * front)  # some of it are edges of elements
        self.assertLess(coloured(bodies).sum(), 2 * front)  # with the faces at the side and on top
        self.assertGreater(share(bodies, YELLOW, 40), 1e-3, "the largest von Mises stress")
        steel = (np.ptp(bodies, axis=2) < 12) & (bodies.min(axis=2) > 80) & (bodies.max(axis=2) < 245)
        self.assertGreater(steel.mean(), 0.02, "wheel and rail around")

    @slow
    def test_black_lines_border_the_layer_of_3_mm(self):
        bodies = picture(RESULTS / "fem")[120:, :1180]
        black = bodies.max(axis=2) < 12
        length, _ = section_size(RESULTS / "fem", "rail")
        self.assertGreater(black.sum(), 2 * length * np.hypot(1, SIGHT[0]) / PIXEL)
        column = np.flatnonzero(coloured(bodies)[250:].any(axis=0))[0] + 40  # a little right of the rail's front edge
        rows = np.flatnonzero(black[:, column])
        self.assertAlmostEqual(np.ptp(rows) * PIXEL / RISE, 3e-3, delta=0.25e-3)

    @slow
    def test_principal_stresses_have_tension_and_compression(self):
        bodies = picture(RESULTS / "fem", "--field", "sigma_1_MPa")[:, :1180]
        self.assertGreater(share(bodies, BLUE, 40), 5e-3)
        self.assertGreater(share(bodies, RED, 60), 2e-4)

    def test_a_half_space_result_shows_its_patch_at_its_size(self):
        bodies = picture(RESULTS / "bem")[:, :1180]
        area = json.loads((RESULTS / "bem" / "summary.json").read_text())["contact"]["patch_area_m2"]
        # the rail's surface rises by some 25 mrad
        self.assertAlmostEqual(coloured(bodies).sum() * PIXEL**2 / (area * SIGHT[2]), 1, delta=0.2)
        self.assertGreater(share(bodies, YELLOW, 60), 1e-4)

    @slow
    def test_arrows_of_10_mm_show_the_axes(self):
        corner = picture(RESULTS / "fem")[650:, :420]
        dark = (np.abs(corner - 51).max(axis=2) < 8)
        rows, columns = dark.sum(axis=1), dark.sum(axis=0)
        x_arrow, z_arrow = rows.max(), columns.max()  # the shafts with their heads lie nearly along both
        right = np.array([-SIGHT[1], SIGHT[0], 0]) / np.hypot(SIGHT[0], SIGHT[1])
        self.assertAlmostEqual(z_arrow * PIXEL / (0.010 * RISE), 1, delta=0.05)
        self.assertGreater(x_arrow * PIXEL, 0.3 * 0.010 * abs(right[0]))

    def test_the_surfaces_touch_at_the_contact_point_only(self):
        rail, wheel = points(RESULTS / "bem" / "rail_surface.vtp"), points(RESULTS / "bem" / "wheel_surface.vtp")
        summit = rail[np.abs(rail[:, 0] - rail[:, 0].mean()) < 1e-9]  # the section below the axle
        lowest = wheel[np.abs(wheel[:, 0] - wheel[:, 0].mean()) < 1e-6]
        lowest = lowest[lowest[:, 2] < wheel[:, 2].mean()]
        lowest = lowest[np.argsort(lowest[:, 1])]
        inside = (summit[:, 1] > lowest[0, 1]) & (summit[:, 1] < lowest[-1, 1])
        gap = np.interp(summit[inside, 1], lowest[:, 1], lowest[:, 2]) - summit[inside, 2]
        self.assertGreater(gap.min(), -2e-6)  # both curves are drawn as lines between points a millimetre apart
        self.assertLess(gap.min(), 2e-6)
        self.assertLess(abs(summit[inside, 1][gap.argmin()]), 2e-3, "near the crown, where LMA meets CN60")

    def test_without_a_display_it_says_what_helps(self):
        bare = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        for display in ({}, {"DISPLAY": ":4711"}):
            done = subprocess.run([sys.executable, RESULTS / "bem" / "view.py", "--png", "no.png"], capture_output=True,
                                  text=True, timeout=120, env=bare | display)
            if done.returncode == 0:
                pathlib.Path("no.png").unlink()  # a VTK that draws without a display
                continue
            self.assertEqual((done.returncode, done.stderr), (1, "view.py: VTK needs a display, e.g. xvfb-run -a "
                                                                 "python3 view.py --png view.png\n"))
        done = subprocess.run([sys.executable, RESULTS / "bem" / "view.py"], capture_output=True, text=True,
                              timeout=120, env=bare)
        self.assertEqual((done.returncode, done.stderr), (1, "view.py: a window needs a display; a picture without "
                                                             "one: xvfb-run -a python3 view.py --png view.png\n"))

    def test_the_script_knows_where_it_was_written(self):
        for folder in ("fem", "bem"):
            text = (RESULTS / folder / "view.py").read_text()
            self.assertIn(f'WRITTEN_TO = "{RESULTS / folder}"', text)


if __name__ == "__main__":
    main()
