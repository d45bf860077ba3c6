//! Gap-free stretches of a run at even steps, by straight lines between its samples.

use super::filter::LowPass;
use crate::log::{GAP, Run, Signal};

/// Samples per period of the band's edge where columns are computed: signs have harmonics.
const FINE: f64 = 10.0;

/// Jitter below this part of a step is none: stamps are rounded.
const ROUNDED: f64 = 0.02;

/// A gap-free stretch of a run at even steps.
pub(super) struct Even {
    pub(super) run: usize,
    pub(super) t: Vec<f64>,
    /// Of each signal each joint.
    pub(super) signals: Vec<Vec<Vec<f64>>>,
    pub(super) contact: Vec<bool>,
    pub(super) holes: Vec<Vec<bool>>,
}

/// A run at even steps, cut at its gaps; what is too short to be filtered is left out.
pub(super) fn stretches(
    index: usize,
    run: &Run,
    period: f64,
    wanted: &[Signal],
    drive: Option<Signal>,
) -> Vec<Even> {
    let start = run.t.first().copied().unwrap_or(0.0);
    let gaps = (1..run.t.len()).filter(|k| run.t[*k] - run.t[k - 1] > GAP * period);
    let ends: Vec<usize> = gaps.chain([run.t.len()]).collect();
    let mut from = 0;
    let mut evens = Vec::new();
    let joints = run.signals.get(&Signal::Q).map_or(0, Vec::len);
    let mut lacks = vec![vec![false; run.t.len()]; joints];
    for hole in run.holes.iter().filter(|hole| Some(hole.signal) == drive) {
        lacks[hole.joint][hole.samples.clone()].fill(true);
    }
    for end in ends {
        let (t, part) = (&run.t[from..end], from..end);
        from = end;
        if t.len() < 2 * FINE as usize {
            continue;
        }
        let joints = |signal: &Signal| -> Vec<&[f64]> {
            run.signals[signal].iter().map(|joint| &joint[part.clone()]).collect()
        };
        let contact = &run.contact[part.clone()];
        let lacks: Vec<&[bool]> = lacks.iter().map(|joint| &joint[part.clone()]).collect();
        let clean = run.clock.dropped == 0 && run.clock.jitter < ROUNDED * period;
        let (first, last) = (t[0], t[t.len() - 1]);
        // A step that rounding makes a little short is one.
        let whole = ((last - first) / period + ROUNDED) as usize + 1;
        let steps = if clean { t.len() } else { whole };
        let mut before = 0;
        let places: Vec<(usize, f64)> = (0..steps)
            .map(|k| match clean {
                true => (k, 0.0),
                false => {
                    let at = first + period * k as f64;
                    while before + 2 < t.len() && t[before + 1] <= at {
                        before += 1;
                    }
                    (before, (at - t[before]) / (t[before + 1] - t[before]))
                }
            })
            .collect();
        let between = |x: &[f64]| -> Vec<f64> {
            let value = |&(k, part): &(usize, f64)| match part {
                0.0 => x[k],
                part => x[k] + part * (x[k + 1] - x[k]),
            };
            places.iter().map(value).collect()
        };
        evens.push(Even {
            run: index,
            t: (0..steps).map(|k| first - start + period * k as f64).collect(),
            signals: wanted
                .iter()
                .map(|signal| joints(signal).into_iter().map(between).collect())
                .collect(),
            contact: places.iter().map(|at| marked(contact, at)).collect(),
            holes: lacks
                .iter()
                .map(|joint| places.iter().map(|at| marked(joint, at)).collect())
                .collect(),
        });
    }
    evens
}

/// Whether what lies so far behind a sample is made of a marked one.
fn marked(marks: &[bool], (k, part): &(usize, f64)) -> bool {
    marks[*k] || (*part > 0.0 && marks[k + 1])
}

/// Every so-manyth sample is enough for the band.
pub(super) fn thinning(band: f64, period: f64) -> usize {
    ((1.0 / (FINE * band * period)).floor() as usize).max(1)
}

impl Even {
    /// Every so-manyth sample, below what they would fold back.
    pub(super) fn thinned(self, band: f64, period: f64) -> Even {
        let every = thinning(band, period);
        // Half the rate that is kept, and a tenth below: what lies above would be folded back.
        let filter = LowPass::new(0.4 / (period * every as f64), period).filter(|_| every > 1);
        let Some(filter) = filter else { return self };
        let any = |marks: &Vec<bool>| marks.chunks(every).map(|m| m.contains(&true)).collect();
        let thin = |x: &Vec<f64>| filter.apply(x).into_iter().step_by(every).collect();
        Even {
            run: self.run,
            t: self.t.into_iter().step_by(every).collect(),
            signals: self.signals.iter().map(|s| s.iter().map(thin).collect()).collect(),
            contact: any(&self.contact),
            holes: self.holes.iter().map(any).collect(),
        }
    }
}
