"""Solving cases."""
from __future__ import annotations

import os
import sys
import time
import warnings
from typing import Any, Callable, Mapping, Optional, Sequence, TypeVar, Union

import numpy as np

from . import _bridge
from .case import AnyCase, Length, PathLike, Value, _case_of, _metres, _thread_count, _value_of
from .errors import CheckWarning
from .results import BemResult, FolderResult, Result, open_result
from .table import Table

Progress = Union[bool, Callable[..., None]]
_Result = TypeVar("_Result", bound=Result)


class _Bar:
    """A line that is written anew, on a terminal and in a notebook alike."""

    def __init__(self) -> None:
        self._last = 0.0
        self._begun = time.monotonic()

    def __call__(self, phase: str, fraction: float) -> None:
        now = time.monotonic()
        if now - self._last < 0.2:
            return
        self._last = now
        left = (now - self._begun) * (1 - fraction) / fraction if fraction > 0.02 else None
        end = "" if left is None else f", {left:.0f} s left"
        sys.stderr.write(f"\r{phase:8s} {100 * fraction:5.1f} %{end}      ")
        sys.stderr.flush()

    def of_pass(self, number: int, fraction: float) -> None:
        self(f"pass {number}", fraction)

    def end(self) -> None:
        sys.stderr.write("\n")


def _callback(progress: Progress, name: str, with_phase: bool) -> Optional[Callable[..., None]]:
    if progress is False or progress is None:
        return None
    if progress is not True:
        return progress
    bar = _Bar()
    return bar if with_phase else lambda fraction: bar(name, fraction)


def _say(result: _Result, notes: Sequence[str] = ()) -> _Result:
    for check in result.checks:
        if not check.ok:
            warnings.warn(f"check {check.name} fails: {check.value} beyond {check.limit}", CheckWarning, stacklevel=3)
    for note in notes:
        warnings.warn(note, CheckWarning, stacklevel=3)
    return result


def bem(
    case: AnyCase, cell: Length = 0.25e-3, *, threads: int = 0, stresses: bool = True, single_track: bool = False,
    progress: Progress = False,
) -> BemResult:
    """Solves a case by half-space theory [Kalker1990], as `railstrata bem` does; some ten milliseconds.

    case: a Case, or the path of one. cell: m, or a text with a unit ("0.2 mm"), side of the cells of the potential
    contact area, 0.02e-3 to 5e-3. threads: 0 for all. stresses: False leaves out the search for the largest stresses,
    which costs more than the contact. single_track: the limit of shakedown for traffic on one line too, where the case
    gives strengths (some seconds). progress: of a transient; True, or a function of the fraction that is done. Raises
    CaseError, NumericalError, MachineError; warns with CheckWarning where a check fails and where run.rolling = false
    makes a drive void. Several Python threads may call it at a time.
    """
    case = _case_of(case)
    solution = _bridge.work(
        "solve_half_space", _callback(progress, "steps", False), case=case._loaded, cell=_metres(cell, "cell"),
        threads=_thread_count(threads), stresses=bool(stresses), single_track=bool(single_track), maps=False,
    )
    return _say(BemResult(solution), case._loaded["static_notes"])


def shakedown(case: AnyCase, cell: Length = 0.25e-3, *, threads: int = 0) -> BemResult:
    """Load factors of shakedown of a case by half-spaces, at every level (`railstrata bem --maps`); some seconds.

    The case must give strengths (yield_strength or grade). `result.shakedown` has the factors by body and zone.
    """
    case = _case_of(case)
    result = BemResult(_bridge.work(
        "solve_half_space", case=case._loaded, cell=_metres(cell, "cell"), threads=_thread_count(threads),
        stresses=True, single_track=True, maps=False,
    ))
    if not result.shakedown:
        raise ValueError('the case gives no strength: give yield_strength = "500 MPa" or grade = "R260" to materials')
    return _say(result, case._loaded["static_notes"])


