//! Which mass moves with a joint: the links that are fixed to each other behind it.

use nalgebra::{IsometryMatrix3, Point3, Vector3};
use urdf_rs::Link;

use super::chain::isometry;
use super::tree::{Tree, moves};

/// Mass and its centre.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lump {
    /// kg.
    pub mass: f64,
    /// Mass times centre, kg·m.
    moment: Vector3<f64>,
}

impl Lump {
    /// The centre of mass; none without mass.
    pub fn centre(&self) -> Option<Point3<f64>> {
        (self.mass > 0.0).then(|| Point3::from(self.moment / self.mass))
    }

    fn add(&mut self, link: &Link, frame: &IsometryMatrix3<f64>) {
        let mass = link.inertial.mass.value;
        let centre = frame * isometry(&link.inertial.origin);
        self.mass += mass;
        self.moment += centre.translation.vector * mass;
    }
}

/// All that is fixed to `link`, in its frame. Branches that move are left out and remarked on; the
/// way to the tip is not.
pub fn lump(tree: &Tree<'_>, link: &str, tip: &str, remarks: &mut Vec<String>) -> Lump {
    let mut lump = Lump::default();
    let mut open = vec![(link.to_owned(), IsometryMatrix3::identity())];
    while let Some((name, frame)) = open.pop() {
        if let Some(link) = tree.link(&name) {
            lump.add(link, &frame);
        }
        for joint in tree.below(&name) {
            let child = &joint.child.link;
            if !moves(joint) {
                open.push((child.clone(), frame * isometry(&joint.origin)));
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
    let own = tree.link(link).map_or(0.0, |link| link.inertial.mass.value);
    own + tree.below(link).iter().map(|joint| whole(tree, &joint.child.link)).sum::<f64>()
}
