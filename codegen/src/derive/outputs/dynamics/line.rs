//! The arm as a line of links, each with its axis, its place on the link before and the moments of its mass.
//!
//! Neighbours with parallel axes make a run. All angles of a run are told from the axes in which it begins, so
//! that they are the sums that the pose is made of. A link's origin may lie anywhere on the axis that it
//! turns about: translations along the axes of a run are left to its end, and behind the last joint to nobody.

use super::moments::{Moments, turned, turned_matrix};
use super::newton_euler::Load;
use crate::derive::chain::{Chain, beam_mass, expression, length};
use crate::expr::{Expr, Graph, Symbol, Turn, Vec3};
use crate::number::Number;
use crate::robot::{Convention, Motion, Value};

/// A link, and the joint that it turns or slides on.
pub(super) struct Link {
    /// Whether its axis is not parallel to the one before.
    pub begins: bool,
    /// How its axis leans in the axes of the link before.
    pub lean: Lean,
    /// Whether its z is opposite to the run's.
    pub opposite: bool,
    /// Its angle about its own z, in the run's axes turned over if it is opposite.
    turn: Turn,
    /// Its origin in the axes of the link before, the slide apart.
    pub offset: Vec3,
    /// How far it has slid along its z, where it does.
    pub slide: Option<Expr>,
    pub row: RowFrame,
    pub moments: Moments,
}

/// Turns by alpha about x, then by beta about y.
#[derive(Clone)]
pub(super) struct Lean([Turn; 2]);

impl Lean {
    const NONE: Lean = Lean([Turn::ZERO; 2]);

    /// Whether the axis behind it is parallel to the one before.
    fn is_straight(&self) -> bool {
        let Lean([alpha, beta]) = self;
        (alpha.is_zero() || alpha.is_half_turn()) && beta.is_zero()
    }

    /// A vector of the axes behind it in those before.
    pub fn outwards(&self, g: &mut Graph, v: Vec3) -> Vec3 {
        let v = turned(g, &self.0[1], 1, v);
        turned(g, &self.0[0], 0, v)
    }

    /// The other way.
    pub fn inwards(&self, g: &mut Graph, v: Vec3) -> Vec3 {
        let v = turned(g, &self.0[0].negated(), 0, v);
        turned(g, &self.0[1].negated(), 1, v)
    }

    /// Moments of mass, as [vectors](Lean::outwards).
    pub fn moments(&self, g: &mut Graph, moments: &Moments) -> Moments {
        moments.turned(g, &self.0[1], 1).turned(g, &self.0[0], 0)
    }
}

impl Lean {
    /// A matrix, as [vectors](Lean::outwards).
    pub fn matrix(&self, g: &mut Graph, matrix: &[Vec3; 3]) -> [Vec3; 3] {
        let matrix = turned_matrix(g, &self.0[1], 1, matrix);
        turned_matrix(g, &self.0[0], 0, &matrix)
    }
}

/// The frame of a link's row, in which the table tells its mass.
pub(super) struct RowFrame {
    /// Of its axes in the link's.
    pub lean: Lean,
    /// From the link's origin, in the link's axes.
    pub origin: Vec3,
}

impl RowFrame {
    fn of(chain: &mut Chain, row: usize, head: Expr) -> RowFrame {
        match chain.robot.convention {
            Convention::Modified => {
                RowFrame { lean: Lean::NONE, origin: [Expr::ZERO, Expr::ZERO, head] }
            }
            Convention::Standard => {
                let (lean, along) = leans(chain, row);
                RowFrame { lean, origin: [along[0], along[1], head] }
            }
        }
    }
}

impl Link {
    /// A vector of the link's axes in the run's.
    pub fn outwards_to_run(&self, g: &mut Graph, v: Vec3) -> Vec3 {
        let turned = turned(g, &self.turn, 2, v);
        self.over(turned)
    }

    /// A vector of the run's axes in the link's.
    pub fn run_to_link(&self, g: &mut Graph, v: Vec3) -> Vec3 {
        turned(g, &self.turn.negated(), 2, self.over(v))
    }

