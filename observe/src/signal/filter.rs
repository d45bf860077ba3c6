//! One low-pass without a phase: Butterworth of order four, once forwards and once backwards.
//!
//! Second-order sections by the bilinear transform with the corner warped (Oppenheim & Schafer,
//! *Discrete-Time Signal Processing*, ch. 7). Both passes together take the band's edge down by half
//! (−6 dB). The ends are continued by the point reflection of the signal, and each section begins
//! at rest with its first value, so that a constant stays what it is (Gustafsson 1996 does more).

use core::f64::consts::PI;

/// Poles' quality factors of order four, `1/(2 cos(kπ/8))`, k = 1, 3.
const QUALITY: [f64; 2] = [0.541_196_100_146_197, 1.306_562_964_876_376_5];

/// After so many periods of its edge the response has died away to below a thousandth.
const MEMORY: f64 = 2.0;

/// A low-pass for one sampling rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LowPass {
    sections: [Section; 2],
    /// Samples by which the ends are continued.
    margin: usize,
}

/// `y = b (x + 2 x₁ + x₂) − a₁ y₁ − a₂ y₂`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Section {
    b: f64,
    a: [f64; 2],
}

impl LowPass {
    /// With its edge at `band` for samples every `period`; `None` where the edge is not below half the
    /// sampling rate: there is nothing to take away.
    pub fn new(band: f64, period: f64) -> Option<LowPass> {
        let turn = PI * band * period;
        if !(turn > 0.0 && turn < 0.5 * PI) {
            return None;
        }
        let warped = turn.tan();
        let sections = QUALITY.map(|quality| {
            let norm = 1.0 + warped / quality + warped * warped;
            let a = [
                2.0 * (warped * warped - 1.0) / norm,
                (1.0 - warped / quality + warped * warped) / norm,
            ];
            Section { b: warped * warped / norm, a }
        });
        Some(LowPass { sections, margin: (MEMORY / (band * period)).ceil() as usize })
    }

    /// How far, s, a sample reaches into those before and behind it.
    pub fn reach(band: f64) -> f64 {
        MEMORY / band
    }

    /// The filtered samples, as many as there were.
    pub fn apply(&self, x: &[f64]) -> Vec<f64> {
        let (Some(&first), Some(&last)) = (x.first(), x.last()) else { return Vec::new() };
        let margin = self.margin.min(x.len() - 1);
        let before = x[1..=margin].iter().rev().map(|v| 2.0 * first - v);
        let after = x[x.len() - 1 - margin..x.len() - 1].iter().rev().map(|v| 2.0 * last - v);
        let mut y: Vec<f64> = before.chain(x.iter().copied()).chain(after).collect();
        let start = y[0];
        self.pass(start, y.iter_mut());
        let end = y[y.len() - 1];
        self.pass(end, y.iter_mut().rev());
        y.truncate(margin + x.len());
        y.drain(..margin);
        y
    }

    /// Once through both sections, from rest at a value. They go along together: each waits for its own last value alone,
    /// so that a processor has both in hand at once.
    fn pass<'y>(&self, start: f64, values: impl Iterator<Item = &'y mut f64>) {
        let [mut first, mut second] = self.sections.map(|section| (section, [start; 4]));
        for value in values {
            *value = second.0.next(&mut second.1, first.0.next(&mut first.1, *value));
        }
    }
}

impl Section {
    /// What comes out as this goes in; the last two of each are what is remembered.
    fn next(&self, [x1, x2, y1, y2]: &mut [f64; 4], x: f64) -> f64 {
        let out = (self.b * (x + 2.0 * *x1 + *x2) - self.a[1] * *y2) - self.a[0] * *y1;
        (*x2, *x1, *y2, *y1) = (*x1, x, *y1, out);
        out
    }
}

