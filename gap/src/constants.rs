//! Numbers by which the diagnosis decides, each with its derivation or with what was measured of it; those of the
//! inference are [`infer::constants`](crate::infer::constants). Where neither is named the number is a judgement between
//! what happens on either side of it, and the suites are the only measure.

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

// What is enough to tell anything, and what counts as nothing.

/// Fewer of a kind (repeats of a reading, runs of a log, joints or arms of one type) do not tell what is usual among
/// them: of two neither is the one that is unlike.
pub(crate) const FEWEST_OF_A_KIND: usize = 3;

/// Fewer blocks of time, or numbers that are left, tell nothing of chance: the signs of eight can be set in 2⁸ ways,
/// two of which are as far from zero as what was measured, a p value of 1/128; of fewer none is below
/// [`BEYOND_NOISE`](crate::infer::constants::BEYOND_NOISE).
pub(crate) const FEWEST_TO_JUDGE: usize = 8;

/// What is less than this part of the largest of its kind is nothing: a joint that is slower than this part of its
/// largest speed stands, one that moves by less than this part of what the one that moves most does, and by less than
/// as many rad or m, is parked, and loads that differ by less than this part of the largest are the same. An encoder's
/// noise is less, and so is a weight's tolerance.
pub(crate) const UNCHANGED: f64 = 5e-3;

// Readings of a log.

/// Steps between samples that recorders of joints have, s, from the shortest to the longest. Those of 50 to 1000 Hz
/// stand apart from either end by ten or more, and a unit is a thousand.
pub(crate) const FAIR_STEPS: [f64; 2] = [5e-5, 0.5];

/// A jump is a whole turn to this part of one: what the joint moves between two samples is in it, and at 50 Hz that is
/// an eighth of a turn only at 39 rad/s.
pub(crate) const WHOLE_TURN: f64 = 0.125;

/// A rate goes with its joint if so much of its square does; a fair one leaves some for noise and delays.
pub(crate) const RATE_GOES: f64 = 0.5;

/// Factors of a rate are told to this part: sensors' scales are right to a tenth, units differ by more than nine.
pub(crate) const SAME_FACTOR: f64 = 0.1;

/// A limit of a channel is one if this part of the samples stands at it, and [`LIMIT_TIMES`] as many as in as much of
/// the range below it as this part is: a motion that turns round there has as many below it as at it.
pub(crate) const LIMITED: f64 = 0.01;

/// How many times as many samples stand at a limit as just below it.
pub(crate) const LIMIT_TIMES: usize = 3;

/// Samples beside one at a limit that are left out with it: a filter of the recorder rounds the edge.
pub(crate) const BESIDE_LIMIT: usize = 3;

/// What a simple model leaves of a joint's torque, as a part of its spread, from which on mistakes of its columns are
/// asked for: real arms leave half of it at most (a Panda up to 60 Hz, without anything but Coulomb friction).
pub(crate) const BAD_TORQUE: f64 = 0.5;

/// The same from which on a zero is asked for: friction hides what one does to the weights where less is left.
pub(crate) const FAIR_TORQUE: f64 = 0.1;

/// No smaller zero is asked for, 15°: by less a base leans, and effects say so.
pub(crate) const LEAST_ZERO: f64 = PI / 12.0;

/// The torque of a joint and the joint itself, turned round, leave the same if the logarithms of what they leave differ
/// by less, sum over the joints: where neither gravity nor another joint tells its sides apart, as of a last joint
/// about its own axis, friction and inertia are the same of both.
pub(crate) const SAME_SIGNS: f64 = 0.05;

/// A delay of all torques, or a body of its own in each run, comes before all effects if what is left shrinks by this
/// part with it, mean over the joints (of a delay, its logarithm does). What leaves less to the others is found among
/// them: a torque that is late by so little is in proportion to its rate.
pub(crate) const SHRINKS: f64 = 0.2;

/// Two masses are of two things that differ by more than this part of the range of all. Three things at even steps are
/// two quarters apart, and masses of one thing are to scatter by less than half of that. It is a judgement: nobody
/// measured it.
pub(crate) const THINGS_APART: f64 = 0.25;

