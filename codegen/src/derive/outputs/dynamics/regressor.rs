//! The regressor of the torques: what each moment of mass costs each joint.
//!
//! A unit of a moment of mass in its row's frame has a load of a few numbers, and a joint bears of it what its twist
//! there makes of it (the principle of virtual work): `v·f + z·n`, with the velocity v of the row's origin and the
//! angular velocity z at a unit of the joint's rate. Twists are carried outwards once for all ten units of a row, where
//! the load of each would have to be carried inwards by itself.

use super::composite::levers;
use super::line::Link;
use super::newton_euler::{Field, Motion, State, outwards};
use crate::expr::{Expr, Graph, Vec3};

/// Velocities at a unit of one joint's rate.
#[derive(Clone, Copy)]
struct Twist {
    /// Angular.
    z: Vec3,
    /// Of the origin.
    v: Vec3,
}

impl Twist {
    /// Of the point at `by` from the origin.
    fn moved(self, g: &mut Graph, by: Vec3) -> Twist {
        let carried = g.cross3(self.z, by);
        Twist { z: self.z, v: g.add3(self.v, carried) }
    }

    fn map(self, mut turn: impl FnMut(Vec3) -> Vec3) -> Twist {
        Twist { z: turn(self.z), v: turn(self.v) }
    }
}

/// Joint by moment of mass, column-major; ten columns for each row: m, m c, and xx, xy, yy, xz, yz, zz of the tensor of
/// inertia about the row's origin.
pub(super) fn regressor(g: &mut Graph, links: &[Link], motion: &Motion<'_>) -> Vec<Expr> {
    let (states, levers) = (outwards(g, links, motion), levers(g, links));
    // Of the joints so far, at the link's origin and in the run's axes.
    let mut twists: Vec<Twist> = Vec::new();
    let mut columns = Vec::new();
    for (k, link) in links.iter().enumerate() {
        for twist in &mut twists {
            if link.begins {
                let of_link = twist.map(|v| links[k - 1].run_to_link(g, v));
                *twist = of_link.moved(g, link.offset).map(|v| link.lean.inwards(g, v));
            }
            *twist = twist.moved(g, levers[k]);
        }
        let axis = [Expr::ZERO, Expr::ZERO, link.signed(Expr::ONE)];
        twists.push(match link.slide {
            None => Twist { z: axis, v: [Expr::ZERO; 3] },
            Some(_) => Twist { z: [Expr::ZERO; 3], v: axis },
        });
        let of_row = twists.iter().map(|twist| {
            let of_link = twist.map(|v| link.run_to_link(g, v)).moved(g, link.row.origin);
            of_link.map(|v| link.row.lean.inwards(g, v))
        });
        let of_row: Vec<Twist> = of_row.collect();
        for (force, moment) in unit_loads(g, link, &states[k].0) {
            columns.extend(of_row.iter().map(|twist| {
                let (pushed, turned) = (g.dot3(force, twist.v), g.dot3(moment, twist.z));
                g.add(pushed, turned)
            }));
            columns.extend((k + 1..links.len()).map(|_| Expr::ZERO));
        }
    }
    columns
}

/// Force and moment about the row's origin that a unit of each moment of mass takes, in the row's axes: `m a`, the force
/// `U s` and the moment `s × a` of the first moments s, `I ω̇ + ω × I ω` of the tensor.
fn unit_loads(g: &mut Graph, link: &Link, state: &State) -> [(Vec3, Vec3); 10] {
    let none = [Expr::ZERO; 3];
    let carried = Field::new(g, state.spin, state.spin_rate).times(g, link.row.origin);
    let at = g.add3(state.acceleration, carried);
    let [spin, rate, a] = [state.spin, state.spin_rate, at].map(|v| link.row.lean.inwards(g, v));
    let Field { u, differences: [d0, d1, d2] } = Field::new(g, spin, rate);
    let [[_, xy, xz], [yx, _, yz], [zx, zy, _]] = u;
    let products = [(1, 2), (0, 2), (0, 1)].map(|(i, j)| g.mul(spin[i], spin[j]));
    let [wyz, wxz, wxy] = products;
    let [ax, ay, az] = a;
    let of_tensor = [
        [rate[0], wxz, -wxy],
        [-zx, zy, -d2],
        [-wyz, rate[1], wxy],
        [yx, -d1, -yz],
        [-d0, -xy, xz],
        [wyz, -wxz, rate[2]],
    ];
    let levers = [[Expr::ZERO, -az, ay], [az, Expr::ZERO, -ax], [-ay, ax, Expr::ZERO]];
    core::array::from_fn(|k| match k {
        0 => (a, none),
        1..=3 => (u.map(|row| row[k - 1]), levers[k - 1]),
        _ => (none, of_tensor[k - 4]),
    })
}
