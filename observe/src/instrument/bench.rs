//! What is known of a bench (`--bench`).
//!
//! ```toml
//! [[point]]                     # a socket, a cone
//! name = "front:0"
//! at = [0.4, 0.1, "20 mm"]      # if it is known
//!
//! [[pair]]                      # how far two points are apart
//! points = ["front:0", "front:1"]
//! distance = "50 mm"
//! sigma = "0.1 mm"
//!
//! [[plane]]
//! name = "table"
//! normal = [0, 0, 1]            # if it is known
//! offset = "0 mm"
//! sigma = "20 um"               # how flat it is: of every row that has no sigma of its own
//!
//! [[centre]]                    # of a ball bar, a draw wire
//! name = "wire"
//! at = [1.0, 0.0, 0.5]          # if it is known
//! length_offset = "0 mm"        # what it reads at no distance, if that is known
//!
//! [[camera]]                    # that tells where a board is, or what it shows
//! name = "left"
//! on = "tool"                   # else "base", beside the arm, and the board is on the tool
//! matrix = [[900, 0, 640], [0, 900, 360], [0, 0, 1]]
//! distortion = [-0.2, 0.05, 0.001, -0.002, 0.01]
//! fit = ["matrix"]              # these values are near, and fitted along
//! at = [0, "60 mm", 0]          # roughly, for plans: on the tool in the tool frame, else in the measuring frame
//! rotation = [0, 0, "90 deg"]   # its axes there, a rotation vector; or, beside the arm, `towards` a point
//! size = [1280, 720]            # of the picture, px; else twice the principal point
//!
//! [[board]]
//! name = "charuco"
//! on = "base"                   # else "tool"; where the camera is not
//! at = [0.5, 0, 0]              # roughly, for plans; `rotation` as a camera's
//! corners = { c0 = ["0 mm", "0 mm", "0 mm"], c1 = ["30 mm", "0 mm", "0 mm"] }
//! ```
//!
//! A number is in metres; a text has its unit. What is not said is unknown, and fitted along.

mod camera;
mod sights;

use nalgebra::{Unit, Vector3};
use serde::Deserialize;

use camera::{Board, Camera};

use super::{Aim, Pair, Plane, Seen, View};
use crate::io::{Dimension, Fault, Mistake, ReadError, from_toml, quantity};
use crate::measurement::{Measurements, Row};

