//! The robots whose text is looked at: the collection, the fixtures of the parity tests, long arms.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use stiffarm_codegen::robot::{Robot, Source, parse_tokens};
use stiffarm_robots::{ARMS, SYMBOLIC};

/// The robots of the collection by id, with their files.
pub fn collection() -> Vec<(&'static str, &'static str, Robot)> {
    let numeric = ARMS.iter().map(|arm| (arm.id, arm.toml));
    let symbolic = SYMBOLIC.iter().map(|arm| (arm.id, arm.toml));
    let read = |(id, toml)| (id, toml, Robot::from_toml(toml, id).expect("a valid file").0);
    numeric.chain(symbolic).map(read).collect()
}

/// The invocations of `robot!` with which the parity tests make their fixtures.
pub fn invocations() -> Vec<TokenStream> {
    let source: TokenStream = include_str!("../parity/fixtures.rs").parse().expect("Rust");
    let tokens: Vec<TokenTree> = source.into_iter().collect();
    let invocation = |window: &[TokenTree]| match window {
        [TokenTree::Ident(name), TokenTree::Punct(_), TokenTree::Group(input)]
            if name == "robot" && input.delimiter() == Delimiter::Brace =>
        {
            Some(input.stream())
        }
        _ => None,
    };
    let found: Vec<TokenStream> = tokens.windows(3).filter_map(invocation).collect();
    assert!(found.len() >= 5, "the fixtures are found");
    found
}

/// The robot of an inline table.
pub fn table(input: TokenStream) -> Robot {
    match parse_tokens(input).map(|invocation| invocation.source) {
        Ok(Source::Table(robot)) => *robot,
        _ => panic!("the table is valid"),
    }
}

/// An arm with so many joints, none parallel to the next, each with a spring and a mass.
pub fn long(joints: usize) -> Robot {
    let row = |i: usize| {
        let (offset, twist) = (10 * (i % 7), 50 + 10 * (i % 3));
        format!(
            "j{i} | q + {offset} deg | 0.1 | 0.2 | {twist} deg | 1e5 | 2 | [-0.1, 0.01, 0.02]\n"
        )
    };
    let rows: String = (1..=joints).map(row).collect();
    let header = "joint | theta | d | a | alpha | stiffness | mass | com";
    let input = format!("mod long; convention: standard_dh;\n{header}\n{rows}");
    table(input.parse().expect("tokens"))
}

/// All of them, with their names.
pub fn all() -> Vec<(String, Robot)> {
    let named = |robot: Robot| (robot.name.clone(), robot);
    let collection = collection().into_iter().map(|(_, _, robot)| named(robot));
    collection.chain(invocations().into_iter().map(|input| named(table(input)))).collect()
}
