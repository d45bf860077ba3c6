//! `stiffarm compensate`.

use nalgebra::Vector6;

use crate::support::{Folder, Table, arm, read, stands, stiffarm};

const LOAD: &str = "0,0,-2kN,0,0,0";

/// Poses of the unloaded KR 240-2 at some postures, in mm and degrees.
fn targets(extra: &str) -> String {
    let arm = arm("kuka_kr240");
    let mut rows = "pose,x[mm],y[mm],z[mm],rx[deg],ry[deg],rz[deg]\n".to_owned();
    for k in 0..6 {
        let turn = f64::from(k) / 10.0;
        let q = [turn - 0.2, 1.1 + turn / 2.0, -1.8 + turn, 0.3, 0.9 - turn, 0.2];
        let pose = arm.pose(&q);
        let (p, r) = (pose.translation.vector * 1e3, pose.rotation.scaled_axis());
        let r = r.map(f64::to_degrees);
        rows.push_str(&format!("p{k},{},{},{},{},{},{}\n", p.x, p.y, p.z, r.x, r.y, r.z));
    }
    rows + extra
}

/// The set-points are put into the simulator: the loaded tool stands at the targets.
#[test]
fn the_loaded_arm_stands_at_the_targets() {
    let folder = Folder::new();
    let (file, out) = (folder.file("path.csv", targets("")), folder.name("out.csv"));
    let arguments = ["compensate", "kuka_kr240", "--targets", &file, "--wrench", LOAD, "--out"];
    let screen = stiffarm(&[&arguments[..], &[&out]].concat()).good();
    assert!(screen.contains("reached  6 of 6"), "{screen}");
    let csv = read(&out);
    let table = Table::of(&csv);
    assert_eq!(table.column("pose"), ["p0", "p1", "p2", "p3", "p4", "p5"]);
    assert!(table.column("status").iter().all(|status| *status == "reached"), "{csv}");
    assert!(!csv.contains(",-0.000000"), "{csv}");
    let arm = arm("kuka_kr240");
    let joints: Vec<Vec<f64>> = (1..=6).map(|j| table.numbers(&format!("q{j}[deg]"))).collect();
    let place = ["x[mm]", "y[mm]", "z[mm]"].map(|name| table.numbers(name));
    let load = Vector6::new(0.0, 0.0, -2000.0, 0.0, 0.0, 0.0);
    for row in 0..6 {
        let q: Vec<f64> = joints.iter().map(|values| values[row].to_radians()).collect();
        let tool = stands(&arm, &q, &load);
        for k in 0..3 {
            // To a micrometre, and the digits written.
            assert!((1e3 * tool[k] - place[k][row]).abs() < 1.1e-3, "{row} {tool} {csv}");
        }
        assert!((0.01..20.0).contains(&table.numbers("before[mm]")[row]), "{csv}");
        assert!(table.numbers("error_rotation[mrad]")[row] <= 1e-3);
    }
    let printed = stiffarm(&[&arguments[..], &["-"]].concat()).good();
    assert_eq!(printed, csv);
}

#[test]
fn what_is_not_reached_is_marked_and_kept() {
    let folder = Folder::new();
    let file = folder.file("path.csv", targets("far,9000,0,0,0,0,0\n"));
    let out = folder.name("out.csv");
    let arguments = ["compensate", "kuka_kr240", "--targets", &file, "--out", &out];
    let run = stiffarm(&[&arguments[..], &["--starts", "4", "--wrench", LOAD]].concat()).ended(1);
    assert!(run.err.contains("1 of 7 targets are not reached"), "{}", run.err);
    assert!(run.out.contains("line 8: nearest") && run.out.contains("mm away"), "{}", run.out);
    let csv = read(&out);
    let table = Table::of(&csv);
    let status = table.column("status");
    assert!(status[..6].iter().all(|s| *s == "reached") && status[6].starts_with("nearest"));
    assert!(table.numbers("error[mm]")[6] > 5000.0, "{csv}");
    stiffarm(&[&arguments[..], &["--wrench", "0,0,-1e12,0,0,0"]].concat()).ended(1);
    let csv = read(&out);
    let table = Table::of(&csv);
    assert!(table.column("status").iter().all(|s| *s == "unstable"), "{csv}");
    assert!(table.column("q1[deg]").iter().all(|s| s.is_empty()), "{csv}");
}

/// Starts and loads of each row; positions alone.
#[test]
fn rows_may_have_starts_and_loads_of_their_own() {
    let folder = Folder::new();
    let rows = "q1,q2,q3,q4,q5,q6,fz[kN],x,y,z\n0.1,1.2,-1.7,0,0.5,0,-2,1.7,0.2,0.9\n\
                0.1,1.2,-1.7,0,0.5,0,0,1.7,0.2,0.9\n";
    let file = folder.file("path.csv", rows);
    let arguments = ["compensate", "kuka_kr240", "--targets", &file, "--out", "-"];
    let csv = stiffarm(&arguments).good();
    let before = Table::of(&csv).numbers("before[mm]");
    assert!(before[0] > 0.1 && before[1] < 2e-3, "{csv}");
    assert!(!csv.contains("rotation"), "{csv}");
    let err = stiffarm(&[&arguments[..], &["--wrench", LOAD]].concat()).refused();
    assert!(err.contains("has loads of its own"), "{err}");
}

#[test]
fn a_rigid_arm_is_remarked_on() {
    let folder = Folder::new();
    let file = folder.file("path.csv", "x,y,z\n0.4,0.2,0.3\n");
    let run = stiffarm(&["compensate", "ur5", "--targets", &file, "--out", "-"]).ended(0);
    assert!(run.err.contains("nothing in the robot file gives way"), "{}", run.err);
}

#[test]
fn targets_in_millimetres_that_say_metres_are_doubted() {
    let folder = Folder::new();
    let file = folder.file("path.csv", targets("").replace("[mm]", ""));
    let run =
        stiffarm(&["compensate", "kuka_kr240", "--targets", &file, "--starts", "1", "--out", "-"])
            .ended(1);
    assert!(run.err.contains("is it millimetres? write x[mm]"), "{}", run.err);
}
