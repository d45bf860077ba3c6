//! A progress bar on the terminal, for what takes longer than a second.

use std::sync::Once;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

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
}

impl Progress {
    /// Of so many steps; `what` stands before the bar.
    pub fn new(what: &str, steps: usize, quiet: bool) -> Progress {
        let bar = ProgressBar::with_draw_target(Some(steps as u64), ProgressDrawTarget::hidden());
        let style = ProgressStyle::with_template("{msg} {bar:40} {percent:>3} %  {eta} left");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("█▌░"));
        bar.set_message(what.to_owned());
        Progress { bar, begun: Instant::now(), shown: Once::new(), quiet }
    }

    /// A part from 0 to 1 of all steps.
    pub fn reach(&self, part: f64, steps: usize) {
        let at = (part.clamp(0.0, 1.0) * steps as f64) as u64;
        self.add(usize::try_from(at.saturating_sub(self.bar.position())).unwrap_or(0));
    }

    /// So many steps more.
    pub fn add(&self, steps: usize) {
        if !self.quiet && self.begun.elapsed() > PATIENCE {
            // Draws nothing where standard error is no terminal.
            self.shown.call_once(|| self.bar.set_draw_target(ProgressDrawTarget::stderr()));
        }
        self.bar.inc(steps as u64);
    }
}

/// What is being done, where nobody knows how much of it there is.
pub struct Stages(ProgressBar);

impl Stages {
    /// Nothing said yet.
    pub fn new(quiet: bool) -> Stages {
        if quiet {
            return Stages(ProgressBar::hidden());
        }
        // Draws nothing where standard error is no terminal.
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
        let style = ProgressStyle::with_template("{spinner} {msg}  {elapsed}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
        bar.enable_steady_tick(TURN);
        Stages(bar)
    }

    /// What is being done now.
    pub fn say(&self, what: String) {
        self.0.set_message(what);
    }
}

impl Drop for Stages {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
