//! The comparisons themselves: what is wrong is found, by each of them.

use stiffarm::kernels::Output;
use stiffarm::kernels::parity::{Agreement, Comparison, Subject, agreement};

use crate::compare::known;

/// The textbook against itself, but for what `change` does to one of its outputs.
fn checked(output: Output, change: fn(&mut Vec<f64>)) -> Agreement {
    let (_, arm) = known("kuka_kr240");
    let generated = |asked, q: &[f64], w: &[f64; 6]| {
        let mut block = arm.evaluate(asked, q, w)?;
        if asked == output {
            change(&mut block);
        }
        Ok(block)
    };
    let subject = Subject {
        outputs: &Output::EACH,
        arm: &arm,
        beyond: None,
        generated: &generated,
        single: None,
    };
    agreement(&subject, 20, 0, &|_| {})
}

#[test]
fn a_small_mistake_is_found_by_every_comparison() {
    let found = checked(Output::Jacobian, |block| block[1] += 1e-6);
    for line in &found.lines {
        let exceeded: Vec<Comparison> = line.exceeded().collect();
        if line.output == Output::Jacobian {
            let each = [Comparison::Textbook, Comparison::Differences, Comparison::Dual];
            assert_eq!(exceeded, each);
        } else {
            assert_eq!(exceeded, [], "{line:?}");
        }
    }
}

#[test]
fn what_cannot_be_compared_does_not_agree() {
    let changes: [fn(&mut Vec<f64>); 2] = [Vec::clear, |block| block[0] = f64::NAN];
    for change in changes {
        let found = checked(Output::Pose, change);
        assert_eq!(found.lines[0].worst[0], Some(f64::INFINITY));
        assert_eq!(found.lines[0].exceeded().count(), 1);
    }
}
