//! A camera's lens: where it shows a place that stands in front of it.
//!
//! OpenCV's model, with its names and order: a pinhole `fx fy cx cy` behind a distortion of up to eight numbers
//! `k1 k2 p1 p2 k3 k4 k5 k6` (radial as a quotient of polynomials, and tangential; Brown 1971). Axes: x to the
//! right of the picture, y down, z to what is seen.
//!
//! What is shown is told in parts of the focal length, so that it is nearly an angle: a pixel of a camera of 1,000
//! pixels' focal length is a milliradian.

use nalgebra::{Matrix2, Matrix2x3, SMatrix, Vector2, Vector3};

/// Constants of a lens.
pub(crate) const CONSTANTS: usize = 12;

/// Their names.
pub(crate) const NAMES: [&str; CONSTANTS] =
    ["fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"];

/// Those of the matrix; the others are of the distortion.
pub(crate) const OF_MATRIX: usize = 4;

/// Standard deviations of constants that are fitted along about what was told: of the matrix in parts of the focal
/// length, of the distortion. Some hundred pictures' corners say more; they keep a fit of few from running off.
const NEAR_MATRIX: f64 = 0.05;
const NEAR_DISTORTION: f64 = 0.3;

/// What lies behind the camera, or beside it, is shown as if it were this part of its distance in front.
const LEAST_DEPTH: f64 = 1e-3;

/// Steps of Newton's method that take a distortion back, and the size of the last one.
const STEPS: usize = 50;
const LAST: f64 = 1e-15;

/// A lens. Where it shows a place is told in parts of [`Lens::focus`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Pixels in one part: the mean focal length as it was told, and never changed.
    pub focus: f64,
    /// The matrix in these parts, then the distortion.
    constants: [f64; CONSTANTS],
    /// The distortion as it was told, where these are a first guess: nothing holds the matrix but what is seen.
    beside_guess: Option<[f64; CONSTANTS - OF_MATRIX]>,
}

/// What is seen, by place and by constants.
struct Slopes {
    by_direction: Matrix2<f64>,
    by_constants: SMatrix<f64, 2, CONSTANTS>,
}

impl Lens {
    /// By its matrix `fx fy cx cy`, px, the first two above 0, and its distortion; the numbers that are not there are
    /// 0.
    pub fn new(matrix: [f64; OF_MATRIX], distortion: &[f64]) -> Lens {
        let focus = f64::midpoint(matrix[0], matrix[1]);
        let mut constants = [0.0; CONSTANTS];
        let scaled = matrix.iter().map(|x| x / focus).chain(distortion.iter().copied());
        constants.iter_mut().zip(scaled).for_each(|(to, from)| *to = from);
        Lens { focus, constants, beside_guess: None }
    }

    /// The same where the matrix is a first guess.
    pub(super) fn guessed(matrix: [f64; OF_MATRIX], distortion: &[f64]) -> Lens {
        let lens = Lens::new(matrix, distortion);
        let [_, _, _, _, told @ ..] = lens.constants;
        Lens { beside_guess: Some(told), ..lens }
    }

    /// A constant as it is told: of the matrix in pixels.
    pub fn constant(&self, number: usize) -> f64 {
        self.constants[number] * self.unit(number)
    }

    /// How far a constant is from what it is near, over a standard deviation that is rough on purpose: a data sheet's
    /// focal length is right to some hundredths, and a distortion is a few tenths at the most. A guess holds nothing.
    pub fn strayed(&self, told: &Lens, number: usize) -> Option<(f64, f64)> {
        let (near, told) = match (number.checked_sub(OF_MATRIX), told.beside_guess) {
            (None, Some(_)) => return None,
            (None, None) => (NEAR_MATRIX, told.constants[number]),
            (Some(k), Some(distortion)) => (NEAR_DISTORTION, distortion[k]),
            (Some(_), None) => (NEAR_DISTORTION, told.constants[number]),
        };
        Some(((told - self.constants[number]) / near, 1.0 / near))
    }

