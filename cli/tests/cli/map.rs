//! `stiffarm map`, and the maps of docs/maps.md.

use nalgebra::Vector6;

use crate::support::{Folder, Table, arm, arm_of, moved, number, read, stiffarm, words};

/// Every picture of the page is what its command prints.
#[test]
fn the_maps_of_the_page_are_those_of_the_commands() {
    let page = read("docs/maps.md");
    let folder = Folder::new();
    let mut maps = 0;
    for line in page.lines().filter_map(|line| line.strip_prefix("stiffarm ")) {
        let mut arguments = words(line);
        let at = arguments.iter().position(|a| a == "--svg").expect("a picture") + 1;
        let committed = arguments[at].clone();
        assert!(
            page.contains(&format!("({})", committed.trim_start_matches("docs/"))),
            "{committed}"
        );
        arguments[at] = folder.name("map.svg");
        let screen = stiffarm(&arguments).good();
        let is_kept = read(&arguments[at]) == read(&committed);
        assert!(is_kept, "{committed} is not what its command prints: print it anew");
        for line in screen.lines().filter(|line| line.contains("highest")) {
            assert!(page.contains(line.trim()), "no `{line}` on the page");
        }
        maps += 1;
    }
    assert_eq!(maps, 5);
}

fn csv(arguments: &[&str]) -> String {
    stiffarm(&[&["--quiet", "map"], arguments, &["--csv", "-"]].concat()).good()
}

/// Cells against the textbook.
#[test]
fn numbers_are_those_of_the_textbook() {
    let arm = arm("kuka_kr240");
    let w = Vector6::new(0.0, 300.0, -2000.0, 50.0, 0.0, 0.0);
    let load = "0,300,-2kN,50,0,0";
    let common = ["kuka_kr240", "--over", "q2,q3", "--at", "q1=0.1,q5=-30deg", "--steps", "4"];
    let map = |of: &str| csv(&[&common[..], &["--of", of, "--wrench", load]].concat());
    let (sag, stiffness, nu_p) = (map("deflection"), map("stiffness"), map("nu_p"));
    assert!(sag.starts_with("q2[deg],q3[deg],deflection[mm]\n"), "{sag}");
    assert!(stiffness.starts_with("q2[deg],q3[deg],stiffness[N/um]\n"), "{stiffness}");
    let [sag, stiffness, nu_p] = [sag, stiffness, nu_p].map(|csv| Table::of(&csv).all());
    assert_eq!((sag.len(), sag[1][0]), (16, 48.666666667));
    for ((sag, stiffness), nu_p) in sag.iter().zip(&stiffness).zip(&nu_p) {
        let q = [0.1, sag[0].to_radians(), sag[1].to_radians(), 0.0, -30_f64.to_radians(), 0.0];
        let moved = arm.deflection(&q, &w).expect("stable");
        let first = arm.deflection_first_order(&q, &w);
        let size = |v: &Vector6<f64>| v.fixed_rows::<3>(0).norm();
        let near = |found: f64, expected: f64, what: &str| {
            // The angles are written to a billionth of a degree.
            assert!((found - expected).abs() <= 1e-8 * expected.abs(), "{what} {found} {expected}");
        };
        near(sag[2], 1e3 * size(&moved), "deflection");
        let force = size(&w);
        let along = (moved[1] * 300.0 - moved[2] * 2000.0) / force;
        near(stiffness[2], 1e-6 * force / along, "stiffness");
        let change = 100.0 * (size(&moved) - size(&first)).abs() / size(&moved).max(size(&first));
        assert!((nu_p[2] - change).abs() < 1e-8, "{nu_p:?} {change}");
    }
}

/// The gap shrinks by what the corrected robot file moves, by the arm at rest of both files, and
/// what stays is about what the diagnosis leaves.
#[test]
fn shrink_is_that_of_the_corrected_file() {
    let folder = Folder::new();
    let better = folder.name("better.toml");
    let (robot, run) = ("docs/workbench/arm.toml", "docs/workbench/run.csv");
    let found = stiffarm(&["diagnose", robot, run, "--json", "-", "--write-robot", &better]).json();
    let after = number(&found["gap"]["after"]["position_rms"]);
    let arms = [robot, &better].map(|path| arm_of(&read(path)));
    let w = Vector6::new(0.0, 0.0, -2000.0, 0.0, 0.0, 0.0);
    let over =
        ["--over", "q2,q3", "--at", "q5=45deg", "--wrench", "0,0,-2kN,0,0,0", "--steps", "5"];
    let shrink = csv(&[&[robot, "--of", "shrink", "--data", run], &over[..]].concat());
    assert!(shrink.starts_with("q2[deg],q3[deg],shrink[%]\n"), "{shrink}");
    for cell in Table::of(&shrink).all() {
        let q = [0.0, cell[0].to_radians(), cell[1].to_radians(), 0.0, 45_f64.to_radians(), 0.0];
        let [was, is] = arms.each_ref().map(|arm| moved(arm, &q, &w));
        let moved = (is - was).norm();
        let expected = 100.0 * (1.0 - after / moved.hypot(after));
        // What is held out has the uncertainty of the fits in it: some per cent of what is left.
        assert!((cell[2] - expected).abs() < 3.0, "{cell:?} {expected}");
    }
}

#[test]
fn sliding_joints_and_free_ones_are_swept() {
    let arguments = ["stanford", "--over", "q3,q1", "--of", "condition", "--length", "0.5m"];
    let out = csv(&[&arguments[..], &["--steps", "3"]].concat());
    assert!(out.starts_with("q3[mm],q1[deg],condition\n304.8,-170,"), "{out}");
    let panda = csv(&["iiwa14", "--over", "q2,q4", "--of", "condition", "--steps", "2"]);
    assert_eq!(Table::of(&panda).rows.len(), 4);
}

/// Where the arm buckles the map is empty, and says so.
#[test]
fn unstable_cells_are_empty() {
    let folder = Folder::new();
    let svg = folder.name("map.svg");
    let robot = folder.file(
        "soft.toml",
        "name = \"soft <arm>\"\nconvention = \"standard\"\n\
         [[joint]]\ntype = \"revolute\"\na = 1.0\nstiffness = 100.0\nlimits = [-3, 3]\n\
         [[joint]]\ntype = \"revolute\"\na = 1.0\nstiffness = 100.0\n",
    );
    let arguments = ["map", &robot, "--over", "q1,q2", "--of", "deflection", "--steps", "20"];
    // A push toward the base on an arm that is stretched out.
    let screen =
        stiffarm(&[&arguments[..], &["--wrench", "-60,0,0,0,0,0", "--svg", &svg]].concat()).good();
    assert!(screen.contains("in which the arm is not stable under the load"), "{screen}");
    let picture = read(&svg);
    roxmltree::Document::parse(&picture).expect("well formed");
    assert!(picture.contains("soft &#60;arm&#62;") && !picture.contains("NaN"), "{picture}");
}
