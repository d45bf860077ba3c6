"""Arms of other packages' models, against these packages."""

import numpy
import pytest
import stiffarm

RANDOM = numpy.random.default_rng(11)
#: Products of a dozen rotations and of lengths of a metre, each rounded a few times.
ROUNDING = 200 * 2.3e-16


def test_pinocchio(repository):
    pinocchio = pytest.importorskip("pinocchio")
    for name, tip in (("ur5", "tool0"), ("panda", None)):
        model = pinocchio.buildModelFromUrdf(str(repository / f"tests/data/urdf/{name}.urdf"))
        tip = tip or model.frames[model.nframes - 1].name
        chain = [joint for joint in chain_of(model, tip)]
        arm = stiffarm.Arm.from_pinocchio(model, tip=tip)
        assert arm.dof == len(chain)
        data = model.createData()
        for _ in range(20):
            q = pinocchio.randomConfiguration(model, numpy.full(model.nq, -1.0), numpy.full(model.nq, 1.0))
            joints = numpy.array([value_of(model, joint, q) for joint in chain])
            pinocchio.framesForwardKinematics(model, data, q)
            want = data.oMf[model.getFrameId(tip)].homogeneous
            assert numpy.abs(arm.pose(joints) - want).max() < ROUNDING * 10
            frame = model.getFrameId(tip)
            mixed = pinocchio.computeFrameJacobian(model, data, q, frame, pinocchio.LOCAL_WORLD_ALIGNED)
            columns = [model.joints[joint].idx_v for joint in chain]
            assert numpy.abs(arm.jacobian(joints) - mixed[:, columns]).max() < ROUNDING * 10
    with pytest.raises(ValueError, match="found no frame"):
        stiffarm.Arm.from_pinocchio(model, tip="elbow room")


def chain_of(model, tip):
    joint, chain = model.frames[model.getFrameId(tip)].parentJoint, []
    while joint:
        chain.insert(0, joint)
        joint = model.parents[joint]
    return chain


def value_of(model, joint, q):
    first = model.joints[joint].idx_q
    return numpy.arctan2(q[first + 1], q[first]) if model.joints[joint].nq == 2 else q[first]


def test_pinocchio_dynamics(repository):
    pinocchio = pytest.importorskip("pinocchio")
    model = pinocchio.buildSampleModelManipulator()
    arm = stiffarm.Arm.from_pinocchio(model)
    data = model.createData()
    assert "inertia" in arm.toml
    for _ in range(10):
        q, qd, qdd = RANDOM.uniform(-1.0, 1.0, (3, model.nv))
        want = pinocchio.rnea(model, data, q, qd, qdd)
        assert numpy.abs(arm.inverse_dynamics(q, qd, qdd) - want).max() < 1e-12 * max(1.0, numpy.abs(want).max())


ARM = """
<mujoco model="bench"><compiler angle="radian"/><worldbody>
  <body name="shoulder" pos="0.1 0 0.3" quat="0.9 0.1 0.2 -0.3">
    <joint name="j1" type="hinge" axis="0 0 1" pos="0 0.02 0" range="-2 2" limited="true" stiffness="1e5"
           damping="12" frictionloss="3" armature="0.4"/>
    <geom type="capsule" size="0.05 0.1" mass="8"/>
    <body name="riser" pos="0 0 0.1"><geom type="sphere" size="0.02" mass="1"/>
      <body name="upper" pos="0.05 0 0.2"><joint name="j2" type="hinge" axis="0 1 0" stiffness="5e4"/>
        <geom type="capsule" size="0.04 0.2" pos="0.2 0 0" mass="4"/>
        <body name="slide" pos="0.5 0 0"><joint name="j3" type="slide" axis="1 0 0" range="0 0.3" limited="true"/>
          <geom type="box" size="0.05 0.03 0.03" mass="2"/>
          <site name="tcp" pos="0.1 0 0.02" quat="0.7 0 0.7 0"/>
        </body></body></body></body>
</worldbody></mujoco>
"""


def mujoco_pose(mujoco, spec, q):
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qpos[:] = q
    mujoco.mj_kinematics(model, data)
    site = model.site("tcp").id
    pose = numpy.eye(4)
    pose[:3, :3], pose[:3, 3] = data.site_xmat[site].reshape(3, 3), data.site_xpos[site]
    return pose