    /// Of a constant's own unit in that in which it is told.
    pub fn unit(&self, number: usize) -> f64 {
        if number < OF_MATRIX { self.focus } else { 1.0 }
    }

    /// Where it shows a place, camera's axes.
    pub fn shows(&self, place: &Vector3<f64>) -> Vector2<f64> {
        let (direction, _) = direction(place);
        self.image(&direction)
    }

    /// By how much that changes with the place, and with each constant.
    pub(crate) fn slopes(
        &self,
        place: &Vector3<f64>,
    ) -> (Matrix2x3<f64>, SMatrix<f64, 2, CONSTANTS>) {
        let (direction, by_place) = direction(place);
        let slopes = self.of_direction(&direction);
        (slopes.by_direction * by_place, slopes.by_constants)
    }

    /// The direction `x/z, y/z` in which it shows something there, by Newton's method.
    pub fn direction(&self, image: &Vector2<f64>) -> Vector2<f64> {
        let [fx, fy, cx, cy, ..] = self.constants;
        let mut found = Vector2::new((image.x - cx) / fx, (image.y - cy) / fy);
        for _ in 0..STEPS {
            let off = self.image(&found) - image;
            let step =
                self.of_direction(&found).by_direction.try_inverse().map(|inverse| inverse * off);
            let Some(step) = step.filter(|step| step.amax() > LAST) else { break };
            found -= step;
        }
        found
    }

    /// With its constants moved, each in its own unit.
    pub fn moved(self, by: &[f64]) -> Lens {
        let mut constants = self.constants;
        constants.iter_mut().zip(by).for_each(|(constant, by)| *constant += by);
        Lens { constants, ..self }
    }

    fn image(&self, direction: &Vector2<f64>) -> Vector2<f64> {
        let [fx, fy, cx, cy, _, _, p1, p2, ..] = self.constants;
        let (x, y) = (direction.x, direction.y);
        let square = direction.norm_squared();
        let (above, below) = self.radial(square);
        let radial = above / below;
        let xx = x * radial + 2.0 * p1 * x * y + p2 * (square + 2.0 * x * x);
        let yy = y * radial + p1 * (square + 2.0 * y * y) + 2.0 * p2 * x * y;
        Vector2::new(fx * xx + cx, fy * yy + cy)
    }

    /// The radial factor as a quotient.
    fn radial(&self, square: f64) -> (f64, f64) {
        let [.., k1, k2, _, _, k3, k4, k5, k6] = self.constants;
        let of = |a: f64, b: f64, c: f64| 1.0 + square * (a + square * (b + square * c));
        (of(k1, k2, k3), of(k4, k5, k6))
    }

    fn of_direction(&self, direction: &Vector2<f64>) -> Slopes {
        let [fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6] = self.constants;
        let (x, y) = (direction.x, direction.y);
        let square = direction.norm_squared();
        let (above, below) = self.radial(square);
        let radial = above / below;
        let slope = |a: f64, b: f64, c: f64| a + square * (2.0 * b + square * 3.0 * c);
        let by_square = (slope(k1, k2, k3) - radial * slope(k4, k5, k6)) / below;
        let across = 2.0 * x * y * by_square + 2.0 * p1 * x + 2.0 * p2 * y;
        let by_direction = Matrix2::new(
            fx * (radial + 2.0 * x * x * by_square + 2.0 * p1 * y + 6.0 * p2 * x),
            fx * across,
            fy * across,
            fy * (radial + 2.0 * y * y * by_square + 6.0 * p1 * y + 2.0 * p2 * x),
        );
        let image = self.image(direction);
        let mut by_constants = SMatrix::zeros();
        by_constants[(0, 0)] = (image.x - cx) / fx;
        by_constants[(1, 1)] = (image.y - cy) / fy;
        by_constants[(0, 2)] = 1.0;
        by_constants[(1, 3)] = 1.0;
        let [once, twice, thrice] = [square, square.powi(2), square.powi(3)];
        for (column, power) in [(4, once), (5, twice), (8, thrice)] {
            by_constants[(0, column)] = fx * x * power / below;
            by_constants[(1, column)] = fy * y * power / below;
        }
        for (column, power) in [(9, once), (10, twice), (11, thrice)] {
            by_constants[(0, column)] = -fx * x * radial * power / below;
            by_constants[(1, column)] = -fy * y * radial * power / below;
        }
        let (mixed, along) = (2.0 * x * y, [square + 2.0 * x * x, square + 2.0 * y * y]);
        by_constants[(0, 6)] = fx * mixed;
        by_constants[(1, 6)] = fy * along[1];
        by_constants[(0, 7)] = fx * along[0];
        by_constants[(1, 7)] = fy * mixed;
        Slopes { by_direction, by_constants }
    }
}

