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
use super::subproblem::{angle_between, on_circle, square, turned, turned_back, two_angles};
use crate::expr::{Expr, Graph, Vec3};
use crate::robot::Sliding;

/// The axis of a joint.
pub(super) const Z: Vec3 = [Expr::ZERO, Expr::ZERO, Expr::ONE];

/// Shoulder and elbow as the bits of the number, from the higher, as far as the joints have them.
pub(super) fn joints(arm: &mut Layout, point: &Point, sliding: Sliding) -> Vec<[Value; 3]> {
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

/// `a_k x + Rx(α_k) v`, from 1.
pub(super) fn link(arm: &mut Layout, k: usize, v: Vec3) -> Vec3 {
    let [x, y, z] = about_x(&mut arm.g, arm.alpha[k - 1], v);
    [arm.g.add(arm.a[k - 1], x), y, z]
}

/// `Rx(−α_1) (v − a_1 x)`.
fn behind_first_link(arm: &mut Layout, [x, y, z]: Vec3) -> Vec3 {
    let x = arm.g.sub(x, arm.a[0]);
    about_x_back(&mut arm.g, arm.alpha[0], [x, y, z])
}

/// The point behind joint 3, which slides, where it stands at no displacement.
pub(super) fn unmoved(arm: &mut Layout, point: &Point) -> Vec3 {
    let [x, y] = point.c;
    about_z(&mut arm.g, arm.offsets[2], [x, y, point.cz])
}

fn minus(g: &mut Graph, a: Vec3, b: Vec3) -> Vec3 {
    core::array::from_fn(|k| g.sub(a[k], b[k]))
}

/// x and y of `x e + y f = w`, for a vector in the plane of e and f, and in general for its projection.
fn in_plane(g: &mut Graph, e: Vec3, f: Vec3, w: Vec3) -> [Expr; 2] {
    let normal = g.cross3(e, f);
    let length = g.dot3(normal, normal);
    let inverse = g.recip(length);
    let (first, second) = (g.cross3(f, normal), g.cross3(normal, e));
    [first, second].map(|dual| {
        let part = g.dot3(dual, w);
        g.mul(inverse, part)
    })
}

fn all(arm: &mut Layout, point: &Point) -> Vec<[Value; 3]> {
    let [first, second] = [arm.offsets[0], arm.offsets[1]];
    let there = unmoved(arm, point);
    let there = link(arm, 2, there);
    let there = about_z(&mut arm.g, second, there);
    let there = link(arm, 1, there);
    let there = about_z(&mut arm.g, first, there);
    let (g, [near, far]) = (&mut arm.g, [arm.alpha[0], arm.alpha[1]]);
    let w = minus(g, point.wrist, there);
    let middle = about_x(g, near, Z);
    let middle = about_z(g, first, middle);
    let last = about_x(g, far, Z);
    let last = about_z(g, second, last);
    let last = about_x(g, near, last);
    let last = about_z(g, first, last);
    let axes = [Z, middle, last];
    let mut values = [Expr::ZERO; 3];
    for (k, value) in values.iter_mut().enumerate() {
        let dual = g.cross3(axes[(k + 1) % 3], axes[(k + 2) % 3]);
        let (volume, part) = (g.dot3(axes[k], dual), g.dot3(w, dual));
        let inverse = g.recip(volume);
        *value = g.mul(inverse, part);
    }
    vec![values.map(Value::Slide)]
}

/// Across both directions of the prismatic joints only θ_1 moves the point.
fn behind_turn(arm: &mut Layout, point: &Point) -> Vec<[Value; 3]> {
    let second = arm.offsets[1];
    let there = unmoved(arm, point);
    let there = link(arm, 2, there);
    let there = about_z(&mut arm.g, second, there);
    let there = link(arm, 1, there);
    let free_first = free(arm, 0);
    let (g, [near, far]) = (&mut arm.g, [arm.alpha[0], arm.alpha[1]]);
    let middle = about_x(g, near, Z);
    let last = about_x(g, far, Z);
    let last = about_z(g, second, last);
    let last = about_x(g, near, last);
    let normal = g.cross3(middle, last);
    let [nx, ny, nz] = normal;
    let [rx, ry, rz] = point.r;
    let (across, lift) = (g.dot3(normal, there), g.mul(nz, rz));
    let right = g.sub(across, lift);
    // n_x v_x + n_y v_y of v = Rz(−θ_1) r.
    let by = turned_back(g, [nx, ny], [rx, ry]);
    let firsts = two_angles(g, by, right, free_first);
    let each = firsts.into_iter().map(|first| {
        let v = about_z_back(g, first, point.r);
        let w = minus(g, v, there);
        let [second, third] = in_plane(g, middle, last, w);
        [Value::Turn(first), Value::Slide(second), Value::Slide(third)]
    });
    each.collect()
}

/// Across both directions of the prismatic joints only θ_3 moves the point.
fn before_turn(arm: &mut Layout, point: &Point) -> Vec<[Value; 3]> {
    let [first, second] = [arm.offsets[0], arm.offsets[1]];
    // What the rows in front of joint 3 do to a point and to a direction.
    let (a, alpha) = (arm.a.clone(), arm.alpha.clone());
    let placed = |g: &mut Graph, lengths: bool, v: Vec3| {
        let mut v = v;
        for (k, turn) in [(1, second), (0, first)] {
            v = about_x(g, alpha[k], v);
            if lengths {
                v[0] = g.add(a[k], v[0]);
            }
            v = about_z(g, turn, v);
        }
        v
    };
    let free_third = free(arm, 2);
    let g = &mut arm.g;
    let middle = about_x(g, alpha[0], Z);
    let middle = about_z(g, first, middle);
    let there = placed(g, true, [Expr::ZERO, Expr::ZERO, point.uz]);
    let normal = g.cross3(Z, middle);
    // The normal as joint 3 sees it.
    let mut seen = normal;
    for (k, turn) in [(0, first), (1, second)] {
        seen = about_z_back(g, turn, seen);
        seen = about_x_back(g, alpha[k], seen);
    }
    let w = minus(g, point.wrist, there);
    let right = g.dot3(normal, w);
    // m · Rz(θ_3) c.
    let [re, im] = turned_back(g, point.c, [seen[0], seen[1]]);
    let thirds = two_angles(g, [re, im], right, free_third);
    let each = thirds.into_iter().map(|third| {
        let [x, y] = turned(g, third, point.c);
        let moved = placed(g, false, [x, y, Expr::ZERO]);
        let w = minus(g, w, moved);
        let [first, second] = in_plane(g, Z, middle, w);
        [Value::Slide(first), Value::Slide(second), Value::Turn(third)]
    });
    each.collect()
}

/// The point as joint 2 is to bring it where the first has no displacement, and that one's direction.
pub(super) fn behind_first_slide(arm: &mut Layout, point: &Point) -> (Vec3, Vec3) {
    let v = about_z_back(&mut arm.g, arm.offsets[0], point.wrist);
    let w = behind_first_link(arm, v);
    (w, about_x_back(&mut arm.g, arm.alpha[0], Z))
}

/// What is left along axis 2, by the first joint: `w_z − e_z d_1 = f_z + d_2`.
pub(super) fn first_left(arm: &mut Layout, w: Vec3, e: Vec3, fz: Expr) -> Value {
    let rest = arm.g.sub(w[2], fz);
    let rest = arm.g.sub(rest, arm.d[1]);
    let inverse = arm.g.recip(e[2]);
    Value::Slide(arm.g.mul(inverse, rest))
}

/// The distance from axis 2 depends on the last joint alone.
fn around_along(arm: &mut Layout, point: &Point) -> Vec<[Value; 3]> {
    let (w, e) = behind_first_slide(arm, point);
    let there = unmoved(arm, point);
    let f = link(arm, 2, there);
    let along = about_x(&mut arm.g, arm.alpha[1], Z);
    let reach = square(&mut arm.g, [w[0], w[1]]);
    let thirds = on_circle(&mut arm.g, [f[0], f[1]], [along[0], along[1]], reach);
    let each = thirds.into_iter().map(|third| {
        let moved = arm.g.scale3(third, along);
        let f = arm.g.add3(f, moved);
        let free_second = free(arm, 1);
        let second = angle_between(&mut arm.g, [f[0], f[1]], [w[0], w[1]], free_second);
        [first_left(arm, w, e, f[2]), Value::Turn(second), Value::Slide(third)]
    });
    each.collect()
}

/// The distance from axis 2 is known, and the first joint brings the point there.
fn around_across(arm: &mut Layout, point: &Point) -> Vec<[Value; 3]> {
    let (w, e) = behind_first_slide(arm, point);
    let there = unmoved(arm, point);
    let f = link(arm, 2, there);
    let reach = square(&mut arm.g, [f[0], f[1]]);
    let firsts = on_circle(&mut arm.g, [w[0], w[1]], [-e[0], -e[1]], reach);
    let each = firsts.into_iter().map(|first| {
        let moved = arm.g.scale3(-first, e);
        let w = arm.g.add3(w, moved);
        let free_second = free(arm, 1);
        let second = angle_between(&mut arm.g, [f[0], f[1]], [w[0], w[1]], free_second);
        let rest = arm.g.sub(w[2], f[2]);
        let rest = arm.g.sub(rest, arm.d[1]);
        // The last joint slides along axis 2, to one of its sides.
        let third = arm.g.mul(arm.alpha[1][0], rest);
        [Value::Slide(first), Value::Turn(second), Value::Slide(third)]
    });
    each.collect()
}
