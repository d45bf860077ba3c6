use std::collections::BTreeSet;

use super::*;
use crate::exact::reader::Reader;
use crate::latex::lexer::lex;
use crate::latex::notation::Notation;
use crate::latex::parser::parse;
use crate::verdict::Verdict;

/// How `printed` is known to be `truth`, in the limit of `infinite`, if it is.
fn agrees(printed: &str, truth: &str, infinite: &[&str]) -> Option<Verdict> {
    let notation = &Notation::default();
    let infinite: Vec<String> = infinite.iter().map(|name| (*name).to_owned()).collect();
    let forms = Forms::new(&[("b".into(), parse("2a", notation).unwrap())], &infinite).unwrap();
    let entries = vec![forms.tree(&parse(truth, notation).unwrap()).unwrap()];
    let truth = &forms.truth(1, entries).unwrap();
    let tokens = lex(printed, notation).unwrap();
    Reader::new(notation, truth).agrees(&tokens, truth.form(truth.entries[0]))
}

#[test]
fn formulas_without_roots_agree_exactly() {
    for (printed, truth) in [
        ("\\frac{a^2-c^2}{a+c}", "a-c"),
        ("b^2", "4a^2"),
        ("\\sin(\\alpha+\\beta)", "\\sin\\alpha\\cos\\beta+\\cos\\alpha\\sin\\beta"),
        ("\\int_{0}^{L}(P x^2)dx", "P L^3/3"),
        ("\\int_{L}^{1}(x - \\frac{3x^2}{P})dx", "(1-L^2)/2 - (1-L^3)/P"),
        ("\\frac{\\partial}{\\partial P}(P^2 a)", "2 P a"),
    ] {
        assert_eq!(agrees(printed, truth, &[]), Some(Verdict::Agrees), "{printed}");
        assert_eq!(agrees(printed, &format!("{truth} + L"), &[]), None, "{printed}");
    }
    assert_eq!(agrees("\\int_{0}^{1}(\\frac{1}{x+1})dx", "1", &[]), None);
    assert_eq!(agrees("\\frac{1}{a-a}", "1", &[]), None);
}

/// A root is positive; what it is taken of may be, or not.
#[test]
fn formulas_with_roots_agree_at_points() {
    for (printed, truth) in [
        ("\\sqrt{9 a^2}", "3a"),
        ("\\sqrt{a + c}\\sqrt{a + c}", "a + c"),
        ("\\frac{a - c}{\\sqrt{a} - \\sqrt{c}}", "\\sqrt{a} + \\sqrt{c}"),
    ] {
        assert!(agrees(printed, truth, &[]).is_some(), "{printed}");
        assert_eq!(agrees(printed, &format!("-({truth})"), &[]), None, "{printed}");
    }
    assert_eq!(agrees("\\sqrt{a + c}", "\\sqrt{a} + \\sqrt{c}", &[]), None);
}

#[test]
fn what_grows_without_bounds_takes_what_it_divides_away() {
    let truth = "a\\frac{L}{A c} A\\frac{c}{L} + \\frac{c}{E A} + \\frac{1}{A(L + c)}";
    assert_eq!(agrees("a", truth, &["A"]), Some(Verdict::Agrees));
    assert_eq!(agrees(truth, truth, &["A"]), None);
    let forms = Forms::new(&[], &["A".into()]).unwrap();
    let grows = forms.tree(&parse("a A", &Notation::default()).unwrap()).unwrap();
    assert!(forms.truth(1, vec![grows]).unwrap_err().contains("grows"));
}

#[test]
fn a_formula_depends_on_what_does_not_cancel() {
    let text = "c + \\sin^2\\alpha + \\cos^2\\alpha + L\\sin\\beta - L\\sin\\beta + \\cos\\gamma";
    let truth = Truth::written(text, &Notation::default());
    let (mut angles, mut symbols) = (BTreeSet::new(), BTreeSet::new());
    truth.form(truth.entries[0]).names(&mut angles, &mut symbols);
    assert_eq!((angles, symbols), (["gamma".to_owned()].into(), ["c".to_owned()].into()));
}
