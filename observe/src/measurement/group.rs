//! Which rows are one pose.

use std::collections::HashMap;
use std::hash::BuildHasher;

use super::Row;

/// Readings that agree to this are the same pose, rad or m: a controller that is sent to a pose again
/// reads it again to some hundred-thousandths, and nobody plans poses closer than a hundredth of a
/// degree.
const SAME: f64 = 1e-4;

/// The same where the joints are all that is read, the ball only lying in its socket: they differ by what the socket
/// leaves free. That is 0.3 mm at most in what people print, three standard deviations of a difference of two, a
/// quarter of a metre from the joint; and nobody takes half a degree for another posture.
const SAME_BY_HAND: f64 = 5e-3;

/// Least side of a cell of the grid in which neighbours are looked up, in the distance within which they
/// are such: what is near a point then lies in its cell and one beside it, along each coordinate. Of n
/// coordinates the side is n: (1 + 2/n)ⁿ < e² cells are looked up on average, and each holds few.
const SIDE: f64 = 2.0;

/// Where the cells begin, in their side: round numbers are not at their borders.
const FIRST: f64 = 0.371_9;

/// Kinds of points: those that are within some distance, in every coordinate, of the first of their
/// kind.
pub struct Near {
    within: f64,
    /// The first of each kind, one after the other.
    firsts: Vec<f64>,
    /// Of each kind the one before it in its cell.
    before: Vec<Option<usize>>,
    /// The last kind that began in a cell, by the cell's hash: cells that share one hold more to
    /// compare, no more.
    cells: HashMap<u64, usize>,
}

impl Near {
    /// Points no farther apart than this are one.
    pub fn new(within: f64) -> Self {
        Self { within, firsts: Vec::new(), before: Vec::new(), cells: HashMap::new() }
    }

    /// The kind of a point, numbered in the order in which they first appear; all have as many
    /// coordinates.
    pub fn kind(&mut self, point: &[f64]) -> usize {
        let wide = SIDE.max(point.len() as f64);
        // A conversion out of range saturates.
        let cell = |x: f64, off: f64| (x / (wide * self.within) + FIRST + off).floor() as i64;
        let mut cells = vec![Vec::with_capacity(point.len())];
        for x in point {
            let [low, high] = [-1.0, 1.0].map(|side| cell(*x, side / wide));
            if low < high {
                let others: Vec<Vec<i64>> = cells.clone();
                cells.iter_mut().for_each(|cell| cell.push(low));
                cells.extend(others.into_iter().map(|mut cell| {
                    cell.push(high);
                    cell
                }));
            } else {
                cells.iter_mut().for_each(|cell| cell.push(low));
            }
        }
        let first = |kind: usize| &self.firsts[kind * point.len()..(kind + 1) * point.len()];
        let is_near = |kind: &usize| {
            first(*kind).iter().zip(point).all(|(a, b)| (a - b).abs() <= self.within)
        };
        let in_cell = |cell: &Vec<i64>| {
            let last = self.cells.get(&self.cells.hasher().hash_one(cell)).copied();
            core::iter::successors(last, |kind| self.before[*kind])
        };
        if let Some(kind) = cells.iter().flat_map(in_cell).filter(is_near).min() {
            return kind;
        }
        let own: Vec<i64> = point.iter().map(|x| cell(*x, 0.0)).collect();
        let (own, kind) = (self.cells.hasher().hash_one(own), self.before.len());
        self.before.push(self.cells.insert(own, kind));
        self.firsts.extend(point);
        kind
    }
}

