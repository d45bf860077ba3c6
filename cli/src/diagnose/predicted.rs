//! What a diagnosis makes of other data of the arm: nothing is fitted to it.

use std::path::PathBuf;

use serde::Serialize;
use stiffarm_document::beside::LogCheck;
use stiffarm_gap::diagnose::Prediction;
use stiffarm_gap::log::model::Explained;

use super::Found;
use super::log::is_log;
use crate::host::Host;
use crate::terminal::failure::Failure;

/// What a diagnosis makes of other data.
pub enum Predicted {
    /// Of measurements at rest, row by row.
    Rows(Prediction),
    /// Of a log, joint by joint.
    Log(Box<PredictedLog>),
}

/// Another log, as the model of a diagnosis has it.
pub struct PredictedLog {
    /// Its rows.
    pub explained: Explained,
    /// What is left of them.
    pub check: LogCheck,
}

/// What is left of a log, as it is written.
#[derive(Serialize)]
struct Written<'a> {
    check: &'a LogCheck,
}

impl PredictedLog {
    /// What `diagnose --check` writes of it, in JSON.
    ///
    /// # Errors
    /// [`Failure`] if it cannot be written so.
    pub fn json(&self) -> Result<String, Failure> {
        crate::terminal::json::text(&Written { check: &self.check })
    }
}

impl dyn Found {
    /// What the models before and after make of other data of the arm, of a kind that was diagnosed:
    /// one measurement file, or the files of a log.
    ///
    /// # Errors
    /// [`Failure`]: what cannot be read, data of the other kind, what was never fitted.
    pub fn predict(&self, paths: &[PathBuf], host: &Host) -> Result<Predicted, Failure> {
        let [first, rest @ ..] = paths else {
            return Err(Failure::new("found no file to predict, expected one"));
        };
        let (campaign, motion) = (self.campaign(), self.motion());
        let name = first.display();
        // A map says of any file that it is a log.
        if let Some(motion) = motion.filter(|motion| motion.is_mapped()) {
            return motion.predict(paths, host).map(|log| Predicted::Log(Box::new(log)));
        }
        match (is_log(first, host)?, campaign, motion) {
            (true, _, Some(motion)) => {
                motion.predict(paths, host).map(|log| Predicted::Log(Box::new(log)))
            }
            (false, Some(campaign), _) if rest.is_empty() => {
                campaign.predict(first, host).map(Predicted::Rows)
            }
            (false, Some(_), _) => {
                Err(Failure::new(format!("found {} measurement files, expected one", paths.len())))
            }
            (true, _, None) => Err(Failure::new(format!(
                "{name} is a joint log, and measurements were diagnosed: expected a measurement file"
            ))),
            (false, None, _) => Err(Failure::new(format!(
                "{name} is no joint log by its columns, and a log was diagnosed: expected one"
            ))),
        }
    }
}
