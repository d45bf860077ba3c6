//! Parallel axes: links in a plane, of arms of fewer than six joints, and the triangle that they and larger arms have.
//!
//! With axes j, j + 1, j + 2 parallel, `Rz(θ_j) L_j Rz(θ_{j+1}) L_{j+1} Rz(θ_{j+2}) v = Rz(φ) (v_x, ±v_y, ±v_z)` but for
//! lengths: the direction of what the joints behind them hold gives φ, the place in the plane the triangle.

use super::Branch;
use super::displacement::{about_x_back, about_z_back};
use super::layout::{Layout, Value};
use super::position::free;
use super::subproblem::{
    Pair, angle_between, nearest_turn, square, turned, turned_back, two_angles,
};
use super::term::{Term, Vector};
use super::wrist;

/// What three parallel axes are to reach, in the plane across them.
pub(super) struct Trio<'g> {
    /// The first of them, from 0.
    pub first: usize,
    /// Cosine and sine of the sum of their angles.
    pub normal: Pair<'g>,
    /// Where the second link behind the first axis ends.
    pub end: Pair<'g>,
}

/// Their angles for both elbows, and what of the place in the plane is missed.
pub(super) fn triangle<'g>(arm: &Layout<'g>, trio: Trio<'g>) -> [([Pair<'g>; 3], Pair<'g>); 2] {
    let Trio { first, normal, end } = trio;
    let [second_side, third_side] = [arm.alpha[first][0], arm.alpha[first + 1][0]];
    let (near, far) = (arm.a[first], arm.a[first + 1]);
    let (reach, own) = (square(end), square([near, far]));
    let right = reach - own;
    let product = near * far;
    two_angles([product + product, product.zero()], right, None).map(|third| {
        let [x, y] = third.map(|component| far * component);
        let from = [near + x, second_side * y];
        let second = angle_between(from, end, free(arm, first));
        // The turn of the fourth row: θ_2 ± θ_3 ± θ_4.
        let before = turned(second, [third[0], second_side * third[1]]);
        let [cosine, sine] = turned_back(before, normal);
        let fourth = [cosine, second_side * third_side * sine];
        let reached = turned(second, from);
        let off = [end[0] - reached[0], end[1] - reached[1]];
        ([second, third, fourth], off)
    })
}

/// The angles of joint 1 by which a point, from the frame that it turns, has its part along the parallel axes:
/// cos α_1 p_z − sin α_1 (−sin θ_1 p_x + cos θ_1 p_y).
pub(super) fn first_turns<'g>(
    arm: &Layout<'g>,
    [px, py, pz]: Vector<'g>,
    along: Term<'g>,
) -> [Pair<'g>; 2] {
    let [cosine, sine] = arm.alpha[0];
    let right = (cosine * pz - along) * sine.recip();
    two_angles([py, -px], right, free(arm, 0))
}

