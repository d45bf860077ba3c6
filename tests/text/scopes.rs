//! The shape of the text: rustc's recursion over the statements of one scope ends at a few thousand.

use std::collections::HashSet;

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use stiffarm_codegen::emit::{RustOptions, rust};
use stiffarm_codegen::robot::Robot;

use crate::tables::{all, long};

/// Most `let`s in one scope, and in one function with all its scopes.
const SCOPE: usize = 256;
const FUNCTION: usize = 2000;

/// Checks a scope and those within it; returns the number of `let`s.
fn lets(scope: TokenStream, place: &str) -> usize {
    let tokens: Vec<TokenTree> = scope.into_iter().collect();
    let (mut here, mut within) = (0, 0);
    let mut names = HashSet::new();
    for (i, token) in tokens.iter().enumerate() {
        match token {
            TokenTree::Ident(word) if word == "let" => {
                here += 1;
                let is_equals =
                    |t: &TokenTree| matches!(t, TokenTree::Punct(p) if p.as_char() == '=');
                let end = tokens[i..].iter().position(is_equals).expect("`let … = …`");
                for name in bound(tokens[i + 1..i + end].iter().cloned().collect()) {
                    assert!(names.insert(name.clone()), "{place}: two `{name}` in one scope");
                }
            }
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
                within += lets(group.stream(), place);
            }
            _ => {}
        }
    }
    assert!(here <= SCOPE, "{place}: {here} lets in one scope");
    here + within
}

/// The names that a pattern binds.
fn bound(pattern: TokenStream) -> Vec<String> {
    let name = |token: TokenTree| match token {
        TokenTree::Ident(word) => vec![word.to_string()],
        TokenTree::Group(group) => bound(group.stream()),
        _ => Vec::new(),
    };
    let names = pattern.into_iter().flat_map(name);
    names.filter(|n| n != "mut" && n != "_" && !n.starts_with(char::is_uppercase)).collect()
}

/// Checks every function; returns how many there are.
fn functions(items: TokenStream, place: &str) -> usize {
    let tokens: Vec<TokenTree> = items.into_iter().collect();
    let mut count = 0;
    let mut name: Option<String> = None;
    for (i, token) in tokens.iter().enumerate() {
        match (token, &name) {
            (TokenTree::Ident(word), _) if word == "fn" => name = Some(tokens[i + 1].to_string()),
            (TokenTree::Group(group), Some(function)) if group.delimiter() == Delimiter::Brace => {
                let place = format!("{place}, {function}");
                let found = lets(group.stream(), &place);
                assert!(found <= FUNCTION, "{place}: {found} lets in one function");
                count += 1;
                name = None;
            }
            (TokenTree::Group(group), None) => count += functions(group.stream(), place),
            _ => {}
        }
    }
    count
}

fn check(name: &str, robot: &Robot) {
    let text = rust(robot, &RustOptions::default());
    // 15 public functions and their kernels, the two traits' and constructors'.
    assert!(functions(text.parse().expect("the text is Rust"), name) >= 30, "{name}");
    for line in text.lines().filter(|line| !line.starts_with("/// |")) {
        let breakable = [" + ", " - ", " * ", ", "].iter().any(|at| line.trim().contains(at));
        assert!(line.chars().count() <= 100 || !breakable, "{name}: {line}");
        assert_eq!(line, line.trim_end(), "{name}");
    }
}

#[test]
fn scopes_and_lines_are_short() {
    for (name, robot) in all() {
        check(&name, &robot);
    }
}

#[test]
fn scopes_of_a_long_arm_are_short() {
    check("40 joints", &long(40));
}

#[test]
fn what_is_too_much_is_found() {
    let text: String = (0..SCOPE).map(|i| format!("let x{i} = 1;")).collect();
    assert_eq!(lets(text.parse().expect("Rust"), "full"), SCOPE);
    let over =
        std::panic::catch_unwind(|| lets(format!("{text} let [y] = z;").parse().unwrap(), ""));
    assert!(over.is_err());
    let twice =
        std::panic::catch_unwind(|| lets("let a = 1; let [b, a] = c;".parse().unwrap(), ""));
    assert!(twice.is_err());
}
