use super::*;
use crate::verdict::Verdict;

const GOOD: &str = "paper = \"x\"\n[notation]\nsine = { s = '\\theta' }\nslash = \"product\"\n\
    [where]\n'b_1' = 'c_1 a'\n'c_1' = '2 a'\n\
    [[equation]]\nnumber = \"(1)\"\nlatex = 'y = s_1 b_1'\ntruth = '2a^2 s_1'\n";

#[test]
fn definitions_may_use_each_other() {
    let paper = read(GOOD, "x.toml").unwrap();
    let equation = &paper.equations[0];
    let names: Vec<&str> = equation.setting.defined.iter().map(|(name, _)| &**name).collect();
    assert_eq!(names, ["c1", "b1"]);
    assert_eq!(
        crate::Ledger::of(core::slice::from_ref(&paper)).entries[0].verdict,
        Verdict::Agrees
    );
    assert_eq!(&GOOD[equation.latex.at..][..1], "y");
    assert_eq!(paper.notation.slash, Slash::Product);
}

#[test]
fn mistakes_point_into_the_file() {
    let messages = |text: &str| {
        let error = read(text, "x.toml").unwrap_err();
        error.errors.iter().map(|e| (e.line, e.column, e.message.clone())).collect::<Vec<_>>()
    };
    let bad = GOOD.replace("'2a^2 s_1'", "'2a^2 ¤'");
    assert_eq!(messages(&bad)[0].1, 15);
    let bad = GOOD.replace("s_1 b_1'", "s_1 \\oops b_1'");
    assert_eq!(messages(&bad)[0], (10, 18, "`\\oops` is no command of a formula".into()));
    let bad = GOOD.replace("'2 a'", "'b_1'");
    assert_eq!(messages(&bad)[0].2, "this definition goes round in a circle");
    let bad = GOOD.replace("truth", "turth");
    assert!(messages(&bad).iter().any(|m| m.2.contains("unknown field `turth`")));
    let bad = GOOD.replace("'c_1 a'", "'c_1 + )'");
    assert_eq!(messages(&bad)[0], (6, 16, "`)` stands where a term is expected".into()));
    assert_eq!(messages("paper = ")[0].0, 1);
}

proptest::proptest! {
    #[test]
    fn no_text_panics(text in "\\PC{0,80}", at in 0usize..220) {
        let _ = read(&text, "x");
        let at = (0..=at.min(GOOD.len())).rev().find(|i| GOOD.is_char_boundary(*i)).unwrap_or(0);
        let _ = read(&format!("{}{text}{}", &GOOD[..at], &GOOD[at..]), "x");
    }
}
