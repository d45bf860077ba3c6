//! Which mass moves with a joint: the links that are fixed to each other behind it.

use super::chain::frame;
use super::document::Link;
use super::tree::{Tree, moves};
use crate::robot::space::{Frame, Vector, dot, plus, times};

/// The moments of a mass: its sum, its centre and how it is spread.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lump {
    /// kg.
    pub mass: f64,
    /// Mass times centre, kg·m.
    moment: Vector,
    /// The sum of each mass times its place, times its place again, kg·m²; rows.
    second: [Vector; 3],
    /// Whether more is known than masses at points.
    spread: bool,
}

impl Lump {
    /// A mass at a point.
    pub fn new(mass: f64, centre: Vector) -> Lump {
        let second = outer(centre, times(centre, mass));
        Lump { mass, moment: times(centre, mass), second, spread: false }
    }

    /// A mass around a point: its tensor of inertia (xx, xy, xz, yy, yz, zz) about that point in the axes of
    /// `at`, whose origin is the point.
    pub fn spread(mass: f64, at: &Frame, tensor: [f64; 6]) -> Lump {
        let [xx, xy, xz, yy, yz, zz] = tensor;
        let half = (xx + yy + zz) / 2.0;
        let own = [[half - xx, -xy, -xz], [-xy, half - yy, -yz], [-xz, -yz, half - zz]];
        let point = Lump::new(mass, at.origin);
        let mut second = point.second;
        for (axis, row) in at.axes.iter().zip(own) {
            let along = (0..3).fold([0.0; 3], |sum, k| plus(sum, row[k], at.axes[k]));
            second = sum(second, outer(*axis, along));
        }
        Lump { second, spread: tensor != [0.0; 6], ..point }
    }

    /// The tensor of inertia about the centre in the axes of a frame, xx, xy, xz, yy, yz, zz; none of masses at
    /// points.
    pub fn tensor(&self, axes: &[Vector; 3]) -> Option<[f64; 6]> {
        let centre = self.centre().filter(|_| self.spread)?;
        let about = sum(self.second, outer(centre, times(self.moment, -1.0)));
        let entry = |i: usize, j: usize| dot(axes[i], about.map(|row| dot(row, axes[j])));
        let trace = entry(0, 0) + entry(1, 1) + entry(2, 2);
        let diagonal = |k| trace - entry(k, k);
        let (xy, xz, yz) = (entry(0, 1), entry(0, 2), entry(1, 2));
        Some([diagonal(0), -xy, -xz, diagonal(1), -yz, diagonal(2)])
    }

    /// The same as a point.
    pub fn at_a_point(&self) -> Lump {
        self.centre().map_or(*self, |centre| Lump::new(self.mass, centre))
    }

    /// The centre of mass; none without mass.
    pub fn centre(&self) -> Option<Vector> {
        (self.mass > 0.0).then(|| times(self.moment, 1.0 / self.mass))
    }

    fn add(&mut self, link: &Link, at: &Frame) {
        let other = Lump::spread(link.mass, &at.then(&frame(&link.centre)), link.inertia);
        self.mass += other.mass;
        self.moment = plus(self.moment, 1.0, other.moment);
        self.second = sum(self.second, other.second);
        self.spread |= other.spread;
    }
}

fn outer(a: Vector, b: Vector) -> [Vector; 3] {
    a.map(|x| times(b, x))
}

fn sum(a: [Vector; 3], b: [Vector; 3]) -> [Vector; 3] {
    core::array::from_fn(|k| plus(a[k], 1.0, b[k]))
}

/// All that is fixed to `link`, in its frame. Branches that move are left out and remarked on; the
/// way to the tip is not.
pub fn lump(tree: &Tree<'_>, link: &str, tip: &str, remarks: &mut Vec<String>) -> Lump {
    let mut lump = Lump::default();
    let mut open = vec![(link.to_owned(), Frame::IDENTITY)];
    while let Some((name, at)) = open.pop() {
        if let Some(link) = tree.link(&name) {
            lump.add(link, &at);
        }
        for joint in tree.below(&name) {
            let child = &joint.child;
            if !moves(joint) {
                open.push((child.clone(), at.then(&frame(&joint.origin))));
            } else if tree.path(child, tip).is_err() {
                let mass = whole(tree, child);
                let weight = if mass > 0.0 { format!(", {mass} kg") } else { String::new() };
                remarks.push(format!(
                    "left out: link `{child}` and what hangs on it{weight}: joint `{}` moves it, \
                     and it is not on the way to `{tip}`",
                    joint.name
                ));
            }
        }
    }
    lump
}

/// The mass of a link and of all below it.
fn whole(tree: &Tree<'_>, link: &str) -> f64 {
    let own = tree.link(link).map_or(0.0, |link| link.mass);
    own + tree.below(link).iter().map(|joint| whole(tree, &joint.child)).sum::<f64>()
}
