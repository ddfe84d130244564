"""rs.Contact and rs.open_table: states one after another, creep-force tables."""
import copy
import math
import os
import pickle
import signal
import subprocess
import threading
import time

import numpy as np
import pytest

import railstrata as rs

CELL = 1e-3


@pytest.fixture(scope="module", params=[("LMA", "CN60"), ("S1002", "UIC60")], ids=lambda pair: pair[0])
def case(request):
    wheel, rail = request.param
    return rs.Case("cases/quick").with_({"geometry.wheel_profile": wheel, "geometry.rail_profile": rail})


@pytest.fixture(scope="module")
def contact(case):
    return rs.Contact(case, CELL, threads=1)


def test_a_new_contact_has_the_bits_of_a_single_solution(case, contact):
    single = rs.bem(case, CELL, stresses=False)
    contact.forget()
    forces = contact.solve()
    assert forces.force == single.force and forces.p_max == single.p_max and forces.patch_area == single.patch_area
    assert forces.slip_area == single.slip_area and forces.ok and list(forces.remarks) == single.notes
    assert (contact.patch().p == single.patch.p).all() and (contact.patch().state == single.patch.state).all()
    assert contact.patch().shape == single.patch.shape and len(contact.patch().to_dataframe()) == single.patch.p.size
    points = [[0, 0, 1e-3], [1e-3, 0, 2e-3]]
    assert (contact.stresses(points) == single.rail.at(points)).all()
    assert (contact.stresses(points, "wheel") == single.wheel.at(points)).all()


def test_states_are_those_of_changed_cases(case, contact):
    """To the solver's tolerance: a solution starts from the one before."""
    state = {"lateral_shift": 1e-3, "load": 70e3, "creepage_x": -0.001, "friction": 0.3}
    changes = {"geometry.lateral_shift": 1e-3, "vehicle.wheel_load": 70e3, "drive.creepage": -0.001,
               "drive.friction_coefficient": 0.3}
    contact.solve()
    stepped, single = contact.solve(**state), rs.bem(case.with_(changes), CELL, stresses=False)
    assert stepped.force == pytest.approx(single.force, rel=1e-4, abs=1)
    assert stepped.p_max == pytest.approx(single.p_max, rel=1e-4)
    assert contact.solve().p_max == pytest.approx(rs.bem(case, CELL, stresses=False).p_max, rel=1e-4), \
        "what a call changes holds for that call"
    sprung = contact.solve(approach=0.1e-3, yaw=0.002, roll=0.0, speed=10.0, creepage_x=0, creepage_y=0.001, spin=0)
    assert sprung.approach == pytest.approx(0.1e-3, rel=1e-6) and sprung.creepage_y == 0.001
    held = contact.solve(force_x=5e3, force_y=0.0)
    assert held.force[0] == pytest.approx(5e3, rel=1e-2)


def test_what_is_given_wrongly_is_told_in_the_words_of_the_call(contact):
    for wrong, kind, words in (
        ({"load": 80e3, "approach": 1e-4}, rs.CaseError, "one of load and approach"),
        ({"lateral_shift": 5.0}, rs.CaseError, "^geometry.lateral_shift: lateral_shift = 5 is out of range"),
        ({"load": -1.0}, rs.CaseError, "load = -1 is no force"),
        ({"load": "80 kN"}, TypeError, "load: a number in SI"),
        ({"spin": math.nan}, ValueError, "spin: a finite number"),
    ):
        with pytest.raises(kind, match=words) as caught:
            contact.solve(**wrong)
        assert "rs_" not in str(caught.value) and "RS_" not in str(caught.value)
    with pytest.raises(rs.CaseError, match="there is no solution.*\n.*solve a state first"):
        contact.patch()
    contact.solve()
    with pytest.raises(rs.CaseError, match="no patch 7"):
        contact.patch(7)
    with pytest.raises(ValueError, match="rail"):
        contact.stresses([[0, 0, 1e-3]], "sleeper")
    with pytest.raises(ValueError, match="shape"):
        contact.stresses([[0, 0]])
    with pytest.raises(rs.CaseError, match="cell"):
        rs.Contact("cases/quick", 1.0)
    with pytest.raises(rs.CaseError, match="transient"):
        rs.Contact("cases/transient/fretting.toml")


