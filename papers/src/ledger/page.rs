//! The ledger as one HTML page that needs nothing else, light or dark as the reader's machine is.
//! It opens with what is wrong; what agrees is folded away below.

use std::fmt::Write as _;

use super::escape::escaped;
use super::mathml::math;
use super::render::details;
use super::verdict::{Entry, Kind, Verdict};
use crate::ledger::Ledger;

const STYLE: &str = "
:root { color-scheme: light dark; --line: light-dark(#ddd, #444);
  --ok: light-dark(#17643a, #7fd6a4); --bad: light-dark(#a3261d, #ff9d94);
  --mute: light-dark(#666, #aaa); }
body { font: 15px/1.5 system-ui, sans-serif; max-width: 72rem; margin: 2rem auto; padding: 0 1rem;
  background: light-dark(#fff, #16181b); color: light-dark(#1b1d20, #e6e6e6); }
h1 { font-size: 1.5rem; } h2 { font-size: 1.25rem; margin-top: 2.5rem; } h3 { font-size: 1rem; }
table { border-collapse: collapse; width: 100%; table-layout: fixed; }
th { text-align: left; font-weight: 600; }
td, th { border-top: 1px solid var(--line); padding: .35rem .6rem .35rem 0; vertical-align: top; }
td { overflow-wrap: anywhere; } td:first-child { width: 11rem; }
td.verdict { width: 8rem; } td > div { overflow: auto hidden; max-width: 100%; padding: .1rem 0; }
code { font-size: .85em; overflow-wrap: anywhere; } summary { cursor: pointer; margin: .5rem 0; }
math .bold { font-weight: bold; } math .lines > mtr > mtd { text-align: left; }
.overview th { width: 30rem; max-width: 50%; }
.sentence { font-size: 1.3rem; font-weight: 600; line-height: 1.35; text-wrap: pretty; }
.skip { position: absolute; left: -100rem; } .skip:focus { left: 1rem; }
button { font: inherit; float: right; } a { color: inherit; }
.ok { color: var(--ok); } .bad { color: var(--bad); font-weight: 600; }
.mute { color: var(--mute); }
@media print { :root { color-scheme: light; } button, .skip { display: none; }
  tr { break-inside: avoid; } }
@media (max-width: 40rem) { td:first-child { width: 6rem; } td.verdict { width: 5rem; } }
";

/// Switches between light and dark.
const SCRIPT: &str = "
const theme = document.getElementById('theme');
const media = window.matchMedia('(prefers-color-scheme: dark)');
let dark = media.matches;
const show = () => theme.setAttribute('aria-pressed', String(dark));
theme.addEventListener('click', () => {
  dark = !dark;
  document.documentElement.style.colorScheme = dark ? 'dark' : 'light';
  show();
});
show();
";

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

impl Ledger {
    /// A self-contained page.
    pub fn to_html(&self) -> String {
        let mut out =
            String::from("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
        let _ = write!(
            out,
            "<meta name=\"viewport\" content=\"width=device-width\">\n\
             <title>Printed equations against derived ones</title>\n\
             <link rel=\"icon\" href=\"data:,\">\n<style>{STYLE}</style>\n</head>\n\
             <body>\n<a class=\"skip\" href=\"#wrong\">Skip to what is wrong</a>\n\
             <button id=\"theme\" type=\"button\" aria-pressed=\"false\">Dark</button>\n\
             <h1>Printed equations against derived ones</h1>\n\
             <p id=\"sentence\" class=\"sentence\">{}</p>\n",
            self.sentence()
        );
        self.overview(&mut out);
        let _ = writeln!(
            out,
            "<p><a download=\"ledger.csv\" href=\"data:text/csv;charset=utf-8,{}\">All of it as \
             CSV</a></p>",
            percent_encoded(&self.to_csv())
        );
        out.push_str("<h2 id=\"wrong\">What is wrong</h2>\n");
        let none = |entry: &&Entry| !folded(entry);
        for (id, title) in &self.titles {
            let wrong: Vec<&Entry> = self.paper(id).filter(none).collect();
            if !wrong.is_empty() {
                let _ = writeln!(out, "<h3>{}</h3>", escaped(title));
                table(&mut out, &wrong);
            }
        }
        for (id, title) in &self.titles {
            let _ = writeln!(out, "<h2>{}</h2>", escaped(title));
            for (heading, kind, verdicts) in FOLDED {
                let chosen = |e: &&Entry| e.kind == kind && verdicts.contains(&e.verdict);
                let entries: Vec<&Entry> = self.paper(id).filter(chosen).collect();
                if !entries.is_empty() {
                    let count = entries.len();
                    let _ = writeln!(out, "<details><summary>{heading} ({count})</summary>");
                    table(&mut out, &entries);
                    out.push_str("</details>\n");
                }
            }
        }
        let _ = write!(out, "<script>{SCRIPT}</script>\n</body>\n</html>\n");
        out
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
            out.push_str(&cells.map(quoted).join(","));
            out.push('\n');
        }
        out
    }

    /// The counts of each paper.
    fn overview(&self, out: &mut String) {
        out.push_str("<table class=\"overview\">\n");
        for (id, title) in &self.titles {
            let (title, summary) = (escaped(title), escaped(&self.summary(id)));
            let _ = writeln!(out, "<tr><th>{title}</th><td>{summary}</td></tr>");
        }
        out.push_str("</table>\n");
    }
}

/// A cell of a CSV file.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

/// Text as it may stand in an address.
fn percent_encoded(text: &str) -> String {
    let mut out = String::with_capacity(2 * text.len());
    for byte in text.bytes() {
        if byte.is_ascii_alphanumeric() || b"-._~,;:()=+*/".contains(&byte) {
            out.push(char::from(byte));
        } else {
            let _ = write!(out, "%{byte:02X}");
        }
    }
    out
}

/// Whether an entry stands below, folded away.
fn folded(entry: &Entry) -> bool {
    FOLDED
        .iter()
        .any(|(_, kind, verdicts)| entry.kind == *kind && verdicts.contains(&entry.verdict))
}

fn table(out: &mut String, entries: &[&Entry]) {
    out.push_str("<table>\n");
    let mut told = None;
    for entry in entries {
        let class = match entry.verdict {
            Verdict::Agrees | Verdict::AgreesAtPoints | Verdict::Reproduced => "ok",
            Verdict::Definition | Verdict::Given | Verdict::Close => "mute",
            _ => "bad",
        };
        let number = escaped(&entry.number);
        let printed = match entry.kind {
            Kind::Equation => format!("<div>{}</div>", math(&entry.printed)),
            Kind::Cell => escaped(&entry.printed),
        };
        let _ = write!(
            out,
            "<tr class=\"entry\"><td>{number}</td>\
             <td class=\"verdict {class}\">{}</td><td>{printed}",
            entry.verdict.words(),
        );
        for (name, text) in details(entry) {
            // A note on a whole table is told once.
            if name == "note" && entry.kind == Kind::Cell {
                if told == entry.note {
                    continue;
                }
                told.clone_from(&entry.note);
            }
            let _ = match name {
                "correct" => write!(out, "{}", correction(&text)),
                _ => write!(out, "<div class=\"mute\">{name}: {}</div>", ticked(&text)),
            };
        }
        out.push_str("</td></tr>\n");
    }
    out.push_str("</table>\n");
}

/// A correction: a formula, or one for each entry of a matrix that is wrong.
fn correction(text: &str) -> String {
    let mut out = String::new();
    for part in text.split("; ") {
        let (place, formula) = match part.split_once(": ") {
            Some((place, formula)) if place.contains("entry ") => (place, formula),
            _ => ("", part),
        };
        let place = if place.is_empty() { String::new() } else { format!("{} ", escaped(place)) };
        let _ = write!(out, "<div>correct: {place}{}</div>", math(formula));
    }
    out
}

/// Text in which formulas, and single signs of them, stand between backticks.
fn ticked(text: &str) -> String {
    let set = |(k, part): (usize, &str)| match k % 2 {
        1 if part.contains(['\\', '_', '^']) => math(part),
        1 => format!("<code>{}</code>", escaped(part)),
        _ => escaped(part),
    };
    text.split('`').enumerate().map(set).collect()
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
        assert!(page.contains("<h2>a &lt; b</h2>") && page.ends_with("</html>\n"));
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
        assert!(page.contains("encoding=\"application/x-tex\">y &amp;= a</annotation>"), "{page}");
        assert!(!page.contains("http"));
    }
}
