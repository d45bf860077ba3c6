//! The chain of one row: the table's transforms with a site wherever something yields.

use nalgebra::{Matrix3, Vector3, Vector6};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Convention;

use super::chain::Chain;
use super::law::{Gear, Law};
use super::reality::{RealJoint, Reality};
use super::transform::{displaced, from_parts, origin, rotation, slide, turn};

/// What a row asks of the chain.
pub(super) struct Situation {
    /// Real joint values.
    pub(super) values: Vec<f64>,
    /// Direction of approach of each joint.
    pub(super) directions: Vec<f64>,
    /// 1 + expansion × temperature.
    pub(super) growth: f64,
    /// Of the tool frame, all told.
    pub(super) tool_frame: Vector6<f64>,
    /// Real load on the tool, base axes.
    pub(super) wrench: Vector6<f64>,
}

/// Below this sine chord and axis count as parallel, as for the robot file's beams.
const PARALLEL: f64 = 1e-9;

impl Reality {
    /// The arm of one situation.
    pub(super) fn chain(
        &self,
        situation: &Situation,
        tool_mount: &nalgebra::Matrix4<f64>,
    ) -> Chain {
        let mut chain = Chain::default();
        if self.rock != Vector3::zeros() || self.give != 0.0 {
            let [x, y, z] = self.rock.into();
            let laws = vec![self.give, self.give, self.give, x, y, z];
            chain.site(&[0, 1, 2, 3, 4, 5], Law::Diagonal(laws));
        }
        for (j, joint) in self.joints.iter().enumerate() {
            let row = RowOf {
                joint,
                gravity: self.gravity,
                value: situation.values[j],
                side: situation.directions[j],
                growth: situation.growth,
            };
            match self.convention {
                Convention::Standard => row.standard(&mut chain),
                Convention::Modified => row.modified(&mut chain),
            }
            chain.weight(joint.com, joint.mass * self.gravity);
        }
        // What is mounted on the arm grows with it, however much of it the robot file knows.
        let tool = self.tool * tool_mount;
        chain.fixed(from_parts(&rotation(&tool), &(origin(&tool) * situation.growth)));
        chain.fixed(displaced(&situation.tool_frame));
        let w = &situation.wrench;
        chain.force = Vector3::new(w[0], w[1], w[2]);
        chain.couple = Vector3::new(w[3], w[4], w[5]);
        chain.payload = self.payload;
        chain
    }
}

/// One row of the table in one situation.
struct RowOf<'a> {
    joint: &'a RealJoint,
    gravity: Vector3<f64>,
    value: f64,
    side: f64,
    growth: f64,
}

impl RowOf<'_> {
    fn a(&self) -> f64 {
        self.joint.a * self.growth
    }

    /// Along z; of a prismatic joint, its travel too.
    fn d(&self) -> f64 {
        match self.joint.motion {
            Motion::Revolute => self.joint.d * self.growth,
            Motion::Prismatic => (self.joint.d + self.value) * self.growth,
        }
    }

    fn theta(&self) -> f64 {
        match self.joint.motion {
            Motion::Revolute => self.joint.theta + self.value,
            Motion::Prismatic => self.joint.theta,
        }
    }

    /// `Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta)`; the beam turns with the joint.
    fn standard(&self, chain: &mut Chain) {
        self.tilt(chain);
        self.spring(chain);
        chain.fixed(turn(2, self.theta()));
        let chord = Vector3::new(self.a(), 0.0, self.d());
        chain.weight(chord / 2.0, self.beam_weight(chord.norm()));
        chain.fixed(slide(2, self.d()) * slide(0, self.a()));
        self.beam(chain, &chord, &Vector3::z());
        chain.weight(-chord / 2.0, self.joint.mass_on_chord * self.gravity);
        chain.fixed(turn(0, self.joint.alpha) * turn(1, self.joint.beta));
    }

    /// `Rx(alpha) Ry(beta) Tx(a) Rz(theta) Tz(d)`; the beam is there before the joint turns, and
    /// bends the axis about which it does.
    fn modified(&self, chain: &mut Chain) {
        let inclined = turn(0, self.joint.alpha) * turn(1, self.joint.beta);
        let chord = Vector3::new(self.a(), 0.0, self.d());
        let in_previous = rotation(&inclined) * chord;
        // A mass of the chord hangs on it as the beam's own does: joint i does not move either.
        let weight = self.beam_weight(chord.norm()) + self.joint.mass_on_chord * self.gravity;
        chain.weight(in_previous / 2.0, weight);
        chain.fixed(inclined * slide(0, self.a()));
        self.tilt(chain);
        if self.joint.motion == Motion::Prismatic {
            self.spring(chain);
        }
        chain.fixed(slide(2, self.d()));
        let previous_axis = rotation(&inclined).tr_mul(&Vector3::z());
        self.beam(chain, &chord, &previous_axis);
        if self.joint.motion == Motion::Revolute {
            self.spring(chain);
        }
        chain.fixed(turn(2, self.theta()));
    }

    fn tilt(&self, chain: &mut Chain) {
        let twice = 2.0 * self.value;
        let [x, y] = self.joint.wobble.map(|[cos, sin]| cos * twice.cos() + sin * twice.sin());
        if [x, y] != [0.0; 2] {
            chain.fixed(displaced(&Vector6::new(0.0, 0.0, 0.0, x, y, 0.0)));
        }
        if self.joint.tilt != [0.0; 2] {
            chain.site(&[3, 4], Law::Diagonal(self.joint.tilt.to_vec()));
        }
    }

    fn spring(&self, chain: &mut Chain) {
        let joint = self.joint;
        let [cos, sin] = joint.counterbalance;
        let mut gear = joint.gear.clone();
        gear.windup *= self.side;
        if gear == Gear::default() {
            return;
        }
        gear.preload = cos * self.value.cos() + sin * self.value.sin();
        let component = match joint.motion {
            Motion::Revolute => 5,
            Motion::Prismatic => 2,
        };
        chain.site(&[component], Law::Joint(gear));
    }

    /// A beam on a prismatic joint counts as weightless.
    fn beam_weight(&self, length: f64) -> Vector3<f64> {
        self.line_weight() * length
    }

    fn line_weight(&self) -> Vector3<f64> {
        match (&self.joint.beam, self.joint.motion) {
            (Some(beam), Motion::Revolute) => beam.line_density * self.gravity,
            _ => Vector3::zeros(),
        }
    }

    /// At the tip of the chord; `z` is the axis of the previous frame, in the axes of the chord.
    fn beam(&self, chain: &mut Chain, chord: &Vector3<f64>, z: &Vector3<f64>) {
        let length = chord.norm();
        let Some(beam) = self.joint.beam.filter(|_| length > 0.0) else { return };
        let along = chord / length;
        let across = z - along * along.dot(z);
        let third = if across.norm() > PARALLEL {
            across.normalize()
        } else {
            along.cross(&Vector3::x()).normalize()
        };
        let axes = Matrix3::from_columns(&[along, third.cross(&along), third]);
        let zero = Vector3::zeros();
        chain.fixed(from_parts(&axes, &zero));
        let weight = self.line_weight();
        chain.site(&[0, 1, 2, 3, 4, 5], Law::Beam { beam, length, weight });
        chain.fixed(from_parts(&axes.transpose(), &zero));
    }
}
