//! A progress bar on the terminal, for what takes longer than a second.

use std::sync::Once;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Work up to this is not worth a bar.
const PATIENCE: Duration = Duration::from_secs(1);

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

    /// So many steps more.
    pub fn add(&self, steps: usize) {
        if !self.quiet && self.begun.elapsed() > PATIENCE {
            // Draws nothing where standard error is no terminal.
            self.shown.call_once(|| self.bar.set_draw_target(ProgressDrawTarget::stderr()));
        }
        self.bar.inc(steps as u64);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
