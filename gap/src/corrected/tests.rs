//! Corrected robots against the exact models of the effects.

use nalgebra::{Isometry3, Vector6};
use stiffarm_kernels::generic;

use super::*;
use crate::effects::{CATALOGUE, Effect, Forms, Spot};
use crate::fixture::{row, table};
use crate::measurement::{Kind, Measurements};
use crate::simulate::{Actual, Sim, moments};

const FILE: &str = r#"
name = "elbow"
convention = "standard"
[[joint]]
type = "revolute"
d = 0.4
alpha = "pi/2"
stiffness = 4e5
gear = 101
mass = 30.0
com = [0.0, -0.2, 0.0]
[[joint]]
type = "revolute"
theta = "pi/2"
a = 0.7
alpha = "pi/6"
beta = "1 deg"
stiffness = 3e5
[joint.beam]
youngs_modulus = 70e9
shear_modulus = 26e9
section = { area = 2e-3, iy = 2e-6, iz = 3e-6, j = 6e-6 }
[[joint]]
type = "prismatic"
d = 0.5
stiffness = 2e7
[[joint]]
type = "revolute"
a = 0.2
d = 0.1
alpha = "-pi/2"
[[joint]]
type = "revolute"
a = 0.3
mass = 4.0
[base]
translation = [0.5, -0.2, 0.1]
rotation = [0.0, 0.1, "pi/2"]
[tool]
translation = [0.0, 0.0, 0.15]
rotation = [0.0, "pi/2", 0.0]
"#;

fn robot(modified: bool) -> Robot {
    let text = if modified { FILE.replace("standard", "modified") } else { FILE.to_owned() };
    Robot::from_toml(&text, "elbow.toml").unwrap().0
}

fn nominal(robot: &Robot) -> generic::Arm {
    arm(robot).unwrap()
}

/// Rows that every effect acts in.
fn data() -> Measurements {
    let rows = (0..6_u32).map(|k| {
        let at = f64::from(k);
        let q = [0.3 + 0.2 * at, -0.5, 0.2 + 0.05 * at, 1.1 - 0.3 * at, 0.4 * at];
        let mut row = row(&q, Vector6::new(150.0, -90.0, -400.0, 20.0, 30.0, -15.0));
        row.direction = Some(vec![1, -1, 1, -1, 1]);
        (row.temperature, row.time) = (Some(20.0 + at), Some(0.6 * at));
        row
    });
    table(rows.collect(), Kind::Pose { orientation: true })
}

/// What the instrument reads in the last row of an arm with some effects.
fn reading(arm: &generic::Arm, known: &[Known]) -> Isometry3<f64> {
    let data = data();
    let (row, when) = (&data.rows[5], &moments(&data)[5]);
    let sim = Sim::of(data.kind, Isometry3::identity(), None, |_| {
        let mut actual = Actual::new(arm, &row.q, &row.wrench);
        known.iter().for_each(|known| known.alter(&mut actual, row, when));
        actual
    });
    let reading = sim.unwrap().reading();
    Isometry3::from_parts(reading.position.into(), reading.rotation)
}

fn known(effect: &'static dyn Effect, spot: Spot, values: Vec<f64>) -> Known {
    Known { effect, spot, values, session: None, at: Default::default() }
}

/// The file with an effect put in, read back, and how far it is from the effect's own exact model.
fn put(robot: &Robot, known: &Known) -> (Robot, Vec<Known>, f64) {
    let nominal = nominal(robot);
    let (mut file, mut beyond) = (RobotFile::new(robot, &nominal), Vec::new());
    let entry = file.put(known, &mut beyond);
    assert!(!entry.is_empty());
    let text = file.finish(&beyond).to_toml();
    let (read, _) = Robot::from_toml(&text, "written.toml").unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(read.to_toml(), text);
    let (read, left) = folded(&read, &Catalogue::default()).unwrap_or_else(|e| panic!("{e}"));
    let want = reading(&nominal, std::slice::from_ref(known));
    let is = reading(&arm(&read).unwrap(), &left);
    let off = (want.inverse() * is).to_homogeneous() - nalgebra::Matrix4::identity();
    (read, left, off.amax())
}

