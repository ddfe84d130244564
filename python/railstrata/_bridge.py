"""Calls of the library, by ctypes: names, JSON and arrays that numpy looks at without a copy (src/doors/bridge)."""
from __future__ import annotations

import ctypes
import json
import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Optional

import numpy as np

from . import errors

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]
else:
    Array = np.ndarray

# Threads that spin long while they wait take the core from those that work. Read when OpenMP comes with the library.
os.environ.setdefault("OMP_WAIT_POLICY", "passive")
os.environ.setdefault("GOMP_SPINCOUNT", "3000")
_LOOK_EVERY = 20  # ms, while a call lasts: for Ctrl-C and for progress


def _loaded() -> ctypes.CDLL:
    file = Path(__file__).with_name("libbridge.so")
    try:
        library = ctypes.CDLL(str(file))
    except OSError as error:
        raise ImportError(f"the library of railstrata cannot be loaded: {error}") from None
    address, text = ctypes.c_void_p, ctypes.c_char_p
    for name, result, *arguments in (
        ("call", address, text, text), ("begin", address, text, text), ("wait", ctypes.c_int, address, ctypes.c_int),
        ("progress", text, address), ("stop", None, address), ("answer", text, address), ("forget", None, address),
    ):
        function = getattr(library, f"railstrata_{name}")
        function.restype, function.argtypes = result, arguments
    return library


_library = _loaded()


class _Memory:
    """What a call holds, and the arrays that it was given: freed with the last array or answer that looks at it."""

    def __init__(self, address: int, given: dict[str, Any]) -> None:
        self.address, self._given = address, given
        self._forget = _library.railstrata_forget

    def __del__(self) -> None:
        self._forget(self.address)


class _View:
    """What numpy makes an array of that keeps the memory alive."""

    def __init__(self, memory: _Memory, entry: dict[str, Any]) -> None:
        self._memory = memory
        strides = entry.get("strides")
        self.__array_interface__ = {
            "version": 3, "data": (entry["__array__"], True), "typestr": entry["type"], "shape": tuple(entry["shape"]),
            "strides": None if strides is None else tuple(strides),
        }


class Answer:
    """What a call has found, by name. Given to a later call it stands for what the call has made."""

    def __init__(self, memory: _Memory, text: bytes) -> None:
        self._memory: Optional[_Memory] = memory

        def seen(entry: dict[str, Any]) -> Any:
            return np.asarray(_View(memory, entry)) if "__array__" in entry else entry

        self._found: dict[str, Any] = json.loads(text, object_hook=seen)

    @property
    def address(self) -> int:
        """Of the call."""
        if self._memory is None:
            raise RuntimeError("a result that was pickled has its numbers and arrays alone: solve the case again for "
                               "stresses inside the bodies and for a folder")
        return self._memory.address

    def __reduce__(self) -> Any:
        """Pickled by its numbers and arrays; what the call has made stays behind."""
        return _unpickled, (self._found,)

    def __deepcopy__(self, memo: Any) -> "Answer":
        """Nobody changes it."""
        return self

    def __getitem__(self, name: str) -> Any:
        return self._found[name]


def _unpickled(found: dict[str, Any]) -> Answer:
    answer = Answer.__new__(Answer)
    answer._memory, answer._found = None, found
    _read_only(found)
    return answer


def _read_only(found: Any) -> None:
    if isinstance(found, np.ndarray):
        found.setflags(write=False)
    elif isinstance(found, (list, dict)):
        for one in found.values() if isinstance(found, dict) else found:
            _read_only(one)


def _plain(value: Any) -> Any:
    """A value as JSON has it. Arrays go by their address: the caller keeps them alive."""
    if isinstance(value, Answer):
        return value.address
    if isinstance(value, np.ndarray):
        return {"__array__": value.ctypes.data, "shape": value.shape}
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    if isinstance(value, dict):
        return {key: _plain(one) for key, one in value.items()}
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    return value


def _arguments(arguments: dict[str, Any]) -> bytes:
    return json.dumps(_plain(arguments), default=_refused, ensure_ascii=False).encode(errors="surrogateescape")


def _refused(value: Any) -> Any:
    raise TypeError(f"{value!r:.60} is no number, text or array")


def numbers(values: Any) -> Array:
    """An array as the library reads it: doubles in one piece."""
    return np.ascontiguousarray(values, np.float64)


def _answer(memory: _Memory) -> Answer:
    answer = Answer(memory, _library.railstrata_answer(memory.address))
    fault = answer._found.get("fault")
    if isinstance(fault, dict) and "kind" in fault:
        raise errors.raised(**fault)
    return answer


def call(function: str, /, **arguments: Any) -> Answer:
    """Calls a function of the library that ends at once."""
    return _answer(_Memory(_library.railstrata_call(function.encode(), _arguments(arguments)), arguments))


def work(function: str, progress: Optional[Callable[..., None]] = None, /, **arguments: Any) -> Answer:
    """Calls a function that takes its time, on a thread of its own. Ctrl-C, and what `progress` raises, stops it."""
    memory = _Memory(_library.railstrata_begin(function.encode(), _arguments(arguments)), arguments)
    raised: Optional[BaseException] = None
    while True:
        try:
            if _library.railstrata_wait(memory.address, _LOOK_EVERY):
                break
            if progress is None or raised is not None:
                continue
            told = _library.railstrata_progress(memory.address)
            if told:
                progress(*json.loads(told))
        except BaseException as error:
            raised = raised or error
            _library.railstrata_stop(memory.address)
    if raised is not None:
        raise raised
    return _answer(memory)
