//! The angles of an arm whose axes 2, 3 and 4 are parallel and whose axis 6 meets 5.
//!
//! The point where 5 and 6 meet gives θ_1 by its part along the parallel axes; axis 6's direction then gives θ_5, and what
//! of the parallel axes stands in the target θ_6. What is left is a triangle in a plane.

use super::Branch;
use super::displacement::{about_x_back, about_z_back};
use super::layout::{Layout, Value};
use super::plane::{Trio, first_turns, triangle};
use super::subproblem::{Pair, square};
use super::term::{Vector, dot};
use super::wrist::{Turned, two_turns};

pub(super) fn branches<'g>(arm: &Layout<'g>) -> Vec<Branch<'g>> {
    let point = arm.before_last();
    let [second, third] = [arm.alpha[1][0], arm.alpha[2][0]];
    let both = second * third;
    let point = [point[0], point[1], point[2] - arm.d[0]];
    // What the rows move along the parallel axes, as the first of them counts.
    let along = arm.alpha[3][0] * arm.d[4] + arm.d[3];
    let along = second * (third * along + arm.d[2]) + arm.d[1];
    let mut out = Vec::with_capacity(8);
    for first in first_turns(arm, point, along) {
        let axes = arm.target.axes.map(|axis| {
            let axis = about_z_back(first, axis);
            about_x_back(arm.alpha[0], axis)
        });
        let at = arm.behind_link(0, about_z_back(first, point));
        let off = at[2] - along;
        let row = axes.map(|axis| both * axis[2]);
        // The parallel axes behind joint 6 are Rz(−θ_6) Rx(−α_5) Rz(−θ_5) (0, sin α_4, cos α_4): with y mirrored a wrist from
        // its other end.
        let mirrored = [row[0], -row[1], row[2]];
        let wrists = two_turns(arm, mirrored, [arm.alpha[4], arm.alpha[3]], 5);
        let mut elbows: [Vec<Branch>; 2] = Default::default();
        for Turned { fifth, beside: sixth, tilt } in wrists {
            // Rz(−θ_6) Rx(−α_5) Rz(−θ_5) x, and the same of axis 5.
            let ([c, s], zero) = (fifth, off.zero());
            let seen = |v: Vector<'g>| -> Pair<'g> {
                let v = about_z_back(sixth, about_x_back(arm.alpha[4], v));
                [0, 1].map(|k| dot(core::array::from_fn(|column| axes[column][k]), v))
            };
            let normal = seen([c, -s, zero]);
            let axis = seen([zero, zero, off.one()]);
            // Where the third link ends.
            let end = core::array::from_fn(|k| {
                let (link, offset) = (arm.a[3] * normal[k], arm.d[4] * axis[k]);
                at[k] - link - offset
            });
            let trio = Trio { first: 1, normal, end };
            for (elbow, (angles, in_plane)) in triangle(arm, trio).into_iter().enumerate() {
                let distance = (square(in_plane) + off * off).sqrt();
                let [second, third, fourth] = angles;
                let angles = [first, second, third, fourth, fifth, sixth];
                let joints = angles.map(Value::Turn).to_vec();
                elbows[elbow].push(Branch { joints, distance, tilt });
            }
        }
        out.extend(elbows.into_iter().flatten());
    }
    out
}
