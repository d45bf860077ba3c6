//! The recursion of Newton and Euler (Luh, Walker & Paul 1980), each link in its own axes.
//!
//! With `U = [ω̇]× + [ω]×²` a point of a link at `r` from its origin accelerates by `p̈ + U r`. So the force on
//! the link is `m p̈ + U s` of its first moments s, and the moment about the origin `s × p̈` and the skew part of
//! `U S` of its second moments S (Khalil & Kleinfinger 1987). As nothing of S lies along z once the moments
//! are regrouped, that takes thirteen products.

use super::composite::levers;
use super::line::Link;
use crate::expr::{Expr, Graph, Vec3};

/// What the joints do, and what pulls at the links.
pub(super) struct Motion<'m> {
    pub rates: &'m [Expr],
    pub accelerations: &'m [Expr],
    /// In base axes, m/s².
    pub gravity: Vec3,
}

/// Force and moment on a link.
pub(super) type Load = (Vec3, Vec3);

/// A link's angular velocity and acceleration, and the acceleration of its origin.
#[derive(Clone, Copy, Default)]
pub(super) struct State {
    pub spin: Vec3,
    pub spin_rate: Vec3,
    pub acceleration: Vec3,
}

/// How the points of a link accelerate.
#[derive(Clone, Copy, Default)]
pub(super) struct Field {
    /// `[ω̇]× + [ω]×²`, rows.
    pub u: [Vec3; 3],
    /// `U_zz − U_yy`, `U_xx − U_zz`, `U_yy − U_xx`: without the sums that they have in common.
    pub differences: Vec3,
}

impl Field {
    pub fn new(g: &mut Graph, w: Vec3, rate: Vec3) -> Field {
        let [x, y, z] = w;
        let squares = w.map(|c| g.mul(c, c));
        let [xy, xz, yz] = [(x, y), (x, z), (y, z)].map(|(a, b)| g.mul(a, b));
        let diagonal: Vec3 =
            core::array::from_fn(|k| -g.add(squares[(k + 1) % 3], squares[(k + 2) % 3]));
        let differences =
            core::array::from_fn(|k| g.sub(squares[(k + 2) % 3], squares[(k + 1) % 3]));
        let u = [
            [diagonal[0], g.sub(xy, rate[2]), g.add(xz, rate[1])],
            [g.add(xy, rate[2]), diagonal[1], g.sub(yz, rate[0])],
            [g.sub(xz, rate[1]), g.add(yz, rate[0]), diagonal[2]],
        ];
        Field { u, differences }
    }

    /// `U r`.
    pub fn times(&self, g: &mut Graph, r: Vec3) -> Vec3 {
        self.u.map(|row| g.dot3(row, r))
    }

    /// The force on a link and the moment about its origin, which accelerates by `p`.
    fn load(&self, g: &mut Graph, link: &Link, p: Vec3) -> Load {
        let moments = &link.moments;
        let (inertial, lifted) = (self.times(g, moments.first), g.scale3(moments.mass, p));
        let force = g.add3(inertial, lifted);
        let [[_, xy, xz], [yx, _, yz], [zx, zy, _]] = self.u;
        let [d0, d1, d2] = self.differences;
        let s = moments.second;
        let x = g.products([
            (s[0][1], zx),
            (s[1][1], zy),
            (s[0][2], -yx),
            (s[1][2], d0),
            (s[2][2], -yz),
        ]);
        let y = g.products([
            (s[0][2], d1),
            (s[1][2], xy),
            (s[0][0], -zx),
            (s[0][1], -zy),
            (s[2][2], xz),
        ]);
        // Without a turn about x or y the two are one.
        let about = match xy == -yx {
            true => {
                let both = g.add(s[0][0], s[1][1]);
                [(both, yx), (Expr::ZERO, xy)]
            }
            false => [(s[0][0], yx), (s[1][1], -xy)],
        };
        let z = g.products([about[0], about[1], (s[0][1], d2), (s[0][2], yz), (s[1][2], -xz)]);
        let lever = g.cross3(moments.first, p);
        (force, g.add3([x, y, z], lever))
    }
}

/// What the motors give so that the links move, rotors and friction apart.
pub(super) fn newton_euler(g: &mut Graph, links: &[Link], motion: &Motion<'_>) -> Vec<Expr> {
    let levers = levers(g, links);
    let states = outwards(g, links, motion);
    let borne = loads(g, links, &states, &levers);
    links.iter().zip(borne).map(|(link, load)| link.borne(load)).collect()
}

