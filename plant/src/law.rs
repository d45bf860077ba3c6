//! What yields, and how far: from generalised forces to displacements.

use nalgebra::{DMatrix, Matrix3, Matrix6, Vector3, Vector6};

use super::reality::RealBeam;

/// What a joint's drive makes of a torque; all zero is rigid.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Gear {
    pub(super) compliance: f64,
    pub(super) cubic: f64,
    /// In a row with the direction's sign.
    pub(super) windup: f64,
    /// Width of the clearance across which the torque pushes.
    pub(super) play: f64,
    /// Torques, N·m, up to which it gives so much more.
    pub(super) zones: Vec<(f64, f64)>,
    /// What is added to the torque.
    pub(super) preload: f64,
}

/// Half a unit of torque to either side the drive floats from flank to flank.
const ACROSS: f64 = 2.0;

impl Gear {
    /// `compliance·τ + cubic·τ³ − windup·|τ|` and clearance and zones, piece by piece.
    fn twist(&self, torque: f64) -> f64 {
        let torque = torque + self.preload;
        let (size, side) = (torque.abs(), if torque < 0.0 { -1.0 } else { 1.0 });
        let across = if size < ACROSS / 2.0 { size / ACROSS } else { 0.5 };
        let zone = |(ends, more): &(f64, f64)| more * if size < *ends { size } else { *ends };
        let odd = self.compliance * size
            + self.cubic * size.powi(3)
            + self.play * across
            + self.zones.iter().map(zone).sum::<f64>();
        side * odd - self.windup * size
    }

    /// Its derivative.
    fn slope(&self, torque: f64) -> f64 {
        let torque = torque + self.preload;
        let (size, sign) = (torque.abs(), if torque == 0.0 { 0.0 } else { torque.signum() });
        let across = if size < ACROSS / 2.0 { self.play / ACROSS } else { 0.0 };
        let zones = self.zones.iter().filter(|(ends, _)| size < *ends).map(|(_, more)| more);
        self.compliance + 3.0 * self.cubic * size * size + across + zones.sum::<f64>()
            - self.windup * sign
    }
}

/// How a site's displacement follows from its generalised forces.
#[derive(Clone, Debug)]
pub(super) enum Law {
    /// A joint.
    Joint(Gear),
    /// Each component by itself.
    Diagonal(Vec<f64>),
    /// A cantilever, and its weight in base axes, N/m.
    Beam { beam: RealBeam, length: f64, weight: Vector3<f64> },
}

impl Law {
    /// The displacement under the forces; `axes` is where the site's axes point.
    pub(super) fn displacement(&self, forces: &[f64], axes: &Matrix3<f64>) -> Vec<f64> {
        match self {
            Law::Joint(gear) => vec![gear.twist(forces[0])],
            Law::Diagonal(compliances) => {
                compliances.iter().zip(forces).map(|(c, force)| c * force).collect()
            }
            Law::Beam { beam, length, weight } => {
                let tip = tip_flexibility(beam, *length) * Vector6::from_row_slice(forces);
                let own = own_weight(beam, *length, &(axes.transpose() * weight));
                (tip + own).as_slice().to_vec()
            }
        }
    }

    /// Its derivative by the forces, at the forces.
    pub(super) fn slope(&self, forces: &[f64]) -> DMatrix<f64> {
        match self {
            Law::Joint(gear) => DMatrix::from_element(1, 1, gear.slope(forces[0])),
            _ => self.flexibility(),
        }
    }

    /// The elastic and linear part.
    pub(super) fn flexibility(&self) -> DMatrix<f64> {
        match self {
            Law::Joint(gear) => DMatrix::from_element(1, 1, gear.compliance),
            Law::Diagonal(compliances) => {
                DMatrix::from_diagonal(&nalgebra::DVector::from_row_slice(compliances))
            }
            Law::Beam { beam, length, .. } => {
                let tip = tip_flexibility(beam, *length);
                DMatrix::from_fn(6, 6, |r, c| tip[(r, c)])
            }
        }
    }
}

