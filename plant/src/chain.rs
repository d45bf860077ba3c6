//! The arm as a product of transforms, some of which yield, and the work that its loads do.
//!
//! No wrench goes down this chain. All loads are forces at points that keep their direction (and
//! one couple at the tool); their work in an infinitesimal motion `p → p + G p` of everything
//! beyond a place is `Σ f · G p`, the product, element by element, of `G` with the *virial*
//! `V = Σ f [p; 1]ᵀ` of the points beyond. The generalised force of a displacement at a site is
//! that work per unit of the displacement, `G` being the derivative of the site's transform.

use nalgebra::{Matrix3x4, Matrix4, Vector3, Vector6};

use super::law::Law;
use super::transform::{self, carried, cross, displaced, inverse, left_jacobian, rotation};

/// A piece of the chain.
#[derive(Clone, Debug)]
pub(super) enum Part {
    /// A transform that does not yield.
    Fixed(Matrix4<f64>),
    /// A displacement that follows from the loads beyond.
    Site(Site),
    /// A force on a point of the frame that the chain has come to; base axes.
    Weight { point: Vector3<f64>, force: Vector3<f64> },
}

/// A place that yields.
#[derive(Clone, Debug)]
pub(super) struct Site {
    /// Index of its first unknown.
    pub(super) first: usize,
    /// Which components of its displacement are unknowns: 0 to 2 translate, 3 to 5 rotate.
    pub(super) components: Vec<usize>,
    pub(super) law: Law,
}

/// One row's arm, from the base to the tool.
#[derive(Clone, Debug, Default)]
pub(super) struct Chain {
    pub(super) parts: Vec<Part>,
    /// Number of unknowns.
    pub(super) unknowns: usize,
    /// On the tool, base axes.
    pub(super) force: Vector3<f64>,
    /// On the tool, base axes.
    pub(super) couple: Vector3<f64>,
    /// Where the force acts, in the tool frame.
    pub(super) payload: Vector3<f64>,
}

/// The chain at some displacements.
pub(super) struct Shape {
    /// The frame in which each site displaces, in the order of the parts.
    pub(super) sites: Vec<Matrix4<f64>>,
    /// The frame of the point of each weight, in the order of the parts.
    weights: Vec<Matrix4<f64>>,
    /// The tool frame.
    pub(super) tool: Matrix4<f64>,
}

impl Site {
    /// Its displacement out of all unknowns.
    fn displacement(&self, unknowns: &[f64]) -> Vector6<f64> {
        let mut all = Vector6::zeros();
        for (k, component) in self.components.iter().enumerate() {
            all[*component] = unknowns[self.first + k];
        }
        all
    }

    /// `(∂E/∂u) E⁻¹` of one component: the motion of everything beyond, in the site's axes.
    pub(super) fn motion(&self, displacement: &Vector6<f64>, component: usize) -> Matrix4<f64> {
        let mut motion = Matrix4::zeros();
        if component < 3 {
            motion[(component, 3)] = 1.0;
            return motion;
        }
        let turned = Vector3::new(displacement[3], displacement[4], displacement[5]);
        let axis: Vector3<f64> = left_jacobian(&turned).column(component - 3).into_owned();
        let centre = Vector3::new(displacement[0], displacement[1], displacement[2]);
        motion.fixed_view_mut::<3, 3>(0, 0).copy_from(&cross(&axis));
        motion.fixed_view_mut::<3, 1>(0, 3).copy_from(&-axis.cross(&centre));
        motion
    }
}

impl Chain {
    /// Transforms between which nothing yields or weighs are one.
    pub(super) fn fixed(&mut self, transform: Matrix4<f64>) {
        match self.parts.last_mut() {
            Some(Part::Fixed(before)) => *before *= transform,
            _ => self.parts.push(Part::Fixed(transform)),
        }
    }

    pub(super) fn weight(&mut self, point: Vector3<f64>, force: Vector3<f64>) {
        if force != Vector3::zeros() {
            self.parts.push(Part::Weight { point, force });
        }
    }

    pub(super) fn site(&mut self, components: &[usize], law: Law) {
        let site = Site { first: self.unknowns, components: components.to_vec(), law };
        self.unknowns += components.len();
        self.parts.push(Part::Site(site));
    }

