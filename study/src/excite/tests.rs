//! The criterion by hand.

use super::*;
use crate::fixture::geared;
use crate::plant::motion::Side;

/// ln det of two columns by hand: friction of one joint that moves by itself, without other masses.
#[test]
fn the_criterion_is_the_determinant() {
    let arm = geared();
    let limits = Limits::of(&arm, &[1.0], &[3.0]).unwrap();
    let joint = Spot::of_joint(1);
    let [coulomb, viscous] =
        ["coulomb_friction", "viscous_friction"].map(|name| (Law::named(name).unwrap(), joint));
    let plan = Plan {
        arm: &arm,
        limits: &limits,
        logged: Logged::Torque(Side::Motor),
        purpose: Purpose::All(vec![coulomb, viscous]),
        period: 10.0,
        harmonics: 5,
        tries: 0,
        seed: 1,
    };
    let course = Fourier::draw(&limits, 10.0, 5, &mut Rng::new(4, Stream::Poses));
    let columns = Columns::of(&plan, &Suspects::of(&plan), &course).unwrap();
    // What is left of both beyond other masses, by their angle and lengths.
    let [a, b] = [0, 1].map(|k| nalgebra::DVector::from_column_slice(&columns.beyond_of(k)));
    let determinant = a.norm_squared() * b.norm_squared() - a.dot(&b).powi(2);
    assert!((columns.value(&plan) - determinant.ln()).abs() < 1e-9);
    let sd = columns.deviations();
    assert!((sd[0] - (b.norm_squared() / determinant).sqrt()).abs() < 1e-9 * sd[0]);
}
