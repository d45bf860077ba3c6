//! Masses, centres and moments of inertia that bodies can have, of numbers that a log tells.
//!
//! A log tells sums of the links' numbers alone, with noise: a mass may come out negative. What is written down
//! is a body for each link: the least of the squares by which its torques differ from those that were fitted, each
//! in what is left of its joint, and of a divergence from what the robot file has (Lee, Wensing & Park 2020),
//! which counts as one independent number for each link. A link's ten numbers are a body's if its
//! pseudo-inertia, a matrix of four rows, is positive definite (Wensing, Kim & Slotine 2018).

use nalgebra::{DMatrix, DVector, Matrix3, Matrix4, Vector3};
use stiffarm_kernels::generic::Arm;

/// Of a link of which the robot file says nothing, kg and m: a ball of this mass and radius.
const BALL: [f64; 2] = [1.0, 0.1];

/// Steps of Newton's method; each about squares what is missing once it is near.
const STEPS: usize = 200;

/// A decrement below which it has arrived: of squares that are told in their noise.
const ARRIVED: f64 = 1e-9;

/// Entries of a tensor as a robot file has them, and where each is among a link's moments of mass.
const ENTRIES: [((usize, usize), usize); 6] =
    [((0, 0), 4), ((0, 1), 5), ((0, 2), 7), ((1, 1), 6), ((1, 2), 8), ((2, 2), 9)];

/// A body: mass, centre of mass, and inertia about that centre (xx, xy, xz, yy, yz, zz).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// kg.
    pub mass: f64,
    /// In the row's frame, m.
    pub com: [f64; 3],
    /// In the row's axes, kg·m².
    pub inertia: [f64; 6],
}

/// Bodies whose moments of mass, in the order of the torques' regressor, are near
/// to `wanted` by the squares `weight`, and to what the arm has.
pub fn bodies(arm: &Arm, wanted: &[f64], weight: &DMatrix<f64>) -> Vec<Body> {
    let wanted = DVector::from_column_slice(wanted);
    let units: Vec<Matrix4<f64>> = (0..10).map(unit).collect();
    let prior: Vec<Matrix4<f64>> = (0..arm.dof()).map(|link| known(arm, link)).collect();
    let inverses: Vec<Matrix4<f64>> =
        prior.iter().map(|p| p.try_inverse().unwrap_or_else(Matrix4::identity)).collect();
    let mut numbers = DVector::from_iterator(wanted.len(), prior.iter().flat_map(told));
    let matrix = |numbers: &DVector<f64>, link: usize| -> Matrix4<f64> {
        units.iter().enumerate().map(|(k, unit)| unit * numbers[10 * link + k]).sum()
    };
    // Nothing where a link is no body.
    let cost = |numbers: &DVector<f64>| -> Option<f64> {
        let off = numbers - &wanted;
        let mut sum = 0.5 * off.dot(&(weight * &off));
        for (link, inverse) in inverses.iter().enumerate() {
            let body = matrix(numbers, link);
            let root = body.cholesky()?;
            let log: f64 = 2.0 * root.l().diagonal().iter().map(|x| x.ln()).sum::<f64>();
            sum += (inverse * body).trace() - log;
        }
        sum.is_finite().then_some(sum)
    };
    let Some(mut now) = cost(&numbers) else { return Vec::new() };
    for _ in 0..STEPS {
        let mut slope = weight * (&numbers - &wanted);
        let mut bend = weight.clone();
        for (link, inverse) in inverses.iter().enumerate() {
            let Some(own) = matrix(&numbers, link).try_inverse() else { return Vec::new() };
            let pulled: Vec<Matrix4<f64>> = units.iter().map(|unit| own * unit).collect();
            for k in 0..10 {
                slope[10 * link + k] += (inverse * units[k]).trace() - pulled[k].trace();
                for l in 0..10 {
                    bend[(10 * link + k, 10 * link + l)] += (pulled[k] * pulled[l]).trace();
                }
            }
        }
        let Some(root) = bend.cholesky() else { break };
        let step = root.solve(&slope);
        let decrement = slope.dot(&step);
        if decrement < ARRIVED {
            break;
        }
        // Half as far until it goes down by a tenth of what was promised.
        let mut part = 1.0;
        let next = loop {
            let next = &numbers - &step * part;
            match cost(&next) {
                Some(cost) if cost <= now - 0.1 * part * decrement => break Some((next, cost)),
                _ if part < 1e-12 => break None,
                _ => part *= 0.5,
            }
        };
        let Some((next, cost)) = next else { break };
        (numbers, now) = (next, cost);
    }
    (0..arm.dof()).map(|link| body(&numbers.as_slice()[10 * link..10 * link + 10])).collect()
}

