"""Results of either engine."""
from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from . import _bridge, _html
from ._bridge import Array
from .patch import Patch, needs

if TYPE_CHECKING:
    import pandas

PathLike = Union[str, "os.PathLike[str]"]


@dataclass(frozen=True)
class Peak:
    """A largest stress and its place: value [Pa], x from the axle, y from the rigid contact point, depth [m]."""

    value: float
    x: float
    y: float
    depth: float


@dataclass(frozen=True)
class Peaks:
    """Largest stresses of a zone of a body."""

    von_mises: Peak
    sigma1: Peak


@dataclass(frozen=True)
class Check:
    """A check of the result: whether it holds, its value and its limit."""

    name: str
    ok: bool
    value: Optional[float]
    limit: Optional[float]


def _peak(entry: dict[str, Any]) -> Peak:
    return Peak(*(float("nan") if entry[k] is None else entry[k] for k in ("value_Pa", "x_m", "y_m", "depth_m")))


class Result:
    """Numbers, checks and patch of a solved case, whichever engine solved it.

    `summary` is the content of summary.json (docs/results-reference.md): a dict, SI units in its keys, None for what
    does not apply. The properties are its main numbers.
    """

    def __init__(self, found: _bridge.Answer) -> None:
        self._found = found
        self.summary: dict[str, Any] = found["summary"]

    def number(self, path: str) -> float:
        """A number of the summary by its path, "contact.p_max_Pa"; NaN where it does not apply. KeyError: no such."""
        value: Any = self.summary
        for part in path.split("."):
            value = value[int(part)] if isinstance(value, list) else value[part]
        return float("nan") if value is None else float(value)

    @property
    def title(self) -> str:
        """The case's title."""
        return str(self.summary["title"])

    @property
    def engine(self) -> str:
        """"fem", "bem", or "sections" of half-spaces with bem.bodies = "sections"."""
        return str(self.summary["run"]["engine"])

    @property
    def p_max(self) -> float:
        """Pa, largest pressure."""
        return self.number("contact.p_max_Pa")

    @property
    def q_max(self) -> float:
        """Pa, largest traction."""
        return self.number("contact.q_max_Pa")

    @property
    def patch_area(self) -> float:
        """m², area of contact."""
        return self.number("contact.patch_area_m2")

    @property
    def slip_area(self) -> float:
        """m², area of slip."""
        return self.number("contact.slip_area_fraction") * self.patch_area

    @property
    def creepage_x(self) -> float:
        """Longitudinal creepage."""
        return self.number("contact.creepage_x")

    @property
    def creepage_y(self) -> float:
        """Lateral creepage."""
        return self.number("contact.creepage_y")

    @property
    def spin(self) -> float:
        """1/m, spin creepage."""
        return self.number("contact.spin_per_m")

    @property
    def force(self) -> tuple[float, float, float]:
        """N, (F_x, F_y, F_z) on the wheel, model frame."""
        return self.number("contact.F_x_N"), self.number("contact.F_y_N"), self.number("contact.F_z_N")

    @property
    def normal_force(self) -> float:
        """N, along the contact plane's normal."""
        return self.number("contact.normal_force_N")

    @property
    def checks(self) -> list[Check]:
        """The checks of the result."""
        return [Check(c["name"], c["ok"], c.get("value"), c.get("limit")) for c in self.summary["checks"]]

    @property
    def ok(self) -> bool:
        """Whether every check holds."""
        return all(check.ok for check in self.checks)

    @property
    def warnings(self) -> list[str]:
        """A sound result that is not plausible, in words."""
        return [w["text"] for w in self.summary.get("warnings", [])]

    @property
    def patch(self) -> Patch:
        """The contact patch; of several the one with the largest pressure."""
        return self.patches[0]

    @property
    def patches(self) -> list[Patch]:
        """All patches, that of the largest pressure first."""
        return [Patch(arrays) for arrays in self._found["patches"]]

    def peaks(self, body: str = "rail", zone: str = "subsurface") -> Peaks:
        """Largest von Mises and principal stress. body: "rail", "wheel"; zone: "surface", "subsurface", "layer",
        "interface", "matrix". KeyError where the result has no such."""
        stress = self.summary["stress"]
        if body not in stress:
            raise KeyError(f"{body!r} is no body of the result: {', '.join(stress)}")
        entry = stress[body].get(zone)
        if entry is None:
            raise KeyError(f"{body} has no zone {zone!r} with stresses")
        return Peaks(_peak(entry["von_mises_max"]), _peak(entry["sigma1_max"]))

    @property
    def shakedown(self) -> Optional[dict[str, Any]]:
        """The summary's shakedown factors, where the case gives strengths; else None."""
        return self.summary.get("shakedown")

    @property
    def damage(self) -> Optional[dict[str, Any]]:
        """The summary's indices of wear, rolling contact fatigue and heat; `railstrata.damage` has them one by one."""
        return self.summary.get("damage")

    @property
    def fatigue(self) -> Optional[list[Any]]:
        """The summary's fatigue below the surface by body, where the case gives the data for it; else None."""
        return self.summary.get("fatigue")

    def __repr__(self) -> str:
        return f"<railstrata {type(self).__name__} ({self.engine}) {self.title!r}: p_max {self.p_max / 1e6:.1f} MPa>"

    def _repr_html_(self) -> str:
        checks = [(check.name, check.ok) for check in self.checks]
        figure = _html.patch_figure(self.patch)
        return _html.result_html((self.title, self.engine), _shown(self), checks, self.warnings, figure)


