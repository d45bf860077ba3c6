//! `stiffarm check`.

use crate::support::{Folder, stiffarm};

#[test]
fn a_robot_agrees_in_both_precisions() {
    let out = stiffarm(&["check", "kuka_kr240", "--count", "50"]).good();
    assert!(out.starts_with("KUKA KR 240-2  6R, modified, derived graph: 50 postures"), "{out}");
    assert!(out.ends_with("✓ all agree\n"), "{out}");
    let jacobian = out.lines().find(|l| l.trim_start().starts_with("jacobian ")).expect("a line");
    let cells: Vec<&str> = jacobian.split_whitespace().collect();
    assert_eq!(cells.len(), 5, "{jacobian}");
    for (cell, limit) in cells[1..].iter().zip([1e-12, 2e-6, 1e-7, 1e-12]) {
        let deviation: f64 = cell.parse().expect("a number");
        assert!(deviation > 0.0 && deviation <= limit, "{jacobian}");
    }
    assert_eq!(out.lines().filter(|l| l.starts_with("  ")).count(), 17, "{out}");
}

#[test]
fn a_file_is_checked_by_its_graph() {
    let arguments = ["check", "robots/arms/stanford.toml", "--count", "20"];
    let out = stiffarm(&arguments).good();
    assert!(out.contains("2R1P3R, standard, derived graph: 20 postures"), "{out}");
    assert!(out.ends_with("✓ all agree\n"), "{out}");
    assert_eq!(stiffarm(&arguments).good(), out);
    let other = stiffarm(&[&arguments[..], &["--seed", "1"]].concat()).good();
    assert_ne!(other, out);
}

#[test]
fn deviations_are_json() {
    let out = stiffarm(&["check", "ur10", "--count", "20", "--json", "-"]).good();
    let told = crate::support::json(&out);
    assert_eq!((&told["count"], &told["seed"]), (&20.into(), &0.into()));
    let robot = &told["robots"][0];
    assert_eq!((&robot["robot"], &robot["agrees"]), (&"ur10".into(), &true.into()));
    for (comparison, limit) in told["limits"].as_object().expect("limits") {
        let deviation = robot["outputs"]["jacobian"][comparison].as_f64().expect("a number");
        assert!(deviation > 0.0 && deviation <= limit.as_f64().expect("a number"), "{out}");
    }
}

#[test]
fn all_robots_have_a_line_each() {
    let out = stiffarm(&["check", "--all", "--count", "4"]).good();
    for arm in stiffarm_robots::ARMS {
        assert_eq!(
            out.lines().filter(|l| l.starts_with(&format!("  {} ", arm.id))).count(),
            1,
            "{out}"
        );
    }
    assert!(out.contains("✓ all agree\n"), "{out}");
}

/// What a posture takes grows with the cube of the joints: 10,000 · (8/40)³.
#[test]
fn of_many_joints_fewer_postures_are_checked() {
    let folder = Folder::new();
    let joint = "[[joint]]\ntype = \"revolute\"\na = 0.1\nalpha = \"pi/2\"\nstiffness = 1e5\n";
    let head = "name = \"snake\"\nconvention = \"standard\"\noutputs = [\"jacobian\"]\n";
    let file = folder.file("snake.toml", head.to_owned() + &joint.repeat(40));
    let out = stiffarm(&["check", &file]).good();
    assert!(out.contains("derived graph: 80 postures"), "{out}");
}

#[test]
fn odd_arms_agree_too() {
    let folder = Folder::new();
    let robot = r#"
        name = "odd"
        convention = "modified"
        [[joint]]
        type = "prismatic"
        theta = 0.3
        a = 0.2
        alpha = "-37 deg"
        stiffness = 2e5
        mass = 4.0
        com = [0.1, 0.2, 0.3]
        [[joint]]
        type = "revolute"
        d = 0.4
        a = -0.3
        alpha = 1.0
        stiffness = 3e4
        mass = 2.0
        limits = [5.0, 6.0]
        [joint.beam]
        youngs_modulus = 69e9
        shear_modulus = 26e9
        section = { shape = "tube", outer_diameter = 0.1, inner_diameter = 0.09 }
        density = 2700.0
        [tool]
        translation = [0.1, 0.2, 0.3]
        rotation = [0.4, -2.0, 1.0]
    "#;
    let file = folder.file("odd.toml", robot);
    let out = stiffarm(&["check", &file, "--count", "100"]).good();
    assert!(out.ends_with("✓ all agree\n"), "{out}");
}

#[test]
fn what_is_not_stable_is_left_out_and_said() {
    let folder = Folder::new();
    let robot = r#"
        name = "pendulum on its head"
        convention = "standard"
        [[joint]]
        type = "revolute"
        a = 1.0
        alpha = "pi/2"
        stiffness = 5.0
        mass = 1.0
    "#;
    // About a level axis: at some postures the weight is more than the spring can hold.
    let robot = robot.replace("alpha = \"pi/2\"", "") + "\n";
    let robot = robot.replace("convention", "gravity = [0.0, -9.81, 0.0]\nconvention");
    let file = folder.file("pendulum.toml", robot);
    let out = stiffarm(&["check", &file, "--count", "100"]).good();
    assert!(out.contains("left out: "), "{out}");
    assert!(out.ends_with("✓ all agree\n"), "{out}");
}
