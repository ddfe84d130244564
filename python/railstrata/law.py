"""The law of yielding at a point: driven along a path, fitted to tests."""
from __future__ import annotations

import os
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any, Mapping, Optional, Union

import numpy as np

from . import _bridge
from ._bridge import Array
from .case import Case, _case_of, _file_of
from .errors import CheckWarning
from .patch import needs

if TYPE_CHECKING:
    import pandas

COMPONENTS = ("xx", "yy", "zz", "xy", "yz", "xz")
PathLike = Union[str, "os.PathLike[str]"]
Card = Union[Case, PathLike]


def _columns(given: Any, names: Mapping[str, Any]) -> list[tuple[str, Array]]:
    """Names and numbers of what maps names to columns (a dict, a DataFrame), in SI units."""
    out = []
    for name in given.keys():
        values = np.asarray(given[name], float)
        if name not in names:
            raise ValueError(f"column {name!r}: one of {', '.join(names)} is wanted, strain without unit, stress in Pa")
        if np.atleast_1d(values).ndim != 1:
            raise ValueError(f"column {name!r}: one number a point is wanted")
        out.append((name, _bridge.numbers(np.atleast_1d(values))))
    return out


def _given(what: Any, names: Mapping[str, Any], of_array: Any) -> Any:
    if isinstance(what, (str, os.PathLike)):
        return {"file": str(_file_of(what)), "columns": []}
    if hasattr(what, "keys"):
        return {"file": "", "columns": _columns(what, names)}
    return {"file": "", "columns": of_array(what)}


def _path(what: Any, letter: str, names: Mapping[str, Any]) -> Any:
    def of_array(values: Any) -> list[tuple[str, Array]]:
        numbers = np.asarray(values, float)
        if numbers.ndim != 2 or numbers.shape[1] != 6:
            raise ValueError("a path: an array of shape (points, 6) is wanted, components xx, yy, zz, xy, yz, xz; or a "
                             "dict of the components that are prescribed")
        return [(f"{letter}_{c}", _bridge.numbers(numbers[:, j])) for j, c in enumerate(COMPONENTS)]

    return _given(what, names, of_array)


def _curve(what: Any, kind: str) -> Any:
    names = dict.fromkeys(("strain", "plastic_strain", "stress"))

    def of_array(values: Any) -> list[tuple[str, Array]]:
        numbers = np.asarray(values, float)
        if numbers.ndim != 2 or numbers.shape[1] != 2:
            raise ValueError(f"{kind}: an array of shape (points, 2) is wanted, strain and stress [Pa]")
        return [(name, _bridge.numbers(numbers[:, j])) for j, name in enumerate(("strain", "stress"))]

    if hasattr(what, "keys"):
        have = set(what.keys())
        if "stress" not in have or len(have & {"strain", "plastic_strain"}) != 1 or len(have) != 2:
            raise ValueError(f"{kind}: the columns stress [Pa] and strain or plastic_strain are wanted")
    return _given(what, names, of_array)


def _law(found: dict[str, Any]) -> dict[str, Any]:
    return {**found, "backstresses": [tuple(term) for term in found["backstresses"]]}