def _shown(result: Result) -> list[tuple[str, str]]:
    force = [f"{1e-3 * f:.2f}" for f in result.force]
    return [
        ("largest pressure", f"{result.p_max / 1e6:.1f} MPa"),
        ("largest traction", f"{result.q_max / 1e6:.1f} MPa"),
        ("patch area", f"{result.patch_area * 1e6:.1f} mm²"),
        ("slip area", f"{100 * result.slip_area / result.patch_area:.1f} %" if result.patch_area else "–"),
        ("creepages", f"{result.creepage_x:.3e}, {result.creepage_y:.3e}, spin {result.spin:.3g} 1/m"),
        ("force on the wheel", f"({', '.join(force)}) kN"),
    ]


class Body:
    """The inside of a body below or above a half-space patch.

    Axes: x along the rolling direction and y along the common tangent, both from the rigid contact point [m]; depth
    into the body [m]. Stresses [Pa] have the components xx, yy, zz, xy, yz, xz in these axes, z into the body.
    """

    def __init__(self, run: _bridge.Answer, name: str, patch: int) -> None:
        self._run, self.name, self._patch = run, name, patch

    def at(self, points: Any, below_interface: bool = False) -> Array:
        """(n, 6) stresses [Pa] at (n, 3) points (x, y, depth) [m]. Points of one depth cost one plane together, some 10
        ms; each distinct depth costs one. On an interface those of the material above, or below if asked. ValueError: a
        point above the surface, or more than ten lengths of the patch's grid away from it (fewer with layers and small
        cells)."""
        points = _bridge.numbers(points)
        if points.ndim == 2 and points.shape[1] == 3 and np.any(points[:, 2] < 0):
            raise ValueError(f"points: row {int(np.argmax(points[:, 2] < 0))} lies above the surface: depths count "
                             "downwards, from 0")
        stresses: Array = _bridge.work(
            "stresses_at", run=self._run, body=self.name, patch=self._patch, points=points,
            below_interface=bool(below_interface),
        )["stresses"]
        return stresses

    def plane(self, depth: float, below_interface: bool = False) -> Array:
        """(6, nx, ny) stresses [Pa] at a depth [m], in the cells of `axes`."""
        stresses: Array = _bridge.work(
            "stress_plane", run=self._run, body=self.name, patch=self._patch, depth=float(depth),
            below_interface=bool(below_interface),
        )["stresses"]
        return stresses

    @property
    def axes(self) -> tuple[Array, Array]:
        """m, x and y of the cells of `plane`."""
        grid = _bridge.call("grid", run=self._run, patch=self._patch)
        return grid["x"], grid["y"]

    def section(self, depths: Any, y: float = 0.0) -> Array:
        """(6, nx, depths) stresses [Pa] in the plane y = const [m], at the x of `axes` and at these depths [m]."""
        depths = np.atleast_1d(np.asarray(depths, float))
        x = self.axes[0]
        points = np.column_stack([np.tile(x, len(depths)), np.full(len(x) * len(depths), y), np.repeat(depths, len(x))])
        return self.at(points).T.reshape(6, len(depths), len(x)).transpose(0, 2, 1)

    def __repr__(self) -> str:
        return f"<railstrata.Body {self.name}>"


