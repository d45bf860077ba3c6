//! What the links alone could ask of the joints, whatever their masses.

use nalgebra::Matrix3;
use stiffarm_kernels::generic::Arm;

use super::body::{Body, Piece};
use crate::course::State;
use crate::rng::{Rng, Stream};

/// Numbers of a link.
const NUMBERS: usize = 10;

/// Columns that span what any masses of the links ask in these states, a row for each joint of each: a
/// link's torques are linear in its ten numbers, and those of ten bodies of chance span them.
pub fn span(arm: &Arm, states: &[State]) -> Vec<Vec<f64>> {
    let mut rng = Rng::new(0, Stream::Arm);
    let bare = Body::of(arm).bare();
    let mut of_chance = |link: usize| {
        let root = Matrix3::from_fn(|_, _| rng.normal());
        let mut body = bare.clone();
        body.add(link, &Piece::about(rng.normal(), rng.normal3(), root * root.transpose()));
        body
    };
    let links = (0..arm.dof()).flat_map(|link| [link; NUMBERS]);
    let bodies: Vec<Body> = links.map(&mut of_chance).collect();
    let mut columns = vec![Vec::with_capacity(states.len() * arm.dof()); bodies.len()];
    for State { q, qd, qdd } in states {
        let posture = bare.posture(q);
        for (column, body) in columns.iter_mut().zip(&bodies) {
            column.extend(body.torques(&posture, qd, qdd, &arm.gravity));
        }
    }
    columns
}
