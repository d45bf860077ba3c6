//! The chain in one posture: where its sites are, which load each carries, and how each gives.

use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3, Vector6};

use super::actual::{Actual, Law};
use super::beam::Link;
use super::site::Site;

/// The small transform of a displacement: translation, then rotation about the displaced origin.
pub(crate) fn transform(displacement: &Vector6<f64>) -> Isometry3<f64> {
    let d = displacement;
    let turn = Vector3::new(d[3], d[4], d[5]);
    Isometry3::from_parts(
        Translation3::new(d[0], d[1], d[2]),
        if turn == Vector3::zeros() {
            UnitQuaternion::identity()
        } else {
            UnitQuaternion::from_scaled_axis(turn)
        },
    )
}

/// The frame in which a site's displacement is expressed, and the one behind it; base frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frames {
    pub(super) before: Isometry3<f64>,
    pub(super) behind: Isometry3<f64>,
}

/// What does not change while the arm comes to rest.
pub(super) struct Walk<'a> {
    pub(super) actual: &'a Actual<'a>,
    pub(super) sites: usize,
    /// For each site the transform from the one before it.
    steps: Vec<Isometry3<f64>>,
    links: Vec<Option<Link<'a>>>,
}

impl<'a> Walk<'a> {
    pub(super) fn new(actual: &'a Actual<'a>) -> Self {
        let n = actual.arm.dof();
        let mut steps = Vec::with_capacity(Site::count(n));
        let mut links = Vec::with_capacity(n);
        steps.push(Isometry3::identity());
        for row in 0..n {
            let (before, behind) = actual.row(row);
            links.push(actual.link(row, &(before * behind)));
            steps.extend([before, behind]);
        }
        steps.push(actual.arm.tool);
        Self { actual, sites: steps.len(), steps, links }
    }

    pub(super) fn frames(&self, at: &[Vector6<f64>]) -> Vec<Frames> {
        let mut frames = Vec::new();
        self.put_frames(at, &mut frames);
        frames
    }

    /// The same in the place of what `frames` has.
    pub(super) fn put_frames(&self, at: &[Vector6<f64>], frames: &mut Vec<Frames>) {
        let mut frame = Isometry3::identity();
        let each = self.steps.iter().zip(at).map(|(step, displacement)| {
            let before = frame * step;
            frame = if *displacement == Vector6::zeros() {
                before
            } else {
                before * transform(displacement)
            };
            Frames { before, behind: frame }
        });
        frames.clear();
        frames.extend(each);
    }

    /// The wrench at each site, in its axes (those before its displacement) about its displaced
    /// origin, from everything beyond it.
    pub(super) fn loads(&self, frames: &[Frames]) -> Vec<Vector6<f64>> {
        let mut loads = Vec::new();
        self.put_loads(frames, &mut loads);
        loads
    }

    /// The same in the place of what `loads` has.
    pub(super) fn put_loads(&self, frames: &[Frames], loads: &mut Vec<Vector6<f64>>) {
        let tool = &frames[self.sites - 1].behind;
        let (mut force, at) = self.tip(tool);
        // About the base's origin.
        let mut moment = self.actual.wrench.fixed_rows::<3>(3) + at.cross(&force);
        loads.clear();
        loads.resize(self.sites, Vector6::zeros());
        for index in (0..self.sites).rev() {
            let Frames { before, behind } = &frames[index];
            if let Some((weight, at)) = self.mass(index, behind) {
                force += weight;
                moment += at.cross(&weight);
            }
            let turn = before.rotation.inverse();
            let (f, m) = (turn * force, turn * (moment - behind.translation.vector.cross(&force)));
            loads[index] = Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z);
            if let Some((weight, at)) = self.beam(index, before) {
                force += weight;
                moment += at.cross(&weight);
            }
        }
    }

    /// Whether a moment acts, which stays constant in base axes and follows no potential.
    pub(super) fn has_moment(&self) -> bool {
        self.actual.wrench.fixed_rows::<3>(3) != Vector3::zeros()
    }

    /// The link of a site behind a row. Sites alternate: the link's stands behind row
    /// (index − 2) / 2.
    fn row(&self, index: usize) -> Option<usize> {
        (index >= 2 && index.is_multiple_of(2)).then(|| index / 2 - 1)
    }

    /// The wrench's force, base axes, and where it acts, base frame.
    pub(super) fn tip(&self, tool: &Isometry3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let at = tool * Point3::from(self.actual.load_point);
        (self.actual.wrench.fixed_rows::<3>(0).into_owned(), at.coords)
    }

    /// The weight of the mass that the frame `behind` a site carries, and where it acts.
    pub(super) fn mass(
        &self,
        index: usize,
        behind: &Isometry3<f64>,
    ) -> Option<(Vector3<f64>, Vector3<f64>)> {
        let joint = &self.actual.arm.joints[self.row(index)?];
        let at = || (behind * Point3::from(joint.com)).coords;
        (joint.mass != 0.0).then(|| (self.actual.arm.gravity * joint.mass, at()))
    }

    /// The weight of a site's beam, and the middle of its length: it loads everything before it,
    /// and itself along its length.
    pub(super) fn beam(
        &self,
        index: usize,
        before: &Isometry3<f64>,
    ) -> Option<(Vector3<f64>, Vector3<f64>)> {
        let link = self.link(index)?;
        let at = (before * Point3::from(link.middle())).coords;
        Some((link.weight(&self.actual.arm.gravity), at))
    }

    /// The beam whose tip a site is.
    pub(super) fn link(&self, index: usize) -> Option<&Link<'a>> {
        self.links[self.row(index)?].as_ref()
    }

    /// The row whose spring a site is.
    pub(super) fn spring(&self, index: usize) -> Option<usize> {
        let row = index / 2;
        (index % 2 == 1 && row < self.actual.arm.dof()).then_some(row)
    }

    /// The laws by which a site gives, beside spring and beam.
    pub(super) fn laws(&self, index: usize) -> impl Iterator<Item = &'a Law> {
        let n = self.actual.arm.dof();
        let here = move |(site, law): &'a (Site, Law)| (site.index(n) == index).then_some(law);
        self.actual.laws.iter().filter_map(here)
    }

    pub(super) fn give(&self, index: usize, frames: &Frames, load: &Vector6<f64>) -> Vector6<f64> {
        let (mut sum, mut load) = (Vector6::zeros(), *load);
        if let Some(row) = self.spring(index) {
            load = self.actual.borne(row, &load);
            sum += self.actual.spring(row, &load);
        } else if let Some(link) = self.link(index) {
            let gravity = frames.before.rotation.inverse() * self.actual.arm.gravity;
            sum += link.give(&load, &link.weight(&gravity));
        }
        self.laws(index).fold(sum, |sum, law| sum + law(&load))
    }
}
