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
    <joint name="j1" type="hinge" axis="0 0 1" pos="0 0.02 0" range="-2 2" limited="true" stiffness="1e5"/>
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


def test_corrections_go_back_to_mujoco():
    mujoco = pytest.importorskip("mujoco")
    spec = mujoco.MjSpec.from_string(ARM)
    nominal = stiffarm.Arm.from_mujoco(spec, tip="tcp")
    effects = ["joint_offset@joint 2=2 mrad", "link_geometry@link 3:a=0.4mm,alpha=0.5mrad", "tool_frame:x=0.3mm,rz=1mrad"]
    data = stiffarm.simulate(nominal, effects=effects, poses=30, noise_position=1e-6, noise_rotation=1e-6, payload=0.0)
    found = stiffarm.diagnose(nominal, data, noise_position=1e-6, noise_rotation=1e-6)
    corrected = found.corrected
    lost = corrected.to_mujoco(spec, nominal, tip="tcp")
    assert lost == [f"{effect} at {place}" for effect, place in corrected.effects]
    for _ in range(10):
        q = RANDOM.uniform(-0.5, 0.5, 3)
        if not corrected.effects:
            assert numpy.abs(corrected.pose(q) - mujoco_pose(mujoco, spec, q)).max() < 1e-9
    moved = numpy.abs(corrected.pose(numpy.zeros(3)) - nominal.pose(numpy.zeros(3))).max()
    assert moved > 1e-4


def test_springs_go_back_to_mujoco():
    mujoco = pytest.importorskip("mujoco")
    spec = mujoco.MjSpec.from_string(ARM)
    nominal = stiffarm.Arm.from_mujoco(spec, tip="tcp")
    softer = stiffarm.Arm.from_toml(nominal.toml.replace("stiffness = 50000.0", "stiffness = 40000.0"))
    assert softer.toml != nominal.toml
    assert softer.to_mujoco(spec, nominal, tip="tcp") == []
    assert [numpy.ravel(one)[0] for one in spec.compile().jnt_stiffness] == [1e5, 4e4, 0.0]


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
