"""Wheelsets that are solved state by state: two wheels on one axle, from its motion to the forces of both contacts."""
from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Any, Mapping, Optional, Sequence

from . import _bridge
from .case import AnyCase, Length, Value, _case_of, _metres, _thread_count
from .contact import Contact, PatchForces, _body, _number, _patch_forces, _plain
from .errors import CheckWarning

Pair = Sequence[float]
_Triple = tuple[float, float, float]


@dataclass(frozen=True)
class WheelForces:
    """One wheel of a wheelset, SI, in the track's axes (x along, y to the left, z up).

    force: N, on the wheel. moment: N m, of the contact on the wheelset, about its centre. normal_force, lateral_force:
    N, along the contact normal and across it, on the wheel. spin_moment: N m, on the wheel about the contact normal.
    creepage_x, creepage_y: at point. spin: 1/m, there. approach: m, along the normal there; < 0: lifted. point: m, of
    the patch, or between several; from the middle of the track below the centre. on_wheel, on_rail: m, y and z of it in
    the profiles' own axes, y to the field side. contact_angle: rad, of the common tangent to y. rolling_radius: m.
    p_max: Pa. patch_area: m². dissipation: W, in the patch. patches, cells: 0: lifted, which is an answer. ok: every
    check of the result holds. beyond: not 0: NO SOLUTION but its continuation beyond what half-spaces bear.
    """

    force: tuple[float, float, float]
    moment: tuple[float, float, float]
    normal_force: float
    lateral_force: float
    spin_moment: float
    creepage_x: float
    creepage_y: float
    spin: float
    approach: float
    point: tuple[float, float, float]
    on_wheel: tuple[float, float]
    on_rail: tuple[float, float]
    contact_angle: float
    rolling_radius: float
    p_max: float
    patch_area: float
    dissipation: float
    patches: int
    cells: int
    ok: bool
    beyond: bool


@dataclass(frozen=True)
class WheelsetForces:
    """z: m and roll: rad, as given or found. force: N and moment: N m, of both contacts on the wheelset about its
    centre. left, right: the wheels. solutions: of each contact, that the state took. beyond: wheels whose
    forces are NO SOLUTION but its continuation beyond what half-spaces bear. remarks: checks that do not hold, and
    notes, each with its wheel before it."""

    z: float
    roll: float
    force: _Triple
    moment: _Triple
    left: WheelForces
    right: WheelForces
    solutions: int
    beyond: int
    remarks: tuple[str, ...]


@dataclass(frozen=True)
class WheelsetDerivatives:
    """Derivatives of what `Wheelset.solve` gave by one number of its state, SI per unit of that.

    z: m and roll: rad, where they are found. force: N and moment: N m, as of WheelsetForces. left_force, left_moment,
    right_force, right_moment: of the contact on one wheel.
    """

    z: float
    roll: float
    force: _Triple
    moment: _Triple
    left_force: _Triple
    left_moment: _Triple
    right_force: _Triple
    right_moment: _Triple


def _pair(values: Any, what: str) -> list[float]:
    if len(values) != 2:
        raise ValueError(f"{what}: two numbers are wanted, of the left and the right side")
    return [_number(value, what) for value in values]


def _wheel_forces(found: Mapping[str, Any]) -> WheelForces:
    numbers = {name: _plain(value) for name, value in found.items()}
    return WheelForces(ok=numbers.pop("checks_hold"), **numbers)


def _motion(given: Mapping[str, Any]) -> dict[str, Any]:
    return {name: (_pair if name.startswith(("rail_", "wheel_")) else _number)(value, name)
            for name, value in given.items() if value is not None}


def _side(side: str) -> int:
    if side not in ("left", "right"):
        raise ValueError('side: "left" or "right"')
    return int(side == "right")


