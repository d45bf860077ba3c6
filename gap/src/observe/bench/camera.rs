//! What is known of cameras and boards, and what rows of theirs see.

use nalgebra::{Isometry3, Vector3};
use serde::Deserialize;
use std::collections::BTreeMap;

use super::{Bench, Length};
use crate::io::{Fault, Mistake};
use crate::measurement::{Measurements, Row};
use crate::observe::pictures::{self, Picture};
use crate::observe::{Aim, Lens, Seen, View, lens};

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
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Board {
    pub(super) name: String,
    on: Option<Mount>,
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

impl Camera {
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
    /// [`Mistake`]: two cameras or boards where there is one frame, or a row whose camera or corner nobody knows.
    pub(super) fn look(&self, data: &mut Measurements) -> Result<(), Mistake> {
        one_of_each(data).map_err(Mistake::from)?;
        for row in &mut data.rows {
            if row.aim.as_ref().is_some_and(|aim| aim.seen == Seen::Camera) {
                let line = row.line;
                data.by_board |= self.pixels(row).map_err(|fault| fault.at(line, None))?;
            } else {
                self.carried(row);
            }
        }
        let unknown = self.camera.iter().filter(|camera| camera.matrix.is_none());
        unknown.map(|camera| camera.by_pictures(data)).collect::<Result<(), _>>()?;
        Ok(())
    }

    fn camera(&self, row: &Row) -> Option<&Camera> {
        let name = row.camera.as_ref().map_or("", |names| &names[0]);
        match (name, &self.camera[..]) {
            // A file without the column is of the one camera that there is.
            ("", [only]) => Some(only),
            _ => self.camera.iter().find(|camera| camera.name == name),
        }
    }

    /// The pose of a camera on the tool in the board's axes, in place of the board's in the camera's.
    fn carried(&self, row: &mut Row) {
        if row.camera.is_none() || self.camera(row).is_none_or(|camera| camera.on != Mount::Tool) {
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
        let told = row.camera.as_ref().map_or("", |names| &names[0]);
        let Some(camera) = self.camera(row) else {
            let found = format!("`u` and `v` of camera `{told}`, which nobody knows");
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
        let board = row.camera.as_ref().map_or("", |names| &names[1]);
        let named = |known: &&Board| board.is_empty() || known.name == board;
        let corner =
            self.board.iter().filter(named).find_map(|b| Some((b, b.corners.get(&marker)?)));
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

/// Of each camera and board the frames are others, and a sitting has one of either.
fn one_of_each(data: &Measurements) -> Result<(), Fault> {
    for rows in data.sessions() {
        let mut named = rows.iter().filter_map(|row| row.camera.as_deref());
        let Some(first) = named.next() else { continue };
        let Some(other) = named.find(|other| *other != first) else { continue };
        let told =
            |[camera, board]: &[String; 2]| format!("camera `{camera}` with board `{board}`");
        let found = format!("{} and {}", told(first), told(other));
        let help = "put each into a file or a `session` of its own";
        return Err(Fault::new(found, "one camera and one board", help));
    }
    Ok(())
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