/// The rate of even samples, by five of them (error of fourth order); by fewer at the ends.
pub fn rate(x: &[f64], period: f64) -> Vec<f64> {
    let n = x.len();
    let slope = |k: usize| match k {
        _ if n < 2 => 0.0,
        0 => x[1] - x[0],
        k if k == n - 1 => x[k] - x[k - 1],
        k if k == 1 || k == n - 2 => 0.5 * (x[k + 1] - x[k - 1]),
        k => (8.0 * (x[k + 1] - x[k - 1]) - (x[k + 2] - x[k - 2])) / 12.0,
    };
    (0..n).map(|k| slope(k) / period).collect()
}

/// The sign of what even samples are of, as their low-pass is to see it, where a step was sampled `finer` times as often
/// before it was thinned. A torque is read at a log's samples: friction there turns halfway between the two around a
/// zero. The sign of each thinned sample would turn up to half a thinned step away; its low-pass then errs by that,
/// which an effect near standstill would explain. Here a turn is spread over four steps by the weights of the cubic
/// through them, so that its low-pass is right to the fourth order of a step; of steps as they were logged it is the
/// plain sign.
pub fn sign(x: &[f64], k: usize, finer: usize) -> f64 {
    let own = if x[k] == 0.0 { 0.0 } else { x[k].signum() };
    if finer == 1 {
        return own;
    }
    let turns = k.saturating_sub(2)..(k + 2).min(x.len() - 1);
    let turns = turns.filter(|before| x[*before] * x[before + 1] < 0.0);
    let more = turns.map(|before| {
        let (from, to) = (x[before], x[before + 1]);
        let between = from / (from - to) * finer as f64;
        let zero = before as f64 + (between.floor() + 0.5) / finer as f64;
        to.signum() * (turned(k as f64 - zero, zero) - (k as f64 - zero).signum())
    });
    own + more.sum::<f64>()
}

/// What a turn from −1 to 1 at `zero` is at a sample so far behind it.
fn turned(behind: f64, zero: f64) -> f64 {
    // Between two steps' ends, in steps from the first.
    let p = (zero - 0.5).rem_euclid(1.0);
    let weights = [
        -p * (p - 1.0) * (p - 2.0) / 6.0,
        (p + 1.0) * (p - 1.0) * (p - 2.0) / 2.0,
        -(p + 1.0) * p * (p - 2.0) / 2.0,
        (p + 1.0) * p * (p - 1.0) / 6.0,
    ];
    let passed = (-1..=2).zip(weights).filter(|(end, _)| f64::from(*end) - p < behind);
    2.0 * passed.map(|(_, weight)| weight).sum::<f64>() - 1.0
}

/// Even samples as they are so many steps later, by the cubic through the four around; beyond an end the last.
pub fn later(x: &[f64], steps: f64) -> Vec<f64> {
    (0..x.len()).map(|k| at(x, k as f64 + steps)).collect()
}

