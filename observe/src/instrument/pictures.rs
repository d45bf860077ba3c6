//! A lens's matrix of which nothing is known, by what its pictures show of a board: the start of its fit.
//!
//! Of each picture the projective matrix P of the board is found, whatever the lens ([`Object::projected`]). Its columns are
//! K times those of a rotation, so that they are perpendicular and of one length under ω = K⁻ᵀ K⁻¹, which is linear in ω
//! (Zhang 2000; of a board whose points are in no plane there are three columns). A distortion is taken for what was told
//! there; [`refined`] finds it.

mod fit;

use nalgebra::{DMatrix, Matrix3, Vector2, Vector3};

pub(crate) use fit::refined;

use super::lens::OF_MATRIX;
use super::resection::{Object, null};
use crate::io::Fault;

/// Numbers that a picture says of the matrix at the most: of a board in a plane, and of another.
const SAYS: [usize; 2] = [2, 5];

/// Numbers of the place where a picture was taken from.
const POSE: usize = 6;

/// Equations whose second smallest singular value is less than this part of the largest leave more than one ω: they
/// differ by rounding.
const ROUNDING: f64 = 1e-9;

/// What a picture shows: points of a board, and where, px.
pub(crate) type Picture = Vec<(Vector3<f64>, Vector2<f64>)>;

/// `fx fy cx cy` by pictures; `free` numbers of the lens are to be found.
///
/// # Errors
/// [`Fault`]: too few pictures, or of boards that are not tilted against each other.
pub fn matrix(camera: &str, free: usize, pictures: &[Picture]) -> Result<[f64; OF_MATRIX], Fault> {
    let all = || pictures.iter().flatten().map(|(_, at)| at);
    let count = all().count().max(1) as f64;
    let middle = all().sum::<Vector2<f64>>() / count;
    let spread = (all().map(|at| (at - middle).norm_squared()).sum::<f64>() / count).sqrt();
    let told = format!("no matrix of camera `{camera}`");
    if spread.is_nan() || spread <= 0.0 {
        let found = format!("{told}, and all its pixels are the same");
        let help =
            "a plan needs the matrix, a rough one will do: `matrix = …` and `fit = [\"matrix\"]`";
        return Err(Fault::new(found, "pictures of a board in different places", help));
    }
    // All of some size about 1, so that no number of ω is lost beside another.
    let scaled = |picture: &Picture| -> Picture {
        picture.iter().map(|(point, at)| (*point, (at - middle) / spread)).collect()
    };
    let objects: Vec<Object> =
        pictures.iter().filter_map(|picture| Object::of(&scaled(picture))).collect();
    let says = |object: &Object| SAYS[usize::from(!object.is_flat)].min(object.numbers() - POSE);
    let numbers: usize = objects.iter().map(|object| object.numbers() - POSE).sum();
    let of_matrix: usize = objects.iter().map(says).sum();
    if of_matrix < OF_MATRIX || numbers < free {
        return Err(too_few(&told, free, &objects, says));
    }
    let rows: Vec<Vec<f64>> = objects.iter().filter_map(equations).flatten().collect();
    let found = omega(&rows).and_then(|omega| pinhole(&omega));
    let Some([fx, fy, cx, cy]) = found else {
        let found = format!("{told}, and {} pictures that do not tell it", objects.len());
        let help = "take pictures of the board tilted by 20° to 50°, each about another axis, or write a rough \
                    `matrix` with `fit = [\"matrix\"]`";
        return Err(Fault::new(found, "boards that are tilted against each other", help));
    };
    Ok([spread * fx, spread * fy, spread * cx + middle.x, spread * cy + middle.y])
}

/// What is missing: as many pictures like the best as the numbers need.
fn too_few(told: &str, free: usize, objects: &[Object], says: impl Fn(&Object) -> usize) -> Fault {
    let counted = |count: usize| format!("{count} picture{}", if count == 1 { "" } else { "s" });
    let verb = if objects.len() == 1 { "tells" } else { "tell" };
    let found = format!("{told}, and {} that {verb} of it", counted(objects.len()));
    let best = objects.iter().max_by_key(|object| object.numbers());
    let most = best.map_or([SAYS[0], SAYS[0]], |best| [says(best), best.numbers() - POSE]);
    let needed = OF_MATRIX.div_ceil(most[0]).max(free.div_ceil(most[1]));
    let expected = format!(
        "at least {} that show{} 4 corners or more of a flat board, or 6 of another: {free} numbers are unknown",
        counted(needed),
        if needed == 1 { "s" } else { "" }
    );
    Fault::new(found, expected, "take more, twenty are good, with the board tilted to all sides")
}

/// That the columns of a picture's matrix are perpendicular and of one length, linear in ω's five entries.
fn equations(object: &Object) -> Option<Vec<Vec<f64>>> {
    let found = object.projected()?;
    let size = found.fixed_columns::<2>(0).norm();
    let column = |k: usize| found.column(k) / size;
    let by = |a: Vector3<f64>, b: Vector3<f64>| {
        [a.x * b.x, a.y * b.y, a.x * b.z + a.z * b.x, a.y * b.z + a.z * b.y, a.z * b.z]
    };
    let perpendicular = |i: usize, k: usize| by(column(i), column(k)).to_vec();
    let alike = |i: usize, k: usize| {
        let (one, other) = (by(column(i), column(i)), by(column(k), column(k)));
        one.iter().zip(other).map(|(a, b)| a - b).collect()
    };
    let mut rows = vec![perpendicular(0, 1), alike(0, 1)];
    if !object.is_flat {
        rows.extend([perpendicular(0, 2), perpendicular(1, 2), alike(1, 2)]);
    }
    Some(rows)
}

