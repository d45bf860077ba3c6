//! Links as beams, read as springs.
//!
//! A straight prismatic beam that is clamped at one end and loaded at the other is the same as six
//! springs in series at the middle of its chord: along the axis L/EA, across it L³/12EI (plus shear
//! L/κGA), about the axis L/GJ, about the other two L/EI. There the flexibility matrix is diagonal,
//! so a beam adds six columns like those of joints, and no 6×6 products. A distributed weight w acts
//! on them as the force wL/2 and, for its own slope, the moment wL²/6.

use super::chain::{Chain, ROW, Step};
use super::jacobian::Twist;
use super::lever::{From, Levers, row_slides};
use crate::expr::{Expr, Graph, Node, Turn, Vec3};
use crate::number::Number;
use crate::robot::{Beam, Convention};

/// A beam's geometry in the working frame.
pub(super) struct Chord {
    pub length: Expr,
    /// The same with the sign that it has along `axes[0]`.
    pub directed: Expr,
    /// Along the chord, and the two axes of the section; each up to its sign.
    pub axes: [Vec3; 3],
    /// Half of each slide of the row: from the middle of the chord to its end.
    pub to_end: [(Expr, Vec3); 2],
    /// Boundary at which everything beyond the beam begins.
    pub end: usize,
}

/// What the compliances of a beam's springs are called: along its axes, then about them.
const SPRINGS: [&str; 6] = ["axial", "across_y", "across_z", "torsion", "bend_y", "bend_z"];

/// One of the six springs of a beam.
pub(super) struct Spring {
    pub compliance: Expr,
    /// Displacement of the tool per unit of the spring's.
    pub twist: Twist,
    /// Direction of the spring, and whether it turns.
    pub axis: Vec3,
    pub turns: bool,
}

/// The chord of a row's beam. Its section's z axis is the part of the previous frame's z that is
/// perpendicular to the chord; along that axis itself, x of the frame is taken as the section's y.
pub(super) fn chord(chain: &mut Chain, row: usize) -> Chord {
    let (z_step, x_step) = row_slides(chain, row);
    let (d, z) = chain.slide(z_step).unwrap_or_default();
    let (a, x) = chain.slide(x_step).unwrap_or_default();
    let half = chain.g.number(Number::ratio(1, 2));
    let to_end = [(chain.g.mul(half, d), z), (chain.g.mul(half, a), x)];
    let end = match chain.robot.convention {
        Convention::Standard => ROW * row + 3,
        Convention::Modified => ROW * (row + 1),
    };
    let y = chain.g.cross3(z, x);
    let previous = chain.z(ROW * row);
    let (directed, axes) = if a.is_zero() {
        // x is perpendicular to both the chord and, unless they coincide, the previous z.
        (d, [z, x, y])
    } else if d.is_zero() {
        (a, [x, chain.g.cross3(previous, x), previous])
    } else {
        oblique(chain, row, (a, x), (d, z))
    };
    let length = magnitude(chain, directed);
    Chord { length, directed, axes, to_end, end }
}

/// `|x|`: a number's, or `√(x²)` of what is only known later and may be negative then.
fn magnitude(chain: &mut Chain, x: Expr) -> Expr {
    let known_positive = matches!(chain.g.node(x), Node::Number(_) | Node::Sqrt(_));
    if known_positive {
        return x.abs();
    }
    let square = chain.g.mul(x, x);
    chain.g.sqrt(square)
}

/// A chord along neither axis: `u = (a x + d z)/L`, `y = previous z × u` normalised, `z = u × y`.
fn oblique(
    chain: &mut Chain,
    row: usize,
    (a, x): (Expr, Vec3),
    (d, z): (Expr, Vec3),
) -> (Expr, [Vec3; 3]) {
    let previous = chain.z(ROW * row);
    let twist = match &chain.steps()[ROW * row] {
        Step::TurnX(turn) => turn.clone(),
        _ => Turn::ZERO,
    };
    let g = &mut chain.g;
    let (aa, dd) = (g.mul(a, a), g.mul(d, d));
    let square = g.add(aa, dd);
    let length = g.sqrt(square);
    let inverse = g.recip(length);
    let (along_x, along_z) = (g.mul(a, inverse), g.mul(d, inverse));
    let chord = g.combine3(along_x, x, along_z, z);
    if twist.is_zero() || twist.is_half_turn() {
        // The chord lies in the plane of x and the previous z: nothing to normalise.
        let across = g.cross3(z, x);
        let up = g.combine3(-along_z, x, along_x, z);
        return (length, [chord, across, up]);
    }
    // The chord's part along the previous z is (d/L) cos alpha, a constant of the row.
    let (_, cosine) = twist.sin_cos(g);
    let along = g.mul(along_z, cosine);
    let along_square = g.mul(along, along);
    let rest = g.sub(Expr::ONE, along_square);
    let root = g.sqrt(rest);
    let norm = g.recip(root);
    let crossed = g.cross3(previous, chord);
    let across = g.scale3(norm, crossed);
    let up = g.cross3(chord, across);
    (length, [chord, across, up])
}

