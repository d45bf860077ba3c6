//! A command is followed later than it is logged.

use super::{LogEffect, Number, Spot};
use crate::effects::About;
use crate::log::pace::{Pace, round};
use crate::log::scene::{Column, Domain, Scene};

/// Joints go where they were to be `delay` ago: a bus, a buffer, an interpolator.
#[derive(Clone, Copy, Debug)]
pub struct Latency;

/// Delays from which the search begins, s.
const STARTS: [f64; 10] = [0.0, 0.01, 0.02, 0.035, 0.06, 0.1, 0.14, 0.2, 0.28, 0.4];

/// A recorder holds a value for up to a step: below this step, s, no arm's delay is shorter.
const SHORT: f64 = 0.01;

impl LogEffect for Latency {
    fn identifier(&self) -> &'static str {
        "latency"
    }

    fn about(&self) -> About {
        About {
            reality: "A command is followed later than it is logged: a bus, a buffer, an interpolator.",
            signature: "All joints are where they were to be some time ago.",
            confused_with: "`tracking_lag`, where all joints have the same.",
            separated_by: "Two speeds and reversals: a delay keeps the path's corners, a lag rounds them.",
        }
    }

    fn domain(&self) -> Domain {
        Domain::Position
    }

    fn spots(&self, _: &Scene<'_>) -> Vec<Spot> {
        vec![Spot::Interface]
    }

    fn numbers(&self) -> &'static [Number] {
        &[("delay", "s")]
    }

    fn columns(&self, scene: &Scene<'_>, _: Spot, values: &[f64]) -> Vec<Column> {
        let step = scene.signals.period;
        let rate = |joint: usize| {
            let [before, after] = [-0.5, 0.5].map(|by| ago(scene, joint, values[0] + by * step));
            let pairs = before.iter().zip(&after);
            pairs.map(|(before, after)| (after - before) / step).collect::<Vec<f64>>()
        };
        vec![whole(scene, rate)]
    }

    fn too_slow(&self, pace: &Pace<'_>, _: Spot, found: Option<&[f64]>) -> Option<String> {
        held(pace, found)
    }

    fn bends(&self) -> bool {
        true
    }

    fn value(&self, scene: &Scene<'_>, _: Spot, values: &[f64]) -> Column {
        whole(scene, |joint| {
            let commands = &scene.signals.command[joint];
            ago(scene, joint, values[0])
                .iter()
                .zip(commands)
                .map(|(then, now)| then - now)
                .collect()
        })
    }

    fn probes(&self, _: &Scene<'_>, _: Spot) -> Vec<Vec<f64>> {
        STARTS.iter().map(|delay| vec![*delay]).collect()
    }

    fn may_be(&self, values: &[f64]) -> bool {
        values[0] >= 0.0
    }
}

/// The commands of so long ago, by straight lines; at the beginning of a span its first.
pub(super) fn ago(scene: &Scene<'_>, joint: usize, delay: f64) -> Vec<f64> {
    let commands = &scene.signals.command[joint];
    let back = delay / scene.signals.period;
    let mut then = Vec::with_capacity(commands.len());
    for span in &scene.signals.spans {
        let part = &commands[span.fine.clone()];
        let last = (part.len() - 1) as f64;
        then.extend((0..part.len()).map(|k| {
            let at = (k as f64 - back).clamp(0.0, last);
            let (before, within) = (at.floor() as usize, at.fract());
            let after = (before + 1).min(part.len() - 1);
            part[before] + within * (part[after] - part[before])
        }));
    }
    then
}

fn whole(scene: &Scene<'_>, of: impl Fn(usize) -> Vec<f64>) -> Column {
    let joints = 0..scene.signals.joints();
    Column { parts: joints.map(|joint| (joint, scene.signals.filtered(&of(joint)))).collect() }
}

/// Why a delay cannot be told from the recorder's, where this one is `found`.
pub(super) fn held(pace: &Pace<'_>, found: Option<&[f64]>) -> Option<String> {
    let period = pace.period;
    let told = found.is_some_and(|values| values[0].abs() > 0.5 * period);
    (period >= SHORT && !told).then(|| {
        format!(
            "a sample every {} ms is held for as long: a delay of less than half of that may be the recorder's",
            round(1e3 * period)
        )
    })
}
