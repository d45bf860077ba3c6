//! The first three joints of which one slides and two turn.

use super::displacement::{about_x, about_z};
use super::layout::{Layout, Value};
use super::point::Point;
use super::position::{STRETCHED, about_meeting, about_parallel, free, shoulders_first, solved};
use super::sliding::{across, behind_first_slide, first_left, second_turn, unmoved, z};
use super::subproblem::{Pair, above, angle_between, on_circle, square, two_angles};
use super::term::{Vector, dot, plus, times};
use crate::number::Number;

/// The distance from where axes 1 and 2 meet depends on the last joint alone.
pub(super) fn last_meets<'g>(arm: &Layout<'g>, point: &Point<'g>) -> Vec<[Value<'g>; 3]> {
    let (f, r) = (unmoved(arm, point), point.r);
    let along = about_x(arm.alpha[1], z(arm));
    let p = [f[0], f[1], f[2] + arm.d[1]];
    // |p + t e|² = |r|² with e of length 1.
    let part = dot(p, along);
    let beside = plus(p, times(-part, along));
    let (reach, own) = (dot(r, r), dot(beside, beside));
    let left = reach - own;
    let left = match across(beside).iter().all(|component| component.is_zero()) {
        // Where both are one the point is on axis 2, and joint 2 is free: there they are one where they are so but for rounding.
        true => above(left, Number::rounded(STRETCHED), reach),
        false => left.positive_part(),
    };
    let root = left.sqrt();
    let thirds = [-root, root].map(|root| root - part);
    shoulders_first(thirds.map(|third| {
        let f = plus(f, times(third, along));
        about_meeting(arm, r, f)
            .map(|[first, second]| [Value::Turn(first), Value::Turn(second), Value::Slide(third)])
    }))
}

/// The height along the parallel axes is the last joint's.
pub(super) fn last_parallel<'g>(arm: &Layout<'g>, point: &Point<'g>) -> Vec<[Value<'g>; 3]> {
    let f = unmoved(arm, point);
    let along = about_x(arm.alpha[1], z(arm));
    let rest = arm.alpha[0][0] * point.r[2] - arm.d[1] - f[2];
    let third = along[2].recip() * rest;
    let f = plus(f, times(third, along));
    let each = about_parallel(arm, point.r, f);
    each.map(|[first, second]| [Value::Turn(first), Value::Turn(second), Value::Slide(third)])
        .to_vec()
}

/// What joint 3 turns, as the plane of joint 1 sees it: where axis 3 stands at no displacement, and the point's parts for
/// θ_3 = 0 and a quarter turn.
struct Between<'g> {
    base: Vector<'g>,
    parts: [Vector<'g>; 2],
}

fn between<'g>(arm: &Layout<'g>, point: &Point<'g>) -> Between<'g> {
    let (second, zero) = (arm.offsets[1], arm.tiny.zero());
    let base = arm.link(0, about_z(second, arm.link(1, [zero, zero, point.uz])));
    let [x, y] = point.c;
    let parts = [[x, y, zero], [-y, x, zero]].map(|v| {
        let v = about_z(second, about_x(arm.alpha[1], v));
        about_x(arm.alpha[0], v)
    });
    Between { base, parts }
}

impl<'g> Between<'g> {
    fn at(&self, [cosine, sine]: Pair<'g>) -> Vector<'g> {
        let moved = plus(times(cosine, self.parts[0]), times(sine, self.parts[1]));
        plus(self.base, moved)
    }
}

/// The height is the prismatic joint's, the distance from axis 1 that of the last.
pub(super) fn between_along<'g>(arm: &Layout<'g>, point: &Point<'g>) -> Vec<[Value<'g>; 3]> {
    let seen = between(arm, point);
    let [rx, ry, rz] = point.r;
    let second = arm.alpha[0][0] * (rz - seen.base[2]);
    let base = across(seen.base);
    let (reach, own, inner) = (square([rx, ry]), square(base), square(point.c));
    let right = reach - own - inner;
    let by = seen.parts.map(|part| {
        let sum = base[0] * part[0] + base[1] * part[1];
        sum + sum
    });
    let each = two_angles(by, right, free(arm, 2)).map(|third| {
        let first = angle_between(across(seen.at(third)), [rx, ry], free(arm, 0));
        [Value::Turn(first), Value::Slide(second), Value::Turn(third)]
    });
    each.to_vec()
}

/// The height is the last joint's, the distance from axis 1 the prismatic one's.
pub(super) fn between_across<'g>(arm: &Layout<'g>, point: &Point<'g>) -> Vec<[Value<'g>; 3]> {
    let seen = between(arm, point);
    let [rx, ry, rz] = point.r;
    let along = about_x(arm.alpha[0], z(arm));
    let right = rz - seen.base[2];
    let reach = square([rx, ry]);
    let thirds = two_angles(seen.parts.map(|part| part[2]), right, free(arm, 2));
    shoulders_first(thirds.map(|third| {
        let [x, y, _] = seen.at(third);
        on_circle([x, y], across(along), reach).map(|second| {
            let moved = times(second, along);
            let at = [x + moved[0], y + moved[1]];
            let first = angle_between(at, [rx, ry], free(arm, 0));
            [Value::Turn(first), Value::Slide(second), Value::Turn(third)]
        })
    }))
}

/// In the plane across the parallel axes two links reach the point; the first joint lifts them.
pub(super) fn first_along<'g>(arm: &Layout<'g>, point: &Point<'g>) -> Vec<[Value<'g>; 3]> {
    let (w, e) = behind_first_slide(arm, point);
    let linear = point.square_across(arm);
    let reach = square(across(w));
    let each = solved(&linear, reach).map(|third| {
        let f = point.f(arm, third);
        let second = second_turn(arm, f, w);
        [first_left(arm, w, e, f[2]), Value::Turn(second), Value::Turn(third)]
    });
    each.to_vec()
}

/// Along axis 2 only θ_3 moves the point; the first joint brings the rest as near to that axis as joint 3 does.
pub(super) fn first_across<'g>(arm: &Layout<'g>, point: &Point<'g>) -> Vec<[Value<'g>; 3]> {
    let (w, e) = behind_first_slide(arm, point);
    let along = point.fz(arm);
    let height = w[2] - arm.d[1];
    shoulders_first(solved(&along, height).map(|third| {
        let f = point.f(arm, third);
        let reach = square(across(f));
        on_circle(across(w), [-e[0], -e[1]], reach).map(|first| {
            let w = plus(w, times(-first, e));
            let second = second_turn(arm, f, w);
            [Value::Slide(first), Value::Turn(second), Value::Turn(third)]
        })
    }))
}
