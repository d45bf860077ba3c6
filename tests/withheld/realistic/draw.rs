//! One arm as it is, and what is measured of it: all by the plant, which shares no regressor with
//! the diagnosis.

use nalgebra::{DVector, Vector6};
use stiffarm_codegen::robot::Robot;
use stiffarm_gap::effects::{Draw, Effect, Place, Quantity};
use stiffarm_gap::measurement::{Layout, Measurements};
use stiffarm_gap::rng::{Rng, Stream};
use stiffarm_kernels::generic::Arm;
use stiffarm_plant::{Frames, Instrument, Noise, Plant, Scatter, Truth, csv, effects};
use stiffarm_study::withhold::resized;

use super::case::GEOMETRY;
use super::floor::errors;
use super::models::MODELS;
use super::session;
use super::size::{Bench, ordinary};

/// How far every offset and row of a table is off, m and rad: standard deviations.
const OFF: [f64; 2] = [0.3e-3, 0.5e-3];

/// A tracker's scale, errors of four degrees of freedom, and one row in fifty that is just wrong.
pub const INSTRUMENT: Instrument = Instrument {
    scale: Noise { position: 30e-6, rotation: 30e-6 },
    freedom: 4,
    wrong: 0.02,
    wrong_by: Noise { position: 0.4e-3, rotation: 0.4e-3 },
};

/// An arm comes back to a few hundredths of a millimetre; its readings agree in five digits.
const SCATTER: Scatter = Scatter { visits: 10e-6, readings: 2e-6 };

/// The size of an effect in multiples of the noise.
pub const RATIO: [f64; 2] = [3.0, 8.0];

/// What an effect leaves beside frames, offsets, rows and the other effects, in units of the noise
/// and over all numbers together: ten is what nobody who looks for it overlooks.
pub const EVIDENCE: f64 = 10.0;

/// Sessions at other poses.
pub const FRESH: usize = 4;

/// A physical effect that the arm has.
pub struct Planted {
    pub truth: Truth,
    /// Distance by which it moves the tool, rms, over the noise's.
    pub ratio: f64,
    /// What is left of it beside all else, in units of the noise, over all numbers.
    pub evidence: f64,
}

/// An arm and its measurements.
pub struct Drawn {
    pub seed: u64,
    pub robot: &'static str,
    pub orientation: bool,
    pub loads: bool,
    /// As designed: what the diagnosis is told.
    pub arm: Arm,
    pub file: Robot,
    pub frames: Frames,
    /// Offsets and rows.
    pub geometry: Vec<Truth>,
    pub planted: Vec<Planted>,
    /// The measurement file.
    pub text: String,
    /// The same as the diagnosis reads it.
    pub data: Measurements,
    /// Without instrument and scatter.
    pub exact: Measurements,
    /// Later sessions: what slipped or drifted in the first is put right. With each the rows in which
    /// the instrument was just wrong.
    pub fresh: Vec<(Measurements, Vec<bool>)>,
}

/// The arm of a seed. Every fifth has no physical effect; every other block of five is measured in
/// position alone, every fourth such block has no load; the kind of arm goes round.
pub fn draw(seed: u64) -> Drawn {
    let k = seed.saturating_sub(1);
    let orientation = (k / 5).is_multiple_of(2);
    let loads = k / 10 % 4 != 3;
    let model = &MODELS[((k + k / 5) % MODELS.len() as u64) as usize];
    let arm = model.arm();
    let frames = Frames::unknown(seed);
    let mut rng = Rng::new(seed, Stream::Arm);
    let geometry = off_design(&arm, &mut rng);
    let design = session::rows(model, &arm, orientation, loads, seed);
    let count = if k % 5 == 4 { 0 } else { 1 + (k as usize / 20 + k as usize) % 3 };
    let planted = {
        let bench = Bench::new(&arm, &design, &frames, INSTRUMENT.scale);
        plant(&bench, &arm, &design, count, &mut rng)
    };
    let physical: Vec<Truth> = planted.iter().map(|p| p.truth.clone()).collect();
    let all: Vec<Truth> = geometry.iter().chain(&physical).cloned().collect();
    let measure = |truths: &[Truth], design: &Measurements, seed: u64| {
        let plant = Plant::new(&arm, truths).expect("truths of this arm");
        let campaign =
            plant.with_frames(frames.clone()).campaign(design, INSTRUMENT, SCATTER, seed);
        campaign.expect("an arm that carries its loads")
    };
    let campaign = measure(&all, &design, seed);
    let (data, text) = as_read(&arm, &campaign.measured, "campaign.csv");
    let lasting: Vec<Truth> = all.iter().filter(|t| lasts(t.effect)).cloned().collect();
    let fresh = (1..=FRESH as u64).map(|session| {
        let seed = seed + 1_000_000 * session;
        let design = session::rows(model, &arm, orientation, loads, seed);
        let campaign = measure(&lasting, &design, seed);
        let data = as_read(&arm, &campaign.measured, "another.csv").0;
        let wrong = wrong(&errors(&data, &campaign.exact));
        (data, wrong)
    });
    Drawn {
        seed,
        robot: model.robot,
        orientation,
        loads,
        fresh: fresh.collect(),
        file: model.file(&arm),
        arm: arm.clone(),
        frames: frames.clone(),
        geometry,
        planted,
        text,
        data,
        exact: campaign.exact,
    }
}