def von_mises(stress: Array, axis: int = -1) -> Array:
    """von Mises stress of components xx, yy, zz, xy, yz, xz along an axis: sqrt(3/2 s:s)."""
    parts = np.asarray(stress, float)
    if parts.ndim == 0 or not -parts.ndim <= axis < parts.ndim or parts.shape[axis] != 6:
        raise ValueError(f"stress: six components xx, yy, zz, xy, yz, xz are wanted along axis {axis}, the shape is "
                         f"{parts.shape}")
    xx, yy, zz, xy, yz, xz = np.moveaxis(parts, axis, 0)
    mises: Array = np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (xy**2 + yz**2 + xz**2))
    return mises


class BemResult(Result):
    """A half-space solution in memory: numbers, patch, and stresses anywhere."""

    @property
    def notes(self) -> list[str]:
        """What the user should know: a grown grid, …"""
        return list(self._found["notes"])

    @property
    def rail(self) -> Body:
        """The inside of the rail below the patch of the largest pressure."""
        return Body(self._found, "rail", 0)

    @property
    def wheel(self) -> Body:
        """The inside of the wheel above the patch of the largest pressure."""
        return Body(self._found, "wheel", 0)

    def save(self, folder: PathLike, force: bool = False) -> "Result":
        """Writes the result folder that `railstrata bem` writes; force: an older result there is replaced."""
        _bridge.call("write_half_space", run=self._found, folder=str(folder), force=bool(force))
        return open_result(folder)


class FolderResult(Result):
    """A result folder read back."""

    def __init__(self, folder: PathLike) -> None:
        super().__init__(_bridge.call("read_result_folder", folder=str(folder)))
        self.folder = Path(folder)

    @property
    def history(self) -> "pandas.DataFrame":
        """history.csv of a finite element run or a transient."""
        file = self.folder / "history.csv"
        if not file.exists():
            raise FileNotFoundError(f"{file}: steady half-space results have no history")
        return needs("pandas", "python3-pandas").read_csv(file, comment="#")

    def table(self, name: str) -> "pandas.DataFrame":
        """A table of the folder by its name: "patch", "centre_line", "depth_line", "rail_cross_section", …"""
        file = self.folder / f"{name}.csv"
        if not file.exists():
            names = ", ".join(sorted(other.stem for other in self.folder.glob("*.csv")))
            raise FileNotFoundError(f"{file}: there is no such table; tables here: {names}")
        return needs("pandas", "python3-pandas").read_csv(file, comment="#")

    def report(self, page: Optional[PathLike] = None, reference: bool = True) -> Path:
        """Writes the report page and returns its path; by default report.html in the folder. reference: a finite
        element result is set against the half-space solution of its case."""
        page = Path(page) if page else self.folder / "report.html"
        _bridge.work("write_report", page=str(page), folders=[str(self.folder)], reference=bool(reference))
        return page


def open_result(folder: PathLike) -> FolderResult:
    """The result folder of either engine, `railstrata run` or `bem`. CaseError: it holds no finished result."""
    return FolderResult(folder)
