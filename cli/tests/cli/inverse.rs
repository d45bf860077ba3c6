//! `stiffarm eval --pose`.

use crate::support::{has, list, number, numbers, stiffarm};

/// Position and rotation of the tool at joint values.
fn pose(robot: &str, q: &str, more: &[&str]) -> Vec<f64> {
    let arguments = [&["eval", robot, "--q", q, "--json", "-"], more].concat();
    let at = stiffarm(&arguments).json();
    list(&at["rotation"]).iter().chain([&at["position"]]).flat_map(numbers).collect()
}

fn solutions(robot: &str, at: &str, more: &[&str]) -> Vec<serde_json::Value> {
    let arguments = [&["eval", robot, "--pose", at, "--json", "-"], more].concat();
    list(&stiffarm(&arguments).json()["solutions"]).to_vec()
}

/// Every branch of a table with a closed form and of one that is near it stands at the pose; they differ.
#[test]
fn every_branch_stands_at_the_pose() {
    let calibrated = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/data/calibrated_ur10.toml");
    let sides = ["--sides", "1,1,-1,1,1,1"];
    for (robot, at, more) in [
        ("kuka_kr240", "1.6,0.2,1.1,0,90deg,0", &[][..]),
        (calibrated, "0.6,0.2,0.4,0,90deg,0", &sides),
    ] {
        let found = solutions(robot, at, more);
        assert_eq!(found.len(), 8);
        let (mut first, mut seen) = (None, Vec::new());
        for branch in found.iter().filter(|branch| branch["reached"] == true) {
            let q: Vec<String> = list(&branch["q"]).iter().map(ToString::to_string).collect();
            let q = q.join(",");
            let stands = pose(robot, &q, more);
            let expected = first.get_or_insert_with(|| stands.clone());
            let off = stands.iter().zip(expected).map(|(a, b)| (a - *b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-9, "{robot} {branch} {off:e}");
            let number = |key: &str| branch[key].as_u64().expect("a number");
            assert_eq!(
                number("branch"),
                4 * number("shoulder") + 2 * number("elbow") + number("wrist")
            );
            seen.push(q);
        }
        seen.sort();
        seen.dedup();
        assert_eq!(seen.len(), 8, "{seen:?}");
        let x: f64 = at.split(',').next().and_then(|x| x.parse().ok()).expect("a number");
        assert!((first.expect("a branch")[9] - x).abs() < 1e-9);
    }
}

/// Of seven joints every branch keeps the one that is given; fewer joints, and prismatic ones, have the branches that they have.
#[test]
fn arms_of_other_joints_stand_at_the_pose() {
    let q = "0.1,0.2,0.3,-1.5,0.2,1.6,0.4";
    for (robot, q, count, wrist) in [
        ("panda", q, 8, true),
        ("iiwa14", q, 8, true),
        ("stanford", "0.1,0.2,0.5,0.3,0.7,0.2", 8, true),
        ("bicchi_3r", "0.1,0.2,0.3", 2, false),
    ] {
        let stands = pose(robot, q, &[]);
        let rotation = nalgebra::Matrix3::from_row_slice(&stands[..9]);
        let turn = nalgebra::UnitQuaternion::from_matrix(&rotation).scaled_axis();
        let at: Vec<String> =
            stands[9..].iter().chain(turn.iter()).map(|x| format!("{x:?}")).collect();
        let found = solutions(robot, &at.join(","), &["--q", q]);
        assert_eq!(found.len(), count, "{robot}");
        let given: Vec<f64> = q.split(',').map(|x| x.parse().expect("a number")).collect();
        let reached: Vec<_> = found.iter().filter(|branch| branch["reached"] == true).collect();
        let off = |branch: &&&serde_json::Value| {
            let values = numbers(&branch["q"]);
            values.iter().zip(&given).all(|(q, x)| (q - x).abs() < 1e-6)
        };
        assert!(reached.iter().any(|branch| off(&branch)), "{robot}: {found:?}");
        if given.len() == 7 {
            assert!(found.iter().all(|branch| branch["q"][6].as_f64() == Some(given[6])));
        }
        let screen = stiffarm(&["eval", robot, "--pose", &at.join(","), "--q", q]).good();
        assert_eq!(screen.contains("wrist"), wrist, "{screen}");
    }
}

/// Limits and whole turns; a load moves set-points; what is out of reach says by how much.
#[test]
fn limits_turns_and_reach_are_told() {
    let found = solutions("kuka_kr240", "1.6,0.2,1.1,0,90deg,0", &[]);
    let within = |branch: &&serde_json::Value| branch["within_limits"] == true;
    assert_eq!(found.iter().filter(within).count(), 6);
    let wrist = found.iter().find(within).expect("a branch")["turns"][3].clone();
    assert_eq!(wrist.as_array().map(Vec::len), Some(2), "{wrist}");
    let loaded = solutions("kuka_kr240", "1.6,0.2,1.1,0,90deg,0", &["--wrench", "0,0,-2000,0,0,0"]);
    let by = |k: usize| (number(&loaded[k]["q"][1]) - number(&found[k]["q"][1])).abs();
    assert!((0..8).any(|k| by(k) > 1e-4));
    let screen = stiffarm(&["eval", "ur5", "--pose", "3,0,0.3,0,90deg,0"]).good();
    has(&screen, &["0 of 8 branches reach the pose", " mm, "]);
}
