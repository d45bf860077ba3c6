//! What is known of cameras and boards, and what rows of theirs see.

use nalgebra::{Isometry3, Matrix3, Rotation3, UnitQuaternion, Vector3};
use serde::Deserialize;
use std::collections::BTreeMap;

use super::{Angle, Bench, Length};
use crate::io::{Fault, Mistake};
use crate::measurement::{Measurements, Row, Sight};
use crate::observe::pictures::{self, Picture};
use crate::observe::{Aim, Lens, Look, Seen, View, lens, look};

/// Numbers that a distortion may have: tangential and two or three radial ones, and three of a denominator.
const DISTORTIONS: [usize; 4] = [0, 4, 5, 8];

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Camera {
    pub(super) name: String,
    #[serde(default)]
    on: Mount,
    matrix: Option<[[f64; 3]; 3]>,
    #[serde(default)]
    distortion: Vec<f64>,
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
    on: Option<Mount>,
    at: Option<[Length; 3]>,
    rotation: Option<[Angle; 3]>,
    #[serde(default)]
    corners: BTreeMap<String, [Length; 3]>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Mount {
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
    fn lens(&self) -> Lens {
        let Some([[fx, _, cx], [_, fy, cy], _]) = self.matrix else {
            return Lens::new([1.0, 1.0, 0.0, 0.0], &self.distortion);
        };
        Lens::new([fx, fy, cx, cy], &self.distortion)
    }

    /// Its constants that are fitted: the matrix if it is not told, too; a distortion that is not told is one of five
    /// numbers.
    fn free(&self) -> &'static [usize] {
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

impl Camera {
    /// Puts a matrix that nobody knows into the camera's rows, which are in pixels, by what it shows at each posture
    /// under each load.
    fn by_pictures(&self, data: &mut Measurements) -> Result<(), Fault> {
        let own = |row: &Row| {
            let aim = row.aim.as_deref().filter(|aim| aim.name == self.name)?;
            let View::Camera { target, .. } = aim.view else { return None };
            Some(target.or_else(|| row.offset.map(Vector3::from)))
        };
        if !data.rows.iter().any(|row| own(row).is_some()) {
            return Ok(());
        }
        let of_picture = |rows: Vec<usize>| -> Picture {
            let rows = rows.into_iter().map(|row| &data.rows[row]);
            rows.filter_map(|row| Some((own(row)??, row.measured.fixed_rows::<2>(3).into_owned())))
                .collect()
        };
        let pictures: Vec<_> = data.pictures().into_iter().map(of_picture).collect();
        let matrix = pictures::matrix(&self.name, self.free().len(), &pictures)?;
        let guess = Lens::guessed(matrix, &self.distortion);
        let guess = pictures::refined(guess, self.free(), &pictures);
        for row in data.rows.iter_mut().filter(|row| own(row).is_some()) {
            if let Some(View::Camera { lens, .. }) = row.aim.as_mut().map(|aim| &mut aim.view) {
                *lens = guess;
            }
            in_parts_of(guess.focus, row);
        }
        Ok(())
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
    pub(crate) fn shows(&self) -> Option<(String, String, Vec<String>)> {
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

    /// Puts what is known of cameras and boards into their rows.
    ///
    /// # Errors
    /// [`Mistake`]: a row whose camera or corner nobody knows.
    pub(super) fn look(&self, data: &mut Measurements) -> Result<(), Mistake> {
        let has_poses = data.by_board;
        for row in &mut data.rows {
            if row.aim.as_ref().is_some_and(|aim| aim.seen == Seen::Camera) {
                let line = row.line;
                data.by_board |= self.pixels(row).map_err(|fault| fault.at(line, None))?;
            } else if has_poses {
                self.carried(row);
            }
        }
        let mut unknown = self.camera.iter().filter(|camera| camera.matrix.is_none());
        unknown.try_for_each(|camera| camera.by_pictures(data))?;
        Ok(())
    }

    fn camera(&self, row: &Row) -> Option<&Camera> {
        let name = row.camera.as_ref().map_or("", |sight| &sight.camera);
        match (name, &self.camera[..]) {
            // A file without the column is of the one camera that there is.
            ("", [only]) => Some(only),
            _ => self.camera.iter().find(|camera| camera.name == name),
        }
    }

    /// Says on which side a camera is that tells a board's pose; the pose of one on the tool in the board's axes, in place of the board's in the camera's.
    fn carried(&self, row: &mut Row) {
        let is_on_tool = self.camera(row).is_some_and(|camera| camera.on == Mount::Tool);
        let sight = row.camera.get_or_insert_default();
        (sight.is_on_tool, sight.has_board) = (is_on_tool, true);
        if !is_on_tool {
            return;
        }
        let [x, y, z, u, v, w] = row.measured.into();
        let board = Isometry3::new(Vector3::new(x, y, z), Vector3::new(u, v, w));
        let camera = board.inverse();
        row.measured.fixed_rows_mut::<3>(0).copy_from(&camera.translation.vector);
        row.measured.fixed_rows_mut::<3>(3).copy_from(&camera.rotation.scaled_axis());
    }

    /// Points the camera of a row at what it shows, pixels in parts of the focal length; whether that is a board's
    /// corner.
    fn pixels(&self, row: &mut Row) -> Result<bool, Fault> {
        let at = |found: String, expected: &str, help: &str| Err(Fault::new(found, expected, help));
        let sight = row.camera.as_deref().cloned().unwrap_or_default();
        let Some(camera) = self.camera(row) else {
            let found = format!("`u` and `v` of camera `{}`, which nobody knows", sight.camera);
            let help = "write a [[camera]] with its name, and its matrix if that is known; `fit = [\"matrix\"]` \
                        where it is rough";
            return at(found, "it in the file of --bench", help);
        };
        let lens = camera.lens();
        let Some(marker) = row.marker.clone() else {
            return at(
                "`u` and `v` without a marker".to_owned(),
                "the name of what is shown",
                "fill `marker` in",
            );
        };
        let named = |known: &&Board| sight.board.is_empty() || known.name == sight.board;
        let mut corners =
            self.board.iter().filter(named).filter_map(|b| Some((b, b.corners.get(&marker)?)));
        let corner = corners.next();
        if let (Some((one, _)), Some((other, _))) = (corner, corners.next()) {
            let found =
                format!("marker `{marker}`, a corner of `{}` and of `{}`", one.name, other.name);
            return at(found, "the name of its board", "fill the column `board` in");
        }
        let place = corner.map(|(_, corner)| Vector3::from(corner.map(|x| x.0)));
        let board_on = corner.and_then(|(board, _)| board.on);
        let (target, is_board) = match (camera.on, place, board_on) {
            (Mount::Base, None, _) => (None, false),
            (Mount::Base, Some(place), None | Some(Mount::Tool)) => {
                row.offset = Some(place.into());
                (None, true)
            }
            (Mount::Tool, Some(place), None | Some(Mount::Base)) => {
                row.offset = Some([0.0; 3]);
                (Some(place), true)
            }
            (Mount::Tool, None, _) => {
                let found = format!("marker `{marker}`, seen by a camera on the tool");
                let help = "name it among the `corners` of a [[board]]";
                return at(found, "a place beside the arm", help);
            }
            (Mount::Base, Some(_), Some(Mount::Base))
            | (Mount::Tool, Some(_), Some(Mount::Tool)) => {
                let found = format!(
                    "camera `{}` and the board of `{marker}` on the same side of the arm",
                    camera.name
                );
                return at(found, "one on the tool and one on the base", "mend `on`");
            }
        };
        row.camera = Some(Box::new(Sight {
            camera: camera.name.clone(),
            board: corner.map_or(sight.board, |(board, _)| board.name.clone()),
            is_on_tool: camera.on == Mount::Tool,
            has_board: is_board,
            at: sight.at,
        }));
        let view = View::Camera { lens, target };
        row.aim = Some(Box::new(Aim {
            seen: Seen::Camera,
            name: camera.name.clone(),
            view,
            free: camera.free(),
        }));
        in_parts_of(lens.focus, row);
        Ok(is_board)
    }
}

/// Pixels in parts of the focal length.
fn in_parts_of(focus: f64, row: &mut Row) {
    for k in 3..5 {
        row.measured[k] /= focus;
        row.sigma.iter_mut().for_each(|sigma| sigma[k] /= focus);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measurement::Layout;
    use stiffarm_kernels::Motion;

    const MATRIX: &str = "matrix = [[900, 0, 640], [0, 900, 360], [0, 0, 1]]";
    const BOARD: &str =
        "[[board]]\nname = \"plate\"\ncorners = { c0 = [0, 0, 0], c1 = [\"30 mm\", 0, 0] }";

    fn told(bench: &str, header: &str, row: &str) -> String {
        let bench = match Bench::read("b.toml", bench) {
            Ok(bench) => bench,
            Err(error) => return error.to_string(),
        };
        let layout = Layout { bench, ..Layout::new([Motion::Revolute]) };
        let text = format!("{header}\n{row}\n{row}\n");
        Measurements::from_bytes("run.csv", text.as_bytes(), &layout)
            .map_or_else(|error| error.to_string(), |data| data.subject())
    }

    #[test]
    fn mistakes_of_cameras_are_told() {
        let camera = |more: &str| format!("[[camera]]\nname = \"left\"\n{more}\n{BOARD}");
        let (header, row) = ("q1,marker,u[px],v[px]", "0.1,c0,600,300");
        assert_eq!(told(&camera(MATRIX), header, row), "cameras");
        for (bench, header, row, part) in [
            (
                camera("matrix = [[900, 1, 640], [0, 900, 360], [0, 0, 1]]"),
                header,
                row,
                "a matrix that is none",
            ),
            (
                camera(&format!("{MATRIX}\ndistortion = [0.1]")),
                header,
                row,
                "a distortion of 1 numbers",
            ),
            (
                camera(""),
                header,
                row,
                "found camera `left` has no matrix, and all its pixels are the same",
            ),
            (
                BOARD.to_owned(),
                header,
                row,
                "line 2: found `u` and `v` of camera ``, which nobody knows",
            ),
            (camera(&format!("{MATRIX}\non = \"tool\"")), "q1,u,v", "0.1,1,2", "without a marker"),
            (camera(MATRIX), header, "0.1,c7,600,300", "unknown marker `c7`"),
            (camera(MATRIX), "q1,marker,u[px]", "0.1,c0,600", "`u` without v"),
            (
                camera(MATRIX),
                "q1,marker,u,v,sigma[mm]",
                "0.1,c0,6,3,1",
                "a standard deviation that is a length",
            ),
            (
                format!("{}\non = \"base\"", camera(MATRIX)),
                header,
                row,
                "camera `left` and the board of `c0` on the same side of the arm",
            ),
            (format!("{0}\n{0}", camera(MATRIX)), header, row, "[[board]] `plate` twice"),
        ] {
            let error = told(&bench, header, row);
            assert!(error.contains(part), "{error}\n{part}");
        }
    }
}