/// ρAL of the row's beam; zero without a beam or a density.
pub(super) fn mass(chain: &mut Chain, row: usize) -> Expr {
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

/// The six springs of a row's beam, and its chord.
pub(super) fn springs(
    chain: &mut Chain,
    levers: &Levers,
    row: usize,
    beam: &Beam,
) -> (Chord, [Spring; 6]) {
    let chord = chord(chain, row);
    let compliances = compliances(chain, beam, chord.length);
    let i = row + 1;
    chain.g.name(chord.length, || format!("len{i}"));
    for (compliance, name) in compliances.into_iter().zip(SPRINGS) {
        chain.g.name(compliance, || format!("{name}{i}"));
    }
    let springs = core::array::from_fn(|k| {
        let (axis, turns) = (chord.axes[k % 3], k >= 3);
        let twist = if turns {
            let from = From::Boundary(chord.end);
            let lever = levers.extended(&mut chain.g, from, &chord.to_end, Some(axis));
            (chain.g.cross3(axis, lever), axis)
        } else {
            (axis, [Expr::ZERO; 3])
        };
        Spring { compliance: compliances[k], twist, axis, turns }
    });
    (chord, springs)
}

/// Compliances of the six springs: along x, y, z of the beam, then about them.
fn compliances(chain: &mut Chain, beam: &Beam, length: Expr) -> [Expr; 6] {
    let [e, shear] = [&beam.youngs_modulus, &beam.shear_modulus].map(|v| chain.value(v));
    let section = &beam.section;
    let [area, iy, iz, j] =
        [&section.area, &section.iy, &section.iz, &section.j].map(|v| chain.value(v));
    let kappa = beam.shear_coefficient.as_ref().map(|k| chain.value(k));
    let g = &mut chain.g;
    let over = |g: &mut Graph, length, a, b| {
        let product = g.mul(a, b);
        let inverse = g.recip(product);
        g.mul(length, inverse)
    };
    let (axial, torsion) = (over(g, length, e, area), over(g, length, shear, j));
    let (about_y, about_z) = (over(g, length, e, iy), over(g, length, e, iz));
    let square = g.mul(length, length);
    let twelfth = g.number(Number::ratio(1, 12));
    let across = g.mul(square, twelfth);
    let (mut across_y, mut across_z) = (g.mul(across, about_z), g.mul(across, about_y));
    if let Some(kappa) = kappa {
        let effective = g.mul(kappa, area);
        let slip = over(g, length, shear, effective);
        (across_y, across_z) = (g.add(across_y, slip), g.add(across_z, slip));
    }
    [axial, across_y, across_z, torsion, about_y, about_z]
}

/// What the beam's own distributed weight (`total` = wL as a force vector) puts on each spring.
pub(super) fn own_weight(chain: &mut Chain, chord: &Chord, total: Vec3) -> [Expr; 6] {
    let [u, y, z] = chord.axes;
    let half = chain.g.number(Number::ratio(1, 2));
    let sixth = chain.g.number(Number::ratio(1, 6));
    let lever = chain.g.mul(sixth, chord.directed);
    let forces = [u, y, z].map(|axis| {
        let component = chain.g.dot3(axis, total);
        chain.g.mul(half, component)
    });
    // The slope at the end, wL³/6EI, is that of a moment u × (wL) · L/6.
    let moment = |chain: &mut Chain, axis: Vec3| {
        let turned = chain.g.cross3(axis, u);
        let component = chain.g.dot3(turned, total);
        chain.g.mul(lever, component)
    };
    let (my, mz) = (moment(chain, y), moment(chain, z));
    let [fu, fy, fz] = forces;
    [fu, fy, fz, Expr::ZERO, my, mz]
}
