//! A command, run on a thread of its own while Python waits: signals are looked at, and what the command tells
//! is handed on.

use std::collections::HashMap;
use std::panic::resume_unwind;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use stiffarm_cli::host::{Ended, Host};
use stiffarm_cli::{Failure, Remark};

create_exception!(
    stiffarm,
    Error,
    PyValueError,
    "What stiffarm was given cannot be used; the message says what was found, where, and what was expected.\n\n\
     `mistakes` lists each as (message, help, file, line, column); help and place are None where there is none."
);
create_exception!(
    stiffarm,
    Unstable,
    Error,
    "The arm has no stable equilibrium under its load; `first` is the first such pose (from 0), `count` how many \
     there are."
);

/// Between two looks at signals.
const TURN: Duration = Duration::from_millis(40);

/// As much as a program's first thread has on the systems that give most.
const STACK: usize = 16 << 20;

/// A function of the user's raised something, by which the work was left.
pub struct Raised;

/// A mistake as Python has it: message, help, file, line, column.
type Mistake = (String, Option<String>, Option<String>, Option<usize>, Option<usize>);

/// What is told while it runs: remarks, and what is being done.
type Doing = Option<(String, Option<f64>)>;

/// The exception of a failure.
pub fn error(py: Python<'_>, failure: &Failure) -> PyErr {
    let text = failure.text();
    let error = Error::new_err(text.trim_start_matches("error: ").trim_end().to_owned());
    let of = |remark: &Remark| {
        let place = remark.place();
        let (message, help) = (remark.message.clone(), remark.help.clone());
        let [line, column] = [place.map(|p| p.1), place.map(|p| p.2)];
        (message, help, place.map(|p| p.0.to_owned()), line, column)
    };
    let mistakes: Vec<Mistake> = match failure {
        Failure::Plain { message, help } => vec![(message.clone(), help.clone(), None, None, None)],
        Failure::File(remarks) => remarks.iter().map(of).collect(),
    };
    match error.value(py).setattr("mistakes", mistakes) {
        Ok(()) => error,
        Err(other) => other,
    }
}

/// Does `work` on another thread. Ctrl-C asks for its end; a second one does not wait for it.
///
/// # Errors
/// [`Error`] of the work, what a signal raises, what `hear` raises.
pub fn wait<T: Send + 'static>(
    py: Python<'_>,
    host: &Host,
    hear: &Bound<'_, PyAny>,
    mut written: impl FnMut(String, Vec<u8>),
    work: impl FnOnce(&Host) -> Result<Result<T, Failure>, Ended> + Send + 'static,
) -> PyResult<T> {
    let (send, mut receive) = mpsc::sync_channel(1);
    let inside = host.clone();
    let body = move || {
        // Where nobody waits any more, nobody is to be told.
        let _ = send.send(work(&inside));
    };
    let thread = thread::Builder::new().stack_size(STACK).spawn(body)?;
    let mut stopped: Option<PyErr> = None;
    loop {
        let done;
        (receive, done) = py.detach(move || {
            let done = receive.recv_timeout(TURN);
            (receive, done)
        });
        let heard = host.take();
        heard.written.into_iter().for_each(|(name, bytes)| written(name, bytes));
        let told = tell(hear, heard.remarks, heard.doing).and_then(|()| py.check_signals());
        if let Err(error) = told {
            if stopped.is_some() {
                return Err(error);
            }
            host.end();
            stopped = Some(error);
        }
        match (done, stopped.take()) {
            (Err(RecvTimeoutError::Timeout), still) => stopped = still,
            (Err(RecvTimeoutError::Disconnected), error) => {
                let panic = thread.join();
                match (error, panic) {
                    (Some(error), _) => return Err(error),
                    (None, Err(panic)) if panic.is::<Raised>() => {
                        return Err(Error::new_err("a function of one's own raised an exception"));
                    }
                    (None, Err(panic)) => resume_unwind(panic),
                    (None, Ok(())) => {
                        return Err(Error::new_err("the work ended without a result"));
                    }
                }
            }
            (Ok(_), Some(error)) => return Err(error),
            (Ok(Ok(Ok(done))), None) => return Ok(done),
            (Ok(Ok(Err(failure))), None) => return Err(self::error(py, &failure)),
            (Ok(Err(Ended)), None) => return Err(Error::new_err("the work was ended")),
        }
    }
}

fn tell(hear: &Bound<'_, PyAny>, remarks: Vec<String>, doing: Doing) -> PyResult<()> {
    if remarks.is_empty() && doing.is_none() {
        return Ok(());
    }
    hear.call1((remarks, doing)).map(|_| ())
}

/// Runs a command of stiffarm.
///
/// `words` are those of the command line, `files` the bytes of those that are on no disk. What is written to
/// `-` and to names that begin with `<` is returned as bytes, by name; the first of the pair is whether all was as it should.
#[pyfunction]
#[pyo3(signature = (words, files, hear))]
pub fn run<'py>(
    py: Python<'py>,
    words: Vec<String>,
    files: HashMap<String, Vec<u8>>,
    hear: &Bound<'py, PyAny>,
) -> PyResult<(bool, HashMap<String, Bound<'py, PyBytes>>)> {
    let host = Host::new(words, files);
    let mut all: HashMap<String, Vec<u8>> = HashMap::new();
    let add = |name, bytes: Vec<u8>| all.entry(name).or_default().extend(bytes);
    let good = wait(py, &host, hear, add, stiffarm_cli::run)?;
    Ok((good, all.into_iter().map(|(name, bytes)| (name, PyBytes::new(py, &bytes))).collect()))
}