    /// Moments of mass in the run's axes.
    pub fn moments_in_run(&self, g: &mut Graph, moments: &Moments) -> Moments {
        let turned = moments.turned(g, &self.turn, 2);
        if self.opposite { turned.over() } else { turned }
    }

    /// A matrix of the link's axes in the run's.
    pub fn matrix_in_run(&self, g: &mut Graph, matrix: &[Vec3; 3]) -> [Vec3; 3] {
        let turned = turned_matrix(g, &self.turn, 2, matrix);
        let sign = |i: usize, x: Expr| x.signed(self.opposite && i > 0);
        core::array::from_fn(|i| core::array::from_fn(|j| sign(i, sign(j, turned[i][j]))))
    }

    /// What the joint bears of a load about its origin, in the run's axes.
    pub fn borne(&self, (force, moment): Load) -> Expr {
        self.signed(if self.slide.is_some() { force[2] } else { moment[2] })
    }

    /// `-x` if the link is opposite to its run.
    pub fn signed(&self, x: Expr) -> Expr {
        x.signed(self.opposite)
    }

    fn over(&self, [x, y, z]: Vec3) -> Vec3 {
        if self.opposite { [x, -y, -z] } else { [x, y, z] }
    }
}

/// The links, the mass of each regrouped so that the constants are as few as can be told from motion
/// (Khalil & Kleinfinger 1987): what lies on an axis is handed to the link before it.
pub(super) fn line(chain: &mut Chain) -> Vec<Link> {
    let (mut links, own) = laid_out(chain);
    let g = &mut chain.g;
    for k in (0..links.len()).rev() {
        let handed = match links[k].slide {
            None => links[k].moments.take_axis(),
            Some(_) => links[k].moments.take_second(),
        };
        let Some(before) = k.checked_sub(1) else { break };
        // A line of mass about its own axis stands as it is.
        let handed = if links[k].slide.is_some() { handed.turned(g, &own[k], 2) } else { handed };
        let handed = links[k].lean.moments(g, &handed).moved(g, links[k].offset);
        links[before].moments = links[before].moments.with(g, &handed);
    }
    links
}

/// The links without mass.
pub(super) fn weightless(chain: &mut Chain) -> Vec<Link> {
    let (mut links, _) = laid_out(chain);
    links.iter_mut().for_each(|link| link.moments = Moments::default());
    links
}

/// The links with the mass that is fixed to each, and the angle of each joint by itself.
fn laid_out(chain: &mut Chain) -> (Vec<Link>, Vec<Turn>) {
    let (robot, n) = (chain.robot, chain.dof());
    let zero = Expr::ZERO;
    let mut links: Vec<Link> = Vec::new();
    let mut own = Vec::new();
    // From the origin of the last link to its row's frame, along its z.
    let mut behind = zero;
    for row in 0..n {
        let joint = &robot.joints[row];
        let g = &mut chain.g;
        let (d, theta) = (length(g, robot, &joint.d), Turn::constant(g, &joint.theta));
        let (turn, slide) = match joint.motion {
            Motion::Revolute => (Turn::joint(g, row).plus(g, &theta), None),
            Motion::Prismatic => (theta, Some(g.symbol(Symbol::Joint(row)))),
        };
        let leaning = match robot.convention {
            Convention::Standard => row.checked_sub(1),
            Convention::Modified => Some(row),
        };
        let (lean, a) = match leaning {
            Some(row) => leans(chain, row),
            None => (Lean::NONE, [zero; 3]),
        };
        let begins = row == 0 || !lean.is_straight();
        let g = &mut chain.g;
        let mut offset = a;
        let (opposite, turned) = if begins {
            offset[2] = g.add(a[2], core::mem::take(&mut behind));
            (false, turn.clone())
        } else {
            let before = &links[row - 1];
            let over = lean.0[0].is_half_turn();
            behind = behind.signed(over);
            let angle = if over { before.turn.negated() } else { before.turn.clone() };
            (before.opposite != over, angle.plus(g, &turn))
        };
        links.push(Link {
            begins,
            lean,
            opposite,
            turn: turned,
            offset,
            slide,
            row: RowFrame { lean: Lean::NONE, origin: [zero; 3] },
            moments: Moments::default(),
        });
        own.push(turn);
        let foot = behind;
        behind = chain.g.add(behind, d);
        links[row].row = RowFrame::of(chain, row, behind);
        weigh(chain, &mut links, row, [foot, behind]);
    }
    (links, own)
}