/// `x/z, y/z` of a place, and its change with the place.
fn direction(place: &Vector3<f64>) -> (Vector2<f64>, Matrix2x3<f64>) {
    let depth = place.z.max(LEAST_DEPTH * place.norm()).max(f64::MIN_POSITIVE);
    let direction = Vector2::new(place.x, place.y) / depth;
    let [x, y] = [direction.x, direction.y];
    (direction, Matrix2x3::new(1.0, 0.0, -x, 0.0, 1.0, -y) / depth)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PROJECTED: [([f64; 3], f64, f64); 4] = [
        ([0.31, -0.22, 1.4], 903.009_012_630_686_7, 171.396_801_458_850_4),
        ([0.0, 0.0, 1.0], 640.0, 355.0),
        ([-0.5, 0.4, 1.1], 125.226_866_618_690_34, 759.769_655_354_551_1),
        ([0.02, 0.3, 0.7], 672.783_945_677_682_4, 845.436_762_742_149_7),
    ];

    fn lens() -> Lens {
        let distortion = [-0.21, 0.07, 1e-3, -2e-3, 0.01, 0.02, -0.01, 3e-3];
        Lens::new([1210.0, 1190.0, 640.0, 355.0], &distortion)
    }

    /// Against the figures of OpenCV 4's `projectPoints` for the same camera.
    #[test]
    fn a_place_is_shown_where_opencv_shows_it() {
        for (place, u, v) in PROJECTED {
            let seen = lens().shows(&Vector3::from(place)) * lens().focus;
            assert!((seen - Vector2::new(u, v)).norm() < 1e-9, "{place:?}: {seen}");
        }
    }

    #[test]
    fn slopes_are_those_of_what_is_shown() {
        let (lens, step) = (lens(), 1e-6);
        let place = Vector3::new(0.31, -0.22, 1.4);
        let (by_place, by_constants) = lens.slopes(&place);
        for k in 0..3 {
            let by = Vector3::ith(k, step);
            let moved = (lens.shows(&(place + by)) - lens.shows(&(place - by))) / (2.0 * step);
            assert!((moved - by_place.column(k)).norm() < 1e-9, "{k}");
        }
        for k in 0..CONSTANTS {
            let one = |by: f64| {
                let mut all = [0.0; CONSTANTS];
                all[k] = by;
                lens.moved(&all).shows(&place)
            };
            let moved = (one(step) - one(-step)) / (2.0 * step);
            assert!((moved - by_constants.column(k)).norm() < 1e-9, "{k}");
        }
    }

    #[test]
    fn a_distortion_is_taken_back() {
        let direction = Vector2::new(0.4, -0.3);
        let back = lens().direction(&lens().image(&direction));
        assert!((back - direction).norm() < 1e-14, "{back}");
    }

    #[test]
    fn nothing_behind_the_camera_is_infinite() {
        for place in [Vector3::zeros(), Vector3::new(0.1, 0.0, -1.0), Vector3::new(1.0, 0.0, 0.0)] {
            assert!(lens().shows(&place).iter().all(|x| x.is_finite()), "{place}");
        }
    }
}
