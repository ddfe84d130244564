"""Fatigue and wear indices for numbers of your own: the functions that `railstrata` itself computes summaries with.

    import numpy as np
    import railstrata as rs
    t = rs.damage.t_gamma(force_x=17e3, force_y=0, creepage_x=-1.2e-3, creepage_y=0)
    rs.damage.rcf_damage(t.without_spin), rs.damage.brr_wear(t.without_spin, wheel_diameter=0.92)
    x = np.linspace(-0.03, 0.03, 241)
    result = rs.bem("cases/quick")
    cycle = result.rail.at([[xi, 0, 2e-3] for xi in x])      # one passage of the wheel at a point
    rs.damage.dang_van(cycle, c=0.3).stress

SI units; equations, ranges and sources stand in docs/damage-theory.md. What a case gives by itself is in
`result.damage`, `result.fatigue` and `result.shakedown`. Constants of a material have no default.
"""
from __future__ import annotations

from typing import Any, NamedTuple, Optional, Sequence, Union

import numpy as np

from . import _bridge

_NO_STRESS = (0.0,) * 6


def _value(function: str, /, **arguments: Any) -> Any:
    """A number of the library; one that is infinite comes as a text. A gap (NaN) among the arguments is an error."""
    for name, given in arguments.items():
        numbers = np.asarray(given) if not isinstance(given, (str, bool)) and given is not None else np.zeros(0)
        if numbers.dtype.kind == "f" and np.isnan(numbers).any():
            raise ValueError(f"{name}: a number is missing (NaN)")
        if name == "t_gamma" and numbers < 0:
            raise ValueError(f"{name}: {given} is below 0; without signs it is |F_x xi| + |F_y eta|")
    found = _bridge.call(function, **arguments)["value"]
    return float(found) if isinstance(found, str) else found


def _number(function: str, /, **arguments: Any) -> float:
    return float(_value(function, **arguments))


class TGamma(NamedTuple):
    """J per m rolled, the same as N."""
    without_spin: float
    with_spin: float
    energy: float


class DangVan(NamedTuple):
    """Pa: s_DV, tau_a and sigma_h at its time; the sample of the cycle."""
    stress: float
    amplitude: float
    hydrostatic: float
    sample: int


class Plane(NamedTuple):
    """A fatigue parameter on its critical plane: value, unit normal, largest normal stress [Pa] and ranges there."""
    value: float
    normal: tuple[float, float, float]
    normal_max: float
    normal_strain_range: float
    shear_range: float


class Planes(NamedTuple):
    """Parameters of a cycle; None where its constants are not given."""
    smith_watson_topper: Plane
    fatemi_socie: Optional[Plane]
    jiang_sehitoglu: Optional[Plane]


def _rows(arrays: dict[str, Any]) -> dict[str, Any]:
    return {name: _bridge.numbers(values) for name, values in arrays.items()}


def _plane(value: float, normal: Sequence[float], *cycle: float) -> Plane:
    x, y, z = normal
    return Plane(float(value), (x, y, z), *map(float, cycle))


def t_gamma(
    force_x: float, force_y: float, creepage_x: float, creepage_y: float, moment: float = 0.0, spin: float = 0.0
) -> TGamma:
    """T-gamma of a patch: forces on the wheel [N], creepages, moment [N m] and spin [1/m] about the contact normal.

    without_spin: |F_x xi| + |F_y eta|, which the damage functions were fitted with; with_spin: with |M_z phi|; energy:
    with signs, what friction takes.
    """
    return TGamma(*map(float, _value(
        "t_gamma", force_x=force_x, force_y=force_y, creepage_x=creepage_x, creepage_y=creepage_y, moment=moment,
        spin=spin,
    )))


def rcf_damage(
    t_gamma: float, function: Union[str, Sequence[tuple[float, float]]] = "15", wear_removes: bool = True
) -> float:
    """Rolling contact fatigue per axle passage over T-gamma [N]; 1 is a crack of visible size [Burstow2004].

    function: "15" (break points 15, 65 and 175 N), "15 clipped", "20", or break points [(N, damage), ...]; for these
    wear_removes: whether the last slope continues.
    """
    points = function if isinstance(function, str) else [(float(at), float(damage)) for at, damage in function]
    return _number("rcf_damage", t_gamma=t_gamma, function=points, wear_removes=bool(wear_removes))


