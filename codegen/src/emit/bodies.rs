//! What the printers of simulators' files share: a chain of bodies, names and numbers in XML.

use super::SymbolicTable;
use crate::robot::Robot;
use crate::robot::urdf::{Chain, Frame, Lump};

/// A robot as bodies.
pub(super) struct Bodies {
    /// The robot's, as an attribute.
    pub name: String,
    pub chain: Chain,
    /// One per joint.
    pub names: Vec<Names>,
}

/// Of a joint and of the link that it moves, as attributes.
pub(super) struct Names {
    pub joint: String,
    pub link: String,
}

impl Bodies {
    pub fn new(robot: &Robot) -> Result<Bodies, SymbolicTable> {
        let chain = Chain::from_robot(robot).ok_or_else(|| SymbolicTable {
            parameters: robot.symbols().into_iter().map(|s| s.name).collect(),
        })?;
        let distinct = |name: &str| chain.steps.iter().filter(|s| s.name == name).count() == 1;
        let names = chain.steps.iter().enumerate().map(|(k, step)| Names {
            joint: match distinct(&step.name) && step.name != "tool_mount" {
                true => attribute(&step.name.replace(' ', "_")),
                false => format!("joint_{}", k + 1),
            },
            link: format!("link_{}", k + 1),
        });
        Ok(Bodies { name: attribute(&robot.name), names: names.collect(), chain })
    }
}

/// The tensor of inertia of a lump, xx, xy, xz, yy, yz, zz, kg·m²: where the table does not tell, that of a ball of
/// aluminium of its mass, 2/5 m r².
pub(super) fn tensor(lump: &Lump) -> [f64; 6] {
    let ball = || {
        let radius = (3.0 * lump.mass / (4.0 * core::f64::consts::PI * 2700.0)).cbrt();
        let i = 0.4 * lump.mass * radius * radius;
        [i, 0.0, 0.0, i, 0.0, i]
    };
    lump.tensor(&Frame::IDENTITY.axes).unwrap_or_else(ball)
}

/// Numbers as an attribute has them; what rounding left of a zero is one.
pub(super) fn words(numbers: [f64; 3]) -> String {
    let clean = |x: f64| if x.abs() < 1e-15 { 0.0 } else { x };
    numbers.map(|x| clean(x).to_string()).join(" ")
}

/// Text within quotation marks. No control character may stand in XML.
fn attribute(text: &str) -> String {
    let escaped = text.chars().map(|c| match c {
        '&' => "&amp;".to_owned(),
        '<' => "&lt;".to_owned(),
        '>' => "&gt;".to_owned(),
        '"' => "&quot;".to_owned(),
        c if c.is_control() => " ".to_owned(),
        c => c.to_string(),
    });
    escaped.collect()
}

#[cfg(test)]
mod tests {
    use roxmltree::{Document, Node};

    use crate::derive::derive;
    use crate::emit::{mjcf, urdf};
    use crate::robot::urdf::{Chain, Frame, read};
    use crate::robot::{Motion, Output, Robot};

    /// Every arm of the collection whose table is of numbers, and one of all that a table can hold.
    fn arms() -> Vec<Robot> {
        const OBLIQUE: &str = r#"
            name = "<oblique> & \"odd\""
            convention = "standard"
            gravity = [1.0, 2.0, -9.0]
            base = { translation = [0.3, -0.1, 0.2], rotation = [0.1, 0.2, -0.4] }
            joint = [
                { type = "revolute", theta = "pi/2", d = 0.3, a = -0.2, alpha = "pi/2", beta = 0.02, mass = 3, com = [0.1, 0.2, 0.3] },
                { type = "prismatic", theta = "pi/2", d = 0.1, a = 0.25, alpha = "-pi/2", stiffness = 1e5 },
                { type = "prismatic", theta = -0.7, d = 0.1, a = 0.2, alpha = 0.4, beta = -0.3, limits = [-0.5, 0.7], mass = 2 },
                { type = "revolute", theta = 3.0, d = 0.05, a = 0.3, alpha = "pi", limits = [-2.0, 1.0] },
            ]
            tool = { translation = [0.1, -0.2, 0.3], rotation = [0.5, -2.0, 1.0] }
        "#;
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/arms");
        let files = std::fs::read_dir(folder).unwrap();
        let texts = files.map(|file| std::fs::read_to_string(file.unwrap().path()).unwrap());
        let modified = OBLIQUE.replace("standard", "modified");
        let texts = texts.chain([OBLIQUE.to_owned(), modified]);
        let robots = texts.map(|text| Robot::from_toml(&text, "arm.toml").unwrap().0);
        robots.filter(|robot| robot.symbols().is_empty()).collect()
    }

