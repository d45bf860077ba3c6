//! The papers, equation by equation and cell by cell: what `stiffarm papers` prints is pinned, line
//! by line.

use std::sync::LazyLock;

use serde_json::Value;
use stiffarm_papers::{Ledger, Verdict, built_in, column, read};

static WHOLE: LazyLock<Ledger> =
    LazyLock::new(|| Ledger::with(&built_in().unwrap_or_else(|e| panic!("{e}")), &column));

static LEDGER: LazyLock<Vec<Value>> =
    LazyLock::new(|| serde_json::from_str(&WHOLE.to_json()).expect("a list of entries"));

fn text<'e>(entry: &'e Value, key: &str) -> &'e str {
    entry[key].as_str().unwrap_or_default()
}

#[test]
fn the_ledger_is_pinned() {
    insta::assert_snapshot!(WHOLE.to_text());
}

#[test]
fn nothing_is_left_unjudged() {
    for entry in LEDGER.iter() {
        let (number, verdict) = (text(entry, "number"), text(entry, "verdict"));
        assert!(!["not_judged", "unreadable"].contains(&verdict), "{number}: {entry}");
        assert!(verdict != "misprint" || entry["correction"].is_string(), "{number}");
        // What cannot be reproduced says why.
        assert!(verdict != "not_reproducible" || entry["note"].is_string(), "{number}");
    }
}

#[test]
fn every_format_has_every_entry() {
    let files = ["bicchi/equations.toml", "bicchi/tables/cases.toml", "knapczyk/equations.toml"];
    let papers = files.map(|file| {
        let path = format!("{}/data/{file}", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).expect("a data file");
        read(&text, file).unwrap_or_else(|error| panic!("{error}"))
    });
    let ledger = Ledger::of(&papers);
    let entries = ledger.entries.len();
    assert_eq!(ledger.to_json().matches("\"verdict\":").count(), entries);
    assert_eq!(ledger.to_html().matches("<tr class=\"entry\">").count(), entries);
    // Every correction of a formula is set.
    for correction in WHOLE.to_html().split("<div>correct: ").skip(1) {
        let shown = correction.split('<').nth(1).unwrap_or_default();
        assert!(shown.starts_with("math "), "{shown}");
    }
    let rows = ledger.to_markdown().lines().filter(|line| line.starts_with("| ")).count();
    let tables: usize = ledger.titles.len() * 2;
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
