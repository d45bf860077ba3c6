//! A document on one sheet of paper, A4, black on white, as PDF.
//!
//! Letters are those that every reader has. The same document gives the same bytes.

mod letters;
mod sheet;

use pdf_writer::{Finish, Name, Pdf, Rect, Ref, TextStr};

use super::{Block, Cell, Document, Finding, Table};
use crate::words::{capital, share};
use letters::Font;
use sheet::{HEIGHT, Sheet, WIDTH};

/// Findings with their parameters, and the size of the letters (pt), until a document fits on the sheet.
const ATTEMPTS: [(usize, f32); 8] =
    [(usize::MAX, 9.0), (8, 9.0), (8, 8.0), (4, 8.0), (4, 7.0), (2, 7.0), (1, 6.0), (0, 5.0)];

/// The most parameters of a finding that are printed; a calibration has dozens.
const PARAMETERS: usize = 8;

/// Width of a bar of a table, and of that of a finding, pt.
const BAR: f32 = 90.0;

/// Between columns, in sizes of the letters.
const GAP: f32 = 1.2;

impl Document {
    /// The sheet.
    pub fn pdf(&self) -> Vec<u8> {
        let mut sheets = ATTEMPTS.iter().map(|(detailed, size)| self.sheet(*detailed, *size));
        let last = sheets.next_back();
        let sheet = sheets.find(Sheet::fits).or(last);
        let content = sheet.map(Sheet::content).unwrap_or_default();
        let [catalog, pages, page, stream, plain, bold, symbol, info] =
            [1, 2, 3, 4, 5, 6, 7, 8].map(Ref::new);
        let mut pdf = Pdf::new();
        pdf.catalog(catalog).pages(pages);
        pdf.pages(pages).kids([page]).count(1);
        let mut one = pdf.page(page);
        one.media_box(Rect::new(0.0, 0.0, WIDTH, HEIGHT)).parent(pages).contents(stream);
        let fonts = [(Font::Plain, plain), (Font::Bold, bold), (Font::Symbol, symbol)];
        let mut resources = one.resources();
        let mut named = resources.fonts();
        for (font, at) in fonts {
            named.pair(Name(font.name()), at);
        }
        named.finish();
        resources.finish();
        one.finish();
        for (font, at) in fonts {
            let mut written = pdf.type1_font(at);
            written.base_font(Name(font.base()));
            if font != Font::Symbol {
                written.encoding_predefined(Name(b"WinAnsiEncoding"));
            }
        }
        pdf.stream(stream, &content);
        let title = format!("{}: {}", self.robot, self.about);
        pdf.document_info(info).title(TextStr(&title)).producer(TextStr("stiffarm"));
        pdf.finish()
    }

    fn sheet(&self, detailed: usize, size: f32) -> Sheet {
        let mut sheet = Sheet::new(size);
        sheet.line(&self.robot, Font::Bold, 1.8);
        sheet.line(&capital(self.about), Font::Plain, 1.2);
        sheet.rule();
        sheet.paragraph(&self.facts, 0.0);
        for block in &self.blocks {
            block.print(&mut sheet, detailed);
        }
        sheet
    }
}

impl Block {
    fn print(&self, sheet: &mut Sheet, detailed: usize) {
        match self {
            Block::Sentence(text) => {
                sheet.space(0.5);
                sheet.bold_paragraph(text);
            }
            Block::Verdict(_, text) => sheet.bold_paragraph(text),
            Block::Paragraph(text) => sheet.paragraph(text, 0.0),
            Block::Section { heading, remark, blocks } => {
                sheet.space(0.8);
                sheet.heading(heading, remark);
                blocks.iter().for_each(|block| block.print(sheet, detailed));
            }
            Block::Note { name, lines, .. } => {
                lines.iter().for_each(|line| sheet.paragraph(&format!("{name}: {line}"), 0.0));
            }
            Block::Shares { name, shares, remark } => {
                let each = shares.iter().map(|(place, part)| format!("{place} {}", share(*part)));
                let listed = each.collect::<Vec<_>>().join(", ");
                sheet.paragraph(&format!("{name}: {listed} ({remark})"), 0.0);
            }
            Block::List(entries) => entries.iter().for_each(|entry| sheet.paragraph(entry, 1.0)),
            Block::Table(table) => table.print(sheet),
            Block::Findings { large, summary, small } => {
                findings(sheet, large, summary, small, detailed);
            }
            Block::Facts(facts) => {
                let rows = facts.iter().filter(|(_, value)| !value.is_empty());
                rows.for_each(|(name, value)| sheet.fact(name, value));
            }
            // What is drawn by a page's scripts, or is a link.
            Block::Csv(_) | Block::Json | Block::Figure(..) | Block::Page(_) => {}
            Block::Document(document, _) => {
                document.blocks.iter().for_each(|block| block.print(sheet, detailed));
            }
        }
    }
}

