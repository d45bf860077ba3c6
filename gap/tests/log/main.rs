//! Logs of plants that are written down in closed form, and what is said of them.

mod evidence;
#[cfg(any(feature = "mcap", feature = "parquet"))]
mod formats;
mod instrument;
mod own;
mod plant;
mod planted;
mod position;
mod rest;
mod shrink;
mod torque;
mod written;

/// The guide holds the catalogue as it is.
#[test]
fn the_guide_holds_the_catalogue() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/logs.md");
    let guide = std::fs::read_to_string(path).expect("the guide");
    let table = stiffarm_gap::log::effects::markdown();
    assert!(guide.contains(&table), "put this into docs/logs.md:\n{table}");
}