/// Every effect at every place. Lengths are written to 1e-12 m, angles to 1e-12 rad, stiffnesses and
/// masses to nine digits: of a deflection of millimetres 5e-12 m, over a reach of a metre or two.
#[test]
fn the_written_robot_does_what_the_effect_does() {
    let mut in_the_table = Vec::new();
    for modified in [false, true] {
        let robot = robot(modified);
        let nominal = nominal(&robot);
        for effect in CATALOGUE {
            let mut most = 0.0_f64;
            for place in effect.places(&nominal) {
                let form = match effect.forms_are() {
                    Forms::Searched { steps, .. } => 3 * steps,
                    _ => effect.named_forms(&nominal, place).last().copied().unwrap_or_default(),
                };
                let spot = Spot { place, form };
                let parameters = effect.parameters(&nominal, spot);
                let values = parameters.iter().map(|p| p.quantity.typical()).collect();
                let known = known(effect, spot, values);
                let (_, left, off) = put(&robot, &known);
                assert!(off < 1e-10, "{effect:?} {place} {modified} {off:e}");
                assert!(left.iter().all(|l| *l == known), "{effect:?} {place} {left:?}");
                let shown = reading(&nominal, &[known]).translation.vector
                    - reading(&nominal, &[]).translation.vector;
                most = most.max(shown.norm());
                if left.is_empty() && !in_the_table.contains(&effect.identifier()) {
                    in_the_table.push(effect.identifier());
                }
            }
            assert!(most > 1e-8, "{effect:?} shows nowhere");
        }
    }
    in_the_table.sort_unstable();
    let entries = [
        "base_frame",
        "geometry",
        "joint_compliance",
        "joint_offset",
        "link_com",
        "link_compliance",
        "link_geometry",
        "link_weight",
        "tool_frame",
    ];
    assert_eq!(in_the_table, entries);
}

#[test]
fn what_is_not_corrected_stays_exact() {
    let offset = CATALOGUE.into_iter().find(|e| e.identifier() == "joint_offset").unwrap();
    let (found, ..) =
        put(&robot(false), &known(offset, Spot::at("joint 1".parse().unwrap()), vec![1e-3]));
    let was = robot(false);
    assert_eq!(found.joints[0].alpha, was.joints[0].alpha);
    assert_eq!(found.joints[0].theta.radians(), Some(1e-3));
    assert_eq!(found.joints[1..], was.joints[1..]);
    assert_eq!((found.tool, found.base), (was.tool, was.base));
}

#[test]
fn a_link_without_mass_is_weighed_at_its_middle() {
    let weight = CATALOGUE.into_iter().find(|e| e.identifier() == "link_weight").unwrap();
    let at = |link: &str| known(weight, Spot::at(link.parse().unwrap()), vec![3.0]);
    let (found, left, _) = put(&robot(false), &at("link 4"));
    assert_eq!(left, []);
    assert_eq!(found.joints[3].com[0].number().unwrap().to_f64(), -0.1);
    // Seen from its frame the middle of a prismatic row, or one that begins with `a`, moves with q.
    for (modified, link) in [(false, "link 3"), (true, "link 2")] {
        let (found, left, _) = put(&robot(modified), &at(link));
        assert_eq!((found.joints, left.len()), (robot(modified).joints, 1));
    }
}

/// A centre of mass without a mass is refused by the reader.
#[test]
fn a_link_that_weighs_nothing_keeps_its_centre() {
    let weight = CATALOGUE.into_iter().find(|e| e.identifier() == "link_weight").unwrap();
    let none = known(weight, Spot::at("link 1".parse().unwrap()), vec![-30.0]);
    let (found, left, off) = put(&robot(false), &none);
    assert_eq!((found.joints[0].com.clone(), left.len()), (robot(false).joints[0].com.clone(), 0));
    assert!(off < 1e-10 && found.joints[0].mass.as_ref().is_some_and(|mass| mass.is_zero()));
}

/// What a file has and what is found on top of it are one effect; what belongs to one session is not
/// the same as what is always there.
#[test]
fn the_same_effect_adds_up() {
    let text =
        format!("{FILE}[[effect]]\nid = \"backlash\"\nplace = \"joint 2\"\nwidth = \"0.3 mrad\"\n");
    let robot = Robot::from_toml(&text, "elbow.toml").unwrap().0;
    let nominal = nominal(&robot);
    let (_, mut beyond) = folded(&robot, &Catalogue::default()).unwrap();
    let more = Known { values: vec![1e-4], ..beyond[0].clone() };
    let mut file = RobotFile::new(&robot, &nominal);
    assert_eq!(file.put(&more, &mut beyond), "an [[effect]]");
    assert_eq!(beyond.len(), 1);
    assert!((beyond[0].values[0] - 4e-4).abs() < 1e-18);
    let of_one = Known { session: Some("run.csv".to_owned()), ..more };
    file.put(&of_one, &mut beyond);
    assert_eq!(beyond.len(), 2);
    assert!(of_one.is_there(&Measurements { file: "here/run.csv".to_owned(), ..data() }));
    assert!(!of_one.is_there(&data()));
    assert_eq!(file.finish(&beyond).effects.len(), 2);
}
