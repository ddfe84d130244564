"""rs.bem: the program's numbers, views, errors, threads."""
import copy
import gc
import json
import math
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import warnings
from pathlib import Path

import numpy as np
import pytest

import railstrata as rs


def without_times(summary):
    return {key: value for key, value in summary.items() if key != "run"}


def rows(file):
    return [line for line in file.read_text().splitlines() if not line.startswith("#")]


def test_numbers_are_those_of_the_program_to_the_bit(program, result, tmp_path):
    subprocess.run([program, "bem", rs.shipped_data() / "cases/quick", "--out", tmp_path / "bem"], check=True,
                   capture_output=True)
    of_program = json.loads((tmp_path / "bem" / "summary.json").read_text())
    assert without_times(result.summary) == without_times(of_program)
    saved = result.save(tmp_path / "saved")
    with pytest.raises(rs.CaseError, match="choose another folder, or overwrite .* with force=True") as full:
        result.save(tmp_path / "saved")
    assert "--" not in full.value.diagnostics[0].remedy
    with pytest.raises(FileNotFoundError, match="tables here: centre_line, depth_line, patch"):
        saved.table("bogus")
    assert without_times(saved.summary) == without_times(of_program)
    assert rows(tmp_path / "saved" / "patch.csv") == rows(tmp_path / "bem" / "patch.csv")


def test_arrays_are_read_only_views_that_outlive_the_result(case):
    result = rs.bem(case, stresses=False)
    p = result.patch.p
    assert p.shape == result.patch.shape and p.dtype == np.float64
    assert not p.flags.owndata and not p.flags.writeable
    assert p.ctypes.data == result.patch.p.ctypes.data
    with pytest.raises(ValueError):
        p[0, 0] = 1
    sum_before = p.sum()
    del result
    gc.collect()
    assert p.sum() == sum_before


def test_pressure_bears_the_load_and_friction_gives_the_force(result):
    patch = result.patch
    assert (patch.p * patch.area).sum() == pytest.approx(result.normal_force, rel=1e-3)
    assert (patch.q_x * patch.area).sum() == pytest.approx(-result.force[0], rel=1e-2)
    slip = patch.state == rs.PatchState.SLIP
    assert patch.area[slip].sum() == pytest.approx(result.slip_area, rel=0.05)  # whole cells at the edges of slip


def test_stresses_at_points_planes_and_maxima_agree(result):
    peak = result.peaks("rail", "layer").von_mises
    x, y = result.rail.axes
    plane = rs.von_mises(result.rail.plane(peak.depth), axis=0)
    assert plane.shape == (len(x), len(y))
    assert plane.max() == pytest.approx(peak.value, rel=1e-3)
    i, j = np.unravel_index(plane.argmax(), plane.shape)
    at = result.rail.at([[x[i], y[j], peak.depth]])
    assert rs.von_mises(at)[0] == pytest.approx(plane[i, j], rel=1e-6)
    section = result.rail.section([1e-3, 2e-3], y[j])
    assert section.shape == (6, len(x), 2)
    assert section[:, i, 1] == pytest.approx(result.rail.at([[x[i], y[j], 2e-3]])[0], rel=1e-12)


def test_a_body_or_zone_that_is_none_is_named(result):
    with pytest.raises(KeyError, match="'sleeper' is no body of the result: rail, wheel"):
        result.peaks("sleeper")
    with pytest.raises(KeyError, match="rail has no zone 'core'"):
        result.peaks("rail", "core")
    with pytest.raises(TypeError, match="a folder is wanted"):
        rs.open(3)


def test_faults_keep_place_and_remedy():
    with pytest.raises(rs.CaseError) as caught:
        rs.Case("cases/quick", {"layer.0.thicknes": "1 mm", "friction.coefficient": -1})
    remedies = [d.remedy for d in caught.value.diagnostics]
    assert any("did you mean thickness" in r for r in remedies)
    assert len(caught.value.diagnostics) >= 2
    with pytest.raises(rs.CaseError, match="cell"):
        rs.bem(rs.Case("cases/quick"), cell=1.0)
    with pytest.raises(rs.CaseError, match="no such file|cannot be read|cannot read"):
        rs.Case("cases/nothing_here.toml")