def test_mujoco():
    mujoco = pytest.importorskip("mujoco")
    spec = mujoco.MjSpec.from_string(ARM)
    arm = stiffarm.Arm.from_mujoco(spec, tip="tcp")
    assert arm.joint_types == ["revolute", "revolute", "prismatic"]
    assert arm.limits[0] == [-2.0, 2.0]
    for _ in range(20):
        q = RANDOM.uniform(-1.0, 1.0, 3)
        assert numpy.abs(arm.pose(q) - mujoco_pose(mujoco, spec, q)).max() < 10 * ROUNDING
    # Springs: 1e5 N·m/rad and 5e4 N·m/rad, by the compliance of the first two joints.
    jacobian, q = arm.jacobian([0.2, 0.3, 0.1]), [0.2, 0.3, 0.1]
    want = jacobian[:, :2] @ numpy.diag([1e-5, 2e-5]) @ jacobian[:, :2].T
    assert numpy.abs(arm.compliance(q) - want).max() < 1e-12 * numpy.abs(want).max()
    with pytest.raises(ValueError, match="found no site and no body"):
        stiffarm.Arm.from_mujoco(spec, tip="elsewhere")


def mujoco_torque(mujoco, spec, q, qd, qdd):
    """What moves the joints, their springs and limits left out."""
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = q, qd
    mujoco.mj_forward(model, data)
    # M q̈, a column for each joint: the response to unit accelerations.
    ahead = numpy.zeros(3)
    mujoco.mj_mulM(model, data, ahead, qdd)
    first = [numpy.ravel(one)[0] for one in model.dof_damping]
    return ahead + data.qfrc_bias + first * qd + model.dof_frictionloss * numpy.sign(qd)


def assert_moves_alike(mujoco, arm, spec):
    for _ in range(10):
        q, qd, qdd = RANDOM.uniform(-1.0, 1.0, (3, 3))
        assert numpy.abs(arm.pose(q) - mujoco_pose(mujoco, spec, q)).max() < 10 * ROUNDING
        want = mujoco_torque(mujoco, spec, q, qd, qdd)
        assert numpy.abs(arm.inverse_dynamics(q, qd, qdd) - want).max() < 1e-12 * numpy.abs(want).max()


def test_mujoco_dynamics():
    mujoco = pytest.importorskip("mujoco")
    spec = mujoco.MjSpec.from_string(ARM)
    assert_moves_alike(mujoco, stiffarm.Arm.from_mujoco(spec, tip="tcp"), spec)


def rewritten(arm, changes):
    """The arm with numbers of its rows replaced: (row, key, value) each."""
    head, *rows = arm.toml.split("[[joint]]")
    for row, key, value in changes:
        lines = [line for line in rows[row].splitlines() if line.split("=")[0].strip() != key]
        assert key in ("coulomb", "viscous") or len(lines) < len(rows[row].splitlines()), (row, key)
        rows[row] = "\n".join([lines[0], f"{key} = {value!r}", *lines[1:]]) + "\n"
    return stiffarm.Arm.from_toml("[[joint]]".join([head, *rows]))


def test_numbers_go_back_to_mujoco():
    mujoco = pytest.importorskip("mujoco")
    spec = mujoco.MjSpec.from_string(ARM)
    nominal = stiffarm.Arm.from_mujoco(spec, tip="tcp")
    first, second, third = nominal.rows
    # Of the first row, part of the mass is in a body that is fixed to the one that turns.
    changes = [
        (0, "mass", first.mass + 1.5), (0, "com", [x + 0.01 for x in first.com]), (0, "coulomb", 4.5), (0, "rotor_inertia", 0.55),
        (1, "stiffness", 4e4), (1, "viscous", 7.0), (1, "mass", 0.9 * second.mass),
        (2, "com", [third.com[0] + 0.02, third.com[1], third.com[2] - 0.01]),
    ]  # fmt: skip
    corrected = rewritten(nominal, changes)
    q, qd = RANDOM.uniform(-1.0, 1.0, (2, 3))
    assert numpy.abs(corrected.bias(q, qd) - nominal.bias(q, qd)).max() > 0.5
    assert corrected.to_mujoco(spec, nominal, tip="tcp") == []
    assert_moves_alike(mujoco, corrected, spec)
    model = spec.compile()
    assert [numpy.ravel(one)[0] for one in model.jnt_stiffness] == [1e5, 4e4, 0.0]
    assert model.body("riser").mass[0] == 1.0 and abs(model.body("shoulder").mass[0] - 9.5) < 1e-12
    # And read again it is the corrected arm.
    for row, want in zip(stiffarm.Arm.from_mujoco(spec, tip="tcp").rows, corrected.rows):
        assert numpy.allclose(row.inertia, want.inertia, rtol=1e-12, atol=1e-15) and numpy.allclose(row.com, want.com, rtol=1e-12, atol=1e-15)
        assert abs(row.mass - want.mass) < 1e-12 and (row.coulomb, row.viscous) == (want.coulomb, want.viscous)


