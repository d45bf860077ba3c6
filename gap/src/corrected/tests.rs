//! Corrected robots against the exact models of the effects.

use stiffarm_kernels::generic;

use nalgebra::Vector6;

use super::*;
use crate::diagnose::{Finding, Options, diagnose_with};
use crate::effects::{CATALOGUE, Spot};
use crate::fixture::{row, table};
use crate::measurement::Kind;
use crate::simulate::{Actual, equilibrium, moments, rest};

const FILE: &str = r#"
name = "elbow"
convention = "standard"
[[joint]]
type = "revolute"
d = 0.4
alpha = "pi/2"
stiffness = 4e5
mass = 30.0
com = [0.0, -0.2, 0.0]
[[joint]]
type = "revolute"
theta = "pi/2"
a = 0.7
alpha = "pi/6"
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
[tool]
translation = [0.0, 0.0, 0.15]
rotation = [0.0, "pi/2", 0.0]
"#;

fn robot(modified: bool) -> Robot {
    let text = if modified { FILE.replace("standard", "modified") } else { FILE.to_owned() };
    Robot::from_toml(&text, "elbow.toml").unwrap().0
}

fn arm(robot: &Robot) -> generic::Arm {
    crate::robot::arm(robot).unwrap()
}

/// What became of an effect, and how far the corrected robot under load is from the effect's
/// own exact model.
fn put(robot: &Robot, effect: &str, place: &str, values: &[f64]) -> (Vec<Fate>, Robot, f64) {
    let nominal = arm(robot);
    let (q, w) = ([0.3, -0.5, 0.2, 1.1], Vector6::new(150.0, -90.0, -400.0, 20.0, 30.0, -15.0));
    let data = table(vec![row(&q, w), row(&q, w)], Kind::Pose { orientation: true });
    let effect = *CATALOGUE.iter().find(|e| e.identifier() == effect).unwrap();
    let at = effect.places(&nominal).into_iter().find(|p| p.to_string() == place).unwrap();
    let parameters = effect.parameters(&nominal, Spot::at(at));
    assert_eq!(parameters.len(), values.len());
    let reports = parameters.iter().zip(values).map(|(p, &value)| {
        let ci95 = [value, value];
        ParameterReport { name: p.name.to_string(), value, unit: p.quantity.unit(), ci95 }
    });
    let mut diagnosed = diagnose_with(&nominal, &data_of(&nominal), &quick(), &|_| {}).unwrap();
    diagnosed.diagnosis.findings = vec![Finding {
        effect: effect.identifier(),
        place: place.to_owned(),
        parameters: reports.collect(),
        held_out: crate::diagnose::Shrink {
            before: 1.0,
            after: 0.0,
            shrink: 1.0,
            shrink_ci95: [1.0; 2],
        },
        p_value: 0.0,
        stability: 1.0,
        alternatives: Vec::new(),
        to_separate: None,
    }];
    let corrected = corrected(robot, &diagnosed);
    let mut actual = Actual::new(&nominal, &q, &w);
    effect.alter(&mut actual, &data.rows[1], &moments(&data)[1], Spot::at(at), values);
    let want = rest(&actual, None).unwrap().tool;
    let is = equilibrium(&arm(&corrected.robot), &q, &w).unwrap().tool;
    let off = (want.inverse() * is).to_homogeneous() - nalgebra::Matrix4::identity();
    let fates = corrected.outcomes.into_iter().map(|o| o.fate).collect();
    (fates, corrected.robot, off.amax())
}

/// Two poses without a gap.
fn data_of(arm: &generic::Arm) -> crate::measurement::Measurements {
    let kind = Kind::Pose { orientation: true };
    let rows = (0..4_u32).map(|k| {
        let mut row = row(&[0.2 * f64::from(k), 0.1, 0.0, 0.3], Vector6::zeros());
        (row.group, row.line) = (k as usize, u64::from(k) + 2);
        row.measured = crate::simulate::simulate(arm, &row, kind).unwrap().reading().vector();
        row
    });
    table(rows.collect(), kind)
}

