//! Derivatives of the torques in closed form (Singh, Russell & Wensing 2022), by what each joint carries as one body.
//!
//! Where joint i turns, or changes its rate, all beyond it moves as one body, and every joint before it bears what that
//! takes: one load, carried inwards like those of the mass matrix. What joint i bears where a joint j before it moves is
//! told by the load of a unit of joint i, carried to j, and by a vector that multiplies the change of j's spin. Velocities
//! are told from the origin at hand: how fast it moves itself drops out.

use super::composite::{carried, levers, unit_load};
use super::line::{Lean, Link};
use super::moments::Moments;
use super::newton_euler::{Load, Motion, State, loads, outwards};
use crate::expr::{Expr, Graph, Vec3};
use crate::number::Number;

const NONE: Vec3 = [Expr::ZERO; 3];

/// A body that moves: `∫ v dm` and `∫ v rᵀ dm`, rows, of velocities v from the origin's beside its moments of mass.
#[derive(Clone, Default)]
struct Body {
    moments: Moments,
    momentum: Vec3,
    flow: [Vec3; 3],
}

impl Body {
    fn of_link(g: &mut Graph, link: &Link, spin: Vec3) -> Body {
        let moments = link.moments.clone();
        let momentum = g.cross3(spin, moments.first);
        let columns = moments.second.map(|column| g.cross3(spin, column));
        let flow = core::array::from_fn(|row| columns.map(|column| column[row]));
        Body { moments, momentum, flow }
    }

    fn with(&self, g: &mut Graph, other: &Body) -> Body {
        Body {
            moments: self.moments.with(g, &other.moments),
            momentum: g.add3(self.momentum, other.momentum),
            flow: core::array::from_fn(|row| g.add3(self.flow[row], other.flow[row])),
        }
    }

    /// Seen from an origin from which the old one is at `by`, and has the velocity `slip`.
    fn moved(&self, g: &mut Graph, by: Vec3, slip: Vec3) -> Body {
        let moments = self.moments.moved(g, by);
        let flow = core::array::from_fn(|row| {
            core::array::from_fn(|column| {
                let (far, swept) = (
                    g.mul(self.momentum[row], by[column]),
                    g.mul(slip[row], moments.first[column]),
                );
                let both = g.add(far, swept);
                g.add(self.flow[row][column], both)
            })
        });
        let lifted = g.scale3(moments.mass, slip);
        Body { momentum: g.add3(self.momentum, lifted), moments, flow }
    }

    fn in_run(&self, g: &mut Graph, link: &Link) -> Body {
        Body {
            moments: link.moments_in_run(g, &self.moments),
            momentum: link.outwards_to_run(g, self.momentum),
            flow: link.matrix_in_run(g, &self.flow),
        }
    }

    fn leaning(&self, g: &mut Graph, lean: &Lean) -> Body {
        Body {
            moments: lean.moments(g, &self.moments),
            momentum: lean.outwards(g, self.momentum),
            flow: lean.matrix(g, &self.flow),
        }
    }
}

