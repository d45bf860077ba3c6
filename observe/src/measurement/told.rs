//! What a row says that an instrument reads which is no tracker, cell by cell.

use nalgebra::{Quaternion, UnitQuaternion, Vector3, Vector6};

use super::role::{Family, Role};
use super::{Kind, Row, Sight};
use crate::instrument::{Aim, Seen, View};
use crate::io::{Dimension, Fault};

/// What a row of a bench has.
const ONE: &str = "one reading a row: `point`, or `plane` with or without `distance`, or `distance` with or without \
                   `from`, or `along`, or `tilt_x tilt_y`, or `u v`";

/// A direction whose length is not 1 to this is none: written with three digits it is.
const UNIT: f64 = 1e-3;

/// The cells of a row, as far as they are there.
#[derive(Default)]
pub(crate) struct Told {
    pub(crate) point: Option<String>,
    pub(crate) plane: Option<String>,
    pub(crate) from: Option<String>,
    /// m.
    pub(crate) from_at: [Option<f64>; 3],
    /// m.
    pub(crate) distance: Option<f64>,
    /// m.
    pub along: Option<f64>,
    pub(crate) normal: [Option<f64>; 3],
    pub(crate) zero: Option<String>,
    /// rad.
    pub(crate) tilt: [Option<f64>; 2],
    /// px.
    pub(crate) pixel: [Option<f64>; 2],
    pub(crate) camera: Option<String>,
    pub(crate) board: Option<String>,
    /// A quaternion, w first.
    pub(crate) turn: [Option<f64>; 4],
    /// Of what quantity the header says that the standard deviation is.
    pub(crate) sigma_is: Option<Dimension>,
}

impl Told {
    /// Whether cells of such a column go here.
    pub(crate) fn takes(role: Role) -> bool {
        let reading = Role::Measured(Family::Distance, 0);
        role.is_of_bench()
            || role == reading
            || matches!(role, Role::From | Role::FromAt(_) | Role::Normal(_) | Role::Zero)
    }

    /// A distance that is below 0 and not that from a plane.
    pub(crate) fn negative(&self) -> Option<f64> {
        self.distance.filter(|distance| *distance < 0.0 && self.plane.is_none())
    }

    /// Puts what is read into the row. Of a file that is planned it may be missing.
    pub(crate) fn into_row(
        self,
        kind: Option<Kind>,
        planned: bool,
        row: &mut Row,
    ) -> Result<(), Fault> {
        if let [Some(w), Some(x), Some(y), Some(z)] = self.turn {
            let turn = Quaternion::new(w, x, y, z);
            if (turn.norm() - 1.0).abs() > UNIT {
                let found = format!("a quaternion of length {}", turn.norm());
                return Err(Fault::new(found, "a unit quaternion", "mend cqw, cqx, cqy and cqz"));
            }
            let vector = UnitQuaternion::from_quaternion(turn).scaled_axis();
            row.measured.fixed_rows_mut::<3>(3).copy_from(&vector);
        }
        if self.camera.is_some() || self.board.is_some() {
            let name = |name: Option<String>| name.unwrap_or_default();
            let (camera, board) = (name(self.camera), name(self.board));
            row.camera = Some(Box::new(Sight { camera, board, ..Sight::default() }));
        }
        if !matches!(kind, Some(Kind::Distance | Kind::Bench { .. })) {
            return Ok(());
        }
        let place = match self.from_at {
            [Some(x), Some(y), Some(z)] => Some(Vector3::new(x, y, z)),
            _ => None,
        };
        let is_from = self.from.is_some() || place.is_some();
        let is_other = self.point.is_some()
            || self.plane.is_some()
            || self.along.is_some()
            || self.distance.is_some();
        let is_open =
            planned && !is_other && matches!(kind, Some(Kind::Bench { angles: true, .. }));
        let angles = match (self.tilt, self.pixel) {
            ([None, None], [None, None]) if is_open && row.marker.is_some() => {
                Some((Seen::Camera, [0.0; 2]))
            }
            ([None, None], [None, None]) if is_open => Some((Seen::Level, [0.0; 2])),
            ([None, None], [None, None]) => None,
            ([Some(x), Some(y)], [None, None]) => Some((Seen::Level, [x, y])),
            ([None, None], [Some(u), Some(v)]) => Some((Seen::Camera, [u, v])),
            _ => return Err(Fault::new("more than one reading", ONE, "empty the other cells")),
        };
        if let Some((seen, [first, second])) = angles {
            if is_other {
                return Err(Fault::new("more than one reading", ONE, "empty the other cells"));
            }
            let name = row.camera.as_ref().filter(|_| seen == Seen::Camera);
            let name = name.map_or_else(String::new, |sight| sight.camera.clone());
            row.aim = Some(Box::new(Aim::at(seen, name)));
            row.measured[3] = first;
            row.measured[4] = second;
            let is = if seen == Seen::Camera { Dimension::Pixels } else { Dimension::Angle };
            if let Some(wrong) = self.sigma_is.filter(|told| *told != is) {
                let found = format!("a standard deviation that is {wrong}");
                return Err(Fault::new(found, is.to_string(), "mend the unit of `sigma`"));
            }
            if let Some(sigma) = &mut row.sigma {
                let own = sigma[0];
                **sigma = Vector6::new(0.0, 0.0, 0.0, own, own, 0.0);
            }
            return Ok(());
        }
        if let Some(wrong) = self.sigma_is.filter(|told| *told != Dimension::Length) {
            let found = format!("a standard deviation that is {wrong}");
            return Err(Fault::new(found, "a length", "mend the unit of `sigma`"));
        }
        let (aim, reading) = match (self.point, self.plane, self.along) {
            (Some(point), None, None) if self.distance.is_none() && !is_from => {
                (Aim::at(Seen::Point, point), None)
            }
            (None, Some(plane), None) if !is_from => {
                (Aim::at(Seen::Plane, plane), Some(self.distance.unwrap_or(0.0)))
            }
            (None, None, None) if self.distance.is_some() || planned => {
                let name = self.from.unwrap_or_default();
                let known = |from| View::Distance { from, offset: 0.0 };
                let aim = match place {
                    Some(at) => Aim::known(Seen::Distance, name, known(at)),
                    None => Aim::at(Seen::Distance, name),
                };
                (aim, self.distance)
            }
            (None, None, along) if along.is_some() && self.distance.is_none() && !is_from => {
                let [Some(x), Some(y), Some(z)] = self.normal else {
                    return Err(Fault::hole("no direction", "nx, ny and nz", "fill them in"));
                };
                let normal = Vector3::new(x, y, z);
                if (normal.norm() - 1.0).abs() > UNIT {
                    let found = format!("a direction of length {}", normal.norm());
                    return Err(Fault::new(found, "a unit vector", "mend nx, ny and nz"));
                }
                let view = View::Direction { along: normal.normalize(), offset: 0.0 };
                let aim = match self.zero {
                    Some(zero) => Aim { view, ..Aim::at(Seen::Direction, zero) },
                    None => Aim::known(Seen::Direction, "", view),
                };
                (aim, along)
            }
            (None, None, None) => {
                let expected =
                    "one of `point`, `plane`, `distance`, `along`, `tilt_x tilt_y` and `u v`";
                return Err(Fault::hole("no reading", expected, "fill it in, or remove the row"));
            }
            _ => return Err(Fault::new("more than one reading", ONE, "empty the other cells")),
        };
        row.measured[0] = reading.unwrap_or(0.0);
        row.aim = Some(Box::new(aim));
        Ok(())
    }
}