/// The ω that solves all equations best, up to a factor; `None` if there is more than one.
fn omega(rows: &[Vec<f64>]) -> Option<Vec<f64>> {
    let equations = DMatrix::from_fn(rows.len(), OF_MATRIX + 1, |i, k| rows[i][k]);
    let mut sizes: Vec<f64> = equations.singular_values().iter().copied().collect();
    sizes.sort_by(|a, b| b.total_cmp(a));
    let is_one = sizes[OF_MATRIX - 1] > ROUNDING * sizes[0];
    null(rows).filter(|_| is_one)
}

/// `fx fy cx cy` by ω up to a factor; `None` where it is of no camera.
fn pinhole(omega: &[f64]) -> Option<[f64; OF_MATRIX]> {
    let [a, b, c, d, e] = omega.try_into().ok()?;
    let omega = Matrix3::new(a, 0.0, c, 0.0, b, d, c, d, e);
    let sign = omega.trace().signum();
    let inverse = (omega * sign).cholesky()?.inverse();
    // ω⁻¹ = K Kᵀ up to a factor.
    let dual = inverse / inverse[(2, 2)];
    let [cx, cy] = [dual[(0, 2)], dual[(1, 2)]];
    let found = [(dual[(0, 0)] - cx * cx).sqrt(), (dual[(1, 1)] - cy * cy).sqrt(), cx, cy];
    found.iter().all(|x| x.is_finite()).then_some(found)
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry3, Point3};

    use super::*;

    pub(in crate::instrument) const MATRIX: [f64; OF_MATRIX] = [1210.0, 1190.0, 640.0, 355.0];

    /// A board at several tilts, by the pinhole's own definition.
    pub(in crate::instrument) fn pictures(
        points: &[Vector3<f64>],
        tilts: &[[f64; 3]],
    ) -> Vec<Picture> {
        let [fx, fy, cx, cy] = MATRIX;
        let of = |tilt: &[f64; 3]| {
            let pose = Isometry3::new(Vector3::new(-0.1, 0.05, 0.8), Vector3::from(*tilt));
            let shown = |p: &Vector3<f64>| {
                let at = pose * Point3::from(*p);
                (*p, Vector2::new(fx * at.x / at.z + cx, fy * at.y / at.z + cy))
            };
            points.iter().map(shown).collect()
        };
        tilts.iter().map(of).collect()
    }

    pub(in crate::instrument) fn board(is_flat: bool) -> Vec<Vector3<f64>> {
        let at = |k: usize| {
            let z = if is_flat || k.is_multiple_of(2) { 0.0 } else { 0.04 };
            Vector3::new(0.05 * (k % 4) as f64, 0.05 * (k / 4) as f64, z)
        };
        (0..12).map(at).collect()
    }

    const TILTS: [[f64; 3]; 3] = [[0.5, 0.1, 0.2], [-0.2, 0.5, 1.0], [0.1, -0.5, -0.4]];

    #[test]
    fn a_matrix_is_found_by_as_few_pictures_as_can_be() {
        for (is_flat, count) in [(true, 2), (true, 3), (false, 1), (false, 3)] {
            let shown = pictures(&board(is_flat), &TILTS[..count]);
            let found = matrix("left", OF_MATRIX, &shown).expect("a matrix");
            for (is, was) in found.into_iter().zip(MATRIX) {
                assert!((is - was).abs() < 1e-6, "{is_flat} {count}: {found:?}");
            }
        }
    }

    #[test]
    fn too_few_pictures_are_told_with_how_many_are_needed() {
        let few = |points: &[Vector3<f64>], tilts: &[[f64; 3]], free: usize| {
            matrix("left", free, &pictures(points, tilts)).unwrap_err().to_string()
        };
        let board = board(true);
        let told = few(&board, &TILTS[..1], OF_MATRIX);
        assert!(
            told.contains("1 picture that tells of it, expected at least 2 pictures"),
            "{told}"
        );
        // Four corners say two numbers beyond the board's place: nine need five pictures.
        let told = few(&[board[0], board[1], board[4], board[5]], &TILTS, 9);
        assert!(
            told.contains("3 pictures that tell of it, expected at least 5 pictures"),
            "{told}"
        );
        let told = few(&board[..3], &TILTS, OF_MATRIX);
        assert!(
            told.contains("0 pictures that tell of it, expected at least 2 pictures"),
            "{told}"
        );
        // Turned about the line of sight a board says the same again.
        let told = few(&board, &[[0.0, 0.0, 0.1], [0.0, 0.0, 0.9], [0.0, 0.0, 2.0]], OF_MATRIX);
        assert!(told.contains("tilted against each other"), "{told}");
        let told = matrix("left", OF_MATRIX, &[]).unwrap_err().to_string();
        assert!(told.contains("all its pixels are the same"), "{told}");
    }
}