/// How a cantilever's tip moves, found by summing what the bending moment of each slice turns the
/// tip by: `∫ m(x)·m̄(x)/EI dx` of the tip's unit loads (the unit-load method). The moments are
/// linear in x, so that Simpson's rule is exact.
fn tip_flexibility(beam: &RealBeam, length: f64) -> Matrix6<f64> {
    let mut tip = Matrix6::zeros();
    for (x, weight) in simpson(length) {
        let arm = length - x;
        // Moments about y and z, and torsion, of the six unit loads at the tip.
        let about_y = Vector6::new(0.0, 0.0, -arm, 0.0, 1.0, 0.0);
        let about_z = Vector6::new(0.0, arm, 0.0, 0.0, 0.0, 1.0);
        tip += weight
            * (beam.bend_y * about_y * about_y.transpose()
                + beam.bend_z * about_z * about_z.transpose());
    }
    tip[(0, 0)] += length * beam.stretch;
    tip[(1, 1)] += length * beam.shear;
    tip[(2, 2)] += length * beam.shear;
    tip[(3, 3)] += length * beam.torsion;
    tip
}

/// How the tip moves under a load spread along the beam, N/m in beam axes, by the same method. The
/// load's moment is quadratic in x and the product cubic: Simpson's rule is still exact.
fn own_weight(beam: &RealBeam, length: f64, load: &Vector3<f64>) -> Vector6<f64> {
    let mut tip = Vector6::zeros();
    for (x, weight) in simpson(length) {
        let arm = length - x;
        let half = arm * arm / 2.0;
        let about_y = Vector6::new(0.0, 0.0, -arm, 0.0, 1.0, 0.0);
        let about_z = Vector6::new(0.0, arm, 0.0, 0.0, 0.0, 1.0);
        tip += weight
            * (beam.bend_y * about_y * (-half * load.z) + beam.bend_z * about_z * (half * load.y));
        // Axial and shear force of what lies beyond.
        tip += weight
            * arm
            * Vector6::new(
                beam.stretch * load.x,
                beam.shear * load.y,
                beam.shear * load.z,
                0.0,
                0.0,
                0.0,
            );
    }
    tip
}

/// Nodes and weights of Simpson's rule from 0 to `length`.
fn simpson(length: f64) -> [(f64, f64); 3] {
    [(0.0, length / 6.0), (length / 2.0, length * 4.0 / 6.0), (length, length / 6.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    const BEAM: RealBeam = RealBeam {
        stretch: 2e-9,
        shear: 3e-9,
        torsion: 4e-6,
        bend_y: 5e-6,
        bend_z: 7e-6,
        line_density: 0.0,
    };

    /// Relative to what the tables of cantilevers say.
    fn same(found: f64, printed: f64) {
        assert!((found - printed).abs() <= 1e-15 * printed.abs(), "{found:e} {printed:e}");
    }

    #[test]
    fn a_cantilever_is_the_handbooks() {
        let l = 0.7_f64;
        let tip = tip_flexibility(&BEAM, l);
        same(tip[(0, 0)], l * 2e-9);
        same(tip[(1, 1)], l.powi(3) / 3.0 * 7e-6 + l * 3e-9);
        same(tip[(5, 1)], l.powi(2) / 2.0 * 7e-6);
        same(tip[(5, 5)], l * 7e-6);
        same(tip[(2, 2)], l.powi(3) / 3.0 * 5e-6 + l * 3e-9);
        same(tip[(4, 2)], -l.powi(2) / 2.0 * 5e-6);
        same(tip[(3, 3)], l * 4e-6);
        assert_eq!(tip, tip.transpose());
    }

    #[test]
    fn a_spread_load_is_the_handbooks() {
        let (l, w) = (0.7_f64, Vector3::new(30.0, 20.0, -50.0));
        let tip = own_weight(&BEAM, l, &w);
        same(tip[0], w.x * l.powi(2) / 2.0 * 2e-9);
        same(tip[1], w.y * (l.powi(4) / 8.0 * 7e-6 + l.powi(2) / 2.0 * 3e-9));
        same(tip[2], w.z * (l.powi(4) / 8.0 * 5e-6 + l.powi(2) / 2.0 * 3e-9));
        same(tip[4], -w.z * l.powi(3) / 6.0 * 5e-6);
        same(tip[5], w.y * l.powi(3) / 6.0 * 7e-6);
    }

    #[test]
    fn the_slope_is_the_derivative() {
        let gear = Gear {
            compliance: 2e-6,
            cubic: -3e-12,
            windup: 1e-7,
            play: 3e-4,
            zones: vec![(50.0, 4e-6), (100.0, 1e-6)],
            preload: -7.0,
        };
        let law = Law::Joint(gear);
        let at = |torque: f64| law.displacement(&[torque], &Matrix3::identity())[0];
        for torque in [-120.0, -30.0, 6.7, 7.4, 20.0, 80.0] {
            let difference = (at(torque + 0.01) - at(torque - 0.01)) / 0.02;
            assert!((difference - law.slope(&[torque])[(0, 0)]).abs() < 1e-13);
        }
    }
}