def test_what_no_body_is_stays_out_of_mujoco():
    mujoco = pytest.importorskip("mujoco")
    spec = mujoco.MjSpec.from_string(ARM)
    nominal = stiffarm.Arm.from_mujoco(spec, tip="tcp")
    # Less than the riser alone, which is fixed to the shoulder.
    lighter = rewritten(nominal, [(0, "mass", 0.5)])
    assert lighter.to_mujoco(spec, nominal, tip="tcp") == ["mass and inertia at link 1: no body has them"]
    assert spec.compile().body("shoulder").mass[0] == 8.0


def test_corrections_go_back_to_mujoco():
    mujoco = pytest.importorskip("mujoco")
    spec = mujoco.MjSpec.from_string(ARM)
    nominal = stiffarm.Arm.from_mujoco(spec, tip="tcp")
    effects = ["joint_offset@joint 2=2 mrad", "link_geometry@link 3:a=0.4mm,alpha=0.5mrad", "tool_frame:x=0.3mm,rz=1mrad"]
    data = stiffarm.simulate(nominal, effects=effects, poses=30, noise_position=1e-6, noise_rotation=1e-6, payload=0.0)
    geometry = ["joint_offset", "link_geometry", "tool_frame"]
    corrected = stiffarm.diagnose(nominal, data, noise_position=1e-6, noise_rotation=1e-6, effects=geometry).corrected
    assert corrected.effects == [] and corrected.to_mujoco(spec, nominal, tip="tcp") == []
    for _ in range(10):
        q = RANDOM.uniform(-0.5, 0.5, 3)
        assert numpy.abs(corrected.pose(q) - mujoco_pose(mujoco, spec, q)).max() < 10 * ROUNDING
        assert numpy.abs(corrected.pose(q) - nominal.pose(q)).max() > 1e-4


def test_friction_of_a_log_goes_back_to_mujoco():
    mujoco = pytest.importorskip("mujoco")
    spec = mujoco.MjSpec.from_string(ARM)
    nominal = stiffarm.Arm.from_mujoco(spec, tip="tcp")
    effects = ["coulomb_friction@joint 2=5", "viscous_friction@joint 1=8"]
    # A hundredth of the friction: with less the half step between a turn and the next sample is what is found.
    log = stiffarm.simulate(nominal, effects=effects, log=stiffarm.Log(runs=2, rate=100, noise_torque=0.05))
    found = stiffarm.diagnose(nominal, log, effects=["coulomb_friction", "viscous_friction"])
    assert {(one.effect, one.place) for one in found.findings} == {("coulomb_friction", "joint 2"), ("viscous_friction", "joint 1")}
    corrected = found.corrected
    assert corrected.to_mujoco(spec, nominal, tip="tcp") == []
    assert_moves_alike(mujoco, corrected, spec)
    model = spec.compile()
    assert abs(model.dof_frictionloss[1] - 5.0) < 0.5 and abs(numpy.ravel(model.dof_damping[0])[0] - 20.0) < 2.0


@pytest.mark.parametrize("name", ["Puma560", "Panda", "Stanford", "IRB140", "Orion5"])
def test_roboticstoolbox(name):
    toolbox = pytest.importorskip("roboticstoolbox")
    robot = getattr(toolbox.models.DH, name)()
    arm = stiffarm.Arm.from_roboticstoolbox(robot)
    assert arm.dof == robot.n
    for _ in range(20):
        q = RANDOM.uniform(-1.0, 1.0, robot.n)
        assert numpy.abs(arm.pose(q) - robot.fkine(q).A).max() < 1e-12
        assert numpy.abs(arm.jacobian(q) - robot.jacob0(q)).max() < 1e-12
