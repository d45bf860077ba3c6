//! What is to be known of an effect by those who measure.

/// What a page says of an effect; sentences.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct About {
    /// What reality does that the sim does not.
    pub reality: &'static str,
    /// How its error shows.
    pub signature: &'static str,
    /// What makes almost the same error, and when.
    pub confused_with: &'static str,
    /// Which measurement separates the two.
    pub separated_by: &'static str,
}
