//! Arms of one model beside each other: what is usual of a number, which arm stands out, and what the others
//! say of an arm whose own campaign is small.
//!
//! The true numbers θ_k of arms are taken as drawn of N(μ, τ²), their estimates as drawn of N(θ_k, s_k²). τ² is
//! that of Paule & Mandel (1982), with which Σ (θ̂_k − μ)² / (s_k² + τ²) is what it should be, the number of arms
//! less one; an arm's number then is drawn towards μ by s² / (s² + τ²) (Morris 1983).

use serde::Serialize;
use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::constants::FEWEST_OF_A_KIND;

/// Arms below which nothing is said of the others.
pub const FEWEST: usize = FEWEST_OF_A_KIND;

/// A number of an arm, and its standard error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// In the number's unit.
    pub value: f64,
    /// The same.
    pub error: f64,
}

/// What is usual of a number among arms.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Pool {
    /// Number of arms.
    pub arms: usize,
    /// μ.
    pub mean: f64,
    /// Its standard error.
    pub mean_error: f64,
    /// τ: how far arms differ beyond what their campaigns can tell.
    pub spread: f64,
}

/// What the others' numbers gain, on arms that they have not seen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Gain {
    /// Number of arms.
    pub arms: usize,
    /// Root mean square of a campaign's number less that of another campaign of the same arm.
    pub alone: f64,
    /// The same of the number drawn towards the other arms'.
    pub pooled: f64,
    /// 95 % interval of the mean square that is gained.
    pub gain_ci95: [f64; 2],
}

impl Estimate {
    /// Of a value and its 95 % interval; `None` of an interval without width.
    pub fn of(value: f64, [low, high]: [f64; 2]) -> Option<Estimate> {
        let error = 0.5 * (high - low) / 1.96;
        (value.is_finite() && error.is_finite() && error > 0.0).then_some(Estimate { value, error })
    }

    fn variance(&self) -> f64 {
        self.error * self.error
    }
}

impl Pool {
    /// Of an estimate for each arm; `None` of fewer than [`FEWEST`].
    pub fn of(arms: &[Estimate]) -> Option<Pool> {
        if arms.len() < FEWEST {
            return None;
        }
        let between = between(arms);
        let (mean, weight) = mean(arms, between);
        Some(Pool {
            arms: arms.len(),
            mean,
            mean_error: weight.recip().sqrt(),
            spread: between.sqrt(),
        })
    }

    /// An arm's number, drawn towards the others'; the arm is none of the pool.
    pub fn drawn(&self, own: Estimate) -> Estimate {
        let variance = own.variance();
        let towards = variance / (variance + self.spread * self.spread);
        Estimate {
            value: own.value + towards * (self.mean - own.value),
            error: ((1.0 - towards) * variance + (towards * self.mean_error).powi(2)).sqrt(),
        }
    }

    /// How often an arm like those of the pool is as far from them as this one, which is none of them.
    pub fn p_value(&self, own: Estimate) -> f64 {
        let distance = own.value - self.mean;
        let usual = own.error.hypot(self.spread).hypot(self.mean_error);
        let student = StudentsT::new(0.0, 1.0, (self.arms - 1) as f64);
        student.map_or(1.0, |student| 2.0 * student.sf((distance / usual).abs()))
    }
}

/// How far it is right to look at the other arms: of each arm's first estimate, drawn towards the others' first
/// ones, what is left to its second one, which is of a campaign of its own. `None` of fewer than four arms.
pub fn gain(arms: &[[Estimate; 2]]) -> Option<Gain> {
    let squares = arms.iter().enumerate().map(|(k, [own, other])| {
        let others = arms.iter().enumerate().filter(|(j, _)| *j != k);
        let pool = Pool::of(&others.map(|(_, [first, _])| *first).collect::<Vec<_>>())?;
        let square = |value: f64| (value - other.value).powi(2);
        Some([square(own.value), square(pool.drawn(*own).value)])
    });
    let squares: Vec<[f64; 2]> = squares.collect::<Option<_>>()?;
    let count = squares.len() as f64;
    let average = |of: &dyn Fn(&[f64; 2]) -> f64| squares.iter().map(of).sum::<f64>() / count;
    let gained = average(&|[alone, pooled]| alone - pooled);
    let spread = average(&|[alone, pooled]| (alone - pooled - gained).powi(2));
    let student = StudentsT::new(0.0, 1.0, count - 1.0).ok()?;
    let half = student.inverse_cdf(0.975) * (spread / (count - 1.0)).sqrt();
    Some(Gain {
        arms: squares.len(),
        alone: average(&|square| square[0]).sqrt(),
        pooled: average(&|square| square[1]).sqrt(),
        gain_ci95: [gained - half, gained + half],
    })
}

/// The weighted mean, and the sum of the weights.
fn mean(arms: &[Estimate], between: f64) -> (f64, f64) {
    let weight = |arm: &Estimate| (arm.variance() + between).recip();
    let all: f64 = arms.iter().map(weight).sum();
    (arms.iter().map(|arm| weight(arm) * arm.value).sum::<f64>() / all, all)
}

