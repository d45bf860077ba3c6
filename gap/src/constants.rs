//! Numbers by which the diagnosis decides, each with its derivation or with what was measured of it; those of the
//! inference are [`infer::constants`](crate::infer::constants).

use core::f64::consts::PI;

// What arms and their frames leave.

/// Of the reach: a gap that asks for a cause, and what one that is named may leave. Lengths are held to a thousandth
/// and zeros marked to a few, also on a bad arm; it is fifteen times what the worst of 200 arms of
/// `tests/withheld/mistakes.rs` leaves.
pub(crate) const LARGE_GAP: f64 = 0.02;

/// Poses below which neither frames nor zeros are doubted: a motion of both frames, nine numbers, explains too much of
/// fewer positions by itself. Frames and six zeros are not told from a mistake by fewer numbers than those poses have.
pub(crate) const FEWEST_POSES: usize = 6;

// Mistakes of a robot file and of readings.

/// Of the reach: what 198 of 200 arms of `tests/withheld/mistakes.rs` leave beside fitted zeros and springs (the median
/// 0.0002, the largest 0.0013). A smaller gap is asked for the units of its loads alone.
pub(crate) const ORDINARY_GAP: f64 = 1e-3;

/// Of the reach: a gap that no mistake makes smaller is no arm's. Rows of other poses leave 0.38 at least, arms 0.0013
/// at most, 25 and 200 of `tests/withheld/mistakes.rs`.
pub(crate) const FOREIGN_GAP: f64 = 0.05;

/// A mistake that is named leaves at most this part of the size that is there with it: of the gap, of a joint's torque,
/// of a joint's distance from its command. A number that is off by 90° or by a factor is nothing that zeros and springs
/// are a half of; where moments needed no more than odds, 6 of 200 arms without one had one named, and 1 with it.
pub(crate) const MISTAKE_LEAVES: f64 = 0.5;

/// Another unit of the loads leaves at most this part of the gap: the springs made up for it, so that the size of the
/// gap says little and the odds decide. What leaves a tenth more than there was is no explanation.
pub(crate) const LOADS_LEAVE: f64 = 1.1;

/// A second mistake leaves at most this part of what the first has left: less than a first one may, because what the
/// first has left may be the arm's own, of which another unknown takes some. It is a judgement: nobody measured it.
pub(crate) const SECOND_LEAVES: f64 = 1.0 / 3.0;

/// Rows count as so many at the most: what an arm does beside zeros and springs is alike in all of them, and rows of it
/// are then no further evidence. It is a judgement: nobody measured it.
pub(crate) const COUNTED_ROWS: f64 = 60.0;

/// Odds against chance, in nats: 100 to 1 (`ln 100`) beside the number of mistakes that were tried.
pub(crate) const CERTAIN: f64 = 4.6;

/// The same against another unit or sign of the loads. Springs that are hardly seen make it likely by chance: of 200
/// arms without a mistake the luckiest came 1.6 nats above [`CERTAIN`], and 3 were above it; of 48 with another unit or
/// sign that were named right the least lucky came 10 above.
pub(crate) const CERTAIN_OF_LOADS: f64 = CERTAIN + 5.0;

/// Nats that an amount costs that may be any: a turn over the milliradian to which a campaign tells it, `ln 2000π`, as
/// MacKay's Occam factor has it.
pub(crate) const ANY_AMOUNT: f64 = 8.7;

/// Part of the rows, those that fit best, by whose spread mistakes are judged: a quarter may be just wrong.
pub(crate) const BEST_ROWS: f64 = 0.75;

/// Part of the rows by which mistakes are judged that are seen in few of them: a coupling in sweeps of single joints, a
/// reading that sticks for a while. Of a tracker's rows fewer are just wrong.
pub(crate) const NEARLY_ALL_ROWS: f64 = 0.97;

/// At fewer poses no unit of a load is told: of 48 arms at 6 to 11 poses one had another unit of its moments named.
pub(crate) const POSES_OF_LOADS: usize = 12;

/// Fewer rows with one reading are a pose that was measured again, or a sweep of another joint: no reading that sticks.
pub(crate) const STUCK_ROWS: usize = 8;

/// The least amount that is a mistake, rad, parts of the reach and 1. What is less is an effect of the arm, and the
/// effects' own search is exact up to twice as much (zeros of 10°, lengths of a tenth of the reach).
pub(crate) const LEAST_AMOUNT: [f64; 3] = [5.0 * PI / 180.0, 0.05, 0.05];

/// Zeros and springs explain something if the squares fall by so many times what they fall by chance: of twelve numbers
/// that is five standard deviations above it. An amount is else told as it is without them.
pub(crate) const ABOVE_CHANCE: f64 = 3.0;

/// Part of the spread of the tool across a plane: where a mistake leaves less of the file's arm's the arm is flat, and
/// where plates leave more of its own one plate would do for all. Joints that are read otherwise than they are meant
/// leave more than a half of the first, and true mistakes less than a tenth of the second.
pub(crate) const FLAT_ARM: f64 = 0.2;
