//! Postures before a camera: beside the arm it stands, and sees a board on the tool.

use nalgebra::{Isometry3, Matrix3, Rotation3, UnitQuaternion, Vector3};
use stiffarm_kernels::generic::Arm;

use super::super::reality::Reality;
use super::super::transform::{origin, rotation};
use super::{Design, Shape, poses, rounded};
use crate::instrument::{Aim, Bench, Look, Seen};
use crate::io::Fault;
use crate::measurement::{Kind, Measurements, Row, Sight};

/// Postures by which the reach of an arm is told.
const REACH: usize = 200;

/// The camera's distance from the middle of them, in parts of the reach about it: all is within 25° of the line of
/// sight.
const FAR: f64 = 2.2;

/// From where it looks, in the arm's axes.
const FROM: [f64; 3] = [2.0, 1.0, 0.7];

/// A board that is turned away by more than 60° shows no corners.
const FACING: f64 = 0.5;

/// Pools of as many postures as are wanted that are drawn at most.
const POOLS: u64 = 50;

/// Where an arm's base stands in the axes of a camera that has all of its reach in view.
pub fn beside(arm: &Arm) -> Isometry3<f64> {
    let nominal = Reality::nominal(arm);
    let all = Design {
        shape: Shape::Payload,
        poses: REACH,
        repeats: 1,
        payload: 0.0,
        kind: Kind::Pose { orientation: true },
        seed: 0,
    };
    let places: Vec<_> =
        poses::draw(arm, &all).iter().map(|q| origin(&nominal.tool_at(q))).collect();
    let middle = places.iter().sum::<Vector3<f64>>() / places.len() as f64;
    let reach = places.iter().map(|p| (p - middle).norm()).fold(0.0, f64::max);
    let eye = middle + FAR * reach * Vector3::from(FROM).normalize();
    let sight = (middle - eye).normalize();
    let right = sight.cross(&Vector3::z()).normalize();
    let axes = Matrix3::from_columns(&[right, sight.cross(&right), sight]);
    let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
    Isometry3::from_parts(eye.map(|x| rounded(x, 1e6)).into(), turn).inverse()
}

/// A camera's rows with what is on the tool and beside the arm where the bench has it, and the arm where it stands
/// before the first of what is beside it.
///
/// # Errors
/// [`Fault`]: a bench that does not say, at least roughly, where camera and board are.
pub fn in_view(arm: &Arm, data: &mut Measurements, bench: &Bench) -> Result<Arm, Fault> {
    let looks = bench.looks();
    let mut beside: Option<Isometry3<f64>> = None;
    for sight in data.rows.iter_mut().filter_map(|row| row.camera.as_mut()) {
        let is = |look: &&Look| {
            let same = |name: &str, own: &str| own.is_empty() || name == own;
            same(&look.camera, &sight.camera) && same(&look.board, &sight.board)
        };
        let Some(look) = looks.iter().find(is) else {
            let found = format!("camera `{}` and board `{}`", sight.camera, sight.board);
            let help = "give the [[camera]] and the [[board]] their `at`, and `rotation` or `towards`; those that are \
                        on the tool may go without";
            return Err(Fault::new(found, "a bench that says roughly where both are", help));
        };
        sight.at = look.mounted;
        let first = *beside.get_or_insert(look.beside);
        if first != look.beside {
            sight.first = look.beside.inverse() * first;
        }
    }
    let beside = beside.unwrap_or_else(Isometry3::identity);
    Ok(Arm { base: beside.inverse() * arm.base, ..arm.clone() })
}

impl Design {
    /// The rows as [`Design::rows`] has them, at postures in which a board on the tool faces the bench's camera, each
    /// once for every corner; `arm` stands before the camera ([`beside`]).
    ///
    /// # Errors
    /// [`Fault`]: a bench without a camera on the base that has a matrix, or without a board that has corners.
    pub fn shown(&self, arm: &Arm, bench: &Bench) -> Result<Measurements, Fault> {
        let Some((camera, board, corners)) = bench.shows() else {
            let found = "no camera and board";
            let expected = "a bench with a [[camera]] on the base that has a matrix, and a [[board]] with corners";
            return Err(Fault::new(found, expected, "write both, and name the file with --bench"));
        };
        let design = self.before(arm);
        let of = |row: &Row| -> Vec<Row> {
            let shown = |corner: &String| Row {
                marker: Some(corner.clone()),
                camera: Some(Box::new(Sight {
                    camera: camera.clone(),
                    board: board.clone(),
                    ..Sight::default()
                })),
                aim: Some(Box::new(Aim::at(Seen::Camera, camera.clone()))),
                ..row.clone()
            };
            corners.iter().map(shown).collect()
        };
        let rows = design.rows.iter().flat_map(of).collect();
        let mut data = Measurements { rows, by_camera: true, by_board: true, ..design };
        bench.set_up(&mut data).map_err(|mistake| mistake.fault)?;
        Ok(data)
    }

    /// The same of a detector that tells the board's pose in each picture.
    pub fn detected(&self, arm: &Arm) -> Measurements {
        let mut data = self.before(arm);
        let sight = Sight { has_board: true, ..Sight::default() };
        data.rows.iter_mut().for_each(|row| row.camera = Some(Box::new(sight.clone())));
        Measurements { by_camera: true, by_board: true, ..data }
    }

    /// The rows at postures in which what is on the tool faces the camera.
    fn before(&self, arm: &Arm) -> Measurements {
        let nominal = Reality::nominal(arm);
        let faces = |q: &[f64]| {
            let tool = arm.base.to_homogeneous() * nominal.tool_at(q);
            let sight = origin(&tool).normalize();
            (rotation(&tool).column(2).dot(&sight)).abs() > FACING
        };
        let pools = (0..POOLS).flat_map(|k| {
            let seed = self.seed.wrapping_add(k.wrapping_mul(0x9e37_79b9));
            poses::draw(arm, &Design { seed, ..*self })
        });
        let mut postures: Vec<_> = pools.filter(|q| faces(q)).take(self.poses).collect();
        let others = poses::draw(arm, self).into_iter();
        postures.extend(others.take(self.poses - postures.len()));
        self.at(arm, &postures)
    }
}
