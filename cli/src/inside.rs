//! Commands inside another program: it hands over files that are nowhere on disk, and takes what would be
//! printed, what is to be known, and how far the work is.
//!
//! A command runs on the thread that called it, and finds its host there; without one it is at a
//! terminal.

use std::cell::RefCell;
use std::collections::HashMap;
use std::ffi::OsStr;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use stiffarm_gap::diagnose::Stop;
use stiffarm_gap::readings::Sheet;

use crate::terminal::failure::Failure;

/// The program around a command. Files whose names begin with `<` are its own, and never on disk.
#[derive(Default)]
pub struct Host {
    /// The words of the command, as they are told on a page.
    pub words: Vec<String>,
    /// Its files, by the names that the command's words have for them.
    pub files: HashMap<String, Vec<u8>>,
    /// Called on the work's thread with what is being done, and what part of it is.
    hears: Option<fn(&str, Option<f64>)>,
    heard: Mutex<Heard>,
    stop: Stop,
}

/// What a command has told so far.
#[derive(Clone, Debug, Default)]
pub struct Heard {
    /// Texts, each with the name of its file; `-` is what a terminal would show.
    pub written: Vec<(String, String)>,
    /// What the user should know.
    pub remarks: Vec<String>,
    /// What is being done, and what part of it is, from 0 to 1, where that is known.
    pub doing: Option<(String, Option<f64>)>,
}

/// The work was asked to end, and was left.
#[derive(Clone, Copy, Debug)]
pub struct Ended;

thread_local! {
    static HOST: RefCell<Option<Arc<Host>>> = const { RefCell::new(None) };
}

impl Host {
    /// With these files.
    pub fn new(words: Vec<String>, files: HashMap<String, Vec<u8>>) -> Arc<Host> {
        Host::hearing(words, files, None)
    }

    /// The same for a program without other threads, which hears how far the work is by being called.
    pub fn hearing(
        words: Vec<String>,
        files: HashMap<String, Vec<u8>>,
        hears: Option<fn(&str, Option<f64>)>,
    ) -> Arc<Host> {
        // What is heard is text, wherever it is shown.
        console::set_colors_enabled(false);
        console::set_colors_enabled_stderr(false);
        Arc::new(Host { words, files, hears, ..Host::default() })
    }

    /// Does `work` inside this program.
    ///
    /// # Errors
    /// [`Failure`] of the work; [`Ended`] if it was left because the program asked for its end.
    pub fn run<T>(
        self: &Arc<Self>,
        work: impl FnOnce() -> Result<T, Failure>,
    ) -> Result<Result<T, Failure>, Ended> {
        let before = HOST.with_borrow_mut(|host| host.replace(Arc::clone(self)));
        let done = catch_unwind(AssertUnwindSafe(work));
        HOST.with_borrow_mut(|host| *host = before);
        match done {
            Err(_) | Ok(_) if self.stop.is_asked() => Err(Ended),
            Ok(done) => Ok(done),
            Err(panic) => resume_unwind(panic),
        }
    }

    /// Asks the work for its end, from another thread.
    pub fn end(&self) {
        self.stop.ask();
    }

    /// What was told since this was last asked for.
    pub fn take(&self) -> Heard {
        std::mem::take(&mut self.heard())
    }

    /// What a search of a command inside this program is told to stop by.
    pub(crate) fn stop(&self) -> Stop {
        self.stop.clone()
    }

    pub(crate) fn remark(&self, text: &str) {
        self.heard().remarks.push(text.trim_end().to_owned());
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        self.heard().written.push((name.to_owned(), text.to_owned()));
    }

    /// Says how far the work is; here it is left if its end was asked for.
    pub(crate) fn is_doing(&self, what: &str, part: Option<f64>) {
        if self.stop.is_asked() {
            resume_unwind(Box::new(Ended));
        }
        if let Some(hears) = self.hears {
            hears(what, part);
        }
        self.heard().doing = Some((what.to_owned(), part));
    }

    fn heard(&self) -> MutexGuard<'_, Heard> {
        self.heard.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The program around what runs on this thread.
pub(crate) fn host() -> Option<Arc<Host>> {
    HOST.with_borrow(Option::clone)
}

/// The host to whom a file belongs.
pub(crate) fn owner(path: &Path) -> Option<Arc<Host>> {
    let first = path.as_os_str().as_encoded_bytes().first();
    host().filter(|_| first == Some(&b'<'))
}

/// The bytes of a file, of the host's or on disk.
///
/// # Errors
/// As reading it.
pub(crate) fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    let held = |host: Arc<Host>| path.to_str().and_then(|name| host.files.get(name)).cloned();
    match host().and_then(held) {
        Some(bytes) => Ok(bytes),
        None => stiffarm_gap::measurement::bytes(path),
    }
}

/// A file of a table: one on disk is gone through where it is, and not held.
///
/// # Errors
/// As reading it.
pub(crate) fn sheet(path: &Path) -> io::Result<Sheet> {
    match path.is_file() && owner(path).is_none() {
        true => Ok(Sheet::on_disk(path)),
        false => Ok(Sheet::new(path.display().to_string(), bytes(path)?)),
    }
}

/// The words that the command was called with.
pub(crate) fn words() -> Vec<String> {
    let of_process = || {
        let lossy = |word: &OsStr| word.to_string_lossy().into_owned();
        std::env::args_os().skip(1).map(|word| lossy(&word)).collect()
    };
    host().map_or_else(of_process, |host| host.words.clone())
}
