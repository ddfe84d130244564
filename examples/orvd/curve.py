#!/usr/bin/python3
"""A vehicle of OpenRailVehicleDynamics in its curves, with its own contact and with RailStrata's beside it.

usage: curve.py CHECKOUT LIBRARY [--radius 1000] [--seconds 8] [--cell 1e-3] [--folder FOLDER]

CHECKOUT: a clone of github.com/wenquantongxin/OpenRailVehicleDynamics; LIBRARY: librailstrata.so. Builds both in
FOLDER/build (Debian: libsundials-dev libeigen3-dev libfmt-dev nlohmann-json3-dev), checks the adapter by one_wheel,
then runs GZ18 at 60 km/h on the shipped track of each radius, without irregularities, and prints a table of the end of
the run. Results are in FOLDER/r1000-theirs, FOLDER/r1000-ours."""
import argparse
import csv
import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
RUNNER = "orvd_gz18_dynamics_qualification"
STARTUP = "vehicle_library/gz18/startup_states/moving_startup_60kmh.json"
WHEEL_PROFILE = "vehicle_library/gz18/wheel_profiles/gz18_reference_wheel_profile.json"
RAIL_PROFILE = "track_library/rail_profiles/uic60_rail_profile.json"
OFFSET = "rail_profile_reference_vertical_offset_meters"
LENGTH = {1000: 300}  # m, of the track; 1100 of the others
CASE = """# The wheel of GZ18 on UIC60, as its own contact has it.
[case]
title = "wheel of GZ18 on UIC60"

[geometry]
wheel_profile = "wheel.txt"
rail_profile = "rail.txt"
gauge = "1435 mm"
gauge_depth = "16 mm"
back_to_back = "1353 mm"
flange_back_to_tape = "70 mm"
cant = 0.025
wheel_radius = "{radius:.9g} mm"

[material.rail]
young = "210 GPa"
poisson = 0.28

[material.wheel]
young = "210 GPa"
poisson = 0.28

[drive]
friction_coefficient = 0.3

[friction]
law = "falling_exponential"
kinetic_coefficient = 0.12
half_velocity = "1.26027 m/s"
"""


def write_profile(source, target):
    """Theirs have z downwards. Returns the height at y = 0, which RailStrata moves to 0."""
    data = json.loads(source.read_text())
    y, z = data["lateral_meters"], [-v for v in data["vertical_meters"]]
    target.write_text("".join(f"{a:.12g} {b:.12g}\n" for a, b in zip(y, z)))
    k = next(i for i in range(len(y)) if y[i + 1] > 0)
    return z[k] - y[k] * (z[k + 1] - z[k]) / (y[k + 1] - y[k])


def write_case(checkout, folder):
    write_profile(checkout / RAIL_PROFILE, folder / "rail.txt")
    height = write_profile(checkout / WHEEL_PROFILE, folder / "wheel.txt")
    (folder / "case.toml").write_text(CASE.format(radius=1e3 * (0.42 - height)))


def write_data(checkout, folder):
    """Their data with a track that has no irregularities, which their program wants named."""
    data = folder / "data"
    shutil.rmtree(data, ignore_errors=True)
    shutil.copytree(checkout / "track_library", data / "track_library")
    (data / "vehicle_library").symlink_to(checkout / "vehicle_library")
    irregularities = data / "track_library/irregularities"
    (irregularities / "none.json").write_text(json.dumps({
        "track_irregularity_identifier": "none", "coordinate_frame": "track_lateral_right_vertical_down",
        "lateral_series_identifier": "level", "vertical_series_identifier": "level"}))
    (irregularities / "series/level.json").write_text(json.dumps({
        "series_identifier": "level", "track_station_meters": [0, 1e4], "displacement_meters": [0, 0]}))


