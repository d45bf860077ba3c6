"""Arms: by every engine the same, and as the command line evaluates them."""

import json
import pickle
import shutil
import threading

import numpy
import pytest
import stiffarm
from stiffarm import _native

RANDOM = numpy.random.default_rng(7)
WRENCH = [30.0, -20.0, -200.0, 3.0, 1.0, -2.0]


def call(arm, name, count=None):
    """An output at a random state, or at `count`."""
    lead = () if count is None else (count,)
    joints = next(output[3] for output in _native.outputs() if output[0] == name)
    wrench = next(output[4] for output in _native.outputs() if output[0] == name)
    inputs = [RANDOM.uniform(-1.0, 1.0, (*lead, arm.dof)) for _ in joints]
    return inputs, getattr(arm, name)(*inputs, *([WRENCH] if wrench else []))


@pytest.mark.parametrize("robot", ["kuka_kr240", "ur10", "panda", "stanford"])
@pytest.mark.parametrize("name", [output[0] for output in _native.outputs()])
def test_kernels_and_textbook_agree(robot, name):
    built_in = stiffarm.Arm.load(robot)
    textbook = stiffarm.Arm.from_toml(built_in.toml)
    assert textbook.engine(name) == "textbook"
    if name == "forward_dynamics" and "\ninertia = " not in built_in.toml:
        for arm in (built_in, textbook):
            with pytest.raises(stiffarm.Unstable, match="mass"):
                call(arm, name)
        return
    inputs, found = call(built_in, name, 9)
    wrench = [WRENCH] if next(output[4] for output in _native.outputs() if output[0] == name) else []
    want = getattr(textbook, name)(*inputs, *wrench)
    # Half of the digits, which what rounds keeps through the solution of a system of condition 1e7.
    assert numpy.abs(found - want).max() <= 1.5e-8 * max(1e-300, numpy.abs(want).max())


@pytest.mark.parametrize("gravity", [False, True])
def test_eval_of_the_command_line(cli, gravity):
    q = [0.3, -1.1, 1.4, -0.2, 0.7, 0.5]
    words = ["--q", ",".join(map(str, q)), "--wrench", ",".join(map(str, WRENCH)), *(["--gravity"] if gravity else [])]
    want = json.loads(cli("eval", "kuka_kr240", *words, "--json", "-"))
    arm = stiffarm.Arm.load("kuka_kr240")
    pose = arm.pose(q)
    sag = arm.deflection_with_gravity if gravity else arm.deflection
    torque, k_c = arm.joint_torque(q, WRENCH), arm.complementary_stiffness(q, WRENCH)
    if gravity:
        torque, k_c = torque + arm.weight_torque(q), k_c + arm.weight_stiffness(q)
    found = {
        "position": pose[:3, 3], "rotation": pose[:3, :3], "jacobian": arm.jacobian(q), "k_c": k_c,
        "compliance": arm.compliance(q), "deflection": sag(q, WRENCH), "joint_torque": torque,
    }  # fmt: skip
    assert found.keys() == want.keys()
    for key, value in found.items():
        scale = numpy.abs(want[key]).max() or 1.0
        # Kernels and graph round apart in their sines, and once an operation: a thousand of them.
        assert numpy.abs(value - want[key]).max() <= 1e3 * 2.3e-16 * scale, key


def test_gravity_holds_the_weights():
    arm, q = stiffarm.Arm.load("ur10"), RANDOM.uniform(-1.0, 1.0, (7, 6))
    want = -arm.weight_torque(q)
    # Inverse dynamics and sums over weights share no code; each adds up some ten terms per link.
    assert numpy.abs(arm.gravity(q) - want).max() < 1e2 * 2.3e-16 * numpy.abs(want).max()
    out = numpy.empty((7, 6))
    assert arm.gravity(q, out=out) is out and (arm.regressor(q, q, q) == arm.torque_regressor(q, q, q)).all()


def test_an_output_array_is_filled():
    arm, q = stiffarm.Arm.load("ur5"), RANDOM.uniform(-1.0, 1.0, (1500, 6))
    want = arm.jacobian(q)
    rows_first = numpy.empty((1500, 6, 6))
    as_written = numpy.empty((1500, 6, 6)).transpose(0, 2, 1)
    for out in (rows_first, as_written, numpy.empty((3000, 6, 6))[::2]):
        assert arm.jacobian(q, out=out) is out
        assert (out == want).all()
    with pytest.raises(ValueError, match="out: found the shape"):
        arm.jacobian(q, out=numpy.empty((6, 6)))
    with pytest.raises(TypeError, match="float64"):
        arm.jacobian(q, out=numpy.empty((1500, 6, 6), int))
    frozen = numpy.empty((1500, 6, 6))
    frozen.flags.writeable = False
    with pytest.raises(ValueError, match="cannot be written"):
        arm.jacobian(q, out=frozen)


