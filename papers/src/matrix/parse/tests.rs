use super::*;

fn back(latex: &str) -> String {
    let sides = sides(latex).unwrap_or_else(|(at, why)| panic!("{latex} at {at}: {why}"));
    sides.iter().map(Tree::latex).collect::<Vec<_>>().join(" = ")
}

#[test]
fn relations_are_read_and_written() {
    let stiffness = "\\mathbf{K}_X = \\mathbf{J}^{-T} (\\mathbf{K}_\\theta - K_C) \\mathbf{J}^{-1}";
    assert_eq!(back(stiffness), stiffness);
    assert_eq!(
        back("\\frac{1}{m} \\sqrt{\\text{tr}(M^T M)}"),
        "\\frac{1}{m} \\sqrt{\\text{tr}(M^T M)}"
    );
    assert_eq!(
        back("{}^Bw = \\begin{bmatrix} {}^BR_E & 0 \\\\ P & R \\end{bmatrix} {}^Ew"),
        "{}^Bw = \\begin{bmatrix} {}^BR_E & 0 \\\\ P & R \\end{bmatrix} {}^Ew"
    );
    assert_eq!(
        back("\\left[\\frac{\\partial \\mathbf{J}^T}{\\partial \\theta_i} \\right] \\mathbf{m}"),
        "\\frac{\\partial \\mathbf{J}^T}{\\partial \\theta_i} \\mathbf{m}"
    );
    assert_eq!(
        back("T_i = (\\prod_{j=1}^{i-1} K_{j,kin}) \\frac{\\partial K_{i,kin}}{\\partial q_i}"),
        "T_i = (\\prod_{j=1}^{i-1} K_{j,kin}) \\frac{\\partial K_{i,kin}}{\\partial q_i}"
    );
}

#[test]
fn names_lose_their_typeface() {
    let key = |latex| name(latex).unwrap().key(&std::collections::HashMap::new());
    assert_eq!(key("\\mathbf{K}_\\theta"), "K_theta");
    assert_eq!(key("{}^B\\dot w_d"), "^Bdotw_d");
    assert_eq!(key("\\mathbf{I}_{3 \\times 3}"), "I_3times3");
    assert_eq!(key("\\boldsymbol{\\Gamma}"), "Gamma");
    assert!(name("a b").is_none());
}

#[test]
fn mistakes_point_at_their_place() {
    assert_eq!(sides("A + ) B").unwrap_err().0, 4);
    assert_eq!(sides("(A B").unwrap_err(), (4, "the end stands where `)` is expected".into()));
    assert!(sides("A^3").unwrap_err().1.contains("no power"));
}

proptest::proptest! {
    #[test]
    fn no_text_panics(
        text in "(\\\\(frac|sqrt|prod|begin\\{bmatrix\\}|left|text|\\|)|[{}()^_&=+a1-]){0,14}",
    ) {
        let _ = sides(&text);
    }
}
