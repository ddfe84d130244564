"""Passes of wheels over a rail that yields."""
from __future__ import annotations

import html
import json
import os
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any, Optional, TypeVar, Union, overload

import numpy as np

from . import _bridge
from ._bridge import Array
from .case import AnyCase, Length, PathLike, _case_of, _metres
from .errors import CaseError, CheckWarning, Diagnostic
from .patch import needs
from .results import FolderResult
from .solve import Progress, _Bar, _callback

if TYPE_CHECKING:
    import pandas
    import xarray

_TABLES = ("passes", "residual", "profile", "loops", "along")


class PassesResult:
    """Passes of wheels over a yielding rail, from their folder (docs/passes.md).

    `summary` is passes.json. A table is a dict of read-only arrays, in the units that its names give:

        result.table("passes")["net_strain"]          # a number a pass
        result.table("residual")["sigma_xx_MPa"]      # a number a point of the section, after the last pass
        y, depth, stress = result.section("sigma_xx_MPa")
    """

    def __init__(self, folder: PathLike) -> None:
        self.folder = Path(folder)
        try:
            self.summary: dict[str, Any] = json.loads((self.folder / "passes.json").read_text(encoding="utf-8"))
        except FileNotFoundError:
            raise CaseError(f"{folder} holds no passes", [Diagnostic(
                f"{folder} holds no passes", "name a folder of railstrata passes or rs.passes", str(folder))]) from None
        except json.JSONDecodeError as error:
            raise CaseError(f"{self.folder / 'passes.json'}: {error}") from None
        self._tables: dict[str, dict[str, Array]] = {}

    @property
    def title(self) -> str:
        """The case's title."""
        return str(self.summary["title"])

    @property
    def method(self) -> str:
        """"stationary" or "rolled" (by the finite elements)."""
        return str(self.summary.get("method", "rolled"))

    @property
    def passes(self) -> int:
        """Passes so far."""
        return int(self.summary["passes"])

    @property
    def kind(self) -> str:
        """"elastic shakedown", "plastic shakedown", "ratchetting" or "transient: no claim yet"."""
        return str(self.summary["class"])

    @property
    def verdict(self) -> str:
        """The same in a sentence, with its numbers."""
        return self.summary.get("verdict", self.kind)

    @property
    def net_strain_per_pass(self) -> float:
        """√(2/3) |E^p_n - E^p_(n-1)| of the last pass where it is largest, per pass: what grows."""
        return float(self.summary["net_strain_per_pass"])

    def table(self, name: str = "passes") -> dict[str, Array]:
        """A table of the folder: "passes" (a row a pass), "residual" (a row a point of the section), "profile" (its
        column with the largest plastic strain), "loops" and "along" (stationary method). Columns: docs/passes.md.
        KeyError: no such table."""
        if name not in self._tables:
            file = self.folder / f"{name}.csv"
            if name not in _TABLES or not file.exists():
                raise KeyError(f"{self.folder} has no table {name!r}; there are " + ", ".join(
                    t for t in _TABLES if (self.folder / f"{t}.csv").exists()))
            self._tables[name] = _bridge.call("read_table", file=str(file))["columns"]
        return self._tables[name]

    @property
    def columns(self) -> list[str]:
        """Names of the columns of passes.csv."""
        return list(self.table())

    def __getitem__(self, column: str) -> Array:
        """A column of passes.csv, a number a pass: result["net_strain"]."""
        return self.table()[column]

    def __len__(self) -> int:
        return len(self.table()["pass"])

    @property
    def history(self) -> "pandas.DataFrame":
        """passes.csv in pandas, a row a pass."""
        return self.to_dataframe("passes")

    def to_dataframe(self, name: str = "residual") -> "pandas.DataFrame":
        """A table in pandas."""
        return needs("pandas", "python3-pandas").DataFrame(self.table(name))

    def section(self, column: str = "sigma_xx_MPa") -> tuple[Array, Array, Array]:
        """(y [m], depth [m], values (y, depth)) of a column of residual.csv in the section after the last pass; NaN
        where the section has no point. y and depth as in docs/passes.md."""
        points = self.table("residual")
        y, j = np.unique(points["y_mm"], return_inverse=True)
        depth, k = np.unique(points["depth_mm"], return_inverse=True)
        values = np.full((len(y), len(depth)), np.nan)
        values[j, k] = points[column]
        out = (y * 1e-3, depth * 1e-3, values)
        for array in out:
            array.setflags(write=False)
        return out

    def to_xarray(self) -> "xarray.Dataset":
        """The section after the last pass: dimensions y and depth [m], a variable a column of residual.csv."""
        module = needs("xarray", "python3-xarray")
        names = [n for n in self.table("residual") if n not in ("y_mm", "depth_mm")]
        sections = {name: self.section(name) for name in names}
        y, depth, _ = sections[names[0]]
        out: xarray.Dataset = module.Dataset({n: (("y", "depth"), values) for n, (_, _, values) in sections.items()},
                             {"y": y, "depth": depth}, {"title": self.title, "verdict": self.verdict})
        out["y"].attrs["units"] = out["depth"].attrs["units"] = "m"
        for name in names:
            out[name].attrs["units"] = "MPa" if name.endswith("_MPa") else "1"
        return out

    def report(self, page: Optional[PathLike] = None) -> Path:
        """Writes the page of the passes and returns its path; by default report.html in the folder."""
        page = Path(page) if page else self.folder / "report.html"
        _bridge.work("write_passes_page", page=str(page), folders=[str(self.folder)])
        return page

    def __repr__(self) -> str:
        return f"<railstrata.PassesResult {self.title!r}: {self.passes} passes. {self.verdict}>"

    def _repr_html_(self) -> str:
        shown = [c for c in ("pass", "accumulated_strain", "net_strain", "net_depth_mm", "sigma_x_min_MPa",
                             "sigma_y_min_MPa", "sinking_um") if c in self.columns]
        rows = range(len(self)) if len(self) <= 8 else [*range(4), *range(len(self) - 4, len(self))]
        head = "".join(f"<th>{name}</th>" for name in shown)
        body = "".join("<tr>" + "".join(f"<td>{self[name][n]:.4g}</td>" for name in shown) + "</tr>" for n in rows)
        return f"<p>{html.escape(self.verdict)}</p><table><tr>{head}</tr>{body}</table>"


