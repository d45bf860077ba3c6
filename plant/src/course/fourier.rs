//! A finite Fourier series of each joint (Swevers et al., IEEE Trans. Robotics Autom. 13, 1997, eq. 8).
//!
//! `q̇ = Σ a_l cos(l ω t) + b_l sin(l ω t)`, so that the motion repeats. With `Σ a_l = 0` and
//! `Σ l b_l = 0` it begins and ends at rest, without a jump of the acceleration.

use core::f64::consts::{PI, TAU};

use super::limits::Limits;
use super::{Course, State};
use crate::rng::Rng;

/// Samples of the highest harmonic's period where extremes are looked for. Of a trigonometric
/// polynomial of degree N sampled at P points of its period the largest value is at most
/// `1/cos(π N / P)` times the largest sample (Ehlich & Zeller 1964).
const FINE: usize = 32;

/// A periodic motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Fourier {
    /// s.
    pub period: f64,
    /// How often it is gone through.
    pub periods: usize,
    joints: Vec<Series>,
}

/// One joint.
#[derive(Clone, Debug, PartialEq)]
struct Series {
    middle: f64,
    /// `a_l` and `b_l` of harmonic l = 1, 2 …
    terms: Vec<[f64; 2]>,
}

/// Harmonic l at one time: its rate `l ω`, rad/s, the sine and the cosine. Joints share them.
struct Wave {
    rate: f64,
    sin: f64,
    cos: f64,
}

fn waves(harmonics: usize, base: f64, time: f64) -> Vec<Wave> {
    let wave = |l: usize| {
        let rate = l as f64 * base;
        let (sin, cos) = (rate * time).sin_cos();
        Wave { rate, sin, cos }
    };
    (1..=harmonics).map(wave).collect()
}

impl Fourier {
    /// A motion of chance that uses the limits, once through.
    pub fn draw(limits: &Limits, period: f64, harmonics: usize, rng: &mut Rng) -> Fourier {
        let mut series = || Series {
            middle: rng.between(-1.0, 1.0),
            terms: (0..harmonics).map(|_| [rng.normal(), rng.normal()]).collect(),
        };
        let joints = (0..limits.rate.len()).map(|_| series()).collect();
        Fourier { period, periods: 1, joints }.within(limits)
    }

    /// The same, so many times over.
    pub fn repeated(self, periods: usize) -> Fourier {
        Fourier { periods, ..self }
    }

    /// Another motion like it: the terms of one joint differ by chance, about by `size` of their own.
    pub fn varied(&self, limits: &Limits, size: f64, rng: &mut Rng) -> Fourier {
        let mut varied = self.clone();
        for (series, [low, high]) in varied.joints.iter_mut().zip(&limits.position) {
            series.middle = 2.0 * (series.middle - low) / (high - low) - 1.0;
        }
        let one = rng.below(self.joints.len());
        let series = &mut varied.joints[one];
        let squares = series.terms.iter().flatten().map(|x| x * x).sum::<f64>();
        let usual = (squares / (2.0 * series.terms.len() as f64)).sqrt();
        for x in series.terms.iter_mut().flatten() {
            *x += size * usual * rng.normal();
        }
        series.middle = (series.middle + size * rng.normal()).clamp(-1.0, 1.0);
        varied.within(limits)
    }

    /// Made to begin at rest, and as large as the limits let it be; middles are parts of the ranges,
    /// from −1 to 1, and moved where the motion would leave them.
    fn within(mut self, limits: &Limits) -> Fourier {
        let base = TAU / self.period;
        let count = FINE * self.harmonics();
        let samples = (0..count).map(|k| TAU / base * k as f64 / count as f64);
        let samples: Vec<_> = samples.map(|time| waves(self.harmonics(), base, time)).collect();
        for (k, series) in self.joints.iter_mut().enumerate() {
            series.rest();
            let [low, high] = limits.position[k];
            let part = core::mem::replace(&mut series.middle, 0.0);
            let [bottom, top] = series.extremes(&samples);
            let sizes =
                [(top - bottom) / (high - low), series.largest(&samples, 1) / limits.rate[k]];
            let hardest = series.largest(&samples, 2) / limits.acceleration[k];
            let largest = sizes.into_iter().fold(hardest, f64::max);
            if largest > 0.0 {
                series.terms.iter_mut().flatten().for_each(|x| *x /= largest);
            }
            let [bottom, top] = series.extremes(&samples);
            let wanted = 0.5 * ((1.0 - part) * low + (1.0 + part) * high) - 0.5 * (bottom + top);
            // Rounding may leave a range that is used up a little too small.
            series.middle = wanted.max(low - bottom).min(high - top);
        }
        self
    }

    fn harmonics(&self) -> usize {
        self.joints.first().map_or(0, |series| series.terms.len())
    }
}

