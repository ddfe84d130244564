"""What can go wrong, as exceptions."""
from __future__ import annotations

import builtins
import re
from dataclasses import dataclass

_SET = re.compile(r"""--set (?P<key>[\w.-]+)=(?P<value>"[^"\n]*"|'[^'\n]*'|(?:(?! or --set |: |\n).)*)""")
_WORDS = (
    ("write --set table.key=value, e.g. ", "write "), ("choose another with --out", "choose another folder"),
    ("choose another folder with --out", "choose another folder"), ("with --force", "with force=True"),
    ("what --set gives", "what the changes give"), ("the --set", "the changes"), ("the --cell", "the cell"),
    ("the --roll-length", "the roll_length"), ("with --engine fem", 'with engine="fem"'),
)


def _change(found: re.Match[str]) -> str:
    """An override as the dict that it came from."""
    value = found["value"].strip("\"'")
    plain = re.fullmatch(r"[-+\d.eE]+|true|false|\[.*|\{.*", value)
    return f'{{"{found["key"]}": ' + (f"{value}}}" if plain else f'"{value}"}}')


def _in_python(text: str) -> str:
    """Messages that name options of the program in the words of this package."""
    for option, argument in _WORDS:
        text = text.replace(option, argument)
    return _SET.sub(_change, text)


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
        self.diagnostics = [Diagnostic(_in_python(d.message), _in_python(d.remedy), _in_python(d.where))
                            for d in diagnostics or [Diagnostic(text)]]


class NumericalError(ArithmeticError):
    """The numbers went wrong (no convergence, an inverted element); the text names where and when."""


class MachineError(OSError):
    """The machine cannot do it: memory, disk, permissions. `remedy`: what the user can do, if anything."""

    def __init__(self, text: str, remedy: str = "") -> None:
        self.remedy = _in_python(remedy)
        super().__init__(f"{text}\n    remedy: {self.remedy}" if remedy else text)


def raised(kind: str, text: str, remedy: str, diagnostics: list[list[str]]) -> BaseException:
    """The exception of a fault that the library reports: one of these classes, or one of Python's own by its name."""
    if kind == "CaseError":
        return CaseError(text, [Diagnostic(*one) for one in diagnostics])
    if kind == "MachineError":
        return MachineError(text, remedy)
    if kind == "NumericalError":
        return NumericalError(text)
    made: BaseException = getattr(builtins, kind)(text)
    return made


class CheckWarning(UserWarning):
    """A check of a result failed, or a note of the solver: read the numbers with care."""
