//! The first three angles of an arm with a spherical wrist: those that bring the wrist's point where it is to be.
//!
//! With `c` the point behind axis 3 and `r` the point from frame 0 moved by d_1,
//! `r = Rz(θ_1) (a_1 x + Rx(α_1) g)`, `g = Rz(θ_2) f + d_2 z`, `f = a_2 x + Rx(α_2) (Rz(θ_3) c + d_3 z)`.
//! A special pair of axes makes an equation of one unknown angle (Pieper 1968).

use super::displacement::{about_x, about_x_back, about_z_back};
use super::layout::{Layout, Value};
use super::pieper;
use super::point::{Linear, Point};
use super::sliding;
use super::subproblem::{Free, Pair, angle_between, square, turned, two_angles, two_angles_within};
use crate::expr::{Expr, Graph, Vec3};
use crate::number::Number;
use crate::robot::Position;

/// Where the first three joints stand, and how far the wrist's point is from where it is to be, m.
#[derive(Clone, Copy)]
pub(super) struct At {
    pub joints: [Value; 3],
    pub distance: Expr,
}

/// Shoulder and elbow as the bits of the number, from the higher.
pub(super) fn positions(arm: &mut Layout, position: Position, behind: usize) -> Vec<At> {
    let point = Point::new(arm, behind);
    let triples = match position {
        Position::SecondParallelThird => second_parallel_third(arm, &point),
        Position::FirstParallelSecond => first_parallel_second(arm, &point),
        Position::FirstMeetsSecond => first_meets_second(arm, &point),
        Position::SecondMeetsThird => second_meets_third(arm, &point),
        Position::General => pieper::general(arm, &point),
        Position::Sliding(sliding) => {
            let each = sliding::joints(arm, &point, sliding).into_iter();
            return each.map(|joints| at(arm, &point, joints)).collect();
        }
    };
    let each = triples.into_iter();
    each.map(|angles| At {
        joints: angles.map(Value::Turn),
        distance: distance(arm, &point, angles),
    })
    .collect()
}

/// How far the wrist's point is from where it is to be, of joints that may slide.
fn at(arm: &mut Layout, point: &Point, joints: [Value; 3]) -> At {
    let mut left = point.wrist;
    for (k, value) in joints.into_iter().enumerate() {
        let (turn, along) = (arm.turn(k, value), arm.along(k, value));
        left[2] = arm.g.sub(left[2], along);
        left = about_z_back(&mut arm.g, turn, left);
        if k < 2 {
            left[0] = arm.g.sub(left[0], arm.a[k]);
            left = about_x_back(&mut arm.g, arm.alpha[k], left);
        }
    }
    let [x, y] = point.c;
    let off = arm.g.add3(left, [-x, -y, -point.cz]);
    let square = arm.g.dot3(off, off);
    At { joints, distance: arm.g.sqrt(square) }
}

/// Both angles of joint 3 where it has a value.
pub(super) fn solved(g: &mut Graph, linear: &Linear, value: Expr) -> [Pair; 2] {
    let right = g.sub(value, linear.constant);
    two_angles(g, linear.by, right, None)
}

/// The same of an elbow that, stretched, leaves a joint free: there it is stretched where it is so but for rounding.
fn stretched(g: &mut Graph, linear: &Linear, value: Expr) -> [Pair; 2] {
    let right = g.sub(value, linear.constant);
    two_angles_within(g, linear.by, right, Number::rounded(STRETCHED))
}

/// The part of `a² + b²` that `a² + b² − c²` counts as none below: 256 units of rounding of a double, since the pose and the
/// square of the distance bring their own errors (16 units are too few for stretched postures of an iiwa). The elbow is then
/// wrong by 2.4e-7 rad at most, and the pose by 3e-14 of the arm's size.
pub(super) const STRETCHED: f64 = 256.0 * f64::EPSILON;

/// A joint of which the point may leave the angle free.
pub(super) fn free(arm: &Layout, joint: usize) -> Option<Free> {
    Some(Free { near: arm.near[joint], tiny: arm.tiny })
}

/// `g_y` of `r_z = sin α_1 g_y + cos α_1 g_z`.
fn across_second(arm: &mut Layout, rz: Expr, gz: Expr) -> Expr {
    let (g, [cosine, sine]) = (&mut arm.g, arm.alpha[0]);
    let part = g.mul(cosine, gz);
    let rest = g.sub(rz, part);
    let inverse = g.recip(sine);
    g.mul(rest, inverse)
}

