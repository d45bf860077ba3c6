//! Why a URDF cannot be imported.

use core::ops::Range;

/// What stands in the way, where, and how to mend it.
#[derive(Debug)]
pub struct Refusal {
    /// What was found and what was expected.
    pub message: String,
    /// How to mend it.
    pub help: Option<String>,
    /// What the message is about.
    pub place: Place,
}

/// A place in a URDF.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// The file as a whole.
    File,
    /// Some of its bytes.
    Bytes(Range<usize>),
    /// The element of the joint with this name.
    Joint(String),
    /// The element of the link with this name.
    Link(String),
}

impl Refusal {
    /// Without advice.
    pub fn new(message: impl Into<String>, place: Place) -> Refusal {
        Refusal { message: message.into(), help: None, place }
    }

    /// The same with advice.
    pub fn help(self, help: impl Into<String>) -> Refusal {
        Refusal { help: Some(help.into()), ..self }
    }
}