def passes(
    case: AnyCase, folder: PathLike, passes: int = 20, *, engine: str = "bem", cell: Length = 0.25e-3,
    roll_length: Length = 0.0, resume: bool = False, force: bool = False, checkpoint_every: float = 600.0,
    page: bool = False, progress: Progress = False,
) -> PassesResult:
    """Wheel after wheel over a rail that yields, into a folder, as `railstrata passes` does [DangVanMaitournam1993].

        E(x, y, z) = e_contact(x, y, z) + e_before(y, z) + e_residual(x, y, z)      strain along every streamline
        elastic shakedown: dp < 1e-6 in a pass;  plastic: net < 1 % of dp;  ratchetting: net the same, at least that

    The case gives strengths (and hardening, docs/material.md), and in [passes] how wheels differ. passes: since the
    first one, so that resume=True with a larger number goes on with those of the folder, to the same bits; force:
    older results in the folder are removed.

    engine "bem": the stationary method, some tenths of a second a pass; cell: m, of the half-space solution, 0.02e-3 to
    5e-3. engine "fem": every pass is a short roll by the finite elements, minutes each; roll_length: m, 0: chosen;
    checkpoint_every: s of wall time, 0 for never. page: report.html too. progress: True, or a function of (pass,
    fraction of all passes).

    Ctrl-C, or what the progress function raises, stops it; resume=True goes on, "bem" with the pass that was stopped
    from its beginning (the ones before are kept), "fem" from a checkpoint within it. Raises CaseError (no strength,
    friction that the surface cannot bear, a folder in use or of another case), NumericalError, MachineError; warns
    with CheckWarning where a pass has not settled and where strains are not small. Assumptions and what it was checked
    with: docs/passes.md.
    """
    if engine not in ("bem", "fem"):
        raise ValueError('engine: "bem" or "fem"')
    case = _case_of(case)
    if passes < 1:
        raise ValueError("passes: 1 or more")
    if engine == "fem":
        case = case.with_({"run.plasticity": True, "run.rolling": True})
    follow = _callback(progress, "", True)
    bar = follow if isinstance(follow, _Bar) else None
    try:
        done = _bridge.work(
            "passes", follow if bar is None else bar.of_pass, case=case._loaded, folder=str(folder),
            rolled=engine == "fem", passes=passes, resume=bool(resume), force=bool(force), page=bool(page),
            cell=_metres(cell, "cell"),
            roll_length=_metres(roll_length, "roll_length"), checkpoint_every=float(checkpoint_every),
        )
    except KeyboardInterrupt:
        begun = Path(folder, "identity.txt").exists()
        raise KeyboardInterrupt(f"stopped; rs.passes(..., {str(folder)!r}, resume=True) goes on" if begun else
                                "stopped before the first pass; nothing was written") from None
    finally:
        if bar is not None:
            bar.end()
    for note in [*case._loaded["static_notes"], *done["notes"]]:
        warnings.warn(note, CheckWarning, stacklevel=2)
    return PassesResult(folder)


_Kind = TypeVar("_Kind", FolderResult, PassesResult)


@overload
def open_folder(folder: PathLike) -> Union[FolderResult, PassesResult]: ...


@overload
def open_folder(folder: PathLike, kind: type[_Kind]) -> _Kind: ...


def open_folder(folder: PathLike, kind: Optional[type[Any]] = None) -> Any:
    """The results of a folder: of `railstrata run` and `bem` a FolderResult, of `railstrata passes` a PassesResult.

    kind: the class that is wanted, so that a type checker knows it: rs.open("results/base", rs.FolderResult); TypeError
    where the folder holds the other. CaseError: it holds no finished result.
    """
    if not isinstance(folder, (str, os.PathLike)):
        raise TypeError(f"a folder is wanted, as text or pathlib.Path, not {folder!r:.60}")
    found = PassesResult(folder) if (Path(folder) / "passes.json").exists() else FolderResult(folder)
    if kind is not None and not isinstance(found, kind):
        raise TypeError(f"{folder} holds a {type(found).__name__}, not a {kind.__name__}")
    return found
