#!/usr/bin/env python3
"""Result folders for the tests of the report: fem (a wheel on a layered block, 30 mm of rolling), its reference
fem/half_space, bem (LMA on CN60 by half-spaces, with two layers), sweep, creep, rest and uneven (shipped transients),
old (what folders held before they had sections and geometry), study (both engines). With --slow, for the slow tests
alone, in the same folder: fretting, two (two patches), wheel (a layer on the wheel).
usage: make_results.py BINARY FOLDER [--slow]"""
import pathlib
import shutil
import subprocess
import sys

BINARY, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
ROLLING = """
[case]
title = "a wheel <b>on</b> a layered block & more"
[geometry]
rail_profile = "flat"
wheel_profile = "arc:R=430 mm"
rail_shape = "block"
wheel_shape = "disc"
cant = 0.0
bore_radius = "250 mm"
[[layer]]
name = "clad"
thickness = "3 mm"
young_ratio = 2.0
[vehicle]
wheel_mass = "1500 kg"
sprung_mass = "7000 kg"
[mesh]
element_size = "3 mm"
fine_width = "30 mm"
fine_depth = "12 mm"
coarse_ratio = 2
largest = "20 mm"
end_length = "60 mm"
[drive]
torque_ramp = "0.5 ms"
[run]
positions = ["30 mm"]
window = "6 mm"
run_up = "0 mm"
"""
HALF_SPACE = """
[case]
title = "two layers by half-spaces"
[geometry]
lateral_shift = "1.5 mm"
[[layer]]
name = "hard"
thickness = "0.5 mm"
young_ratio = 1.5
[[layer]]
name = "bond"
thickness = "1.5 mm"
young_ratio = 0.8
"""

TWO_PATCHES = """
[case]
title = "tread and flange"
[geometry]
rail_profile = "UIC60"
wheel_profile = "S1002"
cant = 0.05
gauge_depth = "14 mm"
back_to_back = "1353 mm"
wheel_radius = "430 mm"
lateral_shift = "9.7 mm"
[drive]
traction_coefficient = 0.02
"""

WHEEL_LAYER = """
[case]
title = "a layer on the wheel alone"
[geometry]
lateral_shift = "1.5 mm"
[[layer]]
name = "tyre"
on = "wheel"
thickness = "1.5 mm"
young_ratio = 1.5
"""

STUDY = """
[study]
title = "a small <i>study</i>"
base = "layers.toml"
engines = ["bem"]
cell = "0.8 mm"
[[group]]
name = "grid"
[group.vary]
"layer.0.thickness" = ["0.5 mm", "10 mm"]
"layer.0.young_ratio" = [1.5, 4]
[[group]]
name = "plain"
base = "plain.toml"
tags = { "layer.0.young_ratio" = 1 }
[[group]]
name = "wheel"
base = "rolling.toml"
engines = ["fem", "bem"]
set = { "run.positions" = ["12 mm"], "mesh.element_size" = "4 mm" }
[[group]]
name = "broken"
base = "plain.toml"
set = { "geometry.gauge" = "1.7 m" }
[[figure]]
id = "lines"
title = "Shear"
kind = "centre_line"
value = "q"
each = "layer.0.thickness"
series = "layer.0.young_ratio"
groups = ["grid", "plain"]
[[figure]]
id = "trend"
title = "Trend"
kind = "trend"
value = "p_max_MPa"
x = "layer.0.thickness"
series = "layer.0.young_ratio"
groups = ["grid", "plain"]
[[figure]]
id = "states"
title = "States"
kind = "map"
value = "state"
series = "layer.0.young_ratio"
groups = ["grid"]
where = { "layer.0.thickness" = ["10 mm"] }
[[figure]]
id = "stress"
title = "Stress"
kind = "map"
value = "von_mises"
series = "layer.0.young_ratio"
groups = ["grid"]
where = { "layer.0.thickness" = ["0.5 mm"] }
"""


