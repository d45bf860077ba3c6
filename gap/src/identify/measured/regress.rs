//! What a row measured, what the arm would have shown, and how that changes with each unknown.

use std::collections::HashMap;

use nalgebra::{Matrix6xX, Point3, UnitQuaternion, Vector3, Vector6};
use stiffarm_kernels::generic::Arm;

use super::{MeasuredError, Question, Unknown};
use crate::measurement::{Kind, Measurements, Row};
use crate::simulate::{State, equilibrium, rotation, translation};

/// The least flexibility that is simulated, as a multiple of the robot file's.
pub(super) const STIFFEST: f64 = 1e-6;

/// The rows, and what is looked for in them.
pub(super) struct Sheet<'a> {
    pub(super) arm: &'a Arm,
    pub(super) data: &'a Measurements,
    pub(super) unknowns: Vec<Unknown>,
    /// For each row, which rows it is compared with: one number per pose and marker.
    constant: Option<Vec<usize>>,
    /// For each link that is looked for, the arm with nothing that yields but its beam.
    beams: Vec<(usize, Arm)>,
}

/// One row: what was measured less what the arm shows, and its change with each unknown.
pub(super) struct Line {
    pub(super) gap: Vector6<f64>,
    pub(super) columns: Matrix6xX<f64>,
}

impl<'a> Sheet<'a> {
    pub(super) fn new(
        arm: &'a Arm,
        data: &'a Measurements,
        question: &Question,
    ) -> Result<Sheet<'a>, MeasuredError> {
        let file = || data.file.clone();
        let (n, rows) = (arm.dof(), &data.rows);
        if let Some(row) = rows.iter().find(|row| row.q.len() != n) {
            return Err(MeasuredError::Joints { file: file(), found: row.q.len(), expected: n });
        }
        if let Some(row) = rows.iter().find(|row| row.offset.is_none()) {
            let marker = row.marker.clone().unwrap_or_default();
            return Err(MeasuredError::UnknownOffset { file: file(), line: row.line, marker });
        }
        if rows.iter().all(|row| row.wrench == Vector6::zeros()) {
            return Err(MeasuredError::NoLoad { file: file() });
        }
        let constant = match data.kind {
            Kind::Displacement { .. } => None,
            Kind::Pose { .. } => Some(constants(rows)),
        };
        let sheet = Sheet { arm, data, unknowns: Vec::new(), constant, beams: Vec::new() };
        if sheet.constants(rows.len()) == rows.len() {
            return Err(MeasuredError::OneLoadEach { file: file() });
        }
        let with_beam = (1..=n).filter(|&k| arm.joints[k - 1].beam.is_some() && question.links);
        let links: Vec<usize> = with_beam.collect();
        let bases = (0..6).filter(|_| question.base).map(Unknown::Base);
        let joints = (1..=n).map(Unknown::Joint);
        let unknowns = joints.chain(links.iter().map(|&k| Unknown::Link(k))).chain(bases).collect();
        let beams = links.into_iter().map(|row| (row, only_beam(arm, row - 1))).collect();
        Ok(Sheet { unknowns, beams, ..sheet })
    }

    /// What the robot file has for each unknown.
    pub(super) fn start(&self) -> Vec<f64> {
        let of = |unknown: &Unknown| match unknown {
            Unknown::Joint(j) => self.arm.joints[j - 1].compliance,
            Unknown::Link(_) => 1.0,
            Unknown::Base(_) => 0.0,
        };
        self.unknowns.iter().map(of).collect()
    }

    /// Unknown constants among the first `rows` rows: none of displacements.
    fn constants(&self, rows: usize) -> usize {
        let Some(each) = &self.constant else { return 0 };
        each[..rows].iter().copied().collect::<std::collections::HashSet<_>>().len()
    }

    /// Numbers that each constant takes away, over all of `rows`.
    pub(super) fn constants_in(&self, rows: &[usize]) -> usize {
        let Some(each) = &self.constant else { return 0 };
        rows.iter().map(|&k| each[k]).collect::<std::collections::HashSet<_>>().len()
    }

    /// Some rows at the values `x` of the unknowns, less the constants of their poses.
    pub(super) fn lines(&self, rows: &[usize], x: &[f64]) -> Result<Vec<Line>, MeasuredError> {
        let mut arm = self.arm.clone();
        for (unknown, value) in self.unknowns.iter().zip(x) {
            match unknown {
                // A spring that pushes the wrong way has no equilibrium: the steps start from a
                // rigid joint then, and may still end below zero. So with a beam.
                Unknown::Joint(j) => arm.joints[j - 1].compliance = value.max(0.0),
                Unknown::Link(row) => {
                    if let Some(beam) = &mut arm.joints[row - 1].beam {
                        let stiffer = 1.0 / value.max(STIFFEST);
                        beam.youngs_modulus *= stiffer;
                        beam.shear_modulus *= stiffer;
                    }
                }
                Unknown::Base(_) => {}
            }
        }
        let lines = rows.iter().map(|&k| self.line(&arm, &self.data.rows[k], x));
        let mut lines: Vec<Line> = lines.collect::<Result<_, _>>()?;
        if let Some(constant) = &self.constant {
            subtract_means(&mut lines, rows, constant);
        }
        Ok(lines)
    }

    fn line(&self, arm: &Arm, row: &Row, x: &[f64]) -> Result<Line, MeasuredError> {
        let unstable = |_| MeasuredError::Unstable { file: self.data.file.clone(), line: row.line };
        let offset = Vector3::from(row.offset.unwrap_or_default());
        let under = |wrench: &Vector6<f64>| -> Result<_, MeasuredError> {
            let state = equilibrium(arm, &row.q, wrench).map_err(unstable)?;
            let columns = self.columns(&state, wrench, &offset).map_err(unstable)?;
            Ok((state.tool * Point3::from(offset), state.tool.rotation, columns))
        };
        let (point, turned, columns) = under(&row.wrench)?;
        let (place, turned, columns) = match self.data.kind {
            Kind::Pose { .. } => (point.coords, turned, columns),
            Kind::Displacement { .. } => {
                let (from, before, resting) = under(&Vector6::zeros())?;
                (point - from, turned * before.inverse(), columns - resting)
            }
        };
        let measured = UnitQuaternion::from_scaled_axis(rotation(&row.measured));
        let (p, r) =
            (translation(&row.measured) - place, (measured * turned.inverse()).scaled_axis());
        let mut gap = Vector6::new(p.x, p.y, p.z, r.x, r.y, r.z);
        // The simulated arm stands on a rigid base.
        for ((unknown, column), value) in self.unknowns.iter().zip(columns.column_iter()).zip(x) {
            if let Unknown::Base(_) = unknown {
                gap -= column * *value;
            }
        }
        Ok(Line { gap, columns })
    }

    /// Twist of the measured point per unit of each unknown, to first order about the loaded arm:
    /// the steps end where the gap itself does, not where these slopes are exact.
    fn columns(
        &self,
        state: &State,
        wrench: &Vector6<f64>,
        offset: &Vector3<f64>,
    ) -> Result<Matrix6xX<f64>, stiffarm_kernels::Unstable> {
        let mut columns = Matrix6xX::zeros(self.unknowns.len());
        let arm = self.arm;
        let jacobian = arm.jacobian(&state.joints);
        let torque = arm.joint_torque(&state.joints, wrench) + arm.weight_torque(&state.joints);
        let origin = state.tool.translation.vector;
        for (mut column, unknown) in columns.column_iter_mut().zip(&self.unknowns) {
            let twist = match unknown {
                Unknown::Joint(j) => jacobian.column(j - 1) * torque[j - 1],
                Unknown::Link(row) => match self.beams.iter().find(|(k, _)| k == row) {
                    Some((_, only)) => only.deflection_with_gravity(&state.joints, wrench)?,
                    None => Vector6::zeros(),
                },
                Unknown::Base(k) => base_twist(*k, wrench, &origin),
            };
            column.copy_from(&twist);
        }
        let lever = state.tool.rotation * offset;
        for mut column in columns.column_iter_mut() {
            let turn = Vector3::new(column[3], column[4], column[5]);
            let mut shift = column.fixed_rows_mut::<3>(0);
            shift += turn.cross(&lever);
        }
        Ok(columns)
    }
}

