//! Numbers by which both engines decide, each with its derivation or with what was measured of it.

/// A finding's largest p value, over all candidates that were tried. Measured by the withheld suites: of 120 campaigns
/// without a cause one has a finding (`campaigns::full`), of 60 logs two (`logs`).
pub const SIGNIFICANT: f64 = 0.05;

/// What noise does less often than this is not put down to noise: what is left is unexplained, a noise is larger than
/// it is told, a row does not belong to the others (each over all that was tried), one rival leaves more than a finding
/// (each for itself). Nobody is to look for a cause that is not there. Measured of what is left, by `stiffarm withhold`
/// (seeds 7701, 7702): none of 150 campaigns without a cause has something unexplained. Rivals are to hold the truth of
/// 97 in 100 logs.
pub const BEYOND_NOISE: f64 = 0.01;

/// Twice the logarithm of the odds below which two explanations are not distinguishable: `2 ln 20`.
pub const DISTINGUISHABLE: f64 = 6.0;

/// At least this many measured numbers for each parameter: two that fix it would leave nothing to judge by.
pub const NUMBERS_EACH: usize = 3;

/// Folds of the independent units, where these are more: with nine tenths of them fitted the part of the held-out gap
/// that comes from uncertain parameters is a ninth too large.
pub const FOLDS: usize = 10;

/// Largest standard deviation of a number's prior, in units of what is usual of it: what is usual is known to a factor
/// of about three. It holds what the data hardly decide, and the price of values beyond it is Gaussian.
pub const LOOSE: f64 = 3.0;

/// A candidate of which less is left beside the model cannot be seen.
pub const OWN: f64 = 0.01;

/// One term is exchanged for another only for this much more evidence: a factor of about five.
pub const EXCHANGE: f64 = 3.0;

/// A term that leads all others by this much evidence, odds of e³⁰, is not compared with them again for an exchange:
/// what is added later does not change as much of the evidence for it.
pub const SURE: f64 = 60.0;
