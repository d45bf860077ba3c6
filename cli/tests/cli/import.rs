//! `stiffarm import`.

use crate::support::{Folder, has, numbers, read, stiffarm};

#[test]
fn the_robot_file_can_be_used_at_once() {
    let folder = Folder::new();
    let out = folder.name("panda.toml");
    let run = stiffarm(&["import", "tests/data/urdf/panda.urdf", "--toml", &out]);
    assert_eq!((run.status, run.out.as_str()), (0, ""));
    assert!(run.err.starts_with("note: forward kinematics as in the URDF to "), "{}", run.err);
    let toml = read(&out);
    assert!(toml.starts_with("# Imported by stiffarm from tests/data/urdf/panda.urdf"), "{toml}");
    let printed = stiffarm(&["--quiet", "import", "tests/data/urdf/panda.urdf"]).good();
    assert_eq!(printed, toml);
    let q = "0.1,-0.2,0.3,-1.4,0.5,1.6,0.7";
    let evaluated =
        |robot: &str| stiffarm(&["eval", robot, "--q", q, "--gravity", "--json", "-"]).json();
    let (ours, built_in) = (evaluated(&out), evaluated("panda"));
    for key in ["position", "joint_torque"] {
        for (a, b) in numbers(&ours[key]).iter().zip(numbers(&built_in[key])) {
            assert!((a - b).abs() < 1e-12, "{key}: {a} is not {b}");
        }
    }
}

#[test]
fn what_a_user_must_know_is_said_and_written() {
    let arguments = ["import", "tests/data/urdf/oblique.urdf", "--tip", "needle"];
    let run = stiffarm(&arguments).ended(0);
    for said in [
        "`[base]` says where axis 1 stands in link `floor`",
        "left out: link `grip_left` and what hangs on it, 0.1 kg",
    ] {
        assert!(run.err.contains(said), "no `{said}` in\n{}", run.err);
        assert!(run.out.contains(said), "no `{said}` in\n{}", run.out);
    }
    assert!(run.out.contains("\n[base]\n"), "{}", run.out);
    let quiet = stiffarm(&[&["--quiet"], &arguments[..]].concat()).good();
    assert_eq!(quiet, run.out);
}

const ARM: &str = r#"<robot name="a"><link name="l0"/><link name="l1"/><link name="l2"/>
<joint name="j1" type="revolute">
  <parent link="l0"/><child link="l1"/><axis xyz="0 0 1"/>
  <limit lower="-1" upper="1" effort="1" velocity="1"/>
</joint>
<joint name="j2" type="revolute">
  <origin xyz="0.5 0 0" rpy="1.5708 0 0"/>
  <parent link="l1"/><child link="l2"/><axis xyz="0 0 1"/>
  <limit lower="-1" upper="1" effort="1" velocity="1"/>
</joint></robot>"#;

#[test]
fn a_deep_file_is_refused() {
    let folder = Folder::new();
    let deep = format!("<robot>{}{}</robot>", "<a>".repeat(1 << 18), "</a>".repeat(1 << 18));
    let err = stiffarm(&["import", &folder.file("arm.urdf", deep)]).refused();
    assert!(err.contains("found no links"), "{err}");
}

/// The common normal of axes that are parallel but for a billionth of a radian is a million kilometres away.
#[test]
fn axes_that_are_nearly_parallel_have_beta() {
    let folder = Folder::new();
    let nearly = ARM.replace("rpy=\"1.5708 0 0\"", "rpy=\"1e-9 3e-10 0\" ");
    let nearly = nearly.replace("xyz=\"0.5 0 0\"", "xyz=\"0.5 0.1 0\"");
    let toml = stiffarm(&["--quiet", "import", &folder.file("arm.urdf", nearly)]).good();
    let mut d = toml.lines().filter_map(|line| line.strip_prefix("d = ")?.parse::<f64>().ok());
    assert!(toml.contains("beta = ") && d.all(|d| d.abs() < 1e-9), "{toml}");
}

/// Wherever a robot file is expected, a URDF is read as `import` reads it.
#[test]
fn a_urdf_is_a_robot() {
    let folder = Folder::new();
    let file = folder.file("arm.urdf", ARM);
    let toml = folder.file("arm.toml", stiffarm(&["--quiet", "import", &file]).good());
    let eval = |robot: &str| stiffarm(&["eval", robot, "--q", "0.3,-0.2", "--json", "-"]);
    let run = eval(&file);
    assert_eq!(run.out, eval(&toml).out, "{}", run.err);
    has(&run.err, &["read as pi/2", "as in the URDF to"]);
}
