//! `stiffarm controller`: a controller that reads the file stands where the arm is.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use crate::support::{Folder, arm, arm_of, read, stiffarm};

const Q: [f64; 6] = [0.3, -1.2, 1.4, 0.2, 0.7, -0.4];

/// A UR10 of which zeros, lengths and twists are off, and the arm.
fn real() -> (String, Arm) {
    let mut text = read("robots/arms/ur10.toml");
    let mut arm = arm("ur10");
    for (k, joint) in arm.joints.iter_mut().enumerate().take(5) {
        let off = 1e-3 * (1.0 + k as f64);
        // Of parallel axes a tilt stands in place of a shift along them.
        let tilted = [1, 2].contains(&k);
        let last = if tilted { &mut joint.beta } else { &mut joint.d };
        *last += 2.0 * off;
        joint.theta += off;
        joint.a -= off;
        joint.alpha += 3.0 * off;
        text.push_str(&format!(
            "\n[[effect]]\nid = \"joint_offset\"\nplace = \"joint {0}\"\noffset = {off}\n\
             [[effect]]\nid = \"link_geometry\"\nplace = \"link {0}\"\na = {1}\n{2} = {3}\nalpha = {4}\n",
            k + 1, -off, if tilted { "beta" } else { "d" }, 2.0 * off, 3.0 * off
        ));
    }
    (text, arm)
}

#[track_caller]
fn same(a: &Isometry3<f64>, b: &Isometry3<f64>) {
    assert!((a.to_homogeneous() - b.to_homogeneous()).amax() < 1e-12, "{a} {b}");
}

/// The sums of model and differences are the rows of the arm as it is.
#[test]
fn the_calibration_of_a_ur_is_its_table() {
    let folder = Folder::new();
    let (text, real) = real();
    let pose = real.pose(&Q);
    let file = folder.file("real.toml", text);
    let arguments = ["controller", &file, "--format", "ur-calibration", "--nominal", "ur10"];
    let written = stiffarm(&arguments).good();
    let lists: Vec<Vec<f64>> = written
        .lines()
        .filter_map(|line| line.split_once("= [")?.1.strip_suffix(']'))
        .map(|list| list.split(',').map(|x| x.trim().parse().expect("a number")).collect())
        .collect();
    let mut ur = arm("ur10");
    for (k, joint) in ur.joints.iter_mut().enumerate() {
        joint.theta += lists[0][k];
        joint.a += lists[1][k];
        joint.d += lists[2][k];
        joint.alpha += lists[3][k];
    }
    same(&ur.pose(&Q), &pose);
}

/// Place of an axis, turn about it, and so on, is the arm as it is.
#[test]
fn the_kinematics_file_is_the_arm() {
    let folder = Folder::new();
    let (text, real) = real();
    let pose = real.pose(&Q);
    let file = folder.file("real.toml", text);
    let arguments = ["controller", &file, "--format", "ur-kinematics", "--hash", "calib_1"];
    let written = stiffarm(&arguments).good();
    assert!(written.ends_with("  hash: calib_1\n"), "{written}");
    let values: Vec<f64> =
        written.lines().filter_map(|line| line.trim().split_once(": ")?.1.parse().ok()).collect();
    assert_eq!(values.len(), 36, "{written}");
    let joints = values.chunks(6).zip(Q).map(|(v, q)| {
        let place = UnitQuaternion::from_euler_angles(v[3], v[4], v[5]);
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), q);
        Isometry3::from_parts(Translation3::new(v[0], v[1], v[2]), place * turn)
    });
    same(&joints.fold(Isometry3::identity(), |chain, joint| chain * joint), &pose);
}

/// Place of an axis, turn about it or slide along it, and the tool at the end are the arm: of either convention.
#[test]
fn the_origins_of_xacro_are_the_arm() {
    let folder = Folder::new();
    let base = "\n[base]\ntranslation = [0.4, -0.3, 0.2]\nrotation = [0.1, -0.2, 0.3]\n";
    let built_in = |id: &str, more: &str| {
        let text = read(&format!("robots/arms/{id}.toml")) + more;
        let arm = arm_of(&text);
        (text, arm)
    };
    // Tilts of two parallel axes; a slide and a base; the other convention; a tool.
    let arms =
        [real(), built_in("stanford", base), built_in("kuka_kr240", ""), built_in("panda", "")];
    for (text, arm) in arms {
        let file = folder.file("arm.toml", &text);
        let written = stiffarm(&["controller", &file, "--format", "xacro", "--quiet"]).good();
        let lists =
            written.lines().filter_map(|line| line.split_once("value=\"")?.1.strip_suffix("\"/>"));
        let triple = |list: &str| -> [f64; 3] {
            let each: Vec<f64> = list.split(' ').map(|x| x.parse().expect("a number")).collect();
            each.try_into().expect("three numbers")
        };
        let values: Vec<[f64; 3]> = lists.map(triple).collect();
        assert_eq!(values.len(), 2 * (arm.dof() + 1), "{written}");
        let q: Vec<f64> = (0..arm.dof()).map(|k| Q[k % Q.len()]).collect();
        let mut chain = Isometry3::identity();
        for (k, place) in values.chunks(2).enumerate() {
            let [[x, y, z], [roll, pitch, yaw]] = [place[0], place[1]];
            let turn = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
            chain *= Isometry3::from_parts(Translation3::new(x, y, z), turn);
            match arm.joints.get(k).map(|joint| joint.motion) {
                Some(Motion::Revolute) => {
                    chain *= UnitQuaternion::from_axis_angle(&Vector3::z_axis(), q[k]);
                }
                Some(Motion::Prismatic) => chain *= Translation3::new(0.0, 0.0, q[k]),
                None => {}
            }
        }
        same(&chain, &arm.pose(&q));
    }
}