/// `g` is known across axis 2 from `r` along axis 1, and with it θ_1; then the plane's two links.
fn second_parallel_third(arm: &mut Layout, point: &Point) -> [[Pair; 3]; 4] {
    let [rx, ry, rz] = point.r;
    let along = point.fz(arm).constant;
    let gz = arm.g.add(along, arm.d[1]);
    let gy = across_second(arm, rz, gz);
    let [across, _] = turned(&mut arm.g, arm.alpha[0], [gy, gz]);
    let free_first = free(arm, 0);
    let firsts = two_angles(&mut arm.g, [ry, -rx], across, free_first);
    let mut out = [[[Expr::ZERO; 2]; 3]; 4];
    for (shoulder, first) in firsts.into_iter().enumerate() {
        let [x, _, _] = about_z_back(&mut arm.g, first, point.r);
        let gx = arm.g.sub(x, arm.a[0]);
        let reach = square(&mut arm.g, [gx, gy]);
        let mut linear = point.square(arm);
        let axial = arm.g.mul(point.uz, point.uz);
        linear.constant = arm.g.sub(linear.constant, axial);
        for (elbow, third) in solved(&mut arm.g, &linear, reach).into_iter().enumerate() {
            let [fx, fy, _] = point.f(arm, third);
            let free_second = free(arm, 1);
            let second = angle_between(&mut arm.g, [fx, fy], [gx, gy], free_second);
            out[2 * shoulder + elbow] = [first, second, third];
        }
    }
    out
}

/// `|r|²` depends on θ_3 alone, then `r` along axis 1 on θ_2.
fn first_meets_second(arm: &mut Layout, point: &Point) -> [[Pair; 3]; 4] {
    let [rx, ry, rz] = point.r;
    let (squares, along) = (point.square(arm), point.fz(arm));
    let g = &mut arm.g;
    let twice = g.add(arm.d[1], arm.d[1]);
    let mut both = |a: Expr, b: Expr| {
        let part = g.mul(twice, b);
        g.add(a, part)
    };
    let by = [both(squares.by[0], along.by[0]), both(squares.by[1], along.by[1])];
    let constant = both(squares.constant, along.constant);
    let own = g.mul(arm.d[1], arm.d[1]);
    let linear = Linear { by, constant: g.add(constant, own) };
    let (across, axial) = (square(g, [rx, ry]), g.mul(rz, rz));
    let reach = g.add(across, axial);
    let mut out = [[[Expr::ZERO; 2]; 3]; 4];
    let aligned = arm.a[1].is_zero() && arm.alpha[1][0].is_zero() && point.uz.is_zero();
    let thirds = match aligned {
        true => stretched(&mut arm.g, &linear, reach),
        false => solved(&mut arm.g, &linear, reach),
    };
    for (elbow, third) in thirds.into_iter().enumerate() {
        let f = point.f(arm, third);
        for (shoulder, [first, second]) in about_meeting(arm, point.r, f).into_iter().enumerate() {
            out[2 * shoulder + elbow] = [first, second, third];
        }
    }
    out
}

/// θ_1 and θ_2 about axes that meet, for both shoulders: `f` is what joint 2 turns.
pub(super) fn about_meeting(
    arm: &mut Layout,
    [rx, ry, rz]: Vec3,
    [fx, fy, fz]: Vec3,
) -> [[Pair; 2]; 2] {
    let (free_first, free_second) = (free(arm, 0), free(arm, 1));
    let gz = arm.g.add(fz, arm.d[1]);
    let gy = across_second(arm, rz, gz);
    let g = &mut arm.g;
    two_angles(g, [fy, fx], gy, free_second).map(|second| {
        let [gx, gy] = turned(g, second, [fx, fy]);
        let [_, y, _] = about_x(g, arm.alpha[0], [gx, gy, gz]);
        let first = angle_between(g, [gx, y], [rx, ry], free_first);
        [first, second]
    })
}

/// `r` along axis 1 depends on θ_3 alone, then its distance from the axis on θ_2.
fn first_parallel_second(arm: &mut Layout, point: &Point) -> [[Pair; 3]; 4] {
    let rz = point.r[2];
    let along = point.fz(arm);
    let side = arm.alpha[0][0];
    let height = arm.g.mul(side, rz);
    let height = arm.g.sub(height, arm.d[1]);
    let mut out = [[[Expr::ZERO; 2]; 3]; 4];
    for (elbow, third) in solved(&mut arm.g, &along, height).into_iter().enumerate() {
        let f = point.f(arm, third);
        for (shoulder, [first, second]) in about_parallel(arm, point.r, f).into_iter().enumerate() {
            out[2 * shoulder + elbow] = [first, second, third];
        }
    }
    out
}

