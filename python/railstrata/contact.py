"""Contacts that are solved state by state, as a vehicle's time integration asks for them."""
from __future__ import annotations

import math
import warnings
from dataclasses import dataclass
from typing import Any, Mapping, Optional

from . import _bridge
from ._bridge import Array
from .case import AnyCase, Length, _case_of, _metres, _thread_count
from .errors import CheckWarning
from .patch import Patch


@dataclass(frozen=True)
class ContactForces:
    """What a contact gives, SI; NaN: does not apply. Of several patches: forces of all, the rest of the one with the
    largest pressure. remarks: the checks that do not hold, and notes.

    force: N, on the wheel, model frame. normal_force, lateral_force: N, along the contact normal and across it, on the
    wheel. spin_moment: N m, on the wheel about the contact normal. creepage_x, creepage_y: as given, or found for the
    forces. spin: 1/m. approach: m. contact_angle: rad. p_max, q_max: Pa. patch_area, slip_area: m². dissipation: W, in
    the patch. patches: contacts that share the load. cells: with pressure, of the first patch. iterations: products
    with the influence matrix. ok: every check of the result holds; the remarks name those that do not. beyond: not 0:
    NO SOLUTION but its continuation beyond what half-spaces bear.
    """

    force: tuple[float, float, float]
    normal_force: float
    lateral_force: float
    spin_moment: float
    creepage_x: float
    creepage_y: float
    spin: float
    approach: float
    contact_angle: float
    p_max: float
    q_max: float
    patch_area: float
    slip_area: float
    dissipation: float
    patches: int
    cells: int
    iterations: int
    ok: bool
    beyond: bool
    remarks: tuple[str, ...]


@dataclass(frozen=True)
class PatchForces:
    """One of the patches that share the load, SI, in the model's axes.

    force: N, on the wheel. moment: N m, of its tractions on the wheel, sum of (r - about) x dF. normal_force,
    lateral_force: N, along the plane's normal and across it, on the wheel. spin_moment: N m, on the wheel about the
    plane's normal through `point`. approach: m, along that normal. point: m, where the rigid bodies touch. on_wheel,
    on_rail: m, y and z of it in the profiles' own axes, y to the field side. contact_angle: rad, of the common tangent
    to y. rolling_radius: m. p_max: Pa. patch_area: m². dissipation: W. cells: with pressure.
    """

    force: tuple[float, float, float]
    moment: tuple[float, float, float]
    normal_force: float
    lateral_force: float
    spin_moment: float
    approach: float
    point: tuple[float, float, float]
    on_wheel: tuple[float, float]
    on_rail: tuple[float, float]
    contact_angle: float
    rolling_radius: float
    p_max: float
    patch_area: float
    dissipation: float
    cells: int


@dataclass(frozen=True)
class ContactDerivatives:
    """Derivatives of a contact's forces by one input of `Contact.solve`, in the units of ContactForces per that of the
    input.

    force: N per unit of the input, and so on.
    """

    force: tuple[float, float, float]
    normal_force: float
    lateral_force: float
    spin_moment: float
    creepage_x: float
    creepage_y: float
    spin: float
    approach: float
    contact_angle: float


def _plain(value: Any) -> Any:
    """Numbers that are none come as texts."""
    if isinstance(value, list):
        return tuple(_plain(v) for v in value)
    return float(value) if isinstance(value, str) else value


def _number(value: Any, what: str) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{what}: a number in SI units is wanted, not {value!r:.40}") from None
    if not math.isfinite(number):
        raise ValueError(f"{what}: a finite number is wanted, not {number}")
    return number


def _patch_forces(found: Any) -> PatchForces:
    return PatchForces(**{name: _plain(found[name]) for name in PatchForces.__dataclass_fields__})


def _body(body: str) -> str:
    if body not in ("rail", "wheel"):
        raise ValueError('body: "rail" or "wheel"')
    return body


def _state(given: Mapping[str, Any]) -> dict[str, float]:
    return {name: _number(value, name) for name, value in given.items() if value is not None}