/// The turns of a row behind (standard) or before (modified) its joint, and the translation with them.
fn leans(chain: &mut Chain, row: usize) -> (Lean, Vec3) {
    let joint = &chain.robot.joints[row];
    let g = &mut chain.g;
    let lean = Lean([&joint.alpha, &joint.beta].map(|angle| Turn::constant(g, angle)));
    let along = [length(g, chain.robot, &joint.a), Expr::ZERO, Expr::ZERO];
    let offset = match chain.robot.convention {
        Convention::Standard => along,
        Convention::Modified => lean.outwards(g, along),
    };
    (lean, offset)
}

/// Adds the mass of a row, and of its beam, to the links that carry them; `foot` and `head` are where the
/// row's translation along z begins and ends, from the link's origin.
fn weigh(chain: &mut Chain, links: &mut [Link], row: usize, [foot, head]: [Expr; 2]) {
    let joint = &chain.robot.joints[row];
    let (lean, along) = leans(chain, row);
    let zero = Expr::ZERO;
    if let Some(mass) = &joint.mass {
        let g = &mut chain.g;
        let mass = expression(g, mass);
        let centre = joint.com.each_ref().map(|c| expression(g, c));
        let second = second(g, joint.inertia.as_ref());
        let at = Moments::body(g, mass, centre, second);
        let frame = &links[row].row;
        let at = frame.lean.moments(g, &at).moved(g, frame.origin);
        links[row].moments = links[row].moments.with(g, &at);
    }
    let mass = beam_mass(chain, row);
    // In the modified convention it is fixed to the link before, and of the first row to the base.
    let (carrier, chord, start) = match chain.robot.convention {
        Convention::Standard => {
            let d = chain.g.sub(head, foot);
            (Some(row), [along[0], along[1], d], [zero, zero, foot])
        }
        Convention::Modified => {
            let g = &mut chain.g;
            let d = g.sub(head, foot);
            let up = lean.outwards(g, [zero, zero, d]);
            let link = &links[row];
            // Where the row begins, the translations left to the end of the run before are in its offset.
            let start = if link.begins {
                g.sub(link.offset[2], along[2])
            } else {
                foot.signed(lean.0[0].is_half_turn())
            };
            (row.checked_sub(1), g.add3(along, up), [zero, zero, start])
        }
    };
    let (Some(carrier), false) = (carrier, mass.is_zero()) else { return };
    let g = &mut chain.g;
    let half = g.number(Number::ratio(1, 2));
    let middle = g.scale3(half, chord);
    let centre = g.add3(start, middle);
    // A thin rod: m/12 along its chord, both ways.
    let twelfth = g.number(Number::ratio(1, 12));
    let scaled = g.mul(twelfth, mass);
    let rod = chord.map(|x| {
        let x = g.mul(scaled, x);
        chord.map(|y| g.mul(x, y))
    });
    let rod = Moments::body(g, mass, centre, rod);
    links[carrier].moments = links[carrier].moments.with(g, &rod);
}

/// Second moments of mass of a tensor of inertia: `tr/2 − I`.
fn second(g: &mut Graph, tensor: Option<&[Value; 6]>) -> [Vec3; 3] {
    let Some(tensor) = tensor else { return [[Expr::ZERO; 3]; 3] };
    let [xx, xy, xz, yy, yz, zz] = tensor.each_ref().map(|value| expression(g, value));
    let half = g.number(Number::ratio(1, 2));
    let sum = g.add(xx, yy);
    let trace = g.add(sum, zz);
    let mean = g.mul(half, trace);
    let [x, y, z] = [xx, yy, zz].map(|moment| g.sub(mean, moment));
    [[x, -xy, -xz], [-xy, y, -yz], [-xz, -yz, z]]
}
