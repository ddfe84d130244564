"""rs.passes: the program's numbers, Ctrl-C, resume to the same bits, reading back."""
import json
import os
import signal
import subprocess
import time

import numpy as np
import pytest

import railstrata as rs

WEAK = {"material.rail.yield_strength": "400 MPa", "drive.friction_coefficient": 0.1,
        "drive.traction_coefficient": 0.05}
NAMES = ["passes.csv", "residual.csv", "profile.csv", "loops.csv", "along.csv", "state.csv", "passes.json"]


@pytest.fixture(scope="module")
def weak():
    return rs.Case("cases/paper/base.toml", WEAK)


@pytest.fixture(scope="module")
def two(weak, tmp_path_factory):
    return rs.passes(weak, tmp_path_factory.mktemp("passes") / "two", 2, cell=1e-3, page=True)


def numbers(folder, names=NAMES):
    """Lines of the files without comments and titles; a title names what --set changes."""
    return {n: [line for line in (folder / n).read_text().splitlines() if not line.startswith(("#", '  "title"'))]
            for n in names}


def words_of(case):
    return [word for change in case._loaded["overrides"] for word in ("--set", change)]


def test_numbers_are_those_of_the_program_to_the_bit(program, weak, two, tmp_path):
    subprocess.run([program, "passes", rs.shipped_data() / "cases/paper/base.toml", *words_of(weak), "--cell", "1 mm",
                    "--passes", "2", "--no-report", "--out", tmp_path / "cli"], check=True, capture_output=True)
    assert numbers(two.folder) == numbers(tmp_path / "cli")
    # the program goes on with what Python has begun
    subprocess.run([program, "passes", rs.shipped_data() / "cases/paper/base.toml", *words_of(weak), "--cell", "1 mm",
                    "--passes", "3", "--no-report", "--resume", "--out", tmp_path / "cli"], check=True,
                   capture_output=True)
    assert rs.open(tmp_path / "cli").passes == 3


def test_tables_are_read_only_arrays_with_the_numbers_of_the_files(two):
    assert isinstance(two, rs.PassesResult) and two.passes == len(two) == 2 and two.method == "stationary"
    assert two.kind in two.summary["class"] and two.verdict in two._repr_html_()
    assert two["accumulated_strain"][1] == two.summary["last_pass"]["accumulated_strain"]
    assert not two["net_strain"].flags.writeable and not two["net_strain"].flags.owndata
    y, depth, stress = two.section("sigma_xx_MPa")
    assert stress.shape == (len(y), len(depth)) and not np.isnan(stress).any()
    assert stress.min() == two["sigma_x_min_MPa"][1]
    place = np.unravel_index(stress.argmin(), stress.shape)
    assert depth[place[1]] == pytest.approx(1e-3 * two["sigma_x_depth_mm"][1], rel=1e-12)
    assert two.to_dataframe("residual")["sigma_xx_MPa"].min() == stress.min() and len(two.history) == 2
    assert float(two.to_xarray().sigma_xx_MPa.min()) == stress.min()
    assert set(two.table("loops")) >= {"point", "strain_xx", "sigma_xx_MPa"}
    assert (two.folder / "report.html").exists() and two.report(two.folder / "again.html").exists()
    with pytest.raises(KeyError, match="residual"):
        two.table("no_such")


@pytest.mark.slow
def test_ctrl_c_keeps_the_passes_before_and_resume_has_the_same_bits(weak, two, tmp_path):
    """Wheels that wander, so that a pass which is given up has moved the load."""
    case = weak.with_({"passes.lateral_positions": ["0 mm", "4 mm"]})
    whole = rs.passes(case, tmp_path / "whole", 4, cell=1e-3)
    pressed = []

    def progress(number, fraction):
        assert 0 <= fraction <= 1
        if number == 3 and not pressed:
            pressed.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt, match="resume=True"):
        rs.passes(case, tmp_path / "parts", 4, cell=1e-3, progress=progress)
    assert time.monotonic() - pressed[0] < 5  # a loaded machine; 0.1 s on a free one
    assert rs.open(tmp_path / "parts").passes == 2
    assert rs.passes(case, tmp_path / "parts", 4, cell=1e-3, resume=True).passes == 4
    assert numbers(tmp_path / "parts") == numbers(whole.folder)


@pytest.mark.slow
def test_what_the_progress_function_raises_arrives(weak, tmp_path):
    def progress(number, fraction):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        rs.passes(weak, tmp_path / "raised", 2, cell=1e-3, progress=progress)
    assert rs.passes(weak, tmp_path / "raised", 1, cell=1e-3, resume=True).passes == 1


def test_faults_keep_their_remedies(weak, two, tmp_path):
    with pytest.raises(rs.CaseError, match="holds|force"):
        rs.passes(weak, two.folder, 2, cell=1e-3)
    with pytest.raises(rs.CaseError, match="no passes of this very case"):
        rs.passes(weak.with_({"material.rail.yield_strength": "410 MPa"}), two.folder, 3, cell=1e-3, resume=True)
    with pytest.raises(rs.CaseError) as caught:
        rs.passes(rs.Case("cases/paper/base.toml"), tmp_path / "none", 1, cell=1e-3)
    assert any("yield_strength" in d.remedy for d in caught.value.diagnostics)
    assert not (tmp_path / "none").exists()
    with pytest.raises(rs.CaseError, match="holds no passes"):
        rs.PassesResult(tmp_path)
    for wrong in ({"passes": 0}, {"engine": "fea"}):
        with pytest.raises(ValueError):
            rs.passes(weak, tmp_path / "none", **wrong)
    with pytest.raises(rs.CaseError, match="cell"):
        rs.passes(weak, tmp_path / "none", 1, cell=1.0)


@pytest.mark.slow
def test_passes_by_the_finite_elements_stop_within_a_pass_and_go_on_to_the_same_bits(tiny_text, tmp_path):
    case = rs.Case.from_text(tiny_text, str(tmp_path / "tiny.toml"), {
        "material.rail.yield_strength": "400 MPa", "drive.traction_coefficient": 0.1, "mesh.element_size": "6 mm"})
    options = {"engine": "fem", "roll_length": 50e-3}
    whole = rs.passes(case, tmp_path / "whole", 1, **options)
    assert whole["accumulated_strain"][0] > 1e-4 and whole.method == "rolled"
    json.dumps(whole.summary)
    _, _, stress = whole.section("sigma_xx_MPa")
    assert np.nanmin(stress) < -10

    def progress(number, fraction):
        if fraction > 0.3:
            raise ValueError("enough")

    with pytest.raises(ValueError, match="enough"):
        rs.passes(case, tmp_path / "parts", 1, progress=progress, **options)
    assert (tmp_path / "parts" / "checkpoint.h5").exists()
    rs.passes(case, tmp_path / "parts", 1, resume=True, **options)
    same = [n for n in NAMES if n not in ("loops.csv", "along.csv")]
    assert numbers(tmp_path / "parts", same) == numbers(whole.folder, same)