/// The moments of mass of bodies.
pub fn moments(bodies: &[Body]) -> Vec<f64> {
    bodies.iter().flat_map(|body| told(&pseudo(body))).collect()
}

/// What a unit of each number is of a pseudo-inertia: `Σ = ½ tr(I) 1 − I` above, the first moments and the mass
/// beside and below.
fn unit(k: usize) -> Matrix4<f64> {
    let mut numbers = [0.0; 10];
    numbers[k] = 1.0;
    let [m, x, y, z, xx, xy, yy, xz, yz, zz] = numbers;
    let half = 0.5 * (xx + yy + zz);
    Matrix4::new(
        half - xx,
        -xy,
        -xz,
        x, //
        -xy,
        half - yy,
        -yz,
        y, //
        -xz,
        -yz,
        half - zz,
        z, //
        x,
        y,
        z,
        m,
    )
}

/// The ten numbers of a pseudo-inertia.
fn told(matrix: &Matrix4<f64>) -> [f64; 10] {
    let second = |r: usize, c: usize| matrix[(r, c)];
    let trace = second(0, 0) + second(1, 1) + second(2, 2);
    [
        second(3, 3),
        second(0, 3),
        second(1, 3),
        second(2, 3),
        trace - second(0, 0),
        -second(0, 1),
        trace - second(1, 1),
        -second(0, 2),
        -second(1, 2),
        trace - second(2, 2),
    ]
}

fn pseudo(body: &Body) -> Matrix4<f64> {
    let [xx, xy, xz, yy, yz, zz] = body.inertia;
    let (c, inertia) = (Vector3::from(body.com), Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz));
    let second =
        Matrix3::identity() * (0.5 * inertia.trace()) - inertia + c * c.transpose() * body.mass;
    let mut matrix = Matrix4::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&second);
    matrix.fixed_view_mut::<3, 1>(0, 3).copy_from(&(c * body.mass));
    matrix.fixed_view_mut::<1, 3>(3, 0).copy_from(&(c.transpose() * body.mass));
    matrix[(3, 3)] = body.mass;
    matrix
}

fn body(numbers: &[f64]) -> Body {
    let mass = numbers[0];
    let c = Vector3::new(numbers[1], numbers[2], numbers[3]) / mass;
    let at =
        |r: usize, k: usize| if r == k { c.norm_squared() - c[r] * c[k] } else { -c[r] * c[k] };
    let inertia = ENTRIES.map(|((r, k), about)| numbers[about] - mass * at(r, k));
    Body { mass, com: c.into(), inertia }
}

/// What the arm has, if that is a body; else a ball about its centre.
fn known(arm: &Arm, link: usize) -> Matrix4<f64> {
    let joint = &arm.joints[link];
    let told = Body {
        mass: joint.mass,
        com: joint.com.into(),
        inertia: ENTRIES.map(|(at, _)| joint.inertia[at]),
    };
    let matrix = pseudo(&told);
    if joint.mass > 0.0 && matrix.cholesky().is_some() {
        return matrix;
    }
    let mass = if joint.mass > 0.0 { joint.mass } else { BALL[0] };
    let moment = 0.4 * mass * BALL[1] * BALL[1];
    pseudo(&Body { mass, com: joint.com.into(), inertia: [moment, 0.0, 0.0, moment, 0.0, moment] })
}

#[cfg(test)]
mod tests {
    use super::*;

    const BODY: Body = Body {
        mass: 3.0,
        com: [0.1, -0.2, 0.05],
        inertia: [0.02, 0.001, -0.002, 0.03, 0.003, 0.025],
    };

    #[test]
    fn numbers_and_bodies_are_told_both_ways() {
        let there = body(&moments(&[BODY]));
        assert!((there.mass - BODY.mass).abs() < 1e-15);
        let pairs = there.com.iter().zip(&BODY.com).chain(there.inertia.iter().zip(&BODY.inertia));
        for (is, was) in pairs {
            assert!((is - was).abs() < 1e-15, "{is}, not {was}");
        }
        // Steiner: the moment about the origin is that about the centre and m d².
        let about = 0.02 + 3.0 * (0.04 + 0.0025);
        assert!((moments(&[BODY])[4] - about).abs() < 1e-15);
    }
}
