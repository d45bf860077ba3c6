//! Frames that are not where the robot file has them.

use core::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI};

use nalgebra::{Isometry3, Point3, Vector3};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::{reach, simulated, spread};
use crate::constants::{ALL_BY_FRAMES, FEWEST_POSES, LARGE_GAP};
use crate::diagnose::{Nuisance, rigid};
use crate::effects::Known;
use crate::gap::rms;
use crate::io::shown;
use crate::measurement::{Measurements, Row, Stands};
use crate::mistakes::moved;
use crate::simulate::{Reading, simulate};

/// Turns of the closed forms: each is exact where the other is, and together they approach the best of both.
const TURNS: usize = 40;

/// Of a zero's last step, rad: a hundredth of what makers' marks are good to.
const LEAST_STEP: f64 = 1e-5;

/// A rigid motion of frames explains nearly all of a gap that is large beside the arm.
#[derive(Debug)]
pub(crate) struct Displaced {
    /// The frames, beside those that are fitted anyway, and how far each is from where the file has it: m, and rad.
    pub(crate) frames: Vec<(Nuisance, f64, f64)>,
    /// Root mean square of the positions' gap, as the file has the frames and with them fitted, m.
    pub(crate) gap: [f64; 2],
}

impl Displaced {
    /// As a question to whoever wrote the file.
    pub(super) fn doubt(&self, data: &Measurements, reach: f64) -> String {
        let names: Vec<&str> = self.frames.iter().map(|(frame, ..)| frame.identifier()).collect();
        format!(
            "{}: the gap is {} m, and the arm reaches {} m; a rigid motion of {} explains {:.1} % of it: is the frame \
             unknown? --nuisance {}",
            data.file,
            shown(self.gap[0]),
            shown(reach),
            names.join(" and ").replace('_', " "),
            (1000.0 * explained(self.gap)).floor() / 10.0,
            names.join(",")
        )
    }
}

/// Part of the gap's square that is explained.
fn explained([before, after]: [f64; 2]) -> f64 {
    1.0 - (after / before).powi(2)
}

/// The frames whose motion explains a gap of positions, if any does and no joint's zero does. The robot file has the
/// effects `known`; `along` are the frames that are fitted along.
pub(crate) fn displaced(
    arm: &Arm,
    data: &Measurements,
    known: &[Known],
    along: &[Nuisance],
) -> Option<Displaced> {
    let reach = reach(arm);
    if !data.kind.is_pose() || data.poses < FEWEST_POSES || reach <= 0.0 {
        return None;
    }
    let along = &Nuisance::unknown(data, along)[..];
    let points = Points::of(arm, data, known);
    if points.rows.len() < FEWEST_POSES {
        return None;
    }
    let [base, tool] = [Nuisance::BaseFrame, Nuisance::ToolFrame];
    let told = points.framed(along);
    let before = points.left(&told);
    if before.is_nan() || before <= LARGE_GAP * reach {
        return None;
    }
    let is_nearly_all = |left: &f64| explained([before, *left]) > ALL_BY_FRAMES;
    let nearly: Vec<_> = [vec![base], vec![tool], vec![base, tool]]
        .into_iter()
        .filter(|free| free.iter().all(|frame| !along.contains(frame)))
        .map(|free| (points.framed(&[along, &free].concat()), free))
        .map(|(framed, free)| (points.left(&framed), framed, free))
        .filter(|(left, ..)| is_nearly_all(left))
        .collect();
    // One frame is enough where what it leaves is not large in turn.
    let enough = nearly.iter().position(|(left, ..)| *left <= LARGE_GAP * reach);
    let (left, framed, frames) = nearly.into_iter().nth(enough.unwrap_or(0))?;
    let origin = Point3::from(arm.base.translation.vector);
    let by = |frame: Nuisance| match frame {
        Nuisance::BaseFrame => {
            framed.bases.iter().fold((frame, 0.0, 0.0), |most: (_, f64, f64), base| {
                let moved = (base * origin - origin).norm();
                if moved > most.1 { (frame, moved, base.rotation.angle()) } else { most }
            })
        }
        Nuisance::ToolFrame => (frame, framed.points[points.unknown].norm(), 0.0),
    };
    let frames = frames.into_iter().map(by).collect();
    // Where unknown markers are is told by the frames that fit; all others stay where the file has them.
    let mut zeroed = Framed { bases: told.bases, points: framed.points };
    zeroed.points[points.unknown] = told.points[points.unknown];
    let is_zero =
        (0..arm.dof()).any(|joint| is_nearly_all(&points.left_of_zero(arm, joint, &zeroed)));
    (!is_zero).then_some(Displaced { frames, gap: [before, left] })
}

/// Rows of positions beside what is simulated of them.
struct Points<'d> {
    data: &'d Measurements,
    /// With the joints where the robot file's effects have them.
    rows: Vec<(Reading, Row)>,
    /// Of each row, the frame in which the arm stands.
    base: Vec<usize>,
    /// Of each row, the marker whose place on the tool is unknown, and is fitted along in any case; the last for all others.
    marker: Vec<usize>,
    unknown: usize,
}

/// Where the frames are.
struct Framed {
    /// Of each base.
    bases: Vec<Isometry3<f64>>,
    /// Of each unknown marker, and of all others, tool frame, m.
    points: Vec<Vector3<f64>>,
}

