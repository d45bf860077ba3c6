//! The first three angles of an arm with a spherical wrist: those that bring the wrist's point where it is to be.
//!
//! With `c` the point behind axis 3 and `r` the point from frame 0 moved by d_1,
//! `r = Rz(θ_1) (a_1 x + Rx(α_1) g)`, `g = Rz(θ_2) f + d_2 z`, `f = a_2 x + Rx(α_2) (Rz(θ_3) c + d_3 z)`.
//! A special pair of axes makes an equation of one unknown angle (Pieper 1968).

use super::displacement::{about_x, about_z_back};
use super::layout::{Layout, Value};
use super::point::{Linear, Point};
use super::subproblem::{Free, Pair, angle_between, square, turned, two_angles, two_angles_within};
use super::term::{Term, Vector, dot, minus, plus};
use super::{pieper, sliding};
use crate::number::Number;
use crate::robot::Position;

/// Where the first three joints stand, and how far the wrist's point is from where it is to be, m.
#[derive(Clone, Copy)]
pub(super) struct At<'g> {
    pub joints: [Value<'g>; 3],
    pub distance: Term<'g>,
}

/// Shoulder and elbow as the bits of the number, from the higher.
pub(super) fn positions<'g>(arm: &Layout<'g>, position: Position, behind: usize) -> Vec<At<'g>> {
    let point = &Point::new(arm, behind);
    let triples = match position {
        Position::SecondParallelThird => second_parallel_third(arm, point),
        Position::FirstParallelSecond => first_parallel_second(arm, point),
        Position::FirstMeetsSecond => first_meets_second(arm, point),
        Position::SecondMeetsThird => second_meets_third(arm, point),
        Position::General => pieper::general(arm, point).to_vec(),
        Position::Sliding(sliding) => {
            let each = sliding::joints(arm, point, sliding).into_iter();
            return each.map(|joints| at(arm, point, joints)).collect();
        }
    };
    let at = |angles: [Pair<'g>; 3]| At {
        joints: angles.map(Value::Turn),
        distance: distance(arm, point, angles),
    };
    triples.into_iter().map(at).collect()
}

/// Both shoulders of each elbow, in the order of the branches' numbers.
pub(super) fn shoulders_first<T>([[a, b], [c, d]]: [[T; 2]; 2]) -> Vec<T> {
    vec![a, c, b, d]
}

/// How far the wrist's point is from where it is to be, of joints that may slide.
fn at<'g>(arm: &Layout<'g>, point: &Point<'g>, joints: [Value<'g>; 3]) -> At<'g> {
    let mut left = point.wrist;
    for (k, value) in joints.into_iter().enumerate() {
        left[2] = left[2] - arm.along(k, value);
        left = about_z_back(arm.turn(k, value), left);
        if k < 2 {
            left = arm.behind_link(k, left);
        }
    }
    let [x, y] = point.c;
    let off = plus(left, [-x, -y, -point.cz]);
    At { joints, distance: dot(off, off).sqrt() }
}

/// Both angles of joint 3 where it has a value.
pub(super) fn solved<'g>(linear: &Linear<'g>, value: Term<'g>) -> [Pair<'g>; 2] {
    two_angles(linear.by, value - linear.constant, None)
}

/// The same of an elbow that, stretched, leaves a joint free: there it is stretched where it is so but for rounding.
fn stretched<'g>(linear: &Linear<'g>, value: Term<'g>) -> [Pair<'g>; 2] {
    two_angles_within(linear.by, value - linear.constant, Number::rounded(STRETCHED))
}

/// The part of `a² + b²` that `a² + b² − c²` counts as none below: 256 units of rounding of a double, since the pose and the
/// square of the distance bring their own errors (16 units are too few for stretched postures of an iiwa). The elbow is then
/// wrong by 2.4e-7 rad at most, and the pose by 3e-14 of the arm's size.
pub(super) const STRETCHED: f64 = 256.0 * f64::EPSILON;

/// A joint of which the point may leave the angle free.
pub(super) fn free<'g>(arm: &Layout<'g>, joint: usize) -> Option<Free<'g>> {
    Some(Free { near: arm.near[joint], tiny: arm.tiny })
}

/// `g_y` of `r_z = sin α_1 g_y + cos α_1 g_z`.
fn across_second<'g>(arm: &Layout<'g>, rz: Term<'g>, gz: Term<'g>) -> Term<'g> {
    let [cosine, sine] = arm.alpha[0];
    (rz - cosine * gz) * sine.recip()
}

/// `g` is known across axis 2 from `r` along axis 1, and with it θ_1; then the plane's two links.
fn second_parallel_third<'g>(arm: &Layout<'g>, point: &Point<'g>) -> Vec<[Pair<'g>; 3]> {
    let [rx, ry, rz] = point.r;
    let gz = point.fz(arm).constant + arm.d[1];
    let gy = across_second(arm, rz, gz);
    let [across, _] = turned(arm.alpha[0], [gy, gz]);
    let firsts = two_angles([ry, -rx], across, free(arm, 0));
    let each = firsts.map(|first| {
        let [x, _, _] = about_z_back(first, point.r);
        let gx = x - arm.a[0];
        let reach = square([gx, gy]);
        solved(&point.square_across(arm), reach).map(|third| {
            let [fx, fy, _] = point.f(arm, third);
            [first, angle_between([fx, fy], [gx, gy], free(arm, 1)), third]
        })
    });
    each.as_flattened().to_vec()
}