/// τ².
fn between(arms: &[Estimate]) -> f64 {
    let excess = |between: f64| {
        let (mean, _) = mean(arms, between);
        let each = arms.iter().map(|a| (a.value - mean).powi(2) / (a.variance() + between));
        each.sum::<f64>() - (arms.len() - 1) as f64
    };
    if excess(0.0) <= 0.0 {
        return 0.0;
    }
    // It falls with τ², and is below zero where τ² is the sum of all squares.
    let (centre, _) = mean(arms, 0.0);
    let mut low = 0.0;
    let mut high: f64 = arms.iter().map(|arm| (arm.value - centre).powi(2)).sum();
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if excess(middle) > 0.0 { low = middle } else { high = middle }
    }
}

#[cfg(test)]
mod tests {

    use super::*;
    use crate::rng::{Rng, Stream};

    fn arms(values: &[f64], error: f64) -> Vec<Estimate> {
        values.iter().map(|value| Estimate { value: *value, error }).collect()
    }

    /// With errors alike τ² is the sample variance less their square, in closed form.
    #[test]
    fn alike_campaigns_have_a_closed_form() {
        let pool = Pool::of(&arms(&[1.0, 4.0, 7.0, 8.0], 1.5)).unwrap();
        assert!((pool.mean - 5.0).abs() < 1e-14);
        assert!((pool.spread.powi(2) - (10.0 - 2.25)).abs() < 1e-13, "{}", pool.spread);
        assert!((pool.mean_error - (10.0_f64 / 4.0).sqrt()).abs() < 1e-14);
        let drawn = pool.drawn(Estimate { value: 9.0, error: 1.5 });
        assert!((drawn.value - (9.0 - 4.0 * 2.25 / 10.0)).abs() < 1e-13);
        let alike = Pool::of(&arms(&[1.0, 1.1, 0.9], 5.0)).unwrap();
        assert_eq!(alike.spread, 0.0);
        assert!((alike.drawn(Estimate { value: 9.0, error: 1.0 }).value - 1.0).abs() < 1e-14);
    }

    /// The equation that defines τ², where errors differ by decades.
    #[test]
    fn the_sum_of_squares_is_what_it_should_be() {
        let errors = [1e-3, 0.2, 0.05, 2.0, 0.4];
        let values = [3.0, 2.0, 4.5, -1.0, 3.3];
        let of = |(value, error): (&f64, &f64)| Estimate { value: *value, error: *error };
        let arms: Vec<Estimate> = values.iter().zip(&errors).map(of).collect();
        let pool = Pool::of(&arms).unwrap();
        let each = arms.iter().map(|arm| {
            (arm.value - pool.mean).powi(2) / (arm.variance() + pool.spread * pool.spread)
        });
        assert!((each.sum::<f64>() - 4.0).abs() < 1e-11);
    }

    #[test]
    fn too_few_arms_say_nothing() {
        assert_eq!(Pool::of(&arms(&[1.0, 2.0], 0.1)), None);
        let two = |value| [Estimate { value, error: 0.1 }; 2];
        assert_eq!(gain(&[two(1.0), two(2.0), two(3.0)]), None);
        assert!(gain(&[two(1.0), two(2.0), two(3.0), two(4.0)]).is_some());
        assert_eq!(Estimate::of(1.0, [1.0, 1.0]), None);
    }

    /// Of 2,000 arms drawn with τ = 1 and s = 2 the mean square of what the pool leaves is
    /// s² τ² / (s² + τ²) = 0.8, a fifth of s²; the mean of 2,000 squares is known to 2/√2000 of itself,
    /// and five times that is allowed.
    #[test]
    fn what_is_gained_is_what_the_theory_says() {
        let mut rng = Rng::new(1, Stream::Starts);
        let drawn: Vec<[f64; 2]> = (0..2000)
            .map(|_| {
                let truth = 10.0 + rng.normal();
                [truth, truth + 2.0 * rng.normal()]
            })
            .collect();
        let own = |[_, value]: &[f64; 2]| Estimate { value: *value, error: 2.0 };
        let pool = Pool::of(&drawn.iter().map(own).collect::<Vec<_>>()).unwrap();
        assert!((pool.spread - 1.0).abs() < 0.25, "{}", pool.spread);
        let left = drawn.iter().map(|arm| (pool.drawn(own(arm)).value - arm[0]).powi(2));
        let left = left.sum::<f64>() / 2000.0;
        assert!((left / 0.8 - 1.0).abs() < 5.0 * (2.0_f64 / 2000.0).sqrt(), "{left}");
    }

    /// Arms that are like the others stand out at 5 % in one of twenty; one that is not, does.
    #[test]
    fn an_arm_stands_out_as_often_as_it_says() {
        let mut rng = Rng::new(2, Stream::Starts);
        let mut out = 0;
        for _ in 0..2000 {
            let mut draw = || Estimate { value: rng.normal() + 0.5 * rng.normal(), error: 0.5 };
            let pool = Pool::of(&[(); 12].map(|()| draw())).unwrap();
            out += usize::from(pool.p_value(draw()) < 0.05);
        }
        // Binomial: 100 ± 10.
        assert!((60..=140).contains(&out), "{out}");
        let pool = Pool::of(&arms(&[1.0, 1.2, 0.9, 1.1, 1.0], 0.05)).unwrap();
        assert!(pool.p_value(Estimate { value: 2.0, error: 0.05 }) < 0.002);
    }
}
