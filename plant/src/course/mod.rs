//! Motions that joints are sent along: where each is to be, its rate and its acceleration, at any time.
//!
//! [`Fourier`] is a finite Fourier series that begins and ends at rest and holds given [`Limits`];
//! [`Sampled`] goes smoothly through the commands of a file.

mod fourier;
mod limits;
mod sampled;
mod text;

pub use fourier::Fourier;
pub use limits::{Limits, LimitsError};
pub use sampled::Sampled;
pub use text::commands;

/// All joints at one time; rad or m, and their rates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// Where they are.
    pub q: Vec<f64>,
    /// How fast they go.
    pub qd: Vec<f64>,
    /// How fast that changes.
    pub qdd: Vec<f64>,
}

impl FromIterator<[f64; 3]> for State {
    /// Of each joint its value, rate and acceleration.
    fn from_iter<I: IntoIterator<Item = [f64; 3]>>(joints: I) -> State {
        let mut state = State::default();
        for [q, qd, qdd] in joints {
            state.q.push(q);
            state.qd.push(qd);
            state.qdd.push(qdd);
        }
        state
    }
}

/// A motion of all joints.
pub trait Course: Sync {
    /// How long it takes, s.
    fn duration(&self) -> f64;

    /// Where the joints are at a time, s; outside of its duration at its nearer end.
    fn at(&self, time: f64) -> State;
}
