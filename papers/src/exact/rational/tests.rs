use super::*;
use crate::latex::notation::Notation;
use crate::latex::parser::parse;

fn read(text: &str) -> Rational {
    let tree = parse(text, &Notation::default()).unwrap();
    Exact(&HashMap::new()).tree(&tree).unwrap()
}

#[test]
fn quotients_compare_by_cross_multiplication() {
    let (a, b) = (read("\\frac{a^2-b^2}{a+b}"), read("a-b"));
    assert_eq!(a.equals(&b), Ok(true));
    assert_eq!(a.equals(&read("a+b")), Ok(false));
    assert_eq!(read("\\sqrt{4a^2}"), read("2a"));
}

#[test]
fn integrals_are_exact() {
    assert_eq!(read("\\int_{0}^{L}(P x^2)dx"), read("P L^3/3"));
    assert_eq!(read("\\frac{\\partial}{\\partial P}(P^2 a)"), read("2 P a"));
}

#[test]
fn what_has_no_exact_form_says_why() {
    let inexact = |text: &str| {
        let tree = parse(text, &Notation::default()).unwrap();
        Exact(&HashMap::new()).tree(&tree).unwrap_err()
    };
    assert_eq!(inexact("\\sqrt{a+b}"), Inexact::Root);
    assert_eq!(inexact("\\frac{1}{a-a}"), Inexact::Zero);
    assert_eq!(inexact("\\int_{0}^{1}(\\frac{1}{x+1})dx"), Inexact::Integral);
}
