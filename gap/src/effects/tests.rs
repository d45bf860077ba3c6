//! Every block against small differences of the exact model.

use nalgebra::{Isometry3, Matrix6xX, Vector6};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Convention};

use super::*;
use crate::displacement::Displacement;
use crate::fixture::{bent, row, springy, table};
use crate::measurement::{Kind, Measurements};
use crate::simulate::{Actual, Reading, Sim, moments};

/// An arm of each convention, one with a prismatic joint; soft enough for loads to matter.
fn arms() -> Vec<Arm> {
    let mut modified = bent();
    modified.convention = Convention::Modified;
    modified.joints[1].drive.gear = 101.0;
    let mut prismatic = bent();
    prismatic.joints[2].motion = Motion::Prismatic;
    prismatic.joints[2].alpha = 0.4;
    let mut plain = springy();
    plain.convention = Convention::Modified;
    let mut plain_prismatic = prismatic.clone();
    plain_prismatic.joints.iter_mut().for_each(|j| j.beam = None);
    vec![bent(), modified, prismatic, springy(), plain, plain_prismatic]
}

#[test]
fn places_are_the_same_wherever_an_arm_stands() {
    for arm in arms() {
        let turn = Vector6::new(2.0, -1.0, 0.5, 1.1, -0.6, 2.0);
        let base = Displacement::new(&turn).transform() * arm.base;
        let moved = Arm { base, ..arm.clone() };
        for effect in AT_REST {
            assert_eq!(effect.places(&moved), effect.places(&arm), "{}", effect.identifier());
        }
    }
}

fn data(kind: Kind) -> Measurements {
    let w = Vector6::new(300.0, -200.0, -800.0, 20.0, -30.0, 10.0);
    let rows = (0..8).map(|k| {
        let at = f64::from(k);
        let mut row = row(&[0.3 + 0.4 * at, -0.7 + 0.2 * at, 0.4 - 0.1 * at], w * (0.5 + 0.1 * at));
        row.offset = Some([0.05, 0.1, 0.2]);
        row.direction = Some(vec![1, -1, 1]);
        row.temperature = Some(20.0 + at);
        row.time = Some(0.6 * at);
        row.group = k as usize;
        row
    });
    let mut data = table(rows.collect(), kind);
    data.sim_given = kind.components();
    data
}

/// The block and its central difference at row 5.
fn both(
    arm: &Arm,
    data: &Measurements,
    effect: &dyn AtRest,
    spot: Spot,
) -> (Matrix6xX<f64>, Matrix6xX<f64>) {
    let (row, when) = (&data.rows[5], &moments(data)[5]);
    let none = Vector6::zeros();
    let actual = |values: &[f64]| {
        let values = values.to_vec();
        move |loaded: bool| {
            let mut actual = Actual::new(arm, &row.q, if loaded { &row.wrench } else { &none });
            effect.alter(&mut actual, row, when, spot, &values);
            actual
        }
    };
    let count = effect.parameters(arm, spot).len();
    let zero = vec![0.0; count];
    let [x, y, z] = row.offset.unwrap_or_default();
    let measured = Isometry3::translation(x, y, z);
    let sim = Sim::of(data.kind, measured, None, actual(&zero)).unwrap();
    let block = sim.change(|state, loaded| {
        let actual = actual(&zero)(loaded);
        let point = sim.point(state);
        let base = &sim.base;
        let scene = Scene { nominal: arm, row, when, actual: &actual, state, point, base };
        effect.block(&scene, spot)
    });
    let size = block.amax().max(1e-12);
    // A change of about a micrometre.
    let step = 1e-6 / size;
    let columns = (0..count).map(|k| {
        let at = |h: f64| -> Reading {
            let mut values = zero.clone();
            values[k] = h;
            Sim::of(data.kind, measured, None, actual(&values)).unwrap().reading()
        };
        let (high, low) = (at(step), at(-step));
        let turn = (high.rotation * low.rotation.inverse()).scaled_axis();
        let shift = high.position - low.position;
        Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z) / (2.0 * step)
    });
    (block, Matrix6xX::from_columns(&columns.collect::<Vec<_>>()))
}

/// What they do is done by weights alone.
const WEIGHTS: [&str; 3] = ["link_weight", "link_com", "gravity_tilt"];