def brr_wear(t_gamma: float, wheel_diameter: float) -> float:
    """British Rail Research's wear number: m² of the profile per m rolled (1 mm²/km = 1e-9) [PearceSherratt1991]."""
    return _number("brr_wear", t_gamma=t_gamma, wheel_diameter=wheel_diameter)


def surface_fatigue_index(
    a: float, b: float, load: float, utilised_friction: float, cyclic_shear_yield: float
) -> float:
    """FI_surf = mu - 2 pi a b k/(3 F_z) of an elliptic patch, semi-axes in m; above 0: surface fatigue
    [EkbergKaboAndersson2002]."""
    return _number(
        "surface_fatigue_index", a=a, b=b, load=load, utilised_friction=utilised_friction,
        cyclic_shear_yield=cyclic_shear_yield,
    )


def subsurface_fatigue_index(
    a: float, b: float, load: float, utilised_friction: float, dang_van_constant: float,
    residual_hydrostatic: float = 0.0,
) -> float:
    """FI_sub = F_z (1 + mu²)/(4 pi a b) + c sigma_h, Pa [EkbergKaboAndersson2002]."""
    return _number(
        "subsurface_fatigue_index", a=a, b=b, load=load, utilised_friction=utilised_friction,
        dang_van_constant=dang_van_constant, residual_hydrostatic=residual_hydrostatic,
    )


def usfd_rate(t_gamma_per_area: float) -> float:
    """kg lost per m rolled and m² of surface, from |q·s|/V in Pa [LewisDwyerJoyce2004]; 1 µg/(m mm²) is 1e-3."""
    return _number("usfd_rate", t_gamma_per_area=t_gamma_per_area)


def usfd_depth(
    q_x: Any, q_y: Any, slip_x: Any, slip_y: Any, dx: float, speed: float, density: float = 7800.0
) -> float:
    """m worn off a streamline per passage: tractions [Pa] and slip [m/s] of its cells of length dx [m]."""
    rows = {"q_x": q_x, "q_y": q_y, "slip_x": slip_x, "slip_y": slip_y}
    return _number("usfd_depth", **_rows(rows), dx=dx, speed=speed, density=density)


def archard_depth(
    p: Any, slip_x: Any, slip_y: Any, dx: float, speed: float, hardness: float, scale: float = 1.0
) -> float:
    """m worn off a streamline per passage by Archard's law with Jendel's map of dry laboratory surfaces [Jendel2002].

    hardness: Pa (9.80665e6 HV). scale: multiplies every coefficient, for lubrication.
    """
    rows = {"p": p, "slip_x": slip_x, "slip_y": slip_y}
    return _number("archard_depth", **_rows(rows), dx=dx, speed=speed, hardness=hardness, scale=scale)


def dang_van(cycle: Any, c: float, residual: Sequence[float] = _NO_STRESS) -> DangVan:
    """The largest tau_a + c sigma_h over a cycle [DangVan1993].

    cycle: (samples, 6) stresses of one point, Pa, components xx, yy, zz, xy, yz, xz, as `Body.at` gives them.
    """
    return DangVan(*_value("dang_van", cycle=_bridge.numbers(cycle), c=c, residual=tuple(residual)))


def critical_plane(
    cycle: Any, young: float, poisson: float, *, fatemi_socie: Optional[tuple[float, float]] = None,
    jiang_sehitoglu: Optional[float] = None, residual: Sequence[float] = _NO_STRESS,
) -> Planes:
    """Smith-Watson-Topper, Fatemi-Socie and Jiang-Sehitoglu on the plane where each is largest.

    cycle: as in `dang_van`. fatemi_socie: (k, yield strength [Pa]); jiang_sehitoglu: J.
    """
    found = _value(
        "critical_plane", cycle=_bridge.numbers(cycle), young=young, poisson=poisson, fatemi_socie=fatemi_socie,
        jiang_sehitoglu=jiang_sehitoglu, residual=tuple(residual),
    )
    first, *others = (None if plane is None else _plane(*plane) for plane in found)
    assert first is not None  # of constants that every call gives
    return Planes(first, *others)


def critical_flaw(toughness: float, sigma_1: float) -> float:
    """m, depth of the edge crack that runs under a stress [Pa] at a toughness [Pa √m]; infinite without tension."""
    return _number("critical_flaw", toughness=toughness, sigma_1=sigma_1)


def grade(name: str) -> dict[str, Any]:
    """Strengths of a steel by its name ("R260"): (low, high) in Pa and HBW, None where nothing is known."""
    found = _value("grade", name=name)
    return {key: tuple(value) if isinstance(value, list) else value for key, value in found.items()}
