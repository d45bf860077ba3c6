//! What an instrument reads of the arm at rest.

use nalgebra::{Isometry3, Matrix6xX, UnitQuaternion, Vector3, Vector6};
use stiffarm_kernels::Unstable;

use super::actual::Actual;
use super::rest::{beyond_first_order, follow_loads, rest};
use super::state::State;
use super::{rotation, translation};
use crate::instrument::View;
use crate::measurement::Kind;

/// Two angles that no instrument reads and no rotation vector exceeds, rad: what a camera would show of things far
/// beside its picture is cut to it.
const LARGEST_ANGLE: f64 = 3.0;

/// What an instrument reads: of a pose its position and orientation, of a displacement the
/// difference and the rotation from the unloaded to the loaded tool; axes of the measuring frame. A
/// distance is the first number of a position, two angles are the first of a rotation vector, the others 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// m.
    pub position: Vector3<f64>,
    /// As a rotation.
    pub rotation: UnitQuaternion<f64>,
}

impl Reading {
    /// What an instrument that is no tracker reads of a frame.
    fn of_view(view: &View, seen: &Isometry3<f64>) -> Reading {
        let read = view.read(seen);
        if !view.is_angle() {
            return Reading { position: read, rotation: UnitQuaternion::identity() };
        }
        let cut = (LARGEST_ANGLE / read.norm()).min(1.0);
        Reading {
            position: Vector3::zeros(),
            rotation: UnitQuaternion::from_scaled_axis(read * cut),
        }
    }

    /// From position (or displacement) and rotation vector, m and rad.
    pub fn from_vector(vector: &Vector6<f64>) -> Reading {
        Reading {
            position: translation(vector),
            rotation: UnitQuaternion::from_scaled_axis(rotation(vector)),
        }
    }

    /// Position and rotation vector, m and rad.
    pub fn vector(&self) -> Vector6<f64> {
        let (p, r) = (self.position, self.rotation.scaled_axis());
        Vector6::new(p.x, p.y, p.z, r.x, r.y, r.z)
    }
}

/// The simulated states behind one row.
#[derive(Clone, Debug, PartialEq)]
pub struct Sim {
    /// Under the wrench and the weights.
    pub loaded: State,
    /// Under the weights alone, if the row measures a displacement.
    pub unloaded: Option<State>,
    /// The measured frame in the tool frame, m: a reflector, a marker, or the tool frame itself.
    pub measured: Isometry3<f64>,
    /// Where the arm's base stands in the measuring frame.
    pub base: Isometry3<f64>,
    /// What the instrument makes of a metre.
    pub metre: f64,
    /// What an instrument reads that is no tracker; `None` of a tracker.
    pub view: Option<View>,
}

impl Sim {
    /// The same arm, read by another instrument than a tracker.
    pub fn seen_by(self, view: Option<View>) -> Sim {
        Sim { view, ..self }
    }

    /// The measured frame under load, measuring frame, m as the instrument has them.
    pub fn seen_frame(&self) -> Isometry3<f64> {
        let mut seen = self.base * self.loaded.tool * self.measured;
        seen.translation.vector *= self.metre;
        seen
    }