def test_points_that_have_no_stress_are_refused(result):
    for points in ([[0, 0, -1e-3]], [[0, 0]], [[np.nan, 0, 1e-3]]):
        with pytest.raises(ValueError):
            result.rail.at(points)
    with pytest.raises(ValueError):
        result.rail.plane(-1.0)


def test_two_threads_at_once_have_the_bits_of_one(case):
    alone = rs.bem(case, threads=1).summary["contact"]
    found = [None, None]

    def solve(k):
        found[k] = rs.bem(case, threads=1).summary["contact"]

    both = [threading.Thread(target=solve, args=(k,)) for k in range(2)]
    for one in both:
        one.start()
    for one in both:
        one.join()
    assert found == [alone, alone]


def test_cases_are_changed_without_changing_the_first(case):
    thicker = case.with_({"layer.0.thickness": "3 mm"})
    assert thicker["layer.0.thickness"] == "3 mm" and case["layer.0.thickness"] == "2 mm"
    with pytest.raises(KeyError):
        case["layer.0.no_such"]
    again = rs.Case.from_text(case.toml, case.file)
    assert rs.bem(again, stresses=False).p_max == rs.bem(case, stresses=False).p_max


def test_a_sweep_has_the_numbers_of_single_solutions(case):
    table = rs.sweep(case, {"layer.0.thickness": ["1 mm", "3 mm"], "layer.0.young_ratio": [0.5, 2]})
    frame = table.to_dataframe()
    assert len(table) == 4 and list(frame["fault"]) == [""] * 4
    single = rs.bem(case.with_({"layer.0.thickness": "3 mm", "layer.0.young_ratio": 0.5}), stresses=False)
    assert table["p_max_MPa"][2] == pytest.approx(single.p_max / 1e6, rel=1e-12)


@pytest.mark.slow
def test_shakedown_needs_a_strength_and_gives_ordered_factors(case):
    with pytest.raises(ValueError, match="yield_strength"):
        rs.shakedown(case)
    factors = rs.shakedown(case.with_({"material.rail.grade": "R260", "layer.0.grade": "R350HT"})).shakedown["factors"]
    assert factors["first_yield"] <= factors["wandering"] <= factors["single_track"] <= factors["upper"]


def test_a_shift_history_is_followed_and_stopped_by_its_progress_function():
    fretting = rs.Case("cases/transient/fretting.toml")
    seen = []
    rs.bem(fretting, 0.5e-3, stresses=False, progress=seen.append)
    assert all(0 <= fraction <= 1 for fraction in seen)

    def stop(_):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        rs.bem(fretting, 0.1e-3, stresses=False, progress=stop)


def test_ctrl_c_stops_a_solution_soon(case):
    """On cells so fine that it would take long."""
    pressed = []

    def press():
        pressed.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(1.0, press)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        rs.bem(case, cell=0.03e-3)
    assert time.monotonic() - pressed[0] < 5  # a loaded machine; 0.1 s on a free one


def test_numbers_of_a_case_are_in_si_units(case):
    """Alone, in lists and in tables; a text has its unit."""
    def resolved(changes):
        return case.with_(changes).toml

    for numbers, texts in (
        ({"vehicle.wheel_load": 80e3}, {"vehicle.wheel_load": "80 kN"}),
        ({"geometry.lateral_shift": 0.001}, {"geometry.lateral_shift": "1 mm"}),
        ({"geometry.lateral_shift": np.float32(0.001)}, {"geometry.lateral_shift": "1 mm"}),
        ({"run.positions": [0.3, 0.4]}, {"run.positions": ["300 mm", "40 cm"]}),
        ({"material.rail.young": int(207e9)}, {"material.rail.young": "207 GPa"}),
        ({"drive.wheel_rotation": 70.0}, {"drive.wheel_rotation": "70 rad/s"}),
        ({"layer": [{"thickness": 3e-3, "young": 400e9}]}, {"layer": '[{thickness = "3 mm", young = "400 GPa"}]'}),
        ({"geometry.cant": 0.025, "drive.friction_coefficient": 0.3, "run.rolling": True},
         {"geometry.cant": "1:40", "drive.friction_coefficient": "0.3", "run.rolling": "true"}),
        ({"material.rail.strength_table": [[0, 400e6], [5e-3, 300e6]]},
         {"material.rail.strength_table": '[["0 mm", "400 MPa"], ["5 mm", "300 MPa"]]'}),
    ):
        assert resolved(numbers) == resolved(texts) != case.toml, numbers
    shifted = rs.Case("cases/quick", {"geometry.lateral_shift": 1e-3})
    assert shifted.with_({"drive.speed": 20})["drive.speed"] == "20 m/s"


