//! `stiffarm compensate --program`: the arm as it is stands where the program meant.

use nalgebra::{Isometry3, Quaternion, Rotation3, Translation3, UnitQuaternion, Vector3};
use stiffarm_kernels::generic::Arm;

use crate::support::{Folder, arm, read, stiffarm};

/// Offsets of joints of the arm as it is, rad.
const OFFSETS: [f64; 6] = [0.0, 8e-4, -1.1e-3, 5e-4, 9e-4, 0.0];

/// A robot file of the collection with these offsets, and the arm.
fn real(id: &str, more: &str) -> (String, Arm) {
    let mut text = read(&format!("robots/arms/{id}.toml"));
    let mut real = arm(id);
    for (k, offset) in OFFSETS.iter().enumerate().filter(|(_, offset)| **offset != 0.0) {
        let place = format!("place = \"joint {}\"", k + 1);
        text.push_str(&format!(
            "\n[[effect]]\nid = \"joint_offset\"\n{place}\noffset = {offset}\n"
        ));
        real.joints[k].theta += offset;
    }
    (text + more, real)
}

fn moved(x: f64, y: f64, z: f64) -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::new(x, y, z), UnitQuaternion::identity())
}

/// Every number of a text.
fn numbers(text: &str) -> Vec<f64> {
    let parts = text.split(|c: char| !(c.is_ascii_digit() || "+-.eE".contains(c)));
    parts.filter_map(|part| part.parse().ok()).collect()
}

/// Columns of the table of moves: the joint values, rad.
fn joints(csv: &str) -> Vec<Vec<f64>> {
    let rows = csv.lines().skip(1).filter(|row| row.ends_with(",moved"));
    let row =
        |row: &str| row.split(',').skip(5).take(6).map(|x| x.parse::<f64>().unwrap()).collect();
    rows.map(row).map(|row: Vec<f64>| row.iter().map(|q| q.to_radians()).collect()).collect()
}

/// How a language writes a pose, and where frame and tool of the test's program are.
struct Language {
    robot: &'static str,
    file: &'static str,
    head: &'static str,
    tail: &'static str,
    /// A point with its numbers for `{}`, and configuration for `[]`.
    point: fn(usize, &Isometry3<f64>, &[f64]) -> String,
    /// The pose of the numbers behind the point's name.
    pose: fn(&[f64]) -> Isometry3<f64>,
    frame: Isometry3<f64>,
    tool: Isometry3<f64>,
    options: &'static [&'static str],
}

fn degrees(pose: &Isometry3<f64>) -> (Vector3<f64>, [f64; 3]) {
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    (pose.translation.vector * 1e3, [roll, pitch, yaw].map(f64::to_degrees))
}

fn of_degrees(n: &[f64], roll: f64, pitch: f64, yaw: f64) -> Isometry3<f64> {
    let [roll, pitch, yaw] = [roll, pitch, yaw].map(f64::to_radians);
    let turned = Rotation3::from_euler_angles(roll, pitch, yaw);
    let origin = Vector3::new(n[0], n[1], n[2]) / 1e3;
    Isometry3::from_parts(origin.into(), UnitQuaternion::from_rotation_matrix(&turned))
}