def railstrata(*words):
    done = subprocess.run([BINARY, *map(str, words)], capture_output=True, text=True, timeout=240)
    if done.returncode not in (0, 1):  # 1: a check of so coarse a result may fail
        sys.exit(f"{words}: exit {done.returncode}\n{done.stdout}{done.stderr}")


TRANSIENTS = pathlib.Path(__file__).resolve().parents[2] / "cases" / "transient"
if sys.argv[3:] == ["--slow"]:  # beside the others, which are there
    railstrata("bem", TRANSIENTS / "fretting.toml", "--out", FOLDER / "fretting", "--cell", "0.4 mm", "--threads", "1",
               "--quiet")
    (FOLDER / "two.toml").write_text(TWO_PATCHES)
    railstrata("bem", FOLDER / "two.toml", "--out", FOLDER / "two", "--cell", "0.5 mm", "--threads", "1", "--quiet")
    (FOLDER / "wheel.toml").write_text(WHEEL_LAYER)
    railstrata("bem", FOLDER / "wheel.toml", "--out", FOLDER / "wheel", "--cell", "0.5 mm", "--threads", "1", "--quiet")
    sys.exit()

shutil.rmtree(FOLDER, ignore_errors=True)
FOLDER.mkdir(parents=True)
(FOLDER / "rolling.toml").write_text(ROLLING)
(FOLDER / "layers.toml").write_text(HALF_SPACE)
railstrata("run", FOLDER / "rolling.toml", "--out", FOLDER / "fem", "--threads", "1", "--quiet")
railstrata("bem", FOLDER / "layers.toml", "--out", FOLDER / "bem", "--cell", "0.4 mm", "--threads", "1", "--quiet")
railstrata("bem", TRANSIENTS.parent / "along" / "indentation.toml", "--out", FOLDER / "uneven", "--cell", "0.5 mm",
           "--threads", "1", "--quiet")
railstrata("bem", TRANSIENTS / "from_rest.toml", "--out", FOLDER / "rest", "--cell", "0.5 mm", "--threads", "1",
           "--set", "output.series_frames=8", "--quiet")
railstrata("run", FOLDER / "rolling.toml", "--out", FOLDER / "yields", "--threads", "1", "--quiet", "--no-report",
           "--set", "run.plasticity=true", "--set", 'material.rail.yield_strength="350 MPa"', "--set",
           'layer.0.yield_strength="600 MPa"', "--set",
           'material.rail.kinematic_hardening=[{modulus = "20 GPa", recall = 50}]')
railstrata("report", FOLDER / "yields", FOLDER / "fem", "--out", FOLDER / "yields.html", "--quiet")
railstrata("sweep", FOLDER / "layers.toml", "--out", FOLDER / "sweep", "--cell", "0.8 mm", "--vary",
           "layer.0.thickness=1 mm,0.5 mm,2 mm", "--vary", "drive.friction_coefficient=0.3,0.5", "--quiet")
railstrata("creep", FOLDER / "layers.toml", "--out", FOLDER / "creep", "--cell", "0.8 mm", "--points", "7",
           "--quiet")
shutil.copytree(FOLDER / "fem", FOLDER / "old")
for file in [*(FOLDER / "old").glob("*_section.csv"), FOLDER / "old" / "geometry.json", FOLDER / "old" / "report.html"]:
    file.unlink(missing_ok=True)
railstrata("report", FOLDER / "old", "--no-reference", "--quiet")
railstrata("report", FOLDER / "fem", FOLDER / "bem", FOLDER / "fem" / "half_space", "--out", FOLDER / "three.html",
           "--quiet")
(FOLDER / "plain.toml").write_text(HALF_SPACE.split("[[layer]]")[0])
(FOLDER / "study.toml").write_text(STUDY)
railstrata("study", FOLDER / "study.toml", "--out", FOLDER / "study", "--quiet")
