//! An error periodic in the joint's angle: an eccentric encoder (order 1), a wavy gear (order 2), the
//! teeth of a stage (10 and more).
//!
//! Each order is a form of its own and may be found beside others. Orders 1 and 2 are confused with
//! offset and ratio of the joint where it covers less than a turn, high orders with each other
//! where poses are few: spread the joint's angles over its range, not on a grid.

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use crate::effects::{Carrier, Effect, Parameter, Place, Scene, Spot};
use crate::measurement::{Measurements, Row};
use crate::simulate::{Actual, Moment};

/// Amplitudes of the cosine and the sine of `order · q`.
#[derive(Clone, Copy, Debug)]
pub struct TransmissionError;

/// Highest order that is tried.
const HIGHEST: usize = 40;

/// Angles closer than this are one, rad.
const SAME: f64 = 1e-3;

impl Effect for TransmissionError {
    fn identifier(&self) -> &'static str {
        "transmission_error"
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        let turns = |j: &usize| arm.joints[j - 1].motion == Motion::Revolute;
        (1..=arm.dof()).filter(turns).map(Place::Joint).collect()
    }

    /// The orders that as many different angles can carry, two numbers each.
    fn forms(&self, _: &Arm, place: Place, data: &Measurements) -> Vec<usize> {
        let mut angles: Vec<i64> =
            data.rows.iter().map(|r| (r.q[place.row()] / SAME).round() as i64).collect();
        angles.sort_unstable();
        angles.dedup();
        (1..=HIGHEST.min(angles.len() / 3)).collect()
    }

    fn parameters(&self, _: &Arm, spot: Spot, _: &Measurements) -> Vec<Parameter> {
        let named =
            |name: &str| Parameter::free(format!("{name} {}", spot.form), "rad").usually(5e-3);
        vec![named("cos"), named("sin")]
    }

    fn alter(&self, actual: &mut Actual<'_>, row: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        let (sine, cosine) = (spot.form as f64 * row.q[spot.row()]).sin_cos();
        actual.turn(spot.row(), v[0] * cosine + v[1] * sine);
    }

    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        Some(Carrier::Joint(spot.row()))
    }

    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        let (sine, cosine) = (spot.form as f64 * scene.row.q[spot.row()]).sin_cos();
        motions.extend([cosine, sine]);
    }

    /// Each order from the one before it by the addition theorems: every step rounds once more, 40
    /// at the most, where each cosine and sine by itself would cost as much as all else of a row.
    fn motions_of(&self, scene: &Scene<'_>, spots: &[Spot], motions: &mut Vec<f64>) {
        let Some(first) = spots.first() else { return };
        let q = scene.row.q[first.row()];
        let (s, c) = q.sin_cos();
        let (mut order, (mut sine, mut cosine)) = (first.form, (first.form as f64 * q).sin_cos());
        for spot in spots {
            if spot.form < order {
                (order, (sine, cosine)) = (spot.form, (spot.form as f64 * q).sin_cos());
            }
            while order < spot.form {
                (sine, cosine) = (sine * c + cosine * s, cosine * c - sine * s);
                order += 1;
            }
            motions.extend([cosine, sine]);
        }
    }

    fn idle(&self) -> &'static str {
        "the joint does not turn"
    }
}
