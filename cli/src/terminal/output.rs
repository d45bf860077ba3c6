//! Where results go: standard output, or a file that is never half-written.

use std::fs;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use clap::{ArgMatches, Command};

use super::failure::{Failure, reason};
use super::whole::Whole;

/// Where a result goes: a file, or standard output for `-`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// Standard output.
    Stdout,
    File(PathBuf),
}

impl std::str::FromStr for Target {
    type Err = std::convert::Infallible;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(if text == "-" { Target::Stdout } else { Target::File(PathBuf::from(text)) })
    }
}

impl Target {
    /// Writes there what `write` writes bit by bit; where that says that it is nothing, a file is as it was.
    pub(crate) fn stream(
        &self,
        write: &mut dyn FnMut(&mut dyn Write) -> io::Result<bool>,
    ) -> Result<(), Failure> {
        match self {
            Target::Stdout => {
                let mut out = BufWriter::new(io::stdout().lock());
                match write(&mut out).and_then(|_| out.flush()) {
                    Err(error) if error.kind() != ErrorKind::BrokenPipe => {
                        Err(Failure::io("write", Path::new("standard output"), &error))
                    }
                    _ => Ok(()),
                }
            }
            Target::File(path) => {
                let failed = |error: io::Error| Failure::io("write", path, &error);
                let mut whole = BufWriter::new(Whole::new(path).map_err(failed)?);
                if !write(&mut whole).map_err(failed)? {
                    return Ok(());
                }
                let whole = whole.into_inner().map_err(|error| failed(error.into_error()))?;
                whole.finish().map_err(failed)
            }
        }
    }
}

/// Refuses results of a command that would go to one place, or to where something is read.
pub fn apart(command: &Command, given: &ArgMatches) -> Result<(), Failure> {
    let mut taken: Vec<(String, PathBuf)> = Vec::new();
    let mut results: Vec<(String, Target)> = Vec::new();
    for argument in command.get_arguments() {
        let id = argument.get_id().as_str();
        let option = argument.get_long().map(|long| format!("--{long}"));
        let name = option.unwrap_or_else(|| id.to_uppercase());
        let robot = (id == "robot").then(|| given.try_get_many::<String>(id).ok().flatten());
        let robot = robot.flatten().into_iter().flatten().map(PathBuf::from);
        let files = given.try_get_many::<PathBuf>(id).ok().flatten().into_iter().flatten().cloned();
        taken.extend(robot.chain(files).map(|file| (name.clone(), place(&file))));
        let to = given.try_get_many::<Target>(id).ok().flatten().into_iter().flatten();
        results.extend(to.map(|target| (name.clone(), target.clone())));
    }
    let mut printed: Option<String> = None;
    for (option, result) in results {
        match (result, &printed) {
            (Target::Stdout, Some(first)) => {
                let message = format!("{first} and {option} cannot both go to standard output");
                return Err(Failure::new(message));
            }
            (Target::Stdout, None) => printed = Some(option),
            (Target::File(path), _) => {
                let to = place(&path);
                // What is no plain file, such as /dev/null, takes whatever comes.
                let plain = fs::metadata(&to).map_or(true, |there| there.is_file());
                if let Some((other, _)) = taken.iter().find(|(_, place)| plain && *place == to) {
                    let message = format!("{option} would write over {other}: {}", path.display());
                    return Err(Failure::with_help(message, "name another file"));
                }
                taken.push((option, to));
            }
        }
    }
    Ok(())
}

/// Where a path leads, there already or not.
fn place(path: &Path) -> PathBuf {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let beside = || Some(fs::canonicalize(folder).ok()?.join(path.file_name()?));
    fs::canonicalize(path).ok().or_else(beside).unwrap_or_else(|| path.to_owned())
}

/// Prints to standard output. A reader that has seen enough (`| head`) is no mistake.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::new(format!("cannot write to standard output: {}", reason(&error))))
        }
        _ => Ok(()),
    }
}

/// Writes a file, which is as it was where that fails.
pub fn file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut whole = Whole::new(path)?;
    whole.write_all(bytes)?;
    whole.finish()
}
