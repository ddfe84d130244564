"""Wheelsets that are solved state by state: two wheels on one axle, from its motion to the forces of both contacts."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping, Optional, Sequence

from . import _bridge
from .case import AnyCase, Length, Value, _case_of, _metres, _overrides, _thread_count
from .contact import _number, _plain

Pair = Sequence[float]
_Triple = tuple[float, float, float]


@dataclass(frozen=True)
class WheelForces:
    """One wheel of a wheelset, SI, in the track's axes (x along, y to the left, z up).

    force: N, on the wheel. moment: N m, of the contact on the wheelset about its centre. normal_force, lateral_force:
    N, along the contact normal and across it, on the wheel. spin_moment: N m, about the contact normal. approach: m,
    below 0 lifted. point: m, of the contact that touches first, from the middle of the track below the centre.
    on_wheel, on_rail: m, y and z of it in the profiles' own axes, y to the field side. contact_angle: rad.
    rolling_radius: m. p_max: Pa. patch_area: m². dissipation: W. patches, cells: 0 of a lifted wheel. ok: whether
    every check holds.
    """

    force: _Triple
    moment: _Triple
    normal_force: float
    lateral_force: float
    spin_moment: float
    creepage_x: float
    creepage_y: float
    spin: float
    approach: float
    point: _Triple
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


@dataclass(frozen=True)
class WheelsetForces:
    """z: m and roll: rad, as given or found. force: N and moment: N m, of both contacts on the wheelset about its
    centre. left, right: the wheels. solutions: of each contact, that the state took."""

    z: float
    roll: float
    force: _Triple
    moment: _Triple
    left: WheelForces
    right: WheelForces
    solutions: int


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
        self._wheelset = _bridge.call("open_wheelset", case=self._given[0]._loaded, cell=self._given[1],
                                      right=_overrides(self._given[2]))

    @property
    def case(self) -> Any:
        """The case of the left wheel."""
        return self._given[0]

    def solve(
        self, *, speed: float, load: Optional[float] = None, z: Optional[float] = None, roll: Optional[float] = None,
        y: float = 0, yaw: float = 0, y_rate: float = 0, z_rate: float = 0, yaw_rate: float = 0, roll_rate: float = 0,
        pitch_rate: float = 0, roll_moment: float = 0, rail_y: Pair = (0, 0), rail_z: Pair = (0, 0),
        rail_roll: Pair = (0, 0), rail_y_rate: Pair = (0, 0), rail_z_rate: Pair = (0, 0),
    ) -> WheelsetForces:
        """Solves a state of motion.

        Given are load (N, on the axle, down): z and roll are found, under a roll_moment (N m, on the axle about x);
        load and roll: z is found; or z and roll: loads are results. speed: m/s along the track. y, z: m, of the axle's
        centre. yaw, roll: rad. Rates: m/s and rad/s, pitch_rate of the axle beyond speed/r0. rail_...: of the left and
        the right rail: displacements in m and rad, rates of their material. Raises CaseError (out of range, no answer),
        NumericalError, MachineError; Ctrl-C stops it.
        """
        numbers = {
            "speed": speed, "load": load, "z": z, "roll": roll, "y": y, "yaw": yaw, "y_rate": y_rate, "z_rate": z_rate,
            "yaw_rate": yaw_rate, "roll_rate": roll_rate, "pitch_rate": pitch_rate, "roll_moment": roll_moment,
        }
        pairs = {"rail_y": rail_y, "rail_z": rail_z, "rail_roll": rail_roll, "rail_y_rate": rail_y_rate,
                 "rail_z_rate": rail_z_rate}
        state: dict[str, Any] = {name: _number(value, name) for name, value in numbers.items() if value is not None}
        for name, pair in pairs.items():
            if len(pair) != 2:
                raise ValueError(f"{name}: two numbers are wanted, of the left and the right rail")
            state[name] = [_number(value, name) for value in pair]
        found = _bridge.work("solve_wheelset", wheelset=self._wheelset, threads=self._given[3], state=state)
        numbers_of_all = {name: _plain(found[name]) for name in ("z", "roll", "force", "moment", "solutions")}
        left, right = (WheelForces(**{name: _plain(value) for name, value in found[side].items()})
                       for side in ("left", "right"))
        return WheelsetForces(**numbers_of_all, left=left, right=right)

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
