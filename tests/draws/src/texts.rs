//! Texts that are nearly right: what a reader has to answer.

use core::fmt::Debug;

use proptest::prelude::*;
use proptest::sample::{Index, select};
use proptest::test_runner::{Config, TestCaseResult, TestRunner};

/// The first lines of one of `files`, as many as `most`, with up to six stretches replaced by pieces
/// or by stretches of itself; every tenth is cut off somewhere.
pub fn mutated(
    files: &'static [&'static str],
    most: usize,
    pieces: &'static [&'static str],
) -> impl Strategy<Value = String> {
    let edit = (any::<Index>(), 0..12_usize, select(pieces), any::<Option<(Index, u8)>>());
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
