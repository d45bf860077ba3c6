//! Arms with a closed form: those of the collection, and random ones of each family.

use nalgebra::{Isometry3, Matrix3, Translation3, UnitQuaternion, Vector3};
use stiffarm_codegen::derive::{Program, inverse};
use stiffarm_codegen::expr::{Expr, Symbol};
use stiffarm_codegen::robot::{Frame, Robot, Value};
use stiffarm_draws::Draws;
use stiffarm_kernels::generic;

/// An arm, its closed form as a graph, and the reference implementation of its forward kinematics.
pub struct Arm {
    pub name: String,
    pub robot: Robot,
    program: Program,
    pub reference: generic::Arm,
}

/// A branch as the graph has it.
pub struct Branch {
    pub q: Vec<f64>,
    pub distance: f64,
    pub tilt: f64,
}

impl Arm {
    pub fn new(robot: &Robot) -> Arm {
        let form = robot.closed_form().unwrap_or_else(|no| panic!("{}: {no:?}", robot.name));
        let program = inverse(robot, form);
        let (name, robot) = (robot.name.clone(), robot.clone());
        Arm { name, program, reference: reference(&robot), robot }
    }

    pub fn pose(&self, q: &[f64]) -> Isometry3<f64> {
        self.reference.pose(q)
    }

    /// All branches at a pose, near joint values.
    pub fn branches(&self, pose: &Isometry3<f64>, near: &[f64]) -> Vec<Branch> {
        let rotation = pose.rotation.to_rotation_matrix();
        let target: Vec<f64> =
            rotation.matrix().iter().chain(pose.translation.vector.iter()).copied().collect();
        let value = |symbol: &Symbol| match symbol {
            Symbol::Own { entry, .. } => target[*entry],
            Symbol::Joint(joint) => near[*joint],
            other => panic!("{other:?}"),
        };
        let entries: Vec<Expr> =
            self.program.blocks.iter().flat_map(|b| b.entries.clone()).collect();
        let values = self.program.graph.evaluate(&entries, value);
        let (q, rest) = values.split_at(48);
        let (distances, tilts) = rest.split_at(8);
        let each = q.chunks(6).zip(distances).zip(tilts);
        each.map(|((q, d), t)| Branch { q: q.to_vec(), distance: *d, tilt: *t }).collect()
    }

    /// Length of the arm, to which distances compare.
    pub fn size(&self) -> f64 {
        let lengths = self.reference.joints.iter().map(|joint| joint.a.abs() + joint.d.abs());
        lengths.sum::<f64>() + self.reference.tool.translation.vector.norm()
    }
}

fn number(value: &Value) -> f64 {
    value.number().expect("a number").to_f64()
}

fn isometry(frame: &Frame) -> Isometry3<f64> {
    let rotation = frame.rotation.each_ref().map(|angle| angle.radians().expect("a number"));
    Isometry3::from_parts(
        Translation3::from(frame.translation.each_ref().map(number)),
        UnitQuaternion::from_scaled_axis(Vector3::from(rotation)),
    )
}

pub fn reference(robot: &Robot) -> generic::Arm {
    let joints = robot.joints.iter().map(|row| generic::Joint {
        motion: row.motion,
        theta: row.theta.radians().expect("a number"),
        d: number(&row.d),
        a: number(&row.a),
        alpha: row.alpha.radians().expect("a number"),
        beta: row.beta.radians().expect("a number"),
        compliance: 0.0,
        mass: 0.0,
        com: Vector3::zeros(),
        inertia: Matrix3::zeros(),
        drive: generic::Drive::default(),
        limits: None,
        beam: None,
    });
    generic::Arm {
        name: robot.name.clone(),
        convention: robot.convention,
        joints: joints.collect(),
        base: isometry(&robot.base),
        tool: isometry(&robot.tool),
        tool_rotation_vector: Vector3::zeros(),
        gravity: Vector3::zeros(),
    }
}

/// Those of the collection that have a closed form.
pub fn collection() -> Vec<Arm> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../robots/arms");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .expect("the folder")
        .map(|file| file.expect("a file").path())
        .collect();
    files.sort();
    let robots = files.iter().map(|path| {
        let text = std::fs::read_to_string(path).expect("the file");
        Robot::from_toml(&text, "arm.toml").expect("the file is valid").0
    });
    let closed = robots.filter(|robot| robot.closed_form().is_ok() && robot.symbols().is_empty());
    closed.map(|robot| Arm::new(&robot)).collect()
}

