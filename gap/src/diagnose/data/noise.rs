//! How large the noise of the measurement is, and whether what is left of the gap is more than
//! noise.

use std::collections::HashMap;

use nalgebra::Vector6;
use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use super::problem::Problem;
use crate::diagnose::options::Options;
use crate::diagnose::report::NoiseReport;

/// Fewer repeats than this (rows beyond the first of each pose and load) say nothing of the noise.
const LEAST_REPEATS: usize = 3;

/// A noise below this is none, m or rad.
const LEAST: f64 = 1e-30;

/// What remains is more than noise if noise alone were to leave as much in fewer than this part of
/// cases.
const LEVEL: f64 = 0.01;

/// A standard deviation is not known better than this: what remains must exceed it by the factor.
const EXCESS: f64 = 1.05;

/// Where a noise level comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Source {
    Option,
    /// With this many degrees of freedom.
    Repeats(f64),
    Residual,
}

/// Standard deviation of each component of one kind (translations or rotations).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Level {
    pub(crate) sd: f64,
    pub(crate) source: Source,
    /// Measured components of this kind in a row.
    pub(crate) components: usize,
    /// The first of the three components of a twist.
    first: usize,
}

/// Both kinds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Noise {
    pub(crate) position: Level,
    pub(crate) rotation: Level,
}

impl Noise {
    /// By the options, else from repeats, else from `residual` (with `parameters` fitted to it).
    pub(crate) fn of(
        problem: &Problem<'_>,
        options: &Options,
        residual: &[Vector6<f64>],
        parameters: usize,
    ) -> Noise {
        let level = |first: usize, given: Option<f64>| {
            let mask = problem.mask;
            let components = (first..first + 3).filter(|&k| mask[k] > 0.0).count();
            let with = |sd, source| Level { sd, source, components, first };
            if let Some(sd) = given {
                return with(sd, Source::Option);
            }
            let residual = &problem.kept(residual);
            if let Some((sd, freedom)) = repeats(problem, residual, first, components) {
                return with(sd, Source::Repeats(freedom));
            }
            let total = problem.numbers();
            // Each kind pays for the parameters by its part of the numbers measured.
            let left = total.saturating_sub(parameters).max(1) as f64 / total.max(1) as f64;
            let freedom = left * (problem.free_rows() * components) as f64;
            let squares = squares(residual, first);
            with(if freedom > 0.0 { (squares / freedom).sqrt() } else { 0.0 }, Source::Residual)
        };
        Noise {
            position: level(0, options.noise_position),
            rotation: level(3, options.noise_rotation),
        }
    }

    /// Weights that whiten a gap: 1/sd, 0 where nothing is measured. A noise that is none weighs 1.
    pub(crate) fn weights(&self, mask: &Vector6<f64>) -> Vector6<f64> {
        let of = |level: &Level| if level.sd > LEAST { 1.0 / level.sd } else { 1.0 };
        let (p, r) = (of(&self.position), of(&self.rotation));
        Vector6::new(p, p, p, r, r, r).component_mul(mask)
    }

    /// The level of what the file measures first: positions, or rotations if it has no positions.
    fn main(&self) -> &Level {
        if self.position.components > 0 { &self.position } else { &self.rotation }
    }

    pub(crate) fn report(&self) -> NoiseReport {
        let rms = |l: &Level| if l.components == 0 { 0.0 } else { l.rms() };
        NoiseReport {
            position_rms: rms(&self.position),
            rotation_rms: rms(&self.rotation),
            from: match self.main().source {
                Source::Option => "option",
                Source::Repeats(_) => "repeats",
                Source::Residual => "residual",
            },
        }
    }

    /// The levels of what is measured.
    pub(crate) fn kinds(&self) -> impl Iterator<Item = &Level> {
        [&self.position, &self.rotation].into_iter().filter(|level| level.components > 0)
    }

    /// Whether the noise is known apart from what is left.
    pub(crate) fn is_known(&self) -> bool {
        self.kinds().all(Level::is_known)
    }

    /// Whether `residual`, with `parameters` fitted to it, is more than this noise: surely, and by
    /// more than noise is ever known. A noise taken from the residual itself cannot tell.
    pub(crate) fn exceeded(&self, residual: &[Vector6<f64>], parameters: usize) -> bool {
        let kinds = [&self.position, &self.rotation];
        let measured: usize = kinds.iter().map(|l| l.components).sum();
        let judged = kinds
            .iter()
            .filter(|l| l.components > 0 && l.sd > 0.0 && l.source != Source::Residual)
            .count();
        kinds.iter().any(|level| {
            let share = level.components as f64 / measured.max(1) as f64;
            let freedom = (residual.len() * level.components) as f64 - share * parameters as f64;
            let squares = squares(residual, level.first);
            let more = squares > freedom * (EXCESS * level.sd).powi(2);
            let chance = level.chance(squares, freedom);
            more && chance.is_some_and(|p| p * (judged as f64) < LEVEL)
        })
    }
}

impl Level {
    /// Whether it is known apart from what is left.
    pub(crate) fn is_known(&self) -> bool {
        self.source != Source::Residual
    }

    /// The squared norm of this kind's part of a gap.
    pub(crate) fn square(&self, gap: &Vector6<f64>) -> f64 {
        gap.fixed_rows::<3>(self.first).norm_squared()
    }

    /// Root mean square of the norm over the measured components.
    pub(crate) fn rms(&self) -> f64 {
        self.sd * (self.components as f64).sqrt()
    }