/// `∂τ/∂q` and `∂τ/∂q̇`, n×n column-major, rotors and friction apart.
pub(super) fn derivatives(g: &mut Graph, links: &[Link], motion: &Motion<'_>) -> [Vec<Expr>; 2] {
    let n = links.len();
    let [mut by_joints, mut by_rates] = [(); 2].map(|()| vec![Expr::ZERO; n * n]);
    let levers = levers(g, links);
    let states = outwards(g, links, motion);
    let loads = loads(g, links, &states, &levers);
    let ways: Vec<Way> = (0..n).map(|k| Way::of(g, links, &states, motion, k)).collect();
    let two = g.number(Number::integer(2));
    // Of the run beyond in the axes of the link that carries it; of the run's links beyond, in its axes.
    let (mut beyond, mut run) = (Body::default(), Body::default());
    for (k, link) in links.iter().enumerate().rev() {
        let own = Body::of_link(g, link, states[k].0.spin).with(g, &beyond);
        let in_run = own.in_run(g, link);
        // A turn about the axis changes neither sum.
        let across = [&own, &run].map(|body| in_plane(g, &body.moments.second));
        let across = g.add(across[0], across[1]);
        let swirl = [&own, &run].map(|body| in_plane(g, &body.flow));
        let swirl = g.add(swirl[0], swirl[1]);
        run = run.with(g, &in_run);

        let unit = unit_load(link, &run.moments, across);
        let taken = run.taken(g, link, &ways[k], [across, swirl], loads[k]);
        let [by_joint, by_rate] = taken.map(|load| carried(g, links, &levers, k, load));
        let borne = by_joint.into_iter().zip(by_rate);
        for (i, (inner, (by_joint, by_rate))) in links.iter().zip(borne).enumerate() {
            by_joints[k * n + i] = inner.borne(by_joint);
            by_rates[k * n + i] = g.mul(two, inner.borne(by_rate));
        }
        let units = carried(g, links, &levers, k, unit);
        let mut turning = run.turning(link, swirl);
        for i in (0..k).rev() {
            turning = ways[i + 1].inwards(g, links, i + 1, turning, units[i + 1].0);
            let [by_joint, by_rate] = ways[i].borne_beyond(g, &links[i], turning, units[i]);
            by_joints[i * n + k] = links[i].signed(by_joint);
            by_rates[i * n + k] = links[i].signed(g.mul(two, by_rate));
        }

        run = run.moved(g, levers[k], ways[k].slip);
        beyond = Body::default();
        if link.begins {
            beyond = run.leaning(g, &link.lean).moved(g, link.offset, ways[k].swing);
            run = Body::default();
        }
    }
    [by_joints, by_rates]
}

/// The first two of a matrix's diagonal.
fn in_plane(g: &mut Graph, matrix: &[Vec3; 3]) -> Expr {
    g.add(matrix[0][0], matrix[1][1])
}

/// `(tr(A) − A) v`, with `A_xx + A_yy` known.
fn about(g: &mut Graph, matrix: &[Vec3; 3], plane: Expr, v: Vec3) -> Vec3 {
    core::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let own = if i == 2 { plane } else { g.add(matrix[j][j], matrix[k][k]) };
        let mut row = matrix[i].map(|entry| -entry);
        row[i] = own;
        g.dot3(row, v)
    })
}

/// `z × v`.
fn across_z([x, y, _]: Vec3) -> Vec3 {
    [-y, x, Expr::ZERO]
}

impl Body {
    /// The loads that the joint's turn, and half of a unit of its rate, take; `load` is what the joint bears. For all that
    /// is carried, `2 B Ψ̇ + I Ψ̈ + S ×̄* f` and `B S + I Ψ̇`.
    fn taken(
        &self,
        g: &mut Graph,
        link: &Link,
        way: &Way,
        [across, swirl]: [Expr; 2],
        load: Load,
    ) -> [Load; 2] {
        let Moments { mass, first, second } = &self.moments;
        let taken = if link.slide.is_some() {
            let mut pushed = |v: Vec3| (g.scale3(*mass, v), g.cross3(*first, v));
            let [by_joint, by_rate] = [way.acceleration, way.rate].map(&mut pushed);
            [(by_joint.0, g.add3(by_joint.1, across_z(load.0))), by_rate]
        } else {
            let two = g.number(Number::integer(2));
            let twice = g.scale3(two, way.rate);
            let forces = [
                g.cross3(way.acceleration, *first),
                g.scale3(*mass, way.weight),
                g.cross3(twice, self.momentum),
                across_z(load.0),
            ];
            let moments = [
                about(g, second, across, way.acceleration),
                g.cross3(*first, way.weight),
                about(g, &self.flow, swirl, twice),
                across_z(load.1),
            ];
            let by_joint = (g.sum3(forces), g.sum3(moments));
            let forces = [g.cross3(way.rate, *first), across_z(self.momentum)];
            let swept = [-self.flow[0][2], -self.flow[1][2], swirl];
            let moments = [about(g, second, across, way.rate), swept];
            [by_joint, (g.sum3(forces), g.sum3(moments))]
        };
        taken.map(|(f, m)| (f.map(|c| link.signed(c)), m.map(|c| link.signed(c))))
    }

