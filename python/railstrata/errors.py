"""What can go wrong, as exceptions."""
from __future__ import annotations

import builtins
from dataclasses import dataclass


def _in_python(text: str) -> str:
    """Remedies that name options of the program, in the words of this package."""
    for option, argument in (("choose another with --out", "choose another folder"),
                             ("choose another folder with --out", "choose another folder"),
                             ("with --force", "with force=True")):
        text = text.replace(option, argument)
    return text


@dataclass(frozen=True)
class Diagnostic:
    """One fault of an input: what is wrong, what to do, and where ("file:line:column" as far as it is known)."""

    message: str
    remedy: str = ""
    where: str = ""


class CaseError(ValueError):
    """The case cannot be computed as it is: a fault of its text, its profiles, its numbers, or a physical refusal.

    `diagnostics` holds every fault that was found (list of Diagnostic); the text shows all of them.
    """

    def __init__(self, text: str, diagnostics: list[Diagnostic] | None = None) -> None:
        super().__init__(_in_python(text))
        self.diagnostics = [Diagnostic(d.message, _in_python(d.remedy), d.where)
                            for d in diagnostics or [Diagnostic(text)]]


class NumericalError(ArithmeticError):
    """The numbers went wrong (no convergence, an inverted element); the text names where and when."""


class MachineError(OSError):
    """The machine cannot do it: memory, disk, permissions. `remedy`: what the user can do, if anything."""

    def __init__(self, text: str, remedy: str = "") -> None:
        self.remedy = _in_python(remedy)
        super().__init__(f"{text}\n    remedy: {self.remedy}" if remedy else text)


def raised(kind: str, text: str, remedy: str, diagnostics: list) -> BaseException:
    """The exception of a fault that the library reports: one of these classes, or one of Python's own by its name."""
    if kind == "CaseError":
        return CaseError(text, [Diagnostic(*one) for one in diagnostics])
    if kind == "MachineError":
        return MachineError(text, remedy)
    if kind == "NumericalError":
        return NumericalError(text)
    return getattr(builtins, kind)(text)


class CheckWarning(UserWarning):
    """A check of a result failed, or a note of the solver: read the numbers with care."""
