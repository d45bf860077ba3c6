//! Loads that an arm surely bears, whatever its posture: under them the test of stability can be left out.

use stiffarm_kernels::Motion;

use crate::number::Number;
use crate::robot::{Convention, Joint, Robot, Value};

/// F, N, and M, N·m, such that every wrench with `|f|²/F² + |m|²/M² < 1` (and the weights, where they count)
/// leaves the symmetric part of `Kθ − K_C` above half of Kθ in every posture, so that neither
/// rounding nor the order of the joints matters. `None` where the table does not say: lengths or springs are
/// symbolic, a joint is prismatic, or the weights alone come near the springs; nor for two springs, where the test
/// takes less than this.
///
/// Scaled to springs of 1, K_C is smaller than the sum of its entries' squares has as root: of joints i and
/// j the force enters with `|f|` times the lever of the outer one at most, the moment with `|m|/2` beside
/// the diagonal (its symmetric part), the weights with their lever moments. Of `x + y < h`, where x is the
/// force's share and y the moment's, `2x² + 2y² < h²` is enough.
pub(super) fn margin(robot: &Robot, weights: bool) -> Option<[Number; 2]> {
    let beyond = &robot.beyond;
    // The lengths are not the table's where the arm grows.
    let arm = Levers::of(robot).filter(|_| !beyond.grows())?;
    let n = robot.dof();
    if robot.joints.iter().filter(|joint| joint.stiffness.is_some()).count() < 3 {
        return None;
    }
    let stiffness: Vec<Option<f64>> = (robot.joints.iter())
        .map(|joint| joint.stiffness.as_ref().map(number).map_or(Some(None), |k| k.map(Some)))
        .collect::<Option<_>>()?;
    let root = |entry: &dyn Fn(usize, usize) -> f64| {
        let mut sum = 0.0;
        for (i, ki) in stiffness.iter().enumerate() {
            for (j, kj) in stiffness.iter().enumerate() {
                let (Some(ki), Some(kj)) = (ki, kj) else { continue };
                sum += entry(i, j).powi(2) / (ki * kj);
            }
        }
        sum.sqrt()
    };
    // The wrench that is told may be scaled, and its force acts beside the tool's origin.
    let scale = (1.0 + beyond.wrench_scale.to_f64()).abs();
    let beside: f64 = beyond.load_point.iter().map(|x| x.to_f64().abs()).sum();
    let tool = magnitude(&robot.tool.translation)? + beside;
    let force = scale * root(&|i, j| arm.lever(i.max(j), n - 1, tool));
    let moment = scale * root(&|i, j| if i == j { 0.0 } else { 0.5 });
    let mut room = 0.5;
    if weights {
        let gravity = magnitude(&robot.gravity)?;
        let moments: Vec<f64> = (0..n).map(|j| arm.mass_moment(robot, j)).collect::<Option<_>>()?;
        room -= root(&|i, j| gravity * moments[i.max(j)]);
    }
    // Rounded to three digits that are on the safe side; squares are to stay within single precision.
    let most = |share: f64| {
        let most = (0.99 * room / (2f64.sqrt() * share)).min(1e15);
        Number::from_decimal(&format!("{most:.2e}"))
    };
    if room > 0.0 { Some([most(force)?, most(moment)?]) } else { None }
}

/// How far the frames of an arm are apart at most.
struct Levers {
    /// Part of a row's length that its own joint swings.
    own: Vec<f64>,
    /// Distance between a row's frames, at most.
    row: Vec<f64>,
}

impl Levers {
    fn of(robot: &Robot) -> Option<Self> {
        let swung = |joint: &Joint| match robot.convention {
            Convention::Standard => number(&joint.a),
            Convention::Modified => Some(0.0),
        };
        let revolute = robot.joints.iter().all(|joint| joint.motion == Motion::Revolute);
        let own = robot.joints.iter().map(swung).collect::<Option<_>>().filter(|_| revolute)?;
        let length = |joint: &Joint| Some(number(&joint.a)?.abs() + number(&joint.d)?.abs());
        Some(Levers { own, row: robot.joints.iter().map(length).collect::<Option<_>>()? })
    }

    /// From the axis of joint `j` to a point that lies `beyond` from frame `last`, at most.
    fn lever(&self, j: usize, last: usize, beyond: f64) -> f64 {
        self.own[j].abs() + self.row[j + 1..=last].iter().sum::<f64>() + beyond
    }

    /// The masses beyond joint `j` times their levers, at most.
    fn mass_moment(&self, robot: &Robot, j: usize) -> Option<f64> {
        let mut moment = 0.0;
        for (k, joint) in robot.joints.iter().enumerate().skip(j) {
            let mass = joint.mass.as_ref().map_or(Some(0.0), number)?;
            moment += mass * self.lever(j, k, magnitude(&joint.com)?);
            if let Some((beam, density)) =
                joint.beam.as_ref().and_then(|b| Some((b, b.density.as_ref()?)))
            {
                let mass = number(density)? * number(&beam.section.area)? * self.row[k];
                moment += mass * (self.lever(j, k, 0.0) + self.row[k]);
            }
        }
        Some(moment)
    }
}

fn number(value: &Value) -> Option<f64> {
    value.number().map(Number::to_f64)
}

fn magnitude(vector: &[Value; 3]) -> Option<f64> {
    let [x, y, z] = vector.each_ref().map(number);
    Some(x?.hypot(y?).hypot(z?))
}
