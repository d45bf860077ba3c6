//! What a row of a file reads: of which thing of the bench, and what is known of that.

use nalgebra::Vector3;

use super::{Plane, View, distance, middle};

/// A kind of thing that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Seen {
    /// The point is in one place: a ball in a socket, a probe in a cone, a tip on a tip.
    Point,
    /// The point's distance from a place: a ball bar, a draw wire.
    Distance,
    /// The point's height above a plane; 0 if it lies on it: a probe, a feeler.
    Plane,
    /// The point's component along a direction: a dial gauge, an LVDT.
    Direction,
}

/// What one row reads.
#[derive(Clone, Debug, PartialEq)]
pub struct Aim {
    /// The kind of thing.
    pub seen: Seen,
    /// What it is called; of one kind, name and session there is one. May be empty.
    pub name: String,
    /// Its constants; those of [`Aim::free`] mean nothing.
    pub view: View,
    /// Which of the constants are unknown, and fitted.
    pub free: &'static [usize],
}

impl Seen {
    /// How many numbers it reads; they stand first among the components of a position.
    pub fn components(self) -> usize {
        if self == Seen::Point { 3 } else { 1 }
    }

    /// What reports call the thing.
    pub fn thing(self) -> &'static str {
        match self {
            Seen::Point => "point",
            Seen::Distance => "centre",
            Seen::Plane => "plane",
            Seen::Direction => "direction",
        }
    }

    /// What reports call a constant.
    pub fn constant(self, number: usize) -> &'static str {
        let names = match self {
            Seen::Plane => ["first tilt", "second tilt", "offset", ""],
            Seen::Point | Seen::Distance | Seen::Direction => ["x", "y", "z", "length offset"],
        };
        names[number]
    }

    /// The unit of a constant.
    pub fn unit(self, number: usize) -> &'static str {
        if self == Seen::Plane && number < 2 { "rad" } else { "m" }
    }

    /// Nothing is known of it. A distance is measured from the place, nothing beyond.
    fn anywhere(self) -> (View, &'static [usize]) {
        let place = Vector3::zeros();
        match self {
            Seen::Point => (View::Point(place), &[0, 1, 2]),
            Seen::Distance => (View::Distance { from: place, offset: 0.0 }, &[0, 1, 2]),
            Seen::Plane => (View::Plane(Plane::new(Vector3::z_axis(), 0.0)), &[0, 1, 2]),
            Seen::Direction => (View::Direction(Vector3::x()), &[]),
        }
    }
}

impl Aim {
    /// At something of which nothing is known.
    pub fn at(seen: Seen, name: impl Into<String>) -> Aim {
        let (view, free) = seen.anywhere();
        Aim { seen, name: name.into(), view, free }
    }

    /// At something that is known.
    pub fn known(seen: Seen, name: impl Into<String>, view: View) -> Aim {
        Aim { seen, name: name.into(), view, free: &[] }
    }

    /// Says what is known of it.
    pub(super) fn set(&mut self, view: View, free: &'static [usize]) {
        (self.view, self.free) = (view, free);
    }

    /// The name with the kind of thing, as reports have it.
    pub fn full_name(&self) -> String {
        format!("{} {}", self.seen.thing(), self.name).trim_end().to_owned()
    }

    /// What reports call its free constants: `x of point front:0`.
    pub(crate) fn unknowns(&self) -> impl Iterator<Item = String> + '_ {
        let name = self.full_name();
        self.free.iter().map(move |k| format!("{} of {name}", self.seen.constant(*k)))
    }

    /// The free constants moved.
    pub(crate) fn moved(&self, view: View, by: &[f64]) -> View {
        let mut all = [0.0; 4];
        self.free.iter().zip(by).for_each(|(at, by)| all[*at] = *by);
        let count = view.as_shifts(&Vector3::zeros()).ncols();
        view.moved(&all[..count])
    }

    /// Constants that come close to what was read at these points, good enough for least squares to converge
    /// from: the free ones are guessed. There must be points.
    pub(crate) fn guess(&self, read: &[(Vector3<f64>, f64)]) -> View {
        let mean = |of: &dyn Fn(&Vector3<f64>) -> f64| {
            read.iter().map(|(p, value)| value - of(p)).sum::<f64>() / read.len() as f64
        };
        match (self.view, self.free) {
            (view, []) => view,
            (View::Point(_), _) => View::Point(middle(read)),
            (View::Distance { from, .. }, [3]) => {
                View::Distance { from, offset: mean(&|p| (p - from).norm()) }
            }
            (View::Distance { offset, .. }, _) => {
                let far: Vec<_> = read.iter().map(|(p, value)| (*p, value - offset)).collect();
                View::Distance { from: distance::equidistant(&far), offset }
            }
            (View::Plane(plane), [2]) => {
                View::Plane(Plane::new(plane.normal, -mean(&|p| plane.normal.dot(p))))
            }
            (View::Plane(_), _) => View::Plane(Plane::through(read)),
            (view @ View::Direction(_), _) => view,
        }
    }
}
