//! Texts to be read: a change shows up as a difference of `snapshots/`.
//!
//! `INSTA_UPDATE=always cargo test -p stiffarm --test text` accepts it.

use stiffarm_codegen::emit::{RustOptions, rust};

use crate::tables::table;

/// Two links in a plane, the lengths and the first spring symbolic.
const PLANAR: &str = "
    mod planar;
    name: \"Planar 2R\";
    convention: standard_dh;
    joint | theta | d | a  | alpha | stiffness
    j1    | q     | 0 | L1 | 0     | k1
    j2    | q     | 0 | L2 | 0     | 2e5 N*m/rad
";

fn text() -> String {
    rust(&table(PLANAR.parse().expect("tokens")), &RustOptions::default())
}

/// From one line that begins so to the next that begins so.
fn part(text: &str, from: &str, to: &str) -> String {
    let start = text.find(from).unwrap_or_else(|| panic!("no `{from}`"));
    let end = text[start..].find(to).map_or(text.len(), |end| start + end);
    text[start..end].to_owned()
}

#[test]
fn the_head_reads_like_the_table() {
    insta::assert_snapshot!(part(&text(), "// Planar 2R", "/// Pose of the tool"));
}

#[test]
fn the_jacobian_reads_like_a_textbook() {
    insta::assert_snapshot!(part(
        &text(),
        "/// Geometric Jacobian, base axes",
        "/// Geometric Jacobian, tool axes"
    ));
}

#[test]
fn the_deflection_reads_like_a_textbook() {
    insta::assert_snapshot!(part(
        &text(),
        "/// Displacement of the tool under the wrench, base axes, at the tool origin, with the",
        "/// Displacement of the tool under the wrench and the links' weights"
    ));
}
