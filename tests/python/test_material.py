"""rs.material and rs.calibrate: the program's numbers, closed forms, views, errors."""
import csv
import json
import math
import subprocess

import numpy as np
import pytest

import railstrata as rs

SHIPPED = rs.shipped_data() / "cases/material"
PERFECT = rs.Case.from_text('[material.rail]\nyoung = "210 GPa"\npoisson = 0.3\nyield_strength = "400 MPa"\n')
CHABOCHE = rs.Case.from_text('[material.rail]\nyield_strength = "400 MPa"\n'
                             'kinematic_hardening = [{ modulus = "40 GPa", recall = 200 }]\n')


def rows(file):
    with open(file, newline="", encoding="utf-8") as f:
        return [[float(v) for v in r] for r in list(csv.reader(f))[1:]]


def test_numbers_are_those_of_the_program_to_the_bit(program, tmp_path):
    for word, path, options in (("strain", "strain_path.csv", {}), ("stress", "ratchetting.csv", {"cycles": 5})):
        out = tmp_path / f"{word}.csv"
        subprocess.run([program, "material", SHIPPED / "r260.toml", f"--{word}", SHIPPED / path, "--depth", "2 mm",
                        "--increments", "50", "--cycles", str(options.get("cycles", 1)), "--out", out], check=True,
                       capture_output=True)
        found = rs.material("cases/material/r260.toml", **{word: f"cases/material/{path}"}, depth=2e-3, increments=50,
                            **options)
        frame = found.to_dataframe()
        assert list(frame.columns) == out.read_text().splitlines()[0].split(",")
        assert frame.to_numpy().tolist() == rows(out)
        if options:
            cycles = np.array(rows(out.with_suffix(".cycles.csv")))
            assert found.net.tolist() == cycles[:, 1:7].tolist() and found.p_of_cycle.tolist() == cycles[:, 7].tolist()


def test_arrays_give_what_a_file_of_the_same_numbers_gives(tmp_path):
    path = np.array([[1e-3, -5e-4, -5e-4, 2e-3, 0, 0], [-2e-3, 1e-3, 1e-3, 0, 1e-3, 0]])
    file = tmp_path / "path.csv"
    file.write_text("e_xx,e_yy,e_zz,e_xy,e_yz,e_xz\n" + "\n".join(",".join(map(repr, row)) for row in path.tolist()))
    by_file, by_array = rs.material(CHABOCHE, strain=file), rs.material(CHABOCHE, strain=path)
    by_name = rs.material(CHABOCHE, strain={f"e_{c}": path[:, j] for j, c in enumerate(("xx", "yy", "zz", "xy", "yz"))})
    for other in (by_array, by_name):
        assert np.array_equal(other.stress, by_file.stress) and np.array_equal(other.p, by_file.p)


def test_perfect_plasticity_in_tension_and_ratchetting_have_their_closed_forms():
    """sigma = min(E eps, sigma_y); the ratchetting of one Armstrong-Frederick term per cycle [Chaboche1989]."""
    tension = rs.material(PERFECT, stress={"e_xx": [1e-3, 5e-3]})
    assert tension.stress[:, 0] == pytest.approx([210e6, 400e6], rel=1e-9)
    assert tension.plastic_strain[1, 0] == pytest.approx(5e-3 - 400e6 / 210e9, rel=1e-9)
    assert tension.dissipated[1] == pytest.approx(400e6 * (5e-3 - 400e6 / 210e9), rel=1e-6)
    assert np.abs(tension.stress[:, 1:]).max() < 1
    # 1/gamma ln of the backstress's ways: C/gamma = 200 MPa, backstress 150 and -50 at the ends
    growth = rs.material(CHABOCHE, stress={"s_xx": [550e6, -450e6]}, cycles=7).net[1:, 0]
    assert growth == pytest.approx([3.8107003e-3] * 6, abs=1e-5)


def test_arrays_are_read_only_views_that_outlive_the_result():
    path = rs.material(PERFECT, stress={"s_xx": [100e6, 200e6], "s_xy": [0, 50e6]})
    stress = path.stress
    assert stress.shape == (2, 6) and not stress.flags.owndata and not stress.flags.writeable
    assert stress.ctypes.data == path.stress.ctypes.data
    way = path.on_the_way
    assert way.p.shape == (2 * path.increments + 1,) and way.stress[0].tolist() == [0] * 6
    del path, way
    assert stress[:, 0] == pytest.approx([100e6, 200e6], rel=1e-9) and stress[1, 3] == pytest.approx(50e6, rel=1e-9)


