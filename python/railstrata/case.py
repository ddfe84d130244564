"""Cases: the contents of a case file."""
from __future__ import annotations

import math
import operator
import os
import sys
import warnings
from pathlib import Path
from typing import Any, Mapping, Optional, Sequence, Union

import numpy as np

from . import _bridge
from .errors import CaseError, Diagnostic

Value = Union[str, int, float, bool, "os.PathLike[str]", Sequence[Any], Mapping[str, Any]]
Length = Union[float, str]
PathLike = Union[str, "os.PathLike[str]"]
AnyCase = Union["Case", str, "os.PathLike[str]"]


def shipped_data() -> Optional[Path]:
    """The folder with the shipped cases and profiles, or None: RAILSTRATA_DATA, else share/railstrata of the prefix
    that the package is installed in, else the checkout that it was built in."""
    if "RAILSTRATA_DATA" in os.environ:
        return Path(os.environ["RAILSTRATA_DATA"])
    for parent in Path(__file__).resolve().parents:
        for folder in (parent / "share" / "railstrata", parent):
            if (folder / "cases" / "quick" / "case.toml").exists() and (folder / "data").exists():
                return folder
    return None


def _file_of(path: PathLike) -> Path:
    if not isinstance(path, (str, os.PathLike)) or isinstance(os.fspath(path), bytes):
        raise TypeError(f"a path is wanted, as text or pathlib.Path, not {path!r:.60}")
    if not os.fspath(path):
        raise ValueError('the path is empty: name a case file, a folder with a case.toml, or a shipped case '
                         '("cases/quick")')
    wanted = Path(path)
    if not wanted.exists() and not wanted.is_absolute():
        data = shipped_data()
        if data is not None and (data / wanted).exists():
            warnings.warn(f"{wanted} is not here; taking the one that comes with the package", stacklevel=_outside())
            wanted = data / wanted
    if wanted.is_dir() and (wanted / "case.toml").exists():
        wanted = wanted / "case.toml"
    return Path(os.path.abspath(wanted))


def _outside() -> int:
    """The level of the caller's line, outside of the package, for warnings."""
    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__package__") == __package__:
        level, frame = level + 1, frame.f_back
    return level


def _value_of(value: Any, key: str) -> Any:
    """A value as the library reads it; it writes the SI unit of the key after a number."""
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, (list, tuple)):
        return [_value_of(one, key) for one in value]
    if isinstance(value, dict):
        return {name: _value_of(one, f"{key}.{name}") for name, one in value.items()}
    if isinstance(value, np.floating):
        value = float(str(value))  # 0.1 of single precision is meant as 0.1
    if isinstance(value, float) and not math.isfinite(value):
        raise ValueError(f"{key}: a finite number is wanted, not {value}")
    if isinstance(value, (str, bool, int, float, np.bool_, np.integer)):
        return value
    remedy = "leave the key out for its default" if value is None else "give a number in SI, a text with a unit, a list"
    raise TypeError(f"{key}: {type(value).__name__} is no value of a case: {remedy}")


def _overrides(changes: Optional[Mapping[str, Value]]) -> list[Any]:
    if changes is not None and not hasattr(changes, "items"):
        raise TypeError(f'changes: a dict of keys and values is wanted, {{"layer.0.thickness": "2 mm"}}, '
                        f"not {type(changes).__name__}")
    for key in changes or {}:
        if not isinstance(key, str) or not key or "=" in key:
            raise TypeError(f'changes: {key!r:.60} is no key; keys are texts, "layer.0.thickness"')
    return [[key, _value_of(value, key)] for key, value in (changes or {}).items()]


def _metres(value: Length, what: str) -> float:
    """A length: a number of metres, or a text with its unit."""
    if isinstance(value, str):
        return float(_bridge.call("length", what=what, text=value)["metres"])
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f'{what}: metres are wanted, 0.25e-3, or a text with a unit, "0.25 mm"') from None


def _count(value: int, what: str) -> int:
    try:
        return operator.index(value)
    except TypeError:
        raise TypeError(f"{what}: a whole number is wanted, not {value!r:.40}") from None


def _thread_count(value: int) -> int:
    """0: as many as are set."""
    most = 1024
    count = _count(value, "threads")
    if not 0 <= count <= most:
        raise ValueError(f"threads: a number from 0 to {most} is wanted, not {count}")
    return count


