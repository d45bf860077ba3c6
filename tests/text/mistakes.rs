//! What the macro says of wrong tables: a golden file that is its own input, each mistake beneath its tokens.
//!
//! A case is a title behind `//`, then what stands between the braces of `robot!`. The lines behind `//~` are the
//! macro's, and are written anew: type the case alone, run `INSTA_UPDATE=always cargo test -p stiffarm --test text`,
//! and read what it adds as a user would. How the compiler shows such mistakes, and that they bring no others with
//! them, `tests/tables` proves on some cases of each kind.

use std::fmt::Write as _;
use std::path::Path;

use proc_macro2::{Span, TokenStream, TokenTree};

/// The message of each `compile_error!` of an expansion, with its first and its last token.
fn errors(expansion: TokenStream) -> Vec<(Span, Span, String)> {
    let tokens: Vec<TokenTree> = expansion.into_iter().collect();
    let error = |four: &[TokenTree]| match four {
        [_, TokenTree::Ident(name), TokenTree::Punct(end), TokenTree::Group(body)]
            if name == "compile_error" =>
        {
            let text = syn::parse2::<syn::LitStr>(body.stream()).expect("a message");
            Some((name.span(), end.span(), text.value()))
        }
        _ => None,
    };
    tokens.windows(4).filter_map(error).collect()
}

/// A case without what was said of it, as the macro explains it now.
fn explained(case: &str, root: &Path) -> String {
    let lines: Vec<&str> = case.lines().filter(|line| !line.starts_with("//~")).collect();
    let tokens = lines.join("\n").parse().expect("tokens");
    let expansion = stiffarm_codegen::expand(tokens, root);
    assert!(syn::parse2::<syn::File>(expansion.clone()).is_ok(), "no items:\n{expansion}");
    let found = errors(expansion);
    assert!(!found.is_empty(), "accepted:\n{case}");
    let mut shown = String::new();
    for (k, line) in lines.iter().enumerate() {
        let _ = writeln!(shown, "{line}");
        for (start, end, message) in found.iter().filter(|(at, ..)| at.start().line == k + 1) {
            let (from, to) = (start.start().column, end.end());
            // The whole invocation, and tokens over several lines, end with the line.
            let to = if to.line == k + 1 { to.column } else { line.chars().count() };
            let marked = format!("{:1$}{2}", "", from.max(4) - 4, "^".repeat(to - from));
            for (k, text) in message.lines().enumerate() {
                let behind = if k == 0 { marked.clone() } else { " ".repeat(marked.len()) };
                let _ = writeln!(shown, "//~ {behind} {text}");
            }
        }
    }
    shown
}

#[test]
fn wrong_tables_are_explained() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/tables");
    let golden = include_str!("snapshots/text__mistakes__wrong_tables_are_explained.snap");
    let (_, cases) = golden[4..].split_once("\n---\n").expect("the head of a snapshot");
    let cases: Vec<String> = cases.split("\n\n").map(|case| explained(case, &root)).collect();
    insta::assert_snapshot!(cases.join("\n"));
}
