"""Every function gives what the command line gives."""

import json

import pytest
import stiffarm

LIN = ["lin_planar", "robots/data/lin1991_table3.csv"]
WORKBENCH = ["docs/workbench/arm.toml", "docs/workbench/run.csv"]


def test_diagnose(cli, at_root):
    want = cli("diagnose", *LIN, "--rival", "ycd", "--rival", "ytd", "--json", "-")
    found = stiffarm.diagnose(*LIN, rivals=["ycd", "ytd"])
    assert found.to_json() == want
    assert found.to_dict() == json.loads(want)
    assert str(found) == cli("diagnose", *LIN, "--rival", "ycd", "--rival", "ytd")


def test_the_page(cli, at_root, tmp_path, monkeypatch):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "0")
    cli("diagnose", *LIN, "--report", tmp_path / "page.html")
    want = (tmp_path / "page.html").read_text(encoding="utf-8")
    found = stiffarm.diagnose(*LIN).to_html(tmp_path / "ours.html")
    assert (tmp_path / "ours.html").read_text(encoding="utf-8") == found
    # The command that made it stands on it.
    words = f"diagnose {' '.join(LIN)}"
    assert words in found and found == want.replace(f"{words} --report {tmp_path / 'page.html'}", words)


def test_the_corrected_arm(cli, at_root, tmp_path):
    names = {"robot": "better.toml", "mjcf": "better.xml", "urdf": "better.urdf"}
    written = [f"--write-{kind}={tmp_path / name}" for kind, name in names.items()]
    cli("diagnose", *WORKBENCH, "--nuisance", "base_frame,tool_frame", *written)
    found = stiffarm.diagnose(*WORKBENCH, nuisance=["base_frame", "tool_frame"])
    texts = {"robot": found.corrected.toml, "mjcf": found.to_mjcf(), "urdf": found.to_urdf(tmp_path / "ours.urdf")}
    assert texts == {kind: (tmp_path / name).read_text(encoding="utf-8") for kind, name in names.items()}
    assert (tmp_path / "ours.urdf").read_text(encoding="utf-8") == texts["urdf"]


def test_an_earlier_diagnosis(cli, at_root, tmp_path):
    (tmp_path / "last.json").write_text(cli("diagnose", *LIN, "--json", "-"), encoding="utf-8")
    want = json.loads(cli("diagnose", *LIN, "--compare", tmp_path / "last.json", "--accept", "0.1mm", "--json", "-"))
    for last in (tmp_path / "last.json", stiffarm.diagnose(*LIN)):
        found = stiffarm.diagnose(*LIN, compare=last, accept=1e-4).to_dict()
        assert found.accept == want["accept"]
        assert {**found.compared, "file": ""} == {**want["compared"], "file": ""}
    assert found.corrected == want["corrected"]


def test_a_diagnosis_is_an_arm(cli, at_root, tmp_path):
    found = stiffarm.diagnose(*LIN)
    (tmp_path / "found.json").write_text(found.to_json(), encoding="utf-8")
    arm = stiffarm.Arm.load(tmp_path / "found.json")
    assert arm.toml == found.corrected.toml
    want = json.loads(cli("eval", tmp_path / "found.json", "--q", "0.1,0.2", "--json", "-"))
    assert abs(arm.pose([0.1, 0.2])[:3, 3] - want["position"]).max() < 1e-15


def test_identify(cli, at_root, tmp_path):
    out = tmp_path / "springs.toml"
    want = json.loads(cli("identify", *WORKBENCH, "--json", "-", "--write-robot", out))
    found = stiffarm.identify(*WORKBENCH)
    assert found.to_dict() == want
    assert found.corrected.toml == out.read_text(encoding="utf-8")
    assert str(found) == cli("identify", *WORKBENCH)
    assert found.parameters == want["parameters"]
    assert found.to_html().startswith("<!doctype html>")


