//! The first three joints of which one slides and two turn.

use super::displacement::{about_x, about_z};
use super::layout::{Layout, Value};
use super::point::Point;
use super::position::{STRETCHED, about_meeting, about_parallel, free, solved};
use super::sliding::{Z, behind_first_slide, first_left, link, unmoved};
use super::subproblem::{Pair, angle_between, on_circle, square, two_angles};
use crate::expr::{Expr, Graph, Vec3};
use crate::number::Number;

/// The distance from where axes 1 and 2 meet depends on the last joint alone.
pub(super) fn last_meets(arm: &mut Layout, point: &Point) -> Vec<[Value; 3]> {
    let there = unmoved(arm, point);
    let f = link(arm, 2, there);
    let (g, r) = (&mut arm.g, point.r);
    let along = about_x(g, arm.alpha[1], Z);
    let p = [f[0], f[1], g.add(f[2], arm.d[1])];
    // |p + t e|² = |r|² with e of length 1.
    let part = g.dot3(p, along);
    let off = g.scale3(-part, along);
    let across = g.add3(p, off);
    let (reach, own) = (g.dot3(r, r), g.dot3(across, across));
    let left = g.sub(reach, own);
    let left = match across[0].is_zero() && across[1].is_zero() {
        // Where both are one the point is on axis 2, and joint 2 is free: there they are one where they are so but for rounding.
        true => {
            let part = g.number(Number::rounded(STRETCHED));
            let none = g.mul(part, reach);
            let beyond = g.sub(left, none);
            g.select(beyond, left, Expr::ZERO)
        }
        false => g.positive_part(left),
    };
    let root = g.sqrt(left);
    let thirds = [-root, root].map(|root| g.sub(root, part));
    let mut out = vec![[Value::Slide(Expr::ZERO); 3]; 4];
    for (elbow, third) in thirds.into_iter().enumerate() {
        let moved = arm.g.scale3(third, along);
        let f = arm.g.add3(f, moved);
        for (shoulder, [first, second]) in about_meeting(arm, r, f).into_iter().enumerate() {
            out[2 * shoulder + elbow] =
                [Value::Turn(first), Value::Turn(second), Value::Slide(third)];
        }
    }
    out
}

/// The height along the parallel axes is the last joint's.
pub(super) fn last_parallel(arm: &mut Layout, point: &Point) -> Vec<[Value; 3]> {
    let there = unmoved(arm, point);
    let f = link(arm, 2, there);
    let g = &mut arm.g;
    let along = about_x(g, arm.alpha[1], Z);
    let height = g.mul(arm.alpha[0][0], point.r[2]);
    let rest = g.sub(height, arm.d[1]);
    let rest = g.sub(rest, f[2]);
    let inverse = g.recip(along[2]);
    let third = g.mul(inverse, rest);
    let moved = g.scale3(third, along);
    let f = g.add3(f, moved);
    let each = about_parallel(arm, point.r, f).into_iter();
    each.map(|[first, second]| [Value::Turn(first), Value::Turn(second), Value::Slide(third)])
        .collect()
}

/// What joint 3 turns, as the plane of joint 1 sees it: where axis 3 stands at no displacement, and the point's parts for
/// θ_3 = 0 and a quarter turn.
struct Between {
    base: Vec3,
    parts: [Vec3; 2],
}

fn between(arm: &mut Layout, point: &Point) -> Between {
    let second = arm.offsets[1];
    let base = link(arm, 2, [Expr::ZERO, Expr::ZERO, point.uz]);
    let base = about_z(&mut arm.g, second, base);
    let base = link(arm, 1, base);
    let [x, y] = point.c;
    let (g, [near, far]) = (&mut arm.g, [arm.alpha[0], arm.alpha[1]]);
    let parts = [[x, y, Expr::ZERO], [-y, x, Expr::ZERO]].map(|v| {
        let v = about_x(g, far, v);
        let v = about_z(g, second, v);
        about_x(g, near, v)
    });
    Between { base, parts }
}

impl Between {
    fn at(&self, g: &mut Graph, [cosine, sine]: Pair) -> Vec3 {
        let moved = g.combine3(cosine, self.parts[0], sine, self.parts[1]);
        g.add3(self.base, moved)
    }
}

