//! All inverse solutions of an elbow manipulator: a standard table of six revolute joints whose
//! axes 2, 3 and 4 are parallel, with axes 1, 5 and 6 at right angles to their neighbours (Paul's
//! elbow manipulator of Table IV, but also arms with offsets along the parallel axes).
//!
//! With `z1` the parallel axes' direction, `p5` the point on axis 6 where axis 5 meets it and `a`
//! the direction of axis 6:
//!
//! * `z1·p5 = d2 + d3 + d4` holds whatever joints 2 to 6 do: two values of θ1;
//! * `z1·a = −sin α4 sin α5 cos θ5`: two values of θ5; then x4 is the direction of `a` across z1;
//! * θ6 follows from the target's rotation, and joints 2 and 3 are the two sides of a triangle that
//!   ends at p3: two values of θ3.

mod found;

use std::f64::consts::PI;

use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Convention, Joint};

pub use found::{Branch, InverseError, Inverses, Missing, Sign, Solution};

/// Below this part of the arm's size (of 1, for directions) a length counts as zero: the branch is
/// singular there.
const SINGULAR: f64 = 1e-9;

/// What rounding may take from the square of a sine at the limit of reach.
const SLACK: f64 = 1e-12;

/// An arm whose inverse kinematics is known in closed form.
#[derive(Clone, Debug)]
pub struct ParallelElbow<'a> {
    arm: &'a Arm,
    /// sin α of rows 1, 4 and 5: 1 or −1.
    sides: [f64; 3],
    /// From frame 5 turned by θ6 and shifted by d6 to the tool.
    behind: Isometry3<f64>,
    size: f64,
}

impl<'a> ParallelElbow<'a> {
    /// The arm, if it is one of this kind.
    ///
    /// # Errors
    /// [`InverseError::Family`] names the first thing that is otherwise.
    pub fn new(arm: &'a Arm) -> Result<Self, InverseError> {
        let refuse = |what: String| Err(InverseError::Family { what });
        let rows = &arm.joints;
        if arm.convention != Convention::Standard {
            return refuse("its table is a modified one, expected a standard one".to_owned());
        }
        if rows.len() != 6 {
            return refuse(format!("it has {} joints, expected 6", rows.len()));
        }
        if let Some(k) = rows.iter().position(|row| row.motion != Motion::Revolute) {
            return refuse(format!("joint {} is prismatic, expected revolute joints", k + 1));
        }
        let finite =
            |row: &Joint| [row.theta, row.d, row.a, row.alpha].iter().all(|v| v.is_finite());
        if let Some(k) = rows.iter().position(|row| !finite(row)) {
            return refuse(format!("row {} has a number that is not finite", k + 1));
        }
        for k in [1, 2] {
            if rows[k].alpha.sin().abs() > SINGULAR || rows[k].alpha.cos() < 0.0 {
                return refuse(format!("alpha of row {} is not 0", k + 1));
            }
            if rows[k].a == 0.0 {
                return refuse(format!("a of row {} is 0", k + 1));
            }
        }
        for k in [0, 3, 4] {
            if rows[k].alpha.cos().abs() > SINGULAR {
                return refuse(format!("alpha of row {} is not a right angle", k + 1));
            }
        }
        if rows[4].a != 0.0 {
            return refuse("a of row 5 is not 0: axes 5 and 6 do not meet".to_owned());
        }
        let last = &rows[5];
        let behind = Isometry3::translation(last.a, 0.0, 0.0)
            * UnitQuaternion::from_axis_angle(&Vector3::x_axis(), last.alpha)
            * arm.tool;
        let lengths: f64 = rows.iter().map(|row| row.a.abs() + row.d.abs()).sum();
        let size = lengths + arm.tool.translation.vector.norm();
        Ok(Self { arm, sides: [0, 3, 4].map(|k| rows[k].alpha.sin().signum()), behind, size })
    }

    /// All joint values at which the unloaded tool stands at `target` (base frame).
    ///
    /// # Errors
    /// [`InverseError::Unreachable`] if no branch has a solution.
    pub fn solve(&self, target: &Isometry3<f64>) -> Result<Inverses, InverseError> {
        let numbers = target.to_homogeneous();
        if !numbers.iter().all(|number| number.is_finite()) {
            return Err(InverseError::NotFinite);
        }
        let mut found = Inverses { solutions: Vec::new(), missing: Vec::new() };
        for shoulder in Sign::BOTH {
            match self.plane(target, shoulder) {
                Err(missing) => found.missing.push(missing),
                Ok(plane) => self.in_plane(target, &plane, shoulder, &mut found),
            }
        }
        if found.solutions.is_empty() {
            return Err(InverseError::Unreachable { missing: found.missing });
        }
        Ok(found)
    }

