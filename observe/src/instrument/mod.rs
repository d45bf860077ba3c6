//! What instruments read that are no trackers: balls in sockets, probes on plates, ball bars and wires,
//! dial gauges, inclinometers, cameras. Each reads one thing of the measured frame through a few constants of the
//! bench.
//!
//! A [`View`] is such an instrument with its constants: the value, its derivative by the frame, and its
//! derivative by the constants. A [`Bench`] is what a file says of these constants. All else (fitting the
//! constants along, intervals, what cannot be told apart) is the diagnosis', which knows some numbers for
//! each view and nothing of what they mean.
//!
//! Lengths are in metres, angles in radians, places and directions in the measuring frame.

mod aim;
mod bench;
mod distance;
mod lens;
mod level;
mod look;
mod pair;
mod pictures;
mod plane;
mod resection;

use nalgebra::{
    Isometry3, Matrix2x3, Matrix2xX, Matrix3, Matrix3x6, Matrix6xX, Point3, Vector2, Vector3,
};

pub use aim::{Aim, Seen};
pub use bench::Bench;
pub use lens::Lens;
pub use look::Look;
pub use pair::Pair;
pub use plane::Plane;
pub use resection::{nearest_rotation, pose};

/// Constants that a view has at most.
pub const MOST_CONSTANTS: usize = lens::CONSTANTS;

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
    /// Along the unit vector, and what the instrument reads beyond that. Constant: the offset.
    Direction {
        /// The unit vector.
        along: Vector3<f64>,
        /// Reading at the origin.
        offset: f64,
    },
    /// How far two axes of the flange rise above the horizontal, two angles. Constants: what the instrument reads
    /// beyond that.
    Level([f64; 2]),
    /// Where the camera shows the point, two numbers in parts of the focal length. Constants: those of the lens.
    Camera {
        /// The lens.
        lens: Lens,
        /// A place that the camera sees from where it sits in the measured frame. Without one it sees the measured
        /// point, and the measuring frame is its own.
        target: Option<Vector3<f64>>,
    },
}

impl View {
    /// What is read of a frame; one number or two stand first, the others are 0.
    pub fn read(&self, at: &Isometry3<f64>) -> Vector3<f64> {
        let point = &at.translation.vector;
        let one = |value| Vector3::new(value, 0.0, 0.0);
        let two = |value: Vector2<f64>| Vector3::new(value.x, value.y, 0.0);
        match self {
            View::Point(place) => point - place,
            View::Distance { from, offset } => one((point - from).norm() + offset),
            View::Plane(plane) => one(plane.height(point)),
            View::Direction { along, offset } => one(along.dot(point) + offset),
            View::Level(offsets) => two(level::tilts(at) + Vector2::from(*offsets)),
            View::Camera { lens, target } => two(lens.shows(&before_lens(at, target.as_ref()))),
        }
    }

    /// Whether angles are read, or what is nearly one.
    pub fn is_angle(&self) -> bool {
        matches!(self, View::Level(_) | View::Camera { .. })
    }

    /// By how much that changes with the frame: its shift, then its turn about its origin, measuring axes.
    pub fn by_frame(&self, at: &Isometry3<f64>) -> Matrix3x6<f64> {
        let mut all = Matrix3x6::zeros();
        let point = &at.translation.vector;
        let mut one =
            |row: Vector3<f64>| all.fixed_view_mut::<1, 3>(0, 0).copy_from(&row.transpose());
        match self {
            View::Point(_) => all.fixed_columns_mut::<3>(0).copy_from(&Matrix3::identity()),
            View::Distance { from, .. } => one(distance::line(from, point)),
            View::Plane(plane) => one(*plane.normal),
            View::Direction { along, .. } => one(*along),
            View::Level(_) => all.fixed_view_mut::<2, 3>(0, 3).copy_from(&level::by_turn(at)),
            View::Camera { lens, target } => {
                let (slope, _) = lens.slopes(&before_lens(at, target.as_ref()));
                let Some(target) = target else {
                    all.fixed_view_mut::<2, 3>(0, 0).copy_from(&slope);
                    return all;
                };
                let slope = slope * at.rotation.inverse().to_rotation_matrix().matrix();
                all.fixed_view_mut::<2, 3>(0, 0).copy_from(&-slope);
                let arm = (target - point).cross_matrix();
                all.fixed_view_mut::<2, 3>(0, 3).copy_from(&(slope * arm));
            }
        }
        all
    }

