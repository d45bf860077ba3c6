//! The build-script form: the same text, written to `OUT_DIR`.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::emit::{RustOptions, rust};
use crate::program::Refused;
use crate::robot::{FileError, Robot};

/// Why a build script's robot was not written.
pub enum BuildError {
    /// A file could not be read or written.
    Io(PathBuf, std::io::Error),
    /// The robot file has mistakes.
    Robot(Box<FileError>),
    /// Not called from a build script: `OUT_DIR` is not set.
    NoOutDir,
    /// A function of one's own has mistakes.
    Program(Refused),
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BuildError::Io(path, e) => write!(f, "{}: {e}", path.display()),
            BuildError::Robot(e) => e.fmt(f),
            BuildError::Program(refused) => refused.fmt(f),
            BuildError::NoOutDir => f.write_str("OUT_DIR is not set: call this from build.rs"),
        }
    }
}

impl fmt::Debug for BuildError {
    /// The message as a user reads it: `main` of a build script prints an error with `Debug`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\n{self}")
    }
}

impl std::error::Error for BuildError {}

impl From<Refused> for BuildError {
    fn from(refused: Refused) -> Self {
        BuildError::Program(refused)
    }
}

/// Generates the module of a robot file into `OUT_DIR`, under the file's own name with the ending
/// `.rs`, and asks cargo to run the build script again when the file changes. Warnings about the file
/// become cargo warnings.
///
/// In the crate: `pub mod elbow { include!(concat!(env!("OUT_DIR"), "/elbow.rs")); }`.
///
/// # Errors
/// [`BuildError`], with every mistake of the robot file. Returned from `main`, it fails the build.
pub fn generate_to_out_dir(
    file: impl AsRef<Path>,
    options: &RustOptions,
) -> Result<PathBuf, BuildError> {
    let file = file.as_ref();
    let robot = read_robot(file)?;
    let name = file.file_stem().unwrap_or(file.as_os_str());
    write_to_out_dir(&name.to_string_lossy(), &rust(&robot, options))
}

/// The arm of a robot file, for a build script: cargo is asked to run it again when the file changes, and
/// warnings about the file become cargo warnings.
///
/// # Errors
/// [`BuildError`], with every mistake of the robot file.
pub fn read_robot(file: impl AsRef<Path>) -> Result<Robot, BuildError> {
    let file = file.as_ref();
    println!("cargo::rerun-if-changed={}", file.display());
    let text = std::fs::read_to_string(file).map_err(|e| BuildError::Io(file.to_owned(), e))?;
    let (robot, warnings) = Robot::for_kernels(&text, &file.to_string_lossy())
        .map_err(|e| BuildError::Robot(Box::new(e)))?;
    for warning in warnings {
        println!("cargo::warning={}", warning.message);
    }
    Ok(robot)
}

/// Writes a text to `OUT_DIR` as `<name>.rs`.
pub(crate) fn write_to_out_dir(name: &str, text: &str) -> Result<PathBuf, BuildError> {
    let out = std::env::var_os("OUT_DIR").ok_or(BuildError::NoOutDir)?;
    let target = Path::new(&out).join(name).with_extension("rs");
    std::fs::write(&target, text).map_err(|e| BuildError::Io(target.clone(), e))?;
    Ok(target)
}
