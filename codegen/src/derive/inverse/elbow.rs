//! Seven joints between a spherical shoulder and a spherical wrist, with the angle of the elbow about the line between them
//! given.
//!
//! The distance from shoulder to wrist gives θ_4. How the upper arm is turned then follows from three directions: that of
//! the line, that across it towards the elbow, and both together; it has the angles of the shoulder, and what is left those
//! of the wrist. The elbow's angle is zero where the elbow is in the plane of axis 1 and the line, on the side to which axis
//! 1 points, and grows about the direction from shoulder to wrist (Shimizu et al. 2008).

use super::displacement::{about_x, about_z};
use super::layout::{Layout, NOTHING, Value};
use super::position::STRETCHED;
use super::subproblem::{Free, Pair, square, turned, turned_back, two_angles_within};
use super::term::{Sheet, Term, Vector, cross, dot, plus, times};
use super::wrist::{behind, three_turns};
use super::{Branch, ClosedForm, quantity};
use crate::derive::own::{Held, Own, Size};
use crate::derive::program::{Block, Program};
use crate::derive::readings::Readings;
use crate::expr::Graph;
use crate::number::Number;
use crate::robot::{ELBOW_ANGLE, Robot};

/// The direction of a vector, where that is more than nothing.
fn direction<'g>(v: Vector<'g>, tiny: Term<'g>, otherwise: Vector<'g>) -> Vector<'g> {
    let square = dot(v, v);
    let beyond = square - tiny;
    let inverse = beyond.select(square, square.one()).sqrt().recip();
    core::array::from_fn(|k| beyond.select(inverse * v[k], otherwise[k]))
}

/// Axes z and x.
fn axes(of: Term<'_>) -> [Vector<'_>; 2] {
    let (zero, one) = (of.zero(), of.one());
    [[zero, zero, one], [one, zero, zero]]
}

/// What of a direction is across another, and the direction across both; that of an axis x where the two are one.
fn across<'g>(along: Vector<'g>, of: Vector<'g>) -> [Vector<'g>; 2] {
    let [_, x] = axes(along[0]);
    let tiny = along[0].exact(Number::rounded(NOTHING * NOTHING));
    let part = |v: Vector<'g>| plus(v, times(-dot(along, v), along));
    let first = direction(part(of), tiny, direction(part(x), tiny, x));
    [first, cross(along, first)]
}

/// From the shoulder to the wrist at an angle of joint 4, in the frame that joint 3 turns.
fn to_wrist<'g>(arm: &Layout<'g>, fourth: Pair<'g>) -> Vector<'g> {
    let ([x, y], z) = forearm(arm);
    let [x, y] = turned(fourth, [x, y]);
    let [x, y, z] = arm.link(2, [x, y, z]);
    [x, y, z + arm.d[2]]
}

/// From axis 4 to the wrist in the frame that joint 4 turns: across the axis, and along it.
fn forearm<'g>(arm: &Layout<'g>) -> (Pair<'g>, Term<'g>) {
    let zero = arm.tiny.zero();
    let [x, y, z] = arm.link(3, [zero, zero, arm.d[4]]);
    ([x, y], z + arm.d[3])
}

/// Every branch with the elbow at an angle.
pub(super) fn branches<'g>(arm: &Layout<'g>, angle: Term<'g>) -> Vec<Branch<'g>> {
    let [x, y, z] = arm.before_last();
    let r = [x, y, z - arm.d[0]];
    let [axis, _] = axes(z);
    let along = direction(r, arm.tiny, axis);
    let [reference, beside] = across(along, axis);
    let towards = plus(times(angle.cos(), reference), times(angle.sin(), beside));
    let outer = [along, towards, cross(along, towards)];
    // |w|² = |r|² as an equation of θ_4.
    let ([cx, cy], cz) = forearm(arm);
    let (a, d, [cosine, sine]) = (arm.a[2], arm.d[2], arm.alpha[2]);
    let [by_cosine, by_sine] = turned_back([a, d * sine], [cx, cy]);
    let height = d + cosine * cz;
    let level = square([a, sine * cz]);
    let own = square([cx, cy]) + level + height * height;
    let right = z.exact(Number::ratio(1, 2)) * (dot(r, r) - own);
    let by = [by_cosine, -by_sine];
    let elbows = two_angles_within(by, right, Number::rounded(STRETCHED)).map(|fourth| {
        let w = to_wrist(arm, fourth);
        let inner_along = direction(w, arm.tiny, axis);
        let elbow = [z.zero(), z.zero(), d];
        let [inner_towards, inner_beside] = across(inner_along, elbow);
        let inner = [inner_along, inner_towards, inner_beside];
        let column = |k: usize| {
            let [u, v, w]: [Vector; 3] = core::array::from_fn(|j| times(inner[j][k], outer[j]));
            plus(plus(u, v), w)
        };
        // A stretched arm turns about itself.
        let free = Free { near: arm.near[2], tiny: arm.tiny };
        let off = square([w[0], w[1]]).sqrt();
        three_turns(arm, [column(0), column(2)], 0).map(|([first, second, third], tilt)| {
            let joints = [first, second, free.or(off, third), fourth].map(Value::Turn);
            let missed = dot(w, w).sqrt() - dot(r, r).sqrt();
            let [x, _, z] = arm.target.axes;
            let rest = [x, z].map(|axis| behind(arm, &joints, axis));
            three_turns(arm, rest, 4).map(|(angles, wrist)| {
                let joints: Vec<Value> =
                    joints.into_iter().chain(angles.map(Value::Turn)).collect();
                match tilt.is_zero() {
                    true => Branch { joints, distance: (missed * missed).sqrt(), tilt: wrist },
                    false => Branch::missed(arm, joints),
                }
            })
        })
    });
    let [[a, b], [c, d]] = elbows;
    [a, c, b, d].into_iter().flatten().collect()
}

/// The angle of the elbow at joint values.
pub fn elbow_angle(robot: &Robot, form: ClosedForm) -> Program {
    let sheet = Sheet::new(Graph::new());
    let arm = &Layout::new(&sheet, &robot.nearest(form), form);
    fn carried<'g>(arm: &Layout<'g>, v: Vector<'g>) -> Vector<'g> {
        let v = about_z(arm.near[2], v);
        let v = about_z(arm.near[1], about_x(arm.alpha[1], v));
        about_z(arm.near[0], about_x(arm.alpha[0], v))
    }
    let zero = arm.tiny.zero();
    let [axis, _] = axes(zero);
    let wrist = carried(arm, to_wrist(arm, arm.near[3]));
    let elbow = carried(arm, [zero, zero, arm.d[2]]);
    let [reference, beside] = across(direction(wrist, arm.tiny, axis), axis);
    let angle = dot(elbow, beside).atan2(dot(elbow, reference)).e;
    let sentence = "The elbow's angle about the line from shoulder to wrist: zero where the elbow is in the plane of axis 1 \
                    and that line, on the side to which axis 1 points";
    let held = Held::Own(quantity(ELBOW_ANGLE, "rad", "The angle".to_owned(), Size::Scalar));
    Program {
        graph: sheet.graph.into_inner(),
        blocks: vec![Block { held, entries: vec![angle] }],
        solves: Vec::new(),
        cut: 0,
        dof: robot.dof(),
        readings: Readings::of(robot),
        own: Some(Own {
            name: ELBOW_ANGLE.to_owned(),
            sentence: sentence.to_owned(),
            inputs: Vec::new(),
            finite: true,
        }),
    }
}