    /// The shifts and turns of the frame that change what is read as much as each constant does, as columns.
    pub fn as_twists(&self, at: &Isometry3<f64>) -> Matrix6xX<f64> {
        let point = &at.translation.vector;
        let [x, y, z] = [0, 1, 2].map(|k| Vector3::ith(k, -1.0));
        let shifts: &[Vector3<f64>] = match self {
            View::Point(_) => &[x, y, z],
            View::Distance { from, .. } => &[x, y, z, distance::line(from, point)],
            View::Plane(plane) => &plane.as_shifts(point),
            View::Direction { along, .. } => &[*along],
            View::Level(_) => {
                let by_turn = self.by_frame(at).fixed_view::<2, 3>(0, 3).into_owned();
                return least(&by_turn, &Matrix2xX::identity(2), 3);
            }
            View::Camera { lens, target } => {
                let by_shift = self.by_frame(at).fixed_view::<2, 3>(0, 0).into_owned();
                let (_, by_constants) = lens.slopes(&before_lens(at, target.as_ref()));
                return least(
                    &by_shift,
                    &Matrix2xX::from_columns(&by_constants.column_iter().collect::<Vec<_>>()),
                    0,
                );
            }
        };
        let mut twists = Matrix6xX::zeros(shifts.len());
        shifts
            .iter()
            .enumerate()
            .for_each(|(k, shift)| twists.fixed_view_mut::<3, 1>(0, k).copy_from(shift));
        twists
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
            (View::Direction { along, offset }, [more]) => {
                View::Direction { along, offset: offset + more }
            }
            (View::Level([x, y]), [by_x, by_y]) => View::Level([x + by_x, y + by_y]),
            (View::Camera { lens, target }, by) => View::Camera { lens: lens.moved(by), target },
            (view, _) => view,
        }
    }

    /// How far a constant of a lens is from what it was told to be near, told minus fitted over the standard
    /// deviation, and the derivative of the fitted over the same; `None` of a constant of which nothing is told.
    pub fn strayed(&self, told: &View, constant: usize) -> Option<(f64, f64)> {
        let (View::Camera { lens, .. }, View::Camera { lens: told, .. }) = (self, told) else {
            return None;
        };
        lens.strayed(told, constant)
    }

    /// In what its readings are told, and what one of it is in m or rad.
    pub fn unit(&self) -> (f64, &'static str) {
        match self {
            View::Camera { lens, .. } => (1.0 / lens.focus, "px"),
            View::Level(_) => (1.0, "rad"),
            _ => (1.0, "m"),
        }
    }

    /// A constant as it is told, and its own unit in that in which it is; of a plane it is another's to tell.
    pub fn constant(&self, number: usize) -> (f64, f64) {
        let told = match self {
            View::Point(at) => at[number],
            View::Distance { from, offset } => from.get(number).copied().unwrap_or(*offset),
            View::Plane(plane) => plane.offset(),
            View::Direction { offset, .. } => *offset,
            View::Level(offsets) => offsets[number],
            View::Camera { lens, .. } => return (lens.constant(number), lens.unit(number)),
        };
        (told, 1.0)
    }

    /// How many constants it has.
    pub fn constants(&self) -> usize {
        match self {
            View::Point(_) | View::Plane(_) => 3,
            View::Distance { .. } => 4,
            View::Direction { .. } => 1,
            View::Level(_) => 2,
            View::Camera { .. } => lens::CONSTANTS,
        }
    }

    /// The same instrument at what another reads: constants are an instrument's, and what it is pointed at is the
    /// row's.
    pub fn pointed(self, row: &View) -> View {
        match (self, row) {
            (View::Camera { lens, .. }, View::Camera { target, .. }) => {
                View::Camera { lens, target: *target }
            }
            (View::Direction { offset, .. }, View::Direction { along, .. }) => {
                View::Direction { along: *along, offset }
            }
            (view, _) => view,
        }
    }

    /// The same, told in a frame that stands at `base` in the measuring frame; `None` of what has a measuring frame
    /// of its own.
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
            View::Direction { along, offset } => View::Direction {
                along: back.rotation * along,
                offset: offset + along.dot(&base.translation.vector),
            },
            View::Camera { lens, target: Some(target) } => {
                View::Camera { lens: *lens, target: Some(place(target)) }
            }
            View::Level(_) | View::Camera { .. } if *base == Isometry3::identity() => *self,
            View::Level(_) | View::Camera { .. } => return None,
        })
    }

    /// The place of a point or a centre.
    pub fn place(&self) -> Option<Vector3<f64>> {
        match self {
            View::Point(at) | View::Distance { from: at, .. } => Some(*at),
            _ => None,
        }
    }
}

/// What stands before the lens, in the camera's axes.
fn before_lens(at: &Isometry3<f64>, target: Option<&Vector3<f64>>) -> Vector3<f64> {
    match target {
        None => at.translation.vector,
        Some(target) => at.rotation.inverse() * (target - at.translation.vector),
    }
}

/// The smallest shifts or turns that change two numbers as asked; they stand from row `first` on.
fn least(by: &Matrix2x3<f64>, asked: &Matrix2xX<f64>, first: usize) -> Matrix6xX<f64> {
    let mut all = Matrix6xX::zeros(asked.ncols());
    if let Some(inverse) = (by * by.transpose()).try_inverse() {
        all.fixed_rows_mut::<3>(first).copy_from(&(by.transpose() * inverse * asked));
    }
    all
}

/// The mean of some points.
fn middle(read: &[(Vector3<f64>, f64)]) -> Vector3<f64> {
    read.iter().map(|(p, _)| p).sum::<Vector3<f64>>() / read.len() as f64
}

#[cfg(test)]
mod tests;
