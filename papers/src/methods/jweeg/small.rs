//! What small turns make of sines and cosines, without cancellation.

/// `1 − cos φ`, as `2 sin²(φ/2)`.
pub(crate) fn versine(angle: f64) -> f64 {
    2.0 * (angle / 2.0).sin().powi(2)
}

/// `φ − sin φ`, by its series where it would cancel: of the terms left out below 0.5 the first is
/// φ¹⁷/17!, less than 1e-18 of the whole.
pub(crate) fn lag(angle: f64) -> f64 {
    if angle.abs() >= 0.5 {
        return angle - angle.sin();
    }
    let square = angle * angle;
    let mut sum = 0.0;
    for k in [14.0, 12.0, 10.0, 8.0, 6.0, 4.0] {
        sum = square / (k * (k + 1.0)) * (1.0 - sum);
    }
    angle * square / 6.0 * (1.0 - sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lag_and_versine_keep_all_digits() {
        for angle in [1e-8_f64, 1e-3, 0.1, 0.3, 0.4999, -0.2] {
            // The series written out, from the small end.
            let mut term = angle.powi(3) / 6.0;
            let mut terms = vec![term];
            for k in 2..20 {
                let k = f64::from(2 * k);
                term *= -angle * angle / (k * (k + 1.0));
                terms.push(term);
            }
            let series: f64 = terms.iter().rev().sum();
            assert!((lag(angle) / series - 1.0).abs() < 1e-15, "{angle}");
        }
        assert!((lag(0.4999999) - lag(0.5000001) + 2e-7 * versine(0.5)).abs() < 1e-16);
        assert!((versine(1e-9) / 5e-19 - 1.0).abs() < 1e-15);
    }
}
