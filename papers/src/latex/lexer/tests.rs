use super::*;

fn texts(text: &str) -> Vec<String> {
    let notation = Notation {
        functions: vec![("cd".into(), Function::Cos, "d\\phi".into())],
        names: vec!["RL".into(), "\\delta x".into()],
        ..Notation::default()
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

#[test]
fn matrices_may_have_a_typeface_an_accent_and_an_index_before_them() {
    let key = |text: &str| match &lex(text, &Notation::MATRICES).unwrap()[..] {
        [Token { is: Lexeme::Name(name), .. }] => name.counted(&Default::default()),
        other => panic!("{other:?}"),
    };
    assert_eq!(key("\\mathbf{K}_\\theta"), "K_theta");
    assert_eq!(key("{}^B\\dot w_d"), "^Bdotw_d");
    assert_eq!(key("K_\\mathbf{J}"), "K_J");
    assert_eq!(key("\\mathbf{I}_{3 \\times 3}"), "I_3times3");
    assert_eq!(key("\\overline{\\boldsymbol{\\Gamma}}"), "overlineGamma");
    let text = "\\text{tr}(A_\\otimes^{-T} \\ldots)\\prod_{j = 1}^n \\begin{bmatrix} a & b \\\\ c";
    let is: Vec<_> = lex(text, &Notation::MATRICES).unwrap().into_iter().map(|t| t.is).collect();
    let over = |token: &Lexeme| matches!(token, Lexeme::Over(over) if over.from == "1");
    assert!(is[0] == Lexeme::Trace && is[3] == Lexeme::Transposed { inverse: true });
    assert!(over(&is[5]) && is[6] == Lexeme::Open(Bracket::Matrix) && is[8] == Lexeme::Cell);
    assert_eq!((is.len(), &is[10]), (12, &Lexeme::Row));
}
