//! Both directions in one walk: loads come down the chain, and each place answers with its error
//! (Bicchi & Melchiorri, eqs. 16-19).
//!
//! From the tip to the base, the wrench in the displaced frame i is known when place i is reached.
//! The place answers with its displacement `E_i`, and the wrench goes on through `A_i E_i`. No
//! iteration is needed as long as the tip's wrench is known in the displaced tip.

use nalgebra::{Isometry3, Matrix6, Vector6};

use super::transport::{along, turning, twist_matrix, wrench_in, wrench_matrix};

/// How one place answers a load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response {
    /// Its displacement E, a transform.
    pub error: Isometry3<f64>,
    /// Twist `dE E⁻¹`, at the origin of the nominal frame and in its axes, per unit of the wrench
    /// in the displaced frame: the place's compliance where it stands.
    pub rate: Matrix6<f64>,
}

impl Response {
    /// An error that does not depend on the load.
    pub fn fixed(error: Isometry3<f64>) -> Self {
        Self { error, rate: Matrix6::zeros() }
    }
}

/// A chain at rest under its load.
#[derive(Clone, Debug, PartialEq)]
pub struct Settled {
    steps: Vec<Isometry3<f64>>,
    responses: Vec<Response>,
    /// In each displaced frame; the last one is the tip's.
    wrenches: Vec<Vector6<f64>>,
    base: Vector6<f64>,
}

/// Walks down the chain of nominal `steps` with the wrench `tip`, given in the last displaced
/// frame; `respond` gets each place's number and the wrench in its displaced frame.
///
/// # Errors
/// The first one of `respond`.
pub fn settle<E>(
    steps: &[Isometry3<f64>],
    tip: &Vector6<f64>,
    mut respond: impl FnMut(usize, &Vector6<f64>) -> Result<Response, E>,
) -> Result<Settled, E> {
    let mut wrench = *tip;
    let (mut responses, mut wrenches) = (Vec::new(), Vec::new());
    for (place, step) in steps.iter().enumerate().rev() {
        let response = respond(place, &wrench)?;
        wrenches.push(wrench);
        wrench = wrench_in(&(step * response.error), &wrench);
        responses.push(response);
    }
    responses.reverse();
    wrenches.reverse();
    Ok(Settled { steps: steps.to_vec(), responses, wrenches, base: wrench })
}

impl Settled {
    /// Number of places.
    pub fn places(&self) -> usize {
        self.steps.len()
    }

    /// The wrench in the displaced frame of a place, or `None` where there is no such place.
    pub fn wrench(&self, place: usize) -> Option<&Vector6<f64>> {
        self.wrenches.get(place)
    }

    /// The wrench in the base frame: what the arm puts on what carries it.
    pub fn base_wrench(&self) -> Vector6<f64> {
        self.base
    }

    /// How each place answered.
    pub fn responses(&self) -> &[Response] {
        &self.responses
    }

    /// `A_i E_i`, from the base to the tip.
    pub fn transforms(&self) -> Vec<Isometry3<f64>> {
        let factors = self.steps.iter().zip(&self.responses);
        factors.map(|(step, response)| step * response.error).collect()
    }

    /// The displaced frames in the base frame, m.
    pub fn frames(&self) -> Vec<Isometry3<f64>> {
        let mut frame = Isometry3::identity();
        let behind = |transform: Isometry3<f64>| {
            frame *= transform;
            frame
        };
        self.transforms().into_iter().map(behind).collect()
    }

    /// The displaced tip in the base frame, m.
    pub fn pose(&self) -> Isometry3<f64> {
        along(self.transforms())
    }

    /// The nominal frame of each place on the displaced chain before it, in the base frame.
    pub(super) fn undisplaced(&self) -> Vec<Isometry3<f64>> {
        let mut frame = Isometry3::identity();
        let before = |(step, response): (&Isometry3<f64>, &Response)| {
            let nominal = frame * step;
            frame = nominal * response.error;
            nominal
        };
        self.steps.iter().zip(&self.responses).map(before).collect()
    }

    /// The wrench of a place in its nominal frame: `u = K(E) w`.
    pub(super) fn nominal_wrench(&self, place: usize) -> Vector6<f64> {
        wrench_in(&self.responses[place].error, &self.wrenches[place])
    }

