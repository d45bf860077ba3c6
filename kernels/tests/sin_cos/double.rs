//! Double precision against a table of values to 106 bits, and against the standard library.

use stiffarm_kernels::Scalar;

/// Spacing of the doubles around `x`.
fn ulp(x: f64) -> f64 {
    let x = x.abs().max(f64::MIN_POSITIVE);
    f64::from_bits(x.to_bits() + 1) - x
}

/// One line of the table: angle, sine and what it lacks, cosine and what it lacks.
fn row(line: &str) -> [f64; 5] {
    let mut cells = line.split(',').map(|cell| {
        f64::from_bits(u64::from_str_radix(cell, 16).expect("sixteen hexadecimal digits"))
    });
    core::array::from_fn(|_| cells.next().expect("five cells"))
}

#[test]
fn the_table_is_met_to_one_and_a_half_ulp_or_far_out_to_the_angles_spacing() {
    let lines = include_str!("double.csv").lines().filter(|line| !line.starts_with('#'));
    let rows: Vec<[f64; 5]> = lines.map(row).collect();
    assert!(rows.len() > 700);
    assert!(rows.iter().filter(|row| row[0].abs() <= 4e5).count() > 660);
    for [x, s, s_rest, c, c_rest] in rows {
        let (sine, cosine) = sin_cos(x);
        for (got, high, low) in [(sine, s, s_rest), (cosine, c, c_rest)] {
            // `got - high` is exact where it is a few ulp at most.
            let error = ((got - high) - low).abs();
            if x.abs() <= 4e5 {
                assert!(error <= 1.5 * ulp(high), "{} ulp at {x}", error / ulp(high));
            } else {
                assert!(error <= ulp(x), "{error} at {x}");
            }
        }
    }
}

#[test]
fn the_standard_library_agrees() {
    // glibc's own sine is within 0.56 ulp, so that one and a half become two.
    for (range, steps) in [(8.0, 400_001), (1e4, 400_001), (4e5, 200_001)] {
        for k in 0..=steps {
            let x = range * (2.0 * f64::from(k) / f64::from(steps) - 1.0);
            let (s, c) = sin_cos(x);
            assert!((s - x.sin()).abs() <= 2.0 * ulp(x.sin()), "sin {x}");
            assert!((c - x.cos()).abs() <= 2.0 * ulp(x.cos()), "cos {x}");
        }
    }
}

#[test]
fn zero_is_exact_and_the_functions_are_odd_and_even() {
    assert_eq!(sin_cos(0.0), (0.0, 1.0));
    assert_eq!(sin_cos(-0.0), (0.0, 1.0));
    for k in 1..10_000 {
        let x = 1e-3 * f64::from(k * k);
        let ((s, c), (minus, same)) = (sin_cos(x), sin_cos(-x));
        assert_eq!((-s, c), (minus, same), "{x}");
    }
    for exponent in -1074..-30 {
        let x = 2f64.powi(exponent);
        assert_eq!(sin_cos(x), (x, 1.0), "2^{exponent}");
    }
}

of_every_precision!(f64, 0, 1, 2, 3, 4, 5, 6, 7, 9, 40);

#[cfg(not(feature = "libm"))]
#[test]
fn far_out_the_error_is_the_angles_spacing_and_then_there_is_no_answer() {
    for k in 0..100_000 {
        let x = 4e5 + 9980.3 * f64::from(k);
        let (s, c) = sin_cos(x);
        assert!((s - x.sin()).abs() <= ulp(x) && (c - x.cos()).abs() <= ulp(x), "{x}");
    }
    assert!(sin_cos(1e9).0.is_finite());
    for x in [1.000001e9, -1e15, 1e16, 1e300, f64::MAX] {
        let (s, c) = sin_cos(x);
        assert!(s.is_nan() && c.is_nan(), "{x}: {s} {c}");
    }
}
