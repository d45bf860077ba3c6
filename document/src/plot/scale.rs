//! From numbers to places, and the round numbers at which an axis is marked.

/// A linear scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    domain: [f64; 2],
    range: [f64; 2],
}

impl Scale {
    /// From numbers between the ends of `domain` to places between those of `range`. A domain
    /// without width is widened, so that its one number stands in the middle.
    pub fn new(domain: [f64; 2], range: [f64; 2]) -> Scale {
        let [low, high] = domain;
        let half = if high > low { 0.0 } else { 0.5 * low.abs().max(1.0) };
        Scale { domain: [low - half, high + half], range }
    }

    /// The place of a number.
    pub fn at(&self, x: f64) -> f64 {
        let ([low, high], [from, to]) = (self.domain, self.range);
        from + (x - low) / (high - low) * (to - from)
    }
}

/// Round numbers (1, 2, 5 times a power of ten) within `[low, high]`, about `count` of them.
pub fn ticks([low, high]: [f64; 2], count: usize) -> Vec<f64> {
    let step = step((high - low) / count.max(1) as f64);
    let step = match step {
        Some(step) if high > low => step,
        _ => return vec![low],
    };
    let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
    // Multiples of the step, not sums of steps, and no minus before zero.
    (0..=(last - first) as usize).map(|k| (first + k as f64) * step + 0.0).collect()
}

/// Whole numbers of degrees that divide a turn come before round ones.
pub fn angle_ticks([low, high]: [f64; 2], count: usize) -> Vec<f64> {
    const STEPS: [f64; 9] = [1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0, 180.0];
    let wanted = (high - low) / count.max(1) as f64;
    match STEPS.into_iter().find(|step| *step >= wanted) {
        Some(step) if wanted > 0.5 => {
            let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
            (0..=(last - first).max(0.0) as usize)
                .map(|k| (first + k as f64) * step + 0.0)
                .collect()
        }
        _ => ticks([low, high], count),
    }
}

/// The round number next to `wanted` on a logarithmic scale.
fn step(wanted: f64) -> Option<f64> {
    if !(wanted.is_finite() && wanted > 0.0) {
        return None;
    }
    let power = wanted.log10().floor();
    let mantissa = wanted / 10_f64.powf(power);
    let round = match mantissa {
        m if m < 1.5 => 1.0,
        m if m < 3.5 => 2.0,
        m if m < 7.5 => 5.0,
        _ => 10.0,
    };
    // A power below one as a quotient, so that 0.1 is 1/10 and not 10^−1 rounded.
    Some(if power < 0.0 { round / 10_f64.powf(-power) } else { round * 10_f64.powf(power) })
}

/// A number as it stands beside a mark: without the noise of its last digits, with a true minus.
pub fn number(x: f64) -> String {
    let text = match x.abs() {
        0.0 => "0".to_owned(),
        size if (1e-4..1e6).contains(&size) => {
            let rounded: f64 = format!("{x:.9e}").parse().unwrap_or(x);
            format!("{rounded}")
        }
        _ => {
            let text = format!("{x:.3e}");
            let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
            let mantissa = mantissa.trim_end_matches('0').trim_end_matches('.');
            format!("{mantissa}e{exponent}")
        }
    };
    text.replacen('-', "−", usize::from(text.starts_with('-')))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within() {
        assert_eq!(ticks([0.0, 1.0], 5), [0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0]);
        assert_eq!(ticks([-245.0, 29.0], 6), [-200.0, -150.0, -100.0, -50.0, 0.0]);
        assert_eq!(
            ticks([0.0, 0.00123], 6),
            [0.0, 0.0002, 0.0004, 0.0006000000000000001, 0.0008, 0.001, 0.0012000000000000001]
        );
        assert_eq!(ticks([3.0, 3.0], 5), [3.0]);
        assert_eq!(angle_ticks([0.0, 146.0], 6), [0.0, 30.0, 60.0, 90.0, 120.0]);
        assert_eq!(
            angle_ticks([-180.0, 180.0], 8),
            [-180.0, -135.0, -90.0, -45.0, 0.0, 45.0, 90.0, 135.0, 180.0]
        );
        for (low, high) in [(1e-9, 3e-9), (-7e12, 1e11), (0.1, 0.1000001)] {
            let found = ticks([low, high], 7);
            assert!((3..=15).contains(&found.len()), "{found:?}");
            let slack = 1e-8 * (high - low);
            assert!(found.iter().all(|t| (low - slack..=high + slack).contains(t)));
        }
    }

    #[test]
    fn numbers_are_short() {
        for (x, text) in [
            (0.6000000000000001, "0.6"),
            (-50.0, "−50"),
            (1.2e-9, "1.2e-9"),
            (0.0, "0"),
            (2e7, "2e7"),
            (-0.00025, "−0.00025"),
        ] {
            assert_eq!(number(x), text);
        }
    }

    #[test]
    fn scales_are_linear() {
        let scale = Scale::new([-1.0, 3.0], [100.0, 0.0]);
        assert_eq!((scale.at(-1.0), scale.at(1.0), scale.at(3.0)), (100.0, 50.0, 0.0));
        assert_eq!(Scale::new([2.0, 2.0], [0.0, 10.0]).at(2.0), 5.0);
    }
}
