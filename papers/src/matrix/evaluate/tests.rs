use super::*;
use crate::latex::notation::Notation;
use crate::latex::parser::parse;

/// A(q) = [[q1², q1 q2], [sin q1, 3]], v = (2, −1), n = 3.
struct Sample;

impl Symbols for Sample {
    fn value(&self, key: &str, q: &[f64]) -> Result<Option<Dense>, String> {
        let [x, y] = [q[0], q[1]];
        let a = [[x * x, x * y], [x.sin(), 3.0]];
        Ok(match key {
            "A" => Some(Dense::from_fn(2, 2, |r, c| a[r][c])),
            "v" => Some(Dense::from_fn(2, 1, |r, _| 2.0 - 3.0 * r as f64)),
            "B_1" | "B_2" => Some(scalar(if key == "B_1" { 5.0 } else { 7.0 })),
            _ => None,
        })
    }
}

fn of(latex: &str) -> Result<Dense, String> {
    let point = Point {
        symbols: &Sample,
        q: vec![0.3, 0.8],
        counted: HashMap::from([("n".into(), 2)]),
        formulas: HashMap::new(),
    };
    point.matrix(&parse(latex, &Notation::MATRICES).unwrap())
}

#[test]
fn derivatives_by_joints_are_columns() {
    let d = of("\\frac{\\partial A}{\\partial \\theta} v").unwrap();
    let expected = [[2.0 * 2.0 * 0.3 - 0.8, -0.3], [2.0 * 0.3f64.cos(), 0.0]];
    for (r, row) in expected.iter().enumerate() {
        for (c, want) in row.iter().enumerate() {
            assert!((d[(r, c)] - want).abs() < 1e-11, "{d:?}");
        }
    }
    let one = of("\\frac{\\partial A}{\\partial q_2} v").unwrap();
    assert!((one[(0, 0)] - d[(0, 1)]).abs() < 1e-12);
    let gradient = of("\\frac{\\partial (A v)}{\\partial q}").unwrap();
    assert!((gradient - &d).amax() < 1e-11);
}

#[test]
fn products_over_an_index_and_blocks() {
    assert_eq!(of("\\prod_{j=1}^{n} B_j").unwrap()[(0, 0)], 35.0);
    assert_eq!(of("\\prod_{j=1}^{n-1} B_{j+1}").unwrap()[(0, 0)], 7.0);
    assert!((of("A^2 - A A").unwrap()).amax() < 1e-15);
    let blocks = of("\\begin{bmatrix} A & 0 \\\\ v^T & 1 \\end{bmatrix}").unwrap();
    assert_eq!((blocks.shape(), blocks[(0, 2)], blocks[(2, 2)]), ((3, 3), 0.0, 1.0));
}

#[test]
fn what_does_not_fit_is_said() {
    assert_eq!(of("A + v").unwrap_err(), "2×2 and 2×1 are added");
    assert_eq!(of("v A").unwrap_err(), "2×1 and 2×2 are multiplied");
    assert_eq!(of("(v v^T)^{-1}").unwrap_err(), "a matrix that has no inverse is inverted");
    assert_eq!(of("\\frac{1}{v}").unwrap_err(), "2×1 stands where a number is expected");
    assert_eq!(of("C_{j,x}").unwrap_err(), "`C_{j,x}` has no value");
}
