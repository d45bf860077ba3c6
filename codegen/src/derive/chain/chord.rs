//! The straight line between the frames of a row, along which its beam lies.

use super::layout::Chain;
use super::place::{ROW, Step, tilt};
use crate::expr::{Expr, Graph, Node, Symbol, Turn, Vec3};
use crate::number::Number;
use crate::robot::Convention;

/// A beam's geometry in the working frame.
pub struct Chord {
    pub length: Expr,
    /// The same with the sign that it has along `axes[0]`.
    pub directed: Expr,
    /// Along the chord, and the two axes of the section; each up to its sign.
    pub axes: [Vec3; 3],
    /// Half of each translation of the row: from the middle of the chord to its end.
    pub to_end: [(Expr, Vec3); 2],
    /// Boundary at which everything beyond the beam begins.
    pub end: usize,
}

/// The chord of a row's beam. Its section's z axis is the part of the previous frame's z that is
/// perpendicular to the chord; along that axis itself, x of the frame is taken as the section's y.
pub fn chord(chain: &mut Chain, row: usize) -> Chord {
    let (z_step, x_step) = chain.row_translations(row);
    let (d, z) = chain.translation(z_step).unwrap_or_default();
    let (a, x) = chain.translation(x_step).unwrap_or_default();
    let half = chain.g.number(Number::ratio(1, 2));
    let to_end = [(chain.g.mul(half, d), z), (chain.g.mul(half, a), x)];
    let end = match chain.robot.convention {
        Convention::Standard => ROW * row + 3,
        Convention::Modified => ROW * (row + 1),
    };
    let y = chain.g.cross3(z, x);
    let previous = chain.z(ROW * row);
    // A whole turn tilts nothing.
    let beta = Turn::constant(&mut chain.g, &chain.robot.joints[row].beta);
    let tilted = chain.robot.convention == Convention::Modified && !beta.is_zero();
    let (directed, axes) = if tilted || !(a.is_zero() || d.is_zero()) {
        oblique(chain, row, (a, x), (d, z))
    } else if a.is_zero() {
        // x is perpendicular to both the chord and, unless they coincide, the previous z.
        (d, [z, x, y])
    } else {
        (a, [x, chain.g.cross3(previous, x), previous])
    };
    let length = magnitude(chain, directed);
    Chord { length, directed, axes, to_end, end }
}

/// `|x|`: a number's, or `√(x²)` of what is only known later and may be negative then.
fn magnitude(chain: &mut Chain, x: Expr) -> Expr {
    let known_positive = matches!(chain.g.node(x), Node::Number(_) | Node::Sqrt(_));
    if known_positive || table_s(&chain.g, x).is_some() {
        return x.abs();
    }
    let square = chain.g.mul(x, x);
    chain.g.sqrt(square)
}

/// Of a length that has grown with all others the table's.
fn table_s(g: &Graph, x: Expr) -> Option<Expr> {
    let Node::Mul(a, b) = g.node(x) else { return None };
    let scaled = g.number_of(a).is_some() && g.symbol_at(b.node()) == Some(&Symbol::Growth);
    scaled.then(|| a.signed(x.is_negative()))
}

/// What two lengths have grown by, and the table's.
fn grown(g: &mut Graph, lengths: [Expr; 2]) -> (Expr, [Expr; 2]) {
    match lengths.map(|x| table_s(g, x)) {
        [Some(a), Some(d)] => (g.symbol(Symbol::Growth), [a, d]),
        _ => (Expr::ONE, lengths),
    }
}

/// A chord along neither axis, or one that beta tilts: `u = (a x + d z)/L`, `y = previous z × u`
/// normalised, `z = u × y`.
fn oblique(
    chain: &mut Chain,
    row: usize,
    (a, x): (Expr, Vec3),
    (d, z): (Expr, Vec3),
) -> (Expr, [Vec3; 3]) {
    let previous = chain.z(ROW * row);
    // What lies between the previous frame and the chord: nothing in the standard convention.
    let of = |step: &Step| match step {
        Step::RotateX(turn) => turn.clone(),
        _ => Turn::ZERO,
    };
    let [twist, tilt] = match chain.robot.convention {
        Convention::Standard => [Turn::ZERO, Turn::ZERO],
        modified => [0, tilt(modified)].map(|offset| of(&chain.steps()[ROW * row + offset])),
    };
    let g = &mut chain.g;
    let (length, [along_x, along_z]) = match (a.is_zero(), d.is_zero()) {
        (true, _) => (d, [Expr::ZERO, Expr::ONE]),
        (_, true) => (a, [Expr::ONE, Expr::ZERO]),
        _ => {
            let (growth, [a, d]) = grown(g, [a, d]);
            let (aa, dd) = (g.mul(a, a), g.mul(d, d));
            let square = g.add(aa, dd);
            let length = g.sqrt(square);
            let inverse = g.recip(length);
            (g.mul(growth, length), [a, d].map(|part| g.mul(part, inverse)))
        }
    };
    let chord = g.combine3(along_x, x, along_z, z);
    if tilt.is_zero() && (twist.is_zero() || twist.is_half_turn()) {
        // The chord lies in the plane of x and the previous z: nothing to normalise.
        let across = g.cross3(z, x);
        let up = g.combine3(-along_z, x, along_x, z);
        return (length, [chord, across, up]);
    }
    // The chord's part along the previous z is (d cos beta − a sin beta)/L cos alpha, a constant of
    // the row.
    let (sine, cosine) = tilt.sin_cos(g);
    let (lifted, sunk) = (g.mul(along_z, cosine), g.mul(along_x, sine));
    let within = g.sub(lifted, sunk);
    let (_, cosine) = twist.sin_cos(g);
    let along = g.mul(within, cosine);
    let along_square = g.mul(along, along);
    let rest = g.sub(Expr::ONE, along_square);
    if rest.is_zero() {
        let y = chain.axes(ROW * row)[0];
        return (length, [chord, y, chain.g.cross3(chord, y)]);
    }
    let root = g.sqrt(rest);
    let norm = g.recip(root);
    let crossed = g.cross3(previous, chord);
    let across = g.scale3(norm, crossed);
    let up = g.cross3(chord, across);
    (length, [chord, across, up])
}

/// ρAL of the row's beam; zero without a beam or a density.
pub fn beam_mass(chain: &mut Chain, row: usize) -> Expr {
    let Some((density, area)) = chain.robot.joints[row]
        .beam
        .as_ref()
        .and_then(|b| b.density.clone().map(|density| (density, b.section.area.clone())))
    else {
        return Expr::ZERO;
    };
    let (density, area) = (chain.value(&density), chain.value(&area));
    let length = chord(chain, row).length;
    let per_length = chain.g.mul(density, area);
    chain.g.mul(per_length, length)
}
