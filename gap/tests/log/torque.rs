//! Torques of the plant with friction.

use stiffarm_gap::log::{Log, Signal};

use super::plant::{Recorder, diagnosed, finding};

/// Friction of the two joints, Coulomb and viscous; torques times `scale`.
fn recorded(seed: u64, friction: [[f64; 2]; 2], scale: f64) -> Log {
    let mut log = Recorder::new(seed, 8000, 0.3).torques(|now| {
        let brake = |j: usize| friction[j][0] * now.v[j].signum() + friction[j][1] * now.v[j];
        (now.rigid_and([0, 1].map(brake)), [0.0; 2])
    });
    let torques = log.runs[0].signals.get_mut(&Signal::Torque).expect("torques");
    torques.iter_mut().flatten().for_each(|x| *x *= scale);
    log
}

#[test]
fn friction_is_found_where_it_is_with_its_numbers() {
    let found = diagnosed(&recorded(1, [[6.0, 0.0], [1.5, 2.5]], 1.0), 8.0);
    for (effect, place, value) in [
        ("coulomb_friction", "joint 1", 6.0),
        ("coulomb_friction", "joint 2", 1.5),
        ("viscous_friction", "joint 2", 2.5),
    ] {
        let finding = finding(&found, effect, place);
        let parameter = &finding.parameters[0];
        let half = 0.5 * (parameter.ci95[1] - parameter.ci95[0]);
        // Intervals hold 95 %: twice as wide they hold what is true of all three here.
        assert!((parameter.value - value).abs() < 2.0 * half, "{finding:#?}");
        assert!(half < 0.1 * value && finding.p_value <= 0.05, "{finding:#?}");
    }
    assert_eq!(found.findings.len(), 3, "{found:#?}");
    // What is left is the noise of 0.3 N·m: of a spectrum that falls from 3.2 Hz on three quarters of the
    // power lie below 8 Hz, 0.26 N·m; its 800 independent numbers tell that to a fortieth.
    for gap in &found.gap {
        assert!(gap.after < 0.3 && gap.after > 0.1 && gap.before > 3.0 * gap.after, "{gap:?}");
    }
}

#[test]
fn nothing_is_found_where_nothing_is() {
    let found = diagnosed(&recorded(2, [[0.0; 2]; 2], 1.0), 8.0);
    assert!(found.findings.is_empty(), "{found:#?}");
}

/// All torques times a factor: with free masses the same is left, part for part.
#[test]
fn a_scale_of_all_torques_is_a_gauge() {
    let friction = [[6.0, 0.0], [1.5, 2.5]];
    let left = |scale: f64| -> Vec<f64> {
        let found = diagnosed(&recorded(3, friction, scale), 8.0);
        assert!(found.cannot_see.iter().any(|h| h.effect == "torque_scale"));
        found.gap.iter().map(|g| g.after / g.size).collect()
    };
    let one = left(1.0);
    for scale in [0.75, 1.25] {
        for (scaled, one) in left(scale).iter().zip(&one) {
            assert!((scaled / one - 1.0).abs() < 1e-6, "{scaled} {one}");
        }
    }
}
