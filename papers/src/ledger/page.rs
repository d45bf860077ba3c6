//! The ledger as one HTML page that needs nothing else, light or dark as the reader's machine is.
//! It opens with what is wrong; what agrees is folded away below.

use askama::Template;

use super::render::details;
use crate::ledger::Ledger;
use crate::verdict::{Entry, Kind, Verdict};

/// The parts of the page below the misprints: a heading, and what stands under it.
const FOLDED: [(&str, Kind, &[Verdict]); 3] = [
    ("Equations that agree", Kind::Equation, &[Verdict::Agrees, Verdict::AgreesAtPoints]),
    ("Definitions", Kind::Equation, &[Verdict::Definition]),
    (
        "Table cells",
        Kind::Cell,
        &[Verdict::Reproduced, Verdict::Close, Verdict::Given, Verdict::NotJudged],
    ),
];

/// A heading and what stands under it.
type Headed<'l, T> = (&'l str, Vec<T>);

#[derive(Template)]
#[template(path = "ledger.html")]
struct Page<'l> {
    sentence: String,
    /// Title and counts of each paper.
    overview: Vec<(&'l str, String)>,
    csv: String,
    wrong: Vec<Headed<'l, Row<'l>>>,
    papers: Vec<Headed<'l, Headed<'static, Row<'l>>>>,
}

/// An entry.
struct Row<'l> {
    entry: &'l Entry,
    class: &'static str,
    printed: Vec<Part>,
    /// The class of each further line, and the line.
    lines: Vec<(&'static str, Vec<Part>)>,
}

/// A piece of text, some of it formulas in LaTeX.
enum Part {
    Plain(String),
    Code(String),
    Math(String),
}

impl Ledger {
    /// A self-contained page.
    pub fn to_html(&self) -> String {
        let each = || self.titles.iter().map(|(id, title)| (id, title.as_str()));
        let wrong = each().filter_map(|(id, title)| {
            let wrong = rows(self.paper(id).filter(|entry| !folded(entry)));
            (!wrong.is_empty()).then_some((title, wrong))
        });
        let papers = each().map(|(id, title)| {
            let parts = FOLDED.iter().filter_map(|(heading, kind, verdicts)| {
                let chosen = |e: &&Entry| e.kind == *kind && verdicts.contains(&e.verdict);
                let rows = rows(self.paper(id).filter(chosen));
                (!rows.is_empty()).then_some((*heading, rows))
            });
            (title, parts.collect())
        });
        let page = Page {
            sentence: self.sentence(),
            overview: each().map(|(id, title)| (title, self.summary(id))).collect(),
            csv: percent_encoded(&self.to_csv()),
            wrong: wrong.collect(),
            papers: papers.collect(),
        };
        // Piece to memory, by a template that was checked when it was compiled.
        page.render().unwrap_or_default()
    }

    /// What a reader has to know.
    fn sentence(&self) -> String {
        let of = |kind: Kind| {
            let all = self.entries.iter().filter(|e| e.kind == kind);
            (all.clone().filter(|e| !folded(e)).count(), all.count())
        };
        let ((equations, printed), (cells, tables)) = (of(Kind::Equation), of(Kind::Cell));
        format!(
            "Not right as printed: {equations} of {printed} equations and {cells} of {tables} table \
             cells. They come first, each with its correction or the reason."
        )
    }

    /// A line for each entry.
    fn to_csv(&self) -> String {
        let mut out = "paper,number,kind,verdict,printed,details\n".to_owned();
        for entry in &self.entries {
            let kind = match entry.kind {
                Kind::Equation => "equation",
                Kind::Cell => "table cell",
            };
            let details: Vec<String> =
                details(entry).iter().map(|(name, text)| format!("{name}: {text}")).collect();
            let (verdict, details) = (entry.verdict.words(), details.join("; "));
            let cells = [&entry.paper, &entry.number, kind, verdict, &entry.printed, &details];
            let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
            out.push_str(&cells.map(quoted).join(","));
            out.push('\n');
        }
        out
    }
}

