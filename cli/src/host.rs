//! What surrounds a command: a terminal, or another program, which hands over files that are nowhere on disk, and takes
//! what would be printed, what is to be known, and how far the work is.

use std::collections::HashMap;
use std::ffi::OsStr;
use std::io::{self, Write};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use console::style;
use stiffarm_gap::diagnose::Stop;
use stiffarm_gap::readings::Sheet;

use crate::terminal::failure::{Failure, Remark};
use crate::terminal::interrupt;
use crate::terminal::output::{self, Target};

/// The surroundings of a command, which it is handed: it reads, remarks, prints and writes by them alone.
#[derive(Clone, Default)]
pub struct Host {
    /// `None` at a terminal.
    program: Option<Arc<Program>>,
    /// Whether remarks are left out.
    quiet: bool,
}

/// The program around a command. Files whose names begin with `<` are its own, and never on disk.
#[derive(Default)]
struct Program {
    /// The words of the command, as they are told on a page.
    words: Vec<String>,
    /// Its files, by the names that the command's words have for them.
    files: HashMap<String, Vec<u8>>,
    /// Called on the work's thread with what is being done, and what part of it is.
    hears: Option<fn(&str, Option<f64>)>,
    heard: Mutex<Heard>,
    stop: Stop,
}

/// What a command has told so far.
#[derive(Clone, Debug, Default)]
pub struct Heard {
    /// Bytes, each with the name of its file; `-` is what a terminal would show.
    pub written: Vec<(String, Vec<u8>)>,
    /// What the user should know.
    pub remarks: Vec<String>,
    /// What is being done, and what part of it is, from 0 to 1, where that is known.
    pub doing: Option<(String, Option<f64>)>,
}

/// The work was asked to end, and was left.
#[derive(Clone, Copy, Debug)]
pub struct Ended;

impl Host {
    /// A program with these files, whose command has these words.
    pub fn new(words: Vec<String>, files: HashMap<String, Vec<u8>>) -> Host {
        Host::hearing(words, files, None)
    }

    /// The same for a program without other threads, which hears how far the work is by being called.
    pub fn hearing(
        words: Vec<String>,
        files: HashMap<String, Vec<u8>>,
        hears: Option<fn(&str, Option<f64>)>,
    ) -> Host {
        // What is heard is text, wherever it is shown.
        console::set_colors_enabled(false);
        console::set_colors_enabled_stderr(false);
        let program = Program { words, files, hears, ..Program::default() };
        Host { program: Some(Arc::new(program)), quiet: false }
    }

    /// The same, `quiet` or not.
    #[must_use]
    pub fn quiet(&self, quiet: bool) -> Host {
        Host { quiet, ..self.clone() }
    }

    /// Whether remarks are left out.
    pub(crate) fn is_quiet(&self) -> bool {
        self.quiet
    }

    /// Does `work` inside this program.
    ///
    /// # Errors
    /// [`Failure`] of the work; [`Ended`] if it was left because the program asked for its end.
    pub fn run<T>(
        &self,
        work: impl FnOnce() -> Result<T, Failure>,
    ) -> Result<Result<T, Failure>, Ended> {
        match catch_unwind(AssertUnwindSafe(work)) {
            Err(_) | Ok(_) if self.stop().is_asked() => Err(Ended),
            Ok(done) => Ok(done),
            Err(panic) => resume_unwind(panic),
        }
    }

    /// Asks the work for its end, from another thread.
    pub fn end(&self) {
        self.stop().ask();
    }

    /// What was told since this was last asked for; nothing is kept at a terminal.
    pub fn take(&self) -> Heard {
        self.program
            .as_ref()
            .map_or_else(Heard::default, |program| std::mem::take(&mut program.heard()))
    }

    /// What a search is told to stop by.
    pub(crate) fn stop(&self) -> Stop {
        self.program.as_ref().map_or_else(interrupt::stop, |program| program.stop.clone())
    }

    /// The words that the command was called with.
    pub(crate) fn words(&self) -> Vec<String> {
        let lossy = |word: &OsStr| word.to_string_lossy().into_owned();
        let of_process = || std::env::args_os().skip(1).map(|word| lossy(&word)).collect();
        self.program.as_ref().map_or_else(of_process, |program| program.words.clone())
    }

    /// The bytes of a file, of the program's or on disk.
    pub(crate) fn read(&self, path: &Path) -> Result<Vec<u8>, Failure> {
        match self.held(path) {
            Some(bytes) => Ok(bytes.clone()),
            None => stiffarm_gap::measurement::bytes(path)
                .map_err(|error| Failure::io("read", path, &error)),
        }
    }

    /// Whether a file is to be read where it is, row by row.
    pub(crate) fn is_on_disk(&self, path: &Path) -> bool {
        path.is_file() && self.held(path).is_none()
    }

