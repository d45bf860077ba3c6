//! A progress bar on the terminal, for what takes longer than a second.

use std::sync::{Arc, Once};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::inside::{Host, host};

/// Work up to this is not worth a bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// Steps of a bar for work that tells its part done.
pub const PARTS: usize = 1000;

/// Between two pictures of what is being done.
const TURN: Duration = Duration::from_millis(120);

/// How far the work has come.
pub struct Progress {
    bar: ProgressBar,
    begun: Instant,
    shown: Once,
    quiet: bool,
    host: Option<Arc<Host>>,
}

impl Progress {
    /// Of so many steps; `what` stands before the bar.
    pub fn new(what: &str, steps: usize, quiet: bool) -> Progress {
        let bar = ProgressBar::with_draw_target(Some(steps as u64), ProgressDrawTarget::hidden());
        let style = ProgressStyle::with_template("{msg} {bar:40} {percent:>3} %  {eta} left");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("█▌░"));
        bar.set_message(what.to_owned());
        let host = host();
        Progress { bar, begun: Instant::now(), shown: Once::new(), quiet, host }
    }

    /// A part from 0 to 1 of all steps.
    pub fn reach(&self, part: f64, steps: usize) {
        let at = (part.clamp(0.0, 1.0) * steps as f64) as u64;
        self.add(usize::try_from(at.saturating_sub(self.bar.position())).unwrap_or(0));
    }

    /// So many steps more.
    pub fn add(&self, steps: usize) {
        if !self.quiet && self.host.is_none() && self.begun.elapsed() > PATIENCE {
            // Draws nothing where standard error is no terminal.
            self.shown.call_once(|| self.bar.set_draw_target(ProgressDrawTarget::stderr()));
        }
        self.bar.inc(steps as u64);
        if let Some(host) = &self.host {
            let all = self.bar.length().unwrap_or_default().max(1);
            let part = self.bar.position() as f64 / all as f64;
            host.is_doing(&self.bar.message(), Some(part.min(1.0)));
        }
    }
}

/// What is being done, where nobody knows how much of it there is.
pub struct Stages {
    bar: ProgressBar,
    host: Option<Arc<Host>>,
}

impl Stages {
    /// Nothing said yet.
    pub fn new(quiet: bool) -> Stages {
        let host = host();
        if quiet || host.is_some() {
            return Stages { bar: ProgressBar::hidden(), host };
        }
        // Draws nothing where standard error is no terminal.
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
        let style = ProgressStyle::with_template("{spinner} {msg}  {elapsed}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
        bar.enable_steady_tick(TURN);
        Stages { bar, host }
    }

    /// What is being done now.
    pub fn say(&self, what: String) {
        if let Some(host) = &self.host {
            host.is_doing(&what, None);
        }
        self.bar.set_message(what);
    }
}

impl Drop for Stages {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
