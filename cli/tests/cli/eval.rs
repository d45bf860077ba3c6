//! `stiffarm eval`.

use serde_json::Value;
use stiffarm_kernels::Output;

use crate::support::{Folder, arm, list, number, read, run, stiffarm};

const KEYS: [&str; 7] =
    ["position", "rotation", "jacobian", "k_c", "compliance", "deflection", "joint_torque"];

fn json(arguments: &[&str]) -> Value {
    stiffarm(&[&["eval"], arguments, &["--json", "-"]].concat()).json()
}

/// Row by row, as the format has it, into one column-major block.
fn block(value: &Value) -> Vec<f64> {
    let row = |row: &Value| match row {
        Value::Array(row) => row.iter().map(number).collect(),
        row => vec![number(row)],
    };
    let rows: Vec<Vec<f64>> = list(value).iter().map(row).collect();
    (0..rows[0].len()).flat_map(|c| rows.iter().map(move |r| r[c]).collect::<Vec<_>>()).collect()
}

fn near(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let scale = expected.iter().fold(1e-30_f64, |m, x| m.max(x.abs()));
    for (f, e) in found.iter().zip(expected) {
        assert!((f - e).abs() <= 1e-12 * scale, "{what}: {f} is not {e}");
    }
}

/// Every key of the JSON against the textbook.
fn agrees(robot: &str, id: &str, q: &[f64], w: &[f64; 6], gravity: bool) {
    let arm = arm(id);
    let list = |x: &[f64]| x.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let (q_text, w_text) = (list(q), list(w));
    let mut arguments = vec![robot, "--q", &q_text, "--wrench", &w_text];
    arguments.extend(gravity.then_some("--gravity"));
    let found = json(&arguments);
    let keys: Vec<&String> = found.as_object().expect("an object").keys().collect();
    assert_eq!(keys, KEYS);
    let textbook = |output| arm.evaluate(output, q, w).expect("stable");
    let sum = |a: Output, b: Output| -> Vec<f64> {
        let weights = if gravity { 1.0 } else { 0.0 };
        textbook(a).iter().zip(textbook(b)).map(|(a, b)| a + weights * b).collect()
    };
    let pose = textbook(Output::Pose);
    let deflection = if gravity { Output::DeflectionWithGravity } else { Output::Deflection };
    near(&block(&found["position"]), &pose[9..], "position");
    near(&block(&found["rotation"]), &pose[..9], "rotation");
    near(&block(&found["jacobian"]), &textbook(Output::Jacobian), "jacobian");
    let k_c = sum(Output::ComplementaryStiffness, Output::WeightStiffness);
    near(&block(&found["k_c"]), &k_c, "k_c");
    near(&block(&found["compliance"]), &textbook(Output::Compliance), "compliance");
    near(&block(&found["deflection"]), &textbook(deflection), "deflection");
    let torque = sum(Output::JointTorque, Output::WeightTorque);
    near(&block(&found["joint_torque"]), &torque, "joint_torque");
}

#[test]
fn compiled_kernels_and_graphs_agree_with_the_textbook() {
    let w = [120.0, -80.0, -300.0, 12.0, -7.0, 5.0];
    let q = [0.3, -0.7, 1.1, -0.2, 0.9, 0.4];
    for gravity in [false, true] {
        for id in ["kuka_kr240", "puma560", "lin_elbow", "stanford"] {
            let load = w.map(|x| if id == "puma560" { x / 100.0 } else { x });
            agrees(id, id, &q, &load, gravity);
            agrees(&format!("robots/arms/{id}.toml"), id, &q, &load, gravity);
        }
        agrees("bicchi_5r", "bicchi_5r", &q[..5], &w.map(|x| x / 1e4), gravity);
    }
}

#[test]
fn values_may_have_units_and_signs() {
    let by_degrees =
        json(&["lin_planar", "--q", "-90deg, 500mrad", "--wrench", "0,-2lbf,0,0,0,3Nmm"]);
    let q = format!("{},0.5", -core::f64::consts::FRAC_PI_2);
    let by_si = json(&["lin_planar", "--q", &q, "--wrench", "0,-8.896443230521,0,0,0,3e-3"]);
    assert_eq!(by_degrees, by_si);
    json(&["stanford", "--q=-0.1,0,500mm,0,0,0"]);
}

#[test]
fn symbolic_parameters_take_numbers() {
    let all = "L1=24in L2=0.6096 E1=6.8948e10 E2=6.8948e10 G1=2.6e10 G2=2.6e10 A1=1e-3 A2=6e-4 I1=8e-7 I2=1.2e-7 \
               Iy1=8e-7 Iy2=1.2e-7 J1=1e-6 J2=2e-7 rho1=0 rho2=0";
    let set = all.split(' ').flat_map(|one| ["--set", one]);
    let found =
        json(&["lin_planar_symbolic", "--q", "0,0"].into_iter().chain(set).collect::<Vec<_>>());
    near(&block(&found["position"]), &[1.2192, 0.0, 0.0], "position");
}

#[test]
fn the_file_is_the_same_as_standard_output() {
    let folder = Folder::new();
    let out = folder.file("state.json", "what was there before");
    let arguments = ["eval", "ur5", "--q", "0.1,0.2,0.3,0.4,0.5,0.6"];
    let silent = stiffarm(&[&arguments[..], &["--json", &out]].concat()).good();
    assert_eq!(silent, "");
    let printed = stiffarm(&[&arguments[..], &["--json", "-"]].concat()).good();
    assert_eq!(read(&out), printed);
    assert_eq!(folder.names(), ["state.json"]);
    assert!(!printed.contains("-0.0,") && !printed.contains("-0.0]"), "{printed}");
}

#[cfg(unix)]
#[test]
fn a_new_file_is_readable_like_any_other() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = Folder::new();
    let (plain, ours) = (folder.file("plain", ""), folder.name("state.json"));
    run(&format!("eval jweeg_two_link --q 0,0 --set a1=1 --set a2=1 --json {ours}")).good();
    let mode = |path: &str| std::fs::metadata(path).expect("there").permissions().mode();
    assert_eq!(mode(&ours), mode(&plain));
}

#[test]
fn the_screen_shows_everything() {
    let out = stiffarm(&["eval", "ur5", "--q", "0,-90deg,90deg,0,90deg,0"]).good();
    for key in KEYS {
        assert!(out.lines().any(|line| line.starts_with(key)), "{key}: {out}");
    }
    assert!(out.starts_with("UR5  ur5 by the derived graph\n"), "{out}");
    assert!(!out.contains('\u{1b}') && !out.contains("  \n"), "{out}");
}
