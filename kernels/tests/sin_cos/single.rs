//! Single precision against the standard library's double precision.

use stiffarm_kernels::Scalar;

/// How far the pair of an angle is from the true one.
fn error(x: f32) -> f64 {
    let (s, c) = sin_cos(x);
    let (sine, cosine) = f64::from(x).sin_cos();
    (f64::from(s) - sine).abs().max((f64::from(c) - cosine).abs())
}

/// Every `stride`-th number of one sign up to 2π, from number `first` on.
fn sweep(sign: f32, first: u32, stride: usize) {
    let last = core::f32::consts::TAU.to_bits();
    for bits in (first..=last).step_by(stride) {
        let x = sign * f32::from_bits(bits);
        let error = error(x);
        assert!(error <= 1e-7, "{error:e} at {x}");
    }
}

#[test]
fn a_thousandth_of_the_numbers_in_one_turn_is_right_to_1e_7() {
    sweep(1.0, 0, 997);
    sweep(-1.0, 498, 997);
}

/// `cargo test -p stiffarm-kernels --release --test sin_cos -- --ignored`: half a minute.
#[test]
#[ignore = "2.2e9 numbers take half a minute with optimisation"]
fn every_number_in_one_turn_is_right_to_1e_7() {
    std::thread::scope(|scope| {
        scope.spawn(|| sweep(1.0, 0, 1));
        scope.spawn(|| sweep(-1.0, 0, 1));
    });
}

#[test]
fn a_hundred_radians_are_right_to_1e_7() {
    let steps = 3_000_000;
    for k in 0..=steps {
        let x = (100.0 * (2.0 * f64::from(k) / f64::from(steps) - 1.0)) as f32;
        let error = error(x);
        assert!(error <= 1e-7, "{error:e} at {x}");
    }
}

#[test]
fn zero_is_exact_and_tiny_angles_are_their_sines() {
    assert_eq!(sin_cos(0.0), (0.0, 1.0));
    assert_eq!(sin_cos(-0.0), (0.0, 1.0));
    for exponent in -149..-13 {
        let x = 2f64.powi(exponent) as f32;
        assert_eq!(sin_cos(x), (x, 1.0), "2^{exponent}");
    }
}

of_every_precision!(f32, 0, 1, 4, 5, 6, 8, 11);

#[cfg(not(feature = "libm"))]
#[test]
fn far_out_the_error_is_the_angles_spacing_and_then_there_is_no_answer() {
    for k in 0..100_000 {
        let x = 100.0 + 0.998 * k as f32;
        let spacing = f64::from(f32::from_bits(x.to_bits() + 1) - x);
        assert!(error(x) <= 1e-7 + spacing, "{x}");
    }
    for x in [1.001e5, -1e8, 1e30, f32::MAX] {
        let (s, c) = sin_cos(x);
        assert!(s.is_nan() && c.is_nan(), "{x}: {s} {c}");
    }
}
