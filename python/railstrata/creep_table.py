"""Creep-force tables read back."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Mapping, Optional, Sequence, Union

import numpy as np

from . import _bridge
from ._bridge import Array
from .errors import CaseError
from .patch import needs

if TYPE_CHECKING:
    import xarray

Numbers = Union[float, Array]


class CreepTable:
    """A creep-force table of `railstrata creep --axis` (docs/creep-table.md): numbers over axes, interpolated between,
    as rs.open_table of its creep_table.h5 gives it.

        table.at(creepage_x=-0.001, creepage_y=0)["force_x"]

    axes: name -> values, SI; of creepages and spin of a scaled table the two ends. grid: the axes of the points, those
    of `axes` but in a scaled table. numbers: name -> values over the grid, in the order of
    `grid`; NaN where a contact has no answer. units: of all, "" of a plain number. Arrays are read-only views.
    """

    def __init__(self, file: Union[str, "os.PathLike[str]"]) -> None:
        if not isinstance(file, (str, os.PathLike)):
            raise TypeError(f"a file is wanted, as text or pathlib.Path, not {file!r:.60}")
        self.file = os.fspath(file)
        self._table = _bridge.call("open_table", file=self.file)
        self.axes: dict[str, Any] = {name: at for name, _, at in self._table["axes"]}
        self.grid: dict[str, Any] = {name: at for name, _, at in self._table["grid"]}
        self.numbers: dict[str, Any] = {name: values for name, _, values in self._table["numbers"]}
        self.units: dict[str, str] = {
            name: unit for name, unit, _ in [*self._table["axes"], *self._table["grid"], *self._table["numbers"]]}

    def at(self, point: Optional[Mapping[str, Any]] = None, *, clamp: bool = False, **axes: Any) -> dict[str, Numbers]:
        """The numbers at a point, or at many: linear along every axis while the others rest, of a scaled table cubic
        along its own three; some ten nanoseconds for every corner of a cell.

        point, axes: a value for every axis, SI; arrays are broadcast against each other, the numbers have their shape.
        point is for names that are no words of Python, {"layer.0.thickness": 1e-3}. A number is NaN where a corner
        around has no answer. CaseError: a value lies beyond its axis, by more than 1e-9 of it; with clamp it is taken
        at the axis's end. TypeError: an axis is missing or unknown; ValueError: NaN, shapes that do not fit.
        """
        given = {**(point or {}), **axes}
        wrong = [f"no {name}" for name in self.axes if name not in given]
        wrong += [f"{name} is no axis" for name in given if name not in self.axes]
        if wrong:
            raise TypeError(f"{', '.join(wrong)}; the axes are {', '.join(self.axes)}")
        values = np.broadcast_arrays(*(np.asarray(given[name], np.float64) for name in self.axes))
        shape = values[0].shape
        found = _bridge.call("look_up", table=self._table,
                             points=_bridge.numbers(np.stack([v.ravel() for v in values], axis=1)))
        if found["beyond"] and not clamp:
            raise CaseError(f"{self._beyond(values)}; compute a larger table, or give clamp=True for the axis's end")
        columns = found["found"].T
        return {name: float(column[0]) if shape == () else column.reshape(shape)
                for name, column in zip(self.numbers, columns)}

    def _beyond(self, values: Sequence[Array]) -> str:
        """Which value lies furthest beyond its axis, over its length."""
        ends = [(float(at[0]), float(at[-1])) for at in self.axes.values()]
        far = [float(np.max(np.maximum(low - v, v - high))) / (high - low) for (low, high), v in zip(ends, values)]
        k = int(np.argmax(far))
        low, high = ends[k]
        wrong = values[k].min() if low - values[k].min() > values[k].max() - high else values[k].max()
        name = list(self.axes)[k]
        return f"{name} = {wrong:g} lies beyond its axis, {low:g} to {high:g} {self.units[name]}".rstrip()

    def to_xarray(self) -> "xarray.Dataset":
        """The whole table as a dataset: a dimension an axis, a variable a number, with units."""
        module = needs("xarray", "python3-xarray")
        names = list(self.grid)
        whole: xarray.Dataset = module.Dataset(
            {name: (names, values, {"units": self.units[name]}) for name, values in self.numbers.items()},
            {name: (name, at, {"units": self.units[name]}) for name, at in self.grid.items()},
        )
        return whole

    def __reduce__(self) -> Any:
        return CreepTable, (self.file,)

    def __repr__(self) -> str:
        shape = " x ".join(str(len(at)) for at in self.grid.values())
        return f"<railstrata.CreepTable {shape} over {', '.join(self.axes)}: {', '.join(self.numbers)}>"


def open_table(file: Union[str, "os.PathLike[str]"]) -> CreepTable:
    """The creep-force table of a file, creep_table.h5. CaseError: no such file, no table; MachineError: no HDF5."""
    return CreepTable(file)