def run(
    case: AnyCase, folder: PathLike, *, force: bool = False, checkpoint_every: float = 600.0,
    max_time: float = 0.0, progress: Progress = False,
) -> FolderResult:
    """Runs a case by finite elements into a result folder, as `railstrata run` does; minutes to hours.

    checkpoint_every, max_time: s of wall time, 0 for never. progress: True, or a function of (phase, fraction). Ctrl-C
    leaves a checkpoint and raises KeyboardInterrupt; `resume` goes on from it to the same bits. What the progress
    function raises stops the run in the same way. Raises CaseError, NumericalError, MachineError, TimeoutError.
    """
    case = _case_of(case)
    return _finish(
        folder, progress, "run", case=case._loaded, folder=str(folder), force=bool(force),
        checkpoint_every=checkpoint_every, limit=max_time,
    )


def resume(
    folder: PathLike, *, checkpoint_every: float = 600.0, max_time: float = 0.0,
    progress: Progress = False,
) -> FolderResult:
    """Goes on with an interrupted run of a folder, to the bits of a run in one go."""
    return _finish(
        folder, progress, "resume", folder=str(folder), checkpoint_every=checkpoint_every, limit=max_time
    )


def _finish(where: PathLike, progress: Progress, function: str, **arguments: Any) -> FolderResult:
    follow = _callback(progress, "rolling", True)
    try:
        done = _bridge.work(function, follow, **arguments)
    except KeyboardInterrupt:
        raise KeyboardInterrupt(f"stopped; rs.resume({str(where)!r}) goes on") from None
    finally:
        if isinstance(follow, _Bar):
            follow.end()
    if done["stopped"]:
        raise TimeoutError(f"max_time is over; rs.resume({str(where)!r}) goes on")
    return _say(open_result(where), done["notes"])


def _listed(values: Any) -> Sequence[Value]:
    """Values to vary over; a text, a number or a path alone is one."""
    alone = isinstance(values, (str, os.PathLike, dict)) or (isinstance(values, np.ndarray) and values.ndim == 0)
    if alone or not hasattr(values, "__iter__"):
        return [values]
    return list(values)


def sweep(
    case: AnyCase, varied: Mapping[str, Union[Value, Sequence[Value]]], cell: Length = 0.25e-3, *,
    stresses: bool = False, progress: Progress = False,
) -> Table:
    """Half-space solutions of every combination of values, side by side on all threads (`railstrata sweep`).

    varied: keys of the case and their values, {"layer.0.thickness": ["1 mm", "3 mm"]}; the last key changes fastest.
    Numbers are SI. A text or a number alone is one value, or a range like "0.5:3 mm:6"; words and ranges are those of
    `railstrata sweep`. A case that cannot be solved has a "fault" (a column). ValueError: no key; CaseError: a key
    without values, or all cases refused.
    """
    if not hasattr(varied, "items"):
        raise TypeError('varied: a dict of keys and their values is wanted, {"layer.0.thickness": ["1 mm", "3 mm"]}')
    if not varied:
        raise ValueError('varied: no key is given; {"layer.0.thickness": ["1 mm", "3 mm"]}, or rs.bem for one solution')
    case = _case_of(case)
    keys = [(key, [_value_of(v, key) for v in _listed(values)]) for key, values in varied.items()]
    swept = _bridge.work(
        "sweep", _callback(progress, "sweep", False), case=case._loaded, varied=keys, cell=_metres(cell, "cell"),
        stresses=bool(stresses),
    )
    rows = swept["rows"]
    for note in dict.fromkeys(note for row in rows for note in row["static_notes"]):
        warnings.warn(note, CheckWarning, stacklevel=2)
    axes = [(key, unit, count) for (key, _), (unit, count) in zip(keys, swept["axes"])]
    return Table(axes, swept["columns"], [(row["values"], row["summary"], row["fault"]) for row in rows])