    /// How often noise alone would leave as much; `None` if that cannot be said.
    fn chance(&self, squares: f64, freedom: f64) -> Option<f64> {
        if self.components == 0 || self.sd <= 0.0 || freedom <= 0.0 {
            return None;
        }
        let ratio = squares / (self.sd * self.sd);
        match self.source {
            Source::Residual => None,
            Source::Option => Some(ChiSquared::new(freedom).ok()?.sf(ratio)),
            Source::Repeats(own) => {
                Some(FisherSnedecor::new(freedom, own).ok()?.sf(ratio / freedom))
            }
        }
    }
}

fn squares(gaps: &[Vector6<f64>], first: usize) -> f64 {
    gaps.iter().map(|g| g.fixed_rows::<3>(first).norm_squared()).sum()
}

/// Standard deviation about the mean of repeats, and its degrees of freedom. Repeats are rows of
/// one pose with the same load, marker and direction of approach.
fn repeats(
    problem: &Problem<'_>,
    residual: &[Vector6<f64>],
    first: usize,
    components: usize,
) -> Option<(f64, f64)> {
    let mut sets: HashMap<_, usize> = HashMap::new();
    let mut members: Vec<Vec<Vector6<f64>>> = Vec::new();
    for (row, gap) in problem.kept_rows().zip(residual) {
        let load: Vec<u64> = row.wrench.iter().map(|f| (f + 0.0).to_bits()).collect();
        let key = (row.group, load, row.marker.as_deref(), row.direction.as_deref());
        let set = *sets.entry(key).or_insert(members.len());
        if set == members.len() {
            members.push(Vec::new());
        }
        members[set].push(*gap);
    }
    let mut sum = 0.0;
    for set in &members {
        let mean = set.iter().sum::<Vector6<f64>>() / set.len() as f64;
        let apart: Vec<_> = set.iter().map(|g| g - mean).collect();
        sum += squares(&apart, first);
    }
    let beyond = residual.len() - members.len();
    let freedom = (beyond * components) as f64;
    (beyond >= LEAST_REPEATS && freedom > 0.0 && sum > 0.0)
        .then(|| ((sum / freedom).sqrt(), freedom))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{rigid, row, table};
    use crate::measurement::{Kind, Measurements};

    /// Two poses of three repeats each, ±1 mm about what the arm says.
    fn data() -> Measurements {
        let rows = (0..6)
            .map(|k: usize| {
                let q = if k < 3 { [0.1, 0.2, 0.3] } else { [0.5, 0.2, 0.3] };
                let mut row = row(&q, Vector6::zeros());
                row.group = k / 3;
                let p = rigid().pose(&q).translation.vector;
                let shift = 1e-3 * (k % 3) as f64;
                row.measured = Vector6::new(p.x + shift, p.y, p.z, 0.0, 0.0, 0.0);
                row
            })
            .collect();
        table(rows, Kind::Pose { orientation: false })
    }

    fn gaps(problem: &Problem<'_>) -> Vec<Vector6<f64>> {
        crate::diagnose::fit::Model::nominal(problem).predict(problem, None).unwrap().gaps
    }

    #[test]
    fn repeats_give_the_noise() {
        let (arm, data) = (rigid(), data());
        let none = Options::default();
        let problem = Problem::new(&arm, &data, &none).unwrap();
        let noise = Noise::of(&problem, &none, &gaps(&problem), 0);
        assert_eq!(noise.position.source, Source::Repeats(12.0));
        // Each set spreads by −1, 0, 1 mm in x: 4 mm² over 12.
        assert!((noise.position.sd - 1e-3 * (4.0_f64 / 12.0).sqrt()).abs() < 1e-12);
        assert!((noise.report().position_rms - 1e-3).abs() < 1e-12);
        assert_eq!(noise.report().from, "repeats");
        assert_eq!(noise.report().rotation_rms, 0.0);
    }

    #[test]
    fn the_option_comes_first_and_the_residual_last() {
        let (arm, mut data) = (rigid(), data());
        let given = Options { noise_position: Some(2e-3), ..Options::default() };
        let problem = Problem::new(&arm, &data, &given).unwrap();
        let noise = Noise::of(&problem, &given, &gaps(&problem), 0);
        assert_eq!((noise.position.sd, noise.position.source), (2e-3, Source::Option));
        for (k, row) in data.rows.iter_mut().enumerate() {
            row.wrench[0] = k as f64;
        }
        let problem = Problem::new(&arm, &data, &given).unwrap();
        let noise = Noise::of(&problem, &Options::default(), &gaps(&problem), 1);
        assert!(!noise.is_known());
        assert_eq!(noise.position.source, Source::Residual);
        assert!(!noise.exceeded(&vec![Vector6::repeat(1.0); 6], 0));
    }

    #[test]
    fn more_than_noise_is_noticed_and_noise_is_not() {
        let (arm, data) = (rigid(), data());
        let given = Options { noise_position: Some(1e-3), ..Options::default() };
        let problem = Problem::new(&arm, &data, &given).unwrap();
        let noise = Noise::of(&problem, &given, &gaps(&problem), 0);
        assert!(noise.is_known());
        let gap = |x| vec![Vector6::new(x, x, x, 0.0, 0.0, 0.0); 6];
        assert!(!noise.exceeded(&gap(1e-3), 1));
        assert!(noise.exceeded(&gap(2e-3), 1));
    }
}
