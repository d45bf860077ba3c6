//! The postures and loads that tests are chosen from, and what each would say of springs.

use nalgebra::{DMatrix, Matrix6xX, Vector6};
use stiffarm_kernels::generic::Arm;
use stiffarm_kernels::{Output, Unstable};

use super::{Plan, Station, bench};
use crate::dexterity::{
    DexterityError, Search, block, characteristic_length, influence, inverse_condition,
};
use crate::rng::{Rng, Stream};
use crate::robot::ranges;
use crate::whole::Whole;

/// Postures drawn per test wanted, and bounds of their number.
const PER_TEST: usize = 40;
const FEWEST: usize = 240;
const MOST: usize = 1000;

/// Postures that are tried at a thing of the bench for each that is wanted.
const TRIES: usize = 20;

/// Of the postures drawn the part that is dexterous enough, and of these the part in which K_C is
/// small enough.
const DEXTEROUS: f64 = 0.5;
const SMALL_K_C: f64 = 0.8;

/// Starts of the search for the characteristic length: no more than the length's digits matter.
const STARTS: usize = 6;

/// A posture that may be tested.
pub(super) struct Posture {
    pub(super) q: Vec<f64>,
    /// Of the plan's bench, what is read.
    pub(super) thing: Option<usize>,
    pub(super) inverse_condition: f64,
    pub(super) nu_p: f64,
}

/// A posture under a load, and its whitened regressors: rows are numbers measured, columns the
/// compliances of all joints and, for a diagnosis, their zeros; or the numbers of effects.
pub(super) struct Block {
    pub(super) posture: usize,
    pub(super) load: usize,
    /// From which side each joint is to come to rest, if that matters.
    pub(super) direction: Option<Vec<i8>>,
    pub(super) rows: DMatrix<f64>,
}

/// Joint values that were drawn, and of the plan's bench what is read there.
type Drawn = (Vec<f64>, Option<usize>);

/// The postures that may be tested.
pub(super) struct Pool {
    pub(super) postures: Vec<Posture>,
    pub(super) length: f64,
}

pub(super) fn draw(whole: Whole<'_>, plan: &Plan) -> Result<Pool, DexterityError> {
    let bounds = ranges(whole.arm).map_err(|joint| DexterityError::Unlimited { joint })?;
    let count = (PER_TEST * plan.count).clamp(FEWEST, MOST).max(2 * plan.count);
    let mut rng = Rng::new(plan.seed, Stream::Starts);
    let drawn: Vec<Vec<f64>> = (0..count).map(|_| rng.point(&bounds)).collect();
    let length = length(whole.arm, &drawn, plan.seed)?;
    let drawn: Vec<Drawn> = match plan.bench.len() {
        0 => drawn.into_iter().map(|q| (q, None)).collect(),
        things => at_bench(whole.arm, plan, things, &bounds, count, &mut rng)?,
    };
    let mut postures = Vec::new();
    let mut unstable = None;
    for (q, thing) in drawn {
        let inverse_condition = inverse_condition(whole, &q, length)?;
        let nu_p = plan.loads.iter().map(|load| influence(whole, &q, load).map(|i| i.nu_p));
        match nu_p.collect::<Result<Vec<f64>, _>>() {
            Ok(each) => {
                let nu_p = each.into_iter().fold(0.0, f64::max);
                postures.push(Posture { q, thing, inverse_condition, nu_p });
            }
            Err(error) => unstable = Some(error),
        }
    }
    if let (true, Some(error)) = (postures.is_empty(), unstable) {
        return Err(error);
    }
    // Ties are kept in the order drawn, so that the plan depends on nothing but its seed.
    keep(&mut postures, DEXTEROUS, plan.count, |p| -p.inverse_condition);
    keep(&mut postures, SMALL_K_C, plan.count, |p| p.nu_p);
    Ok(Pool { postures, length })
}

/// Postures at each thing of the bench in turn.
fn at_bench(
    arm: &Arm,
    plan: &Plan,
    things: usize,
    bounds: &[[f64; 2]],
    count: usize,
    rng: &mut Rng,
) -> Result<Vec<Drawn>, DexterityError> {
    let mut all = Vec::new();
    for thing in 0..things {
        let wanted = count.div_ceil(things);
        let tried = (0..TRIES * wanted).filter_map(|_| {
            let mut q = rng.point(bounds);
            bench::reaches(arm, &plan.plates, &plan.bench[thing], &mut q, bounds)
                .then_some((q, Some(thing)))
        });
        let before = all.len();
        all.extend(tried.take(wanted));
        if all.len() == before {
            return Err(DexterityError::OutOfReach { thing: plan.bench[thing].full_name() });
        }
    }
    Ok(all)
}

