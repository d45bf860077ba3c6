//! The graph's own evaluation on random tables of 1 to 9 joints.

use nalgebra::{DMatrix, DVector, Vector3, Vector6};
use proptest::prelude::*;
use proptest::strategy::ValueTree as _;
use proptest::test_runner::TestRunner;
use stiffarm::kernels::generic::Arm;
use stiffarm::kernels::{Input, Output, Part, Side};
use stiffarm_codegen::derive::{Passes, Program, derive, derive_in, derive_with};
use stiffarm_codegen::number::Number;

use crate::boundary::{KINDS, around};
use crate::compare::{CANCELLED, Draws, ForArm, relative, terms};
use crate::tables::{Table, table};

impl Table {
    /// One output as the program evaluates it.
    fn by(&self, program: &Program, q: &[f64], wrench: &[f64; 6]) -> Option<Vec<f64>> {
        let value = |name: &str| self.value(name).unwrap_or(f64::NAN);
        let taken: usize = program.inputs().filter(|input| input.side() == Side::Joints).count();
        Some(program.evaluate(&q[..taken * program.dof], wrench, value).ok()?.concat())
    }
}

fn drawn(table: &Table, seed: u64) -> (Arm, Vec<f64>, [f64; 6]) {
    let arm = table.arm();
    let mut draws = Draws::new(seed);
    let (q, wrench) = (draws.state(&arm), draws.wrench(&arm));
    (arm, q, wrench)
}

fn floor(arm: &Arm, output: Output, q: &[f64], wrench: &[f64; 6]) -> f64 {
    CANCELLED * terms(arm, output, &q[..output.state(arm.dof())], wrench)
}

fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, ..ProptestConfig::default() }
}

/// Every output of a table by its graph and by the textbook.
fn agree(table: &Table, seed: u64) -> Result<(), TestCaseError> {
    let (arm, q, wrench) = drawn(table, seed);
    let robot = table.robot();
    for output in Output::EACH {
        let expected = arm.evaluate(output, &q[..output.state(arm.dof())], &wrench).ok();
        let got = table.by(&derive(&robot, &[output]), &q, &wrench);
        // A mass matrix that is singular but for rounding may be told either way.
        let told = !output.takes(Input::Torques) || expected.is_some();
        prop_assert!(!told || expected.is_some() == got.is_some());
        let (Some(expected), Some(got)) = (expected, got) else { continue };
        let worst = relative(&got, &expected, floor(&arm, output, &q, &wrench));
        prop_assert!(worst <= 1e-11, "{} {worst:e}\n{}", output.name(), table.text);
    }
    Ok(())
}

proptest! {
    // Each case derives every output, half a second without optimisation.
    #![proptest_config(cases(40))]

    #[test]
    fn the_graph_agrees_with_the_textbook(table in table(1..=9), seed in any::<u64>()) {
        agree(&table, seed)?;
    }
}

proptest! {
    #![proptest_config(cases(10_000))]

    #[test]
    #[ignore = "ten thousand tables take minutes"]
    fn the_graph_agrees_with_the_textbook_on_ten_thousand_tables(
        table in table(1..=9), seed in any::<u64>()
    ) {
        agree(&table, seed)?;
    }
}

