//! What may be said of a log's diagnosis, and what stands in its way.

use stiffarm_table::robot::Effect;

use super::effects::Catalogue;
use super::read::{Log, Signal, TorqueSide};
use super::scene::Domain;
use crate::io::nearest;
use crate::measurement::Body;

/// How a log is diagnosed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LogOptions {
    /// The version that the report names.
    pub version: String,
    /// Where the torque is measured; else as the log says.
    pub side: Option<TorqueSide>,
    /// Which rows, where a log has both; else torques.
    pub rows: Option<Domain>,
    /// The band's edge, Hz; else found.
    pub band: Option<f64>,
    /// Speed below which a joint counts as standing, rad/s or m/s; else 0.5 % of its largest.
    pub standstill: Option<f64>,
    /// The effects that there are: stiffarm's, and one's own.
    pub catalogue: Catalogue,
    /// Only these effects.
    pub effects: Option<Vec<String>>,
    /// What the robot file knows of the arm in motion: its tables of that kind.
    pub known: Vec<Effect>,
    /// Loads that are known, by the names in the log's column `payload`.
    pub payloads: Vec<Body>,
    /// Whether masses and inertias of the robot file are the links'; else these are fitted along.
    pub known_links: bool,
    /// Whether the search is run again for each fold on the others, and the gap told that it leaves: as
    /// many times the work.
    pub nested: bool,
    /// Of random signs.
    pub seed: u64,
}

/// Why a log cannot be diagnosed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the message beside each variant and field says what it is")]
pub enum Refused {
    #[error(
        "{file}: found torques without a side, expected where they are measured: motor (joint side \
         of the gear, friction in it), link (a sensor behind the gear), current, commanded or \
         external; say it with --torque-side, in a line `# torque_side = …` of the log, or as torque_side in the robot file"
    )]
    NoSide { file: String },
    #[error(
        "{file}: found torque_side external, expected the torque itself: of what is external the \
         robot's own model is taken away already, and with it what could be told of the arm"
    )]
    External { file: String },
    #[error("the robot file: {message}")]
    Known { message: String },
    #[error("{file}: found no {missing}, expected it for {rows} rows")]
    NoRows { file: String, missing: &'static str, rows: &'static str },
    #[error("found the effect `{found}`, expected one of {}{}", known.join(", "), suggestion.as_ref().map_or_else(String::new, |s| format!("; did you mean `{s}`?")))]
    Effect { found: String, known: Vec<&'static str>, suggestion: Option<&'static str> },
    #[error(
        "found a band of {found} Hz, expected more than 0 and less than {limit:.4} Hz, a quarter of \
         the log's rate"
    )]
    Band { found: f64, limit: f64 },
    #[error("found a standstill of {found}, expected a speed that is not negative")]
    Standstill { found: f64 },
    #[error(
        "{file}: found {found:.3} s of motion that can be used, expected more: eight blocks of twice \
         the filter's reach ({expected:.3} s) at least"
    )]
    TooShort { file: String, found: f64, expected: f64 },
    #[error(
        "{file}: no joint moves and is driven by a torque that changes, expected both of one joint at least: are the \
         channels connected?"
    )]
    Silent { file: String },
    #[error(
        "{file}: joint {joint} has no row that counts: it does not move, or what drives it is missing or at its limit throughout; \
         expected motion of every joint: leave the log's rest out, or give a lower --standstill"
    )]
    Still { file: String, joint: usize },
}

impl LogOptions {
    /// Which rows of a log, what they are made of, and where a torque is measured.
    ///
    /// # Errors
    /// [`Refused`]: the log has no such rows, or a torque of no side that could be used.
    pub(super) fn rows_of(
        &self,
        log: &Log,
    ) -> Result<(Domain, Option<Signal>, Option<TorqueSide>), Refused> {
        let file = || log.files.join(", ");
        let drive = [Signal::Torque, Signal::Current].into_iter().find(|s| log.has(*s));
        let usual = if drive.is_some() { Domain::Torque } else { Domain::Position };
        match (self.rows.unwrap_or(usual), drive) {
            (Domain::Position, _) if log.has(Signal::QCmd) => Ok((Domain::Position, None, None)),
            (Domain::Position, _) => {
                Err(Refused::NoRows { file: file(), missing: "q_cmd1 …", rows: "position" })
            }
            (Domain::Torque, None) => {
                Err(Refused::NoRows { file: file(), missing: "tau1 … or i1 …", rows: "torque" })
            }
            (Domain::Torque, Some(drive)) => {
                // A column of currents says itself what it is.
                let current = (drive == Signal::Current).then_some(TorqueSide::Current);
                match self.side.or(log.side).or(current) {
                    None => Err(Refused::NoSide { file: file() }),
                    Some(TorqueSide::External) => Err(Refused::External { file: file() }),
                    side => Ok((Domain::Torque, Some(drive), side)),
                }
            }
        }
    }

    /// # Errors
    /// [`Refused`]: an effect that is none, a band or a speed that is none.
    pub(super) fn checked(&self, period: f64) -> Result<(), Refused> {
        let known = || self.catalogue.iter().map(|e| e.identifier());
        let asked = self.effects.iter().flatten();
        if let Some(found) = asked.clone().find(|name| !known().any(|k| k == **name)) {
            let suggestion = nearest(found, known());
            return Err(Refused::Effect {
                found: found.clone(),
                known: known().collect(),
                suggestion,
            });
        }
        let limit = 0.25 / period;
        if let Some(found) = self.band.filter(|band| !(*band > 0.0 && *band < limit)) {
            return Err(Refused::Band { found, limit });
        }
        match self.standstill.filter(|speed| !(*speed >= 0.0 && speed.is_finite())) {
            Some(found) => Err(Refused::Standstill { found }),
            None => Ok(()),
        }
    }
}