fn languages() -> [Language; 4] {
    [
        Language {
            robot: "kuka_kr240",
            file: "cell.src",
            head: "&ACCESS RVP\nDEF CELL()\nBAS(#BASE,2) ; caf\u{e9}\n$TOOL={X 10,Y 0,Z 150,A 0,B 0,C 0}\n",
            tail: "END\n",
            point: |_, pose, q| {
                let (p, [roll, pitch, yaw]) = degrees(pose);
                let t: u32 = q.iter().enumerate().map(|(k, q)| u32::from(*q < 0.0) << k).sum();
                format!(
                    "PTP {{X {},Y {},Z {},A {yaw},B {pitch},C {roll},S 2,T {t},E1 0.0}} C_DIS\n",
                    p.x, p.y, p.z
                )
            },
            pose: |n| of_degrees(n, n[5], n[4], n[3]),
            frame: moved(0.5, -0.1, 0.2),
            tool: moved(0.01, 0.0, 0.15),
            options: &["--frame", "2={X 500, Y -100, Z 200, A 0, B 0, C 0}"],
        },
        Language {
            robot: "irb120",
            file: "cell.mod",
            head: "MODULE cell\nPERS wobjdata wT:=[FALSE,TRUE,\"\",[[100,0,0],[1,0,0,0]],[[0,20,0],[1,0,0,0]]];\n",
            tail: "ENDMODULE\n",
            point: |_, pose, q| {
                let (p, r) = (pose.translation.vector * 1e3, pose.rotation);
                let [a, b, c] = [0, 3, 5].map(|k| (q[k] / 90_f64.to_radians()).floor());
                format!(
                    "MoveL [[{},{},{}],[{},{},{},{}],[{a},{b},{c},0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,z10,tG\\WObj:=wT;\n",
                    p.x, p.y, p.z, r.w, r.i, r.j, r.k
                )
            },
            pose: |n| {
                let turned =
                    UnitQuaternion::from_quaternion(Quaternion::new(n[3], n[4], n[5], n[6]));
                Isometry3::from_parts((Vector3::new(n[0], n[1], n[2]) / 1e3).into(), turned)
            },
            frame: moved(0.1, 0.02, 0.0),
            tool: moved(0.0, 0.0, 0.1),
            options: &["--tool", "tG=[0,0,100],[1,0,0,0]"],
        },
        Language {
            robot: "fanuc_s420f",
            file: "cell.ls",
            head: "/PROG CELL\n/MN\n 1:L P[1] 100mm/sec FINE ;\n/POS\n",
            tail: "/END\n",
            point: |k, pose, q| {
                let (p, [w, pitch, r]) = degrees(pose);
                let pi = std::f64::consts::PI;
                let [a, b, c] = [0, 3, 5].map(|k| ((q[k] + pi) / (2.0 * pi)).floor());
                format!(
                    "P[{}]{{ GP1: UF : 1, UT : 2, CONFIG : 'N U T, {a}, {b}, {c}', X = {} mm, Y = {} mm, \
                     Z = {} mm, W = {w} deg, P = {pitch} deg, R = {r} deg }};\n",
                    k + 1,
                    p.x,
                    p.y,
                    p.z
                )
            },
            pose: |n| of_degrees(&n[7..], n[10], n[11], n[12]),
            frame: moved(0.0, 0.3, 0.0),
            tool: moved(0.0, 0.0, 0.0),
            options: &["--frame", "1=0,300,0,0,0,0", "--tool", "2=robot"],
        },
        Language {
            robot: "ur10",
            file: "cell.script",
            head: "def cell():\n  set_tcp(p[0, 0, 0.1, 0, 0, 0])\n",
            tail: "end\n",
            point: |_, pose, _| {
                let (p, r) = (pose.translation.vector, pose.rotation.scaled_axis());
                let p = [p.x, p.y, p.z, r.x, r.y, r.z].map(|x| x.to_string()).join(", ");
                format!("  movel(p[{p}], a=1.2, v=0.25) # p[1,2\n")
            },
            pose: |n| {
                Isometry3::new(Vector3::new(n[0], n[1], n[2]), Vector3::new(n[3], n[4], n[5]))
            },
            frame: Isometry3::identity(),
            tool: moved(0.0, 0.0, 0.1),
            options: &[],
        },
    ]
}