#[test]
fn every_block_is_the_derivative_of_the_exact_model() {
    let displacement = Kind::Displacement { components: [true; 6] };
    let one_reading = data(Kind::Pose { orientation: true });
    for arm in arms().into_iter().step_by(stiffarm_draws::few_or_many(2, 1)) {
        for kind in [Kind::Pose { orientation: true }, displacement] {
            let data = data(kind);
            for effect in AT_REST {
                for place in effect.places(&arm) {
                    let form = effect.forms(&arm, place, &data)[0];
                    let spot = Spot { place, form };
                    let (block, difference) = both(&arm, &data, effect, spot);
                    let error = (&block - &difference).amax();
                    // The blocks leave out how the change of posture changes the loads: of the
                    // second order in the deflection, here some 1 %.
                    let name = effect.identifier();
                    // Between two readings of one pose a weight cancels but for that part: it is
                    // held against what the weight does to one reading. So do lengths and turns, of
                    // which the blocks leave out that they make a beam longer or turn it, or tilt
                    // a joint's own axis.
                    let is_row = name == "link_geometry" || effect.is_tolerated();
                    let tilts = is_row && arm.convention == Convention::Modified
                        || name == "bearing_wobble";
                    let beams = arm.joints.iter().any(|j| j.beam.is_some());
                    let scale = match kind {
                        Kind::Displacement { .. } if beams || tilts => continue,
                        Kind::Displacement { .. } if WEIGHTS.contains(&name) => {
                            both(&arm, &one_reading, effect, spot).1.amax()
                        }
                        _ => difference.amax(),
                    };
                    assert!(
                        error <= 0.03 * scale + 1e-9,
                        "{name} at {place}, {:?} {kind:?}: {error} of {scale}\n{block}{difference}",
                        arm.convention
                    );
                }
            }
        }
    }
}

/// A load that hangs tilts with gravity: its force, and its moment about the tool.
#[test]
fn the_block_of_a_tilt_is_that_of_hanging_loads_too() {
    for arm in arms() {
        let mut data = data(Kind::Pose { orientation: true });
        for row in &mut data.rows {
            row.wrench = Vector6::new(0.0, 0.0, -800.0, 60.0, -90.0, 0.0);
        }
        let (block, difference) = both(&arm, &data, &GravityTilt, Spot::at(Place::Base));
        let error = (&block - &difference).amax();
        assert!(error <= 0.03 * difference.amax(), "{block}{difference}");
    }
}

/// What is said of an effect is said whole: sentences, and no effect that there is not.
#[test]
fn every_effect_says_what_it_is() {
    let all = Entry::all();
    for law in all.iter().flat_map(Entry::laws) {
        let Facts { identifier, reality, signature, confused_with, separated_by, .. } =
            *law.facts();
        for text in [reality, signature, confused_with, separated_by] {
            assert!(text.ends_with('.') && !text.contains("  "), "{identifier}: {text}");
        }
        assert!(!law.facts().formula.is_empty(), "{identifier}");
        for name in confused_with.split('`').skip(1).step_by(2) {
            let known = all.iter().any(|other| other.is_called(name));
            assert!(known && name != identifier, "{identifier}: {name}");
        }
    }
}

/// An identifier belongs to one effect, and to one of its laws at rest, on torques or on positions at one place.
#[test]
fn identifiers_are_unique() {
    let all = Entry::all();
    for (k, entry) in all.iter().enumerate() {
        let names = entry.laws().map(Law::identifier).chain([entry.identifier]);
        let others = || all.iter().enumerate().filter(|(other, _)| *other != k);
        for name in names {
            assert!(others().all(|(_, other)| !other.is_called(name)), "{name}");
        }
    }
    let count = AT_REST.len() + IN_MOTION.len();
    assert_eq!(all.iter().map(|entry| entry.laws().count()).sum::<usize>(), count);
}

#[test]
fn a_joint_is_at_most_rigid() {
    let arm = bent();
    let data = data(Kind::Pose { orientation: true });
    let spot = Spot::at(Place::Joint(2));
    let parameters = JointCompliance.parameters(&arm, spot);
    assert_eq!(parameters[0].least, -arm.joints[1].compliance);
    let mut actual = Actual::new(&arm, &[0.0; 3], &Vector6::zeros());
    JointCompliance.alter(&mut actual, &data.rows[0], &moments(&data)[0], spot, &[-1.0]);
    assert_eq!(actual.arm.joints[1].compliance, 0.0);
}

#[test]
fn orders_from_one_another_are_those_by_themselves() {
    let (arm, data) = (bent(), data(Kind::Pose { orientation: true }));
    let (row, when) = (&data.rows[6], &moments(&data)[6]);
    let actual = Actual::new(&arm, &row.q, &row.wrench);
    let state = crate::simulate::rest(&actual, None).unwrap();
    let (point, base) = (state.tool.translation.vector, &actual.base);
    let scene = Scene { nominal: &arm, row, when, actual: &actual, state: &state, point, base };
    let place = Place::Joint(2);
    let spots = [1, 2, 5, 40, 39, 3].map(|form| Spot { place, form });
    let (mut together, mut each) = (Vec::new(), Vec::new());
    TransmissionError.motions_of(&scene, &spots, &mut together);
    spots.iter().for_each(|spot| TransmissionError.motions(&scene, *spot, &mut each));
    assert_eq!(together.len(), 2 * spots.len());
    // Forty steps of a few roundings each.
    let apart = together.iter().zip(&each).map(|(a, b)| (a - b).abs());
    assert!(apart.fold(0.0, f64::max) < 40.0 * 4.0 * f64::EPSILON);
}
