//! A progress bar on the terminal, for what takes longer than a second; or what a host is told.

use std::sync::Once;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::host::Host;

/// Work up to this is not worth a bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// Steps of a bar for work that tells its part done.
pub const PARTS: usize = 1000;

/// Between two pictures of what is being done.
const TURN: Duration = Duration::from_millis(120);

/// How far the work has come.
pub struct Progress {
    what: String,
    steps: u64,
    done: AtomicU64,
    host: Host,
    /// A bar that is shown after a while. Without a terminal no clock is asked: a browser has none for this library.
    bar: Option<(ProgressBar, Instant, Once)>,
}

impl Progress {
    /// Of so many steps; `what` stands before the bar.
    pub fn new(what: &str, steps: usize, host: &Host) -> Progress {
        let steps = steps as u64;
        let bar = host.is_watched().then(|| {
            let bar = ProgressBar::with_draw_target(Some(steps), ProgressDrawTarget::hidden());
            let style = ProgressStyle::with_template("{msg} {bar:40} {percent:>3} %  {eta} left");
            let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
            bar.set_style(style.progress_chars("█▌░"));
            bar.set_message(what.to_owned());
            (bar, Instant::now(), Once::new())
        });
        let (what, done) = (what.to_owned(), AtomicU64::new(0));
        Progress { what, steps, done, host: host.clone(), bar }
    }

    /// A part from 0 to 1 of all steps.
    pub fn reach(&self, part: f64, steps: usize) {
        let at = (part.clamp(0.0, 1.0) * steps as f64) as u64;
        let done = self.done.load(Ordering::Relaxed);
        self.add(usize::try_from(at.saturating_sub(done)).unwrap_or(0));
    }

    /// So many steps more.
    pub fn add(&self, steps: usize) {
        let steps = steps as u64;
        let done = self.done.fetch_add(steps, Ordering::Relaxed) + steps;
        if let Some((bar, begun, shown)) = &self.bar {
            if begun.elapsed() > PATIENCE {
                // Draws nothing where standard error is no terminal.
                shown.call_once(|| bar.set_draw_target(ProgressDrawTarget::stderr()));
            }
            bar.inc(steps);
        }
        self.host.is_doing(&self.what, Some((done as f64 / self.steps.max(1) as f64).min(1.0)));
    }
}

/// What is being done, where nobody knows how much of it there is.
pub struct Stages {
    bar: Option<ProgressBar>,
    host: Host,
}

impl Stages {
    /// Nothing said yet.
    pub fn new(host: &Host) -> Stages {
        Stages { bar: host.is_watched().then(Stages::terminal), host: host.clone() }
    }

    fn terminal() -> ProgressBar {
        // Draws nothing where standard error is no terminal.
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
        let style = ProgressStyle::with_template("{spinner} {msg}  {elapsed}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
        bar.enable_steady_tick(TURN);
        bar
    }

    /// What is being done now.
    pub fn say(&self, what: String) {
        self.host.is_doing(&what, None);
        if let Some(bar) = &self.bar {
            bar.set_message(what);
        }
    }
}

impl Drop for Stages {
    fn drop(&mut self) {
        self.bar.iter().for_each(ProgressBar::finish_and_clear);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.iter().for_each(|(bar, ..)| bar.finish_and_clear());
    }
}
