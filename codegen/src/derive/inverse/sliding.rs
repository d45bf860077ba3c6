//! The first three joints of an arm of which some are prismatic: those that bring the wrist's point where it is to be.
//!
//! A prismatic joint moves the point by a constant direction times its displacement: what is perpendicular to it depends on
//! the other joints alone.

use super::displacement::{about_x, about_x_back, about_z, about_z_back};
use super::layout::{Layout, Value};
use super::one_slide::{
    between_across, between_along, first_across, first_along, last_meets, last_parallel,
};
use super::point::Point;
use super::position::free;
use super::subproblem::{Pair, angle_between, on_circle, square, turned, turned_back, two_angles};
use super::term::{Term, Vector, cross, dot, minus, plus, times};
use crate::robot::Sliding;

/// Shoulder and elbow as the bits of the number, from the higher, as far as the joints have them.
pub(super) fn joints<'g>(
    arm: &Layout<'g>,
    point: &Point<'g>,
    sliding: Sliding,
) -> Vec<[Value<'g>; 3]> {
    match sliding {
        Sliding::All => all(arm, point),
        Sliding::BehindTurn => behind_turn(arm, point),
        Sliding::BeforeTurn => before_turn(arm, point),
        Sliding::AroundAlong => around_along(arm, point),
        Sliding::AroundAcross => around_across(arm, point),
        Sliding::LastMeets => last_meets(arm, point),
        Sliding::LastParallel => last_parallel(arm, point),
        Sliding::BetweenAlong => between_along(arm, point),
        Sliding::BetweenAcross => between_across(arm, point),
        Sliding::FirstAlong => first_along(arm, point),
        Sliding::FirstAcross => first_across(arm, point),
    }
}

/// The axis of a joint.
pub(super) fn z<'g>(arm: &Layout<'g>) -> Vector<'g> {
    let [zero, one] = [arm.tiny.zero(), arm.tiny.one()];
    [zero, zero, one]
}

/// What of a vector is across z.
pub(super) fn across([x, y, _]: Vector<'_>) -> Pair<'_> {
    [x, y]
}

/// The point behind joint 3, which slides, where it stands at no displacement, behind the link before it.
pub(super) fn unmoved<'g>(arm: &Layout<'g>, point: &Point<'g>) -> Vector<'g> {
    let [x, y] = point.c;
    arm.link(1, about_z(arm.offsets[2], [x, y, point.cz]))
}

/// x and y of `x e + y f = w`, for a vector in the plane of e and f, and in general for its projection.
fn in_plane<'g>(e: Vector<'g>, f: Vector<'g>, w: Vector<'g>) -> Pair<'g> {
    let normal = cross(e, f);
    let inverse = dot(normal, normal).recip();
    [cross(f, normal), cross(normal, e)].map(|dual| inverse * dot(dual, w))
}

fn all<'g>(arm: &Layout<'g>, point: &Point<'g>) -> Vec<[Value<'g>; 3]> {
    let [first, second] = [arm.offsets[0], arm.offsets[1]];
    let there = arm.link(0, about_z(second, unmoved(arm, point)));
    let w = minus(point.wrist, about_z(first, there));
    let ([near, far], z) = ([arm.alpha[0], arm.alpha[1]], z(arm));
    let middle = about_z(first, about_x(near, z));
    let last = about_x(near, about_z(second, about_x(far, z)));
    let axes = [z, middle, about_z(first, last)];
    let values = [0, 1, 2].map(|k| {
        let dual = cross(axes[(k + 1) % 3], axes[(k + 2) % 3]);
        let (volume, part) = (dot(axes[k], dual), dot(w, dual));
        volume.recip() * part
    });
    vec![values.map(Value::Slide)]
}

/// Across both directions of the prismatic joints only θ_1 moves the point.
fn behind_turn<'g>(arm: &Layout<'g>, point: &Point<'g>) -> Vec<[Value<'g>; 3]> {
    let second = arm.offsets[1];
    let there = arm.link(0, about_z(second, unmoved(arm, point)));
    let ([near, far], z) = ([arm.alpha[0], arm.alpha[1]], z(arm));
    let middle = about_x(near, z);
    let last = about_x(near, about_z(second, about_x(far, z)));
    let normal = cross(middle, last);
    let [rx, ry, rz] = point.r;
    let right = dot(normal, there) - normal[2] * rz;
    // n_x v_x + n_y v_y of v = Rz(−θ_1) r.
    let by = turned_back(across(normal), [rx, ry]);
    let each = two_angles(by, right, free(arm, 0)).map(|first| {
        let v = about_z_back(first, point.r);
        let [second, third] = in_plane(middle, last, minus(v, there));
        [Value::Turn(first), Value::Slide(second), Value::Slide(third)]
    });
    each.to_vec()
}

