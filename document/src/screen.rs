//! A document on a terminal.

use super::{Block, Cell, Document, Finding, Table};
use crate::text::{Align, bad, bar, bold, dim, good, indented, left_bar, listed, table, wrapped};
use crate::words::{capital, share};

/// Width of the screen.
const WIDTH: usize = 100;

/// Width of the bars of a table.
const BAR: usize = 12;

/// Width of a finding's bar.
const NARROW: usize = 12;

/// Where the text beside the names of notes begins.
const MARGIN: usize = 14;

/// Where the details of a finding begin.
const DETAIL: usize = 5;

/// Findings that are shown with their evidence, where nothing else is asked for.
pub const TOP: usize = 4;

/// Entries of a list before the rest is counted.
const MOST: usize = 4;

/// Parameters of a finding before the rest is counted; a calibration has dozens.
const MOST_PARAMETERS: usize = 8;

/// Places with a smaller share are not shown.
const LEAST: f64 = 0.01;

impl Document {
    /// The document as text; the first `top` findings with their evidence, of [`usize::MAX`] all that there is.
    pub fn text(&self, top: usize) -> String {
        let facts = dim(wrapped(&self.facts, WIDTH, 2).trim_end());
        let head = format!("{}\n{facts}\n", bold(&self.robot));
        let mut text = head;
        let mut last = None;
        for block in &self.blocks {
            let next = block.text(top);
            if next.is_empty() {
                continue;
            }
            if !last.is_some_and(|last: &Block| last.runs_on_to(block)) {
                text.push('\n');
            }
            text.push_str(&next);
            last = Some(block);
        }
        text
    }
}

impl Block {
    /// Whether no line stands between two blocks.
    fn runs_on_to(&self, next: &Block) -> bool {
        let is_note = |block: &Block| matches!(block, Block::Note { .. } | Block::Shares { .. });
        let is_said = |block: &Block| matches!(block, Block::Sentence(_) | Block::Verdict(..));
        is_note(self) && is_note(next) || is_said(self) && is_said(next)
    }

    fn text(&self, top: usize) -> String {
        let all = top == usize::MAX;
        match self {
            Block::Sentence(text) | Block::Paragraph(text) => wrapped(text, WIDTH, 0),
            Block::Verdict(passed, text) => {
                let text = wrapped(text, WIDTH, 0);
                let text = text.trim_end();
                let toned = match passed {
                    Some(true) => good(text),
                    Some(false) => bad(text),
                    None => text.to_owned(),
                };
                toned + "\n"
            }
            Block::Section { heading, remark, blocks } => section(heading, remark, blocks, top),
            Block::Note { name, lines, most } => {
                let most = if all { lines.len() } else { *most };
                let mut text = String::new();
                for (k, line) in lines.iter().take(most).enumerate() {
                    text.push_str(&note(if k == 0 { name } else { "" }, line));
                }
                match lines.len().saturating_sub(most) {
                    0 => text,
                    rest => text + &note("", &format!("and {rest} more: --all")),
                }
            }
            Block::Shares { name, shares, remark } => {
                let shown = shares.iter().filter(|(_, part)| all || *part >= LEAST);
                let shown: Vec<String> =
                    shown.map(|(place, part)| format!("{place} {}", share(*part))).collect();
                let most = if all { shown.len() } else { MOST };
                match shown.is_empty() {
                    true => String::new(),
                    false => note(name, &format!("{} ({remark})", listed(&shown, most))),
                }
            }
            Block::List(entries) => entries.iter().map(|e| wrapped(e, WIDTH - 2, 2)).collect(),
            Block::Table(rows) => rows.text(""),
            Block::Findings { large, summary, small } => findings(large, summary, small, top),
            Block::Document(document, _) => document.text(top),
            Block::Facts(_) | Block::Csv(_) | Block::Json | Block::Figure(..) | Block::Page(_) => {
                String::new()
            }
        }
    }
}

