//! What is known of cameras and boards.

use nalgebra::{Isometry3, Matrix3, Rotation3, UnitQuaternion, Vector3};
use serde::Deserialize;
use std::collections::BTreeMap;

use super::{Angle, Bench, Length};
use crate::instrument::{Aim, Lens, Look, lens, look};
use crate::io::Fault;

/// Numbers that a distortion may have: tangential and two or three radial ones, and three of a denominator.
const DISTORTIONS: [usize; 4] = [0, 4, 5, 8];

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Camera {
    pub(super) name: String,
    #[serde(default)]
    pub(super) on: Mount,
    pub(super) matrix: Option<[[f64; 3]; 3]>,
    #[serde(default)]
    pub(super) distortion: Vec<f64>,
    #[serde(default)]
    fit: Vec<Part>,
    at: Option<[Length; 3]>,
    rotation: Option<[Angle; 3]>,
    towards: Option<[Length; 3]>,
    size: Option<[f64; 2]>,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Board {
    pub(super) name: String,
    pub(super) on: Option<Mount>,
    at: Option<[Length; 3]>,
    rotation: Option<[Angle; 3]>,
    #[serde(default)]
    pub(super) corners: BTreeMap<String, [Length; 3]>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Mount {
    #[default]
    Base,
    Tool,
}

/// A part of a lens.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Part {
    Matrix,
    Distortion,
}

/// m.
fn place(at: [Length; 3]) -> Vector3<f64> {
    Vector3::from(at.map(|x| x.0))
}

/// Where something is, roughly; without a rotation in the axes of what it is told in.
fn frame(at: Vector3<f64>, rotation: Option<[Angle; 3]>) -> Isometry3<f64> {
    Isometry3::new(at, rotation.map_or_else(Vector3::zeros, |r| Vector3::from(r.map(|x| x.0))))
}

/// Where a camera is that looks from one point towards another, its picture upright.
fn looking(from: Vector3<f64>, towards: Vector3<f64>) -> Isometry3<f64> {
    let sight = (towards - from).normalize();
    let level = sight.cross(&Vector3::z());
    // Straight down or up no side is up.
    let right = if level.norm() > 1e-6 { level.normalize() } else { Vector3::x() };
    let axes = Matrix3::from_columns(&[right, sight.cross(&right), sight]);
    let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
    Isometry3::from_parts(from.into(), turn)
}

impl Camera {
    /// Where it is, roughly; on the tool it is at its origin where nothing else is said.
    fn stands(&self) -> Option<Isometry3<f64>> {
        let at = self.at.map(place).or_else(|| (self.on == Mount::Tool).then(Vector3::zeros))?;
        match (self.towards, self.on) {
            (Some(towards), _) => Some(looking(at, place(towards))),
            (None, Mount::Base) if self.rotation.is_none() => None,
            _ => Some(frame(at, self.rotation)),
        }
    }

    pub(super) fn check(&self) -> Result<(), Fault> {
        let of = |what: String| format!("{what} of camera `{}`", self.name);
        if let Some([[fx, skew, _], [under, fy, _], last]) = self.matrix {
            let is_matrix = skew == 0.0 && under == 0.0 && last == [0.0, 0.0, 1.0];
            if !(is_matrix && fx > 0.0 && fy > 0.0)
                || self.matrix.iter().flatten().flatten().any(|x| !x.is_finite())
            {
                let found = of("a matrix that is none".to_owned());
                let expected =
                    "[[fx, 0, cx], [0, fy, cy], [0, 0, 1]] with focal lengths above 0, px";
                return Err(Fault::new(found, expected, "write it as OpenCV does"));
            }
        }
        if !DISTORTIONS.contains(&self.distortion.len())
            || self.distortion.iter().any(|x| !x.is_finite())
        {
            let found = of(format!("a distortion of {} numbers", self.distortion.len()));
            let expected = "4, 5 or 8: k1, k2, p1, p2, k3, k4, k5, k6 in OpenCV's order";
            return Err(Fault::new(found, expected, "leave those at the end out that are 0"));
        }
        if self.size.is_some_and(|size| !size.iter().all(|x| x.is_finite() && *x > 0.0)) {
            let found = of("a size that is not above 0".to_owned());
            return Err(Fault::new(found, "the picture's width and height, px", ""));
        }
        if let Some(towards) = self.towards {
            let expected = "`at` of a camera beside the arm, another point, and no `rotation`";
            let is_elsewhere = self.at.is_some_and(|at| place(at) != place(towards));
            if self.rotation.is_some() || self.on == Mount::Tool || !is_elsewhere {
                return Err(Fault::new(of("`towards`".to_owned()), expected, "write one of them"));
            }
        }
        Ok(())
    }

    /// In pixels, as long as nobody knows the matrix.
    pub(super) fn lens(&self) -> Lens {
        let Some([[fx, _, cx], [_, fy, cy], _]) = self.matrix else {
            return Lens::new([1.0, 1.0, 0.0, 0.0], &self.distortion);
        };
        Lens::new([fx, fy, cx, cy], &self.distortion)
    }

    /// Its constants that are fitted: the matrix if it is not told, too; a distortion that is not told is one of five
    /// numbers.
    pub(super) fn free(&self) -> &'static [usize] {
        let is_told = |part| part != Part::Matrix || self.matrix.is_some();
        let has = |part| self.fit.contains(&part) || !is_told(part);
        let distorted =
            lens::OF_MATRIX + if self.distortion.is_empty() { 5 } else { self.distortion.len() };
        match (has(Part::Matrix), has(Part::Distortion)) {
            (false, false) => &[],
            (true, false) => Aim::some(0, lens::OF_MATRIX),
            (false, true) => Aim::some(lens::OF_MATRIX, distorted),
            (true, true) => Aim::some(0, distorted),
        }
    }
}

