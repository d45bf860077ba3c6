"""The inverse kinematics: branches stand at their poses, and what does not fit is refused."""

import numpy
import pytest

import stiffarm


@pytest.mark.parametrize("name", ["kuka_kr240", "ur10", "panda", "iiwa14", "stanford", "bicchi_3r"])
def test_branches_stand_at_their_poses(name):
    arm = stiffarm.Arm.load(name)
    q = numpy.random.default_rng(1).uniform(-1.5, 1.5, (40, arm.dof))
    poses = arm.pose(q)
    found = arm.inverse_kinematics(poses, near=q)
    count = found.q.shape[1]
    assert found.q.shape == (40, count, arm.dof) and count == 2 ** len(found.bits)
    assert found.distance.shape == found.angle.shape == found.within_limits.shape == (40, count)
    again = arm.pose(found.q)
    met = (found.distance < 1e-9) & (found.angle < 1e-9)
    assert met.any(axis=1).all()
    assert numpy.abs(again - poses[:, None])[met].max() < 1e-8
    assert numpy.abs(found.q - q[:, None]).max(axis=2).min(axis=1).max() < 1e-5
    one = arm.inverse_kinematics(poses[0], q[0])
    assert one.q.shape == (count, arm.dof) and (one.q == found.q[0]).all()


def test_the_nearest_is_within_the_limits():
    arm = stiffarm.Arm.load("kuka_kr240")
    low, high = numpy.array(arm.limits).T
    q = numpy.random.default_rng(2).uniform(low, high, (30, 6))
    found = arm.inverse_kinematics(arm.pose(q), near=q)
    assert numpy.abs(found.nearest(q) - q).max() < 1e-6
    assert found.bits == ["shoulder", "elbow", "wrist"]
    far = numpy.eye(4)
    far[:3, 3] = 50.0
    assert numpy.isnan(arm.inverse_kinematics(far).nearest(q[0])).all()


def test_of_seven_joints_one_is_given():
    arm = stiffarm.Arm.load("panda")
    q = numpy.array([0.1, 0.2, 0.3, -1.5, 0.2, 1.6, 0.4])
    with pytest.raises(ValueError, match="every branch has joint 7"):
        arm.inverse_kinematics(arm.pose(q))
    for last in (0.4, 0.9):
        q[6] = last
        assert (arm.inverse_kinematics(arm.pose(q), near=q).q[:, 6] == last).all()


def test_the_elbow_stands_at_its_angle():
    arm = stiffarm.Arm.load("iiwa14")
    q = numpy.array([0.3, 0.7, -0.2, 1.1, 0.4, 0.9, 0.1])
    pose = arm.pose(q)
    same = arm.inverse_kinematics(pose, near=q, given="elbow_angle")
    assert numpy.abs(same.nearest(q) - q).max() < 1e-9
    for angle in (-0.4, 0.7):
        other = arm.inverse_kinematics(pose, near=q, elbow_angle=angle)
        assert other.reached().any() and numpy.abs(arm.pose(other.q) - pose).max() < 1e-9
        again = arm.inverse_kinematics(pose, near=other.nearest(q), given="elbow_angle")
        assert numpy.abs(again.nearest(q) - other.nearest(q)).max() < 1e-9
    with pytest.raises(ValueError, match="every branch has the elbow angle"):
        arm.inverse_kinematics(pose, given="elbow_angle")
    with pytest.raises(ValueError, match="axes 5, 6, 7 do not meet"):
        stiffarm.Arm.load("panda").inverse_kinematics(pose, elbow_angle=0.1)


def test_a_joint_is_given_and_the_others_are_searched():
    arm = stiffarm.Arm.load("panda")
    q = numpy.array([0.1, 0.2, 0.3, -1.5, 0.2, 1.6, 0.4])
    found = arm.inverse_kinematics(arm.pose(q), near=q, given=3)
    assert found.q.shape == (16, 7) and found.bits == []
    assert (found.q[:, 2] == q[2]).all() and numpy.abs(found.nearest(q) - q).max() < 1e-9


def test_a_load_moves_the_set_points():
    arm = stiffarm.Arm.load("kuka_kr240")
    q = numpy.array([0.1, 0.9, -1.2, 0.4, 0.8, 0.0])
    load = [0.0, 0.0, -2000.0, 0.0, 0.0, 0.0]
    free, loaded = (arm.inverse_kinematics(arm.pose(q), near=q, wrench=each).nearest(q) for each in (None, load))
    assert 1e-4 < numpy.abs(loaded - free).max() < 1e-2


def test_what_does_not_fit_is_refused():
    arm = stiffarm.Arm.load("ur10")
    with pytest.raises(ValueError, match=r"pose: found the shape \(3, 4\)"):
        arm.inverse_kinematics(numpy.eye(4)[:3])
    with pytest.raises(ValueError, match="near: found a batch"):
        arm.inverse_kinematics(numpy.eye(4), numpy.zeros((2, 6)))
    with pytest.raises(ValueError, match="not finite"):
        arm.inverse_kinematics(numpy.full((4, 4), numpy.nan))
    with pytest.raises(ValueError, match="no closed form"):
        stiffarm.Arm.load("bicchi_5r").inverse_kinematics(numpy.eye(4))