    fn readings(robot: &Robot, k: usize) -> Vec<f64> {
        (0..robot.dof()).map(|j| (1.3 * (j + 1) as f64 * (k + 1) as f64).sin()).collect()
    }

    /// By the graph, which knows nothing of chains.
    fn pose(robot: &Robot, q: &[f64]) -> Vec<f64> {
        let pose = derive(robot, &[Output::Pose]).evaluate(q, &[0.0; 6], |_| f64::NAN);
        pose.unwrap().remove(0)
    }

    /// The largest difference of a frame from a pose: columns of the rotation, then the origin.
    fn off(frame: &Frame, pose: &[f64]) -> f64 {
        let ours = frame.axes.iter().flatten().chain(&frame.origin);
        ours.zip(pose).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn a_urdf_read_back_is_the_same_arm() {
        let arms = arms();
        assert!(arms.len() > 10);
        for robot in arms {
            let text = urdf(&robot).unwrap();
            let back = read(&text, true).unwrap_or_else(|e| panic!("{e:?}\n{text}"));
            let chain = Chain::new(&back.robot, None, None).unwrap();
            assert_eq!(chain.name, robot.name);
            for k in 0..5 {
                let q = readings(&robot, k);
                let off = off(&chain.pose(&q), &pose(&robot, &q));
                assert!(off < 1e-12, "{}: {off}", robot.name);
            }
            for (step, joint) in chain.steps.iter().zip(&robot.joints) {
                assert_eq!(step.motion, joint.motion);
                if joint.limits.is_some() || joint.motion == Motion::Revolute {
                    assert_eq!(step.limits, joint.limits);
                }
                let mass = joint.mass.as_ref().map_or(0.0, |m| m.number().unwrap().to_f64());
                assert_eq!(step.lump.mass, mass);
            }
        }
    }

    fn numbers(node: Node<'_, '_>, name: &str) -> Vec<f64> {
        let text = node.attribute(name).unwrap();
        text.split_whitespace().map(|word| word.parse().unwrap()).collect()
    }

    fn placed(node: Node<'_, '_>) -> Frame {
        let (origin, quat) = (numbers(node, "pos"), numbers(node, "quat"));
        let sine = (quat[1] * quat[1] + quat[2] * quat[2] + quat[3] * quat[3]).sqrt();
        let frame = match sine == 0.0 {
            true => Frame::IDENTITY,
            false => {
                let axis = [quat[1] / sine, quat[2] / sine, quat[3] / sine];
                Frame::turned(axis, 2.0 * sine.atan2(quat[0]))
            }
        };
        Frame { origin: [origin[0], origin[1], origin[2]], ..frame }
    }

    #[test]
    fn nested_bodies_stand_where_the_table_says() {
        for robot in arms() {
            let text = mjcf(&robot).unwrap();
            let document = Document::parse(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
            let root = document.root_element();
            assert_eq!(root.attribute("model"), Some(robot.name.as_str()));
            for k in 0..5 {
                let q = readings(&robot, k);
                let mut at = Frame::IDENTITY;
                let bodies = root.descendants().filter(|n| n.has_tag_name("body"));
                for ((body, q), joint) in bodies.zip(&q).zip(&robot.joints) {
                    let node = body.children().find(|n| n.has_tag_name("joint")).unwrap();
                    let moved = match node.attribute("type").unwrap() {
                        "hinge" => Frame::turned([0.0, 0.0, 1.0], *q),
                        _ => Frame::moved([0.0, 0.0, *q]),
                    };
                    at = at.then(&placed(body)).then(&moved);
                    let stiffness = joint.stiffness.as_ref().map(|k| k.number().unwrap().to_f64());
                    let found = node.attribute("stiffness").map(|k| k.parse().unwrap());
                    assert_eq!(found, stiffness);
                }
                let tool = root.descendants().find(|n| n.has_tag_name("site")).unwrap();
                let off = off(&at.then(&placed(tool)), &pose(&robot, &q));
                assert!(off < 1e-12, "{}: {off}", robot.name);
            }
        }
    }
}