proptest! {
    #![proptest_config(cases(200))]

    /// In one function, where what they have in common decides how they are derived.
    #[test]
    fn derivatives_of_torques_agree_together(table in table(1..=9), seed in any::<u64>()) {
        let (arm, q, wrench) = drawn(&table, seed);
        let both = [Output::InverseDynamicsByJoints, Output::InverseDynamicsByRates];
        let got = table.by(&derive(&table.robot(), &both), &q, &wrench).expect("nothing is solved");
        for (output, got) in both.into_iter().zip(got.chunks(arm.dof().pow(2))) {
            let expected = arm.evaluate(output, &q[..output.state(arm.dof())], &wrench);
            let expected = expected.expect("nothing is solved");
            let worst = relative(got, &expected, floor(&arm, output, &q, &wrench));
            prop_assert!(worst <= 1e-11, "{} {worst:e}\n{}", output.name(), table.text);
        }
    }

    #[test]
    fn the_working_frame_does_not_matter(
        table in table(1..=9), cut in 0usize..40, seed in any::<u64>()
    ) {
        let (arm, q, wrench) = drawn(&table, seed);
        let robot = table.robot();
        let cut = cut % (7 * robot.dof() + 1);
        for output in [Output::Jacobian, Output::ComplementaryStiffness, Output::Compliance] {
            let at = |cut| table.by(&derive_in(&robot, &[output], cut), &q, &wrench).unwrap();
            let floor = floor(&arm, output, &q, &wrench);
            let worst = relative(&at(cut), &at(0), floor);
            prop_assert!(worst <= 1e-11, "{worst:e}\n{}", table.text);
        }
    }

    #[test]
    fn passes_change_nothing_but_the_cost(
        table in table(1..=9), off in 0usize..6, output in 0..Output::EACH.len(), seed in any::<u64>()
    ) {
        let (arm, q, wrench) = drawn(&table, seed);
        let robot = table.robot();
        let passes = match off {
            0 => Passes { frame: false, ..Passes::ALL },
            1 => Passes { sums: false, ..Passes::ALL },
            2 => Passes { runs: false, ..Passes::ALL },
            3 => Passes { parallel: false, ..Passes::ALL },
            4 => Passes { bodies: false, ..Passes::ALL },
            _ => Passes::NONE,
        };
        let output = Output::EACH[output];
        let all = table.by(&derive(&robot, &[output]), &q, &wrench);
        let some = table.by(&derive_with(&robot, &[output], passes), &q, &wrench);
        prop_assert_eq!(all.is_some(), some.is_some());
        if let (Some(all), Some(some)) = (all, some) {
            let floor = floor(&arm, output, &q, &wrench);
            let worst = relative(&some, &all, floor);
            prop_assert!(worst <= 1e-11, "{} {passes:?} {worst:e}\n{}", output.name(), table.text);
        }
    }
}

/// A load within the margin that the kernels take leaves half of the springs, in every posture: the smallest
/// eigenvalue of the symmetric part of `Kθ − K_C − K_G`, scaled to springs of 1, of the textbook.
#[test]
fn a_margin_leaves_half_of_the_springs() {
    let mut runner = TestRunner::deterministic();
    let (mut least, mut found) = (f64::INFINITY, 0);
    for seed in 0..120 {
        let table = table(3..=9).new_tree(&mut runner).expect("a table").current();
        let (robot, arm, mut draws) = (table.numeric(), table.arm(), Draws::new(seed));
        let roots = arm.joints.iter().map(|joint| joint.compliance.sqrt());
        let roots = DMatrix::from_diagonal(&DVector::from_iterator(arm.dof(), roots));
        for output in [Output::Deflection, Output::DeflectionWithGravity] {
            let program = derive(&robot, &[output]);
            let Some(most) = program.solves.first().and_then(|solve| solve.margin) else {
                continue;
            };
            let [force, moment] = most.map(Number::to_f64);
            found += 1;
            for _ in 0..20 {
                let (q, part) = (draws.posture(&arm), draws.part());
                let [f, m] =
                    [(force, part), (moment, 1.0 - part)].map(|(most, part): (f64, f64)| {
                        Vector3::from(draws.array(-1.0, 1.0)).normalize() * (most * part.sqrt())
                    });
                let wrench = Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z);
                let mut load = arm.complementary_stiffness(&q, &wrench);
                if output.depends_on(Part::Weights) {
                    load += arm.weight_stiffness(&q);
                }
                let left = DMatrix::identity(arm.dof(), arm.dof()) - &roots * load * &roots;
                let left = ((&left + left.transpose()) / 2.0).symmetric_eigenvalues().min();
                assert!(left > 0.5, "{left} with {wrench:?} at {q:?}\n{}", table.text);
                least = least.min(left);
            }
        }
    }
    // Neither empty nor so cautious that no load would come near it.
    assert!(found > 40 && least < 0.8, "{found} {least}");
}

proptest! {
    // Each case has six boundaries to find.
    #![proptest_config(cases(60))]

    #[test]
    fn the_graph_refuses_what_the_textbook_refuses(table in table(1..=9), seed in any::<u64>()) {
        let (arm, q, _) = drawn(&table, seed);
        let robot = table.robot();
        let mut draws = Draws::new(seed ^ 1);
        for kind in KINDS {
            let direction = kind.direction(&mut draws);
            for output in [Output::Deflection, Output::DeflectionWithGravity] {
                let Some([borne, refused]) = around(&arm, output, &q[..arm.dof()], &direction, f64::EPSILON)
                else { continue };
                let program = derive(&robot, &[output]);
                prop_assert!(table.by(&program, &q, &borne).is_some(), "{kind:?}\n{}", table.text);
                prop_assert!(table.by(&program, &q, &refused).is_none(), "{kind:?}\n{}", table.text);
            }
        }
    }
}
