//! What a row of a file reads: of which thing of the bench, and what is known of that.

use nalgebra::Vector3;

use super::{Lens, MOST_CONSTANTS, Plane, View, distance, lens, middle};

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
    /// By how much the flange is tilted: an inclinometer.
    Level,
    /// Where a camera shows the point, or a place from where it sits on the tool.
    Camera,
}

/// The numbers of constants, of which views have some from the first on.
const NUMBERS: [usize; MOST_CONSTANTS] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11];

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
    /// All of them.
    pub const ALL: [Seen; 6] =
        [Seen::Point, Seen::Plane, Seen::Distance, Seen::Direction, Seen::Level, Seen::Camera];

    /// Which of the six components it reads: lengths are a position's, angles a rotation's.
    pub fn components(self) -> [bool; 6] {
        match self {
            Seen::Point => [true, true, true, false, false, false],
            Seen::Distance | Seen::Plane | Seen::Direction => {
                [true, false, false, false, false, false]
            }
            Seen::Level | Seen::Camera => [false, false, false, true, true, false],
        }
    }

    /// Whether it stands somewhere, so that nothing but itself says where the arm is: its first three constants, where it
    /// is unknown.
    pub fn has_place(self) -> bool {
        matches!(self, Seen::Point | Seen::Distance | Seen::Plane)
    }

    /// How many numbers it reads.
    pub fn numbers(self) -> usize {
        self.components().into_iter().filter(|is| *is).count()
    }

    /// What reports call the thing.
    pub fn thing(self) -> &'static str {
        match self {
            Seen::Point => "point",
            Seen::Distance => "centre",
            Seen::Plane => "plane",
            Seen::Direction => "direction",
            Seen::Level => "inclinometer",
            Seen::Camera => "camera",
        }
    }

    /// What reports call a constant.
    pub fn constant(self, number: usize) -> &'static str {
        let names: &[&'static str] = match self {
            Seen::Plane => &["first tilt", "second tilt", "offset"],
            Seen::Point | Seen::Distance => &["x", "y", "z", "length offset"],
            Seen::Direction => &["zero"],
            Seen::Level => &["zero of tilt_x", "zero of tilt_y"],
            Seen::Camera => &lens::NAMES,
        };
        names[number]
    }

    /// The unit of a constant.
    pub fn unit(self, number: usize) -> &'static str {
        match self {
            Seen::Level => "rad",
            Seen::Plane if number < 2 => "rad",
            Seen::Camera => {
                if number < lens::OF_MATRIX {
                    "px"
                } else {
                    "1"
                }
            }
            _ => "m",
        }
    }

    /// Nothing is known of it. A distance is measured from the place, nothing beyond.
    fn anywhere(self) -> (View, &'static [usize]) {
        let place = Vector3::zeros();
        let lens = Lens::new([1.0, 1.0, 0.0, 0.0], &[]);
        match self {
            Seen::Point => (View::Point(place), &[0, 1, 2]),
            Seen::Distance => (View::Distance { from: place, offset: 0.0 }, &[0, 1, 2]),
            Seen::Plane => (View::Plane(Plane::new(Vector3::z_axis(), 0.0)), &[0, 1, 2]),
            Seen::Direction => (View::Direction { along: Vector3::x(), offset: 0.0 }, &[0]),
            Seen::Level => (View::Level([0.0; 2]), &[0, 1]),
            Seen::Camera => (View::Camera { lens, target: None }, &[]),
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

    /// The constants from one to before another, as [`Aim::free`] has them.
    pub(super) fn some(from: usize, to: usize) -> &'static [usize] {
        &NUMBERS[from..to]
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
    pub fn unknowns(&self) -> impl Iterator<Item = String> + '_ {
        let name = self.full_name();
        self.free.iter().map(move |k| format!("{} of {name}", self.seen.constant(*k)))
    }

    /// The instrument alone, without what it is pointed at in a row.
    pub fn instrument(&self) -> Aim {
        let view = match self.view {
            View::Camera { lens, .. } => View::Camera { lens, target: None },
            View::Direction { offset, .. } => View::Direction { along: Vector3::x(), offset },
            view => view,
        };
        Aim { view, ..self.clone() }
    }

    /// The free constants moved.
    pub fn moved(&self, view: View, by: &[f64]) -> View {
        let mut all = [0.0; MOST_CONSTANTS];
        self.free.iter().zip(by).for_each(|(at, by)| all[*at] = *by);
        view.moved(&all[..view.constants()])
    }

    /// Constants that come close to what was read at these points, good enough for least squares to converge
    /// from: the free ones are guessed. There must be points.
    pub fn guess(&self, read: &[(Vector3<f64>, f64)]) -> View {
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
            (view, _) => view,
        }
    }
}