/// θ_1 and θ_2 about parallel axes, two of them: `f` is what joint 2 turns.
pub(super) fn about_parallel(
    arm: &mut Layout,
    [rx, ry, _]: Vec3,
    [fx, fy, _]: Vec3,
) -> [[Pair; 2]; 2] {
    let (free_first, free_second) = (free(arm, 0), free(arm, 1));
    let (g, a, side) = (&mut arm.g, arm.a[0], arm.alpha[0][0]);
    let (across, own, inner) = (square(g, [rx, ry]), g.mul(a, a), square(g, [fx, fy]));
    let rest = g.sub(across, own);
    let rest = g.sub(rest, inner);
    let twice = g.add(a, a);
    let inverse = g.recip(twice);
    let gx = g.mul(rest, inverse);
    two_angles(g, [fx, -fy], gx, free_second).map(|second| {
        let [gx, gy] = turned(g, second, [fx, fy]);
        let (x, y) = (g.add(a, gx), g.mul(side, gy));
        let first = angle_between(g, [x, y], [rx, ry], free_first);
        [first, second]
    })
}

/// The distance from where 2 and 3 meet depends on θ_1 alone, then `g` along axis 2 on θ_3.
fn second_meets_third(arm: &mut Layout, point: &Point) -> [[Pair; 3]; 4] {
    let [rx, ry, rz] = point.r;
    let (inner, along) = (point.square(arm).constant, point.fz(arm));
    let free_first = Free { near: arm.near[0], tiny: arm.g.mul(arm.tiny, arm.size) };
    let (g, a, d, [cosine, sine]) = (&mut arm.g, arm.a[0], arm.d[1], arm.alpha[0]);
    // |r|² + a_1² + d_2² − 2 a_1 m_x − 2 d_2 g_z = |f|², where m = Rz(−θ_1) r and g_z = cos α_1 r_z − sin α_1 m_y: half of
    // what is left is −a_1 m_x + d_2 sin α_1 m_y.
    let side = g.mul(d, sine);
    let by = turned(g, [-a, -side], [rx, ry]);
    let (across, axial, own) = (square(g, [rx, ry]), g.mul(rz, rz), square(g, [a, d]));
    let around = g.add(across, axial);
    let all = g.add(around, own);
    let rest = g.sub(inner, all);
    let half = g.number(Number::ratio(1, 2));
    let rest = g.mul(half, rest);
    let lift = g.mul(d, cosine);
    let lift = g.mul(lift, rz);
    let right = g.add(rest, lift);
    let mut out = [[[Expr::ZERO; 2]; 3]; 4];
    for (shoulder, first) in two_angles(g, by, right, Some(free_first)).into_iter().enumerate() {
        let free_second = free(arm, 1);
        let [x, y, z] = about_z_back(&mut arm.g, first, point.r);
        let x = arm.g.sub(x, arm.a[0]);
        let [gx, gy, gz] = about_x_back(&mut arm.g, arm.alpha[0], [x, y, z]);
        let height = arm.g.sub(gz, arm.d[1]);
        for (elbow, third) in solved(&mut arm.g, &along, height).into_iter().enumerate() {
            let [fx, fy, _] = point.f(arm, third);
            let second = angle_between(&mut arm.g, [fx, fy], [gx, gy], free_second);
            out[2 * shoulder + elbow] = [first, second, third];
        }
    }
    out
}

/// How far the wrist's point is from where it is to be.
fn distance(arm: &mut Layout, point: &Point, [first, second, third]: [Pair; 3]) -> Expr {
    let [fx, fy, fz] = point.f(arm, third);
    let g = &mut arm.g;
    let [gx, gy] = turned(g, second, [fx, fy]);
    let gz = g.add(fz, arm.d[1]);
    let [x, y, z] = about_x(g, arm.alpha[0], [gx, gy, gz]);
    let reached = [g.add(arm.a[0], x), y, z];
    let asked = about_z_back(g, first, point.r);
    let off: Vec3 = core::array::from_fn(|k| g.sub(asked[k], reached[k]));
    let square = g.dot3(off, off);
    g.sqrt(square)
}
