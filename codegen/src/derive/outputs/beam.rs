//! Links as beams, read as springs.
//!
//! A straight prismatic beam that is clamped at one end and loaded at the other is the same as six
//! springs in series at the middle of its chord: along the axis L/EA, across it L³/12EI (plus shear
//! L/κGA), about the axis L/GJ, about the other two L/EI. There the flexibility matrix is diagonal,
//! so a beam adds six columns like those of joints, and no 6×6 products. A distributed weight w acts
//! on them as the force wL/2 and, for its own slope, the moment wL²/6.

use crate::derive::chain::{Chain, Chord};
use crate::expr::{Expr, Graph, Vec3};
use crate::number::Number;
use crate::robot::Beam;

/// What the compliances of a beam's springs are called: along its axes, then about them.
const SPRINGS: [&str; 6] = ["axial", "across_y", "across_z", "torsion", "bend_y", "bend_z"];

/// Names the length of a row's chord and the compliances of its springs.
pub(super) fn name(chain: &mut Chain, row: usize, chord: &Chord, compliances: [Expr; 6]) {
    let i = row + 1;
    chain.g.name(chord.length, || format!("len{i}"));
    for (compliance, name) in compliances.into_iter().zip(SPRINGS) {
        chain.g.name(compliance, || format!("{name}{i}"));
    }
}

/// Compliances of the six springs: along x, y, z of the beam, then about them.
pub(super) fn compliances(chain: &mut Chain, beam: &Beam, length: Expr) -> [Expr; 6] {
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
