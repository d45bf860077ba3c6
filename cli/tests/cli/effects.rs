//! `stiffarm effects`, and the page that it writes.

use stiffarm_gap::effects::{Entry, Law};

use crate::support::{flat, list, stiffarm};
use crate::workbench::same;

#[test]
fn the_page_is_the_catalogue() {
    same("docs/effects.md", &stiffarm(&["effects", "--markdown"]).good());
}

#[test]
fn every_effect_is_printed_with_what_it_says() {
    let found = stiffarm(&["effects", "--json"]).json();
    let found = list(&found);
    let screen = stiffarm(&["effects"]).good();
    let joined = flat(&screen);
    let all = Entry::all();
    let laws: Vec<&dyn Law> = all.iter().flat_map(Entry::laws).collect();
    assert_eq!(found.len(), laws.len());
    for (entry, law) in found.iter().zip(laws) {
        assert_eq!(entry["effect"], law.identifier());
        assert!(!list(&entry["places"]).is_empty(), "{entry}");
        assert!(!list(&entry["numbers"]).is_empty(), "{entry}");
        let facts = law.facts();
        for said in [facts.reality, facts.signature, facts.confused_with, facts.separated_by] {
            assert!(joined.contains(&said.replace('`', "")), "{said}");
        }
    }
    assert!(screen.lines().all(|line| line.chars().count() <= 100), "{screen}");
}