/// What each joint bears of its link and of all beyond, about its origin in its run's axes.
pub(super) fn loads(
    g: &mut Graph,
    links: &[Link],
    states: &[(State, State)],
    levers: &[Vec3],
) -> Vec<Load> {
    let load = |(link, (state, _)): (&Link, &(State, State))| {
        let field = Field::new(g, state.spin, state.spin_rate);
        field.load(g, link, state.acceleration)
    };
    let loads: Vec<Load> = links.iter().zip(states).map(load).collect();
    inwards(g, links, &loads, levers)
}

/// How each link moves, in its own axes; and the link that carries its run, but with the acceleration of the link's own
/// origin, in the run's.
pub(super) fn outwards(g: &mut Graph, links: &[Link], motion: &Motion<'_>) -> Vec<(State, State)> {
    let mut states: Vec<(State, State)> = Vec::new();
    // A base that is thrown upwards weighs its links down.
    let acceleration = motion.gravity.map(|c| -c);
    // The link before the run in the run's axes, and the rates about the run's z.
    let mut run = State { acceleration, ..State::default() };
    let mut field = Field::default();
    let mut turning = [Expr::ZERO; 2];
    for (k, link) in links.iter().enumerate() {
        let last = states.last().map_or(run, |(of_link, _)| *of_link);
        let carried = field.times(g, link.offset);
        if link.begins {
            let at = g.add3(last.acceleration, carried);
            let [spin, spin_rate, acceleration] =
                [last.spin, last.spin_rate, at].map(|v| link.lean.inwards(g, v));
            run = State { spin, spin_rate, acceleration };
            turning = [Expr::ZERO; 2];
        } else {
            let carried = links[k - 1].outwards_to_run(g, carried);
            run.acceleration = g.add3(run.acceleration, carried);
        }
        let (rate, acceleration) = (motion.rates[k], motion.accelerations[k]);
        if link.slide.is_none() {
            turning = [
                g.add(turning[0], link.signed(rate)),
                g.add(turning[1], link.signed(acceleration)),
            ];
        }
        let [w, wd] = turning.map(|x| link.signed(x));
        let spin = link.run_to_link(g, run.spin);
        let spin_rate = link.run_to_link(g, run.spin_rate);
        // ω̇ + ω × z w + z ẇ
        let (x, y) = (g.mul(spin[1], w), g.mul(spin[0], w));
        let spin_rate = [g.add(spin_rate[0], x), g.sub(spin_rate[1], y), g.add(spin_rate[2], wd)];
        let spin = [spin[0], spin[1], g.add(spin[2], w)];
        field = Field::new(g, spin, spin_rate);
        let mut at = link.run_to_link(g, run.acceleration);
        if let Some(slide) = link.slide {
            // U z s + 2 ω × z ṡ + z s̈
            let out = field.times(g, [Expr::ZERO, Expr::ZERO, slide]);
            let twice = g.add(rate, rate);
            let (x, y) = (g.mul(spin[1], twice), g.mul(spin[0], twice));
            let coriolis = [x, -y, acceleration];
            let slid = g.add3(out, coriolis);
            let in_run = link.outwards_to_run(g, slid);
            run.acceleration = g.add3(run.acceleration, in_run);
            at = g.add3(at, slid);
        }
        states.push((State { spin, spin_rate, acceleration: at }, run));
        let i = k + 1;
        for (v, name) in [(spin, "w"), (spin_rate, "dw"), (at, "a")] {
            g.name3(v, &format!("{name}{i}"));
        }
    }
    states
}

/// What each joint bears of its link and of all beyond.
fn inwards(g: &mut Graph, links: &[Link], loads: &[Load], levers: &[Vec3]) -> Vec<Load> {
    let mut borne = loads.to_vec();
    let none = ([Expr::ZERO; 3], [Expr::ZERO; 3]);
    // Of the run beyond, about the origin and in the axes of the link that carries it; of the run's links
    // beyond, in its axes.
    let (mut beyond, mut run): (Load, Load) = (none, none);
    for (k, link) in links.iter().enumerate().rev() {
        let (force, moment) = loads[k];
        let own = (g.add3(force, beyond.0), g.add3(moment, beyond.1));
        beyond = none;
        let here = [own.0, own.1].map(|v| link.outwards_to_run(g, v));
        run = (g.add3(run.0, here[0]), g.add3(run.1, here[1]));
        g.name3(run.0, &format!("f{}", k + 1));
        g.name3(run.1, &format!("n{}", k + 1));
        borne[k] = run;
        // About the origin of the link before.
        let lever = g.cross3(levers[k], run.0);
        run.1 = g.add3(run.1, lever);
        if link.begins {
            let (force, moment) = (link.lean.outwards(g, run.0), link.lean.outwards(g, run.1));
            let lever = g.cross3(link.offset, force);
            beyond = (force, g.add3(moment, lever));
            run = none;
        }
    }
    borne
}
