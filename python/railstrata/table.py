"""Tables of results."""
from __future__ import annotations

import html
from typing import TYPE_CHECKING, Any, Iterator, Optional

import numpy as np

from .patch import needs

if TYPE_CHECKING:
    import pandas
    import xarray


def _at(summary: Optional[dict[str, Any]], path: str) -> Any:
    value: Any = summary
    for part in path.strip("/").split("/"):
        if isinstance(value, dict):
            value = value.get(part)
        elif isinstance(value, list) and part.isdigit() and int(part) < len(value):
            value = value[int(part)]
        else:
            return None
    return value


def _column(values: list[Any]) -> Any:
    """Numbers as an array, NaN where a text has none; texts and lists as they are."""
    if all(isinstance(v, bool) for v in values) or all(type(v) is int for v in values):
        return np.array(values)
    if all(v is None or (isinstance(v, (int, float)) and not isinstance(v, bool)) for v in values):
        return np.array([float("nan") if v is None else v for v in values], float)
    return values


class Table:
    """Rows of a sweep: the varied keys, then the main numbers with the unit in their names, then "fault".

    table["p_max_MPa"] is a column as an array; len(table) the number of cases; iteration gives a dict a case;
    `summaries` what each case's summary.json would hold (None where it could not be solved). Columns of keys hold
    numbers in SI, also where texts with units were given; `units` has their units ("" of a plain number).
    """

    def __init__(self, axes: list[tuple[str, str, int]], columns: list[Any], rows: list[Any]) -> None:
        self.keys = [key for key, _, _ in axes]
        self.units = {key: unit for key, unit, _ in axes}
        self._shape = tuple(count for _, _, count in axes)
        self.summaries: list[Optional[dict[str, Any]]] = [summary for _, summary, _ in rows]
        self._columns: dict[str, Any] = {
            key: _column([values[k] for values, _, _ in rows]) for k, key in enumerate(self.keys)}
        for name, path, factor in columns:
            found = [_at(summary, path) for summary in self.summaries]
            self._columns[name] = np.array([float("nan") if v is None else float(v) * factor for v in found], float)
        self._columns["fault"] = [fault for _, _, fault in rows]

    @property
    def columns(self) -> list[str]:
        """Names of the columns."""
        return list(self._columns)

    def __getitem__(self, name: str) -> Any:
        """A column; KeyError names those that are there."""
        if name not in self._columns:
            raise KeyError(f"{name!r} is no column: {', '.join(self._columns)}")
        return self._columns[name]

    def __contains__(self, name: object) -> bool:
        """Whether there is a column of this name."""
        return name in self._columns

    def __iter__(self) -> Iterator[dict[str, Any]]:
        """The cases, each a dict of the columns."""
        return ({name: column[k] for name, column in self._columns.items()} for k in range(len(self)))

    def __len__(self) -> int:
        return len(self.summaries)

    def to_dataframe(self) -> "pandas.DataFrame":
        """The table in pandas, a row a case; units of the keys in `attrs["units"]`."""
        frame = needs("pandas", "python3-pandas").DataFrame(self._columns)
        frame.attrs["units"] = dict(self.units)
        return frame

    def to_xarray(self) -> "xarray.Dataset":
        """The sweep as a grid: a dimension a key with its SI unit, a variable a number, so that
        `table.to_xarray().p_max_MPa.plot()` labels itself."""
        module = needs("xarray", "python3-xarray")
        coordinates = {}
        for k, key in enumerate(self.keys):
            values = np.moveaxis(np.array(self._columns[key]).reshape(self._shape), k, -1)
            values = values.reshape(-1, self._shape[k])[0]
            coordinates[key] = (key, values, {"units": self.units[key]})
        data = {name: (self.keys, np.array(self._columns[name]).reshape(self._shape))
                for name in self._columns if name not in self.keys}
        grid: xarray.Dataset = module.Dataset(data, coordinates)
        return grid

    def __repr__(self) -> str:
        return f"<railstrata.Table: {len(self)} cases over {', '.join(self.keys)}>"

    def _repr_html_(self) -> str:
        shown = [*self.keys, *[c for c in ("p_max_MPa", "q_max_MPa", "patch_area_mm2", "fault") if c in self._columns]]
        head = "".join(f"<th>{html.escape(name)}</th>" for name in shown)

        def cell(value: Any) -> str:
            return f"{value:.4g}" if isinstance(value, float) else html.escape(str(value))

        body = "".join(
            "<tr>" + "".join(f"<td>{cell(self._columns[name][k])}</td>" for name in shown) + "</tr>"
            for k in range(len(self))
        )
        return f"<table><tr>{head}</tr>{body}</table>"
