"""Many contacts or wheelsets in one call, over threads."""
from __future__ import annotations

from typing import Any, Mapping, Sequence, Union, overload

from . import _bridge, errors
from .case import _thread_count
from .contact import Contact, ContactForces, _contact_forces, _state
from .wheelset import Wheelset, WheelsetForces, _motion, _wheelset_forces


@overload
def solve_many(handles: Sequence[Contact], states: Sequence[Mapping[str, Any]], *, threads: int = 0,
               return_exceptions: bool = False) -> list[ContactForces]: ...
@overload
def solve_many(handles: Sequence[Wheelset], states: Sequence[Mapping[str, Any]], *, threads: int = 0,
               return_exceptions: bool = False) -> list[WheelsetForces]: ...


def solve_many(handles: Any, states: Any, *, threads: int = 0, return_exceptions: bool = False) -> Any:
    """Solves contacts, or wheelsets, each with its state, the keywords of its `solve`: forces in the same order, with
    the bits of one after the other for any number of threads (0: all).

        wheelset = rs.Wheelset("cases/quick", cell="1 mm")
        axles = [wheelset.copy() for _ in range(4)]
        forces = rs.solve_many(axles, [{"speed": 20, "load": 160e3, "y": y} for y in (0, 1e-3, 2e-3, 3e-3)])

    After all are solved, raises what the first that fails raises; with return_exceptions such errors stand in the list
    instead. Ctrl-C stops it after the solutions under way. CaseError: one of them appears twice (give a copy);
    TypeError: contacts among wheelsets, an unknown keyword; ValueError: not as many states.
    """
    handles, states = list(handles), list(states)
    kind: Any = Wheelset if handles and isinstance(handles[0], Wheelset) else Contact
    if not all(isinstance(one, kind) for one in handles):
        raise TypeError("handles: contacts alone, or wheelsets alone, are wanted")
    if len(states) != len(handles):
        raise ValueError(f"{len(handles)} handles and {len(states)} states: as many are wanted")
    for state in states:
        _require_keywords(kind, state)
    of_contacts = kind is Contact
    solved = _bridge.work(
        "solve_contacts" if of_contacts else "solve_wheelsets", threads=_thread_count(threads),
        handles=[one._contact if of_contacts else one._wheelset for one in handles],
        states=[(_state if of_contacts else _motion)(state) for state in states])
    found = [_fault(one) or (_contact_forces if of_contacts else _wheelset_forces)(one, 4) for one in solved["found"]]
    for one in found:
        if isinstance(one, BaseException) and not return_exceptions:
            raise one
    return found


def _fault(one: Mapping[str, Any]) -> Union[BaseException, None]:
    return errors.raised(**one["fault"]) if "fault" in one else None


def _require_keywords(kind: Any, state: Mapping[str, Any]) -> None:
    known = kind.solve.__kwdefaults__ or {}
    for name in state:
        if name not in known and name != "speed":
            raise TypeError(f"{name} is no keyword of {kind.__name__}.solve")
    if kind is Wheelset and "speed" not in state:
        raise TypeError("speed is missing in a state of a wheelset")