def _with_force(found: Mapping[str, Any]) -> dict[str, Any]:
    """force_x, force_y, force_z as one."""
    numbers = {name: _plain(value) for name, value in found.items()}
    return {"force": tuple(numbers.pop(f"force_{axis}") for axis in "xyz"), **numbers}


def _contact_forces(solved: Any, level: int) -> ContactForces:
    """level: of the caller's line, for warnings."""
    found, remarks = _with_force(solved["forces"]), tuple(solved["remarks"].splitlines())
    ok = found.pop("checks_hold")
    if not ok:
        for remark in (r for r in remarks if r.startswith("check ")):
            warnings.warn(remark, CheckWarning, stacklevel=level)
    return ContactForces(**found, ok=ok, remarks=remarks)


class Contact:
    """One wheel on one rail, solved again and again for other positions, loads and creepages; half-spaces
    [Kalker1990].

        contact = rs.Contact("cases/paper/base.toml", cell="0.5 mm")
        for y in (0, 1e-3, 2e-3):
            forces = contact.solve(lateral_shift=y, load=80e3, creepage_x=-0.001)
            forces.force, forces.p_max

    case: a Case, or the path of one; profiles and influence functions are made once. A history in time ([transient])
    is refused. cell: m, or a text with a unit, side of the cells, 0.02e-3 to 5e-3. threads: of a solution, 0 for all;
    on cells as coarse as a vehicle's program takes, 1 is hardly slower. Solutions start from the one before; their
    numbers then depend on it in the sixth digit (`forget` ends that). Python threads may share a contact: they wait for
    each other. A pickled contact is made anew from its case. Raises CaseError.
    """

    def __init__(self, case: AnyCase, cell: Length = 0.25e-3, *, threads: int = 0) -> None:
        self._given = (_case_of(case), _metres(cell, "cell"), _thread_count(threads))
        self._contact = _bridge.call("open_contact", case=self._given[0]._loaded, cell=self._given[1])

    @property
    def case(self) -> Any:
        """The case that the states change."""
        return self._given[0]

    def solve(
        self, *, load: Optional[float] = None, approach: Optional[float] = None, lateral_shift: Optional[float] = None,
        yaw: Optional[float] = None, roll: Optional[float] = None, speed: Optional[float] = None,
        friction: Optional[float] = None, creepage_x: Optional[float] = None, creepage_y: Optional[float] = None,
        spin: Optional[float] = None, force_x: Optional[float] = None, force_y: Optional[float] = None,
    ) -> ContactForces:
        """Solves the case with what is given changed; all else is as in the case, not as in the last call.

        Ranges are those of the keys (docs/case-reference.md). Raises CaseError (out of range, both of a pair, no
        contact, forces beyond friction), NumericalError, MachineError, Ctrl-C stops it; warns with CheckWarning where a
        check fails. An approach beyond what half-spaces bear gives forces to reject a trial step by, with `beyond` and
        a CheckWarning.

        load: N, vertical, on the rail; or approach. approach: m, of the bodies along the contact normal: the load is a
        result. lateral_shift: m, of the wheel to the field side. yaw, roll: tangents of angle of attack and roll, as
        the case's; rs_wheelset_state has the angles in rad. speed: m/s; below 0.01, also at a standstill, that of 0.01;
        < 0 as > 0: x is the rolling direction. friction: coefficient at rest. creepage_x: (V - omega r) / V, negative
        drives; or force_x. creepage_y: lateral, in the contact plane; or force_y. spin: 1/m; without it that of the
        geometry. force_x: N, longitudinal, on the wheel. force_y: N, lateral friction on the wheel, in the contact
        plane.
        """
        given = {name: value for name, value in locals().items() if name != "self"}
        solved = _bridge.work("solve_contact", contact=self._contact, threads=self._given[2], state=_state(given))
        return _contact_forces(solved, 3)

    def jacobian(self, *inputs: str) -> dict[str, ContactDerivatives]:
        """Derivatives of the last solution by inputs of `solve`, {"yaw": ...}; all others stay as they were given.

            contact.solve(load=80e3, yaw=1e-3, creepage_x=0)
            contact.jacobian("lateral_shift", "yaw")["yaw"].force

        The linearised equations of the cells in contact: errors of some 1e-4, 1e-6 after set_tolerance(1e-8). Of
        several patches in one plane `force` is that of `solve`, all else is of the whole plane, where `solve` has one
        patch. Patches in planes of their own, friction that falls and films that yield: differences of new solutions,
        several times dearer. Of a lifted wheel all are 0; after an answer that is `beyond`, those of the solution that
        it is continued from.
        CaseError: no solution, an input that is a result of the last state; ValueError: no input.
        """
        found = _bridge.work("jacobian_of_contact", contact=self._contact, inputs=list(inputs), threads=self._given[2])
        return {name: ContactDerivatives(**_with_force(slopes)) for name, slopes in zip(inputs, found["slopes"])}

    def set_profile(self, body: str, points: Any) -> None:
        """Takes a profile in place of the case's: worn, or another one each step. body: "rail" or "wheel"; points:
        (n, 2), y and z [m] along the curve, as a file of two columns has them. The last solution is gone, the next one
        starts from it; pickles have the case's profile. CaseError, and the old profile stays: no profile, no contact
        with it; ValueError: no such body, another shape."""
        _bridge.call("set_profile_of_contact", contact=self._contact, body=_body(body), points=_bridge.numbers(points))

    def set_tolerance(self, tolerance: float) -> None:
        """Tolerance of solutions, 1e-12 to 1e-3; 1e-5 unless set: of slip, friction and load; of the gap a hundredth.
        CaseError: out of range."""
        _bridge.call("set_tolerance_of_contact", contact=self._contact, tolerance=_number(tolerance, "tolerance"))

    def copy(self) -> "Contact":
        """A copy with profile, tolerance, last solution and where the next one starts from: both go on with the same
        bits. Copies share influence functions; solve them on threads of their own, or by rs.solve_many."""
        made = Contact.__new__(Contact)
        made._given = self._given
        made._contact = _bridge.call("copy_contact", contact=self._contact)
        return made

    def patch(self, index: int = 0) -> Patch:
        """A patch of the last solution, that of the largest pressure first: copies, (stations, columns). CaseError: no
        solution, no such patch."""
        return Patch(_bridge.call("patch_of_contact", contact=self._contact, patch=index)["patch"])

    def patch_forces(self, index: int = 0, about: Any = (0.0, 0.0, 0.0)) -> PatchForces:
        """What a patch of the last solution carries, that of the largest pressure first; tread and gauge corner apart
        where they are not connected. about: m, model axes, the point that the moment is about. CaseError: no solution,
        no such patch."""
        found = _bridge.call(
            "forces_of_patch", contact=self._contact, patch=index, about=_bridge.numbers(about))
        return _patch_forces(found)

    def stresses(self, points: Any, body: str = "rail") -> Array:
        """(n, 6) stresses [Pa] of the last solution at (n, 3) points, as `result.rail.at` of rs.bem has them: x, y,
        depth [m] from the rigid contact point; components xx, yy, zz, xy, yz, xz. body: "rail" or "wheel". CaseError:
        no solution, a point above the surface or far away; ValueError: no such body, another shape."""
        stresses: Array = _bridge.work(
            "stress_of_contact", contact=self._contact, body=_body(body), points=_bridge.numbers(points))["stresses"]
        return stresses

    def forget(self) -> None:
        """The next solution starts from nothing and has the bits of a new contact's first."""
        _bridge.call("forget_contact", contact=self._contact)

    def __reduce__(self) -> Any:
        return _made_anew, self._given

    def __repr__(self) -> str:
        return f"<railstrata.Contact {self._given[0].title!r}, cell {1e3 * self._given[1]:g} mm>"


def _made_anew(case: Any, cell: float, threads: int) -> Contact:
    return Contact(case, cell, threads=threads)
