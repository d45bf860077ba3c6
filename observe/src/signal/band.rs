//! The band in which a log says something of the motion.
//!
//! Above some frequency the joint values hold the noise of their encoders alone: differentiated twice it
//! grows with the frequency squared. The band ends where the spectrum of the joint values, on its way
//! down, last stands clear of the floor that its highest frequencies show.

use core::f64::consts::PI;

use crate::infer::middle;

/// Samples of one spectrum, and how many spectra at most.
const WINDOW: usize = 512;
const MOST: usize = 40;

/// A spectrum stands clear of the floor at so many times its power.
const CLEAR: f64 = 10.0;

/// The band is at most this part of the sampling rate.
const WIDEST: f64 = 0.2;

/// It is at least this part, of torques.
pub(super) const TORQUES: f64 = 0.005;

/// The same of positions: the gap itself is not differentiated, and servos are logged slowly.
pub(super) const POSITIONS: f64 = 0.04;

/// The band, Hz, of stretches of joint values at even steps of `period`, at least this part of the rate.
pub(super) fn found(stretches: &[Vec<Vec<f64>>], period: f64, narrowest: f64) -> f64 {
    let joints = stretches.first().map_or(0, Vec::len);
    let edges = (0..joints).filter_map(|joint| {
        let parts: Vec<&[f64]> = stretches.iter().map(|s| s[joint].as_slice()).collect();
        edge(&spectrum(&parts)?)
    });
    let rate = 1.0 / period;
    let widest = edges.fold(0.0, f64::max) * rate;
    let widest = if widest > 0.0 { widest } else { WIDEST * rate };
    widest.clamp(narrowest * rate, WIDEST * rate)
}

/// Mean power at each frequency, from 0 to half the rate, of windows of the samples' rate (which has no
/// trend that would leak); `None` of too few.
fn spectrum(parts: &[&[f64]]) -> Option<Vec<f64>> {
    let longest = parts.iter().map(|p| p.len()).max()?;
    let window = WINDOW.min(longest);
    if window < 32 {
        return None;
    }
    let starts: Vec<&[f64]> =
        parts.iter().flat_map(|p| p.windows(window).step_by(window / 2)).collect();
    let every = starts.len().div_ceil(MOST);
    let turn = |k: usize| (2.0 * PI * k as f64 / window as f64).sin_cos();
    let turns: Vec<(f64, f64)> = (0..window).map(turn).collect();
    let mut power = vec![0.0; window / 2];
    for samples in starts.iter().step_by(every) {
        let mean = samples.iter().sum::<f64>() / window as f64;
        let slope = (samples[window - 1] - samples[0]) / (window - 1) as f64;
        let shaped: Vec<f64> = samples
            .iter()
            .enumerate()
            .map(|(k, x)| {
                // Blackman's window: side lobes 58 dB down, and falling.
                let weight = 0.42 - 0.5 * turns[k].1 + 0.08 * turns[2 * k % window].1;
                weight * (x - mean - slope * (k as f64 - 0.5 * (window - 1) as f64))
            })
            .collect();
        for (bin, sum) in power.iter_mut().enumerate() {
            let (mut re, mut im) = (0.0, 0.0);
            for (k, x) in shaped.iter().enumerate() {
                let (sin, cos) = turns[bin * k % window];
                (re, im) = (re + x * cos, im + x * sin);
            }
            *sum += re * re + im * im;
        }
    }
    Some(power)
}

/// The part of the sampling rate up to which a spectrum stands clear of its floor.
fn edge(power: &[f64]) -> Option<f64> {
    let floor = middle(power[power.len() / 2..].iter().copied())?;
    let last = power.iter().rposition(|p| *p > CLEAR * floor)?;
    Some((last + 1) as f64 / (2.0 * power.len() as f64))
}