def test_faults_of_a_change_speak_of_the_dict_and_not_of_the_command_line(case):
    for changes, words in (
        ({"geometry.lateral_shift": 5.0}, '"geometry.lateral_shift": "5000 mm"}: .*between -50 mm and 50 mm'),
        ({"speed": 3}, 'names no table\n.*write {"mesh.element_size": "2 mm"} or {"layer.0.thickness": "0.5 mm"}'),
        ({"run.positions.0": "1 m"}, 'give the whole list, e.g. {"run.positions": ["0.1 m", "0.3 m"]}'),
        ({"layer.0.thickness": "1 kg"}, 'write a length'),
    ):
        with pytest.raises(rs.CaseError, match=words.replace("{", r"\{").replace("[", r"\[")) as caught:
            case.with_(changes)
        said = [str(caught.value), *(text for d in caught.value.diagnostics for text in (d.message, d.remedy, d.where))]
        assert not [text for text in said if "--" in text]
    with pytest.raises(ValueError, match="drive.speed: a finite number"):
        case.with_({"drive.speed": float("inf")})
    with pytest.raises(TypeError, match="is no key"):
        case.with_({3: 1})


def test_cases_with_the_same_options_are_equal(case):
    assert rs.Case("cases/quick") == case == rs.Case.from_text(case.toml, case.file)
    assert len({case, rs.Case("cases/quick"), case.with_({"drive.speed": 20})}) == 2
    assert case != case.with_({"drive.speed": 20}) and case != "cases/quick"


def test_results_are_pickled_with_their_numbers_and_arrays(result):
    again = pickle.loads(pickle.dumps(result))
    assert again.summary == result.summary and again.notes == result.notes and again.peaks() == result.peaks()
    for name in ("p", "q_x", "slip_y", "state", "x"):
        assert (getattr(again.patch, name) == getattr(result.patch, name)).all()
    assert not again.patch.p.flags.writeable and (pickle.loads(pickle.dumps(result.patch)).p == result.patch.p).all()
    for lost in (lambda: again.rail.at([[0, 0, 1e-3]]), lambda: again.wheel.axes, lambda: again.save("nowhere")):
        with pytest.raises(RuntimeError, match="solve the case again"):
            lost()


def test_a_deep_copy_of_a_result_keeps_the_inside_of_the_bodies(result):
    twin = copy.deepcopy(result)
    twin.summary["title"] = "another"
    assert result.title != "another"
    assert (twin.rail.at([[0, 0, 1e-3]]) == result.rail.at([[0, 0, 1e-3]])).all()


def test_a_spawned_process_gives_results_back(case):
    program = ("import multiprocessing, railstrata as rs\n"
               "def solve(case): return rs.bem(case, 1e-3, stresses=False)\n"
               "if __name__ == '__main__':\n"
               "    with multiprocessing.get_context('spawn').Pool(1) as pool:\n"
               "        [found] = pool.map(solve, [rs.Case('cases/quick')])\n"
               "    print(repr(found.p_max), found.patch.p.max())\n")
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "pool.py"
        script.write_text(program)
        done = subprocess.run([sys.executable, script], capture_output=True, text=True, check=True)
    here = rs.bem(case, 1e-3, stresses=False)
    assert done.stdout.split() == [repr(here.p_max), str(here.patch.p.max())]