def test_faults_name_row_and_remedy():
    with pytest.raises(rs.CaseError, match="no strain gives the stress") as caught:
        rs.material(PERFECT, stress={"s_xx": [300e6, 900e6]})
    assert caught.value.diagnostics[0].where == "row 1" and "e_xx" in caught.value.diagnostics[0].remedy
    for given, words in (({"stress": {"s_xx": [1e6], "e_xx": [0.0]}}, "s_xx and e_xx"),
                         ({"strain": {"e_xx": [0.9]}}, "between -0.5 and 0.5"),
                         ({"strain": {"e_xx": [np.nan]}}, "between"),
                         ({"strain": {"e_xx": [0.0], "e_yy": [0.0, 0.1]}}, "another length"),
                         ({"strain": np.zeros((0, 6))}, "no points"),
                         ({"strain": "cases/material/none.csv"}, "none.csv"),
                         ({"strain": np.zeros((1, 6)), "of": "layer.0"}, "no such material")):
        with pytest.raises(rs.CaseError, match=words):
            rs.material(PERFECT, **given)
    for given in ({}, {"strain": np.zeros(6)}, {"strain": {"s_xx": [1e6]}}, {"strain": np.zeros((1, 6)), "depth": -1},
                  {"strain": np.zeros((1, 6)), "cycles": 0}, {"strain": {"e_xx": [[0.0]]}}):
        with pytest.raises(ValueError):
            rs.material(PERFECT, **given)
    with pytest.raises(rs.CaseError, match="begins to yield"):
        rs.material(rs.Case("cases/quick"), strain=np.zeros((1, 6)))
    with pytest.warns(rs.CheckWarning, match="no claim"):
        rs.material(PERFECT, stress={"e_xx": [0.3]})


def test_a_fit_is_the_programs_and_gives_the_law_back(program, tmp_path):
    out = tmp_path / "fit.toml"
    done = subprocess.run([program, "material", SHIPPED / "test_steel.toml", "--calibrate", SHIPPED / "loop.csv",
                           "--monotonic", SHIPPED / "tension.csv", "--json", "--out", out], check=True,
                          capture_output=True, text=True)
    found = json.loads(done.stdout)
    fit = rs.calibrate("cases/material/test_steel.toml", loop="cases/material/loop.csv",
                       monotonic="cases/material/tension.csv")
    assert fit.card == out.read_text(encoding="utf-8") and fit.error == found["error"]
    assert fit.law["yield_strength"] == found["yield_strength_Pa"] == pytest.approx(300e6, rel=0.02)
    again = rs.material(rs.Case.from_text(fit.card), stress={"e_xx": [0.01]})
    plastic = 0.01 - again.stress[0, 0] / 210e9
    law = 300 + 80 * (1 - math.exp(-12 * plastic)) + 240 * (1 - math.exp(-250 * plastic)) + \
        250 * (1 - math.exp(-20 * plastic))
    assert again.stress[0, 0] == pytest.approx(law * 1e6, rel=0.01)
    with pytest.raises(FileExistsError):
        fit.save(out)
    assert fit.save(tmp_path / "new.toml").read_text() == fit.card


def test_amplitudes_of_a_law_as_numbers_give_the_law_back():
    """sigma_a = sigma_y0 + C/gamma tanh(gamma eps_pa) of two terms."""
    plastic = np.geomspace(2e-4, 1e-2, 12)
    stress = 300e6 + 240e6 * np.tanh(250 * plastic) + 250e6 * np.tanh(20 * plastic)
    by_plastic = rs.calibrate(PERFECT, amplitudes={"plastic_strain": plastic, "stress": stress})
    by_total = rs.calibrate(PERFECT, amplitudes=np.column_stack([plastic + stress / 210e9, stress]))
    for fit in (by_plastic, by_total):
        assert fit.error < 1e-4 and fit.law["yield_strength"] == pytest.approx(300e6, rel=0.01)
    with pytest.raises(rs.CaseError, match="row 0"):
        rs.calibrate(PERFECT, amplitudes=np.array([[1e-4, 21e6 * 1.01]] * 12))
    with pytest.raises(rs.CaseError, match="a loop needs ten points"):
        rs.calibrate(PERFECT, loop=np.array([[0, 0], [1e-3, 200e6]]))
    with pytest.raises(ValueError):
        rs.calibrate(PERFECT, amplitudes={"strain": plastic})
