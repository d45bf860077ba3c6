//! What a bench reads, or single coordinates: what is left of it without some mistakes, by the diagnosis's own fit of
//! frames and bench.
//!
//! No closed form puts these frames where they fit best. A fit takes a hundred times as long, so that pairs are looked
//! for one after the other, and of what is off by any amount the zeros alone.

use core::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Vector3, Vector6};
use stiffarm_kernels::generic::Arm;

use super::fit::{Left, best};
use super::kind::{Entry, Mistake};
use super::search::Search;
use crate::constants::{FLAT_ARM, NEARLY_ALL_ROWS, ORDINARY_GAP};
use crate::diagnose::{Options, Problem, aligned, prior_penalty, refit_roughly};
use crate::gap::rms;
use crate::instrument::View;
use crate::measurement::{Kind, Measurements, Row};

/// Halvings of the step from one zero that is tried to the next, 15°: to a tenth of a milliradian.
const HALVINGS: usize = 12;

/// How many numbers a row has, where it has no pose.
pub(super) fn numbers(data: &Measurements) -> Option<usize> {
    match data.kind {
        Kind::Bench { lengths, angles } => Some(lengths.max(2 * usize::from(angles))),
        Kind::Distance => Some(1),
        Kind::Coordinates { components } => Some(components.iter().filter(|is| **is).count()),
        _ => None,
    }
}

/// How far an arm moves its tool across the plane that fits it best, root mean square at rows of plates, m; of an arm that
/// moves in a plane any plate takes all points.
fn thickness<'r>(arm: &Arm, rows: impl Iterator<Item = &'r Row>) -> f64 {
    let is_on_plate =
        |row: &&Row| row.aim.as_ref().is_some_and(|aim| matches!(aim.view, View::Plane(_)));
    let points: Vec<Vector3<f64>> =
        rows.filter(is_on_plate).map(|row| arm.pose(&row.q).translation.vector).collect();
    let mean = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    let spread: Matrix3<f64> = points.iter().map(|p| (p - mean) * (p - mean).transpose()).sum();
    (spread.symmetric_eigenvalues().min().max(0.0) / points.len() as f64).sqrt()
}

impl Search<'_> {
    /// What some rows leave without the mistakes, the bench and the frames fitted; with the table `along`, each of its
    /// numbers held to what makers tolerate. `None` where numbers are no place of an arm.
    pub(super) fn left_of_bench(
        &self,
        options: &Options,
        mistakes: &[Mistake],
        rows: &[usize],
        along: bool,
    ) -> Option<Left> {
        let arm = self.arm_without(mistakes);
        let data = self.rows.mended(mistakes, Some(rows));
        let known = super::known(mistakes, &options.known, &options.catalogue);
        let options =
            Options { effects: Some(Vec::new()), geometry: along, known, ..options.clone() };
        if 2 * data.rows.len() < rows.len() {
            return None;
        }
        let problem = Problem::new(&arm, &data, &options).ok()?;
        // Tolerances count against what arms leave beside them; an angle, by the reach.
        let (length, angle) = (1.0 / (ORDINARY_GAP * self.reach), 1.0 / ORDINARY_GAP);
        let weights = Vector6::new(length, length, length, angle, angle, angle);
        let fit = refit_roughly(&problem, aligned(&problem).ok()?, &weights).ok()?;
        let size = |gap: &Vector6<f64>| gap.component_mul(&weights).norm() / length;
        let sizes: Vec<f64> = fit.predicted.gaps.iter().map(size).collect();
        let position = rms(&sizes);
        let size = best(self.kept, sizes.iter().copied());
        let is = thickness(&arm, data.rows.iter());
        let was = thickness(self.arm, rows.iter().map(|row| &self.rows.data.rows[*row]));
        if is < FLAT_ARM * was && size > FLAT_ARM * is {
            return None;
        }
        size.is_finite().then_some(Left {
            size,
            of_nearly_all: best(NEARLY_ALL_ROWS, sizes.into_iter()),
            prior_penalty: prior_penalty(&problem, &fit.model),
            position,
            rotation: 0.0,
            rows: rows.len() as f64,
            told: data.rows.len() as f64 / rows.len() as f64,
            turned: 0.0,
        })
    }

    /// The mistakes, zeros of any amount among them where they leave least.
    pub(super) fn settled(&self, mistakes: Vec<Mistake>, rows: &[usize]) -> Vec<Mistake> {
        let mut best = (self.framed(mistakes.clone(), rows), mistakes);
        let mut step = TAU / 48.0;
        for _ in 0..HALVINGS {
            for by in [step, -step] {
                let mut moved = best.1.clone();
                let zeros = moved.iter_mut().filter_map(|mistake| match mistake {
                    Mistake::Off { entry: Entry::Theta, by, .. } => Some(by),
                    _ => None,
                });
                if zeros.map(|zero| *zero = (*zero + by + PI).rem_euclid(TAU) - PI).count() == 0 {
                    return moved;
                }
                let left = self.framed(moved.clone(), rows);
                if left < best.0 {
                    best = (left, moved);
                }
            }
            step /= 2.0;
        }
        best.1
    }
}
