//! How the numbers of an orientation are written, and the rotation vector that they are.

use core::fmt;

use nalgebra::{Matrix3, Quaternion, Rotation3, Unit, UnitQuaternion, Vector3};
use serde::Deserialize;

use super::mistake::Fault;

/// How an orientation of the tool in the base frame is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub enum Convention {
    /// Axis times angle.
    RotationVector,
    /// Three turns.
    Euler(Euler),
    /// `w x y z`, of any length but zero.
    Quaternion,
    /// Nine entries, row by row.
    Matrix,
}

/// Three turns, one after the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Euler {
    /// About which axis each is, in the order of its numbers: 0 is x.
    pub axes: [usize; 3],
    /// About the axes of the base, which stand, and not about the tool's as they turn.
    pub fixed: bool,
}

/// The names of the axes.
const AXES: [char; 3] = ['x', 'y', 'z'];

/// A matrix whose columns are unit vectors to this is a rotation that was rounded: three decimals.
const ROUNDED: f64 = 2e-3;

impl Convention {
    /// `Rz(a) Ry(b) Rx(c)`: KUKA's A, B, C.
    pub const ABC: Convention = Convention::moving([2, 1, 0]);
    /// `Rz(yaw) Ry(pitch) Rx(roll)`, roll first: URDF's; FANUC's W, P, R.
    pub const RPY: Convention = Convention::Euler(Euler { axes: [0, 1, 2], fixed: true });

    const fn moving(axes: [usize; 3]) -> Convention {
        Convention::Euler(Euler { axes, fixed: false })
    }

    /// All turns about three axes that are another orientation than each other.
    pub fn turns() -> impl Iterator<Item = Convention> {
        let axes = (0..27).map(|k| [k / 9, k / 3 % 3, k % 3]);
        let sound = axes.filter(|[a, b, c]| a != b && b != c);
        sound.flat_map(|axes| [false, true].map(|fixed| Convention::Euler(Euler { axes, fixed })))
    }

    /// Of its name in a map or in a comment.
    ///
    /// # Errors
    /// [`Fault`]: no such convention.
    pub fn named(name: &str) -> Result<Convention, Fault> {
        let none = || {
            let expected = "rotation_vector, quaternion, matrix, abc, rpy, or three letters of x, y, z \
                            such as `zyx` (about the tool's axes as they turn, the first number \
                            first) or `fixed_xyz` (about the base's axes)";
            Fault::new(format!("`orientation = \"{name}\"`"), expected, "")
        };
        match name {
            "rotation_vector" => return Ok(Convention::RotationVector),
            "quaternion" => return Ok(Convention::Quaternion),
            "matrix" => return Ok(Convention::Matrix),
            "abc" => return Ok(Convention::ABC),
            "rpy" => return Ok(Convention::RPY),
            _ => {}
        }
        let (fixed, letters) =
            name.strip_prefix("fixed_").map_or((false, name), |letters| (true, letters));
        let axes = letters.chars().map(|c| AXES.iter().position(|axis| *axis == c));
        let axes: Vec<usize> = axes.collect::<Option<_>>().ok_or_else(none)?;
        match axes[..] {
            [a, b, c] if a != b && b != c => {
                Ok(Convention::Euler(Euler { axes: [a, b, c], fixed }))
            }
            _ => Err(none()),
        }
    }

    /// How many numbers it has.
    pub fn numbers(self) -> usize {
        match self {
            Convention::RotationVector | Convention::Euler(_) => 3,
            Convention::Quaternion => 4,
            Convention::Matrix => 9,
        }
    }

    /// Whether its numbers are angles.
    pub fn has_angles(self) -> bool {
        !matches!(self, Convention::Quaternion | Convention::Matrix)
    }

    /// Its three angles in its order, of those that bear the names of x, y and z: the angle about each axis
    /// where all three are turned about, else the first, second and third.
    pub fn ordered<T: Clone>(self, of_axes: [T; 3]) -> [T; 3] {
        match self {
            Convention::Euler(Euler { axes, .. }) if axes[0] != axes[2] => {
                axes.map(|axis| of_axes[axis].clone())
            }
            _ => of_axes,
        }
    }

    /// As a formula of its numbers.
    pub fn formula(self, numbers: &[&str]) -> String {
        match self {
            Convention::RotationVector => "a rotation vector".to_owned(),
            Convention::Quaternion => "a quaternion w, x, y, z".to_owned(),
            Convention::Matrix => "a matrix, row by row".to_owned(),
            Convention::Euler(Euler { axes, fixed }) => {
                let turn = |(axis, number): (usize, &&str)| format!("R{}({number})", AXES[axis]);
                let mut turns: Vec<String> = axes.into_iter().zip(numbers).map(turn).collect();
                if fixed {
                    turns.reverse();
                }
                turns.join(" ")
            }
        }
    }

