//! The angles behind the first three joints: those that turn the tool as it is to be.
//!
//! With `M` the target's axes in frame 3, `M = Rz(θ_4) Rx(α_4) Rz(θ_5) Rx(α_5) Rz(θ_6)`: its last entry gives θ_5, its last
//! column θ_4, and what is then left θ_6. Of two angles the last axis gives the first, of one the nearest turn.

use super::Branch;
use super::displacement::{about_x_back, about_z_back};
use super::layout::{Layout, NOTHING, Value};
use super::position::At;
use super::subproblem::{
    Free, Pair, angle_between, nearest_turn, square, turned, turned_back, unit,
};
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

/// Both branches of the wrist where the first three joints stand.
pub(super) fn wrists(arm: &mut Layout, At { joints, distance }: At) -> [Branch; 2] {
    let [x, _, z] = arm.target.axes;
    let (first, last) = (behind_third(arm, joints, x), behind_third(arm, joints, z));
    let [near, far] = [arm.alpha[3], arm.alpha[4]];
    two_turns(arm, last, [near, far], 3).map(|Turned { fifth, beside: fourth, tilt }| {
        let g = &mut arm.g;
        // Rx(−α_5) Rz(−θ_5) Rx(−α_4) Rz(−θ_4) M is a turn about z.
        let mut rest = about_z_back(g, fourth, first);
        rest = about_x_back(g, near, rest);
        rest = about_z_back(g, fifth, rest);
        rest = about_x_back(g, far, rest);
        let mut joints = joints.to_vec();
        joints.extend([fourth, fifth, [rest[0], rest[1]]].map(Value::Turn));
        Branch { joints, distance, tilt }
    })
}

/// The branch of an arm with fewer than three joints behind the first three.
pub(super) fn short(arm: &mut Layout, At { joints, .. }: At, behind: usize) -> Branch {
    let mut axes = arm.target.axes.map(|axis| behind_third(arm, joints, axis));
    let mut joints = joints.to_vec();
    if behind == 2 {
        let free = free(arm, 3);
        let g = &mut arm.g;
        let [cosine, sine] = arm.alpha[3];
        let fourth = angle_between(g, [Expr::ZERO, -sine], [axes[2][0], axes[2][1]], Some(free));
        axes = axes.map(|axis| {
            let axis = about_z_back(g, fourth, axis);
            about_x_back(g, [cosine, sine], axis)
        });
        joints.push(Value::Turn(fourth));
    }
    if behind > 0 {
        joints.push(Value::Turn(last_turn(arm, axes)));
    }
    let (distance, tilt) = arm.missed(&joints);
    Branch { joints, distance, tilt }
}

/// The angle of the last joint behind which the axes are nearest to these.
pub(super) fn last_turn(arm: &mut Layout, [x, y, _]: [Vec3; 3]) -> Pair {
    let free = free(arm, arm.near.len() - 1);
    nearest_turn(&mut arm.g, [x[0], x[1]], [y[0], y[1]], free)
}

/// A joint of which an axis may leave the angle free.
pub(super) fn free(arm: &mut Layout, joint: usize) -> Free {
    let tiny = arm.g.number(Number::rounded(NOTHING * NOTHING));
    Free { near: arm.near[joint], tiny }
}

/// A vector of the base in frame 3. Parallel axes turn as one.
fn behind_third(arm: &mut Layout, joints: [Value; 3], v: Vec3) -> Vec3 {
    let mut v = v;
    let mut pending: Option<Pair> = None;
    for (k, value) in joints.into_iter().enumerate() {
        let angle = arm.turn(k, value);
        // There is no link behind the third of three joints.
        let link = arm.alpha.get(k).copied();
        let g = &mut arm.g;
        let sum = match pending {
            None => angle,
            Some(before) => turned(g, before, angle),
        };
        match link {
            Some(alpha) if !alpha[1].is_zero() => {
                v = about_z_back(g, sum, v);
                v = about_x_back(g, alpha, v);
                pending = None;
            }
            // Rz(θ) Rx(0 or π) = Rx(0 or π) Rz(±θ).
            Some(alpha) => {
                v = about_x_back(g, alpha, v);
                pending = Some([sum[0], g.mul(alpha[0], sum[1])]);
            }
            None => pending = Some(sum),
        }
    }
    match pending {
        Some(sum) => {
            let [x, y] = turned_back(&mut arm.g, sum, [v[0], v[1]]);
            [x, y, v[2]]
        }
        None => v,
    }
}
