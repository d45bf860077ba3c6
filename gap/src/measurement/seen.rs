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

#[cfg(test)]
mod tests {
    use nalgebra::Vector6;

    use super::*;
    use crate::fixture::{row, springy, table};
    use crate::simulate::simulate;

    /// An arm that stands somewhere, seen from its base, is the arm that stands nowhere.
    #[test]
    fn an_arm_is_seen_from_its_base() {
        let arm = springy();
        let mut there = arm.clone();
        there.base = Isometry3::new(Vector3::new(1.0, -2.0, 0.5), Vector3::new(0.3, -0.2, 1.4));
        for kind in [
            Kind::Pose { orientation: true },
            Kind::Pose { orientation: false },
            Kind::Displacement { components: [true; 6] },
            Kind::Displacement { components: [true, true, true, false, false, false] },
        ] {
            let load = Vector6::new(50.0, -20.0, -90.0, 4.0, 5.0, -6.0);
            let mask = Vector6::from_iterator(kind.components().map(f64::from));
            let measured = |arm| {
                let mut row = row(&[0.3, -0.8, 0.6], load);
                row.measured = simulate(arm, &row, kind).unwrap().reading().vector();
                row.measured.component_mul_assign(&mask);
                table(vec![row], kind)
            };
            let seen = measured(&there).seen_from(&there.base).unwrap();
            let off = seen.rows[0].measured - measured(&arm).rows[0].measured;
            assert!(off.amax() < 1e-14, "{kind:?} {off}");
        }
        let one = Kind::Displacement { components: [false, true, false, false, false, false] };
        let data = table(vec![row(&[0.0; 3], Vector6::zeros())], one);
        assert!(data.seen_from(&there.base).is_none());
        assert!(data.seen_from(&Isometry3::translation(1.0, 0.0, 0.0)).is_some());
    }
}
