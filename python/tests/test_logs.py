"""Joint logs: predictions, effects of one's own, and a campaign beside them, as the command line has them."""

import _thread
import json
import shutil
import threading
import time

import numpy
import pytest
import stiffarm

FRICTION = ["coulomb_friction", "viscous_friction"]


def recorded(seed, **options):
    """A log of a UR10 whose second joint is braked by 9 N·m."""
    log = stiffarm.Log(runs=1, rate=100, period=12.0, **options)
    return stiffarm.simulate("ur10", effects=["coulomb_friction@joint 2=9"], log=log, seed=seed)


@pytest.fixture(scope="module")
def motion():
    return recorded(2)


@pytest.fixture(scope="module")
def other():
    return recorded(7)


@pytest.fixture(scope="module")
def found(motion):
    return stiffarm.diagnose("ur10", motion, effects=FRICTION)


def test_a_prediction_is_that_of_the_command_line(cli, found, motion, other, tmp_path):
    paths = [tmp_path / "log.csv", tmp_path / "other.csv"]
    motion.save(paths[0])
    other.save(paths[1])
    told = cli("diagnose", "ur10", paths[0], "--effects", ",".join(FRICTION), "--check", paths[1], "--json", "-")
    want = json.loads(told)["check"]
    seen = [found.predict(given) for given in (other, dict(other), paths[1], [other])]
    for prediction in seen:
        assert isinstance(prediction, stiffarm.LogPrediction)
        assert prediction.check.gap == want["gap"] and prediction.check.samples == want["samples"]
    prediction = seen[0]
    # The second way: the same from the arrays.
    for when, left in (("before", prediction.before), ("after", prediction.after)):
        for joint, gap in enumerate(want["gap"]):
            rows = left[prediction.inside[:, joint], joint]
            assert abs(numpy.sqrt((rows**2).mean()) / gap[when] - 1.0) < 1e-12
    torque = prediction.measured[prediction.inside[:, 1], 1]
    assert abs(torque.std() / want["gap"][1]["size"] - 1.0) < 1e-12


def test_what_is_predicted(found, other):
    prediction = found.predict(other)
    m = len(prediction.t)
    for numbers in (*prediction[:3], prediction.measured, prediction.predicted, prediction.q, prediction.qd):
        assert numbers.shape == (m, 6)
    assert prediction.run.shape == (m,) and (numpy.diff(prediction.t[prediction.run == 0]) > 0.0).all()
    # What is left less what was left without: friction at joint 2 alone, against the motion where it is fast.
    does = prediction.before - prediction.after
    fast = prediction.inside[:, 1] & (abs(prediction.qd[:, 1]) > 0.5 * abs(prediction.qd[:, 1]).max())
    part = does[fast, 1] / numpy.sign(prediction.qd[fast, 1])
    assert abs(numpy.median(part) / found.findings[0].parameters[0].value - 1.0) < 0.3
    before, after, inside = prediction
    assert before is prediction.before and after is prediction.after and inside is prediction.inside


def test_what_cannot_be_predicted(found, campaign, motion):
    with pytest.raises(stiffarm.Error, match="no joint log by its columns"):
        found.predict(campaign)
    at_rest = stiffarm.diagnose("kuka_kr240", campaign)
    with pytest.raises(stiffarm.Error, match="is a joint log, and measurements were diagnosed"):
        at_rest.predict(motion)
    with pytest.raises(stiffarm.Error, match="found 2 measurement files"):
        at_rest.predict([campaign, campaign])
    with pytest.raises(stiffarm.Error, match="cannot read"):
        found.predict("nowhere.csv")


def test_the_result(found):
    part, (low, high) = found.shrink
    assert 0.1 < low < part < high < 1.0
    # The joints' own figures say the same.
    before, after = (sum(joint[when] / joint["size"] for joint in found.gap) for when in ("before", "after"))
    assert abs(part - (1.0 - after / before)) < 1e-12
    assert found.sets == [{("coulomb_friction", "joint 2")}] and not found.stopped
    assert found.parts == [found.to_dict()] and "coulomb = " in found.corrected.toml
    assert found._repr_html_().startswith("<iframe srcdoc=")
    pytest.importorskip("matplotlib")
    axes = found.plot().axes[0]
    assert len(axes.patches) == 2 * (6 + 1)
    low, high = axes.containers[-1].lines[2][0].get_segments()[0][:, 0]
    assert low <= found.to_dict().shrink.after <= high


def test_progress_is_told(motion, said):
    stiffarm.diagnose("ur10", motion, effects=FRICTION)
    assert said[-1] == "closed" and any("1 finding found" in what for what in said), said


def test_ctrl_c_ends_it(motion, interruptible):
    threading.Timer(0.4, _thread.interrupt_main).start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(50):
            stiffarm.diagnose("ur10", motion)
    assert time.monotonic() - begun < 60.0
    # And the next one is as ever.
    assert stiffarm.diagnose("ur10", motion, effects=FRICTION).findings


# Effects of one's own.


