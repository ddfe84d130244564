"""Tables of results."""
from __future__ import annotations

import html
from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from .patch import needs

if TYPE_CHECKING:
    import pandas


def _at(summary: Optional[dict], path: str) -> Any:
    value: Any = summary
    for part in path.strip("/").split("/"):
        if isinstance(value, dict):
            value = value.get(part)
        elif isinstance(value, list) and part.isdigit() and int(part) < len(value):
            value = value[int(part)]
        else:
            return None
    return value


class Table:
    """Rows of a sweep: the varied keys, then the main numbers with the unit in their names, then "fault".

    table["p_max_MPa"] is a column as an array; len(table) the number of cases; `summaries` what each case's
    summary.json would hold (None where it could not be solved).
    """

    def __init__(self, keys: list[str], columns: list, rows: list) -> None:
        self.keys = keys
        self.summaries = [summary for _, summary, _ in rows]
        self._columns: dict[str, Any] = {key: [values[k] for values, _, _ in rows] for k, key in enumerate(keys)}
        for name, path, factor in columns:
            found = [_at(summary, path) for summary in self.summaries]
            self._columns[name] = np.array([float("nan") if v is None else v * factor for v in found], float)
        self._columns["fault"] = [fault for _, _, fault in rows]

    @property
    def columns(self) -> list[str]:
        """Names of the columns."""
        return list(self._columns)

    def __getitem__(self, name: str) -> Any:
        return self._columns[name]

    def __len__(self) -> int:
        return len(self.summaries)

    def to_dataframe(self) -> "pandas.DataFrame":
        """The table in pandas."""
        return needs("pandas", "python3-pandas").DataFrame(self._columns)

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
