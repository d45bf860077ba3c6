//! Rows that do not fit, and ordinary calibration, which is no finding of a place.

use stiffarm_gap::diagnose::LeftOut;
use stiffarm_gap::rng::{Rng, Stream};
use stiffarm_gap::simulate::simulate;
use stiffarm_gap::{Options, diagnose};

use super::only;
use crate::fixture::bent;
use crate::noisy::{POSE, data, normal};

#[test]
fn rows_that_do_not_fit_are_named_and_leave_the_rest_as_it_is() {
    let clean = data(20, [0.0, 4e-6, 0.0], 2e-5, 11);
    let mut bad = clean.clone();
    bad.rows[9].measured[0] += 5e-3;
    bad.rows[30].measured[2] -= 4e-3;
    let options = Options::default();
    let [without, with] = [&clean, &bad].map(|data| diagnose(&bent(), data, &options).unwrap());
    assert!(without.left_out.is_empty(), "{:?}", without.left_out);
    let [first, second] = &with.left_out[..] else { panic!("{:?}", with.left_out) };
    assert_eq!([first.line, second.line], [bad.rows[9].line, bad.rows[30].line]);
    // The noise of three numbers, some four of its deviations.
    let far = |row: &LeftOut| row.position.unwrap();
    assert!((far(first) - 5e-3).abs() < 1e-4 && (far(second) - 4e-3).abs() < 1e-4);
    for d in [&without, &with] {
        let finding = only(d, ("joint_compliance", "joint 2"));
        let [low, high] = finding.parameters[0].ci95;
        assert!((low..=high).contains(&4e-6), "{low} {high}");
    }
    assert!((with.gap.after.position_rms / without.gap.after.position_rms - 1.0).abs() < 0.1);
    let kept = Options { keep_all: true, ..Options::default() };
    let kept = diagnose(&bent(), &bad, &kept).unwrap();
    assert!(kept.left_out.is_empty());
    assert!(kept.gap.after.position_rms > 10.0 * with.gap.after.position_rms);
}

/// What is left of clean data is the rounding of sums: no row stands out of it, and how far it shrinks is plain.
#[test]
fn clean_data_leave_nothing_to_tell() {
    let clean = data(20, [0.0, 4e-6, 0.0], 0.0, 11);
    let found = diagnose(&bent(), &clean, &Options::default()).unwrap();
    only(&found, ("joint_compliance", "joint 2"));
    assert!(found.left_out.is_empty() && found.residual.is_none(), "{:?}", found.left_out);
    let [low, high] = found.gap.shrink.shrink_ci95;
    assert!(low > 1.0 - 1e-6 && high <= 1.0, "{low} {high}");
}

/// A load that is mistyped decides alone what gives under it, and what is found hides that it is wrong:
/// ten times too large, of the wrong sign, or far beyond what the arm bears.
#[test]
fn a_load_that_is_mistyped_decides_nothing() {
    let clean = data(20, [0.0, 4e-6, 0.0], 2e-5, 11);
    let size = |k: &usize| clean.rows[*k].wrench.norm();
    let loaded = (0..clean.rows.len()).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap();
    for factor in [10.0, -10.0, 1e4, 1e12] {
        let mut bad = clean.clone();
        bad.rows[loaded].wrench *= factor;
        let found = diagnose(&bent(), &bad, &Options::default()).unwrap();
        let [finding] = &found.findings[..] else { panic!("{factor} {:?}", found.findings) };
        assert_eq!((&*finding.effect, finding.place.as_str()), ("joint_compliance", "joint 2"));
        let [out] = &found.left_out[..] else { panic!("{factor} {:?}", found.left_out) };
        assert_eq!(out.line, bad.rows[loaded].line);
        let no_rest = out.position.is_none();
        assert!(if factor > 1e6 { no_rest } else { factor > 10.0 || !no_rest }, "{factor}");
    }
    // One that is as large as it says is counted as soon as it is foreseen.
    let mut large = clean.clone();
    let row = &mut large.rows[loaded];
    row.wrench *= 10.0;
    let mut plant = bent();
    plant.joints[1].compliance += 4e-6;
    row.measured = simulate(&plant, row, large.kind).unwrap().reading().vector();
    let found = diagnose(&bent(), &large, &Options::default()).unwrap();
    assert!(found.left_out.is_empty(), "{:?}", found.left_out);
}

#[test]
fn ordinary_calibration_is_one_finding_or_fitted_along() {
    let mut plant = bent();
    let mut rng = Rng::new(3, Stream::Signs);
    for joint in &mut plant.joints {
        joint.theta += 5e-4 * normal(&mut rng);
        joint.alpha += 5e-4 * normal(&mut rng);
        joint.a += 3e-4 * normal(&mut rng);
        joint.d += 3e-4 * normal(&mut rng);
    }
    let mut data = data(40, [0.0; 3], 0.0, 4);
    for row in &mut data.rows {
        let exact = simulate(&plant, row, POSE).unwrap();
        row.measured = exact.reading().vector().map(|x| x + 2e-5 * normal(&mut rng));
    }
    let found = diagnose(&bent(), &data, &Options::default()).unwrap();
    only(&found, ("geometry", "arm"));
    assert!(found.gap.after.position_rms < 1.2 * found.gap.noise.position_rms);
    let mut along = Options::default();
    along.fit_along(&["geometry".to_owned()]).unwrap();
    let found = diagnose(&bent(), &data, &along).unwrap();
    assert!(found.findings.is_empty(), "{:?}", found.findings);
    assert!(found.gap.before.position_rms < 1.2 * found.gap.noise.position_rms);
    let nested = Options { nested: true, ..Options::default() };
    let nested = diagnose(&bent(), &data, &nested).unwrap().gap;
    for anew in [nested.nested, nested.nested_in_time] {
        let left = anew.unwrap().position_rms / nested.after.position_rms;
        assert!((0.9..1.2).contains(&left), "{left}");
    }
}
