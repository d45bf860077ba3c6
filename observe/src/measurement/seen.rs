//! Measurements told in another frame.

use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};

use super::{Kind, Measurements};

impl Measurements {
    /// What was measured, told in a frame that stands at `base` in the measuring frame; `None` where
    /// components that are not measured would be needed.
    pub fn seen_from(&self, base: &Isometry3<f64>) -> Option<Measurements> {
        if matches!(self.kind, Kind::Distance | Kind::Bench { .. }) {
            let mut seen = self.clone();
            for aim in seen.rows.iter_mut().filter_map(|row| row.aim.as_deref_mut()) {
                aim.view = aim.view.seen_from(base)?;
            }
            return Some(seen);
        }
        let measured = self.kind.components();
        let whole = |k: usize| measured[k..k + 3].iter().all(|is| *is == measured[k]);
        let turned = base.rotation != UnitQuaternion::identity();
        if turned && !(whole(0) && whole(3)) {
            return None;
        }
        let back = base.inverse();
        let mut seen = self.clone();
        for row in &mut seen.rows {
            let part =
                |k: usize| Vector3::new(row.measured[k], row.measured[k + 1], row.measured[k + 2]);
            let (position, rotation) = if self.kind.is_difference() {
                (back.rotation * part(0), back.rotation * part(3))
            } else {
                let turn = back.rotation * UnitQuaternion::from_scaled_axis(part(3));
                let rotation = if measured[3] { turn.scaled_axis() } else { part(3) };
                ((back * Point3::from(part(0))).coords, rotation)
            };
            row.measured.fixed_rows_mut::<3>(0).copy_from(&position);
            row.measured.fixed_rows_mut::<3>(3).copy_from(&rotation);
        }
        Some(seen)
    }
}
