//! Logs with a wrong file or a wrong reading, and what is said of them.

use stiffarm_gap::log::report::LogDiagnosis;
use stiffarm_gap::log::{Log, LogOptions, Refused, Signal, TorqueSide, diagnose};
use stiffarm_kernels::generic::Arm;

use super::plant::{Recorder, arm, heavier, rigid};

/// Coulomb and viscous friction of the two joints.
const FRICTION: [[f64; 2]; 2] = [[6.0, 3.0], [1.5, 2.5]];

/// A log of the plant with friction: torques told `late`, of what is held, joint values `off` by so much of the torque.
fn recorded(seed: u64, late: f64, held: f64, off: [f64; 2]) -> Log {
    let recorder = Recorder::new(seed, 6000, 0.1);
    recorder.torques(|now| {
        let asks = |[q, v, a]: [[f64; 2]; 3]| {
            if held > 0.0 { heavier(held, q, v, a) } else { rigid(q, v, a) }
        };
        let then = recorder.path.at(now.t - late);
        let (loads, told, v) = (asks([now.q, now.v, now.a]), asks(then), then[1]);
        let drives = |j: usize| told[j] + FRICTION[j][0] * v[j].signum() + FRICTION[j][1] * v[j];
        ([0, 1].map(drives), [0, 1].map(|j| off[j] * loads[j]))
    })
}

/// An arm whose file has the friction times so much.
fn braked(times: f64) -> Arm {
    let mut arm = arm();
    for (joint, [coulomb, viscous]) in arm.joints.iter_mut().zip(FRICTION) {
        (joint.drive.coulomb, joint.drive.viscous) = (times * coulomb, times * viscous);
    }
    arm
}

fn diagnosed(arm: &Arm, log: &Log) -> LogDiagnosis {
    let side = Some(TorqueSide::Motor);
    let options = LogOptions { band: Some(10.0), side, ..LogOptions::default() };
    diagnose(arm, log, &options).unwrap()
}

/// Effects, places and first numbers.
fn named(found: &LogDiagnosis) -> Vec<(&str, &str, f64)> {
    let one = |f| -> (&str, &str, f64) {
        let f: &stiffarm_gap::log::report::Finding = f;
        (&f.effect, &f.place, f.parameters[0].value)
    };
    found.findings.iter().map(one).collect()
}

/// Half a second is hundreds of times what a first order would tell; of a tenth of a sample the time is told.
#[test]
fn torques_that_are_told_late_are_so_by_that_and_lack_nothing_else() {
    for late in [-0.05, 0.2, 0.5] {
        let found = diagnosed(&braked(1.0), &recorded(64, late, 0.0, [0.0; 2]));
        let all = named(&found);
        assert_eq!(all.len(), 1, "{late}: {all:?}");
        assert_eq!((all[0].0, all[0].1), ("latency", "the interface"), "{late}");
        assert!((all[0].2 - late).abs() < 1e-3, "{late}: {all:?}");
    }
    // Friction that the file has not is found beside it.
    let found = diagnosed(&braked(0.0), &recorded(62, 0.2, 0.0, [0.0; 2]));
    let all = named(&found);
    let late = all.iter().find(|(effect, ..)| *effect == "latency");
    assert!(late.is_some_and(|late| (late.2 - 0.2).abs() < 1e-3), "{all:?}");
    assert_eq!(all.len(), 5, "{all:?}");
}

/// What is found is beyond the file's, and their sum is what there is: none of it below zero.
#[test]
fn friction_of_the_file_is_taken_back() {
    let log = recorded(63, 0.0, 0.0, [0.0; 2]);
    for times in [1.0 / 0.6, 3.0] {
        let found = diagnosed(&braked(times), &log);
        let all = named(&found);
        assert_eq!(all.len(), 4, "{times}: {all:?}");
        for (j, [coulomb, viscous]) in FRICTION.into_iter().enumerate() {
            let place = format!("joint {}", j + 1);
            for (effect, there) in [("coulomb_friction", coulomb), ("viscous_friction", viscous)] {
                let is = all.iter().find(|(e, p, _)| *e == effect && *p == place);
                let (.., value) = is.unwrap_or_else(|| panic!("{effect} at {place}: {all:?}"));
                assert!((value + times * there - there).abs() < 0.1 * there, "{times}: {all:?}");
            }
        }
    }
}

/// Of links whose numbers are known a scale multiplies what those ask, not what is fitted to the scaled torques.
#[test]
fn a_scale_of_known_links_is_told_whole() {
    let log = Recorder::new(65, 6000, 0.1).torques(|now| {
        let [first, second] = now.rigid_and([0.0; 2]);
        ([1.3 * first, second], [0.0; 2])
    });
    let side = Some(TorqueSide::Motor);
    let options = LogOptions { band: Some(10.0), side, known_links: true, ..LogOptions::default() };
    let found = diagnose(&arm(), &log, &options).unwrap();
    let all = named(&found);
    assert_eq!((all.len(), all[0].0, all[0].1), (1, "torque_scale", "joint 1"), "{all:?}");
    assert!((all[0].2 - 0.3).abs() < 2e-3, "{all:?}");
}