    /// The program's file of that name.
    fn held(&self, path: &Path) -> Option<&Vec<u8>> {
        let (program, name) = self.program.as_ref().zip(path.to_str())?;
        program.files.get(name)
    }

    /// A file of a table: one on disk is gone through where it is, and not held.
    pub(crate) fn sheet(&self, path: &Path) -> Result<Sheet, Failure> {
        Ok(match self.is_on_disk(path) {
            true => Sheet::on_disk(path),
            false => Sheet::new(path.display().to_string(), self.read(path)?),
        })
    }

    /// Whether a file is the program's by its name.
    pub(crate) fn owns(&self, path: &Path) -> bool {
        self.program.is_some() && path.as_os_str().as_encoded_bytes().first() == Some(&b'<')
    }

    /// Tells a remark, unless quiet.
    pub(crate) fn note(&self, text: &str) {
        let head = style("note").for_stderr().cyan().bold();
        self.tell(text, || format!("{head}: {text}\n"));
    }

    /// Tells a remark on a place in a file, unless quiet.
    pub(crate) fn warn(&self, remark: &Remark) {
        self.tell(&remark.text(), || remark.text());
    }

    /// Tells a text, which a terminal has in its own way; where standard error is closed there is no one to tell.
    fn tell(&self, text: &str, at_terminal: impl FnOnce() -> String) {
        match &self.program {
            _ if self.quiet => {}
            Some(program) => program.remark(text),
            None => {
                let _ = std::io::stderr().write_all(at_terminal().as_bytes());
            }
        }
    }

    /// Prints to standard output.
    pub(crate) fn print(&self, text: &str) -> Result<(), Failure> {
        let Some(program) = &self.program else { return output::print(text) };
        program.write("-", text.as_bytes());
        Ok(())
    }

    /// Writes the whole text there.
    pub(crate) fn write(&self, target: &Target, text: &str) -> Result<(), Failure> {
        match (target, &self.program) {
            (Target::Stdout, _) => return self.print(text),
            (Target::File(path), Some(program)) if self.owns(path) => {
                program.write(&path.display().to_string(), text.as_bytes());
            }
            (Target::File(path), _) => {
                return output::file(path, text.as_bytes())
                    .map_err(|error| Failure::io("write", path, &error));
            }
        }
        Ok(())
    }

    /// Writes there what `write` writes bit by bit; where that says that it is nothing, a file is as it was.
    pub(crate) fn stream(
        &self,
        target: &Target,
        write: &mut dyn FnMut(&mut dyn Write) -> io::Result<bool>,
    ) -> Result<(), Failure> {
        let (program, name) = match (target, &self.program) {
            (Target::Stdout, Some(program)) => (program, "-".to_owned()),
            (Target::File(path), Some(program)) if self.owns(path) => {
                (program, path.display().to_string())
            }
            _ => return target.stream(write),
        };
        let mut held = Vec::new();
        if write(&mut held).map_err(|error| Failure::new(error.to_string()))? {
            program.write(&name, &held);
        }
        Ok(())
    }

    /// Writes what `text` is to where it was asked for, if it was.
    pub(crate) fn put(
        &self,
        target: &Option<Target>,
        text: impl FnOnce() -> Result<String, Failure>,
    ) -> Result<(), Failure> {
        target.as_ref().map_or(Ok(()), |target| self.write(target, &text()?))
    }

    /// Whether a screen is wanted beside what was asked for: not where that goes to standard output itself, nor where
    /// something is written and all else is to be left out.
    pub(crate) fn shows(&self, targets: &[&Option<Target>]) -> bool {
        let mut written = targets.iter().copied().flatten().peekable();
        !(self.quiet && written.peek().is_some()) && written.all(|to| *to != Target::Stdout)
    }

    /// Whether somebody at a terminal may look at how far the work is.
    pub(crate) fn is_watched(&self) -> bool {
        !self.quiet && self.program.is_none()
    }

    /// Says how far the work is; here it is left if its end was asked for.
    pub(crate) fn is_doing(&self, what: &str, part: Option<f64>) {
        let Some(program) = &self.program else { return };
        if program.stop.is_asked() {
            resume_unwind(Box::new(Ended));
        }
        if let Some(hears) = program.hears {
            hears(what, part);
        }
        program.heard().doing = Some((what.to_owned(), part));
    }
}

impl Program {
    fn remark(&self, text: &str) {
        self.heard().remarks.push(text.trim_end().to_owned());
    }

    fn write(&self, name: &str, bytes: &[u8]) {
        self.heard().written.push((name.to_owned(), bytes.to_owned()));
    }

    fn heard(&self) -> MutexGuard<'_, Heard> {
        self.heard.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