    /// θ1 and what it settles.
    fn plane(&self, target: &Isometry3<f64>, shoulder: Sign) -> Result<Plane, Missing> {
        let rows = &self.arm.joints;
        let flange = target * self.behind.inverse();
        let (x6, approach) = (flange.rotation * Vector3::x(), flange.rotation * Vector3::z());
        let p5 = flange.translation.vector - approach * rows[5].d;
        let distance = p5.x.hypot(p5.y);
        let offset = rows[1].d + rows[2].d + rows[3].d;
        if distance < SINGULAR * self.size && offset.abs() < SINGULAR * self.size {
            return Err(Missing::Shoulder);
        }
        let square = (distance - offset) * (distance + offset);
        if square < -SLACK * self.size * self.size {
            return Err(Missing::Offset { distance, offset: offset.abs() });
        }
        let along = shoulder.of(square.max(0.0).sqrt());
        let theta1 = p5.y.atan2(p5.x) + (self.sides[0] * offset).atan2(along);
        let (s1, c1) = theta1.sin_cos();
        let x1 = Vector3::new(c1, s1, 0.0);
        let y1 = Vector3::z() * self.sides[0];
        let p1 = x1 * rows[0].a + Vector3::z() * rows[0].d;
        Ok(Plane { theta1, x1, y1, z1: x1.cross(&y1), from_p1: p5 - p1, approach, x6 })
    }

    /// The wrist's two solutions, and the elbow's two of each.
    fn in_plane(
        &self,
        target: &Isometry3<f64>,
        plane: &Plane,
        shoulder: Sign,
        found: &mut Inverses,
    ) {
        let rows = &self.arm.joints;
        let [_, side4, side5] = self.sides;
        let level = plane.z1.dot(&plane.approach);
        let across = plane.approach - plane.z1 * level;
        let sine = across.norm();
        if sine < SINGULAR {
            return found.missing.push(Missing::Wrist);
        }
        let y4 = plane.z1 * side4;
        for wrist in Sign::BOTH {
            let theta5 = wrist.of(sine).atan2(-side4 * side5 * level);
            let x4 = across * (side5 / wrist.of(sine));
            let to_p3 = plane.from_p1 - x4.cross(&y4) * rows[4].d - x4 * rows[3].a;
            let theta234 = x4.dot(&plane.y1).atan2(x4.dot(&plane.x1));
            let x5 = x4 * theta5.cos() + y4 * theta5.sin();
            let y5 = plane.approach.cross(&x5);
            let theta6 = plane.x6.dot(&y5).atan2(plane.x6.dot(&x5));
            match self.triangle(to_p3.dot(&plane.x1), to_p3.dot(&plane.y1)) {
                Err(missing) => found.missing.push(missing),
                Ok(pairs) => {
                    for (elbow, [theta2, theta3]) in pairs {
                        let theta4 = theta234 - theta2 - theta3;
                        let theta = [plane.theta1, theta2, theta3, theta4, theta5, theta6];
                        let q = std::array::from_fn(|k| wrapped(theta[k] - rows[k].theta));
                        let branch = Branch { shoulder, wrist, elbow };
                        let residual = self.residual(&q, target);
                        found.solutions.push(Solution { q, branch, residual });
                    }
                }
            }
        }
    }

    /// θ2 and θ3 at which p3 stands at (u, v) in frame 1.
    fn triangle(&self, u: f64, v: f64) -> Result<[(Sign, [f64; 2]); 2], Missing> {
        let (a2, a3) = (self.arm.joints[1].a, self.arm.joints[2].a);
        let distance = u.hypot(v);
        // 1 − cos θ3 and 1 + cos θ3.
        let twice = 2.0 * a2 * a3;
        let above = (a2 + a3 - distance) * (a2 + a3 + distance) / twice;
        let below = (distance - (a2 - a3)) * (distance + (a2 - a3)) / twice;
        if above < -SLACK || below < -SLACK {
            let (nearest, farthest) = ((a2.abs() - a3.abs()).abs(), a2.abs() + a3.abs());
            return Err(Missing::Reach { distance, nearest, farthest });
        }
        if distance < SINGULAR * self.size {
            return Err(Missing::Elbow);
        }
        let (above, below) = (above.max(0.0), below.max(0.0));
        Ok(Sign::BOTH.map(|elbow| {
            let theta3 = elbow.of((above * below).sqrt()).atan2((below - above) / 2.0);
            let turn = (a3 * theta3.sin()).atan2(a2 + a3 * theta3.cos());
            (elbow, [v.atan2(u) - turn, theta3])
        }))
    }

    fn residual(&self, q: &[f64; 6], target: &Isometry3<f64>) -> f64 {
        let pose = self.arm.pose(q);
        let distance = (pose.translation.vector - target.translation.vector).norm();
        let turn = pose.rotation * target.rotation.inverse();
        (distance / self.size).max(turn.angle())
    }
}

/// The arm's plane at one θ1, base axes.
struct Plane {
    theta1: f64,
    x1: Vector3<f64>,
    y1: Vector3<f64>,
    z1: Vector3<f64>,
    /// p5 from the origin of frame 1.
    from_p1: Vector3<f64>,
    approach: Vector3<f64>,
    /// x of frame 5 turned by θ6.
    x6: Vector3<f64>,
}

/// Above −π and at most π.
fn wrapped(angle: f64) -> f64 {
    let turns = ((PI - angle) / (2.0 * PI)).floor();
    angle + turns * 2.0 * PI
}
