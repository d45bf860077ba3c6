//! The graph's own evaluation on random tables of 1 to 9 joints.

use proptest::prelude::*;
use stiffarm::kernels::Output;
use stiffarm::kernels::generic::Arm;
use stiffarm_codegen::derive::{Passes, Program, derive, derive_in, derive_with};

use crate::boundary::{KINDS, around};
use crate::compare::{CANCELLED, Draws, ForArm, relative, terms};
use crate::tables::{Table, table};

impl Table {
    /// One output as the program evaluates it.
    fn by(&self, program: &Program, q: &[f64], wrench: &[f64; 6]) -> Option<Vec<f64>> {
        let value = |name: &str| self.value(name).unwrap_or(f64::NAN);
        Some(program.evaluate(q, wrench, value).ok()?.concat())
    }
}

fn drawn(table: &Table, seed: u64) -> (Arm, Vec<f64>, [f64; 6]) {
    let arm = table.arm();
    let mut draws = Draws::new(seed);
    let (q, wrench) = (draws.posture(&arm), draws.wrench(&arm));
    (arm, q, wrench)
}

fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn the_graph_agrees_with_the_textbook(table in table(1..=9), seed in any::<u64>()) {
        let (arm, q, wrench) = drawn(&table, seed);
        let robot = table.robot();
        for output in Output::EACH {
            let expected = arm.evaluate(output, &q, &wrench).ok();
            let got = table.by(&derive(&robot, &[output]), &q, &wrench);
            prop_assert_eq!(expected.is_some(), got.is_some());
            let (Some(expected), Some(got)) = (expected, got) else { continue };
            let worst = relative(&got, &expected, CANCELLED * terms(&arm, output, &q, &wrench));
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
            let floor = CANCELLED * terms(&arm, output, &q, &wrench);
            let worst = relative(&at(cut), &at(0), floor);
            prop_assert!(worst <= 1e-11, "{worst:e}\n{}", table.text);
        }
    }

    #[test]
    fn passes_change_nothing_but_the_cost(
        table in table(1..=9), off in 0usize..5, output in 0..Output::EACH.len(), seed in any::<u64>()
    ) {
        let (arm, q, wrench) = drawn(&table, seed);
        let robot = table.robot();
        let passes = match off {
            0 => Passes { frame: false, ..Passes::ALL },
            1 => Passes { sums: false, ..Passes::ALL },
            2 => Passes { runs: false, ..Passes::ALL },
            3 => Passes { parallel: false, ..Passes::ALL },
            _ => Passes::NONE,
        };
        let output = Output::EACH[output];
        let all = table.by(&derive(&robot, &[output]), &q, &wrench);
        let some = table.by(&derive_with(&robot, &[output], passes), &q, &wrench);
        prop_assert_eq!(all.is_some(), some.is_some());
        if let (Some(all), Some(some)) = (all, some) {
            let floor = CANCELLED * terms(&arm, output, &q, &wrench);
            let worst = relative(&some, &all, floor);
            prop_assert!(worst <= 1e-11, "{} {passes:?} {worst:e}\n{}", output.name(), table.text);
        }
    }
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
                let Some([borne, refused]) = around(&arm, output, &q, &direction, f64::EPSILON)
                else { continue };
                let program = derive(&robot, &[output]);
                prop_assert!(table.by(&program, &q, &borne).is_some(), "{kind:?}\n{}", table.text);
                prop_assert!(table.by(&program, &q, &refused).is_none(), "{kind:?}\n{}", table.text);
            }
        }
    }
}
