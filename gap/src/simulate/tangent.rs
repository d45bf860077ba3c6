//! How an arm answers small displacements of its sites: the loads follow the geometry, and every
//! site gives by the slope of its law.
//!
//! At rest every displacement is what its site gives under its load, `u = c(l(u))`. The derivative
//! of the difference is `1 − C K`: `C = ∂c/∂l` are the compliances of the sites, `K = ∂l/∂u` is how
//! the loads, constant in base axes, change at each site when another one moves. It is the loaded
//! stiffness `Kθ − K_C` of the deformed geometry, multiplied by the compliances, so that rigid
//! sites need no stiffness.

use nalgebra::{DMatrix, DVector, Matrix3, Matrix6, Matrix6x3, SymmetricEigen, Vector3, Vector6};

use super::walk::{Frames, Walk};
use super::{rotation, translation};

/// Part of a load, and N or N·m on top of it, by which a law is differentiated.
const STEP: f64 = 1e-4;

/// What acts beyond a site, base axes.
struct Acting {
    force: Vector3<f64>,
    /// About the site's displaced origin.
    moment: Vector3<f64>,
    /// `A − tr(A)` with `A = Σ a fᵀ` over the forces `f` at `a` from there: times a rotation, how
    /// the moment changes when all that is beyond turns.
    turning: Matrix3<f64>,
}

/// A site that gives.
struct Giving {
    site: usize,
    /// `∂c/∂l`, 6×6, its axes.
    slope: Matrix6<f64>,
}

/// The arm's answers about one posture.
pub(super) struct Tangent<'w, 'a> {
    walk: &'w Walk<'a>,
    at: &'w [Vector6<f64>],
    frames: &'w [Frames],
    acting: Vec<Acting>,
    giving: Vec<Giving>,
}

impl<'w, 'a> Tangent<'w, 'a> {
    /// About the displacements `at`, with the frames and loads that belong to them.
    pub(super) fn new(
        walk: &'w Walk<'a>,
        at: &'w [Vector6<f64>],
        frames: &'w [Frames],
        loads: &[Vector6<f64>],
    ) -> Self {
        let tool = &frames[walk.sites - 1].behind;
        let (force, point) = walk.tip(tool);
        let mut sum = point * force.transpose();
        let mut acting: Vec<Acting> = Vec::with_capacity(walk.sites);
        for index in (0..walk.sites).rev() {
            let Frames { before, behind } = &frames[index];
            if let Some((weight, point)) = walk.mass(index, behind) {
                sum += point * weight.transpose();
            }
            let (force, moment) = (translation(&loads[index]), rotation(&loads[index]));
            let (force, moment) = (before.rotation * force, before.rotation * moment);
            let about = sum - behind.translation.vector * force.transpose();
            let turning = about - Matrix3::identity() * about.trace();
            acting.push(Acting { force, moment, turning });
            if let Some((weight, point)) = walk.beam(index, before) {
                sum += point * weight.transpose();
            }
        }
        acting.reverse();
        let giving = (0..walk.sites).filter_map(|site| {
            let slope = slope(walk, site, &loads[site]);
            (slope != Matrix6::zeros()).then_some(Giving { site, slope })
        });
        let giving = giving.collect();
        Self { walk, at, frames, acting, giving }
    }

    /// What each site gives in answer to a small change `by` of the displacement of `moved`, as
    /// pairs of a site and its displacement, each in its own axes.
    pub(super) fn answers(
        &self,
        moved: usize,
        by: &Vector6<f64>,
    ) -> impl Iterator<Item = (usize, Vector6<f64>)> {
        let turn = self.frames[moved].before.rotation;
        let shift = turn * translation(by);
        let turn = turn * (left(&rotation(&self.at[moved])) * rotation(by));
        self.giving.iter().map(move |one| (one.site, self.answer(one, moved, &shift, &turn)))
    }

    fn answer(
        &self,
        giving: &Giving,
        moved: usize,
        shift: &Vector3<f64>,
        turn: &Vector3<f64>,
    ) -> Vector6<f64> {
        let site = giving.site;
        let mut given = giving.slope * self.load_change(site, moved, shift, turn);
        if site > moved
            && let Some(link) = self.walk.link(site)
        {
            let back = self.frames[site].before.rotation.inverse();
            let gravity = back * -turn.cross(&self.walk.actual.arm.gravity);
            given += link.give(&Vector6::zeros(), &link.weight(&gravity));
        }
        given
    }