impl Table {
    fn print(&self, sheet: &mut Sheet) {
        let is_number = self.columns();
        let size = sheet.size();
        let head = |k: usize| self.heads.get(k).map_or("", String::as_str);
        let wide = |k: usize| {
            let cells = self.rows.iter().filter_map(|row| row.get(k)).map(|cell| match cell {
                Cell::Bar(_) => BAR,
                cell => letters::width(cell.plain(), Font::Plain) * size,
            });
            cells.fold(letters::width(head(k), Font::Plain) * size, f32::max)
        };
        let widths: Vec<f32> = (0..is_number.len()).map(wide).collect();
        let starts: Vec<f32> = widths
            .iter()
            .scan(0.0, |at, width| {
                let start = *at;
                *at += width + GAP * size;
                Some(start)
            })
            .collect();
        let put = |sheet: &mut Sheet, k: usize, text: &str| match is_number[k] {
            true => sheet.right(text, starts[k] + widths[k]),
            false => sheet.left(text, starts[k]),
        };
        if self.heads.iter().any(|head| !head.is_empty()) {
            (0..is_number.len()).for_each(|k| put(sheet, k, head(k)));
            sheet.next();
        }
        for row in &self.rows {
            for (k, cell) in row.iter().enumerate() {
                match cell {
                    Cell::Bar(part) => sheet.bar(starts[k], BAR, [*part, *part]),
                    cell => put(sheet, k, cell.plain()),
                }
            }
            sheet.next();
        }
        if !self.caption.is_empty() {
            sheet.paragraph(&self.caption, 0.0);
        }
    }
}

impl Cell {
    /// Without colours; nothing of what is drawn.
    fn plain(&self) -> &str {
        match self {
            Cell::Text(text)
            | Cell::Number(text)
            | Cell::Shade(_, text)
            | Cell::Judged(_, text) => text,
            Cell::Bar(_) => "",
        }
    }
}

/// A line with a bar for each finding: the outline is the error before it, the filled part what is left.
fn findings(sheet: &mut Sheet, large: &[Finding], summary: &str, small: &[Finding], most: usize) {
    let size = sheet.size();
    let wide = |text: fn(&Finding) -> &String| {
        let widths = large.iter().map(|f| letters::width(text(f), Font::Plain) * size);
        widths.fold(0.0, f32::max)
    };
    let name = 2.0 * size;
    let error = name + wide(|f| &f.name) + GAP * size;
    let bar = error + wide(|f| &f.error) + GAP * size;
    for (k, finding) in large.iter().enumerate() {
        if k >= most.max(PARAMETERS) {
            sheet.paragraph(&format!("and {} more", large.len() - k), 2.0);
            break;
        }
        sheet.left(&finding.number.to_string(), 0.5 * size);
        sheet.left(&finding.name, name);
        sheet.left(&finding.error, error);
        sheet.bar(bar, BAR, finding.parts);
        sheet.left(&finding.less, bar + BAR + GAP * size);
        sheet.next();
        if k < most {
            sheet.paragraph(&finding.numbers(PARAMETERS), 2.0);
            if !finding.same.is_empty() {
                let same = finding.same.join(", ");
                sheet.paragraph(&format!("not distinguishable from: {same}"), 2.0);
            }
        }
    }
    if !small.is_empty() {
        sheet.paragraph(&capital(summary), 2.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sixty findings with a dozen parameters each.
    #[test]
    fn whatever_is_found_fits_on_the_sheet() {
        let finding = |number: usize| Finding {
            number,
            name: format!("transmission error at joint {number}"),
            said: String::new(),
            error: "1.046 → 0.217 mm".to_owned(),
            parts: [1.0, 0.2],
            less: "79 % less [73 to 84]".to_owned(),
            parameters: (0..12).map(|k| format!("cos {k} 0.803 mrad [0.798 to 0.808]")).collect(),
            evidence: String::new(),
            same: vec!["joint compliance at joint 2 (leaves 0.94 mil)".to_owned(); 20],
            next: None,
            advice: None,
        };
        let large: Vec<Finding> = (1..=60).map(finding).collect();
        let findings = Block::Findings { large, summary: String::new(), small: Vec::new() };
        let blocks = vec![Block::Sentence("A sentence. ".repeat(20)), findings];
        let robot = "An arm (with a bracket".to_owned();
        let document = Document { robot, about: "certificate", facts: "f".repeat(2000), blocks };
        let fits = |(detailed, size): &(usize, f32)| document.sheet(*detailed, *size).fits();
        assert!(!fits(&ATTEMPTS[0]) && ATTEMPTS.iter().any(fits));
        let bytes = document.pdf();
        assert!(bytes.starts_with(b"%PDF-1.") && bytes == document.pdf());
    }
}
