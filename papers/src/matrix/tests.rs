use crate::file::read;
use crate::ledger::Ledger;
use crate::verdict::{Entry, Verdict};

const ROBOT: &str = r#"
paper = "x"
[[robot]]
name = "arm"
table = """
name = "arm"
convention = "modified"
[[joint]]
type = "revolute"
d = "r1"
stiffness = "k1"
[[joint]]
type = "revolute"
alpha = "pi/2"
a = "a2"
stiffness = "k2"
[[joint]]
type = "revolute"
alpha = 0.3
a = "a3"
d = 0.2
stiffness = "k3"
"""
"#;

/// The finding about a relation of an arm with three joints.
fn found(latex: &str, matrices: &str, more: &str) -> Entry {
    let text = format!(
        "{ROBOT}[[equation]]\nnumber = '(1)'\nlatex = '{latex}'\nrobot = 'arm'\n\
         matrices = {{ {matrices} }}\n{more}\n"
    );
    let paper = read(&text, "x").unwrap_or_else(|error| panic!("{error}"));
    Ledger::of(&[paper]).entries.remove(0)
}

const K_C: &str =
    "J = 'jacobian', w = 'wrench', 'K_C' = 'complementary_stiffness', '\\Gamma' = 'joint_torque'";

#[test]
fn derived_quantities_fulfil_their_relations() {
    for latex in [
        r"K_C = \frac{\partial J^T}{\partial \theta} w",
        r"K_C = \frac{\partial \Gamma}{\partial \theta}",
        concat!(
            r"K_C = \begin{bmatrix} \frac{\partial J^T}{\partial \theta_1} w",
            r" & \frac{\partial J^T}{\partial \theta_2} w",
            r" & \frac{\partial J^T}{\partial \theta_3} w \end{bmatrix}"
        ),
        r"\Gamma = J^T w = (w^T J)^T",
    ] {
        let entry = found(latex, K_C, "");
        assert_eq!(entry.verdict, Verdict::AgreesAtPoints, "{latex} {:?}", entry.note);
    }
}

#[test]
fn the_smallest_change_is_found() {
    for (latex, right) in [
        (
            r"K_C = -\frac{\partial J^T}{\partial \theta} w",
            r"K_C = \frac{\partial J^T}{\partial \theta} w",
        ),
        (r"\Gamma = J w", r"\Gamma = J^T w"),
        (r"\Gamma = w J^T", r"\Gamma = J^T w"),
        (r"\Gamma = J^T \Gamma", r"\Gamma = J^T w"),
        (r"\Gamma = J^T", r"\Gamma = J^T w"),
    ] {
        let entry = found(latex, K_C, "");
        assert_eq!(entry.verdict, Verdict::Misprint, "{latex}");
        assert_eq!(entry.correction.as_deref(), Some(right));
        assert!(entry.change.is_some_and(|change| change.contains(" → ")));
    }
    let hopeless = found(r"K_C = J^T J", K_C, "");
    assert_eq!(hopeless.verdict, Verdict::NotJudged);
    assert!(hopeless.note.is_some_and(|note| note.contains("no small change")));
}

/// A condition on the left side, instead of a value of it: least squares.
#[test]
fn a_condition_decides() {
    let matrices = "A = 'random 5x2', b = 'random 5'";
    let condition = "truth = 'A^T (A x - b) = 0'";
    let entry = found("x = (A^T A)^{-1} A^T b", matrices, condition);
    assert_eq!(entry.verdict, Verdict::AgreesAtPoints, "{:?}", entry.note);
    let entry = found("x = (A A^T)^{-1} A^T b", matrices, condition);
    assert_eq!(entry.correction.as_deref(), Some("x = (A^T A)^{-1} A^T b"));
    // By its value, with an inverse that is worked out in another way.
    let entry = found(
        "x = (A^T A)^{-1} A^T b",
        "A = 'random 5x2', b = 'random 5', N = 'pseudo-inverse of A'",
        "truth = 'N b'",
    );
    assert_eq!(entry.verdict, Verdict::AgreesAtPoints, "{:?}", entry.note);
}

#[test]
fn what_is_no_source_is_named() {
    for (source, message) in [
        ("random", "is no source"),
        ("random 0x3", "is no source"),
        ("jacobian[9][1]", "is no source"),
        ("pose[1]", "is no source"),
    ] {
        let entry = found("K_C = A", &format!("'K_C' = '{source}'"), "");
        assert_eq!(entry.verdict, Verdict::NotJudged, "{source}");
        let note = entry.note.unwrap_or_default();
        assert!(note.contains(message) || note.contains("`A`"), "{source}: {note}");
    }
    let text = format!(
        "{ROBOT}[[equation]]\nnumber = '(1)'\nlatex = 'A = B^x'\nmatrices = {{ A = 'random 3' }}\n"
    );
    let error = read(&text, "x.toml").err().map(|error| error.to_string()).unwrap_or_default();
    assert!(error.contains("`x` is no power of a matrix") && error.contains("latex = 'A = B^x'"));
    let text = format!(
        "{ROBOT}[[equation]]\nnumber = '(1)'\nlatex = 'A = B'\n\
         matrices = {{ A = '= B (', 'a b' = 'random 3' }}\n"
    );
    let error = read(&text, "x.toml").err().map(|error| error.to_string()).unwrap_or_default();
    assert!(error.contains("the formula ends where a term is expected"), "{error}");
    assert!(error.contains("`a b` is no symbol of a matrix"), "{error}");
}