def test_a_jacobian_has_the_slopes_of_new_solutions(case):
    contact = rs.Contact(case, CELL, threads=1)
    contact.set_tolerance(1e-9)
    state = {"load": 80e3, "creepage_x": -0.0005, "yaw": 1e-3}
    contact.solve(**state)
    slopes = contact.jacobian("load", "yaw")
    assert list(slopes) == ["load", "yaw"] and slopes["load"].force[2] == pytest.approx(1, rel=1e-4)
    more, less = (contact.solve(**{**state, "load": load}) for load in (80.1e3, 79.9e3))
    assert slopes["load"].force[0] == pytest.approx((more.force[0] - less.force[0]) / 200, rel=1e-3)
    contact.solve(**state)
    with pytest.raises(ValueError, match="speeed is no input"):
        contact.jacobian("speeed")
    with pytest.raises(rs.CaseError, match="approach is a result"):
        contact.jacobian("approach")
    with pytest.raises(rs.CaseError, match="tolerance"):
        contact.set_tolerance(1.0)


def test_a_profile_from_an_array_takes_the_place_of_the_cases(case):
    contact, wheelset = rs.Contact(case, CELL, threads=1), rs.Wheelset(case, CELL, threads=1)
    before, both = contact.solve(), wheelset.solve(speed=20, load=160e3)
    y, depth = np.linspace(-34e-3, 34e-3, 137), np.arange(30e-3, 3e-3, -1e-3)
    sides = np.column_stack([34e-3 + 0.05 * depth, -depth])
    top = np.column_stack([y, np.sqrt(0.2**2 - y**2) - 0.2])
    round_rail = np.concatenate([sides * (-1, 1), top, sides[::-1]])
    contact.set_profile("rail", round_rail)
    with pytest.warns(rs.CheckWarning, match="cell_of_patch"):
        assert contact.solve().p_max != pytest.approx(before.p_max, rel=0.02)
    wheelset.set_profile("left", "rail", round_rail)
    one = wheelset.solve(speed=20, load=160e3, roll=both.roll)
    assert one.left.p_max != pytest.approx(both.left.p_max, rel=0.02)
    for wrong in (lambda: contact.set_profile("sleeper", round_rail), lambda: contact.set_profile("rail", [1, 2]),
                  lambda: wheelset.set_profile("middle", "rail", round_rail)):
        with pytest.raises(ValueError):
            wrong()


def test_copies_go_on_with_the_same_bits_and_many_are_solved_at_once(case):
    contact = rs.Contact(case, CELL, threads=1)
    contact.solve(load=80e3)
    copies = [contact.copy() for _ in range(3)]
    states = [{"load": load} for load in (81e3, 82e3, 83e3)]
    alone = [contact.copy().solve(**state) for state in states]
    assert rs.solve_many(copies, states, threads=2) == alone
    states[1] = {"load": -1.0}
    with pytest.raises(rs.CaseError, match="load = -1"):
        rs.solve_many(copies, states)
    found = rs.solve_many(copies, states, return_exceptions=True)
    assert isinstance(found[1], rs.CaseError) and found[0].ok and found[2].ok
    with pytest.raises(rs.CaseError, match="handles 0 and 1 are the same"):
        rs.solve_many([contact, contact], states[:2])
    with pytest.raises(ValueError, match="as many"):
        rs.solve_many(copies, states[:1])
    with pytest.raises(TypeError, match="lode is no keyword of Contact.solve"):
        rs.solve_many(copies[:1], [{"lode": 1.0}])
    with pytest.raises(TypeError, match="wheelsets alone"):
        rs.solve_many([contact, rs.Wheelset(case, CELL)], states[:2])
    assert rs.solve_many([], []) == []


def test_a_contact_is_made_anew_from_a_pickle(contact):
    again = pickle.loads(pickle.dumps(contact))
    contact.forget()
    assert again.case == contact.case and again.solve() == contact.solve() == copy.deepcopy(contact).solve()


def test_threads_of_python_may_share_a_contact(contact):
    found = []

    def solve():
        found.extend(contact.solve(lateral_shift=y).p_max for y in (0.0, 1e-3))

    together = [threading.Thread(target=solve) for _ in range(2)]
    for one in together:
        one.start()
    for one in together:
        one.join()
    assert len(found) == 4 and all(p > 1e8 for p in found)


def test_ctrl_c_stops_a_state_soon():
    fine, pressed = rs.Contact("cases/quick", 0.03e-3), []

    def press():
        pressed.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    threading.Timer(1.0, press).start()
    with pytest.raises(KeyboardInterrupt):
        fine.solve()
    assert time.monotonic() - pressed[0] < 5  # a loaded machine; 0.1 s on a free one


