//! What an arm as its file has it reads in rows of its own: nothing is fitted.

use nalgebra::{Isometry3, Vector6};
use stiffarm_kernels::Unstable;

use crate::diagnose::DiagnoseError;
use crate::diagnose::fit::{self, Placed};
use crate::effects::Known;
use crate::measurement::{Kind, Measurements, Row};
use crate::parallel;
use crate::simulate::{Actual, Moment, Sim, moments};
use crate::whole::Whole;

/// The rows with what the arm is to read in the place of what was measured, at static equilibrium under
/// each row's load with every effect of the robot file. The user's own simulator, if the rows have one,
/// plays no part; what happened in another session is not there.
///
/// # Errors
/// [`DiagnoseError`]: rows of another robot, a marker or a point whose place nobody knows, a load that
/// the arm does not bear.
pub fn predicted<'a>(
    whole: impl Into<Whole<'a>>,
    data: &Measurements,
) -> Result<Measurements, DiagnoseError> {
    let Whole { arm, known } = whole.into();
    let known: Vec<Known> = known.iter().filter(|known| known.is_there(data)).cloned().collect();
    let here = Whole { arm, known: &known };
    let moments = moments(data);
    let read = |k: usize| -> Result<Row, DiagnoseError> {
        let (row, when) = (&data.rows[k], &moments[k]);
        are_known(here, data, row)?;
        let unstable = |_| DiagnoseError::Unstable { file: data.file.clone(), line: row.line };
        let measured = reading(here, data.kind, row, when).map_err(unstable)?;
        Ok(Row { measured, sim: None, ..row.clone() })
    };
    // The first row's error is told, however many are worked on at once.
    let rows = parallel::map(data.rows.len(), &read).into_iter().collect::<Result<_, _>>()?;
    Ok(Measurements { rows, sim_given: [false; 6], ..data.clone() })
}

/// Rows that were measured, with what is unknown of the bench fitted to them (places of sockets, planes and centres,
/// zeros of gauges and levels, a lens, where a camera and its board are), and the same as [`predicted`], so that the gap
/// between both is what the arm leaves. Other frames stay as the file has them.
///
/// # Errors
/// As [`predicted`].
pub fn predicted_on_bench<'a>(
    whole: impl Into<Whole<'a>>,
    data: Measurements,
) -> Result<[Measurements; 2], DiagnoseError> {
    let whole = whole.into();
    if !data.by_camera && !data.rows.iter().any(Row::reads_unknown) {
        let read = predicted(whole, &data)?;
        return Ok([data, read]);
    }
    data.rows.iter().try_for_each(|row| has_marker(&data, row))?;
    let Placed { data, read } = fit::placed(whole.arm, data, whole.known)?;
    let rows = data.rows.iter().zip(read);
    let rows = rows.map(|(row, measured)| Row { measured, sim: None, ..row.clone() }).collect();
    let read = Measurements { rows, ..data.clone() };
    Ok([data, read])
}

fn are_known(whole: Whole<'_>, data: &Measurements, row: &Row) -> Result<(), DiagnoseError> {
    let (file, expected) = (|| data.file.clone(), whole.arm.dof());
    if row.q.len() != expected {
        return Err(DiagnoseError::Joints { file: file(), found: row.q.len(), expected });
    }
    has_marker(data, row)?;
    if let Some(aim) = row.aim.as_deref().filter(|aim| !aim.free.is_empty()) {
        let point = aim.full_name();
        return Err(DiagnoseError::NewPoint { file: file(), point });
    }
    Ok(())
}

fn has_marker(data: &Measurements, row: &Row) -> Result<(), DiagnoseError> {
    match (&row.marker, row.offset) {
        (Some(marker), None) => {
            Err(DiagnoseError::NewMarker { file: data.file.clone(), marker: marker.clone() })
        }
        _ => Ok(()),
    }
}

fn reading(
    Whole { arm, known }: Whole<'_>,
    kind: Kind,
    row: &Row,
    when: &Moment,
) -> Result<Vector6<f64>, Unstable> {
    let [x, y, z] = row.offset.unwrap_or_default();
    let sim = Sim::of(kind, Isometry3::translation(x, y, z), None, |loaded| {
        let wrench = if loaded { row.wrench } else { Vector6::zeros() };
        let mut actual = Actual::new(arm, &row.q, &wrench);
        known.iter().for_each(|known| known.alter(&mut actual, row, when));
        actual
    })?;
    let mask = Vector6::from_iterator(kind.components().map(f64::from));
    Ok(sim.seen_by(row.view(kind)).reading().vector().component_mul(&mask))
}
