//! What rows see of cameras and boards.

use nalgebra::{Isometry3, Vector3};

use super::Bench;
use super::camera::{Board, Camera, Mount};
use crate::instrument::pictures::{self, Picture};
use crate::instrument::{Aim, Lens, Seen, View};
use crate::io::{Fault, Mistake};
use crate::measurement::{Measurements, Row, Sight};

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

    /// Says on which side a camera is that tells a board's pose. Of one on the tool the row becomes the camera's pose in the
    /// board's axes.
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
            board: corner.map_or_else(|| sight.board.clone(), |(board, _)| board.name.clone()),
            is_on_tool: camera.on == Mount::Tool,
            has_board: is_board,
            ..sight
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
                "found no matrix of camera `left`, and all its pixels are the same",
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
