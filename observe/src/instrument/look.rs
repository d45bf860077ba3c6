//! A camera before a board, both roughly where they are: what a plan needs to know of a picture.

use nalgebra::{DMatrix, Isometry3, Matrix2x3, Point3, Vector2, Vector3};

use super::Lens;

/// A board that is turned away by more than 60° shows its corners badly.
const FACING: f64 = 0.5;

/// Corners that stand for all in what a picture says: those farthest from each other.
const FEW: usize = 4;

/// A camera before a board.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// The name of the camera.
    pub camera: String,
    /// The name of the board.
    pub board: String,
    /// The camera's.
    pub lens: Lens,
    /// Which of its constants are unknown.
    pub free: &'static [usize],
    /// Of the picture, px.
    pub size: [f64; 2],
    /// Whether the camera is on the tool, and the board beside the arm.
    pub is_on_tool: bool,
    /// Where what is beside the arm stands, in the measuring frame.
    pub beside: Isometry3<f64>,
    /// Where what is on the tool sits, in the tool frame.
    pub mounted: Isometry3<f64>,
    /// Of the board, in its own axes, m.
    pub corners: Vec<(String, Vector3<f64>)>,
}

impl Look {
    /// As reports call it.
    pub fn full_name(&self) -> String {
        format!("board {} before camera {}", self.board, self.camera)
    }

    /// Unknown constants: those of both frames and of the lens.
    pub fn constants(&self) -> usize {
        2 * 6 + self.free.len()
    }

    /// The board in the camera's axes, and the camera in the measuring frame, with the tool there.
    fn board(&self, tool: &Isometry3<f64>) -> (Isometry3<f64>, Isometry3<f64>) {
        let mounted = tool * self.mounted;
        let (camera, board) =
            if self.is_on_tool { (mounted, self.beside) } else { (self.beside, mounted) };
        (camera.inverse() * board, camera)
    }

    /// Where each corner is shown, px; `None` where one is outside the picture or behind the camera, or the board
    /// turned away.
    pub fn shows(&self, tool: &Isometry3<f64>) -> Option<Vec<Vector2<f64>>> {
        let (board, _) = self.board(tool);
        let sight = self.middle(&board).normalize();
        let faces = (board.rotation * Vector3::z()).dot(&sight) > FACING;
        let shown = self.corners.iter().map(|(_, at)| {
            let place = (board * Point3::from(*at)).coords;
            let at = self.lens.shows(&place) * self.lens.focus;
            let is_inside = at.iter().zip(self.size).all(|(x, size)| (0.0..=size).contains(x));
            (place.z > 0.0 && is_inside).then_some(at)
        });
        shown.collect::<Option<Vec<_>>>().filter(|_| faces)
    }

    /// How far the board's middle is shown from the inner half of the picture, in parts of the focal length.
    pub fn off(&self, tool: &Isometry3<f64>) -> Vector2<f64> {
        let (board, _) = self.board(tool);
        let at = self.lens.shows(&self.middle(&board));
        Vector2::from_fn(|k, _| {
            let size = self.size[k] / self.lens.focus;
            at[k] - at[k].clamp(0.25 * size, 0.75 * size)
        })
    }

    /// By how much that changes with the tool's shift and turn.
    pub fn off_by_tool(&self, tool: &Isometry3<f64>) -> DMatrix<f64> {
        let (board, camera) = self.board(tool);
        let (by_place, _) = self.lens.slopes(&self.middle(&board));
        let sign = if self.is_on_tool { -1.0 } else { 1.0 };
        let place = (camera * Point3::from(self.middle(&board))).coords;
        by_twist(&by_place, &camera, &place, &tool.translation.vector) * sign
    }

    fn middle(&self, board: &Isometry3<f64>) -> Vector3<f64> {
        let sum: Vector3<f64> = self.corners.iter().map(|(_, at)| at).sum();
        (board * Point3::from(sum / self.corners.len() as f64)).coords
    }

