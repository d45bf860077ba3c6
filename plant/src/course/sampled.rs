//! A smooth motion through the commands of a file: a natural cubic spline.

use super::{Course, State};

/// Knots are no closer than this, s; what lies between is averaged. Commands are made for servos that
/// do not follow faster, and what was measured is freed of its noise.
const CLOSEST: f64 = 0.02;

/// A spline of each joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled {
    /// Increasing, s, from 0.
    times: Vec<f64>,
    joints: Vec<Spline>,
}

/// Values and second derivatives at the knots.
#[derive(Clone, Debug, PartialEq)]
struct Spline {
    values: Vec<f64>,
    bends: Vec<f64>,
}

impl Sampled {
    /// Of times that increase, s, and each joint's values; `None` of fewer than three knots.
    pub fn of(times: &[f64], joints: &[Vec<f64>]) -> Option<Sampled> {
        let first = *times.first()?;
        let mut groups: Vec<Vec<usize>> = Vec::new();
        let mut begun = f64::NEG_INFINITY;
        for (k, time) in times.iter().enumerate() {
            // A hair of rounding is no reason to take two samples together.
            if time - begun >= CLOSEST * (1.0 - 1e-9) {
                begun = *time;
                groups.push(Vec::new());
            }
            groups.last_mut()?.push(k);
        }
        if groups.len() < 3 {
            return None;
        }
        let mean = |of: &dyn Fn(usize) -> f64| -> Vec<f64> {
            groups.iter().map(|g| g.iter().map(|k| of(*k)).sum::<f64>() / g.len() as f64).collect()
        };
        let knots = mean(&|k| times[k] - first);
        let joints = joints.iter().map(|values| Spline::of(&knots, mean(&|k| values[k])));
        Some(Sampled { joints: joints.collect(), times: knots })
    }
}

impl Spline {
    /// `h₋ m₋ + 2 (h₋ + h₊) m + h₊ m₊ = 6 (slope₊ − slope₋)`, none at the ends, by elimination.
    fn of(times: &[f64], values: Vec<f64>) -> Spline {
        let n = values.len();
        let step = |k: usize| times[k + 1] - times[k];
        let slope = |k: usize| (values[k + 1] - values[k]) / step(k);
        let (mut above, mut right) = (vec![0.0; n], vec![0.0; n]);
        for k in 1..n - 1 {
            let pivot = 2.0 * (step(k - 1) + step(k)) - step(k - 1) * above[k - 1];
            above[k] = step(k) / pivot;
            right[k] = (6.0 * (slope(k) - slope(k - 1)) - step(k - 1) * right[k - 1]) / pivot;
        }
        let mut bends = vec![0.0; n];
        for k in (1..n - 1).rev() {
            bends[k] = right[k] - above[k] * bends[k + 1];
        }
        Spline { values, bends }
    }

    /// Value, rate and acceleration between knots `k` and `k + 1`.
    fn at(&self, times: &[f64], k: usize, time: f64) -> [f64; 3] {
        let step = times[k + 1] - times[k];
        let b = (time - times[k]) / step;
        let a = 1.0 - b;
        let [y0, y1] = [self.values[k], self.values[k + 1]];
        let [m0, m1] = [self.bends[k], self.bends[k + 1]];
        let cubic = |x: f64| x * x * x - x;
        let bend = |x: f64| 3.0 * x * x - 1.0;
        [
            a * y0 + b * y1 + (cubic(a) * m0 + cubic(b) * m1) * step * step / 6.0,
            (y1 - y0) / step + (bend(b) * m1 - bend(a) * m0) * step / 6.0,
            a * m0 + b * m1,
        ]
    }
}

impl Course for Sampled {
    fn duration(&self) -> f64 {
        self.times[self.times.len() - 1]
    }

    fn at(&self, time: f64) -> State {
        let time = time.clamp(self.times[0], self.duration());
        let behind = self.times.partition_point(|knot| *knot <= time);
        let k = behind.clamp(1, self.times.len() - 1) - 1;
        self.joints.iter().map(|joint| joint.at(&self.times, k, time)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The error of a natural spline falls with the fourth power of its step away from the ends, and
    /// that of its second derivative with the square.
    #[test]
    fn a_smooth_motion_is_followed_with_its_rates() {
        let times: Vec<f64> = (0..200).map(|k| 0.05 * f64::from(k)).collect();
        let of = |t: f64| (1.3 * t).sin();
        let motion = Sampled::of(&times, &[times.iter().map(|t| of(*t)).collect()]).unwrap();
        for time in [2.013, 4.5, 7.777] {
            let state = motion.at(time);
            assert!((state.q[0] - of(time)).abs() < 0.05_f64.powi(4), "{time}");
            assert!((state.qd[0] - 1.3 * (1.3 * time).cos()).abs() < 0.05_f64.powi(3), "{time}");
            assert!((state.qdd[0] + 1.69 * of(time)).abs() < 0.05_f64.powi(2), "{time}");
        }
        assert!((motion.duration() - 9.95).abs() < 1e-12);
    }

    #[test]
    fn a_straight_line_is_one_and_close_samples_are_averaged() {
        let times: Vec<f64> = (0..1000).map(|k| 0.001 * f64::from(k)).collect();
        let values = times.iter().enumerate().map(|(k, t)| 2.0 * t + [1e-3, -1e-3][k % 2]);
        let motion = Sampled::of(&times, &[values.collect()]).unwrap();
        for time in [0.1, 0.42, 0.9] {
            let state = motion.at(time);
            // The first knot is the mean of the first twenty samples, 9.5 ms behind the first.
            assert!((state.q[0] - 2.0 * time).abs() < 1e-12 && (state.qd[0] - 2.0).abs() < 1e-9);
        }
        assert_eq!(Sampled::of(&[0.0, 1.0], &[vec![0.0, 1.0]]), None);
    }
}