def test_single_precision():
    arm, q = stiffarm.Arm.load("kuka_kr240"), RANDOM.uniform(-1.0, 1.0, (40, 6)).astype("f4")
    want = arm.deflection(q.astype("f8"), WRENCH)
    # Of single precision, what was worked out in double is rounded: the nearest there is.
    found = arm.deflection(q, WRENCH)
    assert found.dtype == numpy.float32 and (found == want.astype("f4")).all()
    out = numpy.empty((40, 6))
    assert arm.deflection(q, WRENCH, out=out) is out and (out == want).all()
    strided = numpy.empty((80, 6), "f4")[::2]
    assert arm.deflection(q, WRENCH, out=strided) is strided and (strided == found).all()
    assert arm.pose(q[0]).dtype == numpy.float32
    assert stiffarm.Arm.load("ur10").inverse_dynamics(q, q.astype("f8"), q).dtype == numpy.float64
    with pytest.raises(ValueError, match="out: found the shape"):
        arm.pose(q, out=numpy.empty((4, 4), "f4"))
    frozen = numpy.empty((40, 6), "f4")
    frozen.flags.writeable = False
    with pytest.raises(ValueError):
        arm.deflection(q, WRENCH, out=frozen)


ROWS = [
    {"d": 0.4, "alpha": "pi/2", "stiffness": 2e5},
    {"a": 0.5, "stiffness": 1e5},
    {"a": 0.3, "alpha": "-pi/2", "stiffness": 6e4},
    {"type": "prismatic", "d": 0.1, "stiffness": 1e6},
]
ELBOW = {"translation": [0.05, -0.02, 0.1], "rotation": [0.3, -0.2, 0.5]}
PLACED = {
    "tool": {"translation": [0.0, 0.1, 0.2], "rotation": [0.0, "pi/2", 0.0]},
    "frames": [{"name": "elbow", "joint": 2, **ELBOW}],
    "markers": [{"name": "smr", "translation": [0.01, 0.02, -0.03]}],
}


def test_frames_and_markers():
    arm = stiffarm.Arm.from_dh(ROWS, **PLACED)
    assert arm.places == ["elbow", "smr"]
    # The arm that ends where the elbow is.
    ending = stiffarm.Arm.from_dh(ROWS[:2], tool=ELBOW)
    q = RANDOM.uniform(-1.0, 1.0, (300, 4))
    assert (arm.engine("pose", at="elbow"), ending.engine("pose")) == ("graph", "textbook")
    # What some dozens of products and sums of numbers of about one round.
    near = 100 * 2.3e-16
    assert numpy.abs(arm.pose(q, at="elbow") - ending.pose(q[:, :2])).max() < near
    jacobian = arm.jacobian(q, at="elbow")
    assert jacobian.shape == (300, 6, 4) and not jacobian[..., 2:].any()
    assert numpy.abs(jacobian[..., :2] - ending.jacobian(q[:, :2])).max() < near
    for name in ("deflection", "complementary_stiffness", "joint_torque"):
        found, want = getattr(arm, name)(q, WRENCH, at="elbow"), getattr(ending, name)(q[:, :2], WRENCH)
        found = found[:, :2, :2] if found.ndim == 3 else found[:, : want.shape[1]]
        assert numpy.abs(found - want).max() < 1e3 * near * numpy.abs(want).max()
    tool = arm.pose(q)
    assert numpy.abs(arm.pose(q, at="smr")[..., :3, 3] - (tool @ [0.01, 0.02, -0.03, 1.0])[..., :3]).max() < near
    with pytest.raises(ValueError, match="`wrist` is no frame of this robot"):
        arm.pose(q, at="wrist")
    with pytest.raises(ValueError, match="is not told of a frame"):
        arm.frames(q, at="elbow")
    with pytest.raises(ValueError, match="is no frame"):
        stiffarm.Arm.load("ur5").pose([0.0] * 6, at="elbow")