/// Every branch of an arm of at most five joints, of which three axes are parallel: with a joint before them or not, and one
/// joint behind them or none; or with a prismatic one along them.
pub(super) fn branches<'g>(
    arm: &Layout<'g>,
    before: bool,
    behind: usize,
    lift: bool,
) -> Vec<Branch<'g>> {
    let first = usize::from(before);
    let point = arm.beside_tip();
    // What the rows move along the parallel axes, as the first of them counts; the joint behind them stands on its own.
    let sides = [arm.alpha[first][0], arm.alpha[first + 1][0]];
    let side = sides[0] * sides[1];
    let zero = side.zero();
    let mut lever = arm.lever;
    if (behind, lift) == (0, true) {
        // What the tool is behind the prismatic joint, in the frame that the last axis turns.
        let [x, y] = turned(arm.offsets[3], [lever[0], lever[1]]);
        lever = [arm.a[2] + x, arm.alpha[2][0] * y, zero];
    }
    let tip = if behind == 0 { arm.tip } else { point };
    let held = match behind {
        0 => lever[2],
        _ => {
            let last = arm.d[first + 3] + arm.lever[2];
            arm.alpha[first + 2][0] * last
        }
    };
    let mut along = arm.d[first + 2] + held;
    for (k, side) in sides.into_iter().enumerate().rev() {
        along = side * along + arm.d[first + k];
    }
    let planes = match before {
        false => vec![None],
        true => {
            let moved = [tip[0], tip[1], tip[2] - arm.d[0]];
            first_turns(arm, moved, along).map(Some).to_vec()
        }
    };
    let mut out = Vec::with_capacity(4);
    for plane in planes {
        let mut axes = arm.target.axes;
        let mut at = tip;
        if let Some(first) = plane {
            axes = axes.map(|axis| {
                let axis = about_z_back(first, axis);
                about_x_back(arm.alpha[0], axis)
            });
            at[2] = at[2] - arm.d[0];
            at = arm.behind_link(0, about_z_back(first, at));
        }
        let normal = sum_of_angles(arm, axes, (first, behind, lift), side);
        // Where the second link behind the first of the axes ends.
        let held: Vector = match behind {
            0 => lever,
            _ => {
                let last = arm.d[first + 3] + arm.lever[2];
                let [_, sine] = arm.alpha[first + 2];
                [arm.a[first + 2], -(sine * last), zero]
            }
        };
        let from = turned(normal, [held[0], side * held[1]]);
        let end = [at[0] - from[0], at[1] - from[1]];
        let fifth = (behind > 0).then(|| {
            // Behind the parallel axes and the link to the last joint.
            let left = axes.map(|axis| {
                let [x, y, z] = about_z_back(normal, axis);
                about_x_back(arm.alpha[first + 2], [x, side * y, side * z])
            });
            wrist::last_turn(arm, left)
        });
        let slide = lift.then(|| {
            let rest = at[2] - along;
            side * arm.alpha[2][0] * rest - arm.lever[2]
        });
        for (angles, _) in triangle(arm, Trio { first, normal, end }) {
            let mut joints: Vec<Value> = plane.into_iter().chain(angles).map(Value::Turn).collect();
            joints.extend(fifth.map(Value::Turn));
            joints.extend(slide.map(Value::Slide));
            out.push(Branch::missed(arm, joints));
        }
    }
    out
}

/// Cosine and sine of the sum of the parallel axes' angles by the target's axes in their plane: such that the axis of the joint
/// behind them is as near as it comes, or the whole of the tool where there is none.
fn sum_of_angles<'g>(
    arm: &Layout<'g>,
    axes: [Vector<'g>; 3],
    (first, behind, lift): (usize, usize, bool),
    side: Term<'g>,
) -> Pair<'g> {
    let near = {
        let last = [arm.near[first + 2][0], arm.alpha[first + 1][0] * arm.near[first + 2][1]];
        let pair = turned(arm.near[first + 1], last);
        turned(arm.near[first], [pair[0], arm.alpha[first][0] * pair[1]])
    };
    let mut free = wrist::free(arm, first);
    free.near = near;
    if behind > 0 {
        let [_, sine] = arm.alpha[first + 2];
        let from = [side.zero(), -(side * sine)];
        return angle_between(from, [axes[2][0], axes[2][1]], Some(free));
    }
    let [x, y, _] = axes.map(|axis| [axis[0], axis[1]]);
    let (mut along, mut across) = (x, y);
    let mut side = side;
    if lift {
        // The target's axes are those behind the prismatic joint: Rz(φ) Rx Rx(α) Rz(τ).
        let [c, s] = arm.offsets[3];
        along = [0, 1].map(|k| c * x[k] - s * y[k]);
        across = [0, 1].map(|k| s * x[k] + c * y[k]);
        side = side * arm.alpha[2][0];
    }
    let across = across.map(|component| side * component);
    nearest_turn(along, across, free)
}

/// Both branches of two parallel axes that bring the tool's origin where it is to be in their plane.
pub(super) fn two<'g>(arm: &Layout<'g>) -> Vec<Branch<'g>> {
    let ([x, y, _], [lx, ly, _]) = (arm.tip, arm.lever);
    let (side, a) = (arm.alpha[0][0], arm.a[0]);
    let (reach, own, inner) = (square([x, y]), a * a, square([lx, ly]));
    let right = reach - own - inner;
    let by = [lx, -ly].map(|length| {
        let product = a * length;
        product + product
    });
    let each = two_angles(by, right, None).map(|second| {
        let [tx, ty] = turned(second, [lx, ly]);
        let first = angle_between([a + tx, side * ty], [x, y], free(arm, 0));
        Branch::missed(arm, vec![Value::Turn(first), Value::Turn(second)])
    });
    each.into()
}