/// Across both directions of the prismatic joints only θ_3 moves the point.
fn before_turn<'g>(arm: &Layout<'g>, point: &Point<'g>) -> Vec<[Value<'g>; 3]> {
    let [first, second] = [arm.offsets[0], arm.offsets[1]];
    let (z, zero) = (z(arm), arm.tiny.zero());
    // What the rows in front of joint 3 do to a point and to a direction.
    let placed = |lengths: bool, mut v: Vector<'g>| {
        for (k, turn) in [(1, second), (0, first)] {
            v = if lengths { arm.link(k, v) } else { about_x(arm.alpha[k], v) };
            v = about_z(turn, v);
        }
        v
    };
    let middle = about_z(first, about_x(arm.alpha[0], z));
    let there = placed(true, [zero, zero, point.uz]);
    let normal = cross(z, middle);
    // The normal as joint 3 sees it.
    let mut seen = normal;
    for (k, turn) in [(0, first), (1, second)] {
        seen = about_x_back(arm.alpha[k], about_z_back(turn, seen));
    }
    let w = minus(point.wrist, there);
    let right = dot(normal, w);
    // m · Rz(θ_3) c.
    let by = turned_back(point.c, across(seen));
    let each = two_angles(by, right, free(arm, 2)).map(|third| {
        let [x, y] = turned(third, point.c);
        let moved = placed(false, [x, y, zero]);
        let [first, second] = in_plane(z, middle, minus(w, moved));
        [Value::Slide(first), Value::Slide(second), Value::Turn(third)]
    });
    each.to_vec()
}

/// The point as joint 2 is to bring it where the first has no displacement, and that one's direction.
pub(super) fn behind_first_slide<'g>(
    arm: &Layout<'g>,
    point: &Point<'g>,
) -> (Vector<'g>, Vector<'g>) {
    let v = about_z_back(arm.offsets[0], point.wrist);
    (arm.behind_link(0, v), about_x_back(arm.alpha[0], z(arm)))
}

/// What is left along axis 2, by the first joint: `w_z − e_z d_1 = f_z + d_2`.
pub(super) fn first_left<'g>(
    arm: &Layout<'g>,
    w: Vector<'g>,
    e: Vector<'g>,
    fz: Term<'g>,
) -> Value<'g> {
    let rest = w[2] - fz - arm.d[1];
    Value::Slide(e[2].recip() * rest)
}

/// The angle of joint 2, of which the point `f` behind it is to be where `w` is across its axis.
pub(super) fn second_turn<'g>(arm: &Layout<'g>, f: Vector<'g>, w: Vector<'g>) -> Pair<'g> {
    angle_between(across(f), across(w), free(arm, 1))
}

/// The distance from axis 2 depends on the last joint alone.
fn around_along<'g>(arm: &Layout<'g>, point: &Point<'g>) -> Vec<[Value<'g>; 3]> {
    let (w, e) = behind_first_slide(arm, point);
    let f = unmoved(arm, point);
    let along = about_x(arm.alpha[1], z(arm));
    let reach = square(across(w));
    let each = on_circle(across(f), across(along), reach).map(|third| {
        let f = plus(f, times(third, along));
        let second = second_turn(arm, f, w);
        [first_left(arm, w, e, f[2]), Value::Turn(second), Value::Slide(third)]
    });
    each.to_vec()
}

/// The distance from axis 2 is known, and the first joint brings the point there.
fn around_across<'g>(arm: &Layout<'g>, point: &Point<'g>) -> Vec<[Value<'g>; 3]> {
    let (w, e) = behind_first_slide(arm, point);
    let f = unmoved(arm, point);
    let reach = square(across(f));
    let each = on_circle(across(w), [-e[0], -e[1]], reach).map(|first| {
        let w = plus(w, times(-first, e));
        let second = second_turn(arm, f, w);
        // The last joint slides along axis 2, to one of its sides.
        let rest = w[2] - f[2] - arm.d[1];
        let third = arm.alpha[1][0] * rest;
        [Value::Slide(first), Value::Turn(second), Value::Slide(third)]
    });
    each.to_vec()
}