/// Of sixteen samples one is kept, and a joint turns round between two of them: no effect near standstill is made of it.
#[test]
fn friction_is_all_there_is_of_a_log_that_is_thinned() {
    let recorder = Recorder { step: 0.002, ..Recorder::new(66, 30_000, 0.05) };
    let log = recorder.torques(|now| {
        let brakes = |j: usize| FRICTION[j][0] * now.v[j].signum() + FRICTION[j][1] * now.v[j];
        (now.rigid_and([0, 1].map(brakes)), [0.0; 2])
    });
    let found = super::plant::diagnosed(&log, 3.0);
    let all = named(&found);
    assert_eq!(all.len(), 4, "{all:?}");
    for (effect, place, value) in all {
        let joint = usize::from(place == "joint 2");
        let there = FRICTION[joint][usize::from(effect == "viscous_friction")];
        assert!((value / there - 1.0).abs() < 5e-3, "{effect} at {place}: {value}, not {there}");
    }
}

#[test]
fn one_number_at_every_joint_is_doubted() {
    let alike = |arm: &mut Arm, by: f64| {
        let mut more = arm.joints[1].clone();
        more.drive.coulomb = by;
        arm.joints.push(more);
    };
    let mut arm = braked(1.0);
    alike(&mut arm, 6.0);
    arm.joints.iter_mut().for_each(|joint| joint.drive.viscous = 10.0);
    let said = stiffarm_gap::log::readings::placeholder(&arm, Some(TorqueSide::Motor));
    assert!(said.is_some_and(|said| said.contains("viscous = 10 at every joint")));
    assert_eq!(stiffarm_gap::log::readings::placeholder(&arm, Some(TorqueSide::Link)), None);
    assert_eq!(
        stiffarm_gap::log::readings::placeholder(&braked(1.0), Some(TorqueSide::Motor)),
        None
    );
}

/// Of four runs two carry 0.8 kg: one number for both, whether somebody named it or not.
#[test]
fn what_several_runs_carry_is_one_body() {
    let mut all = recorded(71, 0.0, 0.0, [0.0; 2]);
    for (seed, held) in [(72, 0.8), (73, 0.0), (74, 0.8)] {
        all.runs.extend(recorded(seed, 0.0, held, [0.0; 2]).runs);
    }
    let mut told = all.clone();
    for run in [1, 3] {
        told.runs[run].payload = Some("disc".to_owned());
    }
    for (log, remarks) in [(told, 0), (all, 1)] {
        let found = diagnosed(&braked(1.0), &log);
        let named = named(&found);
        assert_eq!(named.len(), 1, "{named:?}");
        assert_eq!((named[0].0, named[0].1), ("payload", "the tool in runs 2 and 4"));
        assert!((named[0].2 - 0.8).abs() < 0.08, "{named:?}");
        let says = |remark: &&String| remark.contains("runs 2 and 4 carry about 0.");
        assert_eq!(found.remarks.iter().filter(says).count(), remarks, "{:?}", found.remarks);
    }
}

/// The encoder stands before a gear of 2e-4 rad/(N·m) that sags under the weights of both links.
#[test]
fn a_gear_that_sags_under_weights_is_told_from_a_wrong_zero() {
    let found = diagnosed(&braked(1.0), &recorded(81, 0.0, 0.0, [2e-4, 0.0]));
    let all = named(&found);
    let first = all.iter().find(|(effect, ..)| *effect == "joint_elasticity");
    let (_, place, value) = first.unwrap_or_else(|| panic!("{all:?}"));
    assert_eq!((*place, all.len()), ("joint 1", 1), "{all:?}");
    assert!((value / 2e-4 - 1.0).abs() < 0.15, "{all:?}");
}

/// The other joint is diagnosed; without any there is nothing to say.
#[test]
fn a_silent_channel_is_left_out_and_not_the_log() {
    let mut log = recorded(91, 0.0, 0.0, [0.0; 2]);
    let torques = |log: &mut Log, joint: usize| {
        log.runs[0].signals.get_mut(&Signal::Torque).expect("torques")[joint].fill(0.0);
    };
    torques(&mut log, 1);
    let found = diagnosed(&braked(0.0), &log);
    assert!(found.remarks[0].contains("tau2 is 0 throughout"), "{:?}", found.remarks);
    let all = named(&found);
    assert_eq!(all.iter().map(|f| f.1).collect::<Vec<_>>(), ["joint 1"; 2], "{all:?}");
    torques(&mut log, 0);
    let side = Some(TorqueSide::Motor);
    let refused = diagnose(&arm(), &log, &LogOptions { side, ..LogOptions::default() });
    assert!(matches!(refused, Err(Refused::Silent { .. })), "{refused:?}");
}

