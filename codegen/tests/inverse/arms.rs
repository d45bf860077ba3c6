//! Arms with a closed form: those of the collection, and random ones of each family.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use stiffarm_codegen::derive::{Program, inverse};
use stiffarm_codegen::expr::{Expr, Symbol};
use stiffarm_codegen::robot::{ClosedForm, Frame, Motion, Robot, Value};
use stiffarm_draws::Draws;
use stiffarm_kernels::{Pose, generic};

/// An arm, its closed form as a graph, and the reference implementation of its forward kinematics.
pub struct Arm {
    pub name: String,
    pub robot: Robot,
    program: Program,
    pub reference: generic::Arm,
    pub form: ClosedForm,
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
        Arm { name, program, reference: reference(&robot), robot, form }
    }

    /// A random posture: angles up to half a turn, displacements up to a metre.
    pub fn posture(&self, draws: &mut Draws) -> Vec<f64> {
        let each = self.robot.joints.iter();
        each.map(|joint| match joint.motion {
            Motion::Revolute => draws.between(-3.1, 3.1),
            Motion::Prismatic => draws.unit(),
        })
        .collect()
    }

    /// Another posture with the joint that is given where this one has it.
    pub fn near(&self, q: &[f64], draws: &mut Draws) -> Vec<f64> {
        let mut near = self.posture(draws);
        if let Some(joint) = self.form.given {
            near[joint] = q[joint];
        }
        near
    }

    /// The arm that is left where the joint that is given stands as in a posture, and the other joints' values.
    pub fn inner(&self, q: &[f64]) -> (generic::Arm, Vec<f64>) {
        let (mut arm, mut rest) = (self.reference.clone(), q.to_vec());
        let Some(joint) = self.form.given else { return (arm, rest) };
        let value = rest.remove(joint);
        let frames = generic::Arm {
            joints: vec![arm.joints.remove(joint)],
            base: Isometry3::identity(),
            tool: Isometry3::identity(),
            ..arm.clone()
        };
        let there = frames.pose(&[value]);
        match joint {
            0 => arm.base *= there,
            _ => arm.tool = there * arm.tool,
        }
        (arm, rest)
    }

    pub fn pose(&self, q: &[f64]) -> Isometry3<f64> {
        self.reference.pose(q)
    }

    /// All branches at a pose, near joint values.
    pub fn branches(&self, pose: &Isometry3<f64>, near: &[f64]) -> Vec<Branch> {
        let target = Pose::from(*pose).columns();
        let value = |symbol: &Symbol| match symbol {
            Symbol::Own { entry, .. } => target.as_flattened()[*entry],
            Symbol::Joint(joint) => near[*joint],
            other => panic!("{other:?}"),
        };
        let entries: Vec<Expr> =
            self.program.blocks.iter().flat_map(|b| b.entries.clone()).collect();
        let values = self.program.graph.evaluate(&entries, value);
        let (n, count) = (self.robot.dof(), self.form.branches());
        let (q, rest) = values.split_at(n * count);
        let (distances, tilts) = rest.split_at(count);
        let each = q.chunks(n).zip(distances).zip(tilts);
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
        ..generic::Joint::default()
    });
    generic::Arm {
        name: robot.name.clone(),
        convention: robot.convention,
        joints: joints.collect(),
        base: isometry(&robot.base),
        tool: isometry(&robot.tool),
        ..generic::Arm::default()
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

/// The same of other joints than six that turn: a row that begins with `s` is that of a prismatic joint.
pub const OTHERS: [(&str, &[&str]); 41] = [
    ("PPP behind a wrist", &["0ra", "0r0", "axa", "saxa", "saxa", "sara"]),
    ("general", &["axa", "axa", "axa", "0xa", "0x0", "axa"]),
    ("general, at right angles", &["ara", "ara", "ara", "0ra", "0r0", "ara"]),
    ("general, reversed", &["0xa", "0x0", "axa", "axa", "axa", "axa"]),
    ("general, short", &["axa", "axa", "axa"]),
    ("shoulder, elbow and wrist of a Panda", &["0ra", "0r0", "ara", "ara", "0ra", "ara", "ara"]),
    ("spherical shoulder and wrist", &["0ra", "0r0", "0ra", "0r0", "0ra", "0r0", "ara"]),
    ("spherical shoulder and wrist, oblique", &["0xa", "0x0", "0xa", "0xa", "0xa", "0x0", "axa"]),
    ("on a rail", &["saxa", "ara", "apa", "ara", "0ra", "0r0", "ara"]),
    ("on a turntable", &["axa", "0ra", "ara", "ara", "0ra", "0r0", "ara"]),
    ("parallel axes on a turntable", &["axa", "0ra", "apa", "apa", "0ra", "0ra", "00a"]),
    ("PPP and a wrist", &["sara", "saxa", "saxa", "0ra", "0r0", "ara"]),
    ("RPP and a wrist", &["apa", "saxa", "sara", "0ra", "0r0", "ara"]),
    ("PPR and a wrist", &["sara", "saxa", "axa", "0ra", "0r0", "ara"]),
    ("PRP along", &["sapa", "axa", "sara", "0ra", "0r0", "ara"]),
    ("PRP across", &["saxa", "apa", "saxa", "0ra", "0r0", "ara"]),
    ("RRP meeting", &["0ra", "axa", "sara", "0ra", "0r0", "ara"]),
    ("RRP parallel", &["apa", "axa", "saxa", "0ra", "0x0", "ara"]),
    ("RPR along", &["apa", "sapa", "axa", "0ra", "0r0", "ara"]),
    ("RPR across", &["ara", "saxa", "axa", "0ra", "0r0", "ara"]),
    ("PRR along", &["sapa", "apa", "axa", "0ra", "0r0", "ara"]),
    ("PRR across", &["sara", "axa", "axa", "0ra", "0r0", "ara"]),
    ("a wrist of two", &["ara", "apa", "ara", "0xa", "axa"]),
    ("a wrist of two, meeting", &["0ra", "ara", "axa", "0ra", "axa"]),
    ("RRP and a wrist of two", &["0ra", "axa", "sara", "0ra", "axa"]),
    ("three parallel and a roll", &["ara", "apa", "apa", "ara", "axa"]),
    ("three parallel and an oblique roll", &["axa", "apa", "apa", "axa", "axa"]),
    ("a palletiser", &["ara", "apa", "apa", "axa"]),
    ("three parallel, the last a roll", &["apa", "apa", "axa", "axa"]),
    ("SCARA, RRRP", &["apa", "apa", "apa", "sapa"]),
    ("SCARA, RRPR", &["apa", "apa", "sapa", "apa"]),
    ("SCARA, RPRR", &["apa", "sapa", "apa", "apa"]),
    ("SCARA, PRRR", &["sapa", "apa", "apa", "apa"]),
    ("an elbow and a roll", &["ara", "apa", "axa", "axa"]),
    ("an elbow", &["ara", "apa", "axa"]),
    ("first meets second, short", &["0xa", "axa", "axa"]),
    ("second meets third, short", &["axa", "0xa", "axa"]),
    ("plane", &["apa", "apa", "axa"]),
    ("RRP, short", &["0ra", "axa", "saxa"]),
    ("PPP, short", &["sara", "saxa", "saxa"]),
    ("two links", &["apa", "axa"]),
];

/// A random arm of a family, in either convention.
pub fn random(family: (&str, impl AsRef<[&'static str]>), draws: &mut Draws) -> Arm {
    let robot = drawn(family, draws);
    Arm { name: robot.to_toml(), ..Arm::new(&robot) }
}

/// The same as a robot.
pub fn drawn((name, rows): (&str, impl AsRef<[&'static str]>), draws: &mut Draws) -> Robot {
    let rows = rows.as_ref();
    let modified = draws.chance(0.5);
    let mut texts: Vec<[String; 4]> = Vec::new();
    let motion = |row: &str| if row.starts_with('s') { "prismatic" } else { "revolute" };
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
        let cells: Vec<String> = row.trim_start_matches('s').chars().map(&mut cell).collect();
        let [a, alpha, d] = cells.try_into().expect("three cells");
        let theta = match (draws.part() * 4.0) as u32 {
            // Across each other prismatic joints' rows have no special turns here.
            _ if row.starts_with('s') => format!("{:.4}", draws.between(0.2, 1.3)),
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
            let [a, alpha] = &links[(k + rows.len() - 1) % rows.len()];
            (text[0], text[1]) = (a.clone(), alpha.clone());
        }
    }
    let rows: Vec<String> = texts
        .iter()
        .zip(rows)
        .map(|([a, alpha, d, theta], row)| {
            let motion = motion(row);
            format!("{{ type = \"{motion}\", theta = {theta}, a = {a}, alpha = {alpha}, d = {d} }}")
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
    Robot::from_toml(&text, "arm.toml").unwrap_or_else(|e| panic!("{e:?}\n{text}")).0
}