def _wheelset_forces(found: Any, level: int) -> WheelsetForces:
    """level: of the caller's line, for warnings."""
    remarks = tuple(found["remarks"].splitlines())
    for remark in (r for r in remarks if ": check " in r):
        warnings.warn(remark, CheckWarning, stacklevel=level)
    numbers = {name: _plain(found[name]) for name in ("z", "roll", "force", "moment", "solutions", "beyond")}
    return WheelsetForces(**numbers, left=_wheel_forces(found["left"]), right=_wheel_forces(found["right"]),
                          remarks=remarks)


class Wheelset:
    """Two wheels on one axle and their rails, solved again and again for other motions (docs/vehicle.md).

        wheelset = rs.Wheelset("cases/quick", cell="1 mm")
        forces = wheelset.solve(speed=20, load=160e3, y=2e-3, yaw=1e-3)
        forces.force, forces.left.rolling_radius

    case: of the left wheel, a Case or the path of one; the right wheel is its mirror image, with `right`, its own
    changes ({"geometry.rail_profile": "worn.prr"}) of what `case.toml` has. cell: m, or a text with a unit. threads: of
    a solution, 0 for all.
    Solutions start from those before (`keep`, `reset`, `forget`). A pickled wheelset is made anew from its case. Raises
    CaseError.
    """

    def __init__(self, case: AnyCase, cell: Length = 0.25e-3, *, right: Optional[Mapping[str, Value]] = None,
                 threads: int = 0) -> None:
        self._given = (_case_of(case), _metres(cell, "cell"), dict(right or {}), _thread_count(threads))
        case, of_right = self._given[0], self._given[2]
        self._wheelset = _bridge.call("open_wheelset", case=case._loaded, cell=self._given[1],
                                      right=(case.with_(of_right) if of_right else case)._loaded)

    @property
    def case(self) -> Any:
        """The case of the left wheel."""
        return self._given[0]

    def solve(
        self, *, speed: float, z: Optional[float] = None, roll: Optional[float] = None, load: Optional[float] = None,
        y: float = 0, yaw: float = 0, y_rate: float = 0, z_rate: float = 0, yaw_rate: float = 0, roll_rate: float = 0,
        pitch_rate: float = 0, roll_moment: float = 0, rail_y: Pair = (0, 0), rail_z: Pair = (0, 0),
        rail_roll: Pair = (0, 0), rail_y_rate: Pair = (0, 0), rail_z_rate: Pair = (0, 0),
        wheel_pitch_rate: Pair = (0, 0), rail_yaw: Pair = (0, 0),
    ) -> WheelsetForces:
        """Solves a state of motion.

        Given are load (z and roll are found, under a roll_moment), load and roll (z is found), or z and roll (loads are
        results). Pairs are of the left and the right side. Raises CaseError (out of range, no answer), NumericalError,
        MachineError; Ctrl-C stops it. A z that presses a wheel further than half-spaces bear gives forces to reject a
        trial step by, with `beyond` and a CheckWarning.

        y, z, yaw, roll: m, and angles in rad, where rs_state has their tangents. speed: m/s along the track, V; 0
        stands, < 0 rolls back. y_rate, z_rate: m/s. yaw_rate, roll_rate: rad/s; on the inside of a curve of radius R
        yaw_rate has speed / R besides. pitch_rate: rad/s, of the axle beyond speed / r0: > 0 drives. load: N, on the
        axle, down. roll_moment: N m, on the axle about x; with a load and no roll. rail_y, rail_z: m, of the left and
        the right rail: irregularity, deflection. rail_roll: rad, about x through the origins of their profiles.
        rail_y_rate, rail_z_rate: m/s, of the rails' material: deflection, not irregularity. wheel_pitch_rate: rad/s, of
        the left and the right wheel beyond that of the axle: independent wheels. rail_yaw: rad, about z through the
        places of their tape circles at x = 0.
        """
        given = {name: value for name, value in locals().items() if name != "self"}
        found = _bridge.work("solve_wheelset", wheelset=self._wheelset, threads=self._given[3], state=_motion(given))
        return _wheelset_forces(found, 3)

    def jacobian(self, *inputs: str) -> dict[str, WheelsetDerivatives]:
        """Derivatives of the last solution by numbers of its state, {"y": ...}; all others stay as they were given, and
        z and roll that were found follow, so that load and roll moment stay. Of pairs: "rail_y[0]", "rail_y[1]".

            wheelset.solve(speed=20, load=160e3, y=2e-3)
            wheelset.jacobian("y", "yaw", "y_rate")["y"].force

        Errors, and how: as Contact.jacobian. Of a lifted wheel all are 0. CaseError: no solution, no such number, one
        that is a result of the last state.
        """
        found = _bridge.work("jacobian_of_wheelset", wheelset=self._wheelset, inputs=list(inputs),
                             threads=self._given[3])
        return {name: WheelsetDerivatives(**{key: _plain(value) for key, value in slopes.items()})
                for name, slopes in zip(inputs, found["slopes"])}

    def patches(self, side: str, about: Any = None) -> tuple[PatchForces, ...]:
        """What each patch of a wheel carries in the last solution, in the track's axes, the largest pressure first;
        none of a lifted wheel. side: "left" or "right". about: m, track axes, the point that moments are about; None:
        the centre of the wheelset, so that they add up to the wheel's. CaseError: no solution; ValueError: no such
        side."""
        found = _bridge.call("patches_of_wheelset", wheelset=self._wheelset, side=_side(side),
                             about=None if about is None else _bridge.numbers(about))
        return tuple(_patch_forces(patch) for patch in found["patches"])

    def contact(self, side: str) -> Contact:
        """A copy of the contact of one side, "left" or "right", with its last solution: for `patch` and `stresses`. In
        its own axes, those of a left wheel on its rail that rolls on: of the right wheel and of one that rolls back
        those of the mirror. ValueError: no such side."""
        case, cell, right, threads = self._given
        made = Contact.__new__(Contact)
        made._given = (case.with_(right) if right and _side(side) else case, cell, threads)
        made._contact = _bridge.call("contact_of_wheelset", wheelset=self._wheelset, side=_side(side))
        return made

    def set_profile(self, side: str, body: str, points: Any) -> None:
        """As Contact.set_profile, of one side, "left" or "right"; y is to the field side on both."""
        _bridge.call("set_profile_of_wheelset", wheelset=self._wheelset, side=_side(side), body=_body(body),
                     points=_bridge.numbers(points))

    def set_tolerance(self, tolerance: float) -> None:
        """As Contact.set_tolerance, of both sides."""
        _bridge.call("set_tolerance_of_wheelset", wheelset=self._wheelset, tolerance=_number(tolerance, "tolerance"))

    def copy(self) -> "Wheelset":
        """As Contact.copy; what was kept is copied too."""
        made = Wheelset.__new__(Wheelset)
        made._given = self._given
        made._wheelset = _bridge.call("copy_wheelset", wheelset=self._wheelset)
        return made

    def keep(self) -> None:
        """Remembers where the next solution starts from, before trial steps of an integrator."""
        _bridge.call("keep_wheelset", wheelset=self._wheelset)

    def reset(self) -> None:
        """Returns to what was kept: what follows has the bits of what followed the first time."""
        _bridge.call("reset_wheelset", wheelset=self._wheelset)

    def forget(self) -> None:
        """The next solution starts from nothing."""
        _bridge.call("forget_wheelset", wheelset=self._wheelset)

    def __reduce__(self) -> Any:
        return _made_anew, self._given

    def __repr__(self) -> str:
        return f"<railstrata.Wheelset {self._given[0].title!r}, cell {1e3 * self._given[1]:g} mm>"


def _made_anew(case: Any, cell: float, right: Mapping[str, Value], threads: int) -> Wheelset:
    return Wheelset(case, cell, right=right, threads=threads)
