"""The contact patch as arrays."""
from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING, Any

import numpy as np

from ._bridge import Array

if TYPE_CHECKING:
    import pandas
    import xarray


class PatchState(IntEnum):
    """State of a point of the patch."""

    SEPARATED = 0
    STICK = 1
    SLIP = 2


_UNITS = {
    "x": "m", "y": "m", "z": "m", "area": "m2", "p": "Pa", "q_x": "Pa", "q_y": "Pa", "slip_x": "m/s", "slip_y": "m/s",
    "state": "",
}
_NAMES = {
    "p": "contact pressure", "q_x": "longitudinal traction on the rail", "q_y": "lateral traction on the rail",
    "slip_x": "longitudinal slip", "slip_y": "lateral slip", "area": "area of a point", "z": "height of a point",
    "state": "0 separated, 1 stick, 2 slip",
}


def needs(module: str, package: str) -> Any:
    """The optional module, or an ImportError that names the Debian package."""
    import importlib

    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(f"{module} is not installed; on Debian: apt-get install {package}") from error


class Patch:
    """One contact patch: read-only arrays of shape (stations, columns), views into the result, no copies.

    Stations run along the rail (x, rolling direction), columns across it (y). Tractions act on the rail.
    """

    def __init__(self, arrays: dict[str, Any]) -> None:
        self._arrays = arrays

    def _array(self, name: str) -> Array:
        found: Array = self._arrays[name]
        return found

    @property
    def x(self) -> Array:
        """m, from the wheel's axle in the rolling direction."""
        return self._array("x")

    @property
    def y(self) -> Array:
        """m, lateral, model frame."""
        return self._array("y")

    @property
    def z(self) -> Array:
        """m, height, model frame."""
        return self._array("z")

    @property
    def area(self) -> Array:
        """m², of the surface that each point stands for."""
        return self._array("area")

    @property
    def p(self) -> Array:
        """Pa, pressure."""
        return self._array("p")

    @property
    def q_x(self) -> Array:
        """Pa, longitudinal traction on the rail."""
        return self._array("q_x")

    @property
    def q_y(self) -> Array:
        """Pa, lateral traction on the rail."""
        return self._array("q_y")

    @property
    def slip_x(self) -> Array:
        """m/s, longitudinal slip of the wheel's surface over the rail's; m where slip_is_distance."""
        return self._array("slip_x")

    @property
    def slip_y(self) -> Array:
        """m/s, lateral slip; m where slip_is_distance."""
        return self._array("slip_y")

    @property
    def state(self) -> Array:
        """PatchState of each point, uint8."""
        return self._array("state")

    @property
    def slip_is_distance(self) -> bool:
        """Of a shift, which has no speed: slip stands in m, over its last increment."""
        return bool(self._arrays["slip_is_distance"])

    @property
    def shape(self) -> tuple[int, int]:
        """(stations, columns)"""
        stations, columns = self.p.shape
        return stations, columns

    def _unit(self, name: str) -> str:
        return "m" if name.startswith("slip") and self.slip_is_distance else _UNITS[name]

    def to_dataframe(self) -> "pandas.DataFrame":
        """A row a point, a column a quantity, SI units in `attrs["units"]`."""
        table = needs("pandas", "python3-pandas").DataFrame({name: getattr(self, name).ravel() for name in _UNITS})
        table.attrs["units"] = {name: self._unit(name) for name in _UNITS}
        return table

    def to_xarray(self) -> "xarray.Dataset":
        """A dataset over (x, y) with names and units, so that `.p.plot()` labels itself.

        x and y are those of the middle column and station; the points themselves stand in `x_point`, `y_point`, `z`.
        """
        module = needs("xarray", "python3-xarray")
        stations, columns = self.shape
        names = [name for name in _UNITS if name not in ("x", "y")]
        data = {
            name: (("x", "y"), getattr(self, name), {"units": self._unit(name), "long_name": _NAMES[name]})
            for name in names
        }
        for name in ("x", "y"):
            data[f"{name}_point"] = (("x", "y"), getattr(self, name), {"units": "m"})
        coordinates = {
            "x": ("x", self.x[:, columns // 2], {"units": "m", "long_name": "along the rail, from the axle"}),
            "y": ("y", self.y[stations // 2, :], {"units": "m", "long_name": "across the rail"}),
        }
        dataset: xarray.Dataset = module.Dataset(data, coordinates)
        return dataset

    def __repr__(self) -> str:
        return f"railstrata.Patch({self.shape[0]} x {self.shape[1]} points, p_max {self.p.max() / 1e6:.1f} MPa)"
