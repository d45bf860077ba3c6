//! Parallel axes: links in a plane, of arms of fewer than six joints, and the triangle that they and larger arms have.
//!
//! With axes j, j + 1, j + 2 parallel, `Rz(θ_j) L_j Rz(θ_{j+1}) L_{j+1} Rz(θ_{j+2}) v = Rz(φ) (v_x, ±v_y, ±v_z)` but for
//! lengths: the direction of what the joints behind them hold gives φ, the place in the plane the triangle.

use super::Branch;
use super::displacement::{about_x_back, about_z_back};
use super::layout::{Layout, Value};
use super::subproblem::{
    Free, Pair, angle_between, nearest_turn, square, turned, turned_back, two_angles,
};
use super::wrist;
use crate::expr::{Expr, Vec3};

/// What three parallel axes are to reach, in the plane across them.
pub(super) struct Trio {
    /// The first of them, from 0.
    pub first: usize,
    /// Cosine and sine of the sum of their angles.
    pub normal: Pair,
    /// Where the second link behind the first axis ends.
    pub end: Pair,
}

/// Their angles for both elbows, and what of the place in the plane is missed.
pub(super) fn triangle(arm: &mut Layout, trio: Trio) -> [([Pair; 3], Pair); 2] {
    let Trio { first, normal, end } = trio;
    let [second_side, third_side] = [arm.alpha[first][0], arm.alpha[first + 1][0]];
    let free = Free { near: arm.near[first], tiny: arm.tiny };
    let (g, near, far) = (&mut arm.g, arm.a[first], arm.a[first + 1]);
    let (reach, own) = (square(g, end), square(g, [near, far]));
    let right = g.sub(reach, own);
    let product = g.mul(near, far);
    let twice = g.add(product, product);
    two_angles(g, [twice, Expr::ZERO], right, None).map(|third| {
        let [x, y] = third.map(|component| g.mul(far, component));
        let from = [g.add(near, x), g.mul(second_side, y)];
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

/// Every branch of an arm of at most five joints, of which three axes are parallel: with a joint before them or not, and one
/// joint behind them or none; or with a prismatic one along them.
pub(super) fn branches(arm: &mut Layout, before: bool, behind: usize, lift: bool) -> Vec<Branch> {
    let first = usize::from(before);
    let point = arm.beside_tip();
    // What the rows move along the parallel axes, as the first of them counts; the joint behind them stands on its own.
    let sides = [arm.alpha[first][0], arm.alpha[first + 1][0]];
    let side = arm.g.mul(sides[0], sides[1]);
    let mut lever = arm.lever;
    let tip = match (behind, lift) {
        (0, false) => arm.tip,
        (0, true) => {
            // What the tool is behind the prismatic joint, in the frame that the last axis turns.
            let g = &mut arm.g;
            let [x, y] = turned(g, arm.offsets[3], [lever[0], lever[1]]);
            lever = [g.add(arm.a[2], x), g.mul(arm.alpha[2][0], y), Expr::ZERO];
            arm.tip
        }
        _ => point,
    };
    let held = match behind {
        0 => lever[2],
        _ => {
            let last = arm.g.add(arm.d[first + 3], arm.lever[2]);
            arm.g.mul(arm.alpha[first + 2][0], last)
        }
    };
    let mut along = arm.g.add(arm.d[first + 2], held);
    for (k, side) in sides.into_iter().enumerate().rev() {
        along = arm.g.mul(side, along);
        along = arm.g.add(along, arm.d[first + k]);
    }
    let planes = match before {
        false => vec![None],
        true => {
            let ([cosine, sine], free) = (arm.alpha[0], Free { near: arm.near[0], tiny: arm.tiny });
            let g = &mut arm.g;
            // cos α_1 p_z − sin α_1 (−sin θ_1 p_x + cos θ_1 p_y).
            let height = g.sub(tip[2], arm.d[0]);
            let part = g.mul(cosine, height);
            let rest = g.sub(part, along);
            let inverse = g.recip(sine);
            let right = g.mul(rest, inverse);
            two_angles(g, [tip[1], -tip[0]], right, Some(free)).map(Some).to_vec()
        }
    };
    let mut out = Vec::with_capacity(4);
    for plane in planes {
        let mut axes = arm.target.axes;
        let mut at = tip;
        if let Some(first) = plane {
            let (g, alpha) = (&mut arm.g, arm.alpha[0]);
            axes = axes.map(|axis| {
                let axis = about_z_back(g, first, axis);
                about_x_back(g, alpha, axis)
            });
            at[2] = g.sub(at[2], arm.d[0]);
            let [x, y, z] = about_z_back(g, first, at);
            let x = g.sub(x, arm.a[0]);
            at = about_x_back(g, alpha, [x, y, z]);
        }
        let normal = sum_of_angles(arm, axes, (first, behind, lift), side);
        // Where the second link behind the first of the axes ends.
        let held: Vec3 = match behind {
            0 => lever,
            _ => {
                let last = arm.g.add(arm.d[first + 3], arm.lever[2]);
                let [_, sine] = arm.alpha[first + 2];
                [arm.a[first + 2], -arm.g.mul(sine, last), Expr::ZERO]
            }
        };
        let g = &mut arm.g;
        let in_plane = [held[0], g.mul(side, held[1])];
        let from = turned(g, normal, in_plane);
        let end = [g.sub(at[0], from[0]), g.sub(at[1], from[1])];
        let fifth = (behind > 0).then(|| {
            // Behind the parallel axes and the link to the last joint.
            let alpha = arm.alpha[first + 2];
            let left = axes.map(|axis| {
                let [x, y, z] = about_z_back(&mut arm.g, normal, axis);
                let seen = [x, arm.g.mul(side, y), arm.g.mul(side, z)];
                about_x_back(&mut arm.g, alpha, seen)
            });
            wrist::last_turn(arm, left)
        });
        let slide = lift.then(|| {
            let rest = arm.g.sub(at[2], along);
            let all = arm.g.mul(side, arm.alpha[2][0]);
            let rest = arm.g.mul(all, rest);
            arm.g.sub(rest, arm.lever[2])
        });
        for (angles, _) in triangle(arm, Trio { first, normal, end }) {
            let mut joints: Vec<Value> = plane.into_iter().chain(angles).map(Value::Turn).collect();
            joints.extend(fifth.map(Value::Turn));
            joints.extend(slide.map(Value::Slide));
            let (distance, tilt) = arm.missed(&joints);
            out.push(Branch { joints, distance, tilt });
        }
    }
    out
}

/// Cosine and sine of the sum of the parallel axes' angles by the target's axes in their plane: such that the axis of the joint
/// behind them is as near as it comes, or the whole of the tool where there is none.
fn sum_of_angles(
    arm: &mut Layout,
    axes: [Vec3; 3],
    (first, behind, lift): (usize, usize, bool),
    side: Expr,
) -> Pair {
    let near = {
        let g = &mut arm.g;
        let last = [arm.near[first + 2][0], g.mul(arm.alpha[first + 1][0], arm.near[first + 2][1])];
        let pair = turned(g, arm.near[first + 1], last);
        let pair = [pair[0], g.mul(arm.alpha[first][0], pair[1])];
        turned(g, arm.near[first], pair)
    };
    let mut free = wrist::free(arm, first);
    free.near = near;
    let g = &mut arm.g;
    if behind > 0 {
        let [_, sine] = arm.alpha[first + 2];
        let from = [Expr::ZERO, -g.mul(side, sine)];
        return angle_between(g, from, [axes[2][0], axes[2][1]], Some(free));
    }
    let [x, y, _] = axes.map(|axis| [axis[0], axis[1]]);
    let (mut along, mut across) = (x, y);
    let mut side = side;
    if lift {
        // The target's axes are those behind the prismatic joint: Rz(φ) Rx Rx(α) Rz(τ).
        let [c, s] = arm.offsets[3];
        along = [0, 1].map(|k| {
            let (a, b) = (g.mul(c, x[k]), g.mul(s, y[k]));
            g.sub(a, b)
        });
        across = [0, 1].map(|k| {
            let (a, b) = (g.mul(s, x[k]), g.mul(c, y[k]));
            g.add(a, b)
        });
        side = g.mul(side, arm.alpha[2][0]);
    }
    let across = across.map(|component| g.mul(side, component));
    nearest_turn(g, along, across, free)
}

/// Both branches of two parallel axes that bring the tool's origin where it is to be in their plane.
pub(super) fn two(arm: &mut Layout) -> Vec<Branch> {
    let ([x, y, _], [lx, ly, _]) = (arm.tip, arm.lever);
    let (side, a) = (arm.alpha[0][0], arm.a[0]);
    let free_first = Free { near: arm.near[0], tiny: arm.tiny };
    let g = &mut arm.g;
    let (reach, own, inner) = (square(g, [x, y]), g.mul(a, a), square(g, [lx, ly]));
    let right = g.sub(reach, own);
    let right = g.sub(right, inner);
    let by = [lx, -ly].map(|length| {
        let product = g.mul(a, length);
        g.add(product, product)
    });
    let seconds = two_angles(g, by, right, None);
    let each = seconds.into_iter().map(|second| {
        let g = &mut arm.g;
        let [tx, ty] = turned(g, second, [lx, ly]);
        let from = [g.add(a, tx), g.mul(side, ty)];
        let first = angle_between(g, from, [x, y], Some(free_first));
        let joints = vec![Value::Turn(first), Value::Turn(second)];
        let (distance, tilt) = arm.missed(&joints);
        Branch { joints, distance, tilt }
    });
    each.collect()
}