/// A heading and what stands below it; of a table its heads stand beside the heading. What only a page
/// shows has no heading on a screen.
fn section(heading: &str, remark: &str, blocks: &[Block], top: usize) -> String {
    if let ([Block::Table(first), rest @ ..], "") = (blocks, remark) {
        return first.text(heading) + &below(rest, top);
    }
    let text = below(blocks, top);
    let heading = match remark {
        "" => bold(heading),
        remark => format!("{}  {}", bold(heading), dim(remark)),
    };
    if text.is_empty() { text } else { wrapped(&heading, WIDTH, 2) + &text }
}

fn below(blocks: &[Block], top: usize) -> String {
    blocks.iter().map(|block| indented(&block.text(top), 2)).collect()
}

impl Table {
    /// In aligned columns below `heading`, which stands out to the left.
    fn text(&self, heading: &str) -> String {
        let heads = self.heads.iter().skip(1).map(dim);
        let mut rows = vec![std::iter::once(bold(heading)).chain(heads).collect::<Vec<_>>()];
        rows.extend(self.rows.iter().map(|row| row.iter().map(Cell::text).collect()));
        let align = |is_number| if is_number { Align::Right } else { Align::Left };
        let lines = table(&rows, &self.columns().into_iter().map(align).collect::<Vec<_>>());
        let (head, rest) = lines.split_once('\n').unwrap_or((&lines, ""));
        format!("{}\n{}", head.replacen("  ", "    ", 1), indented(rest, 2))
    }
}

impl Cell {
    /// As it stands on a screen.
    pub(super) fn text(&self) -> String {
        match self {
            Cell::Text(text) | Cell::Number(text) | Cell::Shade(_, text) => text.clone(),
            Cell::Bar(part) => bar(*part, BAR),
            Cell::Judged(true, text) => good(text),
            Cell::Judged(false, text) => bad(text),
        }
    }
}

fn findings(large: &[Finding], summary: &str, small: &[Finding], top: usize) -> String {
    let shown: Vec<&Finding> = large.iter().chain(small).take(large.len().max(top)).collect();
    let row = |f: &&Finding| {
        let [before, after] = f.parts;
        vec![
            f.number.to_string(),
            good(&f.name),
            f.error.clone(),
            left_bar(before, after, NARROW),
            f.less.clone(),
        ]
    };
    let rows: Vec<Vec<String>> = shown.iter().map(row).collect();
    let mut text = String::new();
    for (k, (line, finding)) in table(&rows, &[Align::Right]).lines().zip(&shown).enumerate() {
        text.push_str(&format!("{line}\n"));
        let most = if top == usize::MAX { top } else { MOST_PARAMETERS };
        text.push_str(&paragraph(&finding.numbers(most)));
        if k < top {
            text.push_str(&evidence(finding, top == usize::MAX));
        }
    }
    if large.len() > top {
        text.push_str(&format!("The evidence of the others: --top {} or --all\n", large.len()));
    }
    if shown.len() == large.len() && !summary.is_empty() && top != usize::MAX {
        text.push_str(&wrapped(&format!("{}: --all", capital(summary)), WIDTH - 2, 2));
    }
    text
}

/// What speaks for a finding, and what is not distinguishable from it.
fn evidence(finding: &Finding, all: bool) -> String {
    let mut evidence = finding.evidence.clone();
    let next = finding.next.as_ref().filter(|_| finding.same.is_empty());
    evidence.extend(next.map(|next| format!("; next best: {next}")));
    let mut text = paragraph(&evidence);
    if !finding.same.is_empty() {
        let names = listed(&finding.same, if all { usize::MAX } else { MOST });
        text.push_str(&paragraph(&format!("{}: {names}", bad("not distinguishable from"))));
    }
    if let Some(advice) = &finding.advice {
        text.push_str(&paragraph(&format!("to separate them: {advice}")));
    }
    text
}

fn paragraph(text: &str) -> String {
    let margin = " ".repeat(DETAIL - 2);
    wrapped(&format!("{margin}{text}"), WIDTH - 2, DETAIL)
}

/// A remark with its name in front.
fn note(name: &str, text: &str) -> String {
    let pad = " ".repeat(MARGIN.saturating_sub(name.len()));
    let head = if name.is_empty() { String::new() } else { bold(name) };
    wrapped(&format!("{head}{pad}{text}"), WIDTH, MARGIN)
}
