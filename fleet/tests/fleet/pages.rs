//! The page of a fleet whose truth is known.

use std::fs;

use crate::campaigns::{OPTIONS, campaigns, write};
use crate::failures::fleet;

/// Seven arms with springs from 2 to 3.2e-6, the last of which was as stiff as the first a campaign before.
#[test]
fn a_page_says_what_was_put_in() {
    let folder = tempfile::tempdir().unwrap();
    let mut all = campaigns(&["kuka_kr240"], 7, 24);
    let before = campaigns(&["kuka_kr240"], 1, 24).pop().unwrap();
    all[6].name = "2026-Q2".to_owned();
    let arm = all[6].arm.clone();
    all.push(crate::campaigns::Campaign { arm, ..before });
    let mut bad = campaigns(&["kuka_kr240"], 1, 6).pop().unwrap();
    bad.arm = "bad".to_owned();
    bad.text = bad.text.lines().take(2).map(|line| format!("{line}\n")).collect();
    all.push(bad);
    write(&folder.path().join("runs"), &all);
    let page = folder.path().join("fleet.html");
    let runs = format!("runs={}", folder.path().join("runs").display());
    let options = format!("--options={OPTIONS}");
    let words = ["report", "--table", &runs, &options, "--out", page.to_str().unwrap()];
    let made = fleet(&words);
    assert!(made.status.success(), "{made:?}");
    let page = fs::read_to_string(&page).unwrap();
    for says in [
        "7 arms, 9 campaigns",
        "joint compliance at joint 2, 7 of 7 arms",
        "<td>7 of 7</td>",
        "2026-Q1, 2026-Q2",
        "<td>bad</td>",
    ] {
        assert!(page.contains(says), "{says}");
    }
    assert!(!page.contains("http"), "something is fetched");
}
