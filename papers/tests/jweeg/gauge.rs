//! Displacements of a link's tip from what gauges read on it (Jweeg & Al-Khafaji, eqs. 59 and 60),

//! and how far such readings are from the truth.

/// What bends a cantilever.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EndLoad {
    /// A transverse force at the tip.
    Force,
    /// A moment at the tip.
    Moment,
}

/// `dφ = atan(Δδy/Δx)`, rad: the slope of the secant between two points of a link whose
/// deflections differ by `rise` over the distance `run`, both m (eq. 59).
///
/// Where the outer point is the tip, this reads less than the tip's slope: see
/// [`secant_under_reading`].
pub fn secant_slope(rise: f64, run: f64) -> f64 {
    (rise / run).atan()
}

/// The part of the tip's slope by which the secant between the tip and a point at the fraction `h`
/// of the length before it reads too low: `h²/3` under an end force, `h/2` under an end moment
/// (8.3 % and 25 % at half the length). For small slopes of a uniform cantilever without shear.
pub fn secant_under_reading(h: f64, load: EndLoad) -> f64 {
    match load {
        EndLoad::Force => h * h / 3.0,
        EndLoad::Moment => h / 2.0,
    }
}

/// The strain along a link's axis from gauges on its upper and lower face at one section: their
/// mean, in which bending cancels.
pub fn axial_strain(upper: f64, lower: f64) -> f64 {
    (upper + lower) / 2.0
}

/// `δx = ε L`, m: how much a link of length `length` gets longer under an axial strain that is the
/// same all along it (eq. 60).
///
/// It does not contain what bending takes from the chord, [`foreshortening`], which is as large as
/// the difference between the flexible kinematics and its approximation.
pub fn elongation(strain: f64, length: f64) -> f64 {
    strain * length
}

/// How much nearer to its root the tip of an inextensible link of length `length` comes as its tip
/// slope reaches `slope` (rad), m: `4/15 L φ²` under an end force, `L φ²/6` under an end moment, to
/// the second order.
pub fn foreshortening(length: f64, slope: f64, load: EndLoad) -> f64 {
    match load {
        EndLoad::Force => 4.0 / 15.0 * length * slope * slope,
        EndLoad::Moment => length * slope * slope / 6.0,
    }
}

/// Deflection of a cantilever of length 1 at `s`, of tip slope `slope`.
fn deflection(s: f64, slope: f64, load: EndLoad) -> f64 {
    match load {
        EndLoad::Force => slope * (s * s - s * s * s / 3.0),
        EndLoad::Moment => slope * s * s / 2.0,
    }
}

#[test]
fn the_secant_reads_low_as_stated() {
    for load in [EndLoad::Force, EndLoad::Moment] {
        for h in [0.1, 0.5, 0.9] {
            let slope = 1e-4;
            let at = |s| deflection(s, slope, load);
            let read = secant_slope(at(1.0) - at(1.0 - h), h);
            let low = 1.0 - read / slope;
            assert!((low - secant_under_reading(h, load)).abs() < 1e-8, "{load:?} {h}");
        }
    }
    assert!((secant_under_reading(0.5, EndLoad::Force) - 0.083).abs() < 4e-4);
    assert_eq!(secant_under_reading(0.5, EndLoad::Moment), 0.25);
}

/// Half the integral of the squared slope, by Simpson's rule (exact for its degree is not
/// needed).
#[test]
fn foreshortening_is_half_the_square_of_the_slope() {
    let slope = 0.02;
    for load in [EndLoad::Force, EndLoad::Moment] {
        let local = |s: f64| match load {
            EndLoad::Force => slope * (2.0 * s - s * s),
            EndLoad::Moment => slope * s,
        };
        let n = 1000;
        let weight = |k: usize| match (k, k % 2) {
            (0 | 1000, _) => 1.0,
            (_, 1) => 4.0,
            _ => 2.0,
        };
        let square = |k: usize| weight(k) * local(k as f64 / f64::from(n)).powi(2);
        let integral = (0..=1000).map(square).sum::<f64>() / (3.0 * f64::from(n));
        let found = foreshortening(1.0, slope, load);
        assert!((found / (integral / 2.0) - 1.0).abs() < 1e-10, "{load:?}");
    }
}

#[test]
fn bending_cancels_in_the_mean() {
    let (axial, bending) = (3e-6, 200e-6);
    let strain = axial_strain(axial + bending, axial - bending);
    assert!((elongation(strain, 0.4) - 1.2e-6).abs() < 1e-18);
}
