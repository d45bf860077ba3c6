//! The angles of an arm whose axes 2, 3 and 4 are parallel and whose axis 6 meets 5.
//!
//! The point where 5 and 6 meet gives θ_1 by its part along the parallel axes; axis 6's direction then gives θ_5, and what
//! of the parallel axes stands in the target θ_6. What is left is a triangle in a plane.

use super::Branch;
use super::displacement::{about_x_back, about_z_back};
use super::layout::{Layout, Value};
use super::plane::{Trio, triangle};
use super::subproblem::{Free, square, two_angles};
use super::wrist::{Turned, two_turns};
use crate::expr::{Expr, Vec3};

pub(super) fn branches(arm: &mut Layout) -> Vec<Branch> {
    let point = arm.before_last();
    let (g, [cosine, sine]) = (&mut arm.g, arm.alpha[0]);
    let [second, third] = [arm.alpha[1][0], arm.alpha[2][0]];
    let both = g.mul(second, third);
    let [px, py, pz] = [point[0], point[1], g.sub(point[2], arm.d[0])];
    // What the rows move along the parallel axes, as the first of them counts.
    let mut along = g.mul(arm.alpha[3][0], arm.d[4]);
    along = g.add(along, arm.d[3]);
    along = g.mul(third, along);
    along = g.add(along, arm.d[2]);
    along = g.mul(second, along);
    along = g.add(along, arm.d[1]);
    // cos α_1 p_z − sin α_1 (−sin θ_1 p_x + cos θ_1 p_y).
    let part = g.mul(cosine, pz);
    let rest = g.sub(part, along);
    let inverse = g.recip(sine);
    let right = g.mul(rest, inverse);
    let free_first = Free { near: arm.near[0], tiny: arm.tiny };
    let firsts = two_angles(g, [py, -px], right, Some(free_first));
    let mut out = Vec::with_capacity(8);
    for first in firsts {
        let plane = |arm: &mut Layout, v: Vec3| {
            let v = about_z_back(&mut arm.g, first, v);
            about_x_back(&mut arm.g, arm.alpha[0], v)
        };
        let axes = arm.target.axes.map(|axis| plane(arm, axis));
        let [x, y, z] = about_z_back(&mut arm.g, first, [px, py, pz]);
        let moved = [arm.g.sub(x, arm.a[0]), y, z];
        let at = about_x_back(&mut arm.g, arm.alpha[0], moved);
        let off = arm.g.sub(at[2], along);
        let row = axes.map(|axis| arm.g.mul(both, axis[2]));
        // The parallel axes behind joint 6 are Rz(−θ_6) Rx(−α_5) Rz(−θ_5) (0, sin α_4, cos α_4): with y mirrored a wrist from
        // its other end.
        let mirrored = [row[0], -row[1], row[2]];
        let wrists = two_turns(arm, mirrored, [arm.alpha[4], arm.alpha[3]], 5);
        let mut elbows: [Vec<Branch>; 2] = Default::default();
        for Turned { fifth, beside: sixth, tilt } in wrists {
            // Rz(−θ_6) Rx(−α_5) Rz(−θ_5) x, and the same of axis 5.
            let (g, far, [c, s]) = (&mut arm.g, arm.alpha[4], fifth);
            let mut seen = |v: Vec3| -> [Expr; 2] {
                let v = about_x_back(g, far, v);
                let v = about_z_back(g, sixth, v);
                [0, 1].map(|k| {
                    let row: Vec3 = core::array::from_fn(|column| axes[column][k]);
                    g.dot3(row, v)
                })
            };
            let normal = seen([c, -s, Expr::ZERO]);
            let axis = seen([Expr::ZERO, Expr::ZERO, Expr::ONE]);
            // Where the third link ends.
            let end = core::array::from_fn(|k| {
                let (link, offset) = (g.mul(arm.a[3], normal[k]), g.mul(arm.d[4], axis[k]));
                let rest = g.sub(at[k], link);
                g.sub(rest, offset)
            });
            let trio = Trio { first: 1, normal, end };
            for (elbow, (angles, in_plane)) in triangle(arm, trio).into_iter().enumerate() {
                let g = &mut arm.g;
                let (a, b) = (square(g, in_plane), g.mul(off, off));
                let sum = g.add(a, b);
                let distance = g.sqrt(sum);
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