def test_poses(cli):
    words = ["kuka_kr240", "--count", "6", "--load", "0,0,-2000.0,0,0,0", "--csv", "-"]
    found = stiffarm.poses("kuka_kr240", 6, loads=[(0, 0, -2000, 0, 0, 0)])
    assert found.csv == cli("poses", *words)
    pair = ["joint_compliance@joint 2", "link_compliance@link 2"]
    loads = ["0,0,-2kN,0,0,0", "0,1kN,0,0,0,0"]
    words = ["--count", "4", "--for", "separate", *(f"--load={load}" for load in loads), "--csv", "-"]
    assert stiffarm.poses("kuka_kr240", 4, purpose="separate", effects=pair, loads=loads).csv == cli("poses", "kuka_kr240", *pair, *words)


def test_simulate(cli):
    words = ["--effect", "backlash@joint 2=0.3 mrad", "--poses", "8", "--payload", "5kg", "--seed", "2", "--csv", "-"]
    found = stiffarm.simulate("ur5", effects=["backlash@joint 2=0.3 mrad"], poses=8, payload=5.0, seed=2)
    assert found.csv == cli("simulate", "ur5", *words)
    assert found["x"].shape == (found.rows,) and found.comments


def test_logs(cli, tmp_path):
    words = ["--effect", "coulomb_friction@joint 2=9", "--runs", "1", "--rate", "100Hz", "--period", "5s", "--max-rate", "1.2"]
    log = stiffarm.Log(runs=1, rate=100, period=5.0, max_rate=1.2)
    found = stiffarm.simulate("ur10", effects=["coulomb_friction@joint 2=9"], log=log)
    assert found.csv == cli("simulate", "ur10", *words, "--log", "-")
    assert found["tau2"].shape == (found.rows,)
    motion = ["--for", "motion", "--period", "4s", "--harmonics", "3", "--csv", "-"]
    assert stiffarm.poses("ur10", motion=stiffarm.Motion(period=4.0, harmonics=3)).csv == cli("poses", "ur10", *motion)
    words = ["ur10", "--motion", "--cases", "2", "--effects", "coulomb_friction", "--runs", "2", "--rate", "50Hz", "--period", "5s"]
    found = stiffarm.withhold("ur10", cases=2, effects=["coulomb_friction"], log=stiffarm.Log(runs=2, rate=50, period=5.0))
    assert found.to_dict() == json.loads(cli("withhold", *words, "--json", "-"))


def test_eval(cli):
    q, load = [0.3, -1.1, 1.4, -0.2, 0.7, 0.5], [30.0, -20.0, -200.0, 3.0, 1.0, -2.0]
    words = ["kuka_kr240", "--q", ",".join(map(str, q)), "--wrench", ",".join(map(str, load)), "--gravity"]
    found = stiffarm.eval("kuka_kr240", q, load, gravity=True)
    assert found.to_dict() == json.loads(cli("eval", *words, "--json", "-"))
    assert str(found) == cli("eval", *words)
    assert stiffarm.eval("ur5", "30deg,-90deg,90deg,0,0,0").position == stiffarm.eval("ur5", "30deg,-90deg,90deg,0deg,0,0rad").position


def test_check(cli):
    found = stiffarm.check("ur5", count=30, seed=4)
    assert found.agrees is True
    assert found.to_dict() == json.loads(cli("check", "ur5", "--count", "30", "--seed", "4", "--json", "-"))
    assert str(found) == cli("check", "ur5", "--count", "30", "--seed", "4")
    assert {robot.robot for robot in stiffarm.check(count=1).robots} == set(stiffarm.robots())