    /// For each site what carries a small displacement in its own axes to the tool: the twist there,
    /// base axes, with all that is given in answer. In base axes the answers to a shift and a turn
    /// are sums over the sites before the one that moves, and over those behind it.
    pub(super) fn carriers(&self) -> Vec<Matrix6<f64>> {
        let tool = self.frames[self.walk.sites - 1].behind.translation.vector;
        let both = |shift: Matrix3<f64>, turn: Matrix3<f64>| {
            let mut blocks = Matrix6::zeros();
            blocks.fixed_view_mut::<3, 3>(0, 0).copy_from(&shift);
            blocks.fixed_view_mut::<3, 3>(3, 3).copy_from(&turn);
            blocks
        };
        let axes = |site: usize| {
            let turn = *self.frames[site].before.rotation.to_rotation_matrix().matrix();
            let lever = tool - self.frames[site].before.translation.vector;
            let mut rigid = both(turn, turn);
            rigid.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-lever.cross_matrix() * turn));
            (turn, rigid)
        };
        // What a moment on a site does by what it gives, and a turn of all that it bears.
        let mut by_moment = vec![Matrix6x3::zeros(); self.walk.sites];
        let mut by_turn = by_moment.clone();
        for Giving { site, slope } in &self.giving {
            let ((turn, rigid), acting) = (axes(*site), &self.acting[*site]);
            let back = turn.transpose();
            let answer = rigid * slope * both(back, back);
            let (force, moment) = (answer.fixed_columns::<3>(0), answer.fixed_columns::<3>(3));
            by_moment[*site] = moment.into_owned();
            by_turn[*site] = force * acting.force.cross_matrix()
                + moment * (acting.turning + acting.moment.cross_matrix());
            if let Some(link) = self.walk.link(*site) {
                let gravity = back * self.walk.actual.arm.gravity.cross_matrix();
                let own = |k| link.give(&Vector6::zeros(), &link.weight(&gravity.column(k).into()));
                by_turn[*site] += rigid * Matrix6x3::from_columns(&[own(0), own(1), own(2)]);
            }
        }
        let mut before = Matrix6x3::zeros();
        let mut behind: Matrix6x3<f64> = by_turn.iter().sum();
        let each = (0..self.walk.sites).map(|site| {
            let ((turn, rigid), acting) = (axes(site), &self.acting[site]);
            behind -= by_turn[site];
            let by_shift = -before * acting.force.cross_matrix();
            before += by_moment[site];
            let turned = before * acting.turning + behind;
            let mut answers = Matrix6::zeros();
            answers.fixed_columns_mut::<3>(0).copy_from(&by_shift);
            answers.fixed_columns_mut::<3>(3).copy_from(&turned);
            rigid + answers * both(turn, turn * left(&rotation(&self.at[site])))
        });
        each.collect()
    }

    /// How the load of a site changes, its axes, as `moved` is displaced.
    fn load_change(
        &self,
        site: usize,
        moved: usize,
        shift: &Vector3<f64>,
        turn: &Vector3<f64>,
    ) -> Vector6<f64> {
        let (here, there) = (&self.acting[site], &self.acting[moved]);
        // What moves is all that is beyond: with the site itself, if it is one of these.
        let (force, moment) = match site.cmp(&moved) {
            std::cmp::Ordering::Less => {
                (Vector3::zeros(), shift.cross(&there.force) + there.turning * turn)
            }
            std::cmp::Ordering::Equal => (Vector3::zeros(), there.turning * turn),
            std::cmp::Ordering::Greater => {
                (-turn.cross(&here.force), here.turning * turn - turn.cross(&here.moment))
            }
        };
        let back = self.frames[site].before.rotation.inverse();
        let (f, m) = (back * force, back * moment);
        Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z)
    }

    /// Whether an arm that rests here takes work in every small displacement, the kernels' criterion
    /// (`stiffarm_kernels::solve`): with `C = L Lᵀ`, `1 − Lᵀ (K + Kᵀ)/2 L` is positive definite. It is the
    /// loaded stiffness in coordinates in which rigid sites do no harm.
    pub(super) fn is_stable(&self) -> bool {
        if self.bound() < 1.0 {
            return true;
        }
        // A moment does the work of the turn, in the axes before it.
        let turned = |(site, root): (usize, Vector6<f64>)| {
            (site, translation(&root), left(&rotation(&self.at[site])) * rotation(&root))
        };
        let roots: Vec<_> = self.giving.iter().flat_map(roots).map(turned).collect();
        let n = roots.len();
        let mut loaded = DMatrix::zeros(n, n);
        for (column, (moved, shift, turn)) in roots.iter().enumerate() {
            let axes = self.frames[*moved].before.rotation;
            let (shift, turn) = (axes * shift, axes * turn);
            for (row, (site, by_shift, by_turn)) in roots.iter().enumerate() {
                let load = self.load_change(*site, *moved, &shift, &turn);
                loaded[(row, column)] =
                    by_shift.dot(&translation(&load)) + by_turn.dot(&rotation(&load));
            }
        }
        let stiffness = DMatrix::identity(n, n) - (&loaded + loaded.transpose()) / 2.0;
        stiffness.iter().all(|x| x.is_finite()) && stiffness.cholesky().is_some()
    }

    /// No eigenvalue of `Lᵀ (K + Kᵀ)/2 L` is larger. A unit rotation changes a moment by at most `t` and a force
    /// by at most `f`, a unit shift a moment by `f`; over all columns of `L`, whose rotations have the square
    /// sum `A` and whose shifts have `B`, Cauchy and Schwarz give `t A + 2 f √(A B)`.
    fn bound(&self) -> f64 {
        let trace = |first: usize| -> f64 {
            let of =
                |one: &Giving| (first..first + 3).map(|k| one.slope[(k, k)].abs()).sum::<f64>();
            self.giving.iter().map(of).sum()
        };
        let (sliding, turning) = (trace(0), trace(3));
        let most = |of: fn(&Acting) -> f64| self.acting.iter().map(of).fold(0.0, f64::max);
        let moment = most(|acting| acting.turning.norm() + acting.moment.norm());
        let force = most(|acting| acting.force.norm());
        moment * turning + 2.0 * force * (turning * sliding).sqrt()
    }

    /// `1 − C K` over the components that give.
    pub(super) fn matrix(&self) -> Stiffness {
        let unknowns: Vec<(usize, usize)> = (self.giving.iter())
            .flat_map(|one| {
                let gives = |k: &usize| one.slope.row(*k).iter().any(|s| *s != 0.0);
                (0..6).filter(gives).map(|k| (one.site, k))
            })
            .collect();
        let mut matrix = DMatrix::identity(unknowns.len(), unknowns.len());
        for (column, &(moved, component)) in unknowns.iter().enumerate() {
            let mut row = 0;
            for (site, given) in self.answers(moved, &Vector6::ith(component, 1.0)) {
                while let Some((_, k)) = unknowns.get(row).filter(|(of, _)| *of == site) {
                    matrix[(row, column)] -= given[*k];
                    row += 1;
                }
            }
        }
        Stiffness { unknowns, matrix }
    }
}