impl<'d> Points<'d> {
    fn of(arm: &Arm, data: &'d Measurements, known: &[Known]) -> Self {
        let moved = moved(arm, data, known);
        let bases = Stands::of(data).base_of;
        let rows = spread(data).filter_map(|(number, row)| {
            let mut row = row.clone();
            let by = moved.get(number).into_iter().flatten();
            row.q.iter_mut().zip(by).for_each(|(q, by)| *q += by);
            simulated(arm, data, 3, &row).map(|sim| ((sim, row), bases[number]))
        });
        let (rows, base): (Vec<(Reading, Row)>, Vec<usize>) = rows.unzip();
        let mut names = Vec::new();
        for (_, row) in &rows {
            if row.offset.is_none() && !names.contains(&row.marker) {
                names.push(row.marker.clone());
            }
        }
        let of =
            |row: &Row| names.iter().position(|name| row.offset.is_none() && *name == row.marker);
        let marker = rows.iter().map(|(_, row)| of(row).unwrap_or(names.len())).collect();
        Points { data, rows, base, marker, unknown: names.len() }
    }

    fn measured(&self, row: usize) -> Vector3<f64> {
        self.rows[row].1.measured.fixed_rows::<3>(0).into_owned()
    }

    /// The frames `free`, and unknown markers, fitted: each is exact where the other is, and together they approach the
    /// best of both.
    fn framed(&self, free: &[Nuisance]) -> Framed {
        let [has_base, has_tool] =
            [Nuisance::BaseFrame, Nuisance::ToolFrame].map(|frame| free.contains(&frame));
        let count = self.base.iter().max().map_or(0, |last| last + 1);
        let mut framed = Framed {
            bases: vec![Isometry3::identity(); count],
            points: vec![Vector3::zeros(); self.unknown + 1],
        };
        let open = if has_tool { self.unknown + 1 } else { self.unknown };
        // Where one of them alone is free, its closed form is exact.
        for _ in 0..if has_base && open > 0 { TURNS } else { 1 } {
            if has_base {
                for (number, base) in framed.bases.iter_mut().enumerate() {
                    let rows = (0..self.rows.len()).filter(|row| self.base[*row] == number);
                    let both = rows.map(|row| {
                        let sim = &self.rows[row].0;
                        let point = framed.points[self.marker[row]];
                        (sim.position + sim.rotation * point, self.measured(row))
                    });
                    let (from, to): (Vec<_>, Vec<_>) = both.unzip();
                    *base = rigid(&from, &to);
                }
            }
            let mut sums = vec![(Vector3::zeros(), 0.0); self.unknown + 1];
            for (row, (sim, _)) in self.rows.iter().enumerate() {
                let at = framed.bases[self.base[row]].inverse() * Point3::from(self.measured(row));
                let (sum, count) = &mut sums[self.marker[row]];
                *sum += sim.rotation.inverse() * (at.coords - sim.position);
                *count += 1.0;
            }
            for (point, (sum, count)) in framed.points.iter_mut().zip(sums).take(open) {
                if count > 0.0 {
                    *point = sum / count;
                }
            }
        }
        framed
    }

    /// Root mean square of the positions' gap, m.
    fn left(&self, framed: &Framed) -> f64 {
        let gap =
            |row: usize| (self.at(row, &self.rows[row].0, framed) - self.measured(row)).norm();
        rms(&(0..self.rows.len()).map(gap).collect::<Vec<_>>())
    }

    /// Where a row's point is simulated.
    fn at(&self, row: usize, sim: &Reading, framed: &Framed) -> Vector3<f64> {
        let point = Point3::from(sim.position + sim.rotation * framed.points[self.marker[row]]);
        (framed.bases[self.base[row]] * point).coords
    }

    /// The least root mean square of the gap that another zero of a joint leaves, m. The point goes round a circle, or
    /// along a line, with it.
    fn left_of_zero(&self, arm: &Arm, joint: usize, framed: &Framed) -> f64 {
        let is_revolute = arm.joints[joint].motion == Motion::Revolute;
        // The gap, and how the point moves with the cosine less one, and with the sine or the way itself.
        let path = |row: usize| {
            let at = |by: f64| {
                let mut moved = self.rows[row].1.clone();
                moved.q[joint] += by;
                let sim = simulate(arm, &moved, self.data.kind).ok()?.reading();
                Some(self.at(row, &sim, framed))
            };
            let (first, opposite) = (at(0.0)?, at(PI)?);
            let gap = self.measured(row) - first;
            let radius = 0.5 * (first - opposite);
            Some(match is_revolute {
                true => [gap, radius, at(FRAC_PI_2)? - first + radius],
                false => [gap, Vector3::zeros(), -radius * FRAC_2_PI],
            })
        };
        let Some(paths) = (0..self.rows.len()).map(path).collect::<Option<Vec<_>>>() else {
            return f64::INFINITY;
        };
        let left = |by: f64| {
            let (cosine, sine) = if is_revolute { (by.cos() - 1.0, by.sin()) } else { (0.0, by) };
            let size = |[gap, c, s]: &[Vector3<f64>; 3]| (gap - c * cosine - s * sine).norm();
            rms(&paths.iter().map(size).collect::<Vec<_>>())
        };
        if !is_revolute {
            let along: f64 = paths.iter().map(|[gap, _, s]| gap.dot(s)).sum();
            return left(along / paths.iter().map(|[_, _, s]| s.norm_squared()).sum::<f64>());
        }
        let degrees = (-180..180).map(|degree| f64::from(degree).to_radians());
        let each = degrees.map(|by| (left(by), by)).min_by(|a, b| a.0.total_cmp(&b.0));
        let Some(mut best) = each else { return f64::INFINITY };
        let mut step = 0.5_f64.to_radians();
        while step > LEAST_STEP {
            for by in [best.1 - step, best.1 + step] {
                best = if left(by) < best.0 { (left(by), by) } else { best };
            }
            step *= 0.5;
        }
        best.0
    }
}
