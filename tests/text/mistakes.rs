//! What is said of wrong tables and of wrong robot files: golden files that are their own input, each mistake beneath
//! what it is about.
//!
//! A case is a title in a comment, then what stands between the braces of `robot!`, or the robot file. The lines behind
//! `//~` and `#~` are the answers, and are written anew: type the case alone, run `INSTA_UPDATE=always cargo test -p
//! stiffarm --test text`, and read what it adds as a user would. How the compiler shows such mistakes, and that they
//! bring no others with them, `tests/tables` proves on some cases of each kind.

use std::fmt::Write as _;
use std::path::Path;

use proc_macro2::{TokenStream, TokenTree};
use stiffarm_codegen::robot::{Located, Robot};

/// A mistake: its line from 1, its columns from 0, as far as the end of the line if no other is known, and the words.
type Told = (usize, usize, Option<usize>, String);

/// What the macro says of its input: the message of each `compile_error!`, from its first to its last token.
fn of_tokens(text: &str) -> Vec<Told> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/tables");
    let expansion = stiffarm_codegen::expand(text.parse().expect("tokens"), &root);
    assert!(syn::parse2::<syn::File>(expansion.clone()).is_ok(), "no items:\n{expansion}");
    let error = |four: &[TokenTree]| match four {
        [_, TokenTree::Ident(name), TokenTree::Punct(last), TokenTree::Group(body)]
            if name == "compile_error" =>
        {
            let words = syn::parse2::<syn::LitStr>(body.stream()).expect("a message").value();
            let (start, end) = (name.span().start(), last.span().end());
            // The whole invocation, and tokens over several lines, end with the line.
            let to = (end.line == start.line).then_some(end.column);
            Some((start.line, start.column, to, words))
        }
        _ => None,
    };
    let tokens: Vec<TokenTree> = TokenStream::into_iter(expansion).collect();
    tokens.windows(4).filter_map(error).collect()
}

/// What is said of a robot file where kernels are to be made of it.
fn of_file(text: &str) -> Vec<Told> {
    let told = |kind: &str, remark: &Located| {
        let help = remark.help.as_ref().map(|help| format!("\nhelp: {help}")).unwrap_or_default();
        let from = remark.column - 1;
        let marked = text[remark.span.clone()].lines().next().unwrap_or_default();
        let to = Some(from + marked.chars().count());
        (remark.line, from, to, format!("{kind}{}{help}", remark.message))
    };
    match Robot::for_kernels(text, "arm.toml") {
        Ok((_, warnings)) => warnings.iter().map(|remark| told("warning: ", remark)).collect(),
        Err(error) => error.errors.iter().map(|remark| told("", remark)).collect(),
    }
}

/// A case without what was said of it, as it is explained now; `mark` begins the lines of the explanation.
fn explained(case: &str, mark: &str, told: fn(&str) -> Vec<Told>) -> String {
    let lines: Vec<&str> = case.lines().filter(|line| !line.starts_with(mark)).collect();
    let found = told(&lines.join("\n"));
    assert!(!found.is_empty(), "accepted:\n{case}");
    let margin = mark.len() + 1;
    let mut shown = String::new();
    for (k, line) in lines.iter().enumerate() {
        let _ = writeln!(shown, "{line}");
        for (_, from, to, message) in found.iter().filter(|(at, ..)| *at == k + 1) {
            let width = to.unwrap_or(line.chars().count()).saturating_sub(*from);
            let marked = format!("{:1$}{2}", "", from.max(&margin) - margin, "^".repeat(width));
            for (k, text) in message.lines().enumerate() {
                let behind = if k == 0 { marked.clone() } else { " ".repeat(marked.len()) };
                let _ = writeln!(shown, "{mark} {behind} {text}");
            }
        }
    }
    shown
}

/// The cases of a snapshot, explained.
fn all(golden: &str, mark: &str, told: fn(&str) -> Vec<Told>) -> String {
    let (_, cases) = golden[4..].split_once("\n---\n").expect("the head of a snapshot");
    let cases: Vec<String> = cases.split("\n\n").map(|case| explained(case, mark, told)).collect();
    cases.join("\n")
}

#[test]
fn wrong_tables_are_explained() {
    let golden = include_str!("snapshots/text__mistakes__wrong_tables_are_explained.snap");
    insta::assert_snapshot!(all(golden, "//~", of_tokens));
}

#[test]
fn wrong_files_are_explained() {
    let golden = include_str!("snapshots/text__mistakes__wrong_files_are_explained.snap");
    insta::assert_snapshot!(all(golden, "#~", of_file));
}