/// `1 − C K` over the components of the sites that give.
pub(super) struct Stiffness {
    /// Site and component.
    unknowns: Vec<(usize, usize)>,
    matrix: DMatrix<f64>,
}

impl Stiffness {
    /// Newton's step where every site gives `misses` more than it is displaced; none where the
    /// matrix is singular.
    pub(super) fn solve(&self, misses: &[Vector6<f64>]) -> Option<Vec<Vector6<f64>>> {
        let right =
            self.unknowns.iter().map(|(site, k)| misses[*site][*k]).collect::<Vec<_>>().into();
        let step: DVector<f64> = self.matrix.clone().lu().solve(&right)?;
        let mut all = misses.to_vec();
        for ((site, k), step) in self.unknowns.iter().zip(step.iter()) {
            all[*site][*k] = *step;
        }
        step.iter().all(|s| s.is_finite()).then_some(all)
    }
}

/// Columns of `L`, `L Lᵀ` the symmetric part of a site's compliance.
fn roots(giving: &Giving) -> Vec<(usize, Vector6<f64>)> {
    let symmetric = (giving.slope + giving.slope.transpose()) / 2.0;
    let SymmetricEigen { eigenvectors, eigenvalues } = symmetric.symmetric_eigen();
    let least = f64::EPSILON * eigenvalues.amax();
    let pairs = eigenvalues.iter().zip(eigenvectors.column_iter());
    let pairs = pairs.filter(|(value, _)| **value > least);
    pairs.map(|(value, vector)| (giving.site, vector * value.sqrt())).collect()
}

/// The compliance of a site about its load, 6×6.
fn slope(walk: &Walk<'_>, site: usize, load: &Vector6<f64>) -> Matrix6<f64> {
    let (mut slope, mut load) = (Matrix6::zeros(), *load);
    if let Some(row) = walk.spring(site) {
        load = walk.actual.borne(row, &load);
        slope += Matrix6::from_diagonal(&walk.actual.spring(row, &Vector6::repeat(1.0)));
    } else if let Some(link) = walk.link(site) {
        let weightless = Vector3::zeros();
        let column = |k| link.give(&Vector6::ith(k, 1.0), &weightless);
        slope += Matrix6::from_columns(&std::array::from_fn::<_, 6, _>(column));
    }
    for law in walk.laws(site) {
        slope += Matrix6::from_columns(&std::array::from_fn::<_, 6, _>(|k| {
            let step = Vector6::ith(k, STEP * (1.0 + load[k].abs()));
            (law(&(load + step)) - law(&(load - step))) / (2.0 * step[k])
        }));
    }
    slope
}

