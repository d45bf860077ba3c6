//! The load that an arm carries, as a part of its last link.

use super::frames::Refused;
use super::model::{Angle, Frame as Placed, Joint, Payload, Robot, Value};
use super::space::Frame;
use super::suggest::advice;
use crate::number::Number;

type Vector = [Number; 3];

/// Moments of mass about the origin of a row's frame, in its axes: `∫ dm`, `∫ r dm`, `∫ r rᵀ dm`.
struct Moments {
    mass: Number,
    first: Vector,
    second: [Vector; 3],
}

impl Robot {
    /// Hangs a `[[payload]]` on the tool for good: the mass, the centre and the moments of inertia of the last link
    /// become those of both. What then is generated, checked or measured is of the arm that carries it.
    ///
    /// # Errors
    /// [`Refused`]: no payload of that name, or a last link or a tool that is not told in numbers.
    pub fn carry(&mut self, name: &str) -> Result<(), Refused> {
        let Some(payload) = self.payloads.iter().find(|payload| payload.name == name).cloned()
        else {
            let names: Vec<&str> = self.payloads.iter().map(|load| load.name.as_str()).collect();
            let help = match names.is_empty() {
                true => "the robot has no [[payload]]".to_owned(),
                false => advice(name, &names),
            };
            return Err(Refused { message: format!("`{name}` is no payload of this robot"), help });
        };
        let Some(link) = self.joints.last_mut() else { return Ok(()) };
        let Some(both) = carrying(link, &self.tool, &payload) else {
            let message = format!(
                "`{name}` cannot be carried: a parameter stands in the tool or the last link"
            );
            let help = "write numbers there: what is carried is added to the last link".to_owned();
            return Err(Refused { message, help });
        };
        let (com, tensor) = both.centred();
        link.mass = Some(Value::Number(both.mass));
        link.com = com.map(Value::Number);
        let spread = link.inertia.is_some() || tensor.iter().any(|entry| !entry.is_zero());
        link.inertia = spread.then(|| tensor.map(Value::Number));
        Ok(())
    }
}

/// Those of a link and of a load on the tool beyond it; `None` where something is no number.
fn carrying(link: &Joint, tool: &Placed, load: &Payload) -> Option<Moments> {
    let axes = axes(&tool.rotation);
    let centre = sum(numbers(&tool.translation)?, turned(&axes, numbers(&load.com)?));
    let load = moments(load.mass.number()?, centre, axes, load.inertia.as_ref())?;
    let Some(mass) = &link.mass else { return Some(load) };
    let own = moments(mass.number()?, numbers(&link.com)?, UPRIGHT, link.inertia.as_ref())?;
    Some(own.with(&load))
}

impl Moments {
    fn with(&self, other: &Moments) -> Moments {
        Moments {
            mass: self.mass + other.mass,
            first: sum(self.first, other.first),
            second: core::array::from_fn(|k| sum(self.second[k], other.second[k])),
        }
    }

    /// The centre, and the tensor of inertia about it: xx, xy, xz, yy, yz, zz.
    fn centred(&self) -> (Vector, [Number; 6]) {
        let inverse = self.mass.recip().unwrap_or(Number::ZERO);
        let com = self.first.map(|moment| moment * inverse);
        let own = |i: usize, j: usize| self.second[i][j] + -(self.first[i] * com[j]);
        let [x, y, z] = [own(0, 0), own(1, 1), own(2, 2)];
        (com, [y + z, -own(0, 1), -own(0, 2), x + z, -own(1, 2), x + y])
    }
}

/// Those of a body with its centre at a point, whose tensor of inertia about the centre is told in `axes` (columns).
fn moments(
    mass: Number,
    centre: Vector,
    axes: [Vector; 3],
    inertia: Option<&[Value; 6]>,
) -> Option<Moments> {
    let [xx, xy, xz, yy, yz, zz] = match inertia {
        Some(entries) => numbers(entries)?,
        None => [Number::ZERO; 6],
    };
    // Of the tensor I the second moments are tr(I)/2 − I.
    let half = Number::ratio(1, 2) * (xx + yy + zz);
    let own = [[half + -xx, -xy, -xz], [-xy, half + -yy, -yz], [-xz, -yz, half + -zz]];
    let first = centre.map(|x| mass * x);
    let columns = own.map(|column| turned(&axes, column));
    let second = core::array::from_fn(|i| {
        core::array::from_fn(|j| {
            let spread = (0..3).fold(Number::ZERO, |sum, k| sum + axes[k][i] * columns[k][j]);
            first[i] * centre[j] + spread
        })
    });
    Some(Moments { mass, first, second })
}

const UPRIGHT: [Vector; 3] = {
    let (one, none) = (Number::ONE, Number::ZERO);
    [[one, none, none], [none, one, none], [none, none, one]]
};

/// The columns of a rotation, right angles exactly.
fn axes(rotation: &[Angle; 3]) -> [Vector; 3] {
    // The readers let no symbol stand in a frame's rotation.
    let turned = Frame::by_rotation(rotation.each_ref().map(Angle::or_zero));
    turned.axes.map(|axis| axis.map(Number::cosine))
}

fn turned(axes: &[Vector; 3], v: Vector) -> Vector {
    core::array::from_fn(|k| (0..3).fold(Number::ZERO, |sum, c| sum + axes[c][k] * v[c]))
}

fn sum(a: Vector, b: Vector) -> Vector {
    core::array::from_fn(|k| a[k] + b[k])
}

fn numbers<const N: usize>(values: &[Value; N]) -> Option<[Number; N]> {
    let mut found = [Number::ZERO; N];
    for (found, value) in found.iter_mut().zip(values) {
        *found = value.number()?;
    }
    Some(found)
}
