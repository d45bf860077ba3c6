//! Chosen motions against motions of chance.

use stiffarm_gap::effects::Spot;
use stiffarm_gap::log::report::Finding;
use stiffarm_gap::log::{Log, LogOptions, diagnose};
use stiffarm_gap::rng::{Rng, Stream};
use stiffarm_plant::course::{Course, Fourier, Limits, State};
use stiffarm_plant::motion::{LAWS, Law, Logged, MotionTruth, MovingPlant, Recording, Side, Stage};
use stiffarm_study::excite::{Excitation, ExciteError, Plan, Purpose, excite};

use crate::fixture::geared as arm;

fn found(purpose: Purpose, tries: usize) -> Result<(Excitation, Limits), ExciteError> {
    let arm = arm();
    let limits = Limits::of(&arm, &[1.0], &[3.0]).unwrap();
    let logged = Logged::Torque(Side::Motor);
    let plan = Plan {
        arm: &arm,
        limits: &limits,
        logged,
        purpose,
        period: 10.0,
        harmonics: 5,
        tries,
        seed: 1,
    };
    Ok((excite(&plan, &|_| {})?, limits))
}

fn of(names: &[&str]) -> Vec<(&'static Law, Spot)> {
    let arm = arm();
    let spots = |law: &'static Law| law.spots(&arm, 1).into_iter().map(move |spot| (law, spot));
    LAWS.iter().filter(|law| names.contains(&law.name)).flat_map(spots).collect()
}

#[test]
fn a_chosen_motion_says_more_than_one_of_chance_within_the_same_limits() {
    let wanted = of(&["coulomb_friction", "viscous_friction", "rotor_inertia", "load_friction"]);
    let (found, limits) = found(Purpose::All(wanted), 60).unwrap();
    assert!(found.value > found.of_chance && found.efficiency > 1.2, "{found:?}");
    // The rotors of joints 1 and 2 are inertias of their links about the same axis: nothing else turns a
    // link about the axis of joint 2, which is square to that of joint 1.
    let rotor = |joint| ("rotor_inertia", Spot::of_joint(joint), "inertia");
    assert_eq!(found.hidden, [rotor(0), rotor(1)]);
    assert_eq!(found.told.len(), 10);
    for k in 0..=5000 {
        let State { q, qd, qdd } = found.course.at(f64::from(k) * 2e-3);
        for j in 0..3 {
            let [low, high] = limits.position[j];
            let held = (low..=high).contains(&q[j])
                && qd[j].abs() <= limits.rate[j]
                && qdd[j].abs() <= limits.acceleration[j];
            assert!(held, "{k}: {q:?} {qd:?} {qdd:?}");
        }
    }
}

#[test]
fn two_effects_are_told_from_each_other() {
    let pair = ["viscous_friction", "friction_curve"];
    let [a, b] = pair.map(|name| (Law::named(name).unwrap(), Spot::of_joint(1)));
    let (found, _) = found(Purpose::Apart([a, b]), 60).unwrap();
    assert!(found.efficiency > 1.2, "{found:?}");
    let scale = (Law::named("torque_scale").unwrap(), Spot::of_joint(0));
    let same = (Law::named("rotor_inertia").unwrap(), Spot::of_joint(0));
    let error = self::found(Purpose::Apart([scale, same]), 5).unwrap_err().to_string();
    assert!(error.contains("rotor_inertia at joint 1"), "{error}");
}

/// What the diagnosis of logs says of friction, after a motion that was chosen and after motions of
/// chance of the same time and limits: the chosen one's intervals are narrower on average.
#[test]
fn intervals_shrink_on_simulated_logs() {
    let wanted = of(&["coulomb_friction", "viscous_friction"]);
    let (found, limits) = found(Purpose::All(wanted), 100).unwrap();
    let arm = arm();
    let truths: Vec<MotionTruth> = (1..=3)
        .flat_map(|j| {
            ["coulomb_friction", "viscous_friction"]
                .map(|name| MotionTruth::parse(&format!("{name}@joint {j}=6"), &arm, 1).unwrap())
        })
        .collect();
    let only = ["coulomb_friction", "viscous_friction"].map(str::to_owned).to_vec();
    let options = LogOptions { effects: Some(only), ..LogOptions::default() };
    let widths = |course: &Fourier, seed: u64| -> Vec<f64> {
        let course = course.clone().repeated(6);
        let logged = Logged::Torque(Side::Motor);
        let recording = Recording { torque: 0.05, ..Recording::default() };
        let plant = MovingPlant::new(&arm, &truths, logged, recording);
        let told = plant.text(&[Stage { course: &course, payload: None }], seed).unwrap();
        let log = Log::of_arm(&arm, "log", &told).unwrap();
        let found = diagnose(&arm, &log, &options).unwrap();
        // In multiples of the noise, which the plant makes as large as the motion's torques are.
        let number = |name: &str, joint: usize| {
            let place = format!("joint {}", joint + 1);
            let is = |f: &&Finding| f.effect == name && f.place == place;
            let ci95 = found.findings.iter().find(is).map(|f| f.parameters[0].ci95);
            ci95.map_or(f64::NAN, |[low, high]| ((high - low) / found.gap[joint].after).ln())
        };
        let both = |joint| ["coulomb_friction", "viscous_friction"].map(|name| number(name, joint));
        (0..3).flat_map(both).collect()
    };
    let chosen: Vec<Vec<f64>> =
        (0..stiffarm_draws::few_or_many(1, 3)).map(|seed| widths(&found.course, seed)).collect();
    let of_chance: Vec<Vec<f64>> = (0..stiffarm_draws::few_or_many(2, 6))
        .map(|seed| {
            let mut rng = Rng::new(100 + seed, Stream::Poses);
            widths(&Fourier::draw(&limits, 10.0, 5, &mut rng), seed)
        })
        .collect();
    let mean = |all: &[Vec<f64>]| {
        let told: Vec<f64> = all.iter().flatten().copied().filter(|x| x.is_finite()).collect();
        assert!(told.len() as f64 > 0.9 * (6 * all.len()) as f64, "{all:?}");
        told.iter().sum::<f64>() / told.len() as f64
    };
    let narrower = (mean(&of_chance) - mean(&chosen)).exp();
    assert!(narrower > 1.05, "{narrower}: {chosen:?} {of_chance:?}");
}