/// The rotation rate, in the axes before a rotation, per rate of its rotation vector: the left
/// Jacobian of SO(3), `1 + (1 − cos θ)/θ² [θ] + (θ − sin θ)/θ³ [θ]²`.
fn left(vector: &Vector3<f64>) -> Matrix3<f64> {
    let cross = vector.cross_matrix();
    let square = vector.norm_squared();
    let angle = square.sqrt();
    let half = 0.5 * angle;
    let sinc = if half > 0.0 { half.sin() / half } else { 1.0 };
    // Below, what the series leaves out is less than the rounding of its first term.
    let third = if square < 1e-5 {
        1.0 / 6.0 - square / 120.0 + square * square / 5040.0
    } else {
        (1.0 - angle.sin() / angle) / square
    };
    Matrix3::identity() + cross * (0.5 * sinc * sinc) + cross * cross * third
}

#[cfg(test)]
mod tests {
    use super::super::{Actual, Site};
    use super::*;
    use crate::fixture::bent;

    /// Against differences of what the sites give, in a posture with every site displaced.
    #[test]
    fn answers_are_the_differences_of_what_is_given() {
        let arm = bent();
        let (q, w) = ([0.3, -0.7, 0.4], Vector6::new(300.0, -200.0, -800.0, 20.0, -30.0, 10.0));
        let mut actual = Actual::new(&arm, &q, &w);
        actual.load_point = Vector3::new(0.02, 0.03, -0.05);
        actual.laws.push((Site::Joint(1), Box::new(|l| Vector6::ith(5, 1e-12 * l[5].powi(3)))));
        actual.laws.push((Site::Base, Box::new(|l| l * 1e-6)));
        let walk = Walk::new(&actual);
        let at: Vec<Vector6<f64>> = (0..walk.sites)
            .map(|s| Vector6::from_fn(|k, _| 0.2 * (1.3 * s as f64 + 2.7 * k as f64).sin()))
            .collect();
        let gives = |at: &[Vector6<f64>]| -> Vec<Vector6<f64>> {
            let frames = walk.frames(at);
            let loads = walk.loads(&frames);
            (0..walk.sites).map(|k| walk.give(k, &frames[k], &loads[k])).collect()
        };
        let frames = walk.frames(&at);
        let loads = walk.loads(&frames);
        let tangent = Tangent::new(&walk, &at, &frames, &loads);
        let carriers = tangent.carriers();
        let tool = frames[walk.sites - 1].behind.translation.vector;
        let rigid = |site: usize, by: &Vector6<f64>| -> Vector6<f64> {
            let frame = &frames[site].before;
            let turn = frame.rotation * rotation(by);
            let lever = tool - frame.translation.vector;
            let shift = frame.rotation * translation(by) + turn.cross(&lever);
            Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z)
        };
        let step = 1e-5;
        for moved in 0..walk.sites {
            for k in 0..6 {
                let shifted = |by: f64| {
                    let mut at = at.clone();
                    at[moved][k] += by;
                    gives(&at)
                };
                let mut want: Vec<Vector6<f64>> = shifted(step)
                    .iter()
                    .zip(shifted(-step))
                    .map(|(more, less)| (more - less) / (2.0 * step))
                    .collect();
                let size = want.iter().map(|w| w.amax()).fold(0.0, f64::max);
                for (site, given) in tangent.answers(moved, &Vector6::ith(k, 1.0)) {
                    want[site] -= given;
                }
                let left = want.iter().map(|w| w.amax()).fold(0.0, f64::max);
                let carried = tangent
                    .answers(moved, &Vector6::ith(k, 1.0))
                    .fold(rigid(moved, &Vector6::ith(k, 1.0)), |sum, (site, given)| {
                        sum + rigid(site, &given)
                    });
                let apart = (carried - carriers[moved].column(k)).amax();
                // Some hundred roundings of what is carried.
                assert!(apart <= 1e-13 * carried.amax(), "{moved} {k}: {apart:e}");
                // The square of the step, and gives of 1e-2, rounded some hundred times, over it.
                assert!(left <= 1e-8 * size + 1e-11, "{moved} {k}: {left:e} of {size:e}");
            }
        }
    }
}