def test_a_sweep_keeps_numbers_and_turns_units_into_si(case):
    varied = {"load": ["80 kN", "8 t"], "layer.0.thickness": [1e-3, 3e-3], "run.plasticity": False}
    table = rs.sweep(case, varied, "1 mm")
    gravity = 9.81
    assert table["load"] == pytest.approx([80e3, 80e3, 8000 * gravity, 8000 * gravity], rel=1e-12)
    assert list(table["layer.0.thickness"]) == [1e-3, 3e-3, 1e-3, 3e-3]
    assert table["run.plasticity"].dtype == bool
    assert table.units == {"load": "N", "layer.0.thickness": "m", "run.plasticity": ""}
    frame = table.to_dataframe()
    assert frame["layer.0.thickness"].dtype == np.float64 and frame.attrs["units"]["load"] == "N"
    assert [row["layer.0.thickness"] for row in table] == list(table["layer.0.thickness"]) and len(table) == 4
    assert "p_max_MPa" in table and "p_max" not in table
    with pytest.raises(KeyError, match="'p_max' is no column: load"):
        table["p_max"]
    grid = table.to_xarray().p_max_MPa
    assert grid.dims == ("load", "layer.0.thickness", "run.plasticity")
    assert grid["layer.0.thickness"].attrs["units"] == "m"
    assert (grid.values.ravel() == table["p_max_MPa"]).all()
    assert float(grid.sel({"layer.0.thickness": 3e-3}).isel(load=0)) == table["p_max_MPa"][1]


def test_a_life_is_that_of_a_sweep(case):
    yields = case.with_({
        "geometry.rail_profile": "arc:R=300 mm", "geometry.wheel_profile": "arc:R=-500 mm",
        "vehicle.wheel_load": "100 kN", "layer.0.thickness": "1 mm", "layer.0.young_ratio": 1,
        "layer.0.hardening": "R260", "material.rail.hardening": "R260",
        "life.until": "0.05 Mt", "passes.ductility": 0.02,
    })
    one = rs.bem(yields, "1 mm").summary["life"]
    assert 0 < one["best_kg"] < 0.05e9
    table = rs.sweep(yields, {"vehicle.wheel_load": ["100 kN"]}, "1 mm", stresses=True)
    assert table["life_best_MGT"][0] == pytest.approx(1e-9 * one["best_kg"], rel=1e-12)


def test_words_and_refused_values_of_a_sweep(case):
    words = rs.sweep(case, {"material.rail.grade": ["R260", "R350HT"]}, "1 mm")
    assert words["material.rail.grade"] == ["R260", "R350HT"]
    assert list(words.to_xarray()["material.rail.grade"].values) == ["R260", "R350HT"]
    refused = rs.sweep(case, {"layer.0.thickness": ["1 mm", "1 kg"]}, "1 mm")
    assert refused["layer.0.thickness"][0] == 1e-3 and np.isnan(refused["layer.0.thickness"][1])
    assert refused["fault"][0] == "" and "unit of a length" in refused["fault"][1]
    spread = rs.sweep(case, {"layer.0.thickness": "1:3 mm:3"}, "1 mm")
    assert spread["layer.0.thickness"] == pytest.approx([1e-3, 2e-3, 3e-3], rel=1e-12)
    with pytest.raises(ValueError, match="no key is given"):
        rs.sweep(case, {})


@pytest.mark.parametrize("none", [[], np.array([]), ()])
def test_a_sweep_over_no_values_is_refused(case, none):
    with pytest.raises(rs.CaseError, match="layer.0.thickness has no values"):
        rs.sweep(case, {"drive.traction_coefficient": [0.1], "layer.0.thickness": none})


def test_a_text_or_a_number_alone_is_one_value_of_a_sweep(case):
    table = rs.sweep(case, {"layer.0.thickness": "1 mm", "drive.traction_coefficient": 0.1}, cell="1 mm")
    assert len(table) == 1 and list(table["layer.0.thickness"]) == [1e-3] and table["fault"] == [""]


def test_a_drive_that_a_case_at_rest_makes_void_warns():
    still = rs.Case("cases/verification/hertz_sphere.toml")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rs.bem(still, 1e-3, stresses=False)
    driven = still.with_({"drive.creepage": 0.001})
    for work in (lambda: rs.bem(driven, 1e-3, stresses=False),
                 lambda: rs.sweep(still, {"drive.creepage": [0.001, 0.002]}, 1e-3)):
        with pytest.warns(rs.CheckWarning, match="drive.creepage has no effect with run.rolling = false"):
            work()
    assert any("drive.creepage" in note for note in driven.notes)


