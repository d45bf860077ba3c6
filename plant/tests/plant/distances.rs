//! One number a row: a ball bar's distance, a touch probe's coordinate.

use nalgebra::{Isometry3, Vector3, Vector6};
use stiffarm_gap::diagnose::Diagnosed;
use stiffarm_gap::instrument::{Aim, Bench, Seen, View};
use stiffarm_gap::measurement::{Kind, Row};
use stiffarm_gap::simulate::simulate;
use stiffarm_gap::{Measurements, Options, diagnose_with};
use stiffarm_kernels::generic::{Arm, Convention};
use stiffarm_plant::design::{Design, Shape};
use stiffarm_plant::{Noise, csv};

use crate::arms::{EXACT, SOFT, layout, loaded, plant, reading, rows, soft_joint_is_found, sprung};

const NOISE: Noise = Noise { position: 2e-5, rotation: 0.0 };

fn design(arm: &Arm, kind: Kind) -> Measurements {
    let (shape, seed) = (Shape::Payload, 5);
    Design { shape, poses: 40, repeats: 1, payload: 20.0, kind, seed }.rows(arm)
}

fn found(arm: &Arm, data: &Measurements) -> Diagnosed {
    diagnose_with(arm, data, &Options::default(), &|_| {}).expect("a diagnosis")
}

#[track_caller]
fn is_found(found: &Diagnosed) {
    let d = &found.diagnosis;
    soft_joint_is_found(d);
    let left = d.gap.after.position_rms / NOISE.position;
    assert!((0.7..1.3).contains(&left), "{left}");
}

#[test]
fn a_distance_is_that_of_the_measured_point() {
    let arm = sprung(Convention::Modified);
    let mut row = reading(&[0.4, -0.7, 0.2, 0.9, -0.3], [30.0, -20.0, -90.0, 1.0, 2.0, 3.0]);
    let from = Vector3::new(0.3, -0.2, 0.5);
    let view = View::Distance { from, offset: 0.0 };
    row.aim = Some(Box::new(Aim::known(Seen::Distance, "", view)));
    row.offset = Some([0.0, 0.1, 0.02]);
    let at = simulate(&arm, &row, Kind::Pose { orientation: true }).expect("at rest").reading();
    // In space the marker is where the instrument of poses sees it.
    let far = (at.position - from).norm();
    let seen = simulate(&arm, &row, Kind::Distance).expect("at rest");
    assert!((seen.reading().vector() - Vector6::ith(0, far)).amax() < 1e-15);
    let told = plant(&arm, &[]).measure(&rows(Kind::Distance, vec![row]), EXACT, 0).expect("rows");
    let apart = told.rows[0].measured[0] - far;
    assert!(apart.abs() < 1e-11, "{apart:e}");
}

#[test]
fn a_ball_bar_shows_a_soft_joint() {
    let arm = loaded(Convention::Standard);
    let data = plant(&arm, &[SOFT]).measure(&design(&arm, Kind::Distance), NOISE, 1).expect("rows");
    is_found(&found(&arm, &data));
    // As a file it is the same campaign.
    let text = csv(&arm, &data, &[]);
    let layout = layout(&arm, Bench::NONE);
    let read = Measurements::from_bytes("bar.csv", text.as_bytes(), &layout).expect("a file");
    assert_eq!((read.kind, read.poses), (Kind::Distance, data.poses));
    let same = |(a, b): (&Row, &Row)| a.measured == b.measured && a.aim == b.aim;
    assert!(read.rows.iter().zip(&data.rows).all(same));
}

#[test]
fn a_point_that_nobody_knows_is_fitted_along() {
    let arm = loaded(Convention::Standard);
    let mut data =
        plant(&arm, &[SOFT]).measure(&design(&arm, Kind::Distance), NOISE, 1).expect("rows");
    let was = data.rows[0].aim.as_ref().and_then(|aim| aim.view.place()).expect("a place");
    let socket = |name: &str| Some(Box::new(Aim::at(Seen::Distance, name)));
    data.rows.iter_mut().for_each(|row| row.aim = socket("socket"));
    let found = found(&arm, &data);
    is_found(&found);
    let [point] = &found.diagnosis.nuisances[..] else { panic!("{:?}", found.diagnosis.nuisances) };
    // 120 distances to 20 µm, all around the point.
    let off = (Vector3::from(point.translation) - was).norm();
    assert!(point.name == "socket" && off < 5e-5, "{off:e}");
    let same = found.explanation.predict(&data).expect("predicted");
    let [before, after] = [&same.before, &same.after].map(|gaps| gaps[7][0].abs());
    assert!(before.is_finite() && after < 1e-4, "{before:e} {after:e}");
    // One that only the other file has is fitted to it.
    data.rows.iter_mut().for_each(|row| row.aim = socket("another"));
    let again = found.explanation.predict(&data).expect("predicted").after;
    let squares: f64 = again.iter().map(|gap| gap[0] * gap[0]).sum();
    let left = (squares / again.len() as f64).sqrt() / NOISE.position;
    assert!((0.7..1.3).contains(&left), "{left}");
}

#[test]
fn a_touch_probe_shows_a_soft_joint_by_one_coordinate() {
    let mut arm = loaded(Convention::Standard);
    arm.base = Isometry3::translation(0.2, 0.0, 0.1);
    let kind = Kind::Coordinates { components: [false, false, true] };
    let data = plant(&arm, &[SOFT]).measure(&design(&arm, kind), NOISE, 1).expect("rows");
    assert!(data.rows.iter().all(|row| row.measured[0] == 0.0 && row.measured[2] != 0.0));
    is_found(&found(&arm, &data));
}
