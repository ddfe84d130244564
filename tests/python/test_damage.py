"""rs.damage: indices for numbers of one's own, by the program's functions."""
import inspect
import math

import numpy as np
import pytest

import railstrata as rs


@pytest.fixture(scope="module")
def result():
    """A result whose case gives strengths."""
    return rs.bem(rs.Case("cases/quick", {"material.rail.grade": "R260"}), cell=0.5e-3)


def test_every_function_has_a_docstring_and_types():
    functions = {name: f for name, f in vars(rs.damage).items()
                 if inspect.isfunction(f) and f.__module__ == rs.damage.__name__
                 and not name.startswith("_")}
    assert len(functions) == 12
    for name, function in functions.items():
        assert inspect.getdoc(function), name
        assert all(p.annotation is not p.empty for p in inspect.signature(function).parameters.values()), name


def test_indices_of_a_patch_are_those_of_the_summary(result):
    """The same functions: to the bit of one T-gamma. Forces of the summary are sums in another order."""
    contact, found = result.summary["contact"], result.damage
    t = rs.damage.t_gamma(contact["F_x_N"], contact["lateral_force_N"], contact["creepage_x"], contact["creepage_y"],
                          contact["spin_moment_N_m"], contact["spin_per_m"])
    assert t.without_spin == pytest.approx(found["t_gamma_N"], rel=1e-12)
    assert t.with_spin == pytest.approx(found["t_gamma_with_spin_N"], rel=1e-12)
    assert rs.damage.rcf_damage(found["t_gamma_N"]) == found["rcf_damage"]
    radius = 0.43  # geometry.wheel_radius by default
    assert rs.damage.brr_wear(found["t_gamma_N"], 2 * radius) == found["brr_wear_m"]


def test_damage_functions_have_their_published_points():
    assert rs.damage.rcf_damage(40) == pytest.approx(5e-6, rel=1e-12)
    assert rs.damage.rcf_damage(40, "20") == pytest.approx(1e-5 * 20 / 45, rel=1e-12)
    assert rs.damage.rcf_damage(230, "15 clipped") == 0 > rs.damage.rcf_damage(230)
    assert rs.damage.rcf_damage(50, [(0, 0), (100, 1e-5)]) == pytest.approx(5e-6, rel=1e-12)
    with pytest.raises(rs.CaseError):
        rs.damage.rcf_damage(50, [(100, 0), (0, 1e-5)])
    with pytest.raises(ValueError):
        rs.damage.rcf_damage(50, "16")


def test_wear_of_uniform_cells():
    """Mild wear at 5 N/mm² over 12.8 mm: 43.5 nm [LewisDwyerJoyce2004]."""
    ones, speed = np.ones(64), 30.0
    depth = rs.damage.usfd_depth(100e6 * ones, 0 * ones, 0.05 * speed * ones, 0 * ones, 0.2e-3, speed)
    assert depth == pytest.approx(43.5e-9, rel=1e-3)
    assert rs.damage.usfd_rate(5e6) == pytest.approx(26.5e-3, rel=1e-12)
    archard = rs.damage.archard_depth(800e6 * ones, 0.1 * ones, 0 * ones, 0.2e-3, speed, 2.7e9)
    assert archard == pytest.approx(5e-4 * 800e6 * 0.1 * 12.8e-3 / speed / 2.7e9, rel=1e-12)
    with pytest.raises(ValueError):
        rs.damage.usfd_depth(ones, ones, ones, ones[1:], 1e-3, speed)


def test_fatigue_of_closed_forms():
    """Alternating torsion and tension."""
    phase = np.linspace(0, 2 * np.pi, 73)
    torsion, tension = np.zeros((73, 6)), np.zeros((73, 6))
    torsion[:, 3] = 100e6 * np.sin(phase)
    tension[:, 0] = 100e6 * np.sin(phase)
    assert rs.damage.dang_van(torsion, 0.3).stress == pytest.approx(100e6, rel=1e-9)
    assert rs.damage.dang_van(tension, 0.3).stress == pytest.approx(100e6 * (0.5 + 0.3 / 3), rel=1e-9)
    planes = rs.damage.critical_plane(tension, 207e9, 0.3)
    assert planes.smith_watson_topper.value == pytest.approx(100e6**2 / 207e9, rel=2e-4)
    assert abs(planes.smith_watson_topper.normal[0]) == pytest.approx(1, abs=1e-3)
    assert planes.fatemi_socie is None and planes.jiang_sehitoglu is None
    assert rs.damage.critical_plane(tension, 207e9, 0.3, jiang_sehitoglu=0.0).jiang_sehitoglu.value == pytest.approx(
        planes.smith_watson_topper.value, rel=1e-9)
    assert rs.damage.critical_flaw(15e6, 870e6) == pytest.approx(75e-6, rel=0.01)


def test_grades_have_their_standard_minimum():
    r260 = rs.damage.grade("r260")
    assert r260["use"] == "rail" and r260["tensile_strength"][0] == 880e6
    with pytest.raises(rs.CaseError):
        rs.damage.grade("R261")


def test_a_gap_in_the_numbers_is_refused_and_never_a_number():
    damage = rs.damage
    gap, cycle = math.nan, [[1e8, 0, 0, 0, 0, 0], [math.nan, 0, 0, 0, 0, 0], [-1e8, 0, 0, 0, 0, 0]]
    for call in (
        lambda: damage.usfd_rate(gap), lambda: damage.critical_flaw(50e6, gap), lambda: damage.dang_van(cycle, 0.3),
        lambda: damage.usfd_depth([1e8, gap, 1e8], [0] * 3, [0.01] * 3, [0] * 3, 1e-3, 20),
        lambda: damage.archard_depth([1e9] * 3, [0.01, gap, 0.01], [0] * 3, 1e-3, 20, 3e9),
        lambda: damage.critical_plane(cycle, 210e9, 0.3), lambda: damage.brr_wear(gap, 0.92),
    ):
        with pytest.raises(ValueError, match="a number is missing"):
            call()
    with pytest.raises(ValueError, match="below 0"):
        damage.brr_wear(-10, 0.92)