/// Text as it may stand in an address.
fn percent_encoded(text: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-._~,;:()=+*/".contains(&byte);
    let of = |byte: u8| match plain(byte) {
        true => char::from(byte).to_string(),
        false => format!("%{byte:02X}"),
    };
    text.bytes().map(of).collect()
}

/// Whether an entry stands below, folded away.
fn folded(entry: &Entry) -> bool {
    FOLDED
        .iter()
        .any(|(_, kind, verdicts)| entry.kind == *kind && verdicts.contains(&entry.verdict))
}

fn rows<'l>(entries: impl Iterator<Item = &'l Entry>) -> Vec<Row<'l>> {
    let mut told = None;
    let row = |entry: &'l Entry| {
        let class = match entry.verdict {
            Verdict::Agrees | Verdict::AgreesAtPoints | Verdict::Reproduced => "ok",
            Verdict::Definition | Verdict::Given | Verdict::Close => "mute",
            _ => "bad",
        };
        let printed = match entry.kind {
            Kind::Equation => Part::Math(entry.printed.clone()),
            Kind::Cell => Part::Plain(entry.printed.clone()),
        };
        let mut lines = Vec::new();
        for (name, text) in details(entry) {
            // A note on a whole table is told once.
            if name == "note" && entry.kind == Kind::Cell {
                if told == entry.note {
                    continue;
                }
                told.clone_from(&entry.note);
            }
            match name {
                "correct" => lines.extend(text.split("; ").map(correction)),
                _ => lines.push(("mute", ticked(&format!("{name}: {text}")))),
            }
        }
        Row { entry, class, printed: vec![printed], lines }
    };
    entries.map(row).collect()
}

/// A correction: a formula, or that of an entry of a matrix which is wrong.
fn correction(text: &str) -> (&'static str, Vec<Part>) {
    let (place, formula) = match text.split_once(": ") {
        Some((place, formula)) if place.contains("entry ") => (format!("{place} "), formula),
        _ => (String::new(), text),
    };
    ("", vec![Part::Plain(format!("correct: {place}")), Part::Math(formula.to_owned())])
}

/// Text in which formulas, and single signs of them, stand between backticks.
fn ticked(text: &str) -> Vec<Part> {
    let part = |(k, part): (usize, &str)| match k % 2 {
        1 if part.contains(['\\', '_', '^']) => Part::Math(part.to_owned()),
        1 => Part::Code(part.to_owned()),
        _ => Part::Plain(part.to_owned()),
    };
    text.split('`').enumerate().map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::read;

    #[test]
    fn the_page_is_whole_and_escaped_and_opens_with_what_is_wrong() {
        let text = "paper = 'x'\ntitle = 'a < b'\n\
            [[equation]]\nnumber = '(1)'\nlatex = 'y &= a'\ntruth = 'a'\n\
            [[equation]]\nnumber = '(2)'\nlatex = 'y = a - b'\ntruth = 'a + b'\n";
        let page = Ledger::of(&[read(text, "x").unwrap()]).to_html();
        assert!(page.contains("<h2>a &#60; b</h2>") && page.ends_with("</html>\n"));
        assert!(page.contains(">Not right as printed: 1 of 2 equations and 0 of 0 table cells."));
        assert!(
            page.contains("%0A%22x%22,%22(2)%22,%22equation%22,%22misprint%22,%22y%20=%20a%20-")
        );
        assert_eq!(page.matches("<tr class=\"entry\">").count(), 2);
        let (wrong, right) = (page.find("<td>(2)</td>"), page.find("<td>(1)</td>"));
        assert!(wrong < right, "{page}");
        assert!(page.contains("Equations that agree (1)"));
        assert!(page.contains("<div>correct: <math "));
        assert!(page.contains("sign: <code>-</code> → <code>+</code> before <code>b</code>"));
        assert!(page.contains("encoding=\"application/x-tex\">y &#38;= a</annotation>"), "{page}");
        assert!(!page.contains("http"));
    }
}
