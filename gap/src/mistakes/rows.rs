//! The rows by which mistakes are judged: spread over the file, each with what belongs to it.

use core::f64::consts::GOLDEN_RATIO;

use nalgebra::Vector6;
use stiffarm_kernels::generic::Arm;

use super::kind::{Mistake, Told, own_wrench};
use crate::effects::{Carrier, Known};
use crate::measurement::{Measurements, Row, Stands, number_of};
use crate::simulate::Moments;

/// Rows that a fit is of. A mistake that moves the tool by millimetres is seen on a few dozen.
const MOST: usize = 240;

/// Corners of a picture that are enough for the board's pose: two above what one out of a plane needs.
const CORNERS: usize = 8;

/// The rows, and which frame each is measured in.
pub(super) struct Rows<'a> {
    pub data: &'a Measurements,
    /// Numbers of the rows.
    pub chosen: Vec<usize>,
    /// Frames in which each row of the file is told.
    pub frame_of: Vec<usize>,
    /// Measured point of each row of the file: a marker in these, since a target may be put on anew.
    pub point_of: Vec<usize>,
    pub frames: usize,
    /// For each measured point, where the file says that it is on the tool, m.
    pub points: Vec<[f64; 3]>,
    /// What the robot file's effects move each joint by, for each row of the file; empty without any.
    moved: Vec<Vec<f64>>,
}

/// At most so many of some rows, spread over them; of a board pictures that still tell where it is, since frames begin
/// there.
fn thinned(data: &Measurements, rows: &[usize], most: usize) -> Vec<usize> {
    if !data.by_board {
        return rows.iter().copied().step_by(rows.len().div_ceil(most).max(1)).collect();
    }
    let mut pictures = data.pictures();
    pictures.iter_mut().for_each(|picture| picture.retain(|row| rows.binary_search(row).is_ok()));
    pictures.retain(|picture| !picture.is_empty());
    let every = pictures.len().div_ceil((most / CORNERS).max(1)).max(1);
    let mut kept: Vec<usize> =
        pictures.iter().step_by(every).flat_map(|picture| spread(picture)).collect();
    kept.sort_unstable();
    kept
}

/// Enough corners of a picture, in no row of the board: by multiples of the golden ratio, of which each lies far from those
/// before it.
fn spread(picture: &[usize]) -> Vec<usize> {
    if picture.len() <= CORNERS {
        return picture.to_vec();
    }
    let at = |k: usize| ((k as f64 * GOLDEN_RATIO).fract() * picture.len() as f64) as usize;
    (0..CORNERS).map(|k| picture[at(k)]).collect()
}

impl<'a> Rows<'a> {
    /// Of measurements of `arm` that has the effects `known`.
    pub(super) fn of(arm: &Arm, data: &'a Measurements, known: &[Known]) -> Self {
        let stands = Stands::of(data);
        let (mut frames, mut names, mut points) = (Vec::new(), Vec::new(), Vec::new());
        let (mut frame_of, mut point_of) = (Vec::new(), Vec::new());
        for (row, both) in data.rows.iter().zip(stands.base_of.iter().zip(&stands.mount_of)) {
            let frame = number_of(&mut frames, both);
            let point = number_of(&mut names, (frame, row.marker.as_ref()));
            if point == points.len() {
                points.push(row.offset.unwrap_or_default());
            }
            frame_of.push(frame);
            point_of.push(point);
        }
        let chosen = thinned(data, &(0..data.rows.len()).collect::<Vec<_>>(), MOST);
        let moved = moved(arm, data, known);
        Rows { data, chosen, frame_of, point_of, frames: frames.len(), points, moved }
    }

    /// The same of at most `most` rows.
    pub(super) fn fewer(&self, most: usize) -> Vec<usize> {
        thinned(self.data, &self.chosen, most)
    }

    /// What a row says without the mistakes, and the joints' values; `None` where they leave it without a
    /// reading.
    pub(super) fn told(&self, row: usize, mistakes: &[Mistake]) -> Option<Told> {
        let at = self.with_reading_of(row, mistakes)?;
        let here: &Row = &self.data.rows[row];
        let q = self.data.rows[at].q.clone();
        let mut told = Told { q, measured: here.measured, wrench: own_wrench(here) };
        mistakes.iter().for_each(|mistake| mistake.reword(&mut told));
        if let Some(hung) = &here.payload {
            told.wrench += hung.weight;
        }
        if let Some(moved) = self.moved.get(at) {
            told.q.iter_mut().zip(moved).for_each(|(q, by)| *q += by);
        }
        mistakes.iter().for_each(|mistake| mistake.turn(&mut told.q));
        Some(told)
    }

