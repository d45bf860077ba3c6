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

/// Entries of a paper with a verdict, by their numbers.
fn numbers(paper: &str, kind: &str, verdict: &str) -> Vec<&'static str> {
    let chosen = |e: &&Value| {
        (text(e, "paper"), text(e, "kind"), text(e, "verdict")) == (paper, kind, verdict)
    };
    LEDGER.iter().filter(chosen).map(|e| text(e, "number")).collect()
}

#[test]
fn the_ledger_is_pinned() {
    insta::assert_snapshot!(WHOLE.to_text());
}

#[test]
fn the_known_misprints_are_found_and_no_others() {
    let misprints = |paper| numbers(paper, "equation", "misprint");
    assert_eq!(
        misprints("dumas2011"),
        ["(11)", "(31) J_{32}", "(31) J_{33}", "(31) J_{34}", "(31) J_{35}"]
    );
    assert_eq!(
        misprints("knapczyk"),
        [
            "(1)",
            "K_C below (6)",
            "(A.1) to (A.3), prefactors",
            "(A.1) c_{11}, joint 2",
            "(A.2) c_{22}, joint 1",
            "(A.3) c_{33}, joint 2",
            "(A.3) c_{33}, joint 3",
            "(A.3) c_{33}, joint 4",
            "(A.3) c_{33}, joint 5",
        ]
    );
    assert_eq!(
        misprints("lin1991"),
        [
            "(28)",
            "(38)",
            "(45)",
            "App. dy_1, E_6I_6 term",
            "App. A",
            "App. B",
            "App. C",
            "App. D",
            "App. dy_2, E_4I_4 term",
            "App. dy_2, E_3I_3 term",
        ]
    );
    assert_eq!(
        misprints("jweeg2012"),
        ["(4)", "(13)", "(18) A_{31}", "(35)", "(37)", "(45)", "(47)", "(48)"]
    );
    assert_eq!(
        misprints("bicchi"),
        [
            "(5)",
            "(12)",
            "(14)",
            "sect. 4, p_kin, component 1",
            "sect. 4, p_kin, component 2",
            "sect. 4, p_kin, component 3",
            "sect. 4, p_joint, component 2",
            "sect. 4, p_joint, component 3",
            "sect. 4, R_joint",
            "sect. 4, T_i",
        ]
    );
}

/// Relations between matrices, and numbers that need a paper's whole method.
#[test]
fn relations_and_methods_are_judged() {
    for (paper, relation) in [
        ("dumas2011", "(8)"),
        ("dumas2011", "(9)"),
        ("dumas2011", "(10)"),
        ("knapczyk", "(5)"),
        ("bicchi", "(6)"),
        ("bicchi", "(11)"),
        ("bicchi", "(15)"),
        ("bicchi", "(18)"),
    ] {
        let found = numbers(paper, "equation", "agrees_at_points");
        assert!(found.contains(&relation), "{paper} {relation}: {found:?}");
    }
    let reproduced = |paper, number| numbers(paper, "cell", "reproduced").contains(&number);
    assert!(reproduced("dumas2011", "sect. 2.2 (L, m) printed"));
    assert!(reproduced("jweeg2012", "Figs. 14 and 15, p_y of p_x (p_y) m"));
    assert!(reproduced("bicchi", "case study 1, half the E I (m_z) B_e"));
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
