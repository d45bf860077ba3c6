//! An arm whose base leans in the measuring frame: whose axes its loads are told in.

use nalgebra::{Isometry3, Rotation3, Vector3, Vector6};
use stiffarm_gap::diagnose::{Diagnosed, Nuisance};
use stiffarm_gap::{Measurements, Options, diagnose_with};
use stiffarm_kernels::generic::Arm;
use stiffarm_plant::design::{Design, Shape};
use stiffarm_plant::{Noise, Plant};

use crate::fixture::springy;
use crate::noisy::POSE;

/// As a rotation vector, rad.
const LEANS: [f64; 3] = [0.03, -0.02, 0.8];

fn turned(turn: &Rotation3<f64>, w: &Vector6<f64>) -> Vector6<f64> {
    let [force, moment] = [0, 3].map(|k| turn * w.fixed_rows::<3>(k));
    Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
}

/// What a tracker sees of it under the loads of `rows`, which are told in its axes, or in the arm's.
fn measured(rows: &Measurements, as_measured: bool, seed: u64) -> Measurements {
    let turn = Rotation3::new(Vector3::from(LEANS));
    let mut arm =
        Arm { base: Isometry3::from_parts(Vector3::z().into(), turn.into()), ..springy() };
    let mut own = rows.clone();
    if as_measured {
        arm.gravity = turn.inverse() * arm.gravity;
        own.rows.iter_mut().for_each(|row| row.wrench = turned(&turn.inverse(), &row.wrench));
    }
    let plant = Plant::new(&arm, &[]).unwrap();
    let noise = Noise { position: 2e-5, rotation: 2e-5 };
    let mut seen = plant.measure(&own, noise, seed).unwrap();
    seen.rows.iter_mut().zip(&rows.rows).for_each(|(row, told)| row.wrench = told.wrench);
    seen
}

fn found(as_measured: bool, seed: u64) -> Diagnosed {
    let design =
        Design { shape: Shape::Force, poses: 40, repeats: 1, payload: 20.0, kind: POSE, seed };
    let nuisances = vec![Nuisance::BaseFrame];
    let options = Options { nuisances, ..Options::default() };
    let data = measured(&design.rows(&springy()), as_measured, seed);
    diagnose_with(&springy(), &data, &options, &|_| {}).unwrap()
}

#[test]
fn the_data_say_whose_axes_loads_and_gravity_are_told_in() {
    for seed in 0..stiffarm_draws::few_or_many(2, 6) {
        for as_measured in [false, true] {
            let Diagnosed { diagnosis, explanation, .. } = found(as_measured, seed);
            assert_eq!(diagnosis.hangs_as_measured, as_measured, "seed {seed}");
            assert!(diagnosis.findings.is_empty(), "seed {seed}: {:?}", diagnosis.findings);
            let lean = Rotation3::new(Vector3::from(LEANS)).inverse() * -Vector3::z();
            let down = if as_measured { lean } else { -Vector3::z() };
            let off = explanation.arm().gravity.normalize() - down;
            assert!(off.norm() < 1e-3, "seed {seed}: {off}");
        }
    }
}
