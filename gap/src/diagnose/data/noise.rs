//! How large the noise of the measurement is, and whether what is left of the gap is more than
//! noise.

use nalgebra::Vector6;
use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use super::problem::Problem;
use crate::constants::{EXCESS, FEWEST_OF_A_KIND};
use crate::diagnose::options::Options;
use crate::diagnose::report::NoiseReport;
use crate::gap::rms;
use crate::infer::constants::BEYOND_NOISE;
use crate::measurement::{Kind, Row};

/// A noise below this is none, m or rad.
const LEAST: f64 = 1e-30;

/// Where a noise level comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Source {
    Option,
    /// With this many degrees of freedom.
    Repeats(f64),
    /// The file's own standard deviations.
    Columns,
    Residual,
}

impl Source {
    /// As it is written.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Source::Option => "option",
            Source::Repeats(_) => "repeats",
            Source::Columns => "columns",
            Source::Residual => "residual",
        }
    }
}

/// Standard deviation of each component of one kind (translations or rotations).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Level {
    pub(crate) sd: f64,
    /// The part of it that comes and goes with visits, the arm's repeatability; where poses were both
    /// read more than once and visited again.
    pub(crate) visits: Option<f64>,
    pub(crate) source: Source,
    /// Measured components of this kind in a row, at the most.
    pub(crate) components: usize,
    /// The same on average over the rows.
    pub(crate) per_row: f64,
    /// How much larger a row's norm is, root mean square over the rows that read this kind; of a bench each
    /// instrument's as precise as it is.
    norm: f64,
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
    /// By the options, else from repeats, else by the file's own standard deviations, else from
    /// `residual` (with `parameters` fitted to it). Poses that are read more than once and never
    /// visited again tell the instrument alone, which the file's columns know better.
    pub(crate) fn of(
        problem: &Problem<'_>,
        options: &Options,
        residual: &[Vector6<f64>],
        parameters: usize,
    ) -> Noise {
        let gap = |row: usize| residual[row].component_mul(&problem.precision.of_row(row));
        let kept: Vec<usize> = (0..residual.len()).filter(|row| problem.fits[*row]).collect();
        let level = |first: usize, given: Option<f64>| {
            let components = (first..first + 3).filter(|&k| problem.mask[k] > 0.0).count();
            let own = |row: &usize| problem.data.rows[*row].components(problem.data.kind);
            let numbers: usize = (kept.iter().map(own))
                .map(|is| is[first..first + 3].iter().filter(|is| **is).count())
                .sum();
            let per_row = numbers as f64 / kept.len().max(1) as f64;
            let repeats = Repeats::of(problem, kept.clone(), &gap, first, per_row);
            let visits = repeats.as_ref().and_then(Repeats::visits);
            let norm = norm(problem, &kept, first);
            let with = |sd, source| Level { sd, visits, source, components, per_row, norm, first };
            if let Some(sd) = given {
                return with(sd, Source::Option);
            }
            let columns = problem.precision.instrument[first / 3];
            match (repeats, columns) {
                (Some(r), None) => return with(r.sd, Source::Repeats(r.freedom)),
                (Some(r), Some(_)) if r.returns => return with(r.sd, Source::Repeats(r.freedom)),
                (_, Some(sd)) => return with(sd, Source::Columns),
                (None, None) => {}
            }
            let total = problem.numbers();
            // Each kind pays for the parameters by its part of the numbers measured.
            let left = total.saturating_sub(parameters).max(1) as f64 / total.max(1) as f64;
            let held = problem.constants.len() * components;
            let freedom = left * numbers.saturating_sub(held) as f64;
            let squares: f64 = kept.iter().map(|row| square(&gap(*row), first)).sum();
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
    pub(crate) fn main(&self) -> &Level {
        if self.position.components > 0 { &self.position } else { &self.rotation }
    }

    pub(crate) fn report(&self) -> NoiseReport {
        let is_there = |l: &Level| l.components > 0;
        let rms = |l: &Level, sd: f64| sd * l.norm;
        let visits = |l: &Level| l.visits.filter(|_| is_there(l)).map(|sd| rms(l, sd));
        let from = |l: &Level| is_there(l).then(|| l.source.name().into());
        let (position, rotation) = (&self.position, &self.rotation);
        NoiseReport {
            position_rms: rms(position, position.sd),
            rotation_rms: rms(rotation, rotation.sd),
            from: self.main().source.name().into(),
            position_from: from(position),
            rotation_from: from(rotation),
            visits_position_rms: visits(position),
            visits_rotation_rms: visits(rotation),
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
    pub(crate) fn exceeded(
        &self,
        residual: impl Iterator<Item = Vector6<f64>>,
        parameters: usize,
    ) -> bool {
        let (mut rows, mut sums) = (0_u32, [0.0; 2]);
        for gap in residual {
            rows += 1;
            let parts = [&self.position, &self.rotation].map(|level| level.square(&gap));
            sums.iter_mut().zip(parts).for_each(|(sum, part)| *sum += part);
        }
        let kinds = [&self.position, &self.rotation];
        let measured: f64 = kinds.iter().map(|l| l.per_row).sum();
        let judged = kinds
            .iter()
            .filter(|l| l.components > 0 && l.sd > 0.0 && l.source != Source::Residual)
            .count();
        kinds.iter().zip(sums).any(|(level, squares)| {
            let share = level.per_row / if measured > 0.0 { measured } else { 1.0 };
            let freedom = f64::from(rows) * level.per_row - share * parameters as f64;
            let more = squares > freedom * (EXCESS * level.sd).powi(2);
            let p_value = level.p_value(squares, freedom);
            more && p_value.is_some_and(|p| p * (judged as f64) < BEYOND_NOISE)
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

    /// How often noise alone would leave as much; `None` if that cannot be said.
    fn p_value(&self, squares: f64, freedom: f64) -> Option<f64> {
        if self.components == 0 || self.sd <= 0.0 || freedom <= 0.0 {
            return None;
        }
        let ratio = squares / (self.sd * self.sd);
        match self.source {
            Source::Residual => None,
            Source::Option | Source::Columns => Some(ChiSquared::new(freedom).ok()?.sf(ratio)),
            Source::Repeats(own) => {
                Some(FisherSnedecor::new(freedom, own).ok()?.sf(ratio / freedom))
            }
        }
    }
}

/// The norm of what a row reads of a kind, in standard deviations: root mean square over the rows that read it.
fn norm(problem: &Problem<'_>, rows: &[usize], first: usize) -> f64 {
    let (data, is_bench) = (problem.data, matches!(problem.data.kind, Kind::Bench { .. }));
    let reading = rows.iter().filter(|row| data.rows[**row].reads(data.kind, first));
    let of_row = |row: &usize| {
        let (is, precision) =
            (data.rows[*row].components(data.kind), problem.precision.of_row(*row));
        let own = |k: usize| if is_bench { precision[k].powi(-2) } else { 1.0 };
        (first..first + 3).filter(|k| is[*k]).map(own).sum::<f64>().sqrt()
    };
    rms(&reading.map(of_row).collect::<Vec<_>>())
}

/// Of the three components of a kind.
fn square(gap: &Vector6<f64>, first: usize) -> f64 {
    gap.fixed_rows::<3>(first).norm_squared()
}

/// Whether a row that agrees with another says how both scatter: rows in which the joints are all that is read and
/// happen to agree vary less than the others, unless the file names them one pose.
fn can_repeat(row: &Row) -> bool {
    row.pose.is_some() || !row.reads_joints_alone()
}

/// What repeats say of one kind: rows of one pose with the same load, marker and direction of approach,
/// at one visit or at several.
struct Repeats {
    /// Of one reading.
    sd: f64,
    freedom: f64,
    /// Variance of a visit beyond that of its readings; `None` where the two are not told apart.
    visit: Option<f64>,
    /// Whether poses were visited again.
    returns: bool,
}

/// Squares about means, and the number of values beyond these.
#[derive(Default)]
struct Apart {
    squares: f64,
    beyond: usize,
}

impl Repeats {
    /// Of the gaps of some rows to a model: an analysis of variance of readings within visits, and of
    /// visits of what they repeat. `None` where that is too little.
    fn of(
        problem: &Problem<'_>,
        mut rows: Vec<usize>,
        gap: &dyn Fn(usize) -> Vector6<f64>,
        first: usize,
        per_row: f64,
    ) -> Option<Self> {
        let visits = &problem.visits;
        rows.retain(|row| can_repeat(&problem.data.rows[*row]));
        rows.sort_by_key(|row| (visits.repeats[*row], visits.of_row[*row]));
        let mean = |rows: &[usize]| {
            rows.iter().map(|row| gap(*row)).sum::<Vector6<f64>>() / rows.len() as f64
        };
        let square = |apart: Vector6<f64>| square(&apart, first);
        let (mut within, mut between) = (Apart::default(), Apart::default());
        // How often the variance of a visit is in the squares between them.
        let mut times = 0.0;
        for set in rows.chunk_by(|a, b| visits.repeats[*a] == visits.repeats[*b]) {
            let (all, whole) = (set.len() as f64, mean(set));
            times += all;
            for (number, visit) in
                set.chunk_by(|a, b| visits.of_row[*a] == visits.of_row[*b]).enumerate()
            {
                let (count, own) = (visit.len() as f64, mean(visit));
                within.squares += visit.iter().map(|row| square(gap(*row) - own)).sum::<f64>();
                within.beyond += visit.len() - 1;
                between.squares += count * square(own - whole);
                between.beyond += usize::from(number > 0);
                times -= count * count / all;
            }
        }
        let numbers = |apart: &Apart| apart.beyond as f64 * per_row;
        let (inside, outside) = (numbers(&within), numbers(&between));
        let sum = within.squares + between.squares;
        if within.beyond + between.beyond < FEWEST_OF_A_KIND
            || inside + outside <= 0.0
            || sum <= 0.0
        {
            return None;
        }
        let returns = between.beyond >= FEWEST_OF_A_KIND;
        let pooled = Self {
            sd: (sum / (inside + outside)).sqrt(),
            freedom: inside + outside,
            visit: (returns && within.beyond >= FEWEST_OF_A_KIND).then_some(0.0),
            returns,
        };
        if pooled.visit.is_none() {
            // Visits of one reading each scatter by both together.
            return Some(match returns {
                true => Self { sd: (between.squares / outside).sqrt(), freedom: outside, ..pooled },
                false => pooled,
            });
        }
        let times = times / between.beyond as f64;
        let (instrument, visits) = (within.squares / inside, between.squares / outside);
        let visit = (visits - instrument) / times;
        if visit <= 0.0 {
            return Some(pooled);
        }
        // The variance of a sum of two mean squares (Satterthwaite 1946).
        let parts = [(visits / times, outside), (instrument * (1.0 - 1.0 / times), inside)];
        let variance: f64 = parts.iter().map(|(part, _)| part).sum();
        let doubt: f64 = parts.iter().map(|(part, freedom)| part * part / freedom).sum();
        Some(Self {
            sd: variance.sqrt(),
            freedom: variance * variance / doubt,
            visit: Some(visit),
            returns,
        })
    }

    fn visits(&self) -> Option<f64> {
        self.visit.map(f64::sqrt)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::data::Precision;
    use crate::fixture::{rigid, row, table};
    use crate::measurement::{Kind, Measurements, Row};
    use crate::noisy::normal;
    use crate::rng::{Rng, Stream};

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

    /// A hundred poses, each visited three times, four readings a visit: the instrument's 20 µm and the
    /// arm's 50 µm are told from each other; of the first visits alone only the instrument's.
    #[test]
    fn the_arm_is_told_from_the_instrument() {
        let (arm, mut rng) = (rigid(), Rng::new(5, Stream::Signs));
        let (mut rows, mut gaps) = (Vec::new(), Vec::new());
        for _ in 0..3 {
            for group in 0..100 {
                let visit = Vector6::from_fn(|_, _| 5e-5 * normal(&mut rng));
                for _ in 0..4 {
                    rows.push(Row {
                        group,
                        ..row(&[0.01 * group as f64, 0.2, 0.3], Vector6::zeros())
                    });
                    let read = visit.map(|x| x + 2e-5 * normal(&mut rng));
                    gaps.push(read.component_mul(&Vector6::new(1.0, 1.0, 1.0, 0.0, 0.0, 0.0)));
                }
            }
        }
        let none = Options::default();
        let position = |rows: &[Row], gaps: &[Vector6<f64>]| {
            let data = table(rows.to_vec(), Kind::Pose { orientation: false });
            let problem = Problem::new(&arm, &data, &none).unwrap();
            Noise::of(&problem, &none, gaps, 0).position
        };
        let whole = position(&rows, &gaps);
        // 200 visits beyond their poses, of three numbers each: four standard errors of such a variance.
        let close = 4.0 * (2.0 / 600.0_f64).sqrt() / 2.0;
        assert!((whole.visits.unwrap() / 5e-5 - 1.0).abs() < close, "{whole:?}");
        assert!((whole.sd / 5e-5_f64.hypot(2e-5) - 1.0).abs() < close, "{whole:?}");
        assert!(
            matches!(whole.source, Source::Repeats(freedom) if (500.0..900.0).contains(&freedom))
        );
        let once = position(&rows[..400], &gaps[..400]);
        assert!((once.sd / 2e-5 - 1.0).abs() < close && once.visits.is_none(), "{once:?}");
    }

    #[test]
    fn the_files_own_sigma_comes_before_the_residual() {
        let (arm, mut data) = (rigid(), data());
        for (k, row) in data.rows.iter_mut().enumerate() {
            row.wrench[0] = 100.0 * k as f64;
            row.sigma = Some(Box::new(Vector6::new(3e-4, 4e-4, 5e-4, 0.0, 0.0, 0.0)));
        }
        let none = Options::default();
        let mut problem = Problem::new(&arm, &data, &none).unwrap();
        problem.precision = Precision::of(&data);
        let noise = Noise::of(&problem, &none, &gaps(&problem), 0);
        assert_eq!(noise.position.source, Source::Columns);
        let report = noise.report();
        // √(3² + 4² + 5²).
        assert!((report.position_rms - 1e-4 * 50_f64.sqrt()).abs() < 1e-12, "{report:?}");
        assert_eq!(
            (report.position_from.as_deref(), report.rotation_from),
            (Some("columns"), None)
        );
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
        assert!(!noise.exceeded([Vector6::repeat(1.0); 6].into_iter(), 0));
    }

    #[test]
    fn more_than_noise_is_noticed_and_noise_is_not() {
        let (arm, data) = (rigid(), data());
        let given = Options { noise_position: Some(1e-3), ..Options::default() };
        let problem = Problem::new(&arm, &data, &given).unwrap();
        let noise = Noise::of(&problem, &given, &gaps(&problem), 0);
        assert!(noise.is_known());
        let gap = |x| [Vector6::new(x, x, x, 0.0, 0.0, 0.0); 6].into_iter();
        assert!(!noise.exceeded(gap(1e-3), 1));
        assert!(noise.exceeded(gap(2e-3), 1));
    }
}
