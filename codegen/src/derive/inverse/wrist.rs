//! The last three angles of an arm whose last three axes meet: those that turn the tool as it is to be.
//!
//! With `M` the target's axes in frame 3, `M = Rz(θ_4) Rx(α_4) Rz(θ_5) Rx(α_5) Rz(θ_6)`: its last entry gives θ_5, its last
//! column θ_4, and what is then left θ_6.

use super::Branch;
use super::layout::{Layout, NOTHING, about_x_back, about_z_back};
use super::position::At;
use super::subproblem::{Free, Pair, angle_between, square, turned, turned_back, unit};
use crate::expr::{Expr, Vec3};
use crate::number::Number;

/// Two angles of a wrist, and how far the axis that they turn is from where it is to be.
pub(super) struct Turned {
    /// Of joint 5.
    pub fifth: Pair,
    /// Of the joint whose axis the other one turns about.
    pub beside: Pair,
    pub tilt: Expr,
}

/// Both pairs of angles with `Rz(beside) Rx(α) Rz(θ_5) (0, −sin β, cos β)` where `axis` is, for twists α and β; the joint
/// `beside` stays where the axis has no part across its own.
pub(super) fn two_turns(
    arm: &mut Layout,
    axis: Vec3,
    [near, far]: [Pair; 2],
    beside: usize,
) -> [Turned; 2] {
    let near_beside = arm.near[beside];
    let (g, [x, y, z]) = (&mut arm.g, axis);
    // Rx(α) Rz(θ) (0, −sin β, cos β)
    //   = (sin β sin θ, −cos α sin β cos θ − sin α cos β, −sin α sin β cos θ + cos α cos β).
    let [sines, cosines] = [1, 0].map(|k| g.mul(near[k], far[k]));
    let [lift, level] = [(near[0], far[1]), (near[1], far[0])].map(|(a, b)| g.mul(a, b));
    let (inverse, rest) = (g.recip(sines), g.sub(cosines, z));
    let c = g.mul(rest, inverse);
    let up = g.mul(lift, c);
    let up = g.add(up, level);
    let (across, own) = (square(g, [x, y]), g.mul(up, up));
    let left = g.sub(across, own);
    let left = g.positive_part(left);
    let (root, inverse) = (g.sqrt(left), g.recip(far[1]));
    let s = g.mul(root, inverse);
    let ([c, s], _) = unit(g, [c, s]);
    let (up, down) = (g.mul(lift, c), g.mul(sines, c));
    let (part, along) = (-g.add(up, level), g.sub(cosines, down));
    // Of a wrist of right angles the part across has one side or the other, however short it is.
    let right_angles = part.is_zero();
    let nothing = if right_angles { NOTHING } else { NOTHING * NOTHING };
    let free = Free { near: near_beside, tiny: g.number(Number::rounded(nothing)) };
    [-s, s].map(|s| {
        let own = [g.mul(s, far[1]), part];
        let side = match right_angles {
            true => [Expr::ONE.signed(own[0].is_negative()), Expr::ZERO],
            false => own,
        };
        let beside = angle_between(g, side, [x, y], Some(free));
        let tilt = match right_angles {
            true => Expr::ZERO,
            false => {
                let [ox, oy] = turned(g, beside, own);
                let off = [g.sub(x, ox), g.sub(y, oy), g.sub(z, along)];
                let square = g.dot3(off, off);
                g.sqrt(square)
            }
        };
        Turned { fifth: [c, s], beside, tilt }
    })
}

/// Both branches of the wrist at an angle of the first three.
pub(super) fn wrists(arm: &mut Layout, At { angles, distance }: At) -> [Branch; 2] {
    let [x, _, z] = arm.target.axes;
    let (first, last) = (behind_third(arm, angles, x), behind_third(arm, angles, z));
    let twists = [arm.alpha[3], arm.alpha[4]];
    let [near, far] = twists;
    two_turns(arm, last, twists, 3).map(|Turned { fifth, beside: fourth, tilt }| {
        let g = &mut arm.g;
        // Rx(−α_5) Rz(−θ_5) Rx(−α_4) Rz(−θ_4) M is a turn about z.
        let mut rest = about_z_back(g, fourth, first);
        rest = about_x_back(g, near, rest);
        rest = about_z_back(g, fifth, rest);
        rest = about_x_back(g, far, rest);
        let [first, second, third] = angles;
        let angles = [first, second, third, fourth, fifth, [rest[0], rest[1]]];
        Branch { angles, distance, tilt }
    })
}

/// A vector of the base in frame 3. Parallel axes turn as one.
fn behind_third(arm: &mut Layout, angles: [Pair; 3], v: Vec3) -> Vec3 {
    let g = &mut arm.g;
    let mut v = v;
    let mut pending: Option<Pair> = None;
    for (angle, alpha) in angles.into_iter().zip(arm.alpha) {
        let sum = match pending {
            None => angle,
            Some(before) => turned(g, before, angle),
        };
        if alpha[1].is_zero() {
            // Rz(θ) Rx(0 or π) = Rx(0 or π) Rz(±θ).
            v = about_x_back(g, alpha, v);
            pending = Some([sum[0], g.mul(alpha[0], sum[1])]);
        } else {
            v = about_z_back(g, sum, v);
            v = about_x_back(g, alpha, v);
            pending = None;
        }
    }
    match pending {
        Some(sum) => {
            let [x, y] = turned_back(g, sum, [v[0], v[1]]);
            [x, y, v[2]]
        }
        None => v,
    }
}