@pytest.fixture(scope="module")
def table(program, tmp_path_factory):
    out = tmp_path_factory.mktemp("table") / "out"
    subprocess.run([program, "creep", rs.shipped_data() / "cases/quick", "--axis", "creepage_x=-0.002:0.002:3",
                    "--axis", "lateral_shift=0:1 mm:2", "--cell", "1 mm", "--out", out], check=True,
                   capture_output=True)
    return rs.open_table(out / "creep_table.h5")


def test_a_creep_table_has_its_axes_numbers_and_units(table):
    assert list(table.axes) == ["creepage_x", "lateral_shift"]
    assert table.axes["lateral_shift"] == pytest.approx([0, 1e-3], abs=1e-15)
    assert table.units["lateral_shift"] == "m" and table.units["force_x"] == "N" and table.units["creepage_x"] == ""
    assert table.numbers["force_x"].shape == (3, 2) and not table.numbers["force_x"].flags.writeable
    data = table.to_xarray()
    assert data.force_x.dims == ("creepage_x", "lateral_shift") and data.force_x.attrs["units"] == "N"
    place = {"creepage_x": 0, "lateral_shift": 0}
    assert pickle.loads(pickle.dumps(table)).at(**place) == table.at(**place)


def test_a_creep_table_is_linear_between_its_points(table):
    force = table.numbers["force_x"]
    assert table.at(creepage_x=-0.002, lateral_shift=1e-3)["force_x"] == force[0, 1]
    assert table.at({"creepage_x": -0.001}, lateral_shift=0)["force_x"] == pytest.approx(force[:2, 0].mean(), rel=1e-12)
    many = table.at(creepage_x=np.linspace(-0.002, 0.002, 5)[:, None], lateral_shift=[0, 1e-3])["force_x"]
    assert many.shape == (5, 2) and (many[::2] == force).all()
    with pytest.raises(rs.CaseError, match="creepage_x = -0.5 lies beyond its axis, -0.002 to 0.002; .*clamp=True"):
        table.at(creepage_x=[-0.5, 0.0], lateral_shift=0)
    with pytest.raises(rs.CaseError, match="lateral_shift = 0.002 lies beyond its axis, 0 to 0.001 m"):
        table.at(creepage_x=0, lateral_shift=2e-3)
    assert table.at(creepage_x=-0.5, lateral_shift=0, clamp=True)["force_x"] == force[0, 0]
    assert table.at(creepage_x=-0.002, lateral_shift=1e-3 * (1 + 1e-12))["force_x"] == force[0, 1], "round-off"


def test_a_scaled_creep_table_is_asked_as_a_plain_one_is(program, tmp_path):
    subprocess.run([program, "creep", rs.shipped_data() / "cases/quick", "--axis", "creepage_x=-0.002,0.002",
                    "--axis", "creepage_y=-0.002,0.002", "--axis", "spin=-0.2,0.2 1/m", "--scaled", "4:5:4", "--cell",
                    "2 mm", "--places", "0", "--out", tmp_path / "out"], check=True, capture_output=True)
    table = rs.open_table(tmp_path / "out/creep_table.h5")
    assert list(table.axes) == ["creepage_x", "creepage_y", "spin"] and table.axes["spin"] == pytest.approx([-0.2, 0.2])
    assert list(table.grid) == ["creepage_angle", "spin_share", "creepage_size"]
    assert table.numbers["force_x"].shape == (4, 5, 4)
    forces = table.at(creepage_x=[-0.001, 0.001], creepage_y=0, spin=0)["force_x"]
    assert forces[0] > 1000 and forces[1] < -1000


def test_a_creep_table_refuses_what_is_none(table, tmp_path):
    with pytest.raises(TypeError, match="no lateral_shift; the axes are creepage_x, lateral_shift"):
        table.at(creepage_x=0)
    with pytest.raises(TypeError, match="yaw is no axis"):
        table.at(creepage_x=0, lateral_shift=0, yaw=0)
    with pytest.raises(ValueError, match="creepage_x: not a number"):
        table.at(creepage_x=math.nan, lateral_shift=0)
    with pytest.raises(ValueError):
        table.at(creepage_x=[0, 1, 2], lateral_shift=[0, 1])
    with pytest.raises(rs.CaseError, match="no such file"):
        rs.open_table(tmp_path / "none.h5")
    with pytest.raises(TypeError, match="a file is wanted"):
        rs.open_table(3)