/// The second joint's amplifier has a limit below a twentieth of its torques: the first joint keeps its rows and its values,
/// and the second's friction is that of its other rows.
#[test]
fn what_is_clipped_costs_its_own_joint_alone() {
    let right = recorded(93, 0.0, 0.0, [0.0; 2]);
    let mut clipped = right.clone();
    let rows = &mut clipped.runs[0].signals.get_mut(&Signal::Torque).expect("torques")[1];
    let mut sizes: Vec<f64> = rows.iter().map(|x| x.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let most = sizes[19 * sizes.len() / 20];
    rows.iter_mut().for_each(|x| *x = x.clamp(-most, most));
    let [before, after] = [&right, &clipped].map(|log| diagnosed(&braked(0.0), log));
    let said = &after.remarks[0];
    assert!(said.contains("tau2 stands at its limit of"), "{said}");
    assert!(said.contains("there rows of joint 2 are left out"), "{said}");
    // A twentieth of one joint's samples, and half a period of 10 Hz beside each of some dozen stretches.
    let rows = after.evidence.rows as f64 / before.evidence.rows as f64;
    assert!((0.88..0.98).contains(&rows), "{rows}");
    let first = |found: &LogDiagnosis| -> Vec<f64> {
        let own = found.findings.iter().filter(|f| f.place == "joint 1");
        own.map(|f| f.parameters[0].value).collect()
    };
    assert_eq!(first(&before).len(), first(&after).len());
    for (is, was) in first(&after).iter().zip(first(&before)) {
        assert!((is / was - 1.0).abs() < 0.02, "{is} {was}");
    }
    for (effect, there) in [("coulomb_friction", 1.5), ("viscous_friction", 2.5)] {
        let all = named(&after);
        let is = all.iter().find(|(e, place, _)| (*e, *place) == (effect, "joint 2"));
        assert!(is.is_some_and(|is| (is.2 / there - 1.0).abs() < 0.1), "{all:?}");
    }
}

/// Late by a fifth of a second besides: the columns are put right first, then the delay is found as that of right ones.
#[test]
fn columns_are_read_as_meant_where_torques_are_late_besides() {
    let right = recorded(96, 0.2, 0.0, [0.0; 2]);
    let torques = |log: &mut Log, change: &dyn Fn(&mut Vec<Vec<f64>>)| {
        change(log.runs[0].signals.get_mut(&Signal::Torque).expect("torques"));
    };
    type Change<'a> = &'a dyn Fn(&mut Vec<Vec<f64>>);
    let turned: Change<'_> = &|all| all[1].iter_mut().for_each(|x| *x = -*x);
    let swapped: Change<'_> = &|all| all.swap(0, 1);
    for (change, words) in [
        (turned, "tau2 has the wrong sign"),
        (swapped, "tau1 and tau2 stand in each other's columns"),
    ] {
        let mut log = right.clone();
        torques(&mut log, change);
        let found = diagnosed(&braked(1.0), &log);
        let said: Vec<&String> = found.remarks.iter().filter(|r| r.contains("plant.csv")).collect();
        assert!(said.len() == 1 && said[0].contains(words), "{:?}", found.remarks);
        let all = named(&found);
        assert!(all.len() == 1 && all[0].0 == "latency", "{all:?}");
        assert!((all[0].2 - 0.2).abs() < 1e-3, "{all:?}");
    }
}

/// A turned column, and one that wraps.
#[test]
fn columns_are_read_as_they_must_have_been_meant() {
    let right = recorded(95, 0.0, 0.0, [0.0; 2]);
    let turned = |signal: Signal, joint: usize| {
        let mut log = right.clone();
        let rows = &mut log.runs[0].signals.get_mut(&signal).expect("rows")[joint];
        rows.iter_mut().for_each(|x| *x = -*x);
        log
    };
    let arm = braked(1.0);
    assert!(diagnosed(&arm, &right).remarks.is_empty());
    for (signal, joint, words) in [
        (Signal::Torque, 0, "tau1 has the wrong sign"),
        (Signal::Torque, 1, "tau2 has the wrong sign"),
        (Signal::Q, 1, "q2 has the wrong sign"),
    ] {
        let found = diagnosed(&arm, &turned(signal, joint));
        assert!(
            found.remarks.len() == 1 && found.remarks[0].contains(words),
            "{:?}",
            found.remarks
        );
        assert!(found.findings.is_empty(), "{:?}", named(&found));
    }
}
