//! `stiffarm poses`.

use crate::support::{Folder, Table, arm, list, moved, number, read, run, stands, stiffarm};

const PULLS: &str = "--load 0,0,-2kN,0,0,0 --load 1500,-1000,0,0,0,0";

/// A robot file whose last joint shows, and its plan.
fn plan(folder: &Folder, count: u8, extra: &str) -> (String, String, String) {
    let mut robot = read("robots/arms/kuka_kr240.toml");
    robot.push_str("\n[tool]\ntranslation = [0.1, 0.0, 0.15]\n");
    let robot = folder.file("arm.toml", robot);
    let csv = folder.name("plan.csv");
    let screen = run(&format!("poses {robot} --count {count} --csv {csv} {PULLS} {extra}")).good();
    (robot, read(&csv), screen)
}

/// The empty cells filled by simulating an arm with some softer springs, in the units of the header.
fn measured(plan: &str, softer: &[usize]) -> String {
    let mut arm = arm("kuka_kr240");
    arm.tool = nalgebra::Isometry3::translation(0.1, 0.0, 0.15);
    softer.iter().for_each(|joint| arm.joints[joint - 1].compliance *= 1.25);
    let table = Table::of(plan);
    let read = if table.names.contains(&"x[mm]") { stands } else { moved };
    let filled = table.filled(|_, q, load| {
        let at = read(&arm, q, load) * 1e3;
        [at.x, at.y, at.z].map(|x| format!("{x:.6}"))
    });
    format!("{}\n{filled}", table.remarks.join("\n"))
}

#[test]
fn a_plan_that_is_filled_in_identifies_the_springs() {
    let folder = Folder::new();
    for (purpose, rows) in [("identify", 8), ("diagnose", 16)] {
        let (robot, plan, screen) = plan(&folder, 8, &format!("--for {purpose}"));
        assert!(screen.contains("joint 6") && screen.contains("of the file's"), "{screen}");
        let empty: Vec<&str> = plan.lines().skip(2).collect();
        assert_eq!(empty.len(), rows, "{plan}");
        assert!(empty.iter().all(|row| row.ends_with(",,,")), "{plan}");
        let run = folder.file("run.csv", measured(&plan, &[1, 2, 3, 4, 5, 6]));
        let found = stiffarm(&["identify", &robot, &run, "--json", "-"]).json();
        for (parameter, joint) in list(&found["parameters"]).iter().zip(arm("kuka_kr240").joints) {
            let softer = number(&parameter["value"]) / joint.compliance;
            // Read to a nanometre.
            assert!((softer / 1.25 - 1.0).abs() < 1e-3, "{purpose}: {parameter}");
        }
    }
}

/// Measured as planned, the diagnosis names the one that is there and not the other.
#[test]
fn a_plan_that_separates_does() {
    let folder = Folder::new();
    let pair = "--for separate 'joint_compliance@joint 2' link_compliance@link2";
    let (robot, plan, screen) = plan(&folder, 12, pair);
    assert!(screen.contains("Told from the other") && screen.contains("µrad/(N·m)"), "{screen}");
    assert!(plan.contains(",dx[mm],dy[mm],dz[mm]\n") && !plan.contains("s1"), "{plan}");
    let run = folder.file("run.csv", measured(&plan, &[2]));
    let found = stiffarm(&["diagnose", &robot, &run, "--json", "-"]).json();
    let finding = &found["findings"][0];
    assert_eq!(finding["effect"], "joint_compliance", "{found}");
    assert_eq!(finding["place"], "joint 2", "{found}");
    let others = list(&finding["alternatives"]);
    let bending = |o: &&serde_json::Value| o["effect"] == "link_compliance";
    let at = others.iter().filter(bending).find(|o| o["place"] == "link 2").expect("tried");
    assert_eq!(at["separable"], true, "{others:?}");
}

/// What shows without a load is planned as poses, what depends on the side with sides.
#[test]
fn sides_are_planned_where_they_matter() {
    let arguments = ["poses", "ur10", "--count", "4", "--csv", "-", "--nuisance", "base_frame"];
    let pair = ["--for", "separate", "backlash@joint 2", "friction_hysteresis@joint 2"];
    let out = stiffarm(&[&arguments[..], &pair].concat()).good();
    assert!(out.contains("s1,s2,s3,s4,s5,s6,x[mm],y[mm],z[mm]\n"), "{out}");
    assert_eq!(out.lines().filter(|line| !line.starts_with('#')).count(), 9, "{out}");
}

#[test]
fn the_same_seed_gives_the_same_bytes() {
    let arguments = ["poses", "ur5", "--count", "3", "--rotations", "--csv", "-"];
    let first = stiffarm(&arguments).good();
    assert_eq!(stiffarm(&arguments).good(), first);
    let header = first.lines().nth(1).expect("a header");
    assert!(
        header.ends_with("fz[N],dx[mm],dy[mm],dz[mm],drx[mrad],dry[mrad],drz[mrad]"),
        "{first}"
    );
    let other = stiffarm(&[&arguments[..], &["--seed", "5"]].concat()).good();
    assert_ne!(first, other);
}

#[test]
fn sliding_joints_are_in_millimetres() {
    let out = stiffarm(&["poses", "stanford", "--count", "2", "--csv", "-"]).good();
    assert!(out.contains("q2[deg],q3[mm],q4[deg]"), "{out}");
}
