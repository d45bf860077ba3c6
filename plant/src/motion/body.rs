//! The links in motion: forces and moments by recursion, in axes of their own (Luh, Walker & Paul 1980).
//!
//! Each joint has a frame that moves with it, its axis along z: `J_i = J_{i−1} · A_i · Z(q_i)`, with `A_i`
//! all of the table that stands between two joints. Velocities and accelerations go up from the base,
//! which is thrown against gravity; forces and moments come down.

use nalgebra::{DMatrix, Matrix3, Matrix4, Vector3};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Convention};

use super::super::transform::{self, from_parts, origin, rotation, slide, turn};

/// The moments of mass of a rigid piece: its mass, the first about the origin of a frame, and the
/// tensor of the second about it, in that frame's axes.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub(super) mass: f64,
    pub(super) first: Vector3<f64>,
    pub(super) second: Matrix3<f64>,
}

impl Piece {
    /// Of a centre of mass and the tensor about it.
    pub(super) fn about(mass: f64, centre: Vector3<f64>, inertia: Matrix3<f64>) -> Piece {
        let away = Matrix3::identity() * centre.norm_squared() - centre * centre.transpose();
        Piece { mass, first: mass * centre, second: inertia + mass * away }
    }

    /// Told in the frame in which `frame` stands.
    fn moved(&self, frame: &Matrix4<f64>) -> Piece {
        let (axes, at) = (rotation(frame), origin(frame));
        let first = axes * self.first;
        let away = |a: &Vector3<f64>, b: &Vector3<f64>| {
            Matrix3::identity() * a.dot(b) - 0.5 * (a * b.transpose() + b * a.transpose())
        };
        Piece {
            mass: self.mass,
            first: first + self.mass * at,
            second: axes * self.second * axes.transpose()
                + 2.0 * away(&at, &first)
                + self.mass * away(&at, &at),
        }
    }
}

/// A product by rows: nalgebra's is by columns, in a function of its own, and takes several times as long.
fn times(matrix: &Matrix3<f64>, v: &Vector3<f64>) -> Vector3<f64> {
    Vector3::from_fn(|row, _| {
        matrix[(row, 0)] * v.x + matrix[(row, 1)] * v.y + matrix[(row, 2)] * v.z
    })
}

/// What a joint carries.
#[derive(Clone, Debug)]
struct Link {
    motion: Motion,
    /// How the joint frame stands at zero in the one before, or the base: its axes and origin.
    place: (Matrix3<f64>, Vector3<f64>),
    pieces: Vec<Piece>,
}

/// All links of an arm.
#[derive(Clone, Debug)]
pub(super) struct Body {
    links: Vec<Link>,
    /// Of row frames, in the frames of their joints.
    rows: Vec<Matrix4<f64>>,
    /// Tool frame, in the last joint's.
    tool: Matrix4<f64>,
}

/// The arm in a posture: how each joint frame stands in the one before.
pub(super) struct Posture(Vec<(Matrix3<f64>, Vector3<f64>)>);

impl Body {
    /// Of a robot file's table.
    pub(super) fn of(arm: &Arm) -> Body {
        let mut body = Body { links: Vec::new(), rows: Vec::new(), tool: Matrix4::identity() };
        let mut before = Matrix4::identity();
        for joint in &arm.joints {
            let inclined = turn(0, joint.alpha) * turn(1, joint.beta);
            let zero = turn(2, joint.theta) * slide(2, joint.d);
            let (ahead, behind) = match arm.convention {
                Convention::Standard => (Matrix4::identity(), zero * slide(0, joint.a) * inclined),
                Convention::Modified => (inclined * slide(0, joint.a), zero),
            };
            let frame = before * ahead;
            let place = (rotation(&frame), origin(&frame));
            body.links.push(Link { motion: joint.motion, place, pieces: Vec::new() });
            body.rows.push(behind);
            before = behind;
            body.add(body.rows.len() - 1, &Piece::about(joint.mass, joint.com, joint.inertia));
            if let (Some(beam), Motion::Revolute) = (&joint.beam, joint.motion) {
                let chord = Vector3::new(joint.a, 0.0, joint.d);
                body.rod(arm.convention, &inclined, chord, beam.density * beam.area);
            }
        }
        body.tool = before * transform::of(&arm.tool);
        body
    }

    /// Hangs a piece on a link; in the row's frame.
    pub(super) fn add(&mut self, link: usize, piece: &Piece) {
        self.links[link].pieces.push(piece.moved(&self.rows[link]));
    }

    /// Hangs a piece on the tool; in its frame.
    pub(super) fn grip(&mut self, piece: &Piece) {
        let last = self.links.len() - 1;
        self.links[last].pieces.push(piece.moved(&self.tool));
    }

    /// The beam of the last row as a thin rod; of the modified convention the link before carries it.
    fn rod(
        &mut self,
        convention: Convention,
        inclined: &Matrix4<f64>,
        chord: Vector3<f64>,
        density: f64,
    ) {
        let (length, last) = (chord.norm(), self.links.len() - 1);
        if length == 0.0 || density == 0.0 {
            return;
        }
        let theta = |frame: &Matrix4<f64>| from_parts(&rotation(frame), &Vector3::zeros());
        let (link, frame) = match convention {
            // Behind the turn about z, before that about x.
            Convention::Standard => {
                (last, theta(&(self.rows[last] * transform::inverse(inclined))))
            }
            Convention::Modified if last == 0 => return,
            Convention::Modified => (last - 1, self.rows[last - 1] * inclined),
        };
        let along = chord / length;
        let (mass, across) = (density * length, Matrix3::identity() - along * along.transpose());
        let rod = Piece::about(mass, chord / 2.0, across * (mass * length * length / 12.0));
        self.links[link].pieces.push(rod.moved(&frame));
    }

