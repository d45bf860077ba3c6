//! Numbers of arithmetic that several files share: rounding, steps, rounds and portions of work. None of them is a
//! threshold of what is found; those are [`constants`](crate::constants).

/// What is less than this part of the largest of its kind, or than as many rad, is rounding: six digits above the last
/// one of a double, so that sums of a million terms stay below it.
pub const ROUNDING: f64 = 1e-9;

/// The same of what is worked out by a few operations: three digits above the last one of a double.
pub const LAST_DIGITS: f64 = 1e-12;

/// A column of which less than this part of its square stands apart from the others says nothing of its own: three
/// digits above the rounding of products of a million samples.
pub const LEAST_OWN: f64 = 1e-9;

/// Kept in a normal matrix scaled to 1 where the rows that are left do not decide a direction: far above the rounding
/// of its products, and one that they decide to a millionth is off by a thousandth.
pub const RIDGE: f64 = 1e-9;

/// What changes by less than this part has converged: far less than any noise is known.
pub const CONVERGED: f64 = 1e-3;

/// Part of a width or a distance by which the slope over it is taken: its square is lost in what is linear.
pub const SLOPE_STEP: f64 = 0.05;

/// By how much a joint is moved at most to see what more of it does, rad or m: first order to as much.
pub const SMALL_MOVE: f64 = 1e-4;

/// Rounds in which two things that depend on each other settle: each is nearer by the part of the numbers that are
/// hardly decided.
pub const ROUNDS: usize = 6;

/// Most steps of Newton's method, or of what is nearly so: what is left out is of second order, so that the error falls
/// by a factor of ten or more with each.
pub const NEWTON_STEPS: usize = 40;

/// Rows or columns whose products are taken together: few enough for a cache.
pub const CHUNK: usize = 64;

/// Blocks into which data are divided, about: of more, neighbours share one, so that cost and memory stay linear.
pub const BLOCKS: usize = 64;

/// Rows, an even choice, that stand for all of a campaign where a size is enough.
pub const SOME_ROWS: usize = 200;

/// Samples, an even choice, that stand for all of a log where a sign, a size or a correlation time is enough.
pub const SOME_SAMPLES: usize = 20_000;

/// After so many correlation times errors are independent (Sokal's window: 4 to 10).
pub const CORRELATION_TIMES: f64 = 5.0;

/// Of what there may be much, so many are named.
pub const MOST_NAMED: usize = 5;