    /// `J_i = ∂w_{i−1}/∂w_i` of one place, its answer included: `K(A) (K(E) + B(u) dξ/dw)`.
    pub(super) fn wrench_rate(&self, place: usize) -> Matrix6<f64> {
        let response = &self.responses[place];
        let answer = turning(&self.nominal_wrench(place)) * response.rate;
        wrench_matrix(&self.steps[place]) * (wrench_matrix(&response.error) + answer)
    }

    /// Change of the base wrench per unit of the tip's wrench (in its own, moving frame), 6×6.
    pub fn base_rate(&self) -> Matrix6<f64> {
        (0..self.places()).map(|place| self.wrench_rate(place)).product()
    }

    /// Twist of the tip, base axes, at the tip, per unit of the tip's wrench in its own, moving
    /// frame, 6×6: the compliance of the loaded chain.
    pub fn tip_rate(&self) -> Matrix6<f64> {
        let mut rate = Matrix6::zeros();
        let mut arriving = Matrix6::identity();
        for (place, seen) in self.seen_from_tip().iter().enumerate().rev() {
            rate += twist_matrix(seen) * self.responses[place].rate * arriving;
            arriving = self.wrench_rate(place) * arriving;
        }
        rate
    }

    /// The frames of [`Settled::undisplaced`] with the tip as the origin: what carries a twist of a
    /// place to the tip, base axes.
    pub(super) fn seen_from_tip(&self) -> Vec<Isometry3<f64>> {
        let tip = self.pose().translation.vector;
        let mut frames = self.undisplaced();
        for frame in &mut frames {
            frame.translation.vector -= tip;
        }
        frames
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chain::{Chain, Displacement, rate, steps, wrenches};
    use crate::fixture::bent;

    /// A made-up effect: every place gives way in proportion to its wrench, one stiffening.
    fn soft(place: usize, w: &Vector6<f64>) -> Result<Response, ()> {
        let give = 1e-4 * (1.0 + place as f64) * (1.0 - 1e-3 * w[0]);
        let error = Displacement::new(&(w * give));
        let slope = -1e-7 * (1.0 + place as f64);
        let change = Matrix6::identity() * give
            + Matrix6::from_fn(|row, column| if column == 0 { w[row] * slope } else { 0.0 });
        Ok(Response { error: error.transform(), rate: rate(&error) * change })
    }

    const Q: [f64; 3] = [0.4, -0.9, 1.3];

    #[test]
    fn it_is_the_chain_with_the_errors_it_found() {
        let arm = bent();
        let steps = steps(&arm, &Q).unwrap();
        let tip = Vector6::new(30.0, -10.0, 20.0, 3.0, -2.0, 5.0);
        let settled = settle(&steps, &tip, soft).unwrap();
        let errors: Vec<_> =
            settled.responses().iter().map(|r| Displacement::of(&r.error)).collect();
        let chain = Chain::new(&arm, &errors).unwrap();
        let difference = chain.pose(&Q).unwrap().to_homogeneous() - settled.pose().to_homogeneous();
        assert!(difference.amax() < 1e-14);
        let down = wrenches(&settled.transforms(), &tip);
        assert!((down[0] - settled.base_wrench()).amax() < 1e-12);
        assert_eq!(settled.wrench(4), Some(&tip));
        assert_eq!(settled.wrench(5), None);
        assert_eq!(settled.frames().last(), Some(&settled.pose()));
    }

    #[test]
    fn rates_are_central_differences() {
        let steps = steps(&bent(), &Q).unwrap();
        let tip = Vector6::new(30.0, -10.0, 20.0, 3.0, -2.0, 5.0);
        let settled = settle(&steps, &tip, soft).unwrap();
        let (base, pose) = (settled.base_rate(), settled.tip_rate());
        let step = 1e-4;
        for k in 0..6 {
            let at = |h: f64| settle(&steps, &(tip + Vector6::ith(k, h)), soft).unwrap();
            let (high, low) = (at(step), at(-step));
            let change = (high.base_wrench() - low.base_wrench()) / (2.0 * step);
            assert!((base.column(k) - change).amax() < 1e-8 * base.amax());
            let twist = crate::chain::product::between(&low.pose(), &high.pose()) / (2.0 * step);
            assert!((pose.column(k) - twist).amax() < 1e-8 * pose.amax());
        }
    }
}
