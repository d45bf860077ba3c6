//! Postures at a bench: with the tool's point in sockets, or near plates.

use nalgebra::{DMatrix, DVector, Isometry3, Unit, Vector3};
use stiffarm_kernels::generic::Arm;

use super::super::reality::Reality;
use super::super::transform::{carried, origin};
use super::{Design, poses, rounded};
use crate::measurement::{Kind, Measurements, Row};
use crate::observe::{Aim, Plane, Seen, View};

/// Sockets or plates of a bench: fewer tell some of an arm's lengths from each other badly.
const THINGS: usize = 6;

/// Steps that bring a posture there, and postures that are tried at most.
const STEPS: usize = 60;
const TRIES: usize = 400;

/// A posture is there at this distance, m: what is read is exact in any case.
const THERE: f64 = 1e-3;

/// How far from a plate it is probed, m.
const PROBED: f64 = 0.05;

/// For every posture the thing that is read there, the postures changed so that they reach it: an equal number at
/// each.
pub(super) fn reach(arm: &Arm, design: &Design, postures: &mut [Vec<f64>]) -> Vec<Aim> {
    let nominal = Reality::nominal(arm);
    let at = |q: &[f64]| origin(&nominal.tool_at(q));
    let things: Vec<Aim> =
        postures.iter().take(THINGS).enumerate().map(|(k, q)| aim(design, k, at(q))).collect();
    let mut more = Design { poses: TRIES, seed: design.seed.wrapping_add(1), ..*design };
    let mut spare = Vec::new();
    let mut chosen = Vec::with_capacity(postures.len());
    let homes: Vec<Vec<f64>> = postures.iter().take(THINGS).cloned().collect();
    for (number, posture) in postures.iter_mut().enumerate() {
        let aim = &things[number % things.len()];
        let (mut q, mut tries) = (posture.clone(), 0);
        while !bring(arm, &at, &mut q, aim) {
            tries += 1;
            if tries > TRIES {
                // Where nothing else goes, the posture by which the thing was placed does.
                q.clone_from(&homes[number % things.len()]);
                break;
            }
            q = spare.pop().unwrap_or_else(|| {
                more.seed = more.seed.wrapping_add(1);
                spare = poses::draw(arm, &more);
                posture.clone()
            });
        }
        *posture = q.iter().map(|q| rounded(*q, 1e6)).collect();
        chosen.push(aim.clone());
    }
    chosen
}

/// Puts the unknown points and planes of a file where its postures have the rigid arm's point; unknown centres stay
/// at the origin of the measuring frame.
pub fn placed(arm: &Arm, design: &Measurements) -> Measurements {
    let nominal = Reality::nominal(arm);
    let mut placed = design.clone();
    let key = |row: &Row| {
        let aim = row.aim.as_deref().filter(|aim| !aim.free.is_empty())?;
        let is_placed = matches!(aim.seen, Seen::Point | Seen::Plane);
        is_placed.then(|| (aim.clone(), row.session.clone()))
    };
    let mut things: Vec<(_, Vec<usize>)> = Vec::new();
    for (number, row) in design.rows.iter().enumerate() {
        let Some(key) = key(row) else { continue };
        match things.iter_mut().find(|(known, _)| *known == key) {
            Some((_, rows)) => rows.push(number),
            None => things.push((key, vec![number])),
        }
    }
    for ((aim, _), rows) in things {
        let point = |row: &usize| {
            let row = &design.rows[*row];
            let offset = Vector3::from(row.offset.unwrap_or_default());
            (carried(&nominal.tool_at(&row.q), &offset), 0.0)
        };
        let view = aim.guess(&rows.iter().map(point).collect::<Vec<_>>());
        for row in rows {
            placed.rows[row].aim.iter_mut().for_each(|aim| aim.view = view);
        }
    }
    placed
}

/// A socket where the tool is, of a name that no other seed has, or a plate near it: a floor and two walls in turn,
/// each a little tilted.
fn aim(design: &Design, number: usize, at: Vector3<f64>) -> Aim {
    if matches!(design.kind, Kind::Bench { lengths: 3, .. }) {
        let view = View::Point(at.map(|x| rounded(x, 1e6)));
        return Aim {
            seen: Seen::Point,
            name: format!("socket {}.{}", design.seed, number + 1),
            view,
            free: &[0, 1, 2],
        };
    }
    let axis = Vector3::ith(2 - number % 3, 1.0);
    let tilt = 0.1 * Vector3::new((number as f64).sin(), (2.0 * number as f64).cos(), 0.3);
    let normal = Unit::new_normalize(axis + tilt);
    let view = View::Plane(Plane::new(normal, rounded(normal.dot(&at), 1e6)));
    Aim {
        seen: Seen::Plane,
        name: format!("plate {}.{}", design.seed, number + 1),
        view,
        free: &[0, 1, 2],
    }
}

/// Moves a posture until the tool is there; whether it goes within the joints' limits.
fn bring(arm: &Arm, at: &dyn Fn(&[f64]) -> Vector3<f64>, q: &mut [f64], aim: &Aim) -> bool {
    const STEP: f64 = 1e-6;
    let near = if aim.seen == Seen::Plane { PROBED } else { THERE };
    let count = aim.seen.numbers();
    let read = |point: &Vector3<f64>| aim.view.read(&Isometry3::from(*point));
    for _ in 0..STEPS {
        let here = at(q);
        let off = read(&here).rows(0, count).into_owned();
        if off.norm() < near {
            break;
        }
        let mut slope = DMatrix::zeros(count, q.len());
        for joint in 0..q.len() {
            let mut moved = q.to_vec();
            moved[joint] += STEP;
            let by = read(&at(&moved)) - read(&here);
            slope.set_column(joint, &(by.rows(0, count) / STEP));
        }
        let Ok(step) = slope.svd(true, true).solve(&-off, 1e-3) else { return false };
        let step: DVector<f64> = step;
        // A step of half a radian is as far as the first order holds.
        let part = (0.5 / step.amax()).min(1.0);
        q.iter_mut().zip(step.iter()).for_each(|(q, step)| *q += part * step);
    }
    let within = arm.joints.iter().zip(q.iter()).all(|(joint, q)| {
        let [low, high] = poses::range(joint);
        (low..=high).contains(q)
    });
    within && read(&at(q)).norm() < near
}
