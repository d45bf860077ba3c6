//! One cantilever in its own axes: what a wrench at its tip and its own weight do to the tip.

use nalgebra::{Matrix6, Vector3, Vector6};

use super::arm::Beam;
use super::spatial::stack;

impl Beam {
    /// Transverse shear per unit of shear force and length, 1/(κGA); 0 for an Euler-Bernoulli beam.
    fn shear(&self) -> f64 {
        self.shear_coefficient.map_or(0.0, |kappa| 1.0 / (kappa * self.shear_modulus * self.area))
    }

    /// Flexibility of the tip of a cantilever of length `l`, 6×6, in beam axes: twist of the tip
    /// per wrench on the tip. Lin et al., eqs. 18, 20, 21; Bicchi and Melchiorri, eq. 5, where the
    /// axial entry must read L/EA, torsion L/GJ and bending L/EJ.
    ///
    /// A force along y bends the beam about z, turning the tip by +; a force along z bends it about
    /// y, turning the tip by −.
    pub(super) fn flexibility(&self, l: f64) -> Matrix6<f64> {
        self.by_powers([l, l.powi(2), l.powi(3)])
    }

    /// How the flexibility changes with the length.
    pub(super) fn flexibility_by_length(&self, l: f64) -> Matrix6<f64> {
        self.by_powers([1.0, 2.0 * l, 3.0 * l.powi(2)])
    }

    /// The flexibility by length, its square and its cube.
    fn by_powers(&self, [l, l2, l3]: [f64; 3]) -> Matrix6<f64> {
        let (ea, gj) = (self.youngs_modulus * self.area, self.shear_modulus * self.j);
        let (eiy, eiz) = (self.youngs_modulus * self.iy, self.youngs_modulus * self.iz);
        let bend = |ei: f64| l3 / (3.0 * ei) + l * self.shear();
        let slope = |ei: f64| l2 / (2.0 * ei);
        let turn = |ei: f64| l / ei;
        #[rustfmt::skip]
        let flexibility = Matrix6::new(
            l / ea, 0.0,        0.0,         0.0,    0.0,         0.0,
            0.0,    bend(eiz),  0.0,         0.0,    0.0,         slope(eiz),
            0.0,    0.0,        bend(eiy),   0.0,    -slope(eiy), 0.0,
            0.0,    0.0,        0.0,         l / gj, 0.0,         0.0,
            0.0,    0.0,        -slope(eiy), 0.0,    turn(eiy),   0.0,
            0.0,    slope(eiz), 0.0,         0.0,    0.0,         turn(eiz),
        );
        flexibility
    }

    /// Twist of the tip of a cantilever of length `l` under a load spread evenly along it, `load`
    /// per unit length, in beam axes: wL⁴/8EI (Lin et al., eq. 19), its slope wL³/6EI, wL²/2EA
    /// along the beam and wL²/2κGA of shear.
    pub(super) fn spread_load_twist(&self, l: f64, load: &Vector3<f64>) -> Vector6<f64> {
        let ea = self.youngs_modulus * self.area;
        let (eiy, eiz) = (self.youngs_modulus * self.iy, self.youngs_modulus * self.iz);
        let (l2, l3, l4) = (l.powi(2), l.powi(3), l.powi(4));
        let shear = l2 * self.shear() / 2.0;
        let translation = Vector3::new(
            load.x * l2 / (2.0 * ea),
            load.y * (l4 / (8.0 * eiz) + shear),
            load.z * (l4 / (8.0 * eiy) + shear),
        );
        let rotation = Vector3::new(0.0, -load.z * l3 / (6.0 * eiy), load.y * l3 / (6.0 * eiz));
        stack(translation, rotation)
    }
}