    /// What the picture shows per shift and turn of the tool, and per unknown constant, in parts of the focal length: a
    /// few corners in place of all, which weigh as much.
    pub fn rows(&self, tool: &Isometry3<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
        let (board, camera) = self.board(tool);
        let few = self.few();
        let weight = (self.corners.len() as f64 / few.len() as f64).sqrt();
        let sign = if self.is_on_tool { -weight } else { weight };
        let mut by_tool = DMatrix::zeros(2 * few.len(), 6);
        let mut constants = DMatrix::zeros(2 * few.len(), self.constants());
        let turn = tool.rotation.to_rotation_matrix();
        for (k, corner) in few.into_iter().enumerate() {
            let seen = (board * Point3::from(corner)).coords;
            let (by_place, by_lens) = self.lens.slopes(&seen);
            let place = (camera * Point3::from(seen)).coords;
            let of = |about: &Vector3<f64>| by_twist(&by_place, &camera, &place, about) * sign;
            let by_twist = of(&tool.translation.vector);
            by_tool.rows_mut(2 * k, 2).copy_from(&by_twist);
            let mut row = constants.rows_mut(2 * k, 2);
            // What is beside the arm moves against the tool; what is on it, with it and in its axes.
            row.columns_mut(0, 6).copy_from(&-of(&Vector3::zeros()));
            for half in [0, 3] {
                let turned = by_twist.columns(half, 3) * turn.matrix();
                row.columns_mut(6 + half, 3).copy_from(&turned);
            }
            for (column, constant) in self.free.iter().enumerate() {
                row.column_mut(12 + column).copy_from(&(by_lens.column(*constant) * weight));
            }
        }
        (by_tool, constants)
    }

    /// Corners far from each other, one after the other.
    fn few(&self) -> Vec<Vector3<f64>> {
        let mut few: Vec<Vector3<f64>> = Vec::new();
        while few.len() < FEW.min(self.corners.len()) {
            let middle = self.middle(&Isometry3::identity());
            let far = |at: &Vector3<f64>| {
                let from = few.iter().map(|one| (one - at).norm());
                if few.is_empty() {
                    (at - middle).norm()
                } else {
                    from.fold(f64::INFINITY, f64::min)
                }
            };
            let next = self.corners.iter().map(|(_, at)| *at);
            few.extend(next.max_by(|a, b| far(a).total_cmp(&far(b))));
        }
        few
    }
}

/// What a place in the measuring frame that moves with a twist about a point changes by in the picture of a camera.
fn by_twist(
    by_place: &Matrix2x3<f64>,
    camera: &Isometry3<f64>,
    place: &Vector3<f64>,
    about: &Vector3<f64>,
) -> DMatrix<f64> {
    let back = by_place * camera.rotation.inverse().to_rotation_matrix().matrix();
    let mut both = DMatrix::zeros(2, 6);
    both.columns_mut(0, 3).copy_from(&back);
    both.columns_mut(3, 3).copy_from(&(back * -(place - about).cross_matrix()));
    both
}

/// Of a lens the picture is as large as its middle says, px.
pub(super) fn size(matrix: &[[f64; 3]; 3]) -> [f64; 2] {
    [2.0 * matrix[0][2], 2.0 * matrix[1][2]]
}

#[cfg(test)]
mod tests {
    use nalgebra::{Translation3, UnitQuaternion};

    use super::*;
    use crate::instrument::lens;

    fn look(is_on_tool: bool) -> Look {
        let at = |k: usize| Vector3::new(0.03 * (k % 6) as f64, 0.03 * (k / 6) as f64, 0.0);
        let far = Isometry3::translation(-0.1, -0.05, 0.6);
        let turn = Isometry3::new(Vector3::zeros(), Vector3::new(0.3, -0.2, 0.4));
        let hand = Isometry3::new(Vector3::new(0.02, 0.05, 0.1), Vector3::new(0.1, 0.0, 0.2));
        let tool = tool();
        let (beside, mounted) = match is_on_tool {
            true => (tool * hand * far * turn, hand),
            false => (tool * hand * (far * turn).inverse(), hand),
        };
        Look {
            camera: "left".to_owned(),
            board: "plate".to_owned(),
            lens: Lens::new([900.0, 880.0, 640.0, 360.0], &[-0.2, 0.05]),
            free: &[0, 1, 2, 3, 4],
            size: [1280.0, 720.0],
            is_on_tool,
            beside,
            mounted,
            corners: (0..24).map(|k| (format!("c{k}"), at(k))).collect(),
        }
    }

