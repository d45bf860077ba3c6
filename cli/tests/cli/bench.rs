//! `--bench`: postures planned for sockets, and a camera's pixels, from the plan or the simulation to the diagnosis.

use serde_json::Value;

use crate::support::{Folder, has, list, number, read, run, stiffarm};

const SOCKETS: &str = "
[[point]]
name = \"left\"
at = [0.35, 0.2, 0.2]
[[point]]
name = \"right\"
at = [\"350 mm\", \"-200 mm\", 0.25]
[[plane]]
name = \"table\"
normal = [0, 0, 1]
offset = \"-10 mm\"
";

const CAMERA: &str = "
[[camera]]
name = \"left\"
matrix = [[1210, 0, 640], [0, 1190, 355], [0, 0, 1]]
distortion = [-0.21, 0.07, 0.001, -0.002, 0.01]
[[board]]
name = \"charuco\"
corners = { c0 = [0, 0, 0], c1 = [\"90 mm\", 0, 0], c2 = [0, \"90 mm\", 0], c3 = [\"90 mm\", \"90 mm\", 0] }
";

#[test]
fn a_plan_at_sockets_is_measured_and_diagnosed() {
    let folder = Folder::new();
    let bench = folder.file("bench.toml", SOCKETS);
    let [plan, data] = ["plan.csv", "run.csv"].map(|name| folder.name(name));
    let postures = "poses irb120 --for diagnose --count 24";
    let screen = run(&format!("{postures} --bench {bench} --csv {plan}")).good();
    assert!(screen.contains("24 postures"), "{screen}");
    let written = read(&plan);
    has(&written, &["point,plane", ",left,", ",,table"]);
    let effect = "joint_offset@joint 3=3e-3";
    stiffarm(&["simulate", "irb120", &plan, "--bench", &bench, "--effect", effect, "--csv", &data])
        .good();
    let found = run(&format!("diagnose irb120 {data} --bench {bench} --json -")).json();
    let named = |finding: &Value| {
        let is = |one: &Value| one["effect"] == "joint_offset" && one["place"] == "joint 3";
        is(finding) || finding["alternatives"].as_array().is_some_and(|all| all.iter().any(is))
    };
    assert!(list(&found["findings"]).iter().any(named), "{found}");
}

#[test]
fn a_camera_finds_a_soft_joint_and_tells_it_in_pixels() {
    let folder = Folder::new();
    let (bench, data) = (folder.file("bench.toml", CAMERA), folder.name("run.csv"));
    let shown = "--measure camera --payload 3kg --noise-rotation 0.2px";
    let effect = "--effect 'joint_compliance@joint 2=8e-5'";
    run(&format!("simulate irb120 {shown} --csv {data} --bench {bench} {effect}")).good();
    let found = run(&format!("diagnose irb120 {data} --bench {bench} --json -")).json();
    let [finding] = list(&found["findings"]) else { panic!("{found}") };
    assert!(finding["effect"] == "joint_compliance" && finding["place"] == "joint 2", "{finding}");
    let [low, high] = [0, 1].map(|k| number(&finding["parameters"][0]["ci95"][k]));
    assert!(low < 8e-5 && 8e-5 < high, "{low} {high}");
    let left = &found["gap"]["after"]["kinds"]["camera"];
    let rms = number(&left["rms"]);
    assert!(left["unit"] == "px" && (0.25..0.32).contains(&rms), "{left}");
    let screen = run(&format!("diagnose irb120 {data} --bench {bench}")).good();
    assert!(screen.contains("px rms") && screen.contains("Error in the picture"), "{screen}");
    let told = run(&format!("diagnose irb120 {data}")).refused();
    assert!(told.contains("the unknown marker `c0`"), "{told}");
}
