"""Cases: what a case file says."""
from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any, Mapping, Optional, Union

from . import _core
from .errors import CaseError, Diagnostic

Value = Union[str, int, float, bool, list]


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


def _file_of(path: Union[str, os.PathLike]) -> Path:
    wanted = Path(path)
    if not wanted.exists() and not wanted.is_absolute():
        data = shipped_data()
        if data is not None and (data / wanted).exists():
            wanted = data / wanted
    if wanted.is_dir() and (wanted / "case.toml").exists():
        wanted = wanted / "case.toml"
    return wanted


def _text_of(value: Value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(json.dumps(v) if isinstance(v, str) else _text_of(v) for v in value) + "]"
    return repr(float(value)) if isinstance(value, float) else str(value)


def _overrides(changes: Optional[Mapping[str, Value]]) -> list[str]:
    return [f"{key}={_text_of(value)}" for key, value in (changes or {}).items()]


class Case:
    """A case file with changes, read and checked.

    Case("cases/paper/base.toml", {"layer.0.thickness": "2 mm"})

    path: a case file, a folder with a case.toml, or the name of a shipped case ("cases/quick"). changes: keys and
    values as `railstrata ... --set` takes them, with units in quotes; numbers for what has no unit. Raises CaseError
    with every fault of the file at once.
    """

    def __init__(self, path: Union[str, os.PathLike], changes: Optional[Mapping[str, Value]] = None) -> None:
        self._loaded = _core.load_case(str(_file_of(path)), _overrides(changes))

    @classmethod
    def from_text(cls, text: str, name: str = "case.toml", changes: Optional[Mapping[str, Value]] = None) -> "Case":
        """The case of a TOML text. `name` stands for the file in messages; profiles are looked for in its folder."""
        case = cls.__new__(cls)
        case._loaded = _core.parse_case(text, name, _overrides(changes))
        return case

    def with_(self, changes: Mapping[str, Value]) -> "Case":
        """The same case with further changes; this one stays as it is."""
        case = Case.__new__(Case)
        case._loaded = _core.parse_case(
            self._loaded.source, self._loaded.file, [*self._loaded.overrides, *_overrides(changes)]
        )
        return case

    @property
    def title(self) -> str:
        """The case's title."""
        return self._loaded.title

    @property
    def file(self) -> str:
        """The file it was read from, as given."""
        return self._loaded.file

    @property
    def toml(self) -> str:
        """The case with every option written out; reads back to the same numbers."""
        return self._loaded.toml

    @property
    def notes(self) -> list[str]:
        """What is allowed and yet worth knowing."""
        return self._loaded.notes

    @property
    def not_in_fem(self) -> list[Diagnostic]:
        """What the finite element engine refuses of this case; empty: it runs."""
        return self._loaded.not_in_fem

    def __getitem__(self, key: str) -> Any:
        """The value of a key in the resolved case, as the file would hold it: case["layer.0.thickness"]."""
        value: Any = _toml(self.toml)
        for part in key.split("."):
            try:
                value = value[int(part)] if isinstance(value, list) else value[part]
            except (KeyError, IndexError, ValueError, TypeError):
                raise KeyError(f"{key}: the case has no such key; rs.schema() lists all of them") from None
        return value

    def __repr__(self) -> str:
        return f"railstrata.Case({self.file!r}: {self.title})"


def _toml(text: str) -> dict:
    import tomllib

    return tomllib.loads(text)


def schema() -> dict:
    """Every key of a case file with its unit, range and meaning, as a JSON schema."""
    return json.loads(_core.schema())


__all__ = ["Case", "CaseError", "schema", "shipped_data"]
