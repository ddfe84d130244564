"""rs.run: a folder, progress, Ctrl-C, resume to the same bits."""
import json
import os
import shutil
import signal
import threading
import time

import pytest

import railstrata as rs

SMALL = {"mesh.element_size": "5 mm", "run.positions": ["40 mm"], "run.run_up": "20 mm"}


def numbers(result):
    return {key: value for key, value in result.summary.items() if key != "run"}


@pytest.fixture(scope="module")
def small():
    return rs.Case("cases/quick", SMALL)


@pytest.fixture(scope="module")
def in_one_go(small, tmp_path_factory):
    return rs.run(small, tmp_path_factory.mktemp("run") / "whole")


def test_history_and_patch_are_there(in_one_go):
    assert in_one_go.engine == "fem"
    history = in_one_go.history
    assert len(history) > 1 and any("F_x" in name for name in history.columns)
    assert in_one_go.patch.p.max() > 1e8
    assert rs.open(in_one_go.folder).p_max == rs.open(in_one_go.folder, rs.FolderResult).p_max == in_one_go.p_max
    with pytest.raises(TypeError, match="holds a FolderResult, not a PassesResult"):
        rs.open(in_one_go.folder, rs.PassesResult)


@pytest.mark.slow
def test_ctrl_c_leaves_a_checkpoint_within_half_a_second_and_resume_has_the_same_bits(small, in_one_go, tmp_path):
    folder = tmp_path / "stopped"
    pressed = []

    def progress(phase, fraction):
        if phase == "rolling" and fraction > 0.3 and not pressed:
            pressed.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt, match="rs.resume"):
        rs.run(small, folder, progress=progress)
    assert time.monotonic() - pressed[0] < 5  # a loaded machine; 0.1 s on a free one
    assert (folder / "checkpoint.h5").exists()
    assert numbers(rs.resume(folder)) == numbers(in_one_go)


@pytest.mark.slow
def test_what_the_progress_function_raises_arrives_and_the_run_can_go_on(small, in_one_go, tmp_path):
    folder = tmp_path / "raised"

    def progress(phase, fraction):
        if phase == "rolling" and fraction > 0.1:
            raise ValueError("enough")

    with pytest.raises(ValueError, match="enough"):
        rs.run(small, folder, progress=progress)
    assert numbers(rs.resume(folder)) == numbers(in_one_go)


def test_a_folder_with_files_is_not_overwritten(small, in_one_go):
    with pytest.raises(rs.CaseError, match="force|holds"):
        rs.run(small, in_one_go.folder)
    with pytest.raises(rs.CaseError, match="nothing to resume"):
        rs.resume(in_one_go.folder)


@pytest.mark.skipif(shutil.which("nvidia-smi") is not None, reason="there may be a card here")
def test_a_card_that_is_not_here_is_refused_before_anything_is_made(tmp_path):
    case = rs.Case("cases/quick", {**SMALL, "run.device": "gpu"})
    with pytest.raises(rs.MachineError, match="run.device: (no card was found|this program was built)") as refused:
        rs.run(case, tmp_path / "out")
    assert refused.value.remedy.startswith('run.device = "cpu"')
    assert not (tmp_path / "out").exists()


def test_a_report_is_written(in_one_go):
    page = in_one_go.report(reference=False)
    assert page.read_text().startswith("<!DOCTYPE html>") or "<html" in page.read_text()[:2000]
    assert json.loads((in_one_go.folder / "summary.json").read_text()) == in_one_go.summary


def test_no_signal_handler_of_the_core_is_installed(small):
    before = signal.getsignal(signal.SIGINT)
    rs.bem(small, stresses=False)
    assert signal.getsignal(signal.SIGINT) is before and threading.active_count() >= 1