/// What a family's rows are: `0` is zero, `a` a length, `r` a right angle, `x` any angle, `p` 0 or π. Of a row a, alpha, d.
pub const FAMILIES: [(&str, [&str; 6]); 12] = [
    ("second parallel to third", ["ara", "apa", "ara", "0ra", "0r0", "ara"]),
    ("second parallel to third, oblique", ["axa", "apa", "axa", "0xa", "0x0", "axa"]),
    ("second parallel to third, no shoulder", ["0ra", "ap0", "0ra", "0ra", "0r0", "00a"]),
    ("first meets second", ["0ra", "ara", "ara", "0ra", "0r0", "ara"]),
    ("first meets second, oblique", ["0xa", "axa", "axa", "0xa", "0x0", "axa"]),
    ("first parallel to second", ["apa", "ara", "axa", "0ra", "0r0", "ara"]),
    ("second meets third", ["ara", "0ra", "ara", "0ra", "0r0", "ara"]),
    ("second meets third, oblique", ["axa", "0xa", "axa", "0xa", "0x0", "axa"]),
    ("three parallel", ["0ra", "apa", "apa", "0ra", "0ra", "00a"]),
    ("three parallel, oblique", ["axa", "apa", "apa", "axa", "0xa", "axa"]),
    ("spherical shoulder", ["0ra", "0r0", "ara", "apa", "ara", "ara"]),
    ("three parallel behind", ["0ra", "ara", "apa", "apa", "ara", "ara"]),
];

/// A random arm of a family, in either convention.
pub fn random((name, rows): (&str, [&str; 6]), draws: &mut Draws) -> Arm {
    let modified = draws.chance(0.5);
    let mut texts: Vec<[String; 4]> = Vec::new();
    for row in rows {
        let signed = |draws: &mut Draws, low, high| {
            format!("{:.4}", draws.between(low, high) * if draws.chance(0.5) { 1.0 } else { -1.0 })
        };
        let mut cell = |kind: char| match kind {
            '0' => "0".to_owned(),
            'a' => signed(draws, 0.1, 0.9),
            'r' => (if draws.chance(0.5) { "\"pi/2\"" } else { "\"-pi/2\"" }).to_owned(),
            'p' => (if draws.chance(0.5) { "\"pi\"" } else { "0" }).to_owned(),
            _ => signed(draws, 0.5, 2.6),
        };
        let cells: Vec<String> = row.chars().map(&mut cell).collect();
        let [a, alpha, d] = cells.try_into().expect("three cells");
        let theta = match (draws.part() * 4.0) as u32 {
            0 => "\"pi/2\"".to_owned(),
            1 => "\"pi\"".to_owned(),
            2 => format!("{:.4}", draws.unit()),
            _ => "0".to_owned(),
        };
        texts.push([a, alpha, d, theta]);
    }
    if modified {
        // Row k of the modified convention begins with what ends row k − 1 of the standard one.
        let links: Vec<[String; 2]> =
            texts.iter().map(|[a, alpha, ..]| [a.clone(), alpha.clone()]).collect();
        for (k, text) in texts.iter_mut().enumerate() {
            let [a, alpha] = &links[(k + 5) % 6];
            (text[0], text[1]) = (a.clone(), alpha.clone());
        }
    }
    let rows: Vec<String> = texts
        .iter()
        .map(|[a, alpha, d, theta]| {
            format!("{{ type = \"revolute\", theta = {theta}, a = {a}, alpha = {alpha}, d = {d} }}")
        })
        .collect();
    let convention = if modified { "modified" } else { "standard" };
    let mut frame = || {
        let numbers: Vec<String> = (0..6).map(|_| format!("{:.3}", draws.unit())).collect();
        format!(
            "{{ translation = [{}], rotation = [{}] }}",
            numbers[..3].join(", "),
            numbers[3..].join(", ")
        )
    };
    let (base, tool) = (frame(), frame());
    let text = format!(
        "name = \"{name}\"\nconvention = \"{convention}\"\nbase = {base}\ntool = {tool}\njoint = [\n{}\n]\n",
        rows.join(",\n")
    );
    let robot = Robot::from_toml(&text, "arm.toml").unwrap_or_else(|e| panic!("{e:?}\n{text}")).0;
    let mut arm = Arm::new(&robot);
    arm.name = text;
    arm
}