    fn tool() -> Isometry3<f64> {
        Isometry3::new(Vector3::new(0.4, -0.3, 0.7), Vector3::new(1.9, 0.4, -0.6))
    }

    /// In view, and out of it when the tool turns away or the picture is small.
    #[test]
    fn a_board_is_in_view_or_not() {
        for is_on_tool in [true, false] {
            let look = look(is_on_tool);
            let shown = look.shows(&tool()).expect("in view");
            assert_eq!(shown.len(), 24);
            let away = tool() * Isometry3::rotation(Vector3::new(0.0, 2.0, 0.0));
            assert_eq!(look.shows(&away), None);
            let small = Look { size: [300.0, 200.0], ..look };
            assert_eq!(small.shows(&tool()), None);
        }
    }

    /// Every column against central differences of what the lens shows.
    #[test]
    fn rows_are_those_of_what_is_shown() {
        let step = 1e-6;
        for is_on_tool in [true, false] {
            let look = look(is_on_tool);
            let (by_tool, constants) = look.rows(&tool());
            let few = look.few();
            assert_eq!(few.len(), FEW);
            let shown = |look: &Look, tool: &Isometry3<f64>| {
                let (board, _) = look.board(tool);
                let of = |at: &Vector3<f64>| look.lens.shows(&(board * Point3::from(*at)).coords);
                let weight = (look.corners.len() as f64 / FEW as f64).sqrt();
                DMatrix::from_fn(2 * FEW, 1, |r, _| weight * of(&few[r / 2])[r % 2])
            };
            let twisted = |at: &Isometry3<f64>, about: Vector3<f64>, k: usize, by: f64| {
                let mut twist = [0.0; 6];
                twist[k] = by;
                let [x, y, z, u, v, w] = twist;
                let turn = UnitQuaternion::from_scaled_axis(Vector3::new(u, v, w));
                let arm = at.translation.vector - about;
                let place = about + Vector3::new(x, y, z) + turn * arm;
                Isometry3::from_parts(Translation3::from(place), turn * at.rotation)
            };
            let same = |found: nalgebra::DMatrixView<'_, f64>,
                        of: &dyn Fn(f64) -> DMatrix<f64>,
                        what: &str| {
                let slope = (of(step) - of(-step)) / (2.0 * step);
                assert!((slope - found).amax() < 1e-8, "{is_on_tool} {what}");
            };
            for k in 0..6 {
                let about = tool().translation.vector;
                let of = |by: f64| shown(&look, &twisted(&tool(), about, k, by));
                same(by_tool.columns(k, 1), &of, &format!("tool {k}"));
                let of = |by: f64| {
                    let beside = twisted(&look.beside, Vector3::zeros(), k, by);
                    shown(&Look { beside, ..look.clone() }, &tool())
                };
                same(constants.columns(k, 1), &of, &format!("beside {k}"));
                let of = |by: f64| {
                    let mounted = twisted(&look.mounted, Vector3::zeros(), k, by);
                    shown(&Look { mounted, ..look.clone() }, &tool())
                };
                same(constants.columns(6 + k, 1), &of, &format!("mounted {k}"));
            }
            for (column, constant) in look.free.iter().enumerate() {
                let of = |by: f64| {
                    let mut all = [0.0; lens::CONSTANTS];
                    all[*constant] = by;
                    shown(&Look { lens: look.lens.moved(&all), ..look.clone() }, &tool())
                };
                same(constants.columns(12 + column, 1), &of, &format!("lens {constant}"));
            }
        }
    }
}