/// Twist of the tool at `origin` when component `k` of the base gives way by one unit per unit of
/// what the load puts on it.
fn base_twist(k: usize, wrench: &Vector6<f64>, origin: &Vector3<f64>) -> Vector6<f64> {
    let (force, moment) = (translation(wrench), rotation(wrench));
    let at_base = moment + origin.cross(&force);
    let mut unit = Vector3::zeros();
    unit[k % 3] = 1.0;
    let (shift, turn) = if k < 3 {
        (unit * force[k], Vector3::zeros())
    } else {
        let turn = unit * at_base[k - 3];
        (turn.cross(origin), turn)
    };
    Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z)
}

/// A number for each pose and marker.
fn constants(rows: &[Row]) -> Vec<usize> {
    let mut seen = HashMap::new();
    let key = |row: &Row| (row.group, row.marker.clone());
    rows.iter()
        .map(|row| {
            let next = seen.len();
            *seen.entry(key(row)).or_insert(next)
        })
        .collect()
}

fn subtract_means(lines: &mut [Line], rows: &[usize], constant: &[usize]) {
    let mut sums: HashMap<usize, (f64, Vector6<f64>, Matrix6xX<f64>)> = HashMap::new();
    for (line, &k) in lines.iter().zip(rows) {
        let zero = || (0.0, Vector6::zeros(), Matrix6xX::zeros(line.columns.ncols()));
        let sum = sums.entry(constant[k]).or_insert_with(zero);
        sum.0 += 1.0;
        sum.1 += line.gap;
        sum.2 += &line.columns;
    }
    for (line, &k) in lines.iter_mut().zip(rows) {
        if let Some((count, gap, columns)) = sums.get(&constant[k]) {
            line.gap -= gap / *count;
            line.columns -= columns / *count;
        }
    }
}

/// The arm with nothing that yields but one beam.
fn only_beam(arm: &Arm, row: usize) -> Arm {
    let mut only = arm.clone();
    for (k, joint) in only.joints.iter_mut().enumerate() {
        joint.compliance = 0.0;
        joint.beam = joint.beam.take().filter(|_| k == row);
    }
    only
}