/// The joint values that the table of moves tells bring the arm as it is to the pose that the program had, and the
/// nominal arm to the pose that it has now. Everything but numbers is as it was.
#[test]
fn the_arm_as_it_is_stands_where_the_program_meant() {
    for of in languages() {
        let folder = Folder::new();
        let (text, real) = real(of.robot, "");
        let nominal = arm(of.robot);
        let robot = folder.file("real.toml", text);
        let q = |k: f64| match of.robot {
            "kuka_kr240" => [0.1 * k, 1.1 - 0.05 * k, -1.8, -0.3 + 0.3001 * k, 0.9, 0.2 * k],
            "ur10" => [0.1 * k, -1.1 - 0.05 * k, 1.4, -0.3, 0.9, 0.2 * k],
            _ => [0.1 * k - 0.1, 0.2, 0.3 - 0.1 * k, -0.3 + 0.3 * k, 0.6, 0.2 * k],
        };
        let all: Vec<[f64; 6]> = (0..4).map(|k| q(f64::from(k))).collect();
        let flange = |arm: &Arm, q: &[f64]| match of.file {
            // The tool is the robot file's.
            "cell.ls" => arm.pose(q),
            _ => arm.pose(q) * arm.tool.inverse(),
        };
        let (frame, tool) = (of.frame, of.tool);
        let says = |q: &[f64]| frame.inverse() * flange(&nominal, q) * tool;
        let points = all.iter().enumerate().map(|(k, q)| (of.point)(k, &says(q), q));
        let program = of.head.to_owned() + &points.collect::<String>() + of.tail;
        // In Latin-1: bytes that are no UTF-8 stay.
        let bytes: Vec<u8> = program.chars().map(|c| c as u8).collect();
        let path = folder.file(of.file, &bytes);
        let (out, moves) = (folder.name("out"), folder.name("moves.csv"));
        let home = all[0].map(|q| q.to_string()).join(",");
        let arguments = [
            "compensate",
            &robot,
            "--nominal",
            of.robot,
            "--program",
            &path,
            "--home",
            &home,
            "--out",
            &out,
            "--moves",
            &moves,
            "--tolerance",
            "0.01um",
        ];
        let run = stiffarm(&[&arguments[..], of.options].concat());
        assert_eq!((run.status, run.err.as_str()), (0, ""), "{}: {}", of.file, run.out);
        assert!(run.out.contains("moved  4 of 4"), "{}", run.out);
        let written = std::fs::read(&out).expect("written");
        let words = |text: &[u8]| -> Vec<u8> {
            text.iter().copied().filter(|b| !b.is_ascii_digit() && !b"+-.".contains(b)).collect()
        };
        assert_eq!(words(&written), words(&bytes), "{}", of.file);
        let found = joints(&std::fs::read_to_string(&moves).expect("written"));
        assert_eq!(found.len(), 4);
        let text: String = written.iter().map(|b| *b as char).collect();
        let heads = of.head.lines().count();
        for ((line, q), meant) in text.lines().skip(heads).zip(&found).zip(&all) {
            let off = |a: &Isometry3<f64>, b: &Isometry3<f64>| {
                (a.to_homogeneous() - b.to_homogeneous()).amax()
            };
            let stands = frame.inverse() * flange(&real, q) * tool;
            assert!(off(&stands, &says(meant)) < 1e-6, "{}: {line}", of.file);
            let told = (of.pose)(&numbers(line));
            assert!(off(&told, &says(q)) < 1e-6, "{}: {line}\n{told}\n{}", of.file, says(q));
            assert!(off(&told, &says(meant)) > 1e-4, "{}: {line}", of.file);
        }
    }
}

/// Joint points become the joint values themselves, of a table with any columns.
#[test]
fn joint_values_are_corrected_in_a_table() {
    let folder = Folder::new();
    let (text, real) = real("ur10", "");
    let robot = folder.file("real.toml", text);
    let table = "# by hand\nname,q1[deg],q2[deg],q3[deg],q4[deg],q5[deg],q6[deg]\n\"a, b\",10,-80,90,-20,60,5\n";
    let path = folder.file("joints.csv", table);
    let arguments = ["compensate", &robot, "--nominal", "ur10", "--program", &path, "--out", "-"];
    let run = stiffarm(&[&arguments[..], &["--quiet"]].concat()).ended(0);
    assert!(
        run.out.starts_with("# by hand\nname,q1[deg],q2[deg]")
            && run.out.contains("\n\"a, b\",10,-80.045"),
        "{}",
        run.out
    );
    let q: Vec<f64> =
        numbers(run.out.lines().nth(2).unwrap()).iter().map(|x| x.to_radians()).collect();
    let meant = [10.0_f64, -80.0, 90.0, -20.0, 60.0, 5.0].map(f64::to_radians);
    let off = real.pose(&q).to_homogeneous() - arm("ur10").pose(&meant).to_homogeneous();
    assert!(off.amax() < 2e-6, "{off}");
}

/// Backlash depends on from where the joints come, which the order of the points tells; the first needs `--home`.
#[test]
fn backlash_is_compensated_by_the_order_of_the_points() {
    let folder = Folder::new();
    let slack = "\n[[effect]]\nid = \"backlash\"\nplace = \"joint 1\"\nwidth = \"1 mrad\"\n";
    let robot = folder.file("real.toml", read("robots/arms/ur10.toml") + slack);
    let rows =
        "q1[deg],q2[deg],q3[deg],q4[deg],q5[deg],q6[deg]\n10,-80,90,-20,60,5\n5,-80,90,-20,60,5\n";
    let path = folder.file("joints.csv", rows);
    let arguments =
        ["compensate", &robot, "--nominal", "ur10", "--program", &path, "--out", "-", "--quiet"];
    let err = stiffarm(&arguments).refused();
    assert!(err.contains("the backlash at joint 1 depends on") && err.contains("--home"), "{err}");
    let out = stiffarm(&[&arguments[..], &["--home", "0,-80deg,90deg,-20deg,60deg,5deg"]].concat())
        .good();
    let first: Vec<f64> = out.lines().skip(1).map(|line| numbers(line)[0]).collect();
    let half = 0.5e-3_f64.to_degrees();
    // Coming from below the joint rests behind its reading.
    assert!((first[0] - 10.0 - half).abs() < 1e-5 && (first[1] - 5.0 + half).abs() < 1e-5, "{out}");
}
