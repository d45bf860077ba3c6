//! Numbers in which nothing is linear: the row of a jump, an order, a threshold.

use nalgebra::Vector6;
use stiffarm_gap::measurement::{Kind, Row};
use stiffarm_gap::simulate::simulate;
use stiffarm_gap::{Options, diagnose};
use stiffarm_plant::design::{Design, Shape};
use stiffarm_plant::{Noise, Plant, Truth};

use crate::fixture::{rigid, row, springy, table};
use crate::noisy::POSE;

#[test]
fn a_jump_among_very_many_rows_is_placed_at_its_row() {
    let (arm, after) = (rigid(), 1234);
    let kind = Kind::Pose { orientation: false };
    // More rows between two of the moments that are tried at first than the 256 that are tried at once.
    let rows = (0..24 * 256).map(|k| {
        let at = k as f64;
        let q = [(0.7 * at).sin(), (1.3 * at).cos(), (2.1 * at).sin()];
        let mut row = Row { group: k, ..row(&q, Vector6::zeros()) };
        let read = simulate(&arm, &row, kind).unwrap().reading().vector();
        let jump = if k < after { 0.0 } else { 3e-4 };
        let noise = Vector6::from_fn(|c, _| 1e-5 * (91.7 * at + 7.0 * c as f64).sin());
        row.measured = (read + noise).component_mul(&Vector6::new(1.0, 1.0, 1.0, 0.0, 0.0, 0.0));
        row.measured.y += jump;
        row
    });
    let data = table(rows.collect(), kind);
    let options = Options { effects: Some(vec!["slip".to_owned()]), ..Options::default() };
    let found = diagnose(&arm, &data, &options).unwrap().findings;
    assert_eq!((&*found[0].effect, found[0].place.as_str()), ("slip", "base"));
    assert_eq!(found[0].parameters[0].value, after as f64);
}

/// Found by another program's arm: numbers between those that are tried at first.
#[test]
fn numbers_in_which_nothing_is_linear_are_found() {
    let mut arm = springy();
    arm.joints[2].drive.gear = 101.0;
    let design =
        Design { shape: Shape::Force, poses: 60, repeats: 1, payload: 15.0, kind: POSE, seed: 3 };
    let noise = Noise { position: 2e-5, rotation: 4e-5 };
    let cases = [
        ("motor_error@joint 3:order=202.37,cos=0.2 mrad,sin=-0.3 mrad", 202.37, 0.02),
        ("soft_zone@joint 2:threshold=40,compliance=1e-5", 40.0, 1.0),
    ];
    for (text, number, within) in cases {
        let truth = Truth::parse(text, &arm).unwrap();
        let plant = Plant::new(&arm, std::slice::from_ref(&truth)).unwrap();
        let data = plant.measure(&design.rows(&arm), noise, 5).unwrap();
        let options = Options {
            noise_position: Some(noise.position),
            noise_rotation: Some(noise.rotation),
            ..Options::default()
        };
        let found = diagnose(&arm, &data, &options).unwrap().findings;
        let [finding] = &found[..] else { panic!("{text}: {found:?}") };
        let (effect, place) = (truth.effect.identifier(), truth.place.to_string());
        assert_eq!((&*finding.effect, &finding.place), (effect, &place));
        let first = &finding.parameters[0];
        assert!((first.value - number).abs() < within, "{text}: {first:?}");
        assert!((first.ci95[0]..=first.ci95[1]).contains(&number), "{text}: {first:?}");
        for parameter in &finding.parameters[1..] {
            let [low, high] = parameter.ci95;
            assert!((low..=high).contains(&truth.value(&parameter.name)), "{parameter:?}");
        }
    }
}
