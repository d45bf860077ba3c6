//! `stiffarm papers`.

use serde_json::Value;

use crate::support::{Folder, stiffarm, text};

#[test]
fn the_built_in_ledger_names_the_misprints() {
    let out = stiffarm(&["papers"]).good();
    for piece in ["Dumas", "Knapczyk", "Lin", "Jweeg", "Bicchi", "misprint", "reproduced"] {
        assert!(out.contains(piece), "{piece} is missing");
    }
    let found: Value = serde_json::from_str(&stiffarm(&["papers", "--json"]).good()).expect("JSON");
    assert!(found.is_object() || found.is_array());
}

#[test]
fn a_file_of_ones_own_is_judged_and_written() {
    let folder = Folder::new();
    let page = text(&folder.path("ledger.html"));
    let own = "tests/papers/knapczyk/equations.toml";
    assert_eq!(stiffarm(&["papers", own, "--html", &page]).good(), "");
    let html = std::fs::read_to_string(page).expect("written");
    assert!(html.contains("<html") && !html.contains("http://") && !html.contains("src=\"//"));
    assert!(stiffarm(&["papers", own, "--markdown"]).good().contains('|'));
}

#[test]
fn what_cannot_be_read_is_pointed_at() {
    let folder = Folder::new();
    let missing = text(&folder.path("nothing.toml"));
    assert!(stiffarm(&["papers", &missing]).refused().contains("nothing.toml"));
    let wrong = folder.path("wrong.toml");
    std::fs::write(&wrong, "id = 3\n").expect("written");
    assert!(stiffarm(&["papers", &text(&wrong)]).refused().contains("wrong.toml:1"));
}