def test_map(cli, tmp_path):
    words = ["kuka_kr240", "--over", "q2,q3", "--of", "deflection", "--at", "q4=0.5,q5=45deg", "--wrench", "0,0,-500,0,0,0", "--steps", "9"]
    found = stiffarm.map("kuka_kr240", ("q2", "q3"), "deflection", at={"q4": 0.5, "q5": "45deg"}, wrench=[0, 0, -500, 0, 0, 0], steps=9)
    assert found.csv == cli("map", *words, "--csv", "-")
    assert found._repr_svg_() == cli("map", *words, "--svg", "-")
    assert found.rows == 81


def test_predict(cli, at_root, tmp_path):
    words = [WORKBENCH[0].replace("arm.toml", "arm_identified.toml"), WORKBENCH[1]]
    found = stiffarm.predict(*words)
    assert found.to_dict() == json.loads(cli("predict", *words, "--json", "-"))
    assert found.table.csv == cli("predict", *words, "--csv", "-")
    assert str(found) == cli("predict", *words)
    assert found.table.rows == found.rows


def test_effects(cli):
    assert stiffarm.effects() == json.loads(cli("effects", "--json"))
    # Its laws at rest and in motion.
    at_rest, in_motion = stiffarm.effects("backlash")
    for law in (at_rest, in_motion):
        assert law.effect == "backlash" and law.numbers


def test_withhold(cli):
    words = ["ur5", "--cases", "4", "--effects", "joint_compliance", "--poses", "10"]
    found = stiffarm.withhold("ur5", cases=4, effects=["joint_compliance"], poses=10)
    assert found.to_dict() == json.loads(cli("withhold", *words, "--json", "-"))
    assert found._repr_html_().startswith("<iframe")


def test_compensate(cli, at_root):
    words = ["docs/workbench/arm_identified.toml", "--targets", "docs/workbench/path.csv", "--wrench", "0,0,-200.0,0,0,0"]
    found = stiffarm.compensate(words[0], "docs/workbench/path.csv", wrench=[0, 0, -200, 0, 0, 0])
    # One target is out of reach.
    assert found.csv == cli("compensate", *words, "--out", "-", status=1)
    assert found["status"].count("reached") == found.rows - 1


OFFSET = '\n[[effect]]\nid = "joint_offset"\nplace = "joint 2"\noffset = 5e-4\n'

SCRIPT = b"""def pick(): # \xe4
  set_tcp(p[0, 0, 0.12, 0, 0, 0])
  movej(p[0.55, -0.3, 0.35, 0, 3.1416, 0], a=1.4)
  movel(pose_trans(feature, p[0.1, 0, 0.2, 0, 3.1416, 0]), a=1.2)
end
"""


def test_compensate_program(cli, tmp_path):
    nominal = stiffarm.Arm.load("ur10")
    (tmp_path / "real.toml").write_text(nominal.toml + OFFSET, encoding="utf-8")
    # Two arms of one name, and neither is on disk.
    real = stiffarm.Arm.from_toml(nominal.toml + OFFSET)
    script, out, moves = (tmp_path / name for name in ("pick.script", "out.script", "moves.csv"))
    script.write_bytes(SCRIPT)
    home = "-0.9,-1.6,-1.9,-1.2,1.57,0.0"
    words = ["compensate", tmp_path / "real.toml", "--program", script, "--nominal", "ur10", "--frame", "feature=0.5,-0.4,0.1,0,0,0"]
    screen = cli(*words, "--home", home, "--out", out, "--moves", moves)
    found = stiffarm.compensate_program(
        real, script, stiffarm.Arm.from_toml(nominal.toml), frames={"feature": [0.5, -0.4, 0.1, 0, 0, 0]},
        home=[float(q) for q in home.split(",")],
    )
    assert found.files == {"pick.script": out.read_bytes()} and b"\xe4" in found.files["pick.script"] != SCRIPT
    assert found.moves.csv == moves.read_text(encoding="utf-8")
    assert found.complete and str(found) == screen
    with pytest.raises(stiffarm.Error, match="feature"):
        stiffarm.compensate_program(real, script, "ur10", home=[0.0] * 6)
    # Of several files each has its name.
    points, path = tmp_path / "weld.dat", tmp_path / "weld.src"
    points.write_text("DEFDAT weld\nDECL E6POS XP1={X 700,Y -200,Z 500,A 0,B 90,C 0}\nENDDAT\n", encoding="utf-8")
    path.write_text("DEF weld()\n$BASE=$NULLFRAME\nLIN XP1\nEND\n", encoding="utf-8")
    both = stiffarm.compensate_program(real, [path, points], "ur10", tools={"default": "robot"}, home=[-0.5, -1.6, 1.9, -0.2, 1.57, 0.1])
    assert sorted(both.files) == ["weld.dat", "weld.src"] and both.complete
    assert both.files["weld.src"] == path.read_bytes() != both.files["weld.dat"] != points.read_bytes()


