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
use super::term::{Term, Vector, dot};
use crate::number::Number;

/// Two angles of a wrist, and how far the axis that they turn is from where it is to be.
pub(super) struct Turned<'g> {
    /// Of joint 5.
    pub fifth: Pair<'g>,
    /// Of the joint whose axis the other one turns about.
    pub beside: Pair<'g>,
    pub tilt: Term<'g>,
}

/// Both pairs of angles with `Rz(beside) Rx(α) Rz(θ_5) (0, −sin β, cos β)` where `axis` is, for twists α and β; the joint
/// `beside` stays where the axis has no part across its own.
pub(super) fn two_turns<'g>(
    arm: &Layout<'g>,
    [x, y, z]: Vector<'g>,
    [near, far]: [Pair<'g>; 2],
    beside: usize,
) -> [Turned<'g>; 2] {
    // Rx(α) Rz(θ) (0, −sin β, cos β)
    //   = (sin β sin θ, −cos α sin β cos θ − sin α cos β, −sin α sin β cos θ + cos α cos β).
    let [sines, cosines] = [1, 0].map(|k| near[k] * far[k]);
    let [lift, level] = [near[0] * far[1], near[1] * far[0]];
    let inverse = sines.recip();
    let c = (cosines - z) * inverse;
    let up = lift * c + level;
    let left = square([x, y]) - up * up;
    let root = left.positive_part().sqrt();
    let ([c, s], _) = unit([c, root * far[1].recip()]);
    let (up, down) = (lift * c, sines * c);
    let (part, along) = (-(up + level), cosines - down);
    // Of a wrist of right angles the part across has one side or the other, however short it is.
    let right_angles = part.is_zero();
    let nothing = if right_angles { NOTHING } else { NOTHING * NOTHING };
    let free = Free { near: arm.near[beside], tiny: x.exact(Number::rounded(nothing)) };
    [-s, s].map(|s| {
        let own = [s * far[1], part];
        let side = match (right_angles, own[0].e.is_negative()) {
            (true, true) => [-x.one(), x.zero()],
            (true, false) => [x.one(), x.zero()],
            (false, _) => own,
        };
        let beside = angle_between(side, [x, y], Some(free));
        let tilt = match right_angles {
            true => x.zero(),
            false => {
                let [ox, oy] = turned(beside, own);
                let off = [x - ox, y - oy, z - along];
                dot(off, off).sqrt()
            }
        };
        Turned { fifth: [c, s], beside, tilt }
    })
}

/// Both branches of the wrist where the first three joints stand.
pub(super) fn wrists<'g>(arm: &Layout<'g>, At { joints, distance }: At<'g>) -> [Branch<'g>; 2] {
    let [x, _, z] = arm.target.axes;
    let rest = [x, z].map(|axis| behind(arm, &joints, axis));
    three_turns(arm, rest, 3).map(|(angles, tilt)| {
        let joints = joints.into_iter().chain(angles.map(Value::Turn)).collect();
        Branch { joints, distance, tilt }
    })
}

/// Both triples of angles, from that of joint `first`, that turn x and z to these, and how far they leave z.
pub(super) fn three_turns<'g>(
    arm: &Layout<'g>,
    [x, z]: [Vector<'g>; 2],
    first: usize,
) -> [([Pair<'g>; 3], Term<'g>); 2] {
    let [near, far] = [arm.alpha[first], arm.alpha[first + 1]];
    two_turns(arm, z, [near, far], first).map(|Turned { fifth, beside: fourth, tilt }| {
        // Rx(−α_5) Rz(−θ_5) Rx(−α_4) Rz(−θ_4) M is a turn about z.
        let rest = about_x_back(near, about_z_back(fourth, x));
        let rest = about_x_back(far, about_z_back(fifth, rest));
        ([fourth, fifth, [rest[0], rest[1]]], tilt)
    })
}

/// The branch of an arm with fewer than three joints behind the first three.
pub(super) fn short<'g>(arm: &Layout<'g>, At { joints, .. }: At<'g>, after: usize) -> Branch<'g> {
    let mut axes = arm.target.axes.map(|axis| behind(arm, &joints, axis));
    let mut joints = joints.to_vec();
    if after == 2 {
        let free = free(arm, 3);
        let alpha = arm.alpha[3];
        let from = [free.tiny.zero(), -alpha[1]];
        let fourth = angle_between(from, [axes[2][0], axes[2][1]], Some(free));
        axes = axes.map(|axis| about_x_back(alpha, about_z_back(fourth, axis)));
        joints.push(Value::Turn(fourth));
    }
    if after > 0 {
        joints.push(Value::Turn(last_turn(arm, axes)));
    }
    Branch::missed(arm, joints)
}

/// The angle of the last joint behind which the axes are nearest to these.
pub(super) fn last_turn<'g>(arm: &Layout<'g>, [x, y, _]: [Vector<'g>; 3]) -> Pair<'g> {
    nearest_turn([x[0], x[1]], [y[0], y[1]], free(arm, arm.near.len() - 1))
}

/// A joint of which an axis may leave the angle free.
pub(super) fn free<'g>(arm: &Layout<'g>, joint: usize) -> Free<'g> {
    Free { near: arm.near[joint], tiny: arm.tiny.exact(Number::rounded(NOTHING * NOTHING)) }
}

/// A vector of the base in the frame behind the first joints. Parallel axes turn as one.
pub(super) fn behind<'g>(arm: &Layout<'g>, joints: &[Value<'g>], v: Vector<'g>) -> Vector<'g> {
    let mut v = v;
    let mut pending: Option<Pair> = None;
    for (k, value) in joints.iter().enumerate() {
        let angle = arm.turn(k, *value);
        let sum = pending.map_or(angle, |before| turned(before, angle));
        // There is no link behind the third of three joints.
        match arm.alpha.get(k).copied() {
            Some(alpha) if !alpha[1].is_zero() => {
                v = about_x_back(alpha, about_z_back(sum, v));
                pending = None;
            }
            // Rz(θ) Rx(0 or π) = Rx(0 or π) Rz(±θ).
            Some(alpha) => {
                v = about_x_back(alpha, v);
                pending = Some([sum[0], alpha[0] * sum[1]]);
            }
            None => pending = Some(sum),
        }
    }
    match pending {
        Some(sum) => {
            let [x, y] = turned_back(sum, [v[0], v[1]]);
            [x, y, v[2]]
        }
        None => v,
    }
}
