//! The first three joints of an arm of which some are prismatic: those that bring the wrist's point where it is to be.
//!
//! A prismatic joint moves the point by a constant direction times its displacement: what is perpendicular to it depends on
//! the other joints alone.

use super::layout::{Layout, Value, about_x, about_x_back, about_z, about_z_back};
use super::position::{Point, STRETCHED, about_meeting, about_parallel, free, solved};
use super::subproblem::{Pair, angle_between, on_circle, square, turned, turned_back, two_angles};
use crate::expr::{Expr, Graph, Vec3};
use crate::number::Number;
use crate::robot::Sliding;

const Z: Vec3 = [Expr::ZERO, Expr::ZERO, Expr::ONE];

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
fn link(arm: &mut Layout, k: usize, v: Vec3) -> Vec3 {
    let [x, y, z] = about_x(&mut arm.g, arm.alpha[k - 1], v);
    [arm.g.add(arm.a[k - 1], x), y, z]
}

/// `Rx(−α_1) (v − a_1 x)`.
fn behind_first_link(arm: &mut Layout, [x, y, z]: Vec3) -> Vec3 {
    let x = arm.g.sub(x, arm.a[0]);
    about_x_back(&mut arm.g, arm.alpha[0], [x, y, z])
}

/// The point behind joint 3, which slides, where it stands at no displacement.
fn unmoved(arm: &mut Layout, point: &Point) -> Vec3 {
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
fn behind_first_slide(arm: &mut Layout, point: &Point) -> (Vec3, Vec3) {
    let v = about_z_back(&mut arm.g, arm.offsets[0], point.wrist);
    let w = behind_first_link(arm, v);
    (w, about_x_back(&mut arm.g, arm.alpha[0], Z))
}

/// What is left along axis 2, by the first joint: `w_z − e_z d_1 = f_z + d_2`.
fn first_left(arm: &mut Layout, w: Vec3, e: Vec3, fz: Expr) -> Value {
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

/// The distance from where axes 1 and 2 meet depends on the last joint alone.
fn last_meets(arm: &mut Layout, point: &Point) -> Vec<[Value; 3]> {
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
fn last_parallel(arm: &mut Layout, point: &Point) -> Vec<[Value; 3]> {
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
fn between_along(arm: &mut Layout, point: &Point) -> Vec<[Value; 3]> {
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
fn between_across(arm: &mut Layout, point: &Point) -> Vec<[Value; 3]> {
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
fn first_along(arm: &mut Layout, point: &Point) -> Vec<[Value; 3]> {
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
fn first_across(arm: &mut Layout, point: &Point) -> Vec<[Value; 3]> {
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
