//! What a design does not show is refused by name, and the pull that is named shows it.

use nalgebra::Vector3;
use stiffarm_kernels::generic::Arm;
use stiffarm_papers::dumas::rig::{Errors, PoseFit, Rig, carry_out};
use stiffarm_papers::dumas::{
    Hidden, IdentifyError, Reason, Settings, System, Test, Weighting, identify,
};

use crate::robot::{near, with_tool};

fn measured(arm: &Arm, mut tests: Vec<Test>) -> Vec<Test> {
    for test in &mut tests {
        test.displacement = arm.deflection_first_order(&test.q, &test.wrench);
    }
    tests
}

fn hidden(arm: &Arm, tests: &[Test], weighting: Weighting) -> Vec<Hidden> {
    match identify(arm, tests, &Settings::new(weighting)).unwrap_err() {
        IdentifyError::Hidden(hidden) => hidden,
        other => panic!("{other}"),
    }
}

/// The tests and one more in the posture and with the pull that the refusal names.
fn with_pull(arm: &Arm, tests: &[Test], hidden: &Hidden) -> Vec<Test> {
    let pull = hidden.pull.as_ref().unwrap();
    assert_eq!(pull.q, tests[pull.test - 1].q);
    let mut more = tests.to_vec();
    more.push(Test { wrench: pull.wrench(1000.0), ..tests[pull.test - 1].clone() });
    measured(arm, more)
}

/// A vertical pull, wherever it hangs, has no moment about the vertical axis 1.
#[test]
fn a_vertical_pull_leaves_k1_without_a_trace() {
    let arm = with_tool();
    let rig = Rig { tilt: [0.0, 0.0], ..Rig::dumas() };
    let mut tests = rig.plan(&arm, 23, 1).unwrap();
    // Through the tool origin, the origin of the wrench's axes; m_z is 0 with any lever.
    assert!(tests.iter().all(|test| test.wrench[5].abs() < 1e-9));
    tests = measured(&arm, tests);
    let system = System::stack(&arm, &tests, &Weighting::SI).unwrap();
    assert!(system.b.column(0).amax() < 1e-9 * system.b.amax());
    assert_eq!(system.b.rank(1e-9 * system.b.amax()), 5);
    let refused = hidden(&arm, &tests, Weighting::SI);
    let [only] = &refused[..] else { panic!("{refused:?}") };
    assert_eq!((only.joint, &only.reason), (1, &Reason::Untouched));
    let pull = only.pull.as_ref().unwrap();
    near(pull.direction.z, 0.0, 1e-12);
    near(pull.direction.norm(), 1.0, 1e-12);
    // Perpendicular to the line from axis 1 to the tool, of all postures the one farthest out.
    let out = |q: &[f64]| arm.pose(q).translation.vector.xy().norm();
    near(pull.lever.unwrap(), out(&pull.q), 1e-12);
    let farthest = tests.iter().map(|test| out(&test.q)).fold(0.0, f64::max);
    near(pull.lever.unwrap(), farthest, 1e-12);
    let text = IdentifyError::Hidden(refused.clone()).to_string();
    assert!(text.contains("joint 1 leaves no trace; to show it, pull along ["), "{text}");
    let found = identify(&arm, &with_pull(&arm, &tests, only), &Settings::new(Weighting::SI));
    near(found.unwrap().joints[0].stiffness().unwrap() / 3.8e6, 1.0, 1e-9);
}

/// The tool point lies on axis 6: translations alone cannot see joint 6, whatever pulls.
#[test]
fn translations_of_a_point_on_axis_6_leave_k6_without_a_trace() {
    let arm = with_tool();
    let tests = measured(&arm, Rig::dumas().plan(&arm, 10, 1).unwrap());
    let refused = hidden(&arm, &tests, Weighting::TRANSLATIONS);
    let [only] = &refused[..] else { panic!("{refused:?}") };
    assert_eq!((only.joint, &only.reason, &only.pull), (6, &Reason::Untouched, &None));
    assert!(only.to_string().contains("measure rotations, or a point off its axis"), "{only}");
    let mut off = arm.clone();
    off.tool.translation.vector.x = 0.1;
    let tests = measured(&off, tests);
    assert!(identify(&off, &tests, &Settings::new(Weighting::TRANSLATIONS)).is_ok());
    // Rotations alone see every joint.
    let tests = measured(&arm, tests);
    assert!(identify(&arm, &tests, &Settings::new(Weighting::ROTATIONS)).is_ok());
}

/// A force through the point on axis 6 does not load joint 6; a moment about it does.
#[test]
fn a_force_through_axis_6_leaves_k6_without_a_trace() {
    let arm = with_tool();
    let rig = Rig { lever: 0.0, ..Rig::dumas() };
    let tests = measured(&arm, rig.plan(&arm, 10, 1).unwrap());
    let refused = hidden(&arm, &tests, Weighting::SI);
    let [only] = &refused[..] else { panic!("{refused:?}") };
    assert_eq!(only.joint, 6);
    let pull = only.pull.as_ref().unwrap();
    assert_eq!(pull.lever, None);
    let axis = arm.pose(&pull.q).rotation * Vector3::z();
    near(axis.dot(&pull.direction).abs(), 1.0, 1e-12);
    assert!(only.to_string().contains("apply a moment about ["), "{only}");
    let found = identify(&arm, &with_pull(&arm, &tests, only), &Settings::new(Weighting::SI));
    near(found.unwrap().joints[5].stiffness().unwrap() / 4.7e5, 1.0, 1e-9);
}

/// One test of three rows shows only combinations of the other five.
#[test]
fn what_shows_only_together_is_said_so() {
    let arm = with_tool();
    let tests = measured(&arm, Rig::dumas().plan(&arm, 1, 1).unwrap());
    let refused = hidden(&arm, &tests, Weighting::TRANSLATIONS);
    assert_eq!(refused.iter().map(|h| h.joint).collect::<Vec<_>>(), [1, 2, 3, 4, 5, 6]);
    assert_eq!(refused[1].reason, Reason::Mixed(vec![1, 3, 4, 5]));
    assert!(refused[1].to_string().contains("shows only together with joint 1, 3, 4, 5"));
}

/// A chain that hardly tilts determines k₁ on paper; the noise does not let it through.
#[test]
fn a_hardly_tilted_pull_is_a_warning() {
    let arm = with_tool();
    let tilt = [0.0, 0.01_f64.to_radians()];
    let rig = Rig { tilt, ..Rig::dumas() };
    let plan = rig.plan(&arm, 12, 1).unwrap();
    let tests = carry_out(&arm, &rig, &plan, Errors::quoted(), PoseFit::GramSchmidt, 3).unwrap();
    let settings = Settings::known_noise(Weighting::triangle(3e-5, 0.25));
    let found = identify(&arm, &tests, &settings).unwrap();
    let [weak] = &found.weak[..] else { panic!("{:?}", found.weak) };
    assert_eq!(weak.joint, 1);
    assert!(matches!(weak.reason, Reason::Weak { .. }));
    near(weak.pull.as_ref().unwrap().direction.z, 0.0, 1e-12);
    assert_eq!(found.joints[0].stiffness_interval()[1], f64::INFINITY);
}