/// `|r|²` depends on θ_3 alone, then `r` along axis 1 on θ_2.
fn first_meets_second<'g>(arm: &Layout<'g>, point: &Point<'g>) -> Vec<[Pair<'g>; 3]> {
    let [rx, ry, rz] = point.r;
    let (squares, along) = (point.square(arm), point.fz(arm));
    let twice = arm.d[1] + arm.d[1];
    let by = [0, 1].map(|k| squares.by[k] + twice * along.by[k]);
    let constant = squares.constant + twice * along.constant;
    let linear = Linear { by, constant: constant + arm.d[1] * arm.d[1] };
    let reach = square([rx, ry]) + rz * rz;
    let aligned = arm.a[1].is_zero() && arm.alpha[1][0].is_zero() && point.uz.is_zero();
    let thirds = if aligned { stretched(&linear, reach) } else { solved(&linear, reach) };
    shoulders_first(thirds.map(|third| {
        let f = point.f(arm, third);
        about_meeting(arm, point.r, f).map(|[first, second]| [first, second, third])
    }))
}

/// θ_1 and θ_2 about axes that meet, for both shoulders: `f` is what joint 2 turns.
pub(super) fn about_meeting<'g>(
    arm: &Layout<'g>,
    [rx, ry, rz]: Vector<'g>,
    [fx, fy, fz]: Vector<'g>,
) -> [[Pair<'g>; 2]; 2] {
    let gz = fz + arm.d[1];
    let gy = across_second(arm, rz, gz);
    two_angles([fy, fx], gy, free(arm, 1)).map(|second| {
        let [gx, gy] = turned(second, [fx, fy]);
        let [_, y, _] = about_x(arm.alpha[0], [gx, gy, gz]);
        [angle_between([gx, y], [rx, ry], free(arm, 0)), second]
    })
}

/// `r` along axis 1 depends on θ_3 alone, then its distance from the axis on θ_2.
fn first_parallel_second<'g>(arm: &Layout<'g>, point: &Point<'g>) -> Vec<[Pair<'g>; 3]> {
    let along = point.fz(arm);
    let height = arm.alpha[0][0] * point.r[2] - arm.d[1];
    shoulders_first(solved(&along, height).map(|third| {
        let f = point.f(arm, third);
        about_parallel(arm, point.r, f).map(|[first, second]| [first, second, third])
    }))
}

/// θ_1 and θ_2 about parallel axes, two of them: `f` is what joint 2 turns.
pub(super) fn about_parallel<'g>(
    arm: &Layout<'g>,
    [rx, ry, _]: Vector<'g>,
    [fx, fy, _]: Vector<'g>,
) -> [[Pair<'g>; 2]; 2] {
    let (a, side) = (arm.a[0], arm.alpha[0][0]);
    let (across, own, inner) = (square([rx, ry]), a * a, square([fx, fy]));
    let gx = (across - own - inner) * (a + a).recip();
    two_angles([fx, -fy], gx, free(arm, 1)).map(|second| {
        let [gx, gy] = turned(second, [fx, fy]);
        [angle_between([a + gx, side * gy], [rx, ry], free(arm, 0)), second]
    })
}

/// The distance from where 2 and 3 meet depends on θ_1 alone, then `g` along axis 2 on θ_3.
fn second_meets_third<'g>(arm: &Layout<'g>, point: &Point<'g>) -> Vec<[Pair<'g>; 3]> {
    let [rx, ry, rz] = point.r;
    let (inner, along) = (point.square(arm).constant, point.fz(arm));
    let free_first = Free { near: arm.near[0], tiny: arm.tiny * arm.size };
    let (a, d, [cosine, sine]) = (arm.a[0], arm.d[1], arm.alpha[0]);
    // |r|² + a_1² + d_2² − 2 a_1 m_x − 2 d_2 g_z = |f|², where m = Rz(−θ_1) r and g_z = cos α_1 r_z − sin α_1 m_y: half of
    // what is left is −a_1 m_x + d_2 sin α_1 m_y.
    let by = turned([-a, -(d * sine)], [rx, ry]);
    let (across, axial, own) = (square([rx, ry]), rz * rz, square([a, d]));
    let rest = inner - (across + axial + own);
    let right = rz.exact(Number::ratio(1, 2)) * rest + d * cosine * rz;
    let each = two_angles(by, right, Some(free_first)).map(|first| {
        let [gx, gy, gz] = arm.behind_link(0, about_z_back(first, point.r));
        solved(&along, gz - d).map(|third| {
            let [fx, fy, _] = point.f(arm, third);
            [first, angle_between([fx, fy], [gx, gy], free(arm, 1)), third]
        })
    });
    each.as_flattened().to_vec()
}

/// How far the wrist's point is from where it is to be.
fn distance<'g>(
    arm: &Layout<'g>,
    point: &Point<'g>,
    [first, second, third]: [Pair<'g>; 3],
) -> Term<'g> {
    let [fx, fy, fz] = point.f(arm, third);
    let [gx, gy] = turned(second, [fx, fy]);
    let reached = arm.link(0, [gx, gy, fz + arm.d[1]]);
    let off = minus(about_z_back(first, point.r), reached);
    dot(off, off).sqrt()
}