/// The height is the prismatic joint's, the distance from axis 1 that of the last.
pub(super) fn between_along(arm: &mut Layout, point: &Point) -> Vec<[Value; 3]> {
    let seen = between(arm, point);
    let [rx, ry, rz] = point.r;
    let (free_first, free_third) = (free(arm, 0), free(arm, 2));
    let (g, side) = (&mut arm.g, arm.alpha[0][0]);
    let rest = g.sub(rz, seen.base[2]);
    let second = g.mul(side, rest);
    let base = [seen.base[0], seen.base[1]];
    let (reach, own, inner) = (square(g, [rx, ry]), square(g, base), square(g, point.c));
    let right = g.sub(reach, own);
    let right = g.sub(right, inner);
    let by = seen.parts.map(|part| {
        let (x, y) = (g.mul(base[0], part[0]), g.mul(base[1], part[1]));
        let sum = g.add(x, y);
        g.add(sum, sum)
    });
    let thirds = two_angles(g, by, right, free_third);
    let each = thirds.into_iter().map(|third| {
        let [x, y, _] = seen.at(g, third);
        let first = angle_between(g, [x, y], [rx, ry], free_first);
        [Value::Turn(first), Value::Slide(second), Value::Turn(third)]
    });
    each.collect()
}

/// The height is the last joint's, the distance from axis 1 the prismatic one's.
pub(super) fn between_across(arm: &mut Layout, point: &Point) -> Vec<[Value; 3]> {
    let seen = between(arm, point);
    let [rx, ry, rz] = point.r;
    let (free_first, free_third) = (free(arm, 0), free(arm, 2));
    let g = &mut arm.g;
    let along = about_x(g, arm.alpha[0], Z);
    let right = g.sub(rz, seen.base[2]);
    let by = seen.parts.map(|part| part[2]);
    let reach = square(g, [rx, ry]);
    let mut out = vec![[Value::Slide(Expr::ZERO); 3]; 4];
    for (elbow, third) in two_angles(g, by, right, free_third).into_iter().enumerate() {
        let [x, y, _] = seen.at(g, third);
        let seconds = on_circle(g, [x, y], [along[0], along[1]], reach);
        for (shoulder, second) in seconds.into_iter().enumerate() {
            let moved = g.scale3(second, along);
            let at = [g.add(x, moved[0]), g.add(y, moved[1])];
            let first = angle_between(g, at, [rx, ry], free_first);
            out[2 * shoulder + elbow] =
                [Value::Turn(first), Value::Slide(second), Value::Turn(third)];
        }
    }
    out
}

/// In the plane across the parallel axes two links reach the point; the first joint lifts them.
pub(super) fn first_along(arm: &mut Layout, point: &Point) -> Vec<[Value; 3]> {
    let (w, e) = behind_first_slide(arm, point);
    let mut linear = point.square(arm);
    let axial = arm.g.mul(point.uz, point.uz);
    linear.constant = arm.g.sub(linear.constant, axial);
    let reach = square(&mut arm.g, [w[0], w[1]]);
    let thirds = solved(&mut arm.g, &linear, reach);
    let each = thirds.into_iter().map(|third| {
        let f = point.f(arm, third);
        let free_second = free(arm, 1);
        let second = angle_between(&mut arm.g, [f[0], f[1]], [w[0], w[1]], free_second);
        [first_left(arm, w, e, f[2]), Value::Turn(second), Value::Turn(third)]
    });
    each.collect()
}

/// Along axis 2 only θ_3 moves the point; the first joint brings the rest as near to that axis as joint 3 does.
pub(super) fn first_across(arm: &mut Layout, point: &Point) -> Vec<[Value; 3]> {
    let (w, e) = behind_first_slide(arm, point);
    let along = point.fz(arm);
    let height = arm.g.sub(w[2], arm.d[1]);
    let mut out = vec![[Value::Slide(Expr::ZERO); 3]; 4];
    for (elbow, third) in solved(&mut arm.g, &along, height).into_iter().enumerate() {
        let f = point.f(arm, third);
        let reach = square(&mut arm.g, [f[0], f[1]]);
        let firsts = on_circle(&mut arm.g, [w[0], w[1]], [-e[0], -e[1]], reach);
        for (shoulder, first) in firsts.into_iter().enumerate() {
            let moved = arm.g.scale3(-first, e);
            let w = arm.g.add3(w, moved);
            let free_second = free(arm, 1);
            let second = angle_between(&mut arm.g, [f[0], f[1]], [w[0], w[1]], free_second);
            out[2 * shoulder + elbow] =
                [Value::Slide(first), Value::Turn(second), Value::Turn(third)];
        }
    }
    out
}