@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler")
def test_frames_are_compiled(tmp_path):
    text = stiffarm.Arm.from_dh(ROWS, **PLACED).toml
    asked = 'outputs = ["pose", "deflection at elbow", "jacobian at smr"]\nconvention'
    arm = stiffarm.Arm.from_toml(text.replace("convention", asked, 1))
    q = RANDOM.uniform(-1.0, 1.0, (700, 4))
    before = [arm.deflection(q, WRENCH, at="elbow"), arm.jacobian(q, at="smr")]
    arm.compile(cache=tmp_path)
    assert [arm.engine("deflection", "elbow"), arm.engine("jacobian", "smr"), arm.engine("jacobian", "elbow")] == ["c", "c", "graph"]
    for was, found in zip(before, [arm.deflection(q, WRENCH, at="elbow"), arm.jacobian(q, at="smr")]):
        # The graph and its text are one: the same operations in the same order.
        assert numpy.abs(found - was).max() <= 1e-14 * numpy.abs(was).max()


def test_rows_of_the_table():
    arm = stiffarm.Arm.from_dh([{"a": 1.0, "stiffness": 10.0, "mass": 2.0, "com": [-0.5, 0.0, 0.1], "inertia": [0.1, 0, 0, 0.2, 0.01, 0.2],
        "gear": 100.0, "rotor_inertia": 3e-4, "coulomb": "6 N*m", "viscous": 9.0}, {"a": 0.5}])  # fmt: skip
    first, second = arm.rows
    assert (first.mass, first.com, first.coulomb, first.viscous) == (2.0, [-0.5, 0.0, 0.1], 6.0, 9.0)
    assert abs(first.stiffness - 10.0) < 1e-14 and abs(first.armature - 3.0) < 1e-14
    assert first.inertia[1][2] == first.inertia[2][1] == 0.01
    assert second.stiffness is None and second.mass == 0.0


def test_what_is_not_copied():
    arm, q = stiffarm.Arm.load("ur5"), RANDOM.uniform(-1.0, 1.0, (10, 6))
    result = arm.jacobian(q)
    assert result.transpose(0, 2, 1).flags.c_contiguous


@pytest.mark.parametrize("wrong, message", [
    ([1.0, 2.0], r"q: found the shape \(2,\), expected \(6,\) or \(batch, 6\)"),
    ([[0.0] * 6, [0.0, numpy.inf, 0.0, 0.0, 0.0, 0.0]], "not finite, at pose 1"),
])  # fmt: skip
def test_wrong_values(wrong, message):
    with pytest.raises(ValueError, match=message):
        stiffarm.Arm.load("ur5").jacobian(wrong)


@pytest.mark.parametrize("wrong", [["a"] * 6, [1j] * 6, [None] * 6, [True] * 6])
def test_what_is_no_number(wrong):
    with pytest.raises(TypeError, match="q: found"):
        stiffarm.Arm.load("ur5").jacobian(wrong)


def test_a_batch_of_one_load():
    arm, q = stiffarm.Arm.load("kuka_kr240"), RANDOM.uniform(-1.0, 1.0, (7, 6))
    loads = numpy.tile(WRENCH, (7, 1))
    assert (arm.deflection(q, WRENCH) == arm.deflection(q, loads)).all()
    assert arm.deflection(q[0], loads).shape == (7, 6)
    with pytest.raises(ValueError, match="batches of the shapes"):
        arm.deflection(q, loads[:3])


def test_an_unstable_arm():
    arm = stiffarm.Arm.from_dh([{"a": 1.0, "stiffness": 10.0}])
    # Pushed along its link by more than its spring bears: 10 N·m/rad over 1 m.
    with pytest.raises(stiffarm.Unstable) as caught:
        arm.deflection([[0.0]] * 3, [[1.0, 0, 0, 0, 0, 0], [-20.0, 0, 0, 0, 0, 0], [-30.0, 0, 0, 0, 0, 0]])
    assert (caught.value.first, caught.value.count) == (1, 2)
    # What stands is in `out`, however that lies.
    loads = [[1.0, 0, 0, 0, 0, 0], [-20.0, 0, 0, 0, 0, 0]]
    want = arm.deflection([0.0], loads[0])
    for out in (numpy.empty((2, 6)), numpy.empty((4, 6))[::2], numpy.empty((2, 6), "f4")):
        with pytest.raises(stiffarm.Unstable):
            arm.deflection([[0.0]] * 2, loads, out=out)
        assert (out[0] == want.astype(out.dtype)).all()
    alone = numpy.full(6, 7.0)
    with pytest.raises(stiffarm.Unstable):
        arm.deflection(numpy.zeros(1), numpy.array(loads[1]), out=alone)
    assert (alone == 7.0).all()