fn quick() -> Options {
    Options { effects: Some(vec!["joint_offset".to_owned()]), ..Options::default() }
}

#[test]
fn the_corrected_robot_does_what_the_effect_does() {
    let cases: [(&str, &str, &[f64]); 9] = [
        ("joint_offset", "joint 2", &[1.3e-3]),
        ("joint_offset", "joint 3", &[-2e-3]),
        ("joint_compliance", "joint 2", &[2.5e-6]),
        ("joint_compliance", "joint 3", &[-4e-8]),
        ("joint_compliance", "joint 4", &[3e-6]),
        ("link_geometry", "link 2", &[1e-3, -2e-3, 3e-3]),
        // Between parallel axes it has an angle that no table has.
        ("link_geometry", "link 3", &[1e-3, -2e-3, 3e-3, 0.0]),
        ("link_weight", "link 1", &[-12.0]),
        ("link_compliance", "link 2", &[4e-6, -2e-6]),
    ];
    for (effect, place, values) in cases {
        for modified in [false, true] {
            let (fates, _, off) = put(&robot(modified), effect, place, values);
            let put_in = fates.iter().filter(|f| matches!(f, Fate::PutIn(_))).count();
            assert_eq!(put_in, fates.len().min(3), "{effect} {place} {fates:?}");
            assert!(off < 1e-10, "{effect} {place} {modified} {off}");
        }
    }
    let tool = [1e-3, -2e-3, 3e-3, 0.01, -0.02, 0.03];
    let (fates, found, off) = put(&robot(false), "tool_frame", "tool", &tool);
    assert!(fates.iter().all(|f| *f == Fate::PutIn("the tool".to_owned())));
    assert!(off < 1e-10, "{off}");
    assert_eq!(found.joints, robot(false).joints);
}

#[test]
fn a_link_without_mass_is_weighed_at_its_middle() {
    let (fates, found, off) = put(&robot(false), "link_weight", "link 4", &[3.0]);
    assert_eq!(fates, [Fate::PutIn("mass of joint 4".to_owned())]);
    assert!(off < 1e-10, "{off}");
    assert_eq!(found.joints[3].com[0].number().unwrap().to_f64(), -0.1);
    // Seen from its frame the middle of a prismatic row, or one that begins with `a`, moves with q.
    for (modified, link) in [(false, "link 3"), (true, "link 2")] {
        let (fates, found, _) = put(&robot(modified), "link_weight", link, &[3.0]);
        assert!(matches!(fates[..], [Fate::LeftOut(_)]), "{fates:?}");
        assert_eq!(found, robot(modified));
    }
}

#[test]
fn what_is_not_corrected_stays_exact() {
    let (_, found, _) = put(&robot(false), "joint_offset", "joint 1", &[1e-3]);
    let was = robot(false);
    assert_eq!(found.joints[0].alpha, was.joints[0].alpha);
    assert_eq!(found.joints[0].theta.radians(), Some(1e-3));
    assert_eq!(found.joints[1..], was.joints[1..]);
    assert_eq!(found.tool, was.tool);
}

#[test]
fn what_a_file_cannot_hold_is_left_out() {
    for (effect, place, values) in [
        ("backlash", "joint 2", &[3e-4][..]),
        ("base_frame", "base", &[1e-3, 0.0, 0.0, 0.0, 0.0, 1e-3]),
        ("link_compliance", "link 4", &[1e-6, 1e-6]),
    ] {
        let (fates, found, _) = put(&robot(false), effect, place, values);
        assert!(fates.iter().all(|f| matches!(f, Fate::LeftOut(_))), "{effect} {fates:?}");
        assert_eq!(found, robot(false));
    }
    let (fates, ..) = put(&robot(false), "link_geometry", "link 3", &[1e-3, 0.0, 0.0, 2e-3]);
    let said = "left out: a row of the table has no such angle";
    assert_eq!(fates[3].to_string(), said);
    // A spring that is taken away leaves the joint rigid.
    let (_, found, _) = put(&robot(false), "joint_compliance", "joint 2", &[-1.0 / 3e5]);
    assert_eq!(found.joints[1].stiffness, None);
}