def hysteresis(samples, values):
    """A brake that holds the more the farther the joint is from where it began."""
    k = samples.number - 1
    return values[0] * abs(samples.q[:, k]) * numpy.sign(samples.qd[:, k])


def braked(law, seed=5):
    """A log of a UR10 whose joint 3 has something that stiffarm does not know."""
    arm = stiffarm.Arm.load("ur10")
    random = numpy.random.default_rng(seed)
    t = numpy.arange(0.0, 40.0, 0.008)
    rates, phases = 2 * numpy.pi * random.uniform(0.05, 0.35, (6, 3)), random.uniform(0.0, 6.0, (6, 3))
    angles = t[:, None, None] * rates + phases
    q = 0.35 * numpy.sin(angles).sum(axis=2)
    qd = 0.35 * (rates * numpy.cos(angles)).sum(axis=2)
    qdd = -0.35 * (rates**2 * numpy.sin(angles)).sum(axis=2)
    tau = arm.inverse_dynamics(q, qd, qdd)
    tau[:, 2] += law(q[:, 2], qd[:, 2])
    return {"t": t, "q": q, "tau": tau + random.normal(0.0, 0.3, tau.shape)}


def own(data, effect, **options):
    return stiffarm.diagnose("ur10", data, own=[effect], torque_side="motor", **options)


def test_one_in_proportion(caplog):
    data = braked(lambda q, qd: 12.0 * abs(q) * numpy.sign(qd))
    effect = stiffarm.LogEffect("widening_brake", "torque", [("brake", "N·m/rad")], hysteresis)
    found = own(data, effect, effects=FRICTION)
    finding = found.findings[0]
    # Ranked before friction, which does some of it.
    assert (finding.effect, finding.place) == ("widening_brake", "joint 3"), str(found)
    (number,) = finding.parameters
    assert number.ci95[0] < 12.0 < number.ci95[1] and number.unit == "N·m/rad"
    prediction = found.predict(braked(lambda q, qd: 12.0 * abs(q) * numpy.sign(qd), seed=9))
    gap = prediction.check.gap[2]
    assert gap.after < 0.5 * gap.before
    # No robot file has it: it is left out, and said.
    with caplog.at_level("WARNING", logger="stiffarm"):
        assert "[[effect]]" not in found.corrected.toml
    assert "widening_brake at joint 3" in caplog.text
    # Made once, it serves again.
    assert own(data, effect, effects=FRICTION).findings == found.findings


def test_one_that_bends():
    """A brake that comes with speed, and levels out: its speed is no factor."""

    def levels(samples, values):
        torque, speed = values
        return torque * numpy.tanh(samples.qd[:, samples.number - 1] / speed)

    data = braked(lambda q, qd: 9.0 * numpy.tanh(qd / 0.4))
    effect = stiffarm.LogEffect("soft_brake", "torque", [("torque", "N·m"), ("speed", "rad/s")], levels, [[0.0, 0.1], [0.0, 0.25], [0.0, 0.6]])
    found = own(data, effect, effects=["coulomb_friction"])
    named = [finding for finding in found.findings if finding.effect == "soft_brake"]
    assert [finding.place for finding in named] == ["joint 3"], str(found)
    for number, truth in zip(named[0].parameters, (9.0, 0.4)):
        assert number.ci95[0] < truth < number.ci95[1], str(found)


def test_one_of_positions():
    arm = stiffarm.Arm.load("ur10")
    servo = stiffarm.simulate(arm, log=stiffarm.Log(logged="position", runs=3, period=20.0, rate=100), seed=4)
    columns = dict(servo)
    commands = columns["q_cmd2[rad]"]
    columns["q2[rad]"] = columns["q2[rad]"] + 4e-3 * numpy.sin(3.0 * commands)
    wave = stiffarm.LogEffect("wave", "position", [("height", "rad")], lambda at, v: v[0] * numpy.sin(3.0 * at.q[:, at.number - 1]))
    found = stiffarm.diagnose(arm, columns, own=[wave], effects=["latency"])
    (number,) = [one for one in found.findings if one.effect == "wave"][0].parameters
    assert number.ci95[0] < 4e-3 < number.ci95[1], str(found)


def test_what_it_sees(motion):
    seen = {}

    def look(samples, values):
        m, n = samples.q.shape
        assert samples.t.shape == (m,) and samples.qd.shape == samples.qdd.shape == samples.load.shape == (m, n) == (m, 6)
        seen[samples.number] = max(seen.get(samples.number, 0.0), abs(samples.load[:, 1]).max())
        return 0.0 * samples.t

    assert stiffarm.LogEffect("look", "torque", [("x", "N·m")], look).name == "look"
    stiffarm.diagnose("ur10", motion, own=[stiffarm.LogEffect("look", "torque", [("x", "N·m")], look)], effects=[])
    # Joint 2 of a UR10 carries its links: some hundred newton-metres by turns.
    assert sorted(seen) == [1, 2, 3, 4, 5, 6] and min(seen.values()) > 20.0


