//! Freedoms of the geometry: numbers of the table of which the data see only sums. Parallel axes
//! share their `d`, the first offset is a turn of the base, the last lengths are the tool's.

use crate::constants::{ONE_WITH_OTHERS, SEEN};
use crate::diagnose::normal_equations::Candidate;
use crate::diagnose::options::Nuisance;
use crate::diagnose::report::Gauge;
use crate::diagnose::search::{First, Search};
use crate::effects::{Place, Spot};
use crate::infer::Dependent;

impl Search<'_, '_> {
    /// The geometry's numbers that are one with others before them, each with those. Between two
    /// readings of one pose all of them cancel, and none is told.
    pub(crate) fn gauges(&self, first: &First) -> Vec<Gauge> {
        if self.problem.data.kind.is_difference() {
            return Vec::new();
        }
        let names = self.names(&first.geometry);
        let normal = &first.gathered.total.zz;
        let seen = (0..normal.nrows()).filter(|k| normal[(*k, *k)] > 0.0);
        let told = Dependent::of(normal, seen, ONE_WITH_OTHERS).others.into_iter().map(
            |(number, parts)| {
                let with = parts.iter().filter(|(_, part)| part.abs() > SEEN);
                let same_as = with.map(|(k, _)| names[*k].clone()).collect();
                Gauge { parameter: names[number].clone(), same_as }
            },
        );
        told.collect()
    }

    fn names(&self, geometry: &[Candidate]) -> Vec<String> {
        let six = ["x", "y", "z", "rx", "ry", "rz"];
        let sessions = &self.problem.sessions;
        let of = |session: usize| match sessions.len() {
            1 => String::new(),
            _ => format!(" in session {}", sessions[session]),
        };
        let frame = |frame: (Nuisance, usize)| {
            let what = if frame.0 == Nuisance::BaseFrame { "in session" } else { "of" };
            let of = self.problem.frame_of(frame);
            let of = of.map_or_else(String::new, |of| format!(" {what} {of}"));
            six.map(|k| format!("{k} of {}{of}", frame.0.identifier()))
        };
        let frames = self.problem.frames().flat_map(frame);
        let three = |m: &String| ["x", "y", "z"].map(|k| format!("{k} of marker {m}"));
        let markers = self.problem.markers.iter().flat_map(three);
        let bench = self.problem.bench.iter().flat_map(|thing| {
            let of = of(thing.session);
            thing.aim.unknowns().map(move |name| name + &of)
        });
        let each = geometry.iter().filter_map(Candidate::effect).flat_map(|(effect, spot)| {
            let all = effect.parameters(self.problem.arm, spot);
            let named = move |name: &str| format!("{name} of {}", spot.place);
            all.into_iter().map(move |p| named(&p.name)).collect::<Vec<_>>()
        });
        let along = self.problem.along.into_iter().flat_map(|effect| {
            let all = effect.parameters(self.problem.arm, Spot { place: Place::Arm, form: 0 });
            all.into_iter().map(|p| p.name.into_owned()).collect::<Vec<_>>()
        });
        frames.chain(markers).chain(bench).chain(along).chain(each).collect()
    }
}
