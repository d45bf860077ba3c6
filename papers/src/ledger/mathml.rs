//! LaTeX as it stands in the data files, set as MathML: a page shows formulas without any script.

use askama::filters::{Html, escape};
use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Parser, Storage, push_mathml};

/// A formula as a `math` element, its source kept as an annotation; one that cannot be set, such as
/// half of one, as its source.
pub fn math(latex: &str) -> String {
    let source = escape(latex, Html).map_or_else(|never| match never {}, |text| text.to_string());
    let mut lines = latex.to_owned();
    if !latex.contains("\\begin") {
        lines = latex.replace('&', " ");
        if lines.contains("\\\\") {
            lines = format!("\\begin{{array}}{{l}}{lines}\\end{{array}}");
        }
    }
    let storage = Storage::new();
    let read: Result<Vec<_>, _> = Parser::new(&lines, &storage).collect();
    let (display_mode, annotation) = (DisplayMode::Block, Some(source.as_str()));
    let config = RenderConfig { display_mode, annotation, ..RenderConfig::default() };
    let mut out = String::new();
    let events = read.ok().map(|events| events.into_iter().map(Ok::<_, core::fmt::Error>));
    match events.map(|events| push_mathml(&mut out, events, config)) {
        // pulldown-latex 0.8 writes the sign itself as the text of its element.
        Some(Ok(())) => out.replace("<</", "&lt;</"),
        _ => format!("<code>{source}</code>"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::built_in;

    /// Every formula of the five papers.
    #[test]
    fn the_papers_formulas_are_set() {
        for paper in built_in().unwrap_or_else(|e| panic!("{e}")) {
            for equation in &paper.equations {
                let latex = equation.printed.as_ref().unwrap_or(&equation.latex.text);
                assert!(math(latex).starts_with("<math "), "{latex}");
            }
        }
        let lines = math("a < b \\\\ &+ c");
        assert!(lines.contains("<mtable") && lines.contains("<mo>&lt;</mo>"), "{lines}");
        assert_eq!(math("\\frac{a < b"), "<code>\\frac{a &#60; b</code>");
    }

    proptest::proptest! {
        /// Whatever is written, every element is closed.
        #[test]
        fn no_text_breaks_the_page(
            text in "(\\\\(frac|begin\\{bmatrix\\}|end\\{bmatrix\\}|sum|left|text)|[{}^_&'a1.<]){0,12}",
        ) {
            let page = math(&text);
            let opened = page.matches('<').count() - page.matches("</").count();
            let closed = page.matches("</").count() + page.matches("/>").count();
            proptest::prop_assert_eq!(opened, closed, "{}", page);
        }
    }
}
