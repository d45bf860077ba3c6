//! Several measurement files of one arm as one.

use nalgebra::Vector3;

use super::{Kind, Measurements, Row};
use crate::instrument::{Aim, Seen, View};
use crate::io::{Fault, ReadError};

impl Measurements {
    /// The rows of both, each file a sitting of its own: sessions are called by the file, and what a file has
    /// beside them. Positions, distances and readings of a bench may stand together; orientations and
    /// displacements with their like alone. Columns without a meaning stay where both have them.
    ///
    /// # Errors
    /// [`ReadError`]: kinds that cannot stand together.
    pub fn and(self, other: Measurements) -> Result<Measurements, ReadError> {
        let first = self.sitting(false);
        if first.file.split(AND).any(|file| file == other.file) {
            let fault = Fault::new("the same file twice", "another", "name it once");
            return Err(fault.of(&other.file));
        }
        let has = |other: &Measurements| {
            let known = |row: &Row| first.rows.iter().any(|own| own.session == row.session);
            other.sessions().any(|rows| known(&rows[0]))
        };
        let mut second = other.clone().sitting(false);
        if has(&second) {
            second = other.sitting(true);
        }
        let (first, second) = match first.kind == second.kind {
            true => (first, second),
            false => (first.on_bench(&second.file)?, second.on_bench("the other files")?),
        };
        // A camera's poses are told in its own axes; each reading of a bench says itself whether a camera shows it.
        let is_bench = matches!(first.kind, Kind::Bench { .. });
        let differ = !is_bench && first.by_camera != second.by_camera;
        if first.sim_given != second.sim_given || differ {
            let expected = "the same columns `sim_…`, and a camera's poses with their like";
            return Err(Fault::new("files that differ in them", expected, "").of(&second.file));
        }
        let kind = match (first.kind, second.kind) {
            (Kind::Bench { lengths: a, angles: b }, Kind::Bench { lengths: c, angles: d }) => {
                Kind::Bench { lengths: a.max(c), angles: b || d }
            }
            (kind, _) => kind,
        };
        let mut rows = first.rows;
        let more = second.rows.into_iter();
        rows.extend(more.map(|row| Row { group: row.group + first.poses, ..row }));
        let mut extra = first.extra;
        extra.retain_mut(|one| {
            let same = second
                .extra
                .iter()
                .find(|other| (&other.name, &other.unit) == (&one.name, &one.unit));
            if let (Ok(values), Some(Ok(more))) = (&mut one.values, same.map(|same| &same.values)) {
                values.extend(more);
            }
            same.is_some_and(|same| same.values.is_ok())
        });
        let mut pairs = first.pairs;
        pairs.extend(
            second.pairs.into_iter().filter(|pair| !pairs.contains(pair)).collect::<Vec<_>>(),
        );
        let either = |a: [Option<_>; 6], b: [Option<_>; 6]| core::array::from_fn(|k| a[k].or(b[k]));
        Ok(Measurements {
            file: [first.file, second.file].join(AND),
            rows,
            kind,
            sim_given: first.sim_given,
            by_camera: first.by_camera || second.by_camera,
            by_board: first.by_board || second.by_board,
            poses: first.poses + second.poses,
            pairs,
            extra,
            unused: [first.unused, second.unused].concat(),
            skipped: [first.skipped, second.skipped].concat(),
            measured_in: either(first.measured_in, second.measured_in),
            wrench_in: either(first.wrench_in, second.wrench_in),
        })
    }

    /// Its sessions called by the file, or by its whole path; one that is already of several files stays as it is.
    fn sitting(mut self, whole: bool) -> Measurements {
        let last = self.file.rsplit(['/', '\\']).next().filter(|_| !whole);
        let name = last.unwrap_or(&self.file).to_owned();
        if self.rows.iter().all(|row| row.session.as_ref().is_some_and(|s| s.contains(SEPARATOR))) {
            return self;
        }
        for row in &mut self.rows {
            let own = row.session.take().unwrap_or_default();
            row.session = Some(format!("{name}{SEPARATOR}{own}"));
        }
        self
    }

    /// Positions as what an instrument at the origin reads, beside instruments that are no trackers.
    fn on_bench(mut self, other: &str) -> Result<Measurements, ReadError> {
        let lengths = match self.kind {
            Kind::Pose { orientation: false } if !self.sim_given.contains(&true) => 3,
            Kind::Distance if !self.sim_given.contains(&true) => 1,
            Kind::Bench { .. } => return Ok(self),
            _ => {
                let found = format!("{} beside {other}", self.kind.measured().join(" "));
                let expected = "files of one kind, or positions, distances and readings of a bench";
                let help = "diagnose the files one by one";
                return Err(Fault::new(found, expected, help).of(&self.file));
            }
        };
        for row in self.rows.iter_mut().filter(|row| row.aim.is_none()) {
            let origin = View::Point(Vector3::zeros());
            row.aim = Some(Box::new(Aim::known(Seen::Point, "", origin)));
        }
        Ok(Measurements { kind: Kind::Bench { lengths, angles: false }, ..self })
    }
}

/// Between the names of files.
const AND: &str = " and ";

/// Between a file and its own session.
const SEPARATOR: char = ':';

#[cfg(test)]
mod tests {
    use super::*;

    fn file(name: &str, kind: Kind, count: usize) -> Measurements {
        let one = |k: usize| Row { group: k, ..Row::new(2, vec![k as f64]) };
        Measurements::new(name, kind, (0..count).map(one).collect())
    }

    #[test]
    fn files_are_sittings_of_one_campaign() {
        let position = Kind::Pose { orientation: false };
        let [a, b] = ["run/a.csv", "b.csv"].map(|name| file(name, position, 3));
        let c = file("c.csv", Kind::Bench { lengths: 1, angles: false }, 2);
        let both = a.and(b).expect("alike").and(c).expect("a bench");
        assert_eq!(
            (both.kind, both.rows.len(), both.poses),
            (Kind::Bench { lengths: 3, angles: false }, 8, 8)
        );
        let sessions: Vec<_> = both.sessions().map(|rows| rows[0].session.as_deref()).collect();
        assert_eq!(sessions, [Some("a.csv:"), Some("b.csv:"), Some("c.csv:")]);
        assert_eq!((both.rows[7].group, both.rows[0].components(both.kind)[2]), (7, true));
        let again = file("other/a.csv", position, 1);
        let more = both.clone().and(again).expect("another");
        assert_eq!(more.rows[8].session.as_deref(), Some("other/a.csv:"));
        let error = both.clone().and(file("b.csv", position, 1)).unwrap_err().to_string();
        assert!(error.contains("found the same file twice"), "{error}");
        let poses = file("d.csv", Kind::Pose { orientation: true }, 1);
        let error = both.and(poses).unwrap_err().to_string();
        assert!(error.contains("found x y z rx ry rz beside the other files"), "{error}");
    }
}
