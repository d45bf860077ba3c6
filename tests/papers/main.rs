//! The papers, equation by equation and cell by cell: the ledger is pinned, line by line.

use std::sync::LazyLock;

use stiffarm_codegen::paper::{Entry, Kind, Ledger, Verdict, builtin};

static LEDGER: LazyLock<Ledger> =
    LazyLock::new(|| builtin::ledger().unwrap_or_else(|error| panic!("{error}")));

fn ledger() -> &'static Ledger {
    &LEDGER
}

/// Entries of a paper with a verdict, by their numbers.
fn numbers(ledger: &Ledger, paper: &str, kind: Kind, verdict: &Verdict) -> Vec<String> {
    let chosen = |e: &&Entry| e.kind == kind && e.verdict == *verdict;
    ledger.paper(paper).filter(chosen).map(|e| e.number.clone()).collect()
}

#[test]
fn the_ledger_is_pinned() {
    insta::assert_snapshot!(ledger().to_text());
}

#[test]
fn the_known_misprints_are_found_and_no_others() {
    let ledger = ledger();
    let misprints = |paper| numbers(ledger, paper, Kind::Equation, &Verdict::Misprint);
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
    let bicchi = misprints("bicchi");
    for part in ["(5)", "(12)", "(14)", "p_kin", "p_joint", "R_joint", "T_i"] {
        assert!(bicchi.iter().any(|number| number.contains(part)), "{part}: {bicchi:?}");
    }
}

#[test]
fn nothing_is_left_unjudged() {
    let ledger = ledger();
    for entry in &ledger.entries {
        let open = matches!(entry.verdict, Verdict::NotJudged | Verdict::Unreadable);
        assert!(!open, "{} {}: {:?}", entry.paper, entry.number, entry.note);
        let corrected = entry.verdict != Verdict::Misprint || entry.correction.is_some();
        assert!(corrected, "{} {}", entry.paper, entry.number);
    }
}

#[test]
fn every_format_has_every_entry() {
    let ledger = ledger();
    let entries = ledger.entries.len();
    assert_eq!(ledger.to_json().matches("\"verdict\":").count(), entries);
    assert_eq!(ledger.to_html().matches("<tr>").count(), entries);
    let rows = ledger.to_markdown().lines().filter(|line| line.starts_with("| ")).count();
    let tables: usize = ledger.titles.len() * 2;
    assert!(rows >= entries && rows <= entries + tables);
}

#[test]
fn a_formula_that_cannot_be_read_points_at_its_character() {
    let text = "paper = 'x'\n[[equation]]\nnumber = '(1)'\nlatex = 'y = (a + b))) c'\n\
        truth = 'a^5 + c'\n";
    let paper = stiffarm_codegen::paper::read(text, "x.toml").unwrap_or_else(|e| panic!("{e}"));
    let ledger = Ledger::of(&[paper]);
    assert_eq!(ledger.entries[0].verdict, Verdict::Unreadable);
    let change = ledger.entries[0].change.clone().unwrap_or_default();
    assert!(
        change.starts_with("(1):1:12: `)` closes no bracket\n1 | y = (a + b))) c\n"),
        "{change}"
    );
}
