//! What instruments read that are no trackers: balls in sockets, probes on plates, ball bars and wires,
//! dial gauges. Each reads one thing of the tool's point through a few constants of the bench.
//!
//! A [`View`] is such an instrument with its constants: the value, its derivative by the point, and its
//! derivative by the constants. A [`Bench`] is what a file says of these constants. All else (fitting the
//! constants along, intervals, what cannot be told apart) is the diagnosis', which knows some numbers for
//! each view and nothing of what they mean.
//!
//! Lengths are in metres, places and directions in the measuring frame.

mod aim;
mod bench;
mod distance;
mod pair;
mod plane;

use nalgebra::{Isometry3, Matrix3, Matrix3xX, Point3, Vector3};

pub use aim::{Aim, Seen};
pub use bench::Bench;
pub use pair::Pair;
pub use plane::Plane;

/// An instrument with its constants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum View {
    /// From the place to the point: three numbers. Constants: the place.
    Point(Vector3<f64>),
    /// How far the point is from a place, and what the instrument reads beyond that. Constants: the place, and
    /// the offset.
    Distance {
        /// The place.
        from: Vector3<f64>,
        /// Reading at no distance.
        offset: f64,
    },
    /// How far above the plane. Constants: two tilts, and the shift along the normal.
    Plane(Plane),
    /// Along the unit vector. No constants.
    Direction(Vector3<f64>),
}

impl View {
    /// What is read of a point; one number stands first, the others are 0.
    pub fn read(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let one = |value| Vector3::new(value, 0.0, 0.0);
        match self {
            View::Point(at) => point - at,
            View::Distance { from, offset } => one((point - from).norm() + offset),
            View::Plane(plane) => one(plane.height(point)),
            View::Direction(along) => one(along.dot(point)),
        }
    }

    /// By how much that changes with the point.
    pub fn by_point(&self, point: &Vector3<f64>) -> Matrix3<f64> {
        let row = match self {
            View::Point(_) => return Matrix3::identity(),
            View::Distance { from, .. } => distance::line(from, point),
            View::Plane(plane) => *plane.normal,
            View::Direction(along) => *along,
        };
        let mut matrix = Matrix3::zeros();
        matrix.set_row(0, &row.transpose());
        matrix
    }

    /// The shifts of the point that change what is read as much as each constant does, as columns.
    pub fn as_shifts(&self, point: &Vector3<f64>) -> Matrix3xX<f64> {
        let [x, y, z] = [0, 1, 2].map(|k| Vector3::ith(k, -1.0));
        match self {
            View::Point(_) => Matrix3xX::from_columns(&[x, y, z]),
            View::Distance { from, .. } => {
                Matrix3xX::from_columns(&[x, y, z, distance::line(from, point)])
            }
            View::Plane(plane) => Matrix3xX::from_columns(&plane.as_shifts(point)),
            View::Direction(_) => Matrix3xX::zeros(0),
        }
    }

    /// With its constants moved, as many as they are.
    #[must_use]
    pub fn moved(self, by: &[f64]) -> View {
        match (self, by) {
            (View::Point(at), [x, y, z]) => View::Point(at + Vector3::new(*x, *y, *z)),
            (View::Distance { from, offset }, [x, y, z, more]) => {
                View::Distance { from: from + Vector3::new(*x, *y, *z), offset: offset + more }
            }
            (View::Plane(plane), [u, v, shift]) => View::Plane(plane.moved([*u, *v], *shift)),
            _ => self,
        }
    }

    /// The same, told in a frame that stands at `base` in the measuring frame; `None` of a component along a
    /// direction where the frame's origin is another.
    pub(crate) fn seen_from(&self, base: &Isometry3<f64>) -> Option<View> {
        let back = base.inverse();
        let place = |at: &Vector3<f64>| (back * Point3::from(*at)).coords;
        Some(match self {
            View::Point(at) => View::Point(place(at)),
            View::Distance { from, offset } => {
                View::Distance { from: place(from), offset: *offset }
            }
            View::Plane(plane) => {
                View::Plane(Plane { normal: back.rotation * plane.normal, at: place(&plane.at) })
            }
            View::Direction(_) if base.translation.vector != Vector3::zeros() => return None,
            View::Direction(along) => View::Direction(back.rotation * along),
        })
    }

    /// The place of a point or a centre.
    pub fn place(&self) -> Option<Vector3<f64>> {
        match self {
            View::Point(at) | View::Distance { from: at, .. } => Some(*at),
            View::Plane(_) | View::Direction(_) => None,
        }
    }
}

/// The mean of some points.
fn middle(read: &[(Vector3<f64>, f64)]) -> Vector3<f64> {
    read.iter().map(|(p, _)| p).sum::<Vector3<f64>>() / read.len() as f64
}

#[cfg(test)]
mod tests;