    /// Brings the arm to rest as `actual` has it with the row's wrench (`true`) and, for a
    /// displacement, without. `near` is a simulation of the same row to begin from.
    ///
    /// # Errors
    /// [`Unstable`] if there is no stable equilibrium.
    pub fn of<'a>(
        kind: Kind,
        measured: Isometry3<f64>,
        near: Option<&Sim>,
        actual: impl Fn(bool) -> Actual<'a>,
    ) -> Result<Sim, Unstable> {
        let from = |state: &State| state.displacements.clone();
        let at_rest = |actual: &Actual<'_>, near: Option<&State>| {
            let mut state = rest(actual, near.map(from).as_deref())?;
            if actual.loaded_geometry != 0.0 {
                let more = beyond_first_order(actual, &state) * actual.loaded_geometry;
                state.tool.translation.vector += translation(&more);
                let turn = UnitQuaternion::from_scaled_axis(rotation(&more));
                state.tool.rotation = turn * state.tool.rotation;
            }
            if kind.is_difference() {
                follow_loads(actual, &mut state);
            }
            Ok(state)
        };
        let with_load = actual(true);
        let (base, metre) = (with_load.base, with_load.metre);
        let loaded = at_rest(&with_load, near.map(|n| &n.loaded))?;
        let unloaded = match kind {
            Kind::Displacement { .. } => {
                Some(at_rest(&actual(false), near.and_then(|n| n.unloaded.as_ref()))?)
            }
            _ => None,
        };
        Ok(Sim { loaded, unloaded, measured, base, metre, view: None })
    }

    /// The measured point of a state in the arm's base frame, m.
    pub fn point(&self, state: &State) -> Vector3<f64> {
        (state.tool * self.measured).translation.vector
    }

    /// What the instrument would read.
    pub fn reading(&self) -> Reading {
        if let Some(view) = &self.view {
            return Reading::of_view(view, &self.seen_frame());
        }
        let loaded = self.point(&self.loaded);
        let rotation = self.loaded.tool.rotation * self.measured.rotation;
        match &self.unloaded {
            None => {
                let position = self.seen_frame().translation.vector;
                Reading { position, rotation: self.base.rotation * rotation }
            }
            Some(unloaded) => {
                let turned = self.loaded.tool.rotation * unloaded.tool.rotation.inverse();
                Reading {
                    position: self.base.rotation * (loaded - self.point(unloaded)) * self.metre,
                    rotation: self.base.rotation * turned * self.base.rotation.inverse(),
                }
            }
        }
    }

    /// Change of the reading, 6×p, by changes of the tool that `twists` gives for a state, 6×p, base
    /// axes, at the tool origin: carried to the measured point, and of a displacement loaded minus
    /// unloaded.
    pub fn change(&self, mut twists: impl FnMut(&State, bool) -> Matrix6xX<f64>) -> Matrix6xX<f64> {
        let mut change = self.at_point(&self.loaded, twists(&self.loaded, true));
        if let Some(unloaded) = &self.unloaded {
            let mut before = self.at_point(unloaded, twists(unloaded, false));
            // d(R_l R_uᵀ) turns by ω_l − R_l R_uᵀ ω_u.
            let turned = self.loaded.tool.rotation * unloaded.tool.rotation.inverse();
            for mut column in before.column_iter_mut() {
                let turn = turned * column.fixed_rows::<3>(3);
                column.fixed_rows_mut::<3>(3).copy_from(&turn);
            }
            change -= before;
        }
        for mut column in change.column_iter_mut() {
            let shift = self.base.rotation * column.fixed_rows::<3>(0) * self.metre;
            let turn = self.base.rotation * column.fixed_rows::<3>(3);
            column.fixed_rows_mut::<3>(0).copy_from(&shift);
            column.fixed_rows_mut::<3>(3).copy_from(&turn);
        }
        if let Some(view) = &self.view {
            let by_frame = view.by_frame(&self.seen_frame());
            let first = if view.is_angle() { 3 } else { 0 };
            for mut column in change.column_iter_mut() {
                let read = by_frame * &column;
                column.fill(0.0);
                column.fixed_rows_mut::<3>(first).copy_from(&read);
            }
        }
        change
    }

    fn at_point(&self, state: &State, mut twists: Matrix6xX<f64>) -> Matrix6xX<f64> {
        let lever = state.tool.rotation * self.measured.translation.vector;
        if lever != Vector3::zeros() {
            for mut column in twists.column_iter_mut() {
                let turn = Vector3::new(column[3], column[4], column[5]);
                let mut shift = column.fixed_rows_mut::<3>(0);
                shift += turn.cross(&lever);
            }
        }
        twists
    }
}
