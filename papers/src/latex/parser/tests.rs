use super::super::tree::Function;
use super::*;
use proptest::prelude::*;

fn notation(slash: Slash) -> Notation {
    let f = |l: &str, f| (l.to_owned(), f, "\\theta".to_owned());
    Notation {
        functions: vec![f("s", Function::Sin), f("c", Function::Cos)],
        names: vec!["RL".into()],
        slash,
        matrices: false,
    }
}

fn read(text: &str) -> Tree {
    parse(text, &notation(Slash::Factor)).unwrap()
}

#[test]
fn implicit_products_and_functions() {
    assert_eq!(read("\\sin \\theta_1 \\cos(\\theta_2+\\theta_3)"), read("s_1 c_{23}"));
    assert_eq!(read("\\sin^2\\theta_1"), read("s_1^2"));
    assert_eq!(read("-RL_4 s_1"), Tree::Sum(vec![(true, read("RL_4 s_1"))]));
    assert_eq!(read("\\left[ a \\right]^2"), read("a^{2}"));
    assert_eq!(read("a - \\\\ & - b"), read("a-b"));
    assert_eq!(read("a - - b"), read("a+b"));
}

#[test]
fn a_slash_reaches_as_far_as_the_file_says() {
    let long = parse("a/2bc", &notation(Slash::Product)).unwrap();
    assert_eq!(long, read("\\frac{a}{2bc}"));
    assert_ne!(read("a/2bc"), long);
}

#[test]
fn mistakes_point_at_their_character() {
    let at = |text: &str| {
        let m = parse(text, &notation(Slash::Factor)).unwrap_err();
        (m.at.start, m.message)
    };
    assert_eq!(at("a + (b"), (4, "this bracket is never closed".into()));
    assert_eq!(at("a + b)"), (5, "`)` closes no bracket".into()));
    assert_eq!(at("(a]"), (2, "`]` stands where `(` should be closed".into()));
    assert_eq!(at("a +"), (3, "the formula ends where a term is expected".into()));
    assert_eq!(at("\\cos(a b)").0, 4);
}

#[test]
fn integrals_and_derivatives() {
    assert!(matches!(read("\\int_{0}^{L_1}(a x)dx"), Tree::Integral { over, .. } if over == "x"));
    let d = read("\\frac{\\partial}{\\partial P}(P a)");
    assert!(matches!(&d, Tree::Derivative(_, name) if name.base == "P"));
    assert_eq!(read("\\frac{\\partial (P a)}{\\partial P}"), d);
}

#[test]
fn mistakes_in_matrices_point_at_their_place() {
    let at = |text: &str| {
        let m = parse(text, &Notation::MATRICES).unwrap_err();
        (m.at.start, m.message)
    };
    assert_eq!(at("A + ) B").0, 4);
    assert_eq!(at("(A B"), (0, "this bracket is never closed".into()));
    assert_eq!(at("\\|A (B").0, 4);
    assert_eq!(at("A^x"), (1, "`x` is no power of a matrix: T, -T or a whole number".into()));
    assert!(at("\\prod_j A").1.starts_with("a product is written"));
    assert!(at("\\begin{bmatrix} A & \\end{bmatrix}").1.contains("stands where a term"));
}

proptest! {
    #[test]
    fn no_relation_panics(
        text in "(\\\\(frac|sqrt|prod|dot|begin\\{bmatrix\\}|left|text|\\|)|[{}()^_&=+a1-]){0,14}",
    ) {
        let _ = parse(&text, &Notation::MATRICES);
    }

    #[test]
    fn no_text_panics(text in "\\PC{0,60}") {
        let _ = parse(&text, &notation(Slash::Product));
    }

    #[test]
    fn no_formula_panics(parts in proptest::collection::vec(
        prop::sample::select(vec!["\\frac", "{", "}", "(", ")", "\\left[", "\\right.", "a", "_2",
            "_{", "^", "^{3}", "+", "-", "/", "\\sin", "\\theta", "2", ".", "\\int", "\\partial",
            "s_{1-", "'", "\\\\", "=", "\\sqrt", "99999999999999999999999999999999999999999"]),
        0..24,
    )) {
        let _ = parse(&parts.concat(), &notation(Slash::Factor));
    }
}
