//! What a row says that an instrument reads which is no tracker, cell by cell.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::role::{Family, Role};
use super::{Kind, Row};
use crate::io::Fault;
use crate::observe::{Aim, Seen, View};

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
    pub(crate) along: Option<f64>,
    pub(crate) normal: [Option<f64>; 3],
    pub(crate) camera: Option<String>,
    pub(crate) board: Option<String>,
    /// A quaternion, w first.
    pub(crate) turn: [Option<f64>; 4],
}

impl Told {
    /// Whether cells of such a column go here.
    pub(crate) fn takes(role: Role) -> bool {
        let reading = Role::Measured(Family::Distance, 0);
        role.is_of_bench()
            || role == reading
            || matches!(role, Role::From | Role::FromAt(_) | Role::Normal(_))
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
            row.camera = Some(Box::new([name(self.camera), name(self.board)]));
        }
        if !matches!(kind, Some(Kind::Distance | Kind::Bench { .. })) {
            return Ok(());
        }
        let place = match self.from_at {
            [Some(x), Some(y), Some(z)] => Some(Vector3::new(x, y, z)),
            _ => None,
        };
        let is_from = self.from.is_some() || place.is_some();
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
                let view = View::Direction(normal.normalize());
                (Aim::known(Seen::Direction, "", view), along)
            }
            (None, None, None) => {
                let expected = "one of `point`, `plane`, `distance` and `along`";
                return Err(Fault::hole("no reading", expected, "fill it in, or remove the row"));
            }
            _ => {
                let expected = "one reading a row: `point`, or `plane` with or without `distance`, or `distance` \
                                with or without `from`, or `along`";
                return Err(Fault::new("more than one reading", expected, "empty the other cells"));
            }
        };
        row.measured[0] = reading.unwrap_or(0.0);
        row.aim = Some(Box::new(aim));
        Ok(())
    }
}
