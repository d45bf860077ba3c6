//! README shows what is printed.

use proc_macro2::TokenStream;
use stiffarm_codegen::emit::{RustOptions, rust};

use crate::tables::table;

fn between<'t>(text: &'t str, from: &str, to: &str) -> &'t str {
    let start = text.find(from).unwrap_or_else(|| panic!("no `{from}`")) + from.len();
    let end = text[start..].find(to).unwrap_or_else(|| panic!("no `{to}`"));
    &text[start..start + end]
}

#[test]
fn the_listing_of_the_jacobian_is_what_is_printed() {
    let readme = include_str!("../../README.md");
    let section = between(readme, "## The macro", "A mistake in the table");
    let invocation: TokenStream =
        between(section, "stiffarm::robot! {", "\n}\n").parse().expect("tokens");
    let text = rust(&table(invocation), &RustOptions::default());
    let module = between(&text, "pub mod jacobian {", "\n}\n");
    let kernel = between(module, "    #[inline(always)]\n", "\n    }");
    let dedented = kernel.lines().map(|line| line.strip_prefix("    ").unwrap_or(line));
    let printed = dedented.collect::<Vec<_>>().join("\n");
    let listed = between(section, "```rust,ignore\n#[inline(always)]\n", "\n}\n```");
    assert_eq!(listed, printed);

    let figure = |name: &str| -> u32 {
        between(module, &format!("{name}: "), ",")
            .trim_end_matches(" };")
            .parse()
            .expect("a number")
    };
    let flops = figure("add") + figure("mul");
    let said = format!("{flops} additions and multiplications beyond five sine-cosine pairs");
    assert!(section.contains(&said), "README does not say: {said}");
    assert!(module.contains("sin_cos: 5 };"));
}
