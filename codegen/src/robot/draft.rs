//! A table as read: every cell with its place, so that the one validator can point at it.

use super::dimension::Dimension;
use super::frames::Asked;
use super::model::{Angle, Convention, Effect, Motion, Value};
use super::symbols::Symbolic;

/// What a cell holds, and where. A cell that could not be read has no value and has already been
/// reported: it must not cause a second error.
#[derive(Clone, Debug)]
pub(crate) struct Cell<T, L> {
    /// The content; `None` if its mistake has been reported.
    pub value: Option<T>,
    /// Where it stands.
    pub at: L,
}

/// How the entries of a tensor of inertia stand.
pub(crate) const INERTIA: &str = "[xx, xy, xz, yy, yz, zz]";

/// Three cells.
pub(crate) type Vector<T, L> = [Cell<T, L>; 3];

/// A whole table.
#[derive(Clone, Debug)]
pub(crate) struct Draft<L> {
    pub name: Option<Cell<String, L>>,
    pub convention: Option<Cell<Convention, L>>,
    pub gravity: Option<Vector<Value, L>>,
    pub torque_side: Option<Cell<&'static str, L>>,
    pub joints: Vec<DraftJoint<L>>,
    pub base: DraftFrame<L>,
    pub tool: DraftFrame<L>,
    pub frames: Vec<DraftNamedFrame<L>>,
    pub markers: Vec<DraftMarker<L>>,
    pub effects: Vec<Effect>,
    pub payloads: Vec<DraftPayload<L>>,
    pub carries: Option<Cell<String, L>>,
    pub outputs: Vec<Cell<Asked, L>>,
}

/// A fixed transform.
#[derive(Clone, Debug)]
pub(crate) struct DraftFrame<L> {
    pub translation: Option<Vector<Value, L>>,
    pub rotation: Option<Vector<Angle, L>>,
}

impl<L> Default for DraftFrame<L> {
    fn default() -> Self {
        DraftFrame { translation: None, rotation: None }
    }
}

/// A frame with a name.
#[derive(Clone, Debug)]
pub(crate) struct DraftNamedFrame<L> {
    pub name: Cell<String, L>,
    pub joint: Cell<JointName, L>,
    pub frame: DraftFrame<L>,
}

/// How a joint is told.
#[derive(Clone, Debug)]
pub(crate) enum JointName {
    /// Counted from 1 at the base.
    Number(usize),
    /// By the label of its row.
    Label(String),
}

/// A load with a name.
#[derive(Clone, Debug)]
pub(crate) struct DraftPayload<L> {
    pub name: Cell<String, L>,
    pub mass: Cell<Value, L>,
    pub com: Option<Vector<Value, L>>,
    /// The place of the whole tensor, and its entries.
    pub inertia: Option<(L, [Cell<Value, L>; 6])>,
}

/// One row.
#[derive(Clone, Debug)]
pub(crate) struct DraftJoint<L> {
    pub at: L,
    pub name: Option<Cell<String, L>>,
    pub motion: Cell<Motion, L>,
    pub theta: Option<Cell<Angle, L>>,
    pub d: Option<Cell<Value, L>>,
    pub a: Option<Cell<Value, L>>,
    pub alpha: Option<Cell<Angle, L>>,
    pub beta: Option<Cell<Angle, L>>,
    pub stiffness: Option<Cell<Value, L>>,
    pub mass: Option<Cell<Value, L>>,
    /// The place of the whole vector, and its entries.
    pub com: Option<(L, Vector<Value, L>)>,
    /// The place of the whole tensor, and its entries.
    pub inertia: Option<(L, [Cell<Value, L>; 6])>,
    pub drive: DraftDrive<L>,
    pub limits: Option<Cell<[f64; 2], L>>,
    pub source: Option<Cell<String, L>>,
    pub beam: Option<DraftBeam<L>>,
}

/// Motor, gear and friction.
#[derive(Clone, Debug)]
pub(crate) struct DraftDrive<L> {
    pub gear: Option<Cell<Value, L>>,
    pub rotor_inertia: Option<Cell<Value, L>>,
    pub coulomb: Option<Cell<Value, L>>,
    pub viscous: Option<Cell<Value, L>>,
}

