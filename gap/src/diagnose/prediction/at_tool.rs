//! What an instrument's reading says of the tool: how far the findings move it, and how far it is then known.

use super::explanation::Explanation;
use crate::diagnose::data::Problem;
use crate::diagnose::fit::{Fitted, Model};
use crate::diagnose::options::{DiagnoseError, Options};
use crate::diagnose::report::AtTool;
use crate::effects::{Depends, Place};
use crate::gap::rms;
use crate::infer::limits::SOME_ROWS;
use crate::measurement::{Kind, Measurements, Row};
use crate::parallel;

impl Explanation {
    /// The tool's error at the postures and loads of `data`, by the model and the spread of its numbers, in the axes of the
    /// arm's own base; `None` where positions are read themselves, or nothing was found. What moves the instrument, or
    /// happened at a time, moves no tool.
    ///
    /// # Errors
    /// [`DiagnoseError::Unstable`] and others of the rows.
    pub(crate) fn at_tool(&self, data: &Measurements) -> Result<Option<AtTool>, DiagnoseError> {
        let reads_tool = !matches!(data.kind, Kind::Bench { .. } | Kind::Distance);
        let moves = |f: &Fitted| {
            f.effect.depends() != Depends::Session && f.spot.place != Place::Instrument
        };
        let numbers = self.numbers(moves);
        if reads_tool || numbers.is_empty() {
            return Ok(None);
        }
        let bare = |row: &Row| Row {
            offset: Some([0.0; 3]),
            marker: None,
            session: None,
            camera: None,
            aim: None,
            ..row.clone()
        };
        let every = data.rows.len().div_ceil(SOME_ROWS).max(1);
        let rows = data.rows.iter().step_by(every).map(bare).collect();
        let data = Measurements::new(&data.file, Kind::Pose { orientation: false }, rows);
        let options = Options { known: self.known.clone(), ..Options::default() };
        let problem = Problem::new(&self.nominal, &data, &options)?;
        let [before, after] = self.without_bench().map(|mut model| {
            model.mounts.clear();
            model.bases = vec![self.after.bases[0]; problem.stands.bases.len()];
            model.arm.tool = self.after.arm.tool;
            model.found.retain(moves);
            model
        });
        let root = self.spread.root.select_rows(&numbers);
        let place = |model: &Model, row: usize| {
            Ok::<_, DiagnoseError>(model.sim(&problem, row, None)?.reading().position)
        };
        let rows: Vec<usize> = (0..data.rows.len()).filter(|row| problem.fits[*row]).collect();
        let sizes = parallel::tried(rows.len(), &|k| -> Result<[f64; 2], DiagnoseError> {
            let (row, sim) = (rows[k], after.sim(&problem, rows[k], None)?);
            let block = after.change(&problem, &sim, row, |s| after.block(&problem, row, s));
            let uncertain = (block.fixed_rows::<3>(0) * &root).norm();
            Ok([(place(&after, row)? - place(&before, row)?).norm().hypot(uncertain), uncertain])
        })?;
        let [before, after] = [0, 1].map(|when| sizes.iter().map(|s| s[when]).collect::<Vec<_>>());
        Ok(Some(AtTool { before: rms(&before), after: rms(&after) }))
    }
}
