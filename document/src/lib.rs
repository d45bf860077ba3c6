//! What a diagnosis of a robot arm reports: one tree of blocks, which [`Document`] prints to a terminal, as an HTML page
//! and on paper.
//!
//! A report is made into a [`Document`] once; the printers decide how a block looks, never what it says.
#![forbid(unsafe_code)]

pub mod beside;
pub mod campaign;
pub mod figure;
mod findings;
pub mod identified;
pub mod log;
mod page;
pub mod plot;
mod print;
pub mod report;
mod screen;
mod table;
pub mod text;
pub mod together;
mod unit;
pub mod words;

use figure::Picture;
pub use page::{Embedded, PageError};
pub use screen::TOP;
pub use table::{Cell, Row, Table};
pub use unit::{Unit, Units};

/// A report of one robot.
#[derive(Default)]
pub struct Document {
    /// The robot's name.
    pub robot: String,
    /// What the page's title says behind it.
    pub about: &'static str,
    /// From which data, and how.
    pub facts: String,
    /// What is reported, in order.
    pub blocks: Vec<Block>,
}

/// A part of a document.
pub enum Block {
    /// The result in a sentence or two; the first block of every document.
    Sentence(String),
    /// An answer to a question of the user; `None` where it is neither good nor bad.
    Verdict(Option<bool>, String),
    /// Blocks under a heading, with a remark beside it.
    Section {
        /// What stands over it.
        heading: String,
        /// What has to be known to read it.
        remark: String,
        /// What it holds.
        blocks: Vec<Block>,
    },
    /// Sentences.
    Paragraph(String),
    /// Remarks of one kind under their name; a screen has the first `most` of them.
    Note {
        /// At most 13 letters.
        name: &'static str,
        /// One remark each.
        lines: Vec<String>,
        /// Lines of a screen.
        most: usize,
    },
    /// Places with their shares of a whole, largest first.
    Shares {
        /// At most 13 letters.
        name: &'static str,
        /// The places; shares from 0 to 1.
        shares: Vec<(String, f64)>,
        /// What the shares are.
        remark: String,
    },
    /// Entries, one line each.
    List(Vec<String>),
    /// Rows and columns.
    Table(Table),
    /// Findings: those that matter in full, the others in one line.
    Findings {
        /// In the order in which they were added.
        large: Vec<Finding>,
        /// What the others come to together; empty where there are none.
        summary: String,
        /// The others.
        small: Vec<Finding>,
    },
    /// Names and values.
    Facts(Vec<(&'static str, String)>),
    /// A link to a list of the report as CSV, by its path in the JSON; on pages only.
    Csv(&'static str),
    /// A link to all of the report as JSON; on pages only.
    Json,
    /// A picture, with what has to be known to read it; on pages only.
    Figure(Picture, String),
    /// What only a page has room for.
    Page(Vec<Block>),
    /// Another document.
    Document(Document, Embedded),
}

/// A finding as it is reported.
#[derive(Debug)]
pub struct Finding {
    /// Its number, from 1.
    pub number: usize,
    /// `joint compliance at joint 2`.
    pub name: String,
    /// What it does, in half a sentence; empty where there is none.
    pub said: String,
    /// The held-out error before and with it.
    pub error: String,
    /// The same as parts of the whole.
    pub parts: [f64; 2],
    /// By how much that is less, with its interval; empty where it is not known.
    pub less: String,
    /// Its parameters with their intervals.
    pub parameters: Vec<String>,
    /// Its p value, and whatever else speaks for it.
    pub evidence: String,
    /// What is not distinguishable from it.
    pub same: Vec<String>,
    /// The best of what is.
    pub next: Option<String>,
    /// The measurement that would separate them.
    pub advice: Option<String>,
}

impl Block {
    /// A section whose heading needs no remark.
    pub fn section(heading: impl Into<String>, blocks: Vec<Block>) -> Block {
        Block::Section { heading: heading.into(), remark: String::new(), blocks }
    }

    /// Remarks of one kind, the first `most` on a screen; nothing where there are none.
    pub fn notes(name: &'static str, lines: Vec<String>, most: usize) -> Option<Block> {
        (!lines.is_empty()).then_some(Block::Note { name, lines, most })
    }

    /// A remark; nothing where there is none.
    pub fn note(name: &'static str, line: impl Into<String>) -> Option<Block> {
        let line = line.into();
        (!line.is_empty()).then(|| Block::Note { name, lines: vec![line], most: 1 })
    }
}