    /// The row that has a row's readings; `None` where none has.
    fn with_reading_of(&self, row: usize, mistakes: &[Mistake]) -> Option<usize> {
        mistakes.iter().try_fold(row, |at, mistake| match mistake {
            Mistake::Late { rows } => self.neighbour(at, *rows),
            _ => Some(at),
        })
    }

    /// The row so many rows on, in the same session.
    fn neighbour(&self, row: usize, by: i32) -> Option<usize> {
        let at = row.checked_add_signed(by as isize)?;
        (self.data.rows.get(at)?.session == self.data.rows[row].session).then_some(at)
    }

    /// Whether a half of the rows, or more, stand where those with a reading that is stuck are left out.
    pub(super) fn are_enough(&self, mistakes: &[Mistake]) -> bool {
        let stuck = mistakes.iter().filter_map(|mistake| mistake.stuck());
        stuck.map(|(_, rows)| 2 * rows.len()).sum::<usize>() <= self.data.rows.len()
    }

    /// The measurements without the mistakes, of some rows or of all; rows that have no reading then are left out.
    pub(super) fn mended(&self, mistakes: &[Mistake], some: Option<&[usize]>) -> Measurements {
        let of_data: Vec<Mistake> =
            mistakes.iter().filter(|mistake| !mistake.is_of_robot()).copied().collect();
        let is_stuck = |row: usize| {
            of_data.iter().filter_map(|m| m.stuck()).any(|(_, rows)| rows.contains(&row))
        };
        let enough = self.are_enough(&of_data);
        let every: Vec<usize> = (0..self.data.rows.len()).collect();
        let rows = some.unwrap_or(&every).iter().map(|number| (*number, &self.data.rows[*number]));
        let mended =
            rows.filter(|(number, _)| !enough || !is_stuck(*number)).filter_map(|(number, row)| {
                let at = self.with_reading_of(number, &of_data)?;
                let hung = row.payload.as_ref().map_or_else(Vector6::zeros, |hung| hung.weight);
                let (q, measured, wrench) =
                    (self.data.rows[at].q.clone(), row.measured, own_wrench(row));
                let mut told = Told { q, measured, wrench };
                let mut sigma = row.sigma.as_deref().map(|sigma| Told {
                    q: told.q.clone(),
                    measured: *sigma,
                    wrench: Vector6::zeros(),
                });
                for mistake in &of_data {
                    mistake.reword(&mut told);
                    if let Some(sigma) = &mut sigma {
                        mistake.reword(sigma);
                    }
                }
                let mended = Row {
                    q: told.q,
                    measured: told.measured,
                    wrench: told.wrench + hung,
                    sigma: sigma.map(|sigma| Box::new(sigma.measured.abs())),
                    ..row.clone()
                };
                Some((number, mended))
            });
        self.data.of_rows(mended.collect())
    }
}

/// What the effects of a robot file move each joint by, for each row of the file; empty without any.
pub(crate) fn moved(arm: &Arm, data: &Measurements, known: &[Known]) -> Vec<Vec<f64>> {
    let of_joints: Vec<(usize, &Known)> = known
        .iter()
        .filter(|known| known.is_there(data))
        .filter_map(|known| match known.effect.carrier(known.spot) {
            Some(Carrier::Joint(joint)) => Some((joint, known)),
            _ => None,
        })
        .collect();
    if of_joints.is_empty() {
        return Vec::new();
    }
    let moments = Moments::of(data);
    let of_row = |(number, row): (usize, &Row)| {
        let (mut by, when) = (vec![0.0; arm.dof()], moments.at(number));
        for (joint, known) in &of_joints {
            let mut values = known.values.iter();
            known.effect.moves_by(row, &when, known.spot, &mut |unit| {
                by[*joint] += values.next().map_or(0.0, |value| value * unit);
            });
        }
        by
    };
    data.rows.iter().enumerate().map(of_row).collect()
}
