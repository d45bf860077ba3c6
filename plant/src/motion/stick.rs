//! Dry friction over a step: what brakes joints that slide, holds those that stand, and lets go.
//!
//! Where what drives it does not change, one that slides slows down evenly until it stands; behind that
//! friction holds it, or, if that is not enough, it goes the other way. So the mean friction of a step is
//! known exactly, however stiff the dry law is (an event within each step of a time-stepping method:
//! Moreau 1988; Acary & Brogliato 2008, ch. 10). Joints feel each other's friction through the links: one
//! after the other is asked until none changes (Gauss and Seidel, which converges as inertias are
//! positive).

use nalgebra::{DMatrix, DVector};

/// A brake that changes by less than this part of its range has settled.
const SETTLED: f64 = 1e-10;

/// Times that all are asked; a few are usual, some tens where several stand.
const SWEEPS: usize = 10_000;

/// Something that slides.
pub(super) struct Slider {
    /// What a unit of each joint's rate adds to its own.
    pub(super) along: DVector<f64>,
    /// Its friction where it slides backwards, and forwards: not above, and not below zero.
    pub(super) dry: [f64; 2],
}

/// Accelerations under dry friction, mean over a step, of joints that have these rates and would
/// accelerate by `free` without it; `None` if what brakes them does not settle.
pub(super) fn braked(
    sliders: &[Slider],
    inverse: &DMatrix<f64>,
    rates: &DVector<f64>,
    free: DVector<f64>,
    step: f64,
) -> Option<DVector<f64>> {
    let sliders = sliders.iter().filter(|slider| slider.dry[0] < slider.dry[1]);
    let felt = sliders.map(|slider| (slider, inverse * &slider.along));
    let felt: Vec<(&Slider, DVector<f64>)> = felt.collect();
    let mut brakes = vec![0.0; felt.len()];
    let mut accelerations = free;
    for _ in 0..SWEEPS {
        let mut most = 0.0_f64;
        for ((slider, felt), brake) in felt.iter().zip(&mut brakes) {
            let inertia = 1.0 / slider.along.dot(felt);
            let drive = inertia * slider.along.dot(&accelerations) + *brake;
            let by = slider.mean(slider.along.dot(rates), drive, inertia, step) - *brake;
            accelerations.axpy(-by, felt, 1.0);
            *brake += by;
            most = most.max(by.abs() / (slider.dry[1] - slider.dry[0]));
        }
        if most < SETTLED {
            return Some(accelerations);
        }
    }
    None
}

impl Slider {
    /// Friction of what moves that way, or does not move.
    pub(super) fn against(&self, way: f64) -> f64 {
        let [backwards, forwards] = self.dry;
        let towards = [(way > 0.0, forwards), (way < 0.0, backwards)];
        towards.into_iter().find(|(is, _)| *is).map_or(0.0, |(_, dry)| dry)
    }

    /// Friction, mean over a step, of what slides at `rate` and is driven evenly.
    fn mean(&self, rate: f64, drive: f64, inertia: f64, step: f64) -> f64 {
        let [backwards, forwards] = self.dry;
        // What holds it where it stands, or cannot.
        let held = drive.clamp(backwards, forwards);
        let sliding = self.against(rate);
        // By what of its rate a step takes.
        let taken = rate.signum() * (sliding - drive) * step / inertia;
        if rate == 0.0 || taken <= 0.0 {
            return if rate == 0.0 { held } else { sliding };
        }
        let until = (rate.abs() / taken).min(1.0);
        until * sliding + (1.0 - until) * held
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(dry: f64) -> Vec<Slider> {
        vec![Slider { along: DVector::from_element(1, 1.0), dry: [-dry, dry] }]
    }

    /// Of a mass under friction, driven by a torque of the time: rate and place at the end.
    fn slid(
        mass: f64,
        dry: f64,
        rate: f64,
        drive: impl Fn(f64) -> f64,
        step: f64,
        end: f64,
    ) -> [f64; 2] {
        let inverse = DMatrix::from_element(1, 1, 1.0 / mass);
        let (mut rate, mut place) = (DVector::from_element(1, rate), 0.0);
        for k in 0..(end / step).round() as usize {
            let free = DVector::from_element(1, drive((k as f64 + 0.5) * step) / mass);
            let before = rate[0];
            rate += step * braked(&one(dry), &inverse, &rate, free, step).unwrap();
            place += 0.5 * step * (before + rate[0]);
        }
        [rate[0], place]
    }

    /// It stands after `m v / C`, stays while it is pushed by less than C, and is let go by more: whatever
    /// the step, to rounding.
    #[test]
    fn what_is_thrown_stands_and_is_held_until_it_is_pushed() {
        let (mass, dry) = (2.0, 3.0);
        let push = |t: f64| if t < 2.0 { 2.9 } else { 5.0 };
        for step in [0.5, 0.25, 0.01] {
            assert_eq!(slid(mass, dry, 0.0, push, step, 2.0), [0.0, 0.0]);
            let [rate, place] = slid(mass, dry, 0.0, push, step, 4.0);
            // (5 − 3)/2 over two seconds.
            assert!(
                (rate - 2.0).abs() < 1e-12 && (place - 2.0).abs() < 0.5 * step,
                "{rate} {place}"
            );
            let [rate, _] = slid(mass, dry, 1.0, |_| 0.0, step, 1.0);
            assert!(rate.abs() < 1e-12, "{rate}");
            // Turned round by more than friction: −10 slows it by 6.5, then takes it back by 3.5 each second.
            let [rate, _] = slid(mass, dry, 1.3, |_| -10.0, step, 1.0);
            assert!((rate + 3.5 * 0.8).abs() < 1e-12, "{rate}");
        }
    }

    /// Two that feel each other, one shared brake: what the energy loses in a step is the work of the
    /// brakes, as none stands or turns round within it; and standing takes no energy.
    #[test]
    fn brakes_take_what_the_energy_loses() {
        let masses = DMatrix::from_row_slice(2, 2, &[3.0, 1.2, 1.2, 0.8]);
        let inverse = masses.clone().try_inverse().unwrap();
        let slider = |along: [f64; 2], dry| Slider { along: DVector::from_row_slice(&along), dry };
        let sliders = [
            slider([1.0, 0.0], [-1.0, 1.5]),
            slider([0.0, 1.0], [-0.4, 0.4]),
            slider([1.0, -1.0], [-0.7, 0.7]),
        ];
        let mut rates = DVector::from_row_slice(&[1.0, -2.0]);
        let energy = |v: &DVector<f64>| 0.5 * v.dot(&(&masses * v));
        let (mut exact, mut stood) = (0, false);
        for _ in 0..400 {
            let still = DVector::zeros(2);
            let a = braked(&sliders, &inverse, &rates, still, 0.01).unwrap();
            let after = &rates + 0.01 * &a;
            let mean = 0.5 * (&rates + &after);
            let rate = |s: &Slider, v: &DVector<f64>| s.along.dot(v);
            let work: f64 = sliders
                .iter()
                .map(|s| {
                    let v = rate(s, &mean);
                    0.01 * if v > 0.0 { s.dry[1] * v } else { s.dry[0] * v }
                })
                .sum();
            let lost = energy(&rates) - energy(&after);
            assert!(lost >= -1e-15, "{lost}");
            if sliders.iter().all(|s| rate(s, &rates) * rate(s, &after) > 1e-9) {
                exact += 1;
                assert!((lost - work).abs() < 1e-12, "{lost} {work}");
            }
            stood = after.amax() < 1e-9;
            rates = after;
        }
        assert!(exact > 20 && stood, "{exact} {rates}");
    }
}
