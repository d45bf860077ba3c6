//! The angles of an arm whose axes 2, 3 and 4 are parallel and whose axis 6 meets 5.
//!
//! The point where 5 and 6 meet gives θ_1 by its part along the parallel axes; axis 6's direction then gives θ_5, and what
//! of the parallel axes stands in the target θ_6. What is left is a triangle in a plane.

use super::Branch;
use super::layout::{Layout, about_x_back, about_z_back};
use super::subproblem::{Free, Pair, angle_between, square, turned, turned_back, two_angles};
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
            for (elbow, (angles, in_plane)) in
                triangle(arm, axes, at, [fifth, sixth]).into_iter().enumerate()
            {
                let g = &mut arm.g;
                let (a, b) = (square(g, in_plane), g.mul(off, off));
                let sum = g.add(a, b);
                let distance = g.sqrt(sum);
                let [second, third, fourth] = angles;
                let angles = [first, second, third, fourth, fifth, sixth];
                elbows[elbow].push(Branch { angles, distance, tilt });
            }
        }
        out.extend(elbows.into_iter().flatten());
    }
    out
}

/// θ_2, θ_3, θ_4 for both elbows, and what of the place in the plane is missed.
fn triangle(
    arm: &mut Layout,
    axes: [Vec3; 3],
    at: Vec3,
    [fifth, sixth]: [Pair; 2],
) -> [([Pair; 3], Pair); 2] {
    let [second_side, third_side] = [arm.alpha[1][0], arm.alpha[2][0]];
    let far = arm.alpha[4];
    let (near_second, tiny) = (arm.near[1], arm.tiny);
    let (g, a, d) = (&mut arm.g, arm.a, arm.d[4]);
    // Rz(−θ_6) Rx(−α_5) Rz(−θ_5) x, and the same of axis 5.
    let [c, s] = fifth;
    let normal = about_x_back(g, far, [c, -s, Expr::ZERO]);
    let normal = about_z_back(g, sixth, normal);
    let axis = about_x_back(g, far, [Expr::ZERO, Expr::ZERO, Expr::ONE]);
    let axis = about_z_back(g, sixth, axis);
    let mut in_plane = |v: Vec3| -> Pair {
        [0, 1].map(|k| {
            let row: Vec3 = core::array::from_fn(|column| axes[column][k]);
            g.dot3(row, v)
        })
    };
    let (normal, axis) = (in_plane(normal), in_plane(axis));
    // Where the third link ends.
    let end: Pair = core::array::from_fn(|k| {
        let (link, offset) = (g.mul(a[3], normal[k]), g.mul(d, axis[k]));
        let rest = g.sub(at[k], link);
        g.sub(rest, offset)
    });
    let (reach, own) = (square(g, end), square(g, [a[1], a[2]]));
    let right = g.sub(reach, own);
    let product = g.mul(a[1], a[2]);
    let twice = g.add(product, product);
    two_angles(g, [twice, Expr::ZERO], right, None).map(|third| {
        let [x, y] = third.map(|component| g.mul(a[2], component));
        let from = [g.add(a[1], x), g.mul(second_side, y)];
        let free = Free { near: near_second, tiny };
        let second = angle_between(g, from, end, Some(free));
        // The turn of the fourth row: θ_2 ± θ_3 ± θ_4.
        let third_turn = [third[0], g.mul(second_side, third[1])];
        let before = turned(g, second, third_turn);
        let [cosine, sine] = turned_back(g, before, normal);
        let side = g.mul(second_side, third_side);
        let fourth = [cosine, g.mul(side, sine)];
        let reached = turned(g, second, from);
        let off = [g.sub(end[0], reached[0]), g.sub(end[1], reached[1])];
        ([second, third, fourth], off)
    })
}