def test_controller(cli, tmp_path):
    real = stiffarm.Arm.from_toml(stiffarm.Arm.load("ur10").toml + OFFSET)
    (tmp_path / "real.toml").write_text(real.toml, encoding="utf-8")
    for options in ({"format": "ur-calibration", "nominal": "ur10"}, {"format": "ur-kinematics", "hash": "calib_1"}):
        words = [f"--{name}={value}" for name, value in options.items()]
        assert stiffarm.controller(real, **options) == cli("controller", tmp_path / "real.toml", *words).encode()
    # The bytes of a file are its own.
    own, out = tmp_path / "machine.dat", tmp_path / "new.dat"
    own.write_bytes(b"; \xe4\r\n$MAMES[2]=-90.0\r\n")
    cli("controller", tmp_path / "real.toml", "--format=kuka-mastering", "--nominal=ur10", f"--into={own}", f"--out={out}")
    assert stiffarm.controller(real, "kuka-mastering", nominal="ur10", into=own) == out.read_bytes()
    assert b"\xe4" in out.read_bytes()
    with pytest.raises(stiffarm.Error, match="--nominal"):
        stiffarm.controller(real, "ur-calibration")


@pytest.mark.parametrize("emit", ["rust", "latex", "dot", "urdf", "mjcf"])
def test_generate(cli, emit):
    (text,) = stiffarm.generate("ur5", emit).values()
    assert text == cli("generate", "ur5", "--emit", emit)


def test_generate_c(cli, tmp_path):
    cli("generate", "ur5", "--emit", "c", "--precision", "f32", "--out", tmp_path)
    found = stiffarm.generate("ur5", "c", precision="f32")
    assert found == {path.name: path.read_text(encoding="utf-8") for path in tmp_path.iterdir()}


def test_papers(cli):
    assert stiffarm.papers() == json.loads(cli("papers", "--json"))


def test_import_urdf(cli, at_root):
    path = "tests/data/urdf/ur5.urdf"
    want = cli("import", path, "--base", "base_link", "--tip", "tool0")
    assert stiffarm.import_urdf(path, base="base_link", tip="tool0").toml == want
    with open(path, encoding="utf-8") as file:
        text = file.read()
    assert stiffarm.import_urdf(text, base="base_link", tip="tool0").toml == want.replace(path, "<urdf>")


def test_measurements(cli, at_root):
    words = ["docs/workbench/raw.txt", "--map", "docs/workbench/map.toml"]
    found = stiffarm.measurements(words[0], map=words[2])
    assert found.csv == cli("measurements", *words)


def test_mistakes_read_alike(at_root, stiffarm_program):
    import subprocess

    words = ["diagnose", "ur5", LIN[1]]
    told = subprocess.run([stiffarm_program, *words], capture_output=True, text=True, check=False).stderr
    with pytest.raises(stiffarm.Error) as caught:
        stiffarm.diagnose(*words[1:])
    assert told.strip() == f"error: {caught.value}"
    assert caught.value.mistakes[0][2:] == (LIN[1], 6, caught.value.mistakes[0][4])