/// A link as a beam.
#[derive(Clone, Debug)]
pub(crate) struct DraftBeam<L> {
    pub at: L,
    pub youngs_modulus: Cell<Value, L>,
    pub shear_modulus: Cell<Value, L>,
    /// Area, iy, iz, j.
    pub section: [Cell<Value, L>; 4],
    pub density: Option<Cell<Value, L>>,
    pub shear_coefficient: Option<Cell<Value, L>>,
}

/// A measured point.
#[derive(Clone, Debug)]
pub(crate) struct DraftMarker<L> {
    pub name: Cell<String, L>,
    pub translation: Option<Vector<Value, L>>,
}

impl<T, L> Cell<T, L> {
    /// A cell that was read.
    pub fn new(value: T, at: L) -> Self {
        Cell { value: Some(value), at }
    }

    /// A cell whose mistake has been reported.
    pub fn broken(at: L) -> Self {
        Cell { value: None, at }
    }
}

/// Three cells of one mistake that has been reported.
pub(crate) fn broken<T, L: Clone, const N: usize>(at: &L) -> [Cell<T, L>; N] {
    core::array::from_fn(|_| Cell::broken(at.clone()))
}

/// What is called for a parameter: its name, dimension and place.
pub(crate) type Visit<'v, 'a, L> = &'v mut dyn FnMut(&'a str, Dimension, &'a L);

/// Visits the parameter that a cell may hold.
fn visit_cell<'a, T: Symbolic + 'a, L: 'a>(
    visit: Visit<'_, 'a, L>,
    dimension: Dimension,
    cells: impl IntoIterator<Item = &'a Cell<T, L>>,
) {
    for cell in cells {
        if let Some(name) = cell.value.as_ref().and_then(Symbolic::symbol) {
            visit(name, dimension, &cell.at);
        }
    }
}

impl<L> DraftJoint<L> {
    fn each_symbol<'a>(&'a self, visit: Visit<'_, 'a, L>) {
        visit_cell(visit, Dimension::Angle, &self.theta);
        visit_cell(visit, Dimension::Length, &self.d);
        visit_cell(visit, Dimension::Length, &self.a);
        visit_cell(visit, Dimension::Angle, &self.alpha);
        visit_cell(visit, Dimension::Angle, &self.beta);
        let stiffness = Dimension::stiffness(self.motion.value.unwrap_or(Motion::Revolute));
        visit_cell(visit, stiffness, &self.stiffness);
        visit_cell(visit, Dimension::Mass, &self.mass);
        visit_cell(visit, Dimension::Length, self.com.iter().flat_map(|(_, com)| com));
        visit_cell(visit, Dimension::Inertia, self.inertia.iter().flat_map(|(_, i)| i));
        let motion = self.motion.value.unwrap_or(Motion::Revolute);
        visit_cell(visit, Dimension::gear(motion), &self.drive.gear);
        visit_cell(visit, Dimension::Inertia, &self.drive.rotor_inertia);
        visit_cell(visit, Dimension::load(motion), &self.drive.coulomb);
        visit_cell(visit, Dimension::damping(motion), &self.drive.viscous);
        if let Some(beam) = &self.beam {
            visit_cell(visit, Dimension::Pressure, [&beam.youngs_modulus, &beam.shear_modulus]);
            let [area, moments @ ..] = &beam.section;
            visit_cell(visit, Dimension::Area, [area]);
            visit_cell(visit, Dimension::SecondMoment, moments);
            visit_cell(visit, Dimension::Density, &beam.density);
            visit_cell(visit, Dimension::Ratio, &beam.shear_coefficient);
        }
    }
}

impl<L> Draft<L> {
    /// Every use of a parameter, in the order of [`super::Robot::symbols`].
    pub fn each_symbol<'a>(&'a self, visit: Visit<'_, 'a, L>) {
        visit_cell(visit, Dimension::Acceleration, self.gravity.iter().flatten());
        for joint in &self.joints {
            joint.each_symbol(visit);
        }
        visit_cell(visit, Dimension::Length, self.tool.translation.iter().flatten());
    }
}
