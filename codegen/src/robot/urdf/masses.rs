//! Which mass moves with a joint: the links that are fixed to each other behind it.

use super::super::space::{Frame, Vector, plus, times};
use super::chain::frame;
use super::document::Link;
use super::tree::{Tree, moves};

/// Mass and its centre.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lump {
    /// kg.
    pub mass: f64,
    /// Mass times centre, kg·m.
    moment: Vector,
}

impl Lump {
    /// A mass at a point.
    pub fn new(mass: f64, centre: Vector) -> Lump {
        Lump { mass, moment: times(centre, mass) }
    }

    /// The centre of mass; none without mass.
    pub fn centre(&self) -> Option<Vector> {
        (self.mass > 0.0).then(|| times(self.moment, 1.0 / self.mass))
    }

    fn add(&mut self, link: &Link, at: &Frame) {
        self.mass += link.mass;
        self.moment = plus(self.moment, link.mass, at.point(link.centre.xyz));
    }
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