/// What even samples, of which there is one at least, are at a place among them; as [`later`].
pub fn at(x: &[f64], place: f64) -> f64 {
    let last = x.len().saturating_sub(1) as f64;
    let place = place.clamp(0.0, last);
    let (before, s) = (place.floor(), place.fract());
    if s == 0.0 {
        return x[place as usize];
    }
    let [a, b, c, d] = [-1.0, 0.0, 1.0, 2.0].map(|by| x[(before + by).clamp(0.0, last) as usize]);
    // Lagrange's polynomials at −1, 0, 1 and 2.
    b * (1.0 - s * s) * (1.0 - 0.5 * s)
        + c * s * (1.0 + s) * (1.0 - 0.5 * s)
        + s * (1.0 - s) * ((s - 2.0) * a - (1.0 + s) * d) / 6.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cubic is read exactly between its samples, and beyond the end the last is.
    #[test]
    fn samples_later_are_those_of_the_cubic_through_four() {
        let cubic = |t: f64| 0.5 * t * t * t - 2.0 * t * t + t - 3.0;
        let x: Vec<f64> = (0..9).map(|k| cubic(f64::from(k))).collect();
        let moved = later(&x, 1.3);
        for (k, is) in moved.iter().enumerate().take(6) {
            let there = cubic(k as f64 + 1.3);
            assert!((is - there).abs() < 1e-12 * there.abs().max(1.0), "{k}: {is}, not {there}");
        }
        assert_eq!((moved[8], later(&x, 0.0)), (x[8], x));
    }

    const PERIOD: f64 = 1e-3;

    fn sine(frequency: f64) -> Vec<f64> {
        (0..4000).map(|k| (2.0 * PI * frequency * PERIOD * f64::from(k)).sin()).collect()
    }

    /// The response of a Butterworth filter of order four, squared since it is passed twice, with the
    /// frequency as the bilinear transform warps it.
    #[test]
    fn sines_pass_as_the_closed_form_says_and_are_not_delayed() {
        let (band, filter) = (20.0, LowPass::new(20.0, PERIOD).unwrap());
        for frequency in [2.0, 10.0, 20.0, 30.0] {
            let x = sine(frequency);
            let y = filter.apply(&x);
            let warped = (PI * frequency * PERIOD).tan() / (PI * band * PERIOD).tan();
            let gain = 1.0 / (1.0 + warped.powi(8));
            // Away from the ends, where the continued sine is none.
            for k in 1000..3000 {
                assert!((y[k] - gain * x[k]).abs() < 1e-6, "{frequency} Hz, {k}: {}", y[k]);
            }
        }
    }

    #[test]
    fn a_constant_and_a_slope_stay() {
        let filter = LowPass::new(50.0, PERIOD).unwrap();
        let line: Vec<f64> = (0..200).map(|k| 3.0 - 0.5 * f64::from(k)).collect();
        assert!(filter.apply(&[7.0; 50]).iter().all(|y| (y - 7.0).abs() < 1e-12));
        for (x, y) in line.iter().zip(filter.apply(&line)) {
            // What begins at rest is not on the slope: it is a thousandth of the margin's 20 away.
            assert!((x - y).abs() < 0.02, "{x} {y}");
        }
        assert!(filter.apply(&[]).is_empty());
        assert!(LowPass::new(500.0, PERIOD).is_none());
    }

    /// Wherever the zero lies between two samples, its turn is there in the mean, and has no spread and no skew.
    #[test]
    fn a_sign_turns_where_its_zero_is() {
        for part in [0.1, 0.45, 0.5, 0.8] {
            let x: Vec<f64> = (0..12).map(|k| 0.3 * (f64::from(k) - 5.0 - part)).collect();
            // Where the sign turns in the steps, 2 in all: the differences of the samples, at the ends of their steps.
            let turn = |k: usize| 0.5 * (sign(&x, k, 5) - sign(&x, k - 1, 5));
            let turns: Vec<f64> = (1..12).map(turn).collect();
            // Halfway between two of the finer samples.
            let zero = 5.0 + ((part * 5.0).floor() + 0.5) / 5.0;
            for power in 0..4 {
                let moment = |k: usize| turns[k] * (k as f64 + 0.5 - zero).powi(power);
                let sum: f64 = (0..turns.len()).map(moment).sum();
                let whole = if power == 0 { 1.0 } else { 0.0 };
                assert!((sum - whole).abs() < 1e-12, "{part}, {power}: {sum}");
            }
        }
        assert_eq!((sign(&[0.0; 3], 1, 4), sign(&[-2.0], 0, 4)), (0.0, -1.0));
        assert_eq!((sign(&[-1.0, 0.1], 0, 1), sign(&[-1.0, 0.1], 1, 1)), (-1.0, 1.0));
    }

    #[test]
    fn rates_are_those_of_a_sine() {
        let turn = 2.0 * PI * 10.0;
        let rates = rate(&sine(10.0), PERIOD);
        for (k, found) in rates.iter().enumerate().take(3000).skip(2) {
            let expected = turn * (turn * PERIOD * k as f64).cos();
            // (ωT)⁴/30 of the rate.
            assert!((found - expected).abs() < turn * (turn * PERIOD).powi(4) / 25.0);
        }
    }
}