@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler")
@pytest.mark.parametrize("robot", ["kuka_kr240", "panda", "stanford"])
def test_compiled_c(robot, tmp_path):
    built_in = stiffarm.Arm.load(robot)
    arm = stiffarm.Arm.from_toml(built_in.toml)
    assert arm.compile(cache=tmp_path) == "c"
    q = RANDOM.uniform(-1.0, 1.0, (3000, arm.dof))
    # The same operations in the same order: the same bits.
    assert (arm.jacobian(q) == built_in.jacobian(q)).all()
    library = next(tmp_path.iterdir())
    written = library.stat().st_mtime_ns
    again = stiffarm.Arm.from_toml(built_in.toml)
    assert again.compile(cache=tmp_path) == "c"
    assert library.stat().st_mtime_ns == written


def test_no_compiler(monkeypatch, caplog):
    monkeypatch.setattr(shutil, "which", lambda _: None)
    monkeypatch.delenv("CC", raising=False)
    arm = stiffarm.Arm.from_dh([{"a": 1.0}])
    assert arm.compile() == "textbook"
    assert "found no C compiler" in caplog.text
    with pytest.raises(ValueError, match="found no compiler"):
        arm.compile(compiler="no-such-compiler")


def test_a_library_of_another_arm(tmp_path):
    one, other = (stiffarm.Arm.from_dh([{"a": length}]) for length in (1.0, 1.1))
    one.compile(cache=tmp_path)
    with pytest.raises(ValueError, match="is not what the textbook gives"):
        other.load_c(next(tmp_path.iterdir()))
    assert other.engine("jacobian") == "textbook"


def test_a_corrected_arm(at_root, cli):
    better = stiffarm.Arm.load("examples/compensation/better.toml")
    q, sides = [0.2, -1.0, 1.1, 0.1, 0.5, 0.3], [1, -1, 1, 1, -1, 1]
    assert better.effects and better.engine("pose") == "graph"
    words = ["--q", ",".join(map(str, q)), "--sides", ",".join(map(str, sides)), "--json", "-"]
    want = json.loads(cli("eval", "examples/compensation/better.toml", *words))
    assert numpy.array_equal(better.pose(q, sides=sides)[:3, 3], want["position"])
    with pytest.raises(stiffarm.Error, match="does not honour"):
        better.pose(q)
    before = better.pose(q, sides=sides)
    assert better.compile() == "c"
    assert numpy.abs(better.pose(q, sides=sides) - before).max() < 1e-14


def test_threads_do_not_wait_for_each_other():
    arm, q = stiffarm.Arm.load("ur10"), RANDOM.uniform(-1.0, 1.0, (20000, 6))
    want, found = arm.jacobian(q), []
    threads = [threading.Thread(target=lambda: found.append(arm.jacobian(q))) for _ in range(4)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert all((one == want).all() for one in found) and len(found) == 4


def test_arms_are_made_of_anything(tmp_path, at_root):
    assert set(stiffarm.robots()) >= {"kuka_kr240", "ur10"}
    elbow = stiffarm.Arm.load("lin_planar_symbolic", set={
        name: 1.0 for name in symbols("lin_planar_symbolic")
    })  # fmt: skip
    assert elbow.pose([0.0, 0.0]).shape == (4, 4)
    ur5 = stiffarm.Arm.load("tests/data/urdf/ur5.urdf", base="base_link", tip="tool0")
    assert ur5.dof == 6 and ur5.jacobian([0.1] * 6)[5, 0] == 1.0
    copy = pickle.loads(pickle.dumps(ur5))
    assert copy == ur5 and hash(copy) == hash(ur5) and copy != stiffarm.Arm.load("ur10") and copy != "ur5"
    assert numpy.array_equal(copy.pose([0.3] * 6), ur5.pose([0.3] * 6))
    ur5.save(tmp_path / "ur5.toml")
    assert stiffarm.Arm.load(tmp_path / "ur5.toml").toml == ur5.toml


def symbols(robot):
    with pytest.raises(stiffarm.Error) as caught:
        stiffarm.Arm.load(robot)
    listed = caught.value.mistakes[0][1].split(": ")[1]
    return [entry.split(" ")[0] for entry in listed.split(", ")]


def test_mistakes_have_their_place():
    with pytest.raises(stiffarm.Error) as caught:
        stiffarm.Arm.from_dh([{"a": 1.0, "alpha": "half a turn"}], name="elbow")
    message, _, file, line, column = caught.value.mistakes[0]
    assert file == "<elbow>" and line == 7 and column is not None, caught.value.mistakes
    assert "half a turn" in str(caught.value)