impl Bench {
    /// The cameras before boards of which it is known where both are, at least roughly.
    pub fn looks(&self) -> Vec<Look> {
        let pairs = self.camera.iter().flat_map(|c| self.board.iter().map(move |b| (c, b)));
        let of = |(camera, board): (&Camera, &Board)| {
            let (matrix, camera_at) = (camera.matrix?, camera.stands()?);
            let is_on_tool = camera.on == Mount::Tool;
            // A board on the tool is at its origin where nothing else is said.
            let at = board.at.map(place).or_else(|| (!is_on_tool).then(Vector3::zeros))?;
            let board_at = frame(at, board.rotation);
            let (beside, mounted) =
                if is_on_tool { (board_at, camera_at) } else { (camera_at, board_at) };
            let is_seen = board.on.is_none_or(|on| on != camera.on) && !board.corners.is_empty();
            is_seen.then(|| Look {
                camera: camera.name.clone(),
                board: board.name.clone(),
                lens: camera.lens(),
                free: camera.free(),
                size: camera.size.unwrap_or_else(|| look::size(&matrix)),
                is_on_tool,
                beside,
                mounted,
                corners: board
                    .corners
                    .iter()
                    .map(|(name, at)| (name.clone(), place(*at)))
                    .collect(),
            })
        };
        pairs.filter_map(of).collect()
    }

    /// The names of a camera beside the arm whose lens is known, of a board that may be on the tool, and of its
    /// corners.
    pub fn shows(&self) -> Option<(String, String, Vec<String>)> {
        let camera = self.camera.iter().find(|c| c.on == Mount::Base && c.matrix.is_some())?;
        let is_on_tool =
            |board: &&Board| board.on != Some(Mount::Base) && !board.corners.is_empty();
        let board = self.board.iter().find(is_on_tool)?;
        Some((camera.name.clone(), board.name.clone(), board.corners.keys().cloned().collect()))
    }

    /// Whether a board has a corner of that name.
    pub(crate) fn has_corner(&self, name: &str) -> bool {
        self.board.iter().any(|board| board.corners.contains_key(name))
    }
}
