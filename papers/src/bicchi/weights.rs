//! What makes a newton and a newton metre comparable.

use nalgebra::Vector6;

use super::ForceError;

/// The diagonal of the matrix P of Bicchi & Melchiorri's `V = eᵀ P e/2` (eq. 9): 1 for forces,
/// `1/l²` for moments, so that V is in N². A moment error counts like the force error that makes it
/// over the length l.
///
/// P = I, as in the paper ("with proper dimensional units"), is l = 1 m. Which l is right depends
/// on the task; in newton millimetres without a length the moments would outweigh everything.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights {
    length: f64,
}

impl Weights {
    /// The paper's P = I: one newton metre counts like one newton.
    pub const UNIT: Self = Self { length: 1.0 };

    /// Moments weighted by the length `length`, m.
    ///
    /// # Errors
    /// [`ForceError::Length`] if it is not a positive number.
    pub fn with_length(length: f64) -> Result<Self, ForceError> {
        if length.is_finite() && length > 0.0 {
            Ok(Self { length })
        } else {
            Err(ForceError::Length { found: length })
        }
    }

    /// l, m.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The diagonal of P.
    pub fn diagonal(&self) -> Vector6<f64> {
        let moment = 1.0 / (self.length * self.length);
        Vector6::new(1.0, 1.0, 1.0, moment, moment, moment)
    }

    /// The diagonal of the square root of P.
    pub(super) fn root(&self) -> Vector6<f64> {
        let moment = 1.0 / self.length;
        Vector6::new(1.0, 1.0, 1.0, moment, moment, moment)
    }

    /// `V = eᵀ P e/2`, N² (eq. 9).
    pub fn value(&self, error: &Vector6<f64>) -> f64 {
        error.component_mul(&self.root()).norm_squared() / 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moment_counts_as_a_force_over_the_length() {
        let weights = Weights::with_length(0.5).unwrap();
        let force = weights.value(&Vector6::new(0.0, 4.0, 0.0, 0.0, 0.0, 0.0));
        let moment = weights.value(&Vector6::new(0.0, 0.0, 0.0, 0.0, 0.0, 2.0));
        assert_eq!((force, moment), (8.0, 8.0));
        assert_eq!(Weights::UNIT.diagonal(), Vector6::repeat(1.0));
        assert_eq!(weights.diagonal()[5], 4.0);
    }

    #[test]
    fn the_length_is_positive() {
        for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let error = Weights::with_length(wrong).unwrap_err();
            assert!(error.to_string().contains("positive number of metres"), "{error}");
        }
    }
}
