"""What a diagnosis is in Python beyond what the command line writes."""

import _thread
import copy
import pickle
import threading
import time

import numpy
import pytest
import stiffarm


@pytest.fixture
def found(campaign):
    return stiffarm.diagnose("kuka_kr240", campaign)


def test_the_result(found):
    finding = found.findings[0]
    assert (finding.effect, finding.place) == ("joint_compliance", "joint 2")
    assert (finding.effect, finding.place) in found.sets[0]
    part, (low, high) = found.shrink
    assert low <= part <= high <= 1.0 and part > 0.5
    assert isinstance(found.cannot_see, list)
    assert found.stopped is False
    value = finding.parameters[0]
    assert value.ci95[0] < 1.5e-7 < value.ci95[1]
    assert "stiffness" in found.corrected.toml
    with pytest.raises(AttributeError, match="found no 'nothing'"):
        found.nothing


def test_predictions(found):
    other = stiffarm.simulate("kuka_kr240", effects=["joint_compliance@joint 2=1.5e-7"], poses=10, payload=200.0, seed=9)
    before, after, inside = found.predict(other)
    assert before.shape == after.shape == (other.rows, 6) and inside.shape == (other.rows,)
    size = [numpy.sqrt((gap[inside, :3] ** 2).sum(axis=1).mean()) for gap in (before, after)]
    # The noise is 30 µm in each of three coordinates.
    assert size[1] < 2 * 30e-6 * 3**0.5 < size[0]


def test_notebooks_and_plots(found):
    page = found._repr_html_()
    assert page.startswith("<iframe srcdoc=") and "&lt;!doctype" in page
    pytest.importorskip("matplotlib")
    figure = found.plot()
    assert len(figure.axes[0].patches) == 1 + len(found.findings)


def test_a_certificate(found, tmp_path):
    sheet = found.to_pdf(tmp_path / "found.pdf")
    assert sheet.startswith(b"%PDF-1.") and (tmp_path / "found.pdf").read_bytes() == sheet


def test_pickles_and_copies(found):
    again = pickle.loads(pickle.dumps(copy.deepcopy(found)))
    assert (str(again), again.to_json(), again.to_html(), again.to_pdf()) == (str(found), found.to_json(), found.to_html(), found.to_pdf())
    assert again.corrected == found.corrected and again.to_urdf() == found.to_urdf()
    assert again.sets == found.sets and again.findings == found.findings
    with pytest.raises(ValueError, match="no data to predict with"):
        again.predict({"q1": [0.0]})


def test_remarks_are_logged(caplog, campaign):
    stiffarm.simulate("ur5", poses=3)
    with caplog.at_level("WARNING", logger="stiffarm"):
        stiffarm.compensate("ur5", {"x": [0.4], "y": [0.1], "z": [0.4]})
    assert "nothing in the robot file gives way" in caplog.text


def test_progress(said):
    stiffarm.withhold("ur5", cases=6, effects=["joint_compliance"], poses=10)
    assert "withheld cases" in said and said[-1] == "closed"


def test_ctrl_c_ends_it(interruptible):
    data = stiffarm.simulate("kuka_kr240", effects=["backlash@joint 1=1mrad", "joint_compliance@joint 2=3e-7"], poses=400, payload=200.0)
    threading.Timer(0.4, _thread.interrupt_main).start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(50):
            stiffarm.diagnose("kuka_kr240", data, nested=True)
    assert time.monotonic() - begun < 60.0
    # And the next one is as ever.
    assert stiffarm.diagnose("lin_planar", {"q1": [0.1, 0.5, 0.9], "q2": [0.2] * 3, "fy": [-9.0] * 3, "dy": [-1e-4, -2e-4, -3e-4]})


def lag(reading, values):
    """A joint falls behind in proportion to how far it is beyond half a radian."""
    q = reading.q[reading.number - 1]
    return -values[0] * (q - min(max(q, -0.5), 0.5))


def pulled(effect, campaign):
    return stiffarm.diagnose("kuka_kr240", campaign, own=[effect], noise_position=30e-6, noise_rotation=1e-4)


def test_an_effect_of_ones_own():
    plan = stiffarm.simulate("kuka_kr240", poses=25, payload=50.0, seed=5)
    arm = stiffarm.Arm.load("kuka_kr240")
    q = numpy.column_stack([plan[f"q{k}"] for k in range(1, 7)])
    columns = dict(plan)
    moved = q.copy()
    moved[:, 1] -= 2e-3 * (q[:, 1] - numpy.clip(q[:, 1], -0.5, 0.5))
    shift = arm.pose(moved) - arm.pose(q)
    for k, name in enumerate("xyz"):
        columns[f"{name}[m]"] = columns[f"{name}[m]"] + shift[:, k, 3]
    turn = arm.pose(moved)[:, :3, :3] @ arm.pose(q)[:, :3, :3].transpose(0, 2, 1)
    assert numpy.abs(turn - numpy.eye(3)).max() > 1e-4
    positions = {name: column for name, column in columns.items() if name[:2] not in ("rx", "ry", "rz")}
    effect = stiffarm.Effect("taut_hose", "joint", [("lag", "1")], lag)
    found = pulled(effect, positions)
    assert any(("taut_hose", "joint 2") in one for one in found.sets), str(found)
    named = [f for f in found.findings if f.effect == "taut_hose"]
    if named:
        low, high = named[0].parameters[0].ci95
        assert low < 2e-3 < high
    # Made once, it serves again.
    assert pulled(effect, positions).findings == found.findings


def test_an_effect_at_the_tool(campaign):
    drift = stiffarm.Effect("creep", "tool", [("rate", "m")], lambda row, v: [v[0] * row.index / 10, 0, 0, 0, 0, 0])
    assert pulled(drift, campaign).findings


def test_what_an_effect_raises(campaign):
    def wrong(reading, values):
        raise RuntimeError("my function is wrong")

    with pytest.raises(RuntimeError, match="my function is wrong"):
        pulled(stiffarm.Effect("wrong", "joint", [("x", "rad")], wrong), campaign)
    with pytest.raises(ValueError, match="finite"):
        pulled(stiffarm.Effect("endless", "joint", [("x", "rad")], lambda r, v: float("inf")), campaign)
    with pytest.raises(ValueError, match="expected one"):
        pulled(stiffarm.Effect("backlash", "joint", [("x", "rad")], lag), campaign)
    for place, parameters in (("elbow", [("x", "rad")]), ("joint", []), ("joint", [("x", "furlong")])):
        with pytest.raises(ValueError):
            stiffarm.Effect("none", place, parameters, lag)
