//! What is wrong with a program of one's own.

use core::fmt;

use crate::term::Mistake;

/// Why a function was not made: every mistake in it, each at its line of the build script.
#[derive(Clone)]
pub struct Refused {
    pub(super) function: String,
    pub(super) mistakes: Vec<Mistake>,
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, Mistake { at, text }) in self.mistakes.iter().enumerate() {
            let line = if k == 0 { "" } else { "\n" };
            write!(f, "{line}function `{}`: {text}", self.function)?;
            if let Some(at) = at {
                write!(f, "\n --> {}:{}:{}", at.file(), at.line(), at.column())?;
            }
        }
        Ok(())
    }
}

impl fmt::Debug for Refused {
    /// The message as a user reads it: `main` of a build script prints an error with `Debug`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\n{self}")
    }
}

impl std::error::Error for Refused {}