def test_points_far_away_are_refused_before_they_cost_memory(result):
    for far in ([100, 0, 1e-3], [0, -100, 1e-3], [1, 0, 1e-3]):
        with pytest.raises(ValueError, match="too far away.*metres"):
            result.rail.at([far])
    with pytest.raises(ValueError, match="row 1 lies above the surface"):
        result.rail.at([[0, 0, 1e-3], [0, 0, -1e-3]])


def test_what_is_given_wrongly_is_told_in_words(case, result):
    quick = "cases/quick"
    assert rs.bem(quick, "1 mm", stresses=False).p_max == rs.bem(case, 1e-3, stresses=False).p_max
    with pytest.raises(rs.CaseError, match="cell"):
        rs.bem(case, "1 kN")
    for kind, words, wrong in (
        (TypeError, "metres", lambda: rs.bem(case, cell=None)),
        (TypeError, "Case is wanted", lambda: rs.bem(5)),
        (TypeError, "whole number", lambda: rs.bem(case, threads="a")),
        (TypeError, "whole number", lambda: rs.threads("x")),
        (ValueError, "0 to 1024", lambda: rs.threads(10**9)),
        (ValueError, "0 to 1024", lambda: rs.bem(case, threads=-1)),
        (TypeError, "TOML text", lambda: rs.Case.from_text(5)),
        (TypeError, "a key is wanted", lambda: case[0]),
        (ValueError, "path is empty", lambda: rs.Case("")),
        (TypeError, "a path is wanted", lambda: rs.Case(None)),
        (TypeError, "drive.speed: NoneType", lambda: case.with_({"drive.speed": None})),
        (TypeError, "drive.speed: ndarray", lambda: case.with_({"drive.speed": np.zeros(2)})),
        (TypeError, "dict of keys", lambda: rs.Case(quick, "drive.speed")),
        (TypeError, "dict of keys", lambda: rs.sweep(case, ["drive.speed"])),
        (ValueError, "six components", lambda: rs.von_mises(np.zeros((2, 5)))),
        (ValueError, "six components", lambda: rs.von_mises(1.0)),
    ):
        with pytest.raises(kind, match=words):
            wrong()
    assert rs.Case(quick, {"run.rolling": np.bool_(False)})["run.rolling"] is False


def test_cases_are_pickled_by_their_text(case):
    changed = case.with_({"layer.0.thickness": "3 mm"})
    for again in (pickle.loads(pickle.dumps(changed)), copy.deepcopy(changed)):
        assert again.toml == changed.toml and again["layer.0.thickness"] == "3 mm"


def test_a_case_keeps_its_folder_when_the_working_folder_changes(tmp_path, monkeypatch):
    for name, radius in (("a", 300.0), ("b", 80.0)):
        (tmp_path / name).mkdir()
        heights = "".join(f"{y / 2};{radius - math.sqrt(radius**2 - y * y / 4):.6f}\n" for y in range(-50, 51))
        (tmp_path / name / "rail.csv").write_text("y [mm];z [mm]\n" + heights)
        (tmp_path / name / "case.toml").write_text(
            '[geometry]\nrail_profile = "rail.csv"\nwheel_profile = "flat"\nwheel_radius = "460 mm"\ncant = 0\n'
            '[drive]\ntraction_coefficient = 0\n')
    monkeypatch.chdir(tmp_path / "a")
    case = rs.Case("case.toml")
    here = rs.bem(case, cell="1 mm").p_max
    monkeypatch.chdir(tmp_path / "b")
    assert rs.bem(rs.Case("case.toml"), cell="1 mm").p_max > 1.2 * here
    changed = case.with_({"drive.friction_coefficient": 0.31})
    for same in (changed, pickle.loads(pickle.dumps(case)), pickle.loads(pickle.dumps(changed))):
        assert rs.bem(same, cell="1 mm").p_max == here


def test_a_shipped_case_that_stands_for_a_missing_file_is_named(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.warns(UserWarning, match="is not here; taking the one that comes with the package") as caught:
        rs.Case("cases/quick")
    assert caught[0].filename == __file__
