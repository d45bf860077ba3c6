//! The ledger as one HTML page that needs nothing else, light or dark as the reader's machine is.

use std::fmt::Write as _;

use super::ledger::Ledger;
use super::render::details;
use super::verdict::Verdict;

const STYLE: &str = "
:root { color-scheme: light dark; --line: light-dark(#ddd, #444);
  --ok: light-dark(#17643a, #7fd6a4); --bad: light-dark(#a3261d, #ff9d94);
  --mute: light-dark(#666, #aaa); }
body { font: 15px/1.5 system-ui, sans-serif; max-width: 72rem; margin: 2rem auto; padding: 0 1rem;
  background: light-dark(#fff, #16181b); color: light-dark(#1b1d20, #e6e6e6); }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin-top: 2.5rem; }
table { border-collapse: collapse; width: 100%; }
td { border-top: 1px solid var(--line); padding: .35rem .6rem .35rem 0; vertical-align: top; }
td:first-child { min-width: 6rem; max-width: 14rem; overflow-wrap: anywhere; } code { font-size: .85em; overflow-wrap: anywhere; }
.ok { color: var(--ok); } .bad { color: var(--bad); font-weight: 600; }
.mute { color: var(--mute); }
";

impl Ledger {
    /// A self-contained page.
    pub fn to_html(&self) -> String {
        let mut out =
            String::from("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
        let _ = write!(
            out,
            "<meta name=\"viewport\" content=\"width=device-width\">\n\
             <title>Printed equations against derived ones</title>\n\
             <style>{STYLE}</style>\n</head>\n\
             <body>\n<h1>Printed equations against derived ones</h1>\n"
        );
        for (id, title) in &self.titles {
            let _ = writeln!(
                out,
                "<h2>{}</h2>\n<p>{}.</p>",
                escaped(title),
                escaped(&self.summary(id))
            );
            out.push_str("<table>\n");
            for entry in self.paper(id) {
                let class = match entry.verdict {
                    Verdict::Agrees | Verdict::AgreesAtPoints | Verdict::Reproduced => "ok",
                    Verdict::Definition | Verdict::Given | Verdict::Close => "mute",
                    _ => "bad",
                };
                let _ = write!(
                    out,
                    "<tr><td>{}</td><td class=\"{class}\">{}</td><td><code>{}</code>",
                    escaped(&entry.number),
                    entry.verdict.words(),
                    escaped(&entry.printed)
                );
                for (name, text) in details(entry) {
                    let text = escaped(&text);
                    let _ = match name {
                        "correct" => write!(out, "<br>{name}: <code>{text}</code>"),
                        _ => write!(out, "<br><span class=\"mute\">{name}: {text}</span>"),
                    };
                }
                out.push_str("</td></tr>\n");
            }
            out.push_str("</table>\n");
        }
        out.push_str("</body>\n</html>\n");
        out
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::super::file::read;
    use super::*;

    #[test]
    fn the_page_is_whole_and_escaped() {
        let text = "paper = 'x'\ntitle = 'a < b'\n[[equation]]\nnumber = '(1)'\n\
            latex = 'y &= a'\ntruth = 'a'\n";
        let page = Ledger::of(&[read(text, "x").unwrap()]).to_html();
        assert!(page.contains("<h2>a &lt; b</h2>") && page.ends_with("</html>\n"));
        assert!(page.contains("<td class=\"ok\">agrees</td><td><code>y &amp;= a</code>"), "{page}");
        assert!(!page.contains("http"));
    }
}