/// What is known of a bench.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Bench {
    /// The file as it was named, for messages.
    #[serde(skip)]
    pub file: String,
    point: Vec<Point>,
    pair: Vec<Known>,
    plane: Vec<Flat>,
    centre: Vec<Centre>,
    camera: Vec<Camera>,
    board: Vec<Board>,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Point {
    name: String,
    at: Option<[Length; 3]>,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Known {
    points: [String; 2],
    distance: Length,
    sigma: Option<Length>,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Flat {
    name: String,
    normal: Option<[f64; 3]>,
    offset: Option<Length>,
    sigma: Option<Length>,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Centre {
    name: String,
    at: Option<[Length; 3]>,
    length_offset: Option<Length>,
}

/// m.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "Written")]
struct Length(f64);

#[derive(Deserialize)]
#[serde(untagged)]
enum Written {
    Si(f64),
    Text(String),
}

/// rad.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "Written")]
struct Angle(f64);

impl Written {
    /// In SI: what it is, and the unit of a bare number.
    fn of(self, dimension: Dimension, [what, si]: [&str; 2]) -> Result<f64, String> {
        let (found, value) = match self {
            Written::Si(value) => (value.to_string(), Some(value)),
            Written::Text(text) => (format!("{text:?}"), quantity(&text, Some(dimension))),
        };
        value.filter(|x| x.is_finite()).ok_or_else(|| {
            let units = dimension.units();
            format!("{found} is no {what}: write {si}, or a text with one of {units}")
        })
    }
}

impl TryFrom<Written> for Length {
    type Error = String;

    fn try_from(written: Written) -> Result<Length, String> {
        written.of(Dimension::Length, ["length", "metres"]).map(Length)
    }
}

impl TryFrom<Written> for Angle {
    type Error = String;

    fn try_from(written: Written) -> Result<Angle, String> {
        written.of(Dimension::Angle, ["angle", "radians"]).map(Angle)
    }
}

/// A pair whose standard deviation nobody tells is known to a micrometre.
const EXACT: f64 = 1e-6;

impl Bench {
    /// Of which nothing is known.
    pub const NONE: Bench = Bench {
        file: String::new(),
        point: Vec::new(),
        pair: Vec::new(),
        plane: Vec::new(),
        centre: Vec::new(),
        camera: Vec::new(),
        board: Vec::new(),
    };

    /// The points and planes of which it is known where they are, at least roughly: their constants are unknown.
    pub fn places(&self) -> Vec<Aim> {
        let points = self.point.iter().filter_map(|one| {
            let at = View::Point(Vector3::from(one.at?.map(|x| x.0)));
            Some(Aim { view: at, ..Aim::at(Seen::Point, one.name.clone()) })
        });
        let planes = self.plane.iter().filter_map(|one| {
            let normal = Unit::new_normalize(Vector3::from(one.normal?));
            let view = View::Plane(Plane::new(normal, one.offset?.0));
            Some(Aim { view, ..Aim::at(Seen::Plane, one.name.clone()) })
        });
        points.chain(planes).collect()
    }

    /// Reads what is known; `file` is what messages call it.
    ///
    /// # Errors
    /// [`ReadError`]: what is no bench, with the line and what was expected.
    pub fn read(file: &str, text: &str) -> Result<Bench, ReadError> {
        let bench: Bench = from_toml(file, text, "no bench")?;
        let wrong = |found: String, expected: &str, help: &str| {
            Err(Fault::new(found, expected, help).of(file))
        };
        for pair in &bench.pair {
            let [one, other] = &pair.points;
            if one == other {
                let found = format!("a [[pair]] of `{one}` with itself");
                return wrong(found, "two points", "name the other");
            }
            if pair.distance.0 <= 0.0 || pair.sigma.is_some_and(|sigma| sigma.0 <= 0.0) {
                let found = format!(
                    "a [[pair]] of `{one}` and `{other}` with a length that is not above 0"
                );
                return wrong(found, "a distance and a standard deviation above 0", "");
            }
        }
        for plane in &bench.plane {
            let normal = plane.normal.map(Vector3::from);
            if normal.is_some_and(|n| n.norm() == 0.0 || !n.norm().is_finite()) {
                let found = format!("the normal of plane `{}`, which has no direction", plane.name);
                return wrong(found, "three numbers, not all 0", "");
            }
            if plane.sigma.is_some_and(|sigma| sigma.0 <= 0.0) {
                let found = format!("the sigma of plane `{}`, not above 0", plane.name);
                return wrong(found, "a standard deviation", "");
            }
        }
        for camera in &bench.camera {
            camera.check().map_err(|fault| fault.of(file))?;
        }
        let points = bench.point.iter().map(|one| ("point", &one.name));
        let planes = bench.plane.iter().map(|one| ("plane", &one.name));
        let centres = bench.centre.iter().map(|one| ("centre", &one.name));
        let cameras = bench.camera.iter().map(|one| ("camera", &one.name));
        let boards = bench.board.iter().map(|one| ("board", &one.name));
        let mut names: Vec<_> =
            points.chain(planes).chain(centres).chain(cameras).chain(boards).collect();
        names.sort_unstable();
        if let Some([(table, name), _]) = names.array_windows().find(|[one, next]| one == next) {
            let found = format!("[[{table}]] `{name}` twice");
            return wrong(found, "one table for each name", "remove one");
        }
        Ok(Bench { file: file.to_owned(), ..bench })
    }

    /// Puts what is known into measurements that were read. A pair of which the file has neither point is
    /// another file's.
    ///
    /// # Errors
    /// [`Mistake`]: a pair of which the file has one point alone; a row whose camera or corner nobody knows.
    pub fn set_up(&self, data: &mut Measurements) -> Result<(), Mistake> {
        data.rows.iter_mut().for_each(|row| self.known(row));
        self.look(data)?;
        let has = |name: &String| {
            let of = |aim: &Aim| aim.seen == Seen::Point && aim.name == *name;
            data.rows.iter().any(|row| row.aim.as_deref().is_some_and(of))
        };
        for Known { points, distance, sigma } in &self.pair {
            let (distance, sigma) = (distance.0, sigma.map_or(EXACT, |sigma| sigma.0));
            match points.each_ref().map(has) {
                [true, true] => data.pairs.push(Pair { points: points.clone(), distance, sigma }),
                [false, false] => {}
                [is_first, _] => {
                    let [one, other] = points;
                    let (is, not) = if is_first { (one, other) } else { (other, one) };
                    let found = format!(
                        "a [[pair]] of `{is}` and `{not}` in {}, and no row with point `{not}`",
                        self.file
                    );
                    let expected = "rows of both points or of none";
                    let fault = Fault::new(found, expected, "mend the name, or remove the pair");
                    return Err(Mistake::from(fault));
                }
            }
        }
        Ok(())
    }

    fn known(&self, row: &mut Row) {
        let Some(aim) = row.aim.as_deref_mut() else { return };
        let place = |at: [Length; 3]| Vector3::from(at.map(|x| x.0));
        match aim.seen {
            Seen::Point => {
                let at = self.point.iter().find(|one| one.name == aim.name).and_then(|one| one.at);
                if let Some(at) = at {
                    aim.set(View::Point(place(at)), &[]);
                }
            }
            Seen::Distance => {
                let Some(of) = self.centre.iter().find(|one| one.name == aim.name) else { return };
                let offset = of.length_offset.map_or(0.0, |offset| offset.0);
                let from = of.at.map_or_else(Vector3::zeros, place);
                let free: &[usize] = match (of.at.is_some(), of.length_offset.is_some()) {
                    (true, true) => &[],
                    (true, false) => &[3],
                    (false, true) => &[0, 1, 2],
                    (false, false) => &[0, 1, 2, 3],
                };
                aim.set(View::Distance { from, offset }, free);
            }
            Seen::Plane => {
                let Some(of) = self.plane.iter().find(|one| one.name == aim.name) else { return };
                if let Some(normal) = of.normal.map(|n| Unit::new_normalize(Vector3::from(n))) {
                    let offset = of.offset.map_or(0.0, |offset| offset.0);
                    let free: &[usize] = if of.offset.is_some() { &[] } else { &[2] };
                    aim.set(View::Plane(Plane::new(normal, offset)), free);
                }
                if let (Some(sigma), None) = (of.sigma, &row.sigma) {
                    row.sigma.get_or_insert_default()[0] = sigma.0;
                }
            }
            Seen::Direction | Seen::Level | Seen::Camera => {}
        }
    }
}
