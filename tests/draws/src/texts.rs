//! Texts that are nearly right: what a reader has to answer.

use core::fmt::Debug;
use std::sync::LazyLock;

use proptest::prelude::*;
use proptest::sample::{Index, select};
use proptest::test_runner::{Config, TestCaseResult, TestRunner};

/// What troubles every reader: nothing, quotes and signs, numbers out of reach and that are none, letters beyond ASCII.
pub const PIECES: [&str; 31] = [
    "", " ", "\n", "\"", "'", "#", "[", "]", ",", ";", "|", "+", "-", "0", "-1", "1e999", "1e308",
    "-1e308", "1e-320", "nan", "inf", "1.5708", "é", "°", "\0", "\u{feff}", "kg", "1e", "x", "=",
    "1/0",
];

/// What to put into tables of measurements and of logs: separators, numbers, units and names, right and wrong.
pub static PIECES_OF_TABLES: LazyLock<Vec<&str>> = LazyLock::new(|| {
    let short = [
        "\r", "\r\n", "\t", "\"\"", "(mm)", "[deg]", "[kN]", "[in]", "NaN", "-inf", "-0", "1,5",
        "1.5.2", "q1", "drx", "sim_x", "marker", "smr1", "A1", "1 000", "[]", "[,", "1e12", "t",
        "q0", "q_cmd1", "tau1", "i1", "[rpm]", "run", "contact",
    ];
    let long = ["q99999999999999999999", "torque_side = motor", "# torque_side = nothing\n"];
    [&PIECES[..], &short, &long].concat()
});

/// The first lines of one of `files`, as many as `most`, with up to six stretches replaced by pieces, these or what troubles
/// every reader, or by stretches of itself; every tenth is cut off somewhere.
pub fn mutated(
    files: &'static [&'static str],
    most: usize,
    pieces: &[&'static str],
) -> impl Strategy<Value = String> + use<> {
    let pieces = select([&PIECES, pieces].concat());
    let edit = (any::<Index>(), 0..12_usize, pieces, any::<Option<(Index, u8)>>());
    let edits = prop::collection::vec(edit, 0..7);
    let cut = prop::option::weighted(0.1, any::<Index>());
    (select(files), 1..=most, edits, cut).prop_map(|(file, lines, edits, cut)| {
        let mut text: Vec<char> =
            file.split_inclusive('\n').take(lines).flat_map(str::chars).collect();
        for (at, length, piece, copied) in edits {
            let at = at.index(text.len() + 1);
            let end = (at + length).min(text.len());
            let copied = copied.map(|(from, length)| {
                let from = from.index(text.len() + 1);
                text[from..(from + usize::from(length)).min(text.len())].to_vec()
            });
            text.splice(at..end, copied.unwrap_or_else(|| piece.chars().collect()));
        }
        text.truncate(cut.map_or(text.len(), |cut| cut.index(text.len() + 1)));
        text.into_iter().collect()
    })
}

/// Asks so many of the inputs.
///
/// # Panics
/// With the smallest input that fails.
pub fn answered<I: Strategy>(cases: u32, inputs: &I, asks: impl Fn(I::Value) -> TestCaseResult)
where
    I::Value: Debug,
{
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    TestRunner::new(config).run(inputs, asks).unwrap_or_else(|error| panic!("{error}"));
}
