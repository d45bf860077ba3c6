"""Measurements from whatever holds columns."""

import datetime
import decimal
import sys

import numpy
import pytest
import stiffarm


def told(found):
    """The diagnosis, without what it was read of."""
    record = dict(found.to_dict())
    if "trust" in record:
        record["trust"] = {key: value for key, value in record["trust"].items() if key != "file"}
    return {key: value for key, value in record.items() if key not in ("data_sha256", "robot_sha256", "corrected", "files")}


@pytest.fixture
def want(campaign, tmp_path):
    # Without comments, so that rows stand in the same lines.
    lines = [line for line in campaign.csv.splitlines(keepends=True) if not line.startswith("#")]
    (tmp_path / "run.csv").write_text("".join(lines), encoding="utf-8")
    return told(stiffarm.diagnose("kuka_kr240", tmp_path / "run.csv"))


def test_a_table_and_a_dictionary(campaign, want):
    bare = "".join(line for line in campaign.csv.splitlines(keepends=True) if not line.startswith("#"))
    assert told(stiffarm.diagnose("kuka_kr240", stiffarm.Table(bare))) == want
    assert told(stiffarm.diagnose("kuka_kr240", dict(campaign))) == want


def test_arrays_of_two_dimensions(campaign, want):
    names, load = [f"q{k}[rad]" for k in range(1, 7)], ["fz[N]", "mx[Nm]", "my[Nm]"]
    joints = numpy.column_stack([campaign[name] for name in names])
    loads = numpy.zeros((campaign.rows, 6))
    loads[:, 2:5] = numpy.column_stack([campaign[name] for name in load])
    rest = {name: column for name, column in campaign.items() if name not in (*names, *load)}
    assert told(stiffarm.diagnose("kuka_kr240", {"q": joints, "wrench": loads, **rest})) == want


def test_pandas_and_polars_and_arrow(campaign, want):
    pandas, polars, pyarrow = (pytest.importorskip(name) for name in ("pandas", "polars", "pyarrow"))
    frames = [campaign.to_pandas(), campaign.to_polars(), pyarrow.table(dict(campaign))]
    # In pieces, and from some row on: offsets and several batches.
    frames.append(polars.concat([frames[1][:5], frames[1][5:]], rechunk=False))
    frames.append(pyarrow.concat_tables([frames[2].slice(0, 7), frames[2].slice(7)]))
    for frame in frames:
        assert told(stiffarm.diagnose("kuka_kr240", frame)) == want
    assert isinstance(frames[0], pandas.DataFrame)


def test_pandas_without_pyarrow(campaign, want, monkeypatch):
    pytest.importorskip("pandas")
    frame = campaign.to_pandas()
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    assert told(stiffarm.diagnose("kuka_kr240", frame)) == want


def test_duckdb(campaign, want):
    duckdb = pytest.importorskip("duckdb")
    pytest.importorskip("pyarrow")
    frame = campaign.to_pandas()
    assert len(frame) == campaign.rows
    assert told(stiffarm.diagnose("kuka_kr240", duckdb.sql("select * from frame"))) == want
    # What it has typed as decimals are numbers too.
    from stiffarm import arrow

    assert arrow.columns(duckdb.sql("select * from (values (1.25, 3), (null, 4), (-0.1, 5)) t(x, k)")) == {"x": [1.25, None, -0.1], "k": [3, 4, 5]}


def test_arrow_types():
    pyarrow = pytest.importorskip("pyarrow")
    polars = pytest.importorskip("polars")
    from stiffarm import arrow

    columns = {
        "number": [1.5, None, -2.0, 4.0],
        "whole": pyarrow.array([1, 2, None, 4], pyarrow.int16()),
        "truth": [True, False, None, True],
        "text": ["a", None, "of more than twelve bytes, ä", ""],
        "large": pyarrow.array(["x", "yy", None, "z"], pyarrow.large_string()),
        "chosen": pyarrow.array(["p", "q", "p", None]).dictionary_encode(),
        "nothing": pyarrow.nulls(4),
        "exact": pyarrow.array([decimal.Decimal("-1.50"), None, decimal.Decimal("0.25"), decimal.Decimal(7)], pyarrow.decimal128(9, 2)),
    }
    table = pyarrow.table(columns)
    # A decimal is equal to the double that is as large.
    want = table.to_pydict()
    assert arrow.columns(table) == want
    assert arrow.columns(table.slice(1, 2)) == table.slice(1, 2).to_pydict()
    frame = polars.DataFrame({"text": want["text"], "number": want["number"]})
    assert arrow.columns(frame) == frame.to_dict(as_series=False)
    with pytest.raises(TypeError, match="Arrow's type"):
        arrow.columns(pyarrow.table({"lists": [[0]]}))


