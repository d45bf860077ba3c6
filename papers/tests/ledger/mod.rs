//! The papers, equation by equation and cell by cell: what `stiffarm papers` prints is pinned, line
//! by line.

use std::sync::LazyLock;

use stiffarm_papers::{Entry, Ledger, Verdict, built_in, column, read};

static WHOLE: LazyLock<Ledger> =
    LazyLock::new(|| Ledger::with(&built_in().unwrap_or_else(|e| panic!("{e}")), &column));

#[test]
fn the_ledger_is_pinned() {
    insta::assert_snapshot!(WHOLE.to_text());
}

#[test]
fn nothing_is_left_unjudged() {
    for Entry { number, verdict, correction, note, .. } in &WHOLE.entries {
        assert!(![Verdict::NotJudged, Verdict::Unreadable].contains(verdict), "{number}: {note:?}");
        assert!(*verdict != Verdict::Misprint || correction.is_some(), "{number}");
        // What cannot be reproduced says why.
        assert!(*verdict != Verdict::NotReproduced || note.is_some(), "{number}");
    }
}

#[test]
fn every_format_has_every_entry() {
    let (entries, page) = (WHOLE.entries.len(), WHOLE.to_html());
    assert_eq!(WHOLE.to_json().matches("\"verdict\":").count(), entries);
    assert_eq!(page.matches("<tr class=\"entry\">").count(), entries);
    // Every correction of a formula is set.
    for correction in page.split("<div>correct: ").skip(1) {
        let shown = correction.split('<').nth(1).unwrap_or_default();
        assert!(shown.starts_with("math "), "{shown}");
    }
    let rows = WHOLE.to_markdown().lines().filter(|line| line.starts_with("| ")).count();
    let tables: usize = WHOLE.titles.len() * 2;
    assert!(rows >= entries && rows <= entries + tables);
}

#[test]
fn a_formula_that_cannot_be_read_points_at_its_character() {
    let text = "paper = 'x'\n[[equation]]\nnumber = '(1)'\nlatex = 'y = (a + b))) c'\n\
        truth = 'a^5 + c'\n";
    let paper = read(text, "x.toml").unwrap_or_else(|e| panic!("{e}"));
    let ledger = Ledger::of(&[paper]);
    assert_eq!(ledger.entries[0].verdict, Verdict::Unreadable);
    let change = ledger.entries[0].change.clone().unwrap_or_default();
    assert!(
        change.starts_with("(1):1:12: `)` closes no bracket\n1 | y = (a + b))) c\n"),
        "{change}"
    );
}