    /// Sites, base to tool.
    pub(super) fn sites(&self) -> impl Iterator<Item = &Site> {
        self.parts.iter().filter_map(|part| match part {
            Part::Site(site) => Some(site),
            _ => None,
        })
    }

    /// Where everything is at some displacements.
    pub(super) fn shape(&self, unknowns: &[f64]) -> Shape {
        let (mut sites, mut weights) = (Vec::new(), Vec::new());
        let mut frame = Matrix4::identity();
        for part in &self.parts {
            match part {
                Part::Fixed(transform) => frame *= transform,
                Part::Site(site) => {
                    sites.push(frame);
                    frame *= displaced(&site.displacement(unknowns));
                }
                Part::Weight { .. } => weights.push(frame),
            }
        }
        Shape { sites, weights, tool: frame }
    }

    /// The generalised force of every unknown at some displacements.
    pub(super) fn forces(&self, unknowns: &[f64]) -> Vec<f64> {
        self.forces_of(&self.shape(unknowns), unknowns)
    }

    /// The same, the chain's shape at these displacements being known.
    pub(super) fn forces_of(&self, shape: &Shape, unknowns: &[f64]) -> Vec<f64> {
        let mut virial = dyad(&self.force, &carried(&shape.tool, &self.payload));
        // Half the couple's cross product does the couple's work: `[ω]× : [m]× = 2 ω·m`.
        let mut block = virial.fixed_view_mut::<3, 3>(0, 0);
        block += 0.5 * cross(&self.couple);
        let mut forces = vec![0.0; self.unknowns];
        let (mut sites, mut weights) = (shape.sites.iter().rev(), shape.weights.iter().rev());
        for part in self.parts.iter().rev() {
            match part {
                Part::Fixed(_) => {}
                Part::Weight { point, force } => {
                    let Some(frame) = weights.next() else { break };
                    virial += dyad(force, &carried(frame, point));
                }
                Part::Site(site) => {
                    let Some(frame) = sites.next() else { break };
                    // The virial in the site's axes.
                    let own = rotation(frame).tr_mul(&virial) * inverse(frame).transpose();
                    let displacement = site.displacement(unknowns);
                    for (k, component) in site.components.iter().enumerate() {
                        let motion = site.motion(&displacement, *component);
                        forces[site.first + k] = motion.fixed_rows::<3>(0).dot(&own);
                    }
                }
            }
        }
        forces
    }

    /// Where the laws want the unknowns to be, given what they are.
    pub(super) fn wanted(&self, unknowns: &[f64]) -> Vec<f64> {
        let shape = self.shape(unknowns);
        let forces = self.forces_of(&shape, unknowns);
        let mut wanted = Vec::with_capacity(self.unknowns);
        for (site, frame) in self.sites().zip(&shape.sites) {
            let own = &forces[site.first..site.first + site.components.len()];
            wanted.extend(site.law.displacement(own, &rotation(frame)));
        }
        wanted
    }

    /// Twist of the tool, base axes, at the tool's origin, to first order in `unknowns` about the
    /// undeformed arm.
    pub(super) fn first_order_twist(&self, unknowns: &[f64]) -> Vector6<f64> {
        let rest = vec![0.0; self.unknowns];
        let shape = self.shape(&rest);
        let tool = transform::origin(&shape.tool);
        let mut twist = Vector6::zeros();
        for (site, frame) in self.sites().zip(&shape.sites) {
            for (k, component) in site.components.iter().enumerate() {
                let motion = frame * site.motion(&Vector6::zeros(), *component) * inverse(frame);
                let moved = (motion * tool.push(1.0)) * unknowns[site.first + k];
                let turned = unknowns[site.first + k];
                twist += Vector6::new(
                    moved.x,
                    moved.y,
                    moved.z,
                    motion[(2, 1)] * turned,
                    motion[(0, 2)] * turned,
                    motion[(1, 0)] * turned,
                );
            }
        }
        twist
    }
}

/// `f [p; 1]ᵀ`.
fn dyad(force: &Vector3<f64>, point: &Vector3<f64>) -> Matrix3x4<f64> {
    force * point.push(1.0).transpose()
}