def test_what_it_raises(motion, campaign):
    def one(change, name="wrong", rows="torque", **options):
        return stiffarm.LogEffect(name, rows, [("x", "N·m")], change, **options)

    def wrong(samples, values):
        raise RuntimeError("my function is wrong")

    def ask(effect, data=motion):
        return stiffarm.diagnose("ur10" if data is motion else "kuka_kr240", data, own=[effect], effects=[])

    with pytest.raises(RuntimeError, match="my function is wrong"):
        ask(one(wrong))
    with pytest.raises(ValueError, match="found 3 numbers, 3 of them finite, expected"):
        ask(one(lambda samples, v: [0.0, 0.0, 0.0]))
    with pytest.raises(ValueError, match="finite"):
        ask(one(lambda samples, v: numpy.full(len(samples.t), numpy.inf)))
    with pytest.raises(ValueError, match="not in proportion"):
        ask(one(lambda samples, v: v[0] ** 3 * samples.t))
    with pytest.raises(ValueError, match="not in proportion"):
        ask(one(lambda samples, v: v[0] + samples.t))
    with pytest.raises(TypeError, match="expected real numbers"):
        ask(one(lambda samples, v: [None] * len(samples.t)))
    with pytest.raises(ValueError, match="found two effects"):
        ask(one(hysteresis, name="coulomb_friction"))
    with pytest.raises(ValueError, match="`wrong`, which is of joint logs"):
        ask(one(hysteresis), campaign)
    with pytest.raises(ValueError, match="`held`, which is of measurements"):
        ask(stiffarm.Effect("held", "joint", [("x", "rad")], lambda row, v: v[0]))
    with pytest.raises(ValueError, match="expected torque or position"):
        one(hysteresis, rows="current")
    with pytest.raises(ValueError, match="expected 1 finite numbers"):
        one(hysteresis, about=[[1.0, 2.0]])
    with pytest.raises(TypeError, match="expected a function"):
        one(5)
    # And the next one is as ever.
    assert ask(one(hysteresis)).gap


# A campaign and a log.

def test_a_campaign_and_a_log(cli, repository, tmp_path, monkeypatch):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "0")
    shutil.copy(repository / "tests" / "data" / "elbow.toml", tmp_path)
    arm = stiffarm.Arm.load(tmp_path / "elbow.toml")
    gives = {"effects": ["joint_compliance@joint 2=2e-4"], "payload": 5.0, "noise_position": 5e-4}
    campaign = stiffarm.simulate(arm, **gives)
    servo = stiffarm.simulate(arm, effects=["servo_droop@joint 2=2e-4"], log=stiffarm.Log(logged="position", lost=0.0))
    paths = [tmp_path / name for name in ("elbow.toml", "campaign.csv", "servo.csv", "better.toml")]
    campaign.save(paths[1])
    servo.save(paths[2])
    options = ["--effects", "joint_compliance,servo_droop,latency", "--nuisance", "base_frame"]
    told = cli("diagnose", *paths[:3], *options, "--write-robot", paths[3], "--json", "-")
    want = json.loads(told)
    known = {"effects": ["joint_compliance", "servo_droop", "latency"], "nuisance": ["base_frame"]}
    found = stiffarm.diagnose(*map(str, paths[:1]), [paths[1], paths[2]], **known)
    assert found.to_json() == told
    assert str(found) == cli("diagnose", *paths[:3], *options)
    assert found.corrected.toml == paths[3].read_text(encoding="utf-8")
    (spring,) = found.together.springs
    assert spring.place == "joint 2" and spring.together.ci95[0] < 2e-4 < spring.together.ci95[1]
    # Frames, in whatever order, say the same of the same numbers.
    for frames in ([campaign, servo], [dict(servo), dict(campaign)]):
        again = stiffarm.diagnose(arm, frames, **known)
        assert again.together == want["together"]
    assert [f.effect for f in found.findings] == [f["effect"] for part in ("campaign", "log") for f in want[part]["findings"]]
    assert len(found.sets) == len(found.findings) and found.shrink[0] > 0.1
    # Either kind is predicted, each by its own.
    assert found.predict(paths[1]).after.shape == (campaign.rows, 6)
    log = found.predict(paths[2])
    assert isinstance(log, stiffarm.LogPrediction) and log.after.shape == (len(log.t), 3)
    assert found.to_html().count("<iframe") == 2
    pytest.importorskip("matplotlib")
    assert len(found.plot().axes) == 2


def test_base_parameters_have_intervals_and_a_covariance(found):
    told = found.base_parameters
    spread = numpy.sqrt(numpy.diag(numpy.array(found.rigid.covariance)))
    assert len(told) == found.rigid_parameters == len(spread) > 0
    for one, deviation in zip(told, spread):
        assert one.sum[0].times == 1.0 and one.name.startswith(one.sum[0].moment)
        if "ci95" in one:
            low, high = one.ci95
            # Student's t of a few blocks or of many.
            assert low < one.value < high and 1.9 < (high - low) / (2.0 * deviation) < 13.0
        else:
            assert one.value == deviation == 0.0
