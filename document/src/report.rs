//! What is reported of an arm's error, whatever was measured: data that every kind fills in, and the one order in which
//! a document has it.

use stiffarm_gap::report::Finding as Found;

use super::figure::{Step, waterfall};
use super::{Block, Document, Finding, Table, Unit, findings};

/// A report of an arm's error.
pub struct Report {
    /// The robot's name.
    pub robot: String,
    /// What the page's title says behind it.
    pub about: &'static str,
    /// From which data, and how.
    pub facts: String,
    /// The result in a sentence or two.
    pub sentence: String,
    /// What stands before the error: mistakes, verdicts, springs.
    pub first: Vec<Block>,
    /// How large the error is.
    pub error: Errors,
    /// What explains it, and what stands beside it: findings, other models, changes, remarks.
    pub rest: Vec<Block>,
    /// What only a page has room for, and how everything was computed; `None` of a screen.
    pub page: Option<(Vec<Block>, Method)>,
}

/// The error before and after.
pub struct Errors {
    /// Which error.
    pub heading: String,
    /// Its sizes.
    pub table: Table,
    /// The same finding by finding, as a page draws it.
    pub steps: Vec<Step>,
    /// Of the steps.
    pub unit: Unit<'static>,
    /// What has to be known to read them.
    pub caption: &'static str,
}

/// How everything was computed.
pub struct Method {
    /// What is always done.
    pub text: &'static str,
    /// With what it was done.
    pub facts: Vec<(&'static str, String)>,
    /// Lists of the report that have no other place.
    pub lists: &'static [&'static str],
}

impl Report {
    /// In the one order that all kinds have.
    pub fn document(self) -> Document {
        let Report { robot, about, facts, sentence, first, error, rest, page } = self;
        let mut blocks = vec![Block::Sentence(sentence)];
        blocks.extend(first);
        blocks.push(error.section());
        blocks.extend(rest);
        blocks.extend(page.map(|(mut sections, method)| {
            sections.push(method.section());
            Block::Page(sections)
        }));
        Document { robot, about, facts, blocks }
    }
}

impl Errors {
    fn section(self) -> Block {
        let steps = Box::new(waterfall(self.steps, self.unit));
        let page = vec![Block::Figure(steps, self.caption.to_owned()), Block::Csv("gap")];
        Block::section(self.heading, vec![Block::Table(self.table), Block::Page(page)])
    }
}

impl Method {
    /// As the last section of a page.
    pub fn section(self) -> Block {
        let mut blocks = vec![Block::Paragraph(self.text.to_owned())];
        blocks.extend((!self.facts.is_empty()).then_some(Block::Facts(self.facts)));
        blocks.extend(self.lists.iter().map(|list| Block::Csv(list)));
        blocks.push(Block::Json);
        Block::section("How it was computed", blocks)
    }
}

/// The findings as `one` reports each, small ones by the `size` of what they remove, and links to their `lists`;
/// `None` where there are none.
pub fn explained(
    all: &[Found],
    remark: String,
    one: impl Fn(usize, &Found) -> Finding,
    size: impl Fn(f64) -> String,
    lists: &[&'static str],
) -> Option<Block> {
    let links = lists.iter().map(|list| Block::Csv(list)).collect();
    (!all.is_empty()).then(|| Block::Section {
        heading: "Findings".to_owned(),
        remark,
        blocks: vec![findings::block(all, one, size), Block::Page(links)],
    })
}