def build(checkout, library, folder):
    target = folder / "build"
    subprocess.run(["cmake", "-S", HERE, "-B", target, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                    f"-DORVD={checkout}", f"-DRAILSTRATA_LIBRARY={library}"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", target, "-j2", "--target", RUNNER, "one_wheel"], check=True,
                   stdout=subprocess.DEVNULL)
    return target


def prepare(checkout, library, folder):
    """Builds, writes the data; returns what one_wheel printed and its exit code."""
    folder.mkdir(parents=True, exist_ok=True)
    target = build(checkout, library, folder)
    write_case(checkout, folder)
    write_data(checkout, folder)
    done = subprocess.run([target / "one_wheel", checkout, folder / "case.toml"], stdout=subprocess.PIPE, text=True)
    return done.stdout, done.returncode


def write_startup(checkout, folder, raise_rail):
    """RailStrata's wheels sink deeper under the same force: the rail stands higher, the vehicle starts in balance."""
    for who, higher in (("theirs", 0), ("ours", raise_rail)):
        state = json.loads((checkout / STARTUP).read_text())
        state[OFFSET] -= higher
        (folder / f"startup-{who}.json").write_text(json.dumps(state))


def drive(folder, who, radius, seconds, cell=1e-3):
    """Runs the vehicle; returns the report of its contacts and the processor time, s."""
    out, report, data = folder / f"r{radius}-{who}", folder / f"r{radius}-{who}.txt", folder / "data"
    shutil.rmtree(out, ignore_errors=True)
    environment = dict(os.environ, OMP_NUM_THREADS="1", RAILSTRATA_REPORT=str(report), RAILSTRATA_CELL=str(cell))
    environment.pop("RAILSTRATA_CASE", None)
    if who == "ours":
        environment["RAILSTRATA_CASE"] = str(folder / "case.toml")
    program = next((folder / "build").rglob(RUNNER))
    track = f"r{radius}_centerline_superelevation_{LENGTH.get(radius, 1100)}m.json"
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    command = [program, data / "vehicle_library/gz18/vehicle_definition.json", folder / f"startup-{who}.json",
               data / "track_library/geometries" / track, data, "none", out, str(round(1e9 * seconds)), "10000000"]
    done = subprocess.run(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit(f"radius {radius} m, contact {who}: {done.stderr}")
    return read_report(report), resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def read_report(path):
    """Calls, seconds, and of each wheel the normal force and the energy, N: of the end of the run."""
    words = [line.split() for line in path.read_text().splitlines()]
    out = {w[0]: float(w[1]) for w in words if w[0] != "wheel"}
    out["wheels"] = [(w[1], *map(float, w[2:])) for w in words if w[0] == "wheel"]
    return out


def last_rows(path):
    rows = list(csv.DictReader(path.open(), delimiter="\t"))
    return [row for row in rows if row["sample_index"] == rows[-1]["sample_index"]]


def end_of(folder, who, radius, report):
    """Numbers of the leading wheelset at the end, to the outside of the curve, by name. Their curves turn right."""
    out = folder / f"r{radius}-{who}"
    row = last_rows(out / "observations.tsv")[0]
    name = "front_leading_wheelset"
    found = {"shift [mm]": -1e3 * float(row[f"{name}.lateral_meters"]),
             "yaw [mrad]": 1e3 * float(row[f"{name}.yaw_radians"])}
    for side, place in (("left", "outer"), ("right", "inner")):
        wheel = f"{name}.{side}"
        patches = [r for r in last_rows(out / "contact_patches.tsv") if r["interface_name"] == wheel]
        first = max(patches, key=lambda r: float(r["normal_force_newtons"]))
        force = [float(row[f"{wheel}.total_force_on_wheel_in_carrier_track_frame_{axis}_newtons"]) for axis in "xyz"]
        normal = float(row[f"{wheel}.normal_force_newtons"])
        energy = min((w for w in report["wheels"] if w[0] == side), key=lambda w: abs(w[1] - normal))
        found.update({f"{place}: patches": len(patches), f"{place}: N [kN]": 1e-3 * normal,
                      f"{place}: Q [kN]": -1e-3 * force[2], f"{place}: Y [kN]": 1e-3 * force[1],
                      f"{place}: along the rail [kN]": 1e-3 * force[0],
                      f"{place}: contact angle [deg]": 57.29578 * abs(float(first["contact_frame_angle_radians"])),
                      f"{place}: force times creepage [N]": energy[2], f"{place}: energy, with spin [N]": energy[3]})
    return found


def compare(folder, radius, seconds, cell):
    """Runs both; returns name -> (theirs, ours)."""
    ends = []
    for who in ("theirs", "ours"):
        report, cpu = drive(folder, who, radius, seconds, cell)
        numbers = end_of(folder, who, radius, report)
        numbers["contact calls"] = report["calls"]
        numbers["time of a call [us]"] = 1e6 * report["seconds"] / report["calls"]
        numbers["processor time of the run [s]"] = cpu
        ends.append(numbers)
    return {name: (ends[0][name], ends[1][name]) for name in ends[0]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("checkout", type=lambda p: pathlib.Path(p).resolve())
    parser.add_argument("library", type=lambda p: pathlib.Path(p).resolve())
    parser.add_argument("--radius", type=int, nargs="+", default=[1000], choices=[300, 600, 800, 1000])
    parser.add_argument("--seconds", type=float, default=8)
    parser.add_argument("--cell", type=float, default=1e-3)
    parser.add_argument("--folder", type=lambda p: pathlib.Path(p).resolve(), default=pathlib.Path("orvd").resolve())
    options = parser.parse_args()
    text, code = prepare(options.checkout, options.library, options.folder)
    print(text, flush=True)
    if code:
        return code
    write_startup(options.checkout, options.folder, float(re.search(r"^raise (\S+)", text, re.M)[1]))
    for radius in options.radius:
        table = compare(options.folder, radius, options.seconds, options.cell)
        print(f"| radius {radius} m | theirs | ours |\n|---|---|---|")
        for name, values in table.items():
            print(f"| {name} | {values[0]:.5g} | {values[1]:.5g} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
