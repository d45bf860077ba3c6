//! Postures at a bench: with the tool's point in sockets, near plates, at gauges, and wherever a wire or a level reads.

use nalgebra::{DMatrix, DVector, Isometry3, Unit, Vector3};
use stiffarm_kernels::generic::Arm;

use super::super::reality::Reality;
use super::super::transform::{carried, origin};
use super::{Design, poses, rounded};
use crate::instrument::{Aim, Plane, Seen, View};
use crate::measurement::{Kind, Measurements, Row};
use crate::rng::{Rng, Stream};

/// Sockets or plates of a bench: fewer tell some of an arm's lengths from each other badly.
const THINGS: usize = 6;

/// Steps that bring a posture there, and postures that are tried at most.
const STEPS: usize = 60;
const TRIES: usize = 400;

/// A posture is there at this distance, m: what is read is exact in any case.
const THERE: f64 = 1e-3;

/// How far from a plate it is probed, and how far a gauge reads, m.
const PROBED: f64 = 0.05;

/// Fixed ends of wires, which stand around the arm.
const WIRES: usize = 3;

/// Zeros of a level are within this of 0, rad: it is screwed on by hand.
const ZERO: f64 = 0.02;

impl Design {
    /// The rows where something of a bench is read, in places and with zeros that nobody knows: six sockets, plates or
    /// gauges along six directions, three wires, a level.
    pub fn read_by(&self, arm: &Arm, seen: Seen) -> Measurements {
        let [.., angles, _, _] = seen.components();
        let lengths = if angles { 0 } else { seen.numbers() };
        let design = Design { kind: Kind::Bench { lengths, angles }, ..*self };
        let mut postures = poses::draw(arm, &design);
        let aims = reach(arm, &design, seen, &mut postures);
        let mut rows = design.at(arm, &postures);
        rows.rows.iter_mut().for_each(|row| row.aim = Some(Box::new(aims[row.group].clone())));
        rows
    }
}

/// For every posture the thing that is read there, the postures changed so that they reach it: an equal number at
/// each.
fn reach(arm: &Arm, design: &Design, seen: Seen, postures: &mut [Vec<f64>]) -> Vec<Aim> {
    let nominal = Reality::nominal(arm);
    let at = |q: &[f64]| origin(&nominal.tool_at(q));
    if matches!(seen, Seen::Distance | Seen::Level) {
        let places: Vec<_> = postures.iter().map(|q| at(q)).collect();
        return (0..places.len()).map(|k| around(design, seen, k % WIRES, &places)).collect();
    }
    let things: Vec<Aim> = postures
        .iter()
        .take(THINGS)
        .enumerate()
        .map(|(k, q)| aim(design, seen, k, at(q)))
        .collect();
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

/// A socket where the tool is, of a name that no other seed has, or a plate near it or a gauge across one: a floor and
/// two walls in turn, each a little tilted.
fn aim(design: &Design, seen: Seen, number: usize, at: Vector3<f64>) -> Aim {
    let named = |what: &str| Aim::at(seen, format!("{what} {}.{}", design.seed, number + 1));
    if seen == Seen::Point {
        return Aim { view: View::Point(at.map(|x| rounded(x, 1e6))), ..named("socket") };
    }
    let axis = Vector3::ith(2 - number % 3, 1.0);
    let tilt = 0.1 * Vector3::new((number as f64).sin(), (2.0 * number as f64).cos(), 0.3);
    let normal = Unit::new_normalize(axis + tilt);
    let height = rounded(normal.dot(&at), 1e6);
    if seen == Seen::Direction {
        return Aim { view: View::Direction { along: *normal, offset: -height }, ..named("gauge") };
    }
    Aim { view: View::Plane(Plane::new(normal, height)), ..named("plate") }
}

/// The fixed end of a wire beyond what the arm reaches, where another stands on the other sides; or a level.
fn around(design: &Design, seen: Seen, number: usize, places: &[Vector3<f64>]) -> Aim {
    if seen == Seen::Level {
        let mut rng = Rng::new(design.seed, Stream::Frames);
        let zeros = [0; 2].map(|_| rounded(rng.between(-ZERO, ZERO), 1e6));
        return Aim { view: View::Level(zeros), ..Aim::at(seen, "") };
    }
    let middle = places.iter().sum::<Vector3<f64>>() / places.len() as f64;
    let reach = places.iter().map(|p| (p - middle).norm()).fold(0.0, f64::max);
    let turn = core::f64::consts::TAU * number as f64 / WIRES as f64;
    let from = middle + 1.2 * reach * Vector3::new(turn.cos(), turn.sin(), -0.3);
    let view = View::Distance { from: from.map(|x| rounded(x, 1e6)), offset: 0.0 };
    Aim { view, ..Aim::at(seen, format!("wire {}.{}", design.seed, number + 1)) }
}

/// Moves a posture until the tool is there; whether it goes within the joints' limits.
fn bring(arm: &Arm, at: &dyn Fn(&[f64]) -> Vector3<f64>, q: &mut [f64], aim: &Aim) -> bool {
    const STEP: f64 = 1e-6;
    let near = if aim.seen == Seen::Point { THERE } else { PROBED };
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