class DrivenPath:
    """What a material does along a path: read-only views, a row a point (cycles times through the rows of the path).

    strain, plastic_strain: (n, 6) [-], tensor shears; stress: (n, 6) [Pa]; components xx, yy, zz, xy, yz, xz.
    p: (n,) accumulated plastic strain. dissipated: (n,) J/m³ since the beginning. `on_the_way` has the same of the
    states between the points, without extrapolation. increments: steps a row of the finest run; strain_error,
    stress_error [Pa]: largest ± of the states.
    """

    def __init__(self, driven: _bridge.Answer, on_the_way: bool = False) -> None:
        self._driven = driven
        states = driven["on_the_way" if on_the_way else "states"]
        self.strain: Array = states["strain"]
        self.stress: Array = states["stress"]
        self.plastic_strain: Array = states["plastic_strain"]
        self.p: Array = states["p"]
        self.dissipated: Array = states["dissipated"]
        self.increments: int = driven["increments"]
        self.strain_error: float = driven["strain_error"]
        self.stress_error: float = driven["stress_error"]

    @property
    def on_the_way(self) -> "DrivenPath":
        """The states of the increments, for pictures: every one of them, of long paths every n-th; the first one is
        unloaded."""
        return DrivenPath(self._driven, True)

    @property
    def net(self) -> Array:
        """(cycles, 6) what each time through the rows adds to the plastic strain: ratchetting."""
        net: Array = self._driven["net"]
        return net

    @property
    def p_of_cycle(self) -> Array:
        """(cycles,) plastic strain accumulated in each time through the rows."""
        strain: Array = self._driven["p_of_cycle"]
        return strain

    @property
    def law(self) -> dict[str, Any]:
        """The law that was driven: young, yield_strength, saturation (Q) [Pa], rate (b), backstresses [(C, gamma)]."""
        return _law(self._driven["law"])

    @property
    def notes(self) -> list[str]:
        """Which numbers of the law are estimates, and by what."""
        return list(self._driven["notes"])

    def to_dataframe(self) -> "pandas.DataFrame":
        """The table that `railstrata material` writes, in its units (MPa)."""
        return needs("pandas", "python3-pandas").DataFrame(_bridge.call("driven_table", driven=self._driven)["columns"])

    def __len__(self) -> int:
        return len(self.p)

    def __repr__(self) -> str:
        return f"<railstrata.DrivenPath of {self._driven['name']}: {len(self)} points, p {self.p[-1]:.3g}>"


def material(
    card: Card, *, strain: Any = None, stress: Any = None, of: str = "rail", depth: float = 0.0, increments: int = 100,
    cycles: int = 1,
) -> DrivenPath:
    """Drives a law of yielding at a point along a path, as `railstrata material` does [Chaboche1989].

        S = lambda tr(E) I + 2 mu (E - E^p),   f = sqrt(3/2) |dev S - sum alpha_i| - (sigma_y0 + R) <= 0
        dalpha_i = 2/3 C_i dE^p - gamma_i alpha_i dp,   R = Q (1 - exp(-b p))          (docs/material.md)

        rs.material("cases/material/r260.toml", stress={"s_xx": [500e6, -400e6]}, cycles=50).net[:, 0]

    card: a Case, or the path of a case file; [material.rail] alone will do. of: "rail", "wheel", "layer.0" or a layer's
    name. depth: m, 0 or more, a place in a graded material. One of the two paths:

    strain: every component's strain, tensor shears, -0.5 to 0.5: an array (points, 6), or a dict or DataFrame of
    "e_xx" ... "e_xz"; what it leaves out is zero. stress: the same in Pa with "s_xx" ... "s_xz"; what it leaves out is
    free of stress; "e_xx" instead of "s_xx" prescribes the strain of a direction, e_xx alone is the tensile test. Or a
    path of a CSV file as the command reads it. The path begins unloaded and goes straight from point to point in steps
    of backward Euler, at first `increments` each, doubled and extrapolated to none, `cycles` times through the rows;
    prescribed stresses are met to 1e-9 of the yield stress.
    Strains are small: a CheckWarning from 5 % plastic strain on, no claim above 10 %.

    Raises CaseError (the card gives no strength; a stress that the material does not bear, with its row, the first one
    0), NumericalError (increments too large), ValueError (shapes). Ctrl-C stops it.
    """
    if (strain is None) == (stress is None):
        raise ValueError("one of strain and stress is wanted")
    if not (np.isfinite(depth) and depth >= 0):
        raise ValueError("depth: a length of 0 or more is wanted, in m")
    if increments < 1 or cycles < 1:
        raise ValueError("increments and cycles: 1 or more")
    strains = dict.fromkeys(f"e_{c}" for c in COMPONENTS)
    both = {**strains, **dict.fromkeys(f"s_{c}" for c in COMPONENTS)}
    path = _path(strain, "e", strains) if stress is None else _path(stress, "s", both)
    loaded = _case_of(card)._loaded
    driven = _bridge.work(
        "drive_material", card=loaded, of=of, depth=float(depth), path=path, by_stress=stress is not None,
        increments=increments, cycles=cycles,
    )
    largest = driven["largest_plastic_strain"]
    if largest > 0.05:
        warnings.warn(f"plastic strain reaches {100 * largest:.1f} %: the law is one of small strain, " + (
            "the stresses are no claim" if largest > 0.1 else "stresses are some per cent off"), CheckWarning,
            stacklevel=2)
    return DrivenPath(driven)