impl Series {
    /// The nearest series that begins at rest.
    fn rest(&mut self) {
        let n = self.terms.len() as f64;
        let mean = self.terms.iter().map(|t| t[0]).sum::<f64>() / n;
        let weights = || (1..=self.terms.len()).map(|l| l as f64);
        let squares: f64 = weights().map(|l| l * l).sum();
        let along = self.terms.iter().zip(weights()).map(|(t, l)| l * t[1]).sum::<f64>() / squares;
        for (l, term) in (1..).zip(&mut self.terms) {
            term[0] -= mean;
            term[1] -= f64::from(l) * along;
        }
    }

    /// Value, rate and acceleration.
    fn at(&self, waves: &[Wave]) -> [f64; 3] {
        let mut all = [self.middle, 0.0, 0.0];
        for (Wave { rate, sin, cos }, [a, b]) in waves.iter().zip(&self.terms) {
            all[0] += (a * sin - b * cos) / rate;
            all[1] += a * cos + b * sin;
            all[2] += rate * (b * cos - a * sin);
        }
        all
    }

    /// At most, of rates (1) or accelerations (2).
    fn largest(&self, samples: &[Vec<Wave>], which: usize) -> f64 {
        let sizes = samples.iter().map(|waves| self.at(waves)[which].abs());
        sizes.fold(0.0, f64::max) / (PI / FINE as f64).cos()
    }

    /// At least and at most, of values.
    fn extremes(&self, samples: &[Vec<Wave>]) -> [f64; 2] {
        let ends = |[low, high]: [f64; 2], x: f64| [low.min(x), high.max(x)];
        let values = samples.iter().map(|waves| self.at(waves)[0]);
        let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], ends);
        // About its middle the polynomial is one whose largest sample is half the range.
        let more = 0.5 * (high - low) * (1.0 / (PI / FINE as f64).cos() - 1.0);
        [low - more, high + more]
    }
}

impl Course for Fourier {
    fn duration(&self) -> f64 {
        self.period * self.periods as f64
    }

    fn at(&self, time: f64) -> State {
        let time = time.clamp(0.0, self.duration());
        let waves = waves(self.harmonics(), TAU / self.period, time);
        self.joints.iter().map(|series| series.at(&waves)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Stream;

    fn limits() -> Limits {
        Limits {
            position: vec![[-0.5, 2.5], [0.3, 0.9], [-100.0, 100.0]],
            rate: vec![1.0, 10.0, 0.7],
            acceleration: vec![3.0, 5.0, 100.0],
        }
    }

    #[test]
    fn limits_are_held_between_the_samples_too_and_used() {
        let limits = limits();
        for seed in 0..40 {
            let mut rng = Rng::new(seed, Stream::Poses);
            let mut motion = Fourier::draw(&limits, 10.0, 5, &mut rng);
            if seed % 2 == 1 {
                motion = motion.varied(&limits, 0.5, &mut rng);
            }
            let mut largest = [[0.0_f64; 3]; 3];
            for k in 0..20_011 {
                let state = motion.at(10.0 * f64::from(k) / 20_011.0);
                for (j, largest) in largest.iter_mut().enumerate() {
                    let [low, high] = limits.position[j];
                    assert!((low..=high).contains(&state.q[j]), "{seed}: {state:?}");
                    let parts = [
                        (state.q[j] - motion.joints[j].middle).abs() / (high - low),
                        state.qd[j].abs() / limits.rate[j],
                        state.qdd[j].abs() / limits.acceleration[j],
                    ];
                    largest.iter_mut().zip(parts).for_each(|(most, x)| *most = most.max(x));
                }
            }
            for most in largest {
                assert!(most.iter().all(|part| *part <= 1.0), "{seed}: {most:?}");
                // Some limit is reached, but for what the bound between samples keeps back.
                assert!(most.iter().any(|part| *part > 0.4), "{seed}: {most:?}");
            }
        }
    }

    #[test]
    fn rates_are_derivatives_and_the_ends_are_at_rest() {
        let motion = Fourier::draw(&limits(), 8.0, 4, &mut Rng::new(1, Stream::Poses)).repeated(2);
        let step = 1e-5;
        for time in [0.3, 2.9, 7.1, 11.0] {
            let [before, at, after] = [-step, 0.0, step].map(|by| motion.at(time + by));
            for j in 0..3 {
                let rate = (after.q[j] - before.q[j]) / (2.0 * step);
                let acceleration = (after.qd[j] - before.qd[j]) / (2.0 * step);
                // Third derivatives of some units, and 1e-16 over the step.
                assert!((rate - at.qd[j]).abs() < 1e-8, "{time} {j}");
                assert!((acceleration - at.qdd[j]).abs() < 1e-7, "{time} {j}");
            }
        }
        for time in [0.0, 8.0, 16.0] {
            let state = motion.at(time);
            let still = state.qd.iter().chain(&state.qdd).all(|x| x.abs() < 1e-12);
            assert!(still, "{state:?}");
        }
    }
}