/// Numbers the poses in the order in which they first appear; returns how many there are.
///
/// With a `pose` column its ids decide. Without one, rows with the same readings, to the resolution of
/// a controller (of a socket, where they are all that is read), are one pose, even if other poses were
/// measured between them. Rows of two sessions are never one pose.
pub fn assign(rows: &mut [Row]) -> usize {
    #[derive(PartialEq, Eq, Hash)]
    enum Key<'r> {
        Id(&'r str),
        Readings(bool, usize),
    }
    let mut seen = HashMap::new();
    let mut readings = [SAME, SAME_BY_HAND].map(Near::new);
    let mut groups = Vec::with_capacity(rows.len());
    for row in &*rows {
        let key = match &row.pose {
            Some(id) => Key::Id(id),
            None => {
                let by_hand = row.reads_joints_alone();
                Key::Readings(by_hand, readings[usize::from(by_hand)].kind(&row.q))
            }
        };
        let next = seen.len();
        groups.push(*seen.entry((row.session.as_deref(), key)).or_insert(next));
    }
    let poses = seen.len();
    rows.iter_mut().zip(groups).for_each(|(row, group)| row.group = group);
    poses
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::instrument::{Aim, Seen};
    use nalgebra::Vector6;

    fn row(q: &[f64], pose: Option<&str>) -> Row {
        let pose = pose.map(str::to_owned);
        Row { pose, ..Row::new(1, q.to_vec()) }
    }

    fn groups(mut rows: Vec<Row>) -> (usize, Vec<usize>) {
        let poses = assign(&mut rows);
        (poses, rows.iter().map(|r| r.group).collect())
    }

    #[test]
    fn equal_readings_are_one_pose() {
        let rows = vec![
            row(&[0.1, 0.2], None),
            row(&[0.1, 0.3], None),
            row(&[0.1 + 1e-13, 0.2], None),
            row(&[0.1 - 6e-6, 0.2 + 4e-5], None),
            row(&[0.1 + 1.7e-4, 0.2], None),
        ];
        assert_eq!(groups(rows), (3, vec![0, 1, 0, 0, 2]));
    }

    /// Whatever cells points fall into, the kinds are those of comparing all with all.
    #[test]
    fn kinds_are_those_of_comparing_all_with_all() {
        let (mut near, mut firsts) = (Near::new(1e-3), Vec::<[f64; 3]>::new());
        let any = |k: u32| (12.9898 * f64::from(k) + 1.0).sin();
        for k in 0..3000 {
            let point = [0, 1, 2].map(|c| 4e-3 * any(7 * k + c) + 0.1 * any(k % 5));
            let is_near = |f: &[f64; 3]| f.iter().zip(&point).all(|(a, b)| (a - b).abs() <= 1e-3);
            let kinds: Vec<usize> = (0..firsts.len()).filter(|n| is_near(&firsts[*n])).collect();
            let found = near.kind(&point);
            if kinds.is_empty() {
                assert_eq!(found, firsts.len());
                firsts.push(point);
            } else {
                assert!(kinds.contains(&found), "{found} {kinds:?}");
            }
        }
        assert!(firsts.len() > 20, "{}", firsts.len());
    }

    /// In a socket the joints of one posture differ by what the socket leaves free; a tracker's rows of
    /// the same readings are other poses.
    #[test]
    fn what_lies_in_a_socket_is_one_pose_within_its_play() {
        let read = |q: f64| row(&[q, 0.2], None);
        let lies =
            |q: f64, name: &str| Row { aim: Some(Box::new(Aim::at(Seen::Point, name))), ..read(q) };
        let rows = vec![lies(0.1, "a"), lies(0.102, "a"), lies(0.12, "a"), read(0.1), read(0.102)];
        assert_eq!(groups(rows), (4, vec![0, 0, 1, 2, 3]));
        let probed = Row { measured: Vector6::repeat(1e-3), ..lies(0.102, "a") };
        assert_eq!(groups(vec![lies(0.1, "a"), probed]), (2, vec![0, 1]));
    }

    #[test]
    fn the_pose_column_decides() {
        let rows =
            vec![row(&[0.1], Some("a")), row(&[0.1], Some("b")), row(&[0.1000001], Some("a"))];
        assert_eq!(groups(rows), (2, vec![0, 1, 0]));
    }

    #[test]
    fn a_pose_is_of_one_session() {
        let of =
            |session: &str, pose| Row { session: Some(session.to_owned()), ..row(&[0.1], pose) };
        let named = vec![of("a", Some("1")), of("a", Some("1")), of("b", Some("1"))];
        assert_eq!(groups(named), (2, vec![0, 0, 1]));
        assert_eq!(groups(vec![of("a", None), of("b", None), of("b", None)]), (2, vec![0, 1, 1]));
    }
}
