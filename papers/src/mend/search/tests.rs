use super::*;
use crate::exact::truth::Truth;
use crate::latex::lexer::lex;
use crate::latex::notation::Notation;
use crate::latex::tree::Function;

fn changes(printed: &str, truth: &str) -> Option<Vec<String>> {
    let f = |l: &str, f| (l.to_owned(), f, "\\theta".to_owned());
    let functions = vec![f("s", Function::Sin), f("c", Function::Cos)];
    let notation = Notation { functions, ..Notation::default() };
    let tokens = lex(printed, &notation).unwrap();
    let truth = &Truth::written(truth, &notation);
    let (read, truth) = (&Reader::new(&notation, truth), truth.form(truth.entries[0]));
    let mut inventory = Inventory::default();
    inventory.add(&tokens);
    let search = Search { tokens: &tokens, inventory: &inventory, read, truth };
    let found = mend(&search, |tokens| read.is(tokens, truth))?;
    Some(found.into_iter().map(|e| e.what).collect())
}

#[test]
fn one_slip() {
    assert_eq!(changes("a c_1 - b s_1", "a c_1 + b s_1").unwrap(), ["`-` → `+` before `b s_1`"]);
    assert_eq!(changes("8a c_1^3", "8 a c_1^2").unwrap(), ["`c_1^3` → `c_1^2`"]);
}

#[test]
fn two_and_three_slips_inside_a_square() {
    let two = changes("\\frac{1}{k}(a c_1 - b s_2 + d c_3)^2", "(a s_1 + b s_2 + d c_3)^2/k");
    assert_eq!(two.unwrap().len(), 2);
    let three = changes("(a c_1 - b s_2 + d c_3 + a b)^2", "(a s_1 + b s_2 + d c_3)^2");
    assert_eq!(three.unwrap().len(), 3);
}

#[test]
fn a_missing_bracket_and_a_slip() {
    let found = changes("[a(b + c_1 + d]^2", "(a(b + s_1) + d)^2").unwrap();
    assert_eq!(found.len(), 2, "{found:?}");
}

#[test]
fn what_is_too_far_off_is_left() {
    assert_eq!(changes("a", "b^5 + c + d_2 + e_2 + f_2"), None);
}