def _case_of(given: AnyCase) -> "Case":
    """A case as it is, or that of a path."""
    if isinstance(given, Case):
        return given
    if isinstance(given, (str, os.PathLike)):
        return Case(given)
    raise TypeError(f"a railstrata.Case is wanted, or the path of a case file, not {type(given).__name__}")


class Case:
    """A case file with changes, read and checked.

        rs.Case("cases/paper/base.toml", {"layer.0.thickness": "2 mm", "layer.0.young_ratio": 2})

    path: a case file, a folder with a case.toml, or the name of a shipped case ("cases/quick"). changes: keys and
    values; a number is SI ({"vehicle.wheel_load": 80e3} is 80 kN), a text has a unit ("80 kN"), also inside lists.
    Cases with the same resolved options are equal. Raises CaseError with every fault of the file at once.
    """

    def __init__(self, path: PathLike, changes: Optional[Mapping[str, Value]] = None) -> None:
        self._loaded = _bridge.call("load_case", file=str(_file_of(path)), overrides=_overrides(changes))

    @classmethod
    def from_text(cls, text: str, name: str = "case.toml", changes: Optional[Mapping[str, Value]] = None) -> "Case":
        """The case of a TOML text. `name` stands for the file in messages; profiles are looked for in its folder."""
        if not isinstance(text, str):
            raise TypeError(f"text: the TOML text of a case is wanted, not {type(text).__name__}")
        return _parsed(text, os.path.abspath(name), _overrides(changes))

    def with_(self, changes: Mapping[str, Value]) -> "Case":
        """The same case with further changes; this one stays as it is."""
        loaded = self._loaded
        return _parsed(loaded["source"], loaded["file"], [*loaded["overrides"], *_overrides(changes)])

    @property
    def title(self) -> str:
        """The case's title."""
        return str(self._loaded["title"])

    @property
    def file(self) -> str:
        """The file it was read from. Its folder, where profiles are looked for, stays that of the case when the working
        folder changes."""
        return str(self._loaded["file"])

    @property
    def toml(self) -> str:
        """The case with every option written out; reads back to the same numbers."""
        return str(self._loaded["toml"])

    @property
    def notes(self) -> list[str]:
        """What is allowed and yet worth knowing."""
        return list(self._loaded["notes"])

    @property
    def not_in_fem(self) -> list[Diagnostic]:
        """What the finite element engine refuses of this case; empty: it runs."""
        return [Diagnostic(*one) for one in self._loaded["not_in_fem"]]

    def __getitem__(self, key: str) -> Any:
        """The value of a key in the resolved case, as the file would hold it: case["layer.0.thickness"]."""
        if not isinstance(key, str):
            raise TypeError(f'a key is wanted, case["layer.0.thickness"], not {key!r:.40}')
        value: Any = _bridge.call("case_values", case=self._loaded)["values"]
        for part in key.split("."):
            try:
                value = value[int(part)] if isinstance(value, list) else value[part]
            except (KeyError, IndexError, ValueError, TypeError):
                raise KeyError(f"{key}: the case has no such key; rs.schema() lists all of them") from None
        return value

    def __eq__(self, other: object) -> bool:
        """Whether every option is the same; profile files by their paths."""
        return isinstance(other, Case) and self.toml == other.toml

    def __hash__(self) -> int:
        return hash(self.toml)

    def __reduce__(self) -> Any:
        """Pickled by its text: other processes (multiprocessing "spawn") and copies read the same case again."""
        return _parsed, (self._loaded["source"], self._loaded["file"], self._loaded["overrides"])

    def __repr__(self) -> str:
        return f"railstrata.Case({self.file!r}: {self.title})"


def _parsed(source: str, file: str, overrides: list[Any]) -> Case:
    case = Case.__new__(Case)
    case._loaded = _bridge.call("parse_case", text=source, name=file, overrides=overrides)
    return case


def schema() -> dict[str, Any]:
    """Every key of a case file with its unit, range and meaning, as a JSON schema."""
    return dict(_bridge.call("schema")["schema"])


__all__ = ["Case", "CaseError", "schema", "shipped_data"]
