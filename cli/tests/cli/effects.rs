//! `stiffarm effects`, and the page that it writes.

use serde_json::Value;
use stiffarm_gap::effects::CATALOGUE;

use crate::support::stiffarm;
use crate::workbench::same;

#[test]
fn the_page_is_the_catalogue() {
    same("docs/effects.md", &stiffarm(&["effects", "--markdown"]).good());
}

#[test]
fn every_effect_is_printed_with_what_it_says() {
    let found: Value =
        serde_json::from_str(&stiffarm(&["effects", "--json"]).good()).expect("JSON");
    let found = found.as_array().expect("a list");
    let screen = stiffarm(&["effects"]).good();
    let joined = screen.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(found.len(), CATALOGUE.len());
    for (entry, effect) in found.iter().zip(CATALOGUE) {
        assert_eq!(entry["effect"], effect.identifier());
        assert!(!entry["places"].as_array().expect("a list").is_empty(), "{entry}");
        let about = effect.about();
        for said in [about.reality, about.signature, about.confused_with, about.separated_by] {
            assert!(joined.contains(&said.replace('`', "")), "{said}");
        }
    }
    assert!(screen.lines().all(|line| line.chars().count() <= 100), "{screen}");
}

#[test]
fn some_are_printed_alone() {
    let out = stiffarm(&["effects", "transmission_error", "latency"]).good();
    assert!(out.starts_with("transmission_error  joint i\n"), "{out}");
    assert!(out.contains("numbers        order, cos (rad), sin (rad)\n"), "{out}");
    assert!(out.contains("\n\nlatency  instrument\n") && out.contains("delay (s)"), "{out}");
    let err = stiffarm(&["effects", "latncy"]).refused();
    assert!(
        err.contains("`latncy`; did you mean `latency`?") && err.contains("backlash,"),
        "{err}"
    );
}
