use super::super::brackets::{brackets, moved_brackets};
use super::super::edit::{apply, written};
use super::*;
use crate::latex::lexer::lex;

fn notation() -> Notation {
    let f = |l: &str, f| (l.to_owned(), f, "\\theta".to_owned());
    let functions = vec![f("s", Function::Sin), f("c", Function::Cos)];
    Notation { functions, ..Notation::default() }
}

fn reached(from: &str, to: &str) -> Option<Slip> {
    let tokens = lex(from, &notation()).unwrap();
    let mut inventory = Inventory::default();
    inventory.add(&tokens);
    inventory.add(&lex("l_9 c_{234}", &notation()).unwrap());
    let mut all = slips(&tokens, &notation(), &inventory, &inventory);
    all.extend(brackets(&tokens));
    all.extend(moved_brackets(&tokens));
    all.iter().find(|e| written(&apply(&tokens, &[e])) == to).map(|e| e.slip)
}

#[test]
fn the_usual_slips_are_reached() {
    assert_eq!(reached("a - b", "a + b"), Some(Slip::Sign));
    assert_eq!(reached("a + b", "-a + b"), Some(Slip::Sign));
    assert_eq!(reached("l_3c_{23}", "l_3s_{23}"), Some(Slip::Function));
    assert_eq!(reached("l_3c_{2}", "l_9c_{2}"), Some(Slip::Index));
    assert_eq!(reached("C_1^3", "C_1^2"), Some(Slip::Power));
    assert_eq!(reached("(a + b^2)", "(a + b)^2"), Some(Slip::Bracket));
    assert_eq!(reached("(a + b", "(a + b)"), Some(Slip::Bracket));
    assert_eq!(reached("(a + b)c", "a + (b)c"), Some(Slip::Bracket));
    assert_eq!(reached("a + b c", "a"), Some(Slip::Extra));
    assert_eq!(reached("a + b c", "a + c"), Some(Slip::Extra));
    assert_eq!(reached("ab + c", "a b + a c"), Some(Slip::Missing));
}
