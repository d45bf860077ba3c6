//! `stiffarm effects`, and the page that it writes.

use serde_json::Value;
use stiffarm_gap::effects::{Entry, Law};

use crate::support::{flat, stiffarm};
use crate::workbench::same;

#[test]
fn the_page_is_the_catalogue() {
    same("docs/effects.md", &stiffarm(&["effects", "--markdown"]).good());
}

#[test]
fn every_effect_is_printed_with_what_it_says() {
    let found = stiffarm(&["effects", "--json"]).json();
    let found = found.as_array().expect("a list");
    let screen = stiffarm(&["effects"]).good();
    let joined = flat(&screen);
    let all = Entry::all();
    let laws: Vec<&dyn Law> = all.iter().flat_map(Entry::laws).collect();
    assert_eq!(found.len(), laws.len());
    for (entry, law) in found.iter().zip(laws) {
        assert_eq!(entry["effect"], law.identifier());
        assert!(!entry["places"].as_array().expect("a list").is_empty(), "{entry}");
        assert!(!entry["numbers"].as_array().expect("a list").is_empty(), "{entry}");
        let facts = law.facts();
        for said in [facts.reality, facts.signature, facts.confused_with, facts.separated_by] {
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
    assert!(out.contains("\n\nlatency  the interface; positions of a log\n"), "{out}");
    // A law by the name that findings in a log have, and the effect whose law it is.
    let of_log = stiffarm(&["effects", "servo_droop"]).good();
    assert_eq!(of_log, stiffarm(&["effects", "joint_compliance"]).good());
    assert!(of_log.contains("\n\nservo_droop  joint i; positions of a log\n"), "{of_log}");
    let friction = stiffarm(&["effects", "coulomb_friction"]).good();
    assert!(friction.starts_with("coulomb_friction  joint i; torques of a log\n"), "{friction}");
}
