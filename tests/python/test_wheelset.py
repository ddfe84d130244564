"""rs.Wheelset: states of two wheels on one axle."""
import copy

import numpy as np
import pytest

import railstrata as rs


@pytest.fixture(scope="module", params=[("LMA", "CN60"), ("S1002", "UIC60")], ids=lambda pair: pair[0])
def wheelset(request):
    wheel, rail = request.param
    case = rs.Case("cases/quick").with_({"geometry.wheel_profile": wheel, "geometry.rail_profile": rail})
    return rs.Wheelset(case, "1 mm", threads=1)


def test_a_wheelset_bears_its_load_and_roll_moment(wheelset):
    forces = wheelset.solve(speed=20, load=160e3, y=2e-3, yaw=1e-3, roll_moment=20e3)
    assert forces.force[2] == pytest.approx(160e3, rel=1e-4) and forces.moment[0] == pytest.approx(-20e3, rel=1e-3)
    assert np.allclose(np.add(forces.left.force, forces.right.force), forces.force, rtol=1e-12)
    assert forces.left.point[1] > 0.7 > -0.7 > forces.right.point[1] and forces.left.ok and forces.right.ok
    again = wheelset.solve(speed=20, z=forces.z, roll=forces.roll, y=2e-3, yaw=1e-3)
    assert again.left.force[2] == pytest.approx(forces.left.force[2], rel=1e-4)


def test_mirror_images_have_mirrored_forces(wheelset):
    one = wheelset.solve(speed=20, load=160e3, y=1e-3, rail_y=(0.2e-3, 0))
    other = wheelset.solve(speed=20, load=160e3, y=-1e-3, rail_y=(0, -0.2e-3))
    assert other.force[1] == pytest.approx(-one.force[1], rel=1e-3)
    assert other.right.p_max == pytest.approx(one.left.p_max, rel=1e-3)


def test_a_wheelset_may_stand_roll_back_and_have_no_load(wheelset):
    on = wheelset.solve(speed=20, load=160e3, y=1e-3, wheel_pitch_rate=(0.05, 0), rail_yaw=(1e-3, 0))
    back = wheelset.solve(speed=-20, load=160e3, y=-1e-3, wheel_pitch_rate=(0, -0.05), rail_yaw=(0, 1e-3))
    assert back.force == pytest.approx((-on.force[0], -on.force[1], on.force[2]), abs=2)
    assert wheelset.solve(speed=0, load=160e3).force[2] == pytest.approx(160e3, rel=1e-4)
    assert wheelset.solve(speed=20, load=0).force == (0, 0, 0)


def test_a_wheel_that_is_pressed_too_far_is_marked(wheelset):
    forces = wheelset.solve(speed=20, load=160e3)
    assert forces.beyond == 0 and not forces.left.beyond
    with pytest.warns(rs.CheckWarning, match="left wheel: check half_spaces fails"):
        forces = wheelset.solve(speed=20, z=forces.z - 4e-3, roll=forces.roll)
    assert forces.beyond == 2 and forces.left.beyond and not forces.left.ok and forces.left.force[2] > 1e6


def test_patches_add_up_to_their_wheel_and_copies_go_on(wheelset):
    forces = wheelset.solve(speed=-20, load=160e3, y=2e-3)
    patches = wheelset.patches("right")
    assert len(patches) == forces.right.patches
    assert np.sum([p.force for p in patches], axis=0) == pytest.approx(forces.right.force, abs=1e-6)
    assert np.sum([p.moment for p in patches], axis=0) == pytest.approx(forces.right.moment, abs=1e-6)
    about = wheelset.patches("right", about=patches[0].point)[0]
    assert abs(about.moment[0]) < 100 and about.force == patches[0].force
    assert isinstance(forces.remarks, tuple)
    axles = [wheelset.copy(), wheelset.copy()]
    states = [{"speed": 20, "load": 160e3, "y": y, "rail_y": (0, 1e-4)} for y in (1e-3, -1e-3)]
    many = rs.solve_many(axles, states, threads=2)
    assert many == [wheelset.copy().solve(**state) for state in states]
    with pytest.raises(ValueError, match="left"):
        wheelset.patches("middle")
    with pytest.raises(TypeError, match="speed is missing"):
        rs.solve_many(axles[:1], [{"load": 160e3}])
    with pytest.raises(rs.CaseError, match="there is no solution"):
        rs.Wheelset("cases/quick", "1 mm").patches("left")


def test_fields_and_stresses_are_those_of_a_side_s_contact(wheelset):
    forces = wheelset.solve(speed=20, load=160e3, y=2e-3, yaw=1e-3)
    contact = wheelset.contact("right")
    patch = contact.patch()
    assert np.sum(patch.p * patch.area) == pytest.approx(forces.right.normal_force, rel=1e-9)
    assert patch.p.max() == pytest.approx(forces.right.p_max, rel=0.01)  # which lies between cells
    assert contact.stresses([[0, 0, 3e-3]])[0, 2] < -100e6
    wheelset.solve(speed=20, load=120e3)
    assert contact.patch().p.max() == patch.p.max()
    with pytest.raises(ValueError, match="left"):
        wheelset.contact("middle")


def test_trial_steps_leave_no_trace(wheelset):
    wheelset.solve(speed=20, load=160e3)
    wheelset.keep()
    first = wheelset.solve(speed=20, load=160e3, y=1e-3)
    wheelset.solve(speed=20, load=160e3, y=-2e-3)
    wheelset.reset()
    assert wheelset.solve(speed=20, load=160e3, y=1e-3) == first


def test_the_right_wheel_may_differ_and_a_copy_is_made_anew():
    softer = rs.Wheelset("cases/quick", "1 mm", right={"layer.0.young_ratio": 1.0}, threads=1)
    forces = softer.solve(speed=20, load=160e3)
    assert forces.left.p_max > 1.02 * forces.right.p_max
    assert copy.deepcopy(softer).solve(speed=20, load=160e3) == forces
    assert "cell 1 mm" in repr(softer)


def test_mistakes_have_a_reason(wheelset):
    with pytest.raises(rs.CaseError, match="z and roll"):
        wheelset.solve(speed=20)
    with pytest.raises(rs.CaseError, match="tips"):
        wheelset.solve(speed=20, load=160e3, roll_moment=1e6)
    with pytest.raises(ValueError, match="rail_y"):
        wheelset.solve(speed=20, load=160e3, rail_y=(1e-3,))
    with pytest.raises(TypeError, match="load"):
        wheelset.solve(speed=20, load="160 kN")
    with pytest.raises(rs.CaseError):
        rs.Wheelset("cases/quick", right={"geometry.rail_profile": "no such profile"})


def test_a_jacobian_keeps_what_is_given(wheelset):
    wheelset.solve(speed=20, load=160e3, y=2e-3)
    slopes = wheelset.jacobian("y", "load", "rail_y[1]")
    assert slopes["load"].force[2] == pytest.approx(1)
    assert slopes["y"].force[2] == pytest.approx(0, abs=1e-6 * abs(slopes["y"].force[1]))
    assert slopes["y"].left_force[1] + slopes["y"].right_force[1] == pytest.approx(slopes["y"].force[1])
    for wrong, said in (("z", "is a result"), ("rail_y", "no number"), ("speeed", "no number")):
        with pytest.raises(rs.CaseError, match=said):
            wheelset.jacobian(wrong)
