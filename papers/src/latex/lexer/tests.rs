use super::super::notation::Slash;
use super::*;

fn texts(text: &str) -> Vec<String> {
    let notation = Notation {
        functions: vec![("cd".into(), Function::Cos, "d\\phi".into())],
        names: vec!["RL".into(), "\\delta x".into()],
        slash: Slash::Factor,
    };
    lex(text, &notation).unwrap().into_iter().map(|t| t.text).collect()
}

#[test]
fn names_take_their_subscripts() {
    assert_eq!(texts("RL_4 C_{234}^2"), ["RL_4", "C_{234}", "^2"]);
    assert_eq!(texts("cd_1c_1\\delta x_2"), ["cd_1", "c_1", "\\delta x_2"]);
    assert_eq!(texts("d\\phi_1 d_1"), ["d\\phi_1", "d_1"]);
}

#[test]
fn sizes_and_line_breaks_are_not_tokens() {
    assert_eq!(
        texts("\\left[ a \\right. \\\\ & + \\left. b \\right]"),
        ["\\left[", "a", "+", "b", "\\right]"]
    );
    assert_eq!(texts("\\frac{1}{2}"), ["\\frac", "{", "1", "}", "{", "2", "}"]);
}

#[test]
fn mistakes_have_a_place() {
    let at = |text: &str| lex(text, &Notation::default()).unwrap_err().at;
    assert_eq!(at("a + §"), 4..6);
    assert_eq!(at("a \\foo"), 2..6);
    assert_eq!(at("a^x"), 1..3);
    assert_eq!(at("a_{2"), 2..3);
    assert_eq!(at("_2"), 0..1);
}