/// The rows whose error in position no normal error of the middle row's size would have in a hundred
/// such sessions: of a chi-squared number of three degrees of freedom the median is 2.366, and one in
/// twenty thousand is beyond 22.5.
fn wrong(errors: &[Vector6<f64>]) -> Vec<bool> {
    let sizes: Vec<f64> = errors.iter().map(|e| e.fixed_rows::<3>(0).norm_squared()).collect();
    let mut ascending = sizes.clone();
    ascending.sort_by(f64::total_cmp);
    let limit = 22.5 / 2.366 * ascending[ascending.len() / 2];
    sizes.into_iter().map(|size| size > limit).collect()
}

/// Whether the arm still has it in another session.
pub fn lasts(effect: &dyn Effect) -> bool {
    !matches!(effect.identifier(), "slip" | "drift")
}

/// Every offset and every number of every row a little wrong.
fn off_design(arm: &Arm, rng: &mut Rng) -> Vec<Truth> {
    let mut truths: Vec<Truth> = Vec::new();
    for (effect, place, name) in ordinary(arm) {
        if matches!(place, Place::Base | Place::Tool) {
            continue;
        }
        let number = effect.number(arm, place, &name);
        let length = number.is_some_and(|(_, n)| n.quantity == Quantity::Length);
        let value = (name, OFF[usize::from(!length)] * rng.normal());
        match truths.last_mut().filter(|t| t.effect == effect && t.place == place) {
            Some(truth) => truth.values.push(value),
            None => truths.push(Truth { effect, place, values: vec![value] }),
        }
    }
    truths
}

/// So many different effects, each at a place at which it can be seen.
fn plant(
    bench: &Bench<'_>,
    arm: &Arm,
    design: &Measurements,
    count: usize,
    rng: &mut Rng,
) -> Vec<Planted> {
    let mut found: Vec<(Truth, DVector<f64>)> = Vec::new();
    let can = |e: &&'static dyn Effect| !GEOMETRY.contains(&e.identifier()) && !e.has_one_size();
    let mut effects: Vec<&'static dyn Effect> = effects().into_iter().filter(can).collect();
    rng.shuffle(&mut effects);
    for effect in effects {
        if found.len() == count {
            break;
        }
        let mut places = effect.places(arm);
        rng.shuffle(&mut places);
        let seen = places.into_iter().find_map(|place| {
            let wanted = rng.between(RATIO[0], RATIO[1]);
            let new = of_size(bench, arm, design, (effect, place), wanted, rng)?;
            let mut all: Vec<&DVector<f64>> = found.iter().map(|(_, signal)| signal).collect();
            all.push(&new.1);
            let each = (0..all.len()).map(|own| {
                let others: Vec<_> = (0..all.len()).filter(|k| *k != own).map(|k| all[k]).collect();
                bench.evidence(all[own], &others)
            });
            each.fold(f64::INFINITY, f64::min).ge(&EVIDENCE).then_some(new)
        });
        found.extend(seen);
    }
    let signals: Vec<DVector<f64>> = found.iter().map(|(_, signal)| signal.clone()).collect();
    let planted = found.into_iter().enumerate().map(|(own, (truth, signal))| {
        let others: Vec<_> =
            (0..signals.len()).filter(|k| *k != own).map(|k| &signals[k]).collect();
        let (ratio, evidence) = (bench.ratio(&signal), bench.evidence(&signal, &others));
        Planted { truth, ratio, evidence }
    });
    planted.collect()
}

/// An effect that moves the tool so many times as far as the noise does.
fn of_size(
    bench: &Bench<'_>,
    arm: &Arm,
    design: &Measurements,
    (effect, place): (&'static dyn Effect, Place),
    wanted: f64,
    rng: &mut Rng,
) -> Option<(Truth, DVector<f64>)> {
    let values = effect.draw(&mut Draw::new(arm, place, design, rng));
    let mut truth = Truth { effect, place, values };
    // Most gaps are proportional to the size, that of a cubic law and its torque nearly so.
    for _ in 0..5 {
        let signal = bench.signal(&truth)?;
        let off = wanted / bench.ratio(&signal);
        if (off - 1.0).abs() < 0.01 {
            return is_plausible(&truth, arm).then_some((truth, signal));
        }
        truth = resized(&truth, arm, off)?;
    }
    None
}

/// Whether an arm that works may have it.
fn is_plausible(truth: &Truth, arm: &Arm) -> bool {
    let mass: f64 = arm.joints.iter().map(|joint| joint.mass).sum();
    truth.values.iter().all(|(name, value)| {
        let number = truth.effect.number(arm, truth.place, name);
        let most = match number.map(|(_, number)| number.quantity) {
            Some(Quantity::Length)
                if ["payload_com", "link_com"].contains(&truth.effect.identifier()) =>
            {
                0.1
            }
            Some(Quantity::Length | Quantity::Angle) => 5e-3,
            Some(Quantity::Mass) => 0.3 * mass,
            Some(Quantity::PerKelvin) => 5e-5,
            Some(Quantity::Ratio) => 0.2,
            _ => f64::INFINITY,
        };
        value.abs() <= most
    })
}

/// Rounded as a controller and a tracker write, and read back from the text.
fn as_read(arm: &Arm, measured: &Measurements, file: &str) -> (Measurements, String) {
    let mut rounded = measured.clone();
    for row in &mut rounded.rows {
        row.q.iter_mut().for_each(|q| *q = (*q * 1e8).round() / 1e8);
        let digits = [1e7, 1e7, 1e7, 1e8, 1e8, 1e8];
        row.measured = Vector6::from_fn(|k, _| (row.measured[k] * digits[k]).round() / digits[k]);
    }
    let text = csv(arm, &rounded, &[]);
    let layout = Layout::new(arm.joints.iter().map(|joint| joint.motion));
    let data = Measurements::from_bytes(file, text.as_bytes(), &layout).expect("our own file");
    (data, text)
}
