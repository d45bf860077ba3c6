use super::*;

fn inner(latex: &str) -> String {
    let text = math(latex);
    let start = text.find("<mrow>").unwrap() + "<mrow>".len();
    text[start..text.find("</mrow><annotation").unwrap()].to_owned()
}

#[test]
fn indices_powers_and_fractions() {
    assert_eq!(inner("s_{23}"), "<msub><mi>s</mi><mrow><mrow><mn>23</mn></mrow></mrow></msub>");
    assert_eq!(
        inner("a^2/\\kappa_1"),
        "<msup><mi>a</mi><mrow><mn>2</mn></mrow></msup><mo>/</mo>\
         <msub><mi>κ</mi><mrow><mn>1</mn></mrow></msub>"
    );
    assert!(inner("\\frac{1}{2.5}").starts_with("<mfrac><mrow><mn>1</mn>"));
    assert_eq!(inner("a < b"), "<mi>a</mi><mo>&lt;</mo><mi>b</mi>");
}

#[test]
fn matrices_and_bold_letters() {
    let text = inner("\\mathbf{J} = \\begin{bmatrix} a & -b \\\\ 0 & \\dots \\end{bmatrix}^T");
    assert!(text.starts_with("<mrow><mi class=\"bold\">J</mi></mrow><mo>=</mo><msup>"));
    assert_eq!((text.matches("<mtr>").count(), text.matches("<mtd>").count()), (2, 4));
    assert!(text.contains("<mo>−</mo><mi>b</mi>") && text.contains("<mo>…</mo>"));
}

#[test]
fn sums_have_their_limits_above_and_below() {
    assert!(inner("\\sum_{i=1}^n x_i").starts_with("<munderover><mo>∑</mo>"));
    assert_eq!(inner("\\strange"), "<mtext>strange</mtext>");
    assert_eq!(inner("\\left. x \\right)"), "<mi>x</mi><mo>)</mo>");
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