    /// The rotation vector of its numbers, rad; `None` of what is no rotation.
    pub fn rotation(self, n: &[f64]) -> Option<Vector3<f64>> {
        match self {
            Convention::RotationVector => Some(Vector3::new(n[0], n[1], n[2])),
            Convention::Euler(Euler { axes, fixed }) => {
                let units = [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()];
                let turn = |k: usize| UnitQuaternion::from_axis_angle(&units[axes[k]], n[k]);
                let [a, b, c] = [0, 1, 2].map(turn);
                Some(if fixed { c * b * a } else { a * b * c }.scaled_axis())
            }
            Convention::Quaternion => {
                let length = n.iter().fold(0.0_f64, |a, b| a.hypot(*b));
                let sound = length > 0.0 && length.is_finite();
                let q = Quaternion::new(n[0], n[1], n[2], n[3]);
                sound.then(|| Unit::new_normalize(q).scaled_axis())
            }
            Convention::Matrix => {
                let matrix = Matrix3::from_row_slice(n);
                let off = (matrix.transpose() * matrix - Matrix3::identity()).amax();
                let sound = off <= 2.0 * ROUNDED && matrix.determinant() > 0.0;
                sound.then(|| Rotation3::from_matrix(&matrix).scaled_axis())
            }
        }
    }
}

impl TryFrom<String> for Convention {
    type Error = String;

    fn try_from(name: String) -> Result<Convention, String> {
        Convention::named(&name).map_err(|fault| fault.to_string())
    }
}

impl fmt::Display for Convention {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Convention::RotationVector => f.write_str("rotation_vector"),
            Convention::Quaternion => f.write_str("quaternion"),
            Convention::Matrix => f.write_str("matrix"),
            Convention::Euler(Euler { axes, fixed }) => {
                f.write_str(if *fixed { "fixed_" } else { "" })?;
                axes.iter().try_for_each(|axis| write!(f, "{}", AXES[*axis]))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_come_back() {
        let all = [Convention::RotationVector, Convention::Quaternion, Convention::Matrix];
        for convention in Convention::turns().chain(all) {
            assert_eq!(Convention::named(&convention.to_string()), Ok(convention));
        }
        assert_eq!(Convention::turns().count(), 24);
        for (name, same) in [("abc", "zyx"), ("rpy", "fixed_xyz"), ("zyz", "zyz")] {
            assert_eq!(Convention::named(name), Convention::named(same));
        }
        for none in ["", "zz", "zzy", "xyzx", "XYZ", "fixed_", "euler", "fixed_xxy"] {
            assert!(Convention::named(none).is_err(), "{none}");
        }
    }

    /// Entry by entry, as the matrices of the textbooks have them.
    #[test]
    fn turns_are_products_of_matrices() {
        let about = |axis: usize, t: f64| {
            let (s, c) = t.sin_cos();
            let [x, y, z] = [
                Matrix3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c),
                Matrix3::new(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c),
                Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0),
            ];
            [x, y, z][axis]
        };
        let n = [0.4, -0.7, 1.1];
        let rotated = |of: Convention, n: &[f64]| Rotation3::new(of.rotation(n).unwrap());
        for convention in Convention::turns() {
            let Convention::Euler(Euler { axes, fixed }) = convention else { unreachable!() };
            let [a, b, c] = [0, 1, 2].map(|k| about(axes[k], n[k]));
            let expected = if fixed { c * b * a } else { a * b * c };
            let found = rotated(convention, &n);
            assert!((found.matrix() - expected).amax() < 1e-14, "{convention}");
            let rows: Vec<f64> = expected.transpose().iter().copied().collect();
            let by_entries = rotated(Convention::Matrix, &rows);
            assert!((by_entries.matrix() - expected).amax() < 1e-12);
            let q = UnitQuaternion::from_rotation_matrix(&found);
            let again = rotated(Convention::Quaternion, &[q.w, q.i, q.j, q.k].map(|x| -3.0 * x));
            assert!((again.matrix() - expected).amax() < 1e-14);
        }
        assert_eq!(Convention::Matrix.rotation(&[1.0; 9]), None);
        let mirrored = [-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        assert_eq!(Convention::Matrix.rotation(&mirrored), None);
        assert_eq!(Convention::Quaternion.rotation(&[0.0; 4]), None);
        assert_eq!(Convention::RPY.formula(&["r", "p", "y"]), "Rz(y) Ry(p) Rx(r)");
        assert_eq!(Convention::ABC.formula(&["A", "B", "C"]), "Rz(A) Ry(B) Rx(C)");
        // An angle that bears the name of an axis is the one about it.
        assert_eq!(Convention::ABC.ordered(["x", "y", "z"]), ["z", "y", "x"]);
        assert_eq!(Convention::RPY.ordered(["x", "y", "z"]), ["x", "y", "z"]);
        assert_eq!(Convention::named("zyz").unwrap().ordered([1, 2, 3]), [1, 2, 3]);
    }
}