class MaterialFit:
    """A law fitted to tests.

    law: young, yield_strength, saturation (Q) [Pa], rate (b), backstresses [(C [Pa], gamma)], rounded to five digits as
    in the card. error, largest_error: of stress over the largest measured one, root mean square and largest, of the
    stabilised cycle. card: the case file's [material.rail], as text; `Case.from_text(fit.card)` takes it. notes: doubts
    about the tests and the fit.
    """

    def __init__(self, found: _bridge.Answer) -> None:
        self.law: dict[str, Any] = _law(found["law"])
        self.card: str = found["card"]
        self.error: float = found["error"]
        self.largest_error: float = found["largest_error"]
        self.notes: list[str] = found["notes"]

    def save(self, file: PathLike) -> Path:
        """Writes the card; a file that is there is not replaced (FileExistsError)."""
        with open(file, "x", encoding="utf-8") as out:
            out.write(self.card)
        return Path(file)

    def __repr__(self) -> str:
        return f"<railstrata.MaterialFit: yields at {self.law['yield_strength'] / 1e6:.1f} MPa, error {self.error:.2%}>"


def calibrate(
    card: Card, *, loop: Any = None, amplitudes: Any = None, monotonic: Any = None, backstresses: int = 0,
    of: str = "rail",
) -> MaterialFit:
    """Fits a law of yielding to tests, as `railstrata material --calibrate` does [Chaboche1989].

        amplitudes   sigma_a = sigma_y0 + sum C_i/gamma_i tanh(gamma_i eps_pa)
        monotonic    sigma = sigma_s - Q exp(-b eps_p) + sum C_i/gamma_i (1 - exp(-gamma_i eps_p))

    card: gives Young's modulus [Pa], with which total strains become plastic ones. One of loop (a stabilised loop,
    point by point once around) and amplitudes (a stabilised cycle a row); with monotonic, tension from the virgin
    state, Q and b too. Each: an array (points, 2) of strain and stress [Pa], a dict or DataFrame with "stress" and
    "strain" or "plastic_strain", or a path of a CSV file as the command reads it. backstresses: 1 to 4, 0: as many as
    lower the error by a quarter each. Least squares of the relative stress, docs/material.md.

    Raises CaseError (too few points, elastic amplitudes, with the row), ValueError (shapes).
    """
    if (loop is None) == (amplitudes is None):
        raise ValueError("one of loop and amplitudes is wanted")
    if not 0 <= backstresses <= 4:
        raise ValueError("backstresses: 0 to 4")
    of_loop = loop is not None
    cyclic = _curve(loop if of_loop else amplitudes, "loop" if of_loop else "amplitudes")
    tension: Optional[Any] = None if monotonic is None else _curve(monotonic, "monotonic")
    fit = MaterialFit(_bridge.work(
        "calibrate", card=_case_of(card)._loaded, of=of, cyclic=cyclic, of_loop=of_loop, monotonic=tension,
        backstresses=backstresses,
    ))
    for note in fit.notes:
        warnings.warn(note, CheckWarning, stacklevel=2)
    return fit