    /// Where the joints are.
    pub(super) fn posture(&self, q: &[f64]) -> Posture {
        let stands = |(link, q): (&Link, &f64)| {
            let (axes, place) = link.place;
            let [x, y, z] = [0, 1, 2].map(|k| axes.column(k).into_owned());
            match link.motion {
                Motion::Revolute => {
                    let (sine, cosine) = q.sin_cos();
                    let turned = [x * cosine + y * sine, y * cosine - x * sine, z];
                    (Matrix3::from_columns(&turned), place)
                }
                Motion::Prismatic => (axes, place + z * *q),
            }
        };
        Posture(self.links.iter().zip(q).map(stands).collect())
    }

    /// Without any mass.
    pub(super) fn bare(mut self) -> Body {
        self.links.iter_mut().for_each(|link| link.pieces.clear());
        self
    }

    /// What the links ask of each joint, N·m or N; gravity in the axes of the base.
    pub(super) fn torques(
        &self,
        posture: &Posture,
        qd: &[f64],
        qdd: &[f64],
        gravity: &Vector3<f64>,
    ) -> Vec<f64> {
        let z = Vector3::z();
        let (mut spin, mut spun, mut thrown) = (Vector3::zeros(), Vector3::zeros(), -gravity);
        let mut loads = Vec::with_capacity(self.links.len());
        for (k, link) in self.links.iter().enumerate() {
            let (axes, place) = &posture.0[k];
            thrown = axes.tr_mul(&(thrown + spun.cross(place) + spin.cross(&spin.cross(place))));
            (spin, spun) = (axes.tr_mul(&spin), axes.tr_mul(&spun));
            match link.motion {
                Motion::Revolute => {
                    spun += spin.cross(&z) * qd[k] + z * qdd[k];
                    spin += z * qd[k];
                }
                Motion::Prismatic => thrown += 2.0 * spin.cross(&z) * qd[k] + z * qdd[k],
            }
            let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
            for Piece { mass, first, second } in &link.pieces {
                force += *mass * thrown + spun.cross(first) + spin.cross(&spin.cross(first));
                moment += times(second, &spun) + spin.cross(&times(second, &spin));
                moment += first.cross(&thrown);
            }
            loads.push((force, moment));
        }
        let mut torques = vec![0.0; self.links.len()];
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for (k, link) in self.links.iter().enumerate().rev() {
            force += loads[k].0;
            moment += loads[k].1;
            torques[k] = match link.motion {
                Motion::Revolute => moment.z,
                Motion::Prismatic => force.z,
            };
            let (axes, place) = &posture.0[k];
            force = times(axes, &force);
            moment = times(axes, &moment) + place.cross(&force);
        }
        torques
    }

    /// What each joint feels of each other's acceleration, without rotors.
    pub(super) fn masses(&self, posture: &Posture) -> DMatrix<f64> {
        let n = self.links.len();
        let (still, nothing) = (vec![0.0; n], Vector3::zeros());
        let mut masses = DMatrix::zeros(n, n);
        let mut one = still.clone();
        for k in 0..n {
            one[k] = 1.0;
            masses.column_mut(k).copy_from_slice(&self.torques(posture, &still, &one, &nothing));
            one[k] = 0.0;
        }
        masses
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Rng, Stream};

    /// Both conventions, tilted axes, a joint that slides, beams with weight, inertias at random.
    fn arms() -> Vec<Arm> {
        let mut rng = Rng::new(5, Stream::Arm);
        let mut of = |convention, slides: usize| {
            let mut arm = crate::fixture::bent();
            arm.convention = convention;
            for (k, joint) in arm.joints.iter_mut().enumerate() {
                let root = Matrix3::from_fn(|_, _| rng.normal());
                joint.inertia = root * root.transpose();
                joint.com = rng.normal3() / 3.0;
                (joint.beta, joint.theta) = (0.3 * rng.normal(), rng.normal());
                joint.motion = if k == slides { Motion::Prismatic } else { Motion::Revolute };
                joint.beam.iter_mut().for_each(|beam| beam.density = 2700.0);
            }
            arm
        };
        let conventions = [Convention::Standard, Convention::Modified];
        conventions.into_iter().flat_map(|c| [0, 1, 2, 9].map(|slides| of(c, slides))).collect()
    }

    /// The kernels' textbook is another program: base axes, another recursion. Rounding of some
    /// hundred sums of terms of up to a few thousand newton metres.
    #[test]
    fn torques_and_masses_are_the_textbooks() {
        let mut rng = Rng::new(3, Stream::Poses);
        for arm in arms() {
            let body = Body::of(&arm);
            for _ in 0..50 {
                let mut draw = || (0..3).map(|_| rng.normal()).collect::<Vec<f64>>();
                let [q, qd, qdd] = [draw(), draw(), draw()];
                let expected = arm.inverse_dynamics(&q, &qd, &qdd);
                let posture = body.posture(&q);
                let found = body.torques(&posture, &qd, &qdd, &arm.gravity);
                for (found, expected) in found.iter().zip(expected.iter()) {
                    assert!((found - expected).abs() < 1e-10, "{arm:?}: {found} {expected}");
                }
                let off = body.masses(&posture) - arm.mass_matrix(&q);
                assert!(off.amax() < 1e-10, "{arm:?}: {off}");
            }
        }
    }
}
