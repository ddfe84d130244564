"""RailStrata: rolling contact of a wheel on a layered rail.

    import railstrata as rs
    case = rs.Case("cases/paper/base.toml", {"layer.0.thickness": "2 mm", "layer.0.young_ratio": 2})
    result = rs.bem(case)               # half-spaces, tens of milliseconds
    result.p_max, result.patch.p        # Pa; arrays are read-only views (stations, columns)
    result.rail.at([[0, 0, 2e-3]])      # stresses 2 mm below the contact
    run = rs.run(case, "results/base")  # finite elements; Ctrl-C leaves a checkpoint
    weak = case.with_({"material.rail.hardening": "R260", "drive.traction_coefficient": 0.05})
    rs.passes(weak, "results/yields")   # wheel after wheel over a rail that yields

SI units everywhere; signs and axes as in docs/conventions.md.
"""
from __future__ import annotations

from . import _bridge, damage
from .case import Case, _thread_count, schema, shipped_data
from .contact import Contact, ContactDerivatives, ContactForces, PatchForces
from .creep_table import CreepTable, open_table
from .errors import CaseError, CheckWarning, Diagnostic, MachineError, NumericalError
from .law import DrivenPath, MaterialFit, calibrate, material
from .many import solve_many
from .patch import Patch, PatchState
from .results import BemResult, Body, Check, FolderResult, Peak, Peaks, Result, von_mises
from .solve import bem, resume, run, shakedown, sweep
from .table import Table
from .wheelset import WheelForces, Wheelset, WheelsetDerivatives, WheelsetForces
from .yielding import PassesResult, passes
from .yielding import open_folder as open  # noqa: A004 - the word users expect

__version__: str = _bridge.call("version")["version"]


def threads(count: int = 0) -> int:
    """The number of threads that solvers called from this Python thread use; sets it if `count` is positive."""
    return int(_bridge.call("threads", count=_thread_count(count))["threads"])


__all__ = [
    "BemResult", "Body", "Case", "CaseError", "Check", "CheckWarning", "Contact", "ContactDerivatives", "ContactForces",
    "CreepTable", "Diagnostic", "DrivenPath", "FolderResult", "MachineError", "MaterialFit", "NumericalError",
    "PassesResult", "Patch", "PatchForces", "PatchState", "Peak", "Peaks", "Result", "Table", "WheelForces", "Wheelset",
    "WheelsetDerivatives", "WheelsetForces", "bem", "calibrate", "damage", "material", "open", "open_table", "passes",
    "resume", "run",
    "schema", "shakedown", "shipped_data", "solve_many", "sweep", "threads", "von_mises",
]
