//! Sines and cosines of the scalars against more precise ones.

/// What holds in every precision, with arrays of the lengths `$length`.
macro_rules! of_every_precision {
    ($scalar:ident, $($length:literal),*) => {
        fn sin_cos(x: $scalar) -> ($scalar, $scalar) {
            let ([s], [c]) = $scalar::sin_cos_all([x]);
            (s, c)
        }

        #[test]
        fn an_array_is_its_angles_one_by_one() {
            fn check<const M: usize>() {
                let angles: [$scalar; M] =
                    core::array::from_fn(|k| 0.7 * k as $scalar * k as $scalar - 3.0);
                let (sines, cosines) = $scalar::sin_cos_all(angles);
                for ((x, s), c) in angles.into_iter().zip(sines).zip(cosines) {
                    assert_eq!(sin_cos(x), (s, c));
                }
            }
            $(check::<$length>();)*
        }

        #[test]
        fn what_is_no_number_gives_none() {
            for x in [$scalar::NAN, $scalar::INFINITY, $scalar::NEG_INFINITY, -$scalar::NAN] {
                let (s, c) = sin_cos(x);
                assert!(s.is_nan() && c.is_nan(), "{x}: {s} {c}");
            }
        }
    };
}

mod double;
mod single;