/// Each posture with each load, by their numbers.
pub(super) fn pairs(
    postures: &[Posture],
    plan: &Plan,
) -> impl Iterator<Item = (usize, usize)> + use<> {
    let loads = plan.loads.len();
    (0..postures.len() * loads).map(move |k| (k / loads, k % loads))
}

/// What each test says of springs, and of zeros if poses are measured.
pub(super) fn blocks(
    whole: Whole<'_>,
    plan: &Plan,
    postures: &[Posture],
    zeros: bool,
) -> Result<Vec<Block>, Unstable> {
    let each = pairs(postures, plan).map(|(posture, load)| {
        let rows = rows(whole, &postures[posture], &plan.loads[load], plan, zeros)?;
        Ok(Block { posture, load, direction: None, rows })
    });
    each.collect()
}

/// The part of the postures with the lowest cost, no fewer than `least`.
fn keep(postures: &mut Vec<Posture>, part: f64, least: usize, cost: impl Fn(&Posture) -> f64) {
    postures.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    let count = (part * postures.len() as f64).ceil() as usize;
    postures.truncate(count.max(least));
}

/// The characteristic length; of an arm that cannot move its tool in all ways, the one that makes
/// translations and rotations equal on average. It is that of the table: what moves joints alone reaches
/// the same postures.
fn length(arm: &Arm, drawn: &[Vec<f64>], seed: u64) -> Result<f64, DexterityError> {
    let search = Search { starts: STARTS, seed, limits: true };
    match characteristic_length(arm, search) {
        Ok(found) => return Ok(found.length),
        Err(DexterityError::TooFewJoints { .. } | DexterityError::AllSingular) => {}
        Err(other) => return Err(other),
    }
    let (mut shifts, mut turns) = (0.0, 0.0);
    for q in drawn {
        let jacobian = arm.jacobian(q);
        shifts += jacobian.fixed_rows::<3>(0).norm_squared();
        turns += jacobian.fixed_rows::<3>(3).norm_squared();
    }
    if turns > 0.0 && shifts > 0.0 { Ok((shifts / turns).sqrt()) } else { Ok(1.0) }
}

/// What a test measures per unit of each unknown, in units of the noise.
fn rows(
    whole: Whole<'_>,
    posture: &Posture,
    load: &Vector6<f64>,
    plan: &Plan,
    zeros: bool,
) -> Result<DMatrix<f64>, Unstable> {
    let (n, q) = (whole.arm.dof(), &posture.q[..]);
    let noise = plan.noises();
    let measured = noise.len();
    let springs = block(whole, Output::ComplianceRegressor, q, load)?;
    if let Some(thing) = posture.thing {
        let zeros = block(whole, Output::Jacobian, q, load)?;
        return Ok(bench_rows(whole.arm, plan, posture, thing, [springs, zeros]));
    }
    // A displacement is the difference of two readings, each with its noise.
    if !zeros {
        return Ok(DMatrix::from_fn(measured, n, |r, c| {
            springs[(r, c)] / (core::f64::consts::SQRT_2 * noise[r])
        }));
    }
    // Two poses: unloaded below, loaded above.
    let zeros = block(whole, Output::Jacobian, q, load)?;
    Ok(DMatrix::from_fn(2 * measured, 2 * n, |r, c| {
        let (row, loaded) = (r % measured, r < measured);
        let value = match (c < n, loaded) {
            (true, true) => springs[(row, c)],
            (true, false) => 0.0,
            (false, _) => zeros[(row, c - n)],
        };
        value / noise[row]
    }))
}

/// The same of a thing of the bench, without the load below and with it above: springs, zeros, and the constants of
/// all things.
fn bench_rows(
    arm: &Arm,
    plan: &Plan,
    posture: &Posture,
    thing: usize,
    [springs, zeros]: [Matrix6xX<f64>; 2],
) -> DMatrix<f64> {
    let (n, at) = (arm.dof(), arm.pose(&posture.q));
    let (by_frame, constants) = plan.bench[thing].rows(&at);
    let (springs, zeros) = (&by_frame * springs, &by_frame * zeros);
    let read = by_frame.nrows();
    let own = plan.constants(thing);
    let mut rows = DMatrix::zeros(2 * read, 2 * n + plan.constants(plan.bench.len()).start);
    for loaded in [true, false] {
        let first = if loaded { 0 } else { read };
        if loaded {
            rows.view_mut((first, 0), (read, n)).copy_from(&springs);
        }
        rows.view_mut((first, n), (read, n)).copy_from(&zeros);
        rows.view_mut((first, 2 * n + own.start), (read, own.len())).copy_from(&constants);
    }
    rows / match plan.bench[thing] {
        Station::Thing(_) => plan.noise_position,
        Station::Board(_) => plan.noise_rotation.unwrap_or(plan.noise_position),
    }
}
