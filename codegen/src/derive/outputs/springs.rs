//! What gives in the arm besides its joints' springs, to first order: beams, and what stands beyond the table.

use super::beam;
use crate::derive::chain::{
    Chain, Chord, Levers, Point, ROW, beam_mass, chord, entries, gravity, mass_beyond,
};
use crate::expr::{Expr, Graph, Twist, Vec3};
use crate::number::Number;
use crate::robot::Beam;
use crate::robot::beyond::Spring as Beyond;

/// Something that gives.
#[derive(Clone)]
pub(super) enum Elastic {
    /// The beam of a row.
    Beam(usize, Box<Beam>),
    /// What the table does not have.
    Beyond(Beyond),
}

/// One spring of it.
pub(super) struct Spring {
    pub compliance: Expr,
    /// Displacement of the tool per unit of the spring's.
    pub twist: Twist,
    /// Direction of the spring, and whether it gives by an angle about it.
    pub axis: Vec3,
    pub angular: bool,
}

/// Where springs stand.
pub(super) struct Place {
    /// From where the moments of what is beyond are taken.
    from: Point,
    /// What lies between there and the springs.
    inwards: Vec<(Expr, Vec3)>,
    /// Masses that move with this boundary are beyond.
    beyond: usize,
    /// Of a beam, whose own weight loads it.
    beam: Option<(usize, Chord)>,
}

/// All of them, base to tip.
pub(super) fn elastics(chain: &Chain) -> Vec<Elastic> {
    let joints = chain.robot.joints.iter().enumerate();
    let beams =
        joints.filter_map(|(row, joint)| Some(Elastic::Beam(row, Box::new(joint.beam.clone()?))));
    beams.chain(chain.robot.beyond.springs.iter().cloned().map(Elastic::Beyond)).collect()
}

/// The springs of one, and where they stand.
pub(super) fn springs(
    chain: &mut Chain,
    levers: &Levers,
    elastic: &Elastic,
) -> (Place, Vec<Spring>) {
    match elastic {
        Elastic::Beam(row, of) => {
            let chord = chord(chain, *row);
            let compliances = beam::compliances(chain, of, chord.length);
            beam::name(chain, *row, &chord, compliances);
            at_chord(chain, levers, (*row, chord), compliances)
        }
        Elastic::Beyond(Beyond::Link(row, flexibility)) => {
            let chord = chord(chain, *row);
            let compliances = flexible(&mut chain.g, chord.length, *flexibility);
            at_chord(chain, levers, (*row, chord), compliances)
        }
        Elastic::Beyond(Beyond::Bearing(joint, tilt)) => {
            let step = ROW * joint + entries(chain.robot.convention)[0];
            let [x, y, _] = chain.axes(step);
            let place = Place::at(Point::Step(step), step + 1);
            let [tilt_x, tilt_y] = tilt.map(|tilt| chain.g.number(tilt));
            let give = [(x, true, tilt_x), (y, true, tilt_y)];
            let springs = place.springs(chain, levers, give);
            (place, springs)
        }
        Elastic::Beyond(Beyond::Base(each)) => {
            let [x, y, z] = chain.axes(0);
            let place = Place::at(Point::Boundary(0), 0);
            let [about_x, about_y, about_z, give] = each.map(|n| chain.g.number(n));
            let all = [(x, true, about_x), (y, true, about_y), (z, true, about_z)];
            let all = all.into_iter().chain([x, y, z].map(|axis| (axis, false, give)));
            let springs = place.springs(chain, levers, all);
            (place, springs)
        }
    }
}

/// Springs at the middle of a chord: along its axes, then about them.
fn at_chord(
    chain: &mut Chain,
    levers: &Levers,
    (row, chord): (usize, Chord),
    compliances: [Expr; 6],
) -> (Place, Vec<Spring>) {
    let axes = chord.axes;
    let place = Place {
        from: Point::Boundary(chord.end),
        inwards: chord.to_end.to_vec(),
        beyond: chord.end,
        beam: Some((row, chord)),
    };
    let each = compliances.into_iter().enumerate().map(|(k, give)| (axes[k % 3], k >= 3, give));
    let springs = place.springs(chain, levers, each);
    (place, springs)
}

/// The six springs of a chord of length L with 1/EI in both planes and 1/GJ: those of a beam that is not
/// drawn out.
fn flexible(g: &mut Graph, length: Expr, [bending, torsion]: [Number; 2]) -> [Expr; 6] {
    let [bending, torsion] = [bending, torsion].map(|n| g.number(n));
    let (about, twist) = (g.mul(bending, length), g.mul(torsion, length));
    let square = g.mul(length, length);
    let twelfth = g.number(Number::ratio(1, 12));
    let across = g.mul(square, twelfth);
    let across = g.mul(across, about);
    [Expr::ZERO, across, across, twist, about, about]
}

impl Place {
    fn at(from: Point, beyond: usize) -> Place {
        Place { from, inwards: Vec::new(), beyond, beam: None }
    }

    /// The springs along or about some axes.
    fn springs(
        &self,
        chain: &mut Chain,
        levers: &Levers,
        each: impl IntoIterator<Item = (Vec3, bool, Expr)>,
    ) -> Vec<Spring> {
        let spring = |(axis, angular, compliance): (Vec3, bool, Expr)| {
            let twist = if angular {
                let lever = levers.extended(&mut chain.g, self.from, &self.inwards, Some(axis));
                (chain.g.cross3(axis, lever), axis)
            } else {
                (axis, [Expr::ZERO; 3])
            };
            Spring { compliance, twist, axis, angular }
        };
        each.into_iter().map(spring).collect()
    }

    /// What the weights beyond, and a beam's own, put on each of the springs.
    pub fn weight_on(&self, chain: &mut Chain, moments: &Levers, springs: &[Spring]) -> Vec<Expr> {
        let g = gravity(chain);
        let mass = mass_beyond(chain, self.beyond);
        let inwards: Vec<(Expr, Vec3)> =
            self.inwards.iter().map(|(half, axis)| (chain.g.mul(mass, *half), *axis)).collect();
        let mut loads = match &self.beam {
            Some((row, chord)) => {
                let mass_of_beam = beam_mass(chain, *row);
                let own = chain.g.scale3(mass_of_beam, g);
                beam::own_weight(chain, chord, own).to_vec()
            }
            None => vec![Expr::ZERO; springs.len()],
        };
        for (spring, load) in springs.iter().zip(&mut loads) {
            let outer = if spring.angular {
                let moment = moments.extended(&mut chain.g, self.from, &inwards, Some(spring.axis));
                let arm = chain.g.cross3(spring.axis, moment);
                chain.g.dot3(arm, g)
            } else {
                let along = chain.g.dot3(spring.axis, g);
                chain.g.mul(mass, along)
            };
            *load = chain.g.add(*load, outer);
        }
        loads
    }
}