def test_arrow_times_are_seconds():
    pyarrow = pytest.importorskip("pyarrow")
    from stiffarm import arrow

    moment, day = datetime.datetime(2026, 1, 2, 3, 4, 5, 250000, datetime.timezone.utc), datetime.date(2026, 1, 2)
    seconds = moment.timestamp()
    kinds = {unit: pyarrow.timestamp(unit) for unit in ("s", "ms", "us", "ns")}
    kinds["zone"] = pyarrow.timestamp("us", tz="Europe/Vienna")
    times = {name: pyarrow.array([moment, None], kind) for name, kind in kinds.items() if name != "s"}
    table = pyarrow.table({
        **times,
        "s": pyarrow.array([moment.replace(microsecond=0), None], kinds["s"]),
        "day": pyarrow.array([day, None], pyarrow.date32()),
        "date": pyarrow.array([day, None], pyarrow.date64()),
        "clock": pyarrow.array([datetime.time(0, 1, 0, 500000), None], pyarrow.time32("ms")),
        "fine": pyarrow.array([datetime.time(0, 1, 0, 500000), None], pyarrow.time64("us")),
        "took": pyarrow.array([datetime.timedelta(milliseconds=1500), None], pyarrow.duration("ms")),
    })  # fmt: skip
    found = {name: cells[0] for name, cells in arrow.columns(table).items() if cells[1] is None}
    midnight = datetime.datetime(2026, 1, 2, tzinfo=datetime.timezone.utc).timestamp()
    want = {name: seconds for name in times} | {"s": seconds - 0.25, "day": midnight, "date": midnight}
    assert found == want | {"clock": 60.5, "fine": 60.5, "took": 1.5}
    assert arrow.columns(table.slice(1, 1))["clock"] == [None]


def test_what_is_no_frame():
    with pytest.raises(TypeError, match="expected a path, a dictionary of arrays"):
        stiffarm.diagnose("ur5", 5)
    with pytest.raises(ValueError, match="several lengths"):
        stiffarm.diagnose("ur5", {"q1": [1.0, 2.0], "x": [1.0]})
    with pytest.raises(ValueError, match="found the shape"):
        stiffarm.diagnose("ur5", {"x": numpy.zeros((3, 2))})


def test_what_is_not_finite_is_told(campaign, caplog):
    columns = {name: list(column) for name, column in campaign.items()}
    columns["x[m]"][4] = float("nan")
    found = stiffarm.diagnose("kuka_kr240", columns)
    assert found.measurements == campaign.rows - 1
    assert "left out" in caplog.text
    columns["x[m]"] = [float("nan")] * campaign.rows
    with pytest.raises(stiffarm.Error):
        stiffarm.diagnose("kuka_kr240", columns)


def test_mistakes_are_at_their_cells(campaign):
    columns = {**campaign, "q1[rad]": ["much"] * campaign.rows}
    with pytest.raises(stiffarm.Error) as caught:
        stiffarm.diagnose("kuka_kr240", columns)
    _, _, file, line, _ = caught.value.mistakes[0]
    assert (file, line) == ("<data>", 2)


@pytest.fixture(scope="module")
def motion():
    """A log of a UR10 whose second joint is braked."""
    return stiffarm.simulate("ur10", effects=["coulomb_friction@joint 2=9"], log=stiffarm.Log(runs=1, rate=100, period=12.0), seed=2)


def test_logs_from_frames(motion, tmp_path):
    pandas, polars, pyarrow = (pytest.importorskip(name) for name in ("pandas", "polars", "pyarrow"))
    path = tmp_path / "log.csv"
    # What its comments say is said beside.
    path.write_text("".join(line for line in motion.csv.splitlines(keepends=True) if not line.startswith("#")), encoding="utf-8")
    effects = {"effects": ["coulomb_friction", "viscous_friction"], "torque_side": "motor"}
    first = stiffarm.diagnose("ur10", path, **effects)
    assert [(one.effect, one.place) for one in first.findings] == [("coulomb_friction", "joint 2")]
    low, high = first.findings[0].parameters[0].ci95
    assert low < 9.0 < high
    want = told(first)
    joints = {name: numpy.column_stack([motion[f"{name}{k}"] for k in range(1, 7)]) for name in ("q", "tau")}
    rest = {name: column for name, column in motion.items() if name.split("[")[0].rstrip("123456") not in joints}
    frames = [dict(motion), {**rest, **joints}, motion.to_pandas(), motion.to_polars(), pyarrow.table(dict(motion))]
    assert isinstance(frames[2], pandas.DataFrame) and isinstance(frames[3], polars.DataFrame)
    for frame in frames:
        assert told(stiffarm.diagnose("ur10", frame, **effects)) == want


def test_runs_of_one_log(motion):
    again = stiffarm.simulate("ur10", effects=["coulomb_friction@joint 2=9"], log=stiffarm.Log(runs=1, rate=100, period=12.0), seed=5)
    found = stiffarm.diagnose("ur10", [dict(motion), dict(again)], effects=["coulomb_friction"], torque_side="motor")
    assert found.findings[0].place == "joint 2"