// Effects in a log.

/// How often a ripple stands out by accident in a log, over all joints: it is then likely to be named, and comes on top
/// of the findings' own 0.05.
pub(crate) const ACCIDENT: f64 = 0.02;

/// Of the robot file's value, the part by which an estimate of zero may come out below it: what is taken back at all is
/// so by twice its standard deviation (p of 0.05), which is then a tenth of it where the finding is plain.
pub(crate) const BELOW_ZERO: f64 = 0.1;

/// Of the robot file's value, the least part that is taken back. The signs of speeds are read wrongly where a joint
/// turns round, and friction seems smaller by as much: of 120 logs without a cause two had such a finding, of a
/// thousandth of the file's.
pub(crate) const TAKEN_BACK: f64 = 0.05;

// Measurements of a campaign.

/// Rows farther apart than this, s, are poses between which nobody knows how the arm moved: they have no rates, and are
/// no stream. Programs that go from pose to pose take seconds, instruments that follow an arm tens of readings a
/// second.
pub(crate) const LONGEST_STEP: f64 = 1.0;

/// Loads of a campaign are of one order: what is pulled with at a few rows by this factor more than at nine in ten of
/// the others decides alone on every law by which the arm gives, and is left out at first.
pub(crate) const FAR_LOAD: f64 = 5.0;

/// Numbers of an instrument from which on its precision is its own: a standard deviation is then known to a sixth.
pub(crate) const OWN_PRECISION: f64 = 20.0;

/// An instrument that is a hundred times as precise as the others decides alone; one that seems more precise fits by
/// chance.
pub(crate) const MOST_PRECISE: f64 = 100.0;

/// A noise that is told is not known better than to this factor: it is too small only where what remains exceeds it by
/// more. A standard deviation is known to 5 % by two hundred numbers.
pub(crate) const EXCESS: f64 = 1.05;

// Doubts of what a file says.

/// Trackers see tens of metres and the smallest arms reach half of one; from millimetres to metres it is a factor of a
/// thousand.
pub(crate) const MOST_REACHES: f64 = 100.0;

/// A stiffness that no joint has, over the reach's cube, N/m². Arms of one shape and material stiffen with the cube of
/// their size; of those with published springs the KUKA KR 240-2 is the stiffest, 6.6e6 N·m/rad at 3 m or 2.4e5 N/m².
pub(crate) const STIFFEST_JOINT: f64 = 3e6;

/// rad. Springs, zeros and levels turn nothing by so much: zeros are off by some mrad, a base is levelled or stands in
/// no frame that is, springs are linear while an arm gives by less of its reach than this at its first joint. What is
/// read in a wrong convention turns by a radian, and what is told in millimetres by hundreds.
pub(crate) const LARGE_ANGLE: f64 = 0.1;

/// Part of the gap's square that a motion of a frame, or another convention of angles, explains where it is all that is
/// amiss: a tenth of the gap is left.
pub(crate) const ALL_BY_FRAMES: f64 = 0.99;

// What the data show.

/// A number of the table whose column has less than this part left beside those before it is one with them: the square
/// of a ratio of sizes of 3e-3. What is left is how the loads follow the arm.
pub(crate) const ONE_WITH_OTHERS: f64 = 1e-5;

/// An effect that moves what is measured by less than this part of what it does at its strongest place is idle there:
/// what it does is lost beside what it does elsewhere.
pub(crate) const IDLE: f64 = 1e-3;

/// Less than this left of an effect beside geometry is called unseen, and a number that is less of another one is not
/// named beside it: an effect would have to be some 20 times the noise to be told from it.
pub(crate) const SEEN: f64 = 0.05;

// Effects of a campaign.

/// The part of the fall that the linear fit promises which the exact one has to keep: of what keeps less the larger
/// part was there by the linearisation alone.
pub(crate) const PROMISE_KEPT: f64 = 0.5;

/// A number that is identified with a standard deviation of more than this part of it is weak: zero, a spring that does
/// not give, is then within two of them.
pub(crate) const WEAK: f64 = 0.5;