    /// What half of the joint's load changes by with the spin of what it carries, `Bᵀ S`.
    fn turning(&self, link: &Link, swirl: Expr) -> Vec3 {
        let turning = match link.slide {
            Some(_) => [self.momentum[1], -self.momentum[0], Expr::ZERO],
            None => [-self.flow[2][0], -self.flow[2][1], swirl],
        };
        turning.map(|c| link.signed(c))
    }
}

/// How a joint's axis and origin move, in its run's axes.
struct Way {
    /// `ω × z` of the run's z.
    rate: Vec3,
    /// `ω̇ × z + ω × (ω × z)`.
    acceleration: Vec3,
    /// `p̈ × z` of the origin.
    weight: Vec3,
    /// How fast the origin goes from the one before in the run; of the first of a run, from where the run begins.
    slip: Vec3,
    /// How fast the run's beginning goes from the origin of the link that carries it, in that link's axes.
    swing: Vec3,
}

impl Way {
    fn of(
        g: &mut Graph,
        links: &[Link],
        states: &[(State, State)],
        motion: &Motion<'_>,
        k: usize,
    ) -> Way {
        let (link, run) = (&links[k], &states[k].1);
        let [x, y, z] = run.spin;
        let [xz, yz, xx, yy] = [(x, z), (y, z), (x, x), (y, y)].map(|(a, b)| g.mul(a, b));
        let rate = [y, -x, Expr::ZERO];
        // The turns about z that the run adds to the spin change nothing of it.
        let [dx, dy, _] = run.spin_rate;
        let acceleration = [g.add(xz, dy), g.sub(yz, dx), -g.add(xx, yy)];
        let [ax, ay, _] = run.acceleration;
        let carrier = k.checked_sub(1).map(|before| (&links[before], states[before].0.spin));
        let swung = carrier.map_or(NONE, |(_, spin)| g.cross3(spin, link.offset));
        let (mut slip, swing) = match carrier {
            Some((before, _)) if !link.begins => (before.outwards_to_run(g, swung), NONE),
            _ => (NONE, swung),
        };
        if let Some(slide) = link.slide {
            let turned = g.scale3(link.signed(slide), rate);
            slip = g.sum3([slip, turned, [Expr::ZERO, Expr::ZERO, link.signed(motion.rates[k])]]);
        }
        Way { rate, acceleration, weight: [ay, -ax, Expr::ZERO], slip, swing }
    }

    /// What multiplies a spin, from link `k`'s origin to that of the link before, whose run's axes it is then told in. The
    /// bodies are then faster by as much as the one origin is than the other; `force` is that of the unit load at `k`.
    fn inwards(&self, g: &mut Graph, links: &[Link], k: usize, turning: Vec3, force: Vec3) -> Vec3 {
        let link = &links[k];
        let swept = g.cross3(self.slip, force);
        let turning = g.add3(turning, swept);
        if !link.begins {
            return turning;
        }
        let (turning, force) = (link.lean.outwards(g, turning), link.lean.outwards(g, force));
        let swept = g.cross3(self.swing, force);
        let turning = g.add3(turning, swept);
        links[k - 1].outwards_to_run(g, turning)
    }

    /// What a joint beyond bears where this one turns, and half of it where its rate changes.
    fn borne_beyond(
        &self,
        g: &mut Graph,
        link: &Link,
        turning: Vec3,
        (force, moment): Load,
    ) -> [Expr; 2] {
        if link.slide.is_some() {
            return [g.dot3(force, self.acceleration), g.dot3(force, self.rate)];
        }
        let two = g.number(Number::integer(2));
        let twice = g.scale3(two, self.rate);
        let parts = [(turning, twice), (moment, self.acceleration), (force, self.weight)];
        let by_joint = parts.iter().fold(Expr::ZERO, |sum, (a, b)| {
            let part = g.dot3(*a, *b);
            g.add(sum, part)
        });
        let by_rate = g.dot3(moment, self.rate);
        [by_joint, g.add(turning[2], by_rate)]
    }
}
