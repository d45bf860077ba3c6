//! Yoshikawa's measure of manipulability and its gradient, without a division but by the measure itself.

use stiffarm_kernels::Output;

use super::{Derivation, Derived};
use crate::derive::chain::{Chain, flatten, seen_from, twists};
use crate::expr::{Expr, Symbol};
use crate::number::Number;

/// The outputs of this file.
pub(super) const DERIVED: &[(Output, Derivation)] = &[
    (Output::Manipulability, manipulability),
    (Output::ManipulabilityByJoints, manipulability_by_joints),
];

/// More joints than this have more minors than the square of J Jᵀ has terms.
const BY_MINORS: usize = 8;

/// √det(J Jᵀ).
fn manipulability(chain: &mut Chain) -> Derived {
    let square = square(chain);
    let square = never_negative(chain, square);
    vec![chain.g.sqrt(square)].into()
}

/// ∂w/∂q_i = ½ ∂(w²)/∂q_i / w. Where w is zero it has no derivative: 10⁻³⁷ under the root, nothing beside the
/// rounding of any w above 10⁻¹⁰, makes it zero there, in single precision too.
fn manipulability_by_joints(chain: &mut Chain) -> Derived {
    let square = square(chain);
    let joints: Vec<Symbol> = (0..chain.dof()).map(Symbol::Joint).collect();
    let gradient = chain.g.gradient(square, &joints);
    let least = Number::from_decimal("1e-37").map(|least| chain.g.number(least));
    let square = never_negative(chain, square);
    let above = chain.g.add(square, least.unwrap_or_default());
    let root = chain.g.sqrt(above);
    let (half, inverse) = (chain.g.number(Number::ratio(1, 2)), chain.g.recip(root));
    let scale = chain.g.mul(half, inverse);
    gradient.into_iter().map(|slope| chain.g.mul(scale, slope)).collect::<Vec<Expr>>().into()
}

/// The determinant of many joints' J Jᵀ may be rounded below zero; a sum of squares is not.
fn never_negative(chain: &mut Chain, square: Expr) -> Expr {
    if chain.dof() <= BY_MINORS {
        return square;
    }
    let twice = chain.g.mul(square, square);
    chain.g.sqrt(twice)
}

/// det(J Jᵀ), or of fewer than six joints det(Jᵀ J), the square of what there is of singular values: the sum of
/// the squares of J's minors (Cauchy and Binet). Of six joints and more it is the same whatever
/// point J is told at, as if it moved with the tool: that of all frames' origins at which it costs least.
fn square(chain: &mut Chain) -> Expr {
    let n = chain.dof();
    if n < 6 {
        let twists = twists(chain);
        return squares(
            chain,
            &twists.into_iter().map(|twist| flatten([twist])).collect::<Vec<_>>(),
        );
    }
    let mut best = None;
    for row in 0..=n {
        let columns: Vec<Vec<Expr>> =
            seen_from(chain, row).into_iter().map(|twist| flatten([twist])).collect();
        let square = squares(chain, &columns);
        let cost = chain.g.count(&[square]).cost();
        if best.is_none_or(|(least, _)| cost < least) {
            best = Some((cost, square));
        }
    }
    best.map_or(Expr::ZERO, |(_, square)| square)
}

/// The sum of the squares of all minors of the matrix with these columns of six.
fn squares(chain: &mut Chain, columns: &[Vec<Expr>]) -> Expr {
    let n = columns.len();
    if n > BY_MINORS {
        let gram: Vec<Vec<Expr>> =
            (0..6).map(|r| (0..6).map(|c| dot(chain, columns, (r, c))).collect()).collect();
        return chain.g.minors(&gram).into_iter().next().unwrap_or_default();
    }
    let rows: Vec<Vec<Expr>> =
        (0..6).map(|r| columns.iter().map(|column| column[r]).collect()).collect();
    let minors = if n < 6 { chain.g.minors(&rows) } else { chain.g.minors(columns) };
    chain.g.products(minors.into_iter().map(|minor| (minor, minor)))
}

fn dot(chain: &mut Chain, columns: &[Vec<Expr>], (r, c): (usize, usize)) -> Expr {
    let (r, c) = (r.min(c), r.max(c));
    chain.g.products(columns.iter().map(|column| (column[r], column[c])))
}
