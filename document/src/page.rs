//! A document as one self-contained page: nothing in it refers to anything outside of it.

use askama::Template;
use serde::Serialize;

use super::words::{capital, share};
use super::{Block, Cell, Document, Finding, Table};

/// What the scripts of a page read, as JSON, and the scripts that draw with it.
#[derive(Debug, Default)]
pub struct Embedded {
    data: String,
    script: String,
}

/// What a page holds besides its text.
#[derive(Serialize)]
struct Data<'a, F: Serialize, W: Serialize> {
    /// What the figures read.
    #[serde(flatten)]
    figures: F,
    /// The report, whose lists are offered as CSV and all of it as JSON.
    whole: &'a W,
}

impl Embedded {
    /// What the figures of a page read, the report as it is written in JSON, and the figures' script.
    pub fn new(
        figures: impl Serialize,
        whole: &impl Serialize,
        script: &str,
    ) -> Result<Embedded, PageError> {
        let data = serde_json::to_string(&Data { figures, whole }).map_err(wrong)?;
        // Nothing in it ends the element that it stands in.
        let data = data.replace('<', "\\u003c");
        let always =
            concat!(include_str!("figure/script/data.js"), include_str!("figure/script/theme.js"));
        Ok(Embedded { data, script: always.to_owned() + script })
    }
}

/// A page that could not be made.
#[derive(Debug, thiserror::Error)]
#[error("cannot make the page: {0}")]
pub struct PageError(String);

fn wrong(error: impl std::fmt::Display) -> PageError {
    PageError(error.to_string())
}

#[derive(Template)]
#[template(path = "page.html")]
struct Page<'a> {
    version: &'static str,
    style: &'static str,
    document: &'a Document,
    embedded: &'a Embedded,
}

impl Document {
    /// The page in HTML.
    pub fn html(&self, embedded: &Embedded) -> Result<String, PageError> {
        self.page(embedded).map_err(wrong)
    }

    fn page(&self, embedded: &Embedded) -> askama::Result<String> {
        let style = include_str!("style.css");
        let page = Page { version: env!("CARGO_PKG_VERSION"), style, document: self, embedded };
        page.render()
    }
}

/// A block in HTML; those within a section stand one heading lower.
#[derive(Template)]
#[template(path = "block.html")]
struct Part<'a> {
    block: &'a Block,
    inner: bool,
}

impl Block {
    fn outer(&self) -> Part<'_> {
        Part { block: self, inner: false }
    }

    fn inner(&self) -> Part<'_> {
        Part { block: self, inner: true }
    }
}

#[derive(Template)]
#[template(path = "table.html")]
struct Grid<'a> {
    table: &'a Table,
}

#[derive(Template)]
#[template(path = "finding.html")]
struct Article<'a> {
    finding: &'a Finding,
}

impl Table {
    fn grid(&self) -> Grid<'_> {
        Grid { table: self }
    }
}

impl Finding {
    fn article(&self) -> Article<'_> {
        Article { finding: self }
    }
}

fn percentage(part: &f64) -> String {
    share(*part)
}

/// For a style: a part in per cent.
fn width(part: &f64) -> String {
    format!("{:.1}", (100.0 * part).clamp(0.0, 100.0))
}

/// No darker than what is written upon it can be read.
fn shade(part: &f64) -> String {
    format!("{:.0}", 60.0 * part.abs())
}
