//! Vectors, points and frames of the arm. They stand in whatever frame of the chain the whole function costs least,
//! and only their components along the axes of a frame are numbers.

use core::ops::{Add, Mul, Neg, Sub};

use crate::expr::{Expr, Graph, Vec3, parallel3};
use crate::term::{Sheet, Term, cross, plus};

/// A vector in space: a direction, a displacement, an axis.
#[derive(Clone, Copy)]
pub struct Vector<'f> {
    pub(super) v: Vec3,
    pub(super) sheet: &'f Sheet,
}

impl<'f> Vector<'f> {
    /// `self · other`.
    pub fn dot(self, other: Self) -> Term<'f> {
        self.sheet.term(self.sheet.graph.borrow_mut().dot3(self.v, other.v))
    }

    /// `self × other`.
    pub fn cross(self, other: Self) -> Self {
        self.with(|g| g.cross3(self.v, other.v))
    }

    /// Its length. Where it is zero, its derivative is not finite.
    #[track_caller]
    pub fn norm(self) -> Term<'f> {
        self.dot(self).sqrt()
    }

    pub(super) fn with(self, does: impl FnOnce(&mut Graph) -> Vec3) -> Self {
        Vector { v: does(&mut self.sheet.graph.borrow_mut()), ..self }
    }
}

impl Add for Vector<'_> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.with(|g| g.add3(self.v, other.v))
    }
}

impl Sub for Vector<'_> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Vector<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        Vector { v: self.v.map(|c| -c), ..self }
    }
}

impl<'f> Mul<Term<'f>> for Vector<'f> {
    type Output = Self;
    fn mul(self, factor: Term<'f>) -> Self {
        self.with(|g| g.scale3(factor.e, self.v))
    }
}

impl Mul<f64> for Vector<'_> {
    type Output = Self;
    #[track_caller]
    fn mul(self, factor: f64) -> Self {
        self * self.sheet.number(factor)
    }
}

/// A point in space, known from a frame of the chain with which it moves.
#[derive(Clone, Copy)]
pub struct Point<'f> {
    /// Boundary of the chain (0 = base, as many steps a row as a row has).
    pub(super) boundary: usize,
    /// Lengths along axes from that frame's origin: what is along one axis is added before it is turned.
    pub(super) offsets: [(Expr, Vec3); 3],
    /// From there.
    pub(super) beyond: Vector<'f>,
}

impl<'f> Point<'f> {
    /// The point at a distance along an axis.
    fn along(mut self, length: Term<'f>, axis: Vector<'f>) -> Self {
        let free = |(own, along): &(Expr, Vec3)| own.is_zero() || parallel3(*along, axis.v);
        let Some(slot) = self.offsets.iter().position(free) else {
            return self + axis * length;
        };
        let (own, along) = self.offsets[slot];
        self.offsets[slot] = match own.is_zero() {
            true => (length.e, axis.v),
            false => {
                let sign = if along == axis.v { length } else { -length };
                ((axis.sheet.term(own) + sign).e, along)
            }
        };
        self
    }
}

impl<'f> Add<Vector<'f>> for Point<'f> {
    type Output = Self;
    fn add(self, by: Vector<'f>) -> Self {
        Point { beyond: self.beyond + by, ..self }
    }
}

/// A frame: of the chain, of the tool, of the base, or one that is told from one of them.
#[derive(Clone, Copy)]
pub struct Frame<'f> {
    pub(super) axes: [Vector<'f>; 3],
    pub(super) origin: Point<'f>,
    /// A small displacement along the axes and turn about them: it acts on components, so that nobody has to know that
    /// axes are perpendicular.
    pub(super) displaced: Option<[[Term<'f>; 3]; 2]>,
}

impl<'f> Frame<'f> {
    /// Unit vectors along x, y, z.
    pub fn axes(&self) -> [Vector<'f>; 3] {
        match self.displaced {
            None => self.axes,
            Some([_, turn]) => {
                let turn = self.along(turn);
                self.axes.map(|axis| axis + turn.cross(axis))
            }
        }
    }

    /// Where it stands.
    pub fn origin(&self) -> Point<'f> {
        match self.displaced {
            None => self.origin,
            Some([shift, _]) => self.origin + self.along(shift),
        }
    }

    /// The vector with these components along the axes.
    pub fn vector(&self, components: [Term<'f>; 3]) -> Vector<'f> {
        match self.displaced {
            None => self.along(components),
            Some([_, turn]) => self.along(plus(components, cross(turn, components))),
        }
    }

    /// The point with these coordinates, m.
    pub fn point(&self, coordinates: [Term<'f>; 3]) -> Point<'f> {
        let coordinates = match self.displaced {
            None => coordinates,
            Some([shift, turn]) => plus(plus(shift, coordinates), cross(turn, coordinates)),
        };
        let along = coordinates.into_iter().zip(self.axes);
        along.fold(self.origin, |point, (length, axis)| point.along(length, axis))
    }

    /// Components of a vector along the axes.
    pub fn components(&self, v: Vector<'f>) -> [Term<'f>; 3] {
        let components = self.axes.map(|axis| axis.dot(v));
        match self.displaced {
            None => components,
            Some([_, turn]) => plus(components, cross(components, turn)),
        }
    }

    /// The frame whose origin has these coordinates, m, and whose axes have these components.
    pub fn then(&self, origin: [Term<'f>; 3], axes: [[Term<'f>; 3]; 3]) -> Frame<'f> {
        let axes = axes.map(|axis| self.vector(axis));
        Frame { axes, origin: self.point(origin), displaced: None }
    }

    /// The frame displaced along and turned about its own axes by so little that squares do not count: by v, m, and a
    /// rotation vector ω, rad. Derivatives by [variations](super::Formulas::variation) v and ω are those on the group of
    /// displacements, six for a frame, however its place is written.
    pub fn displaced(&self, v: [Term<'f>; 3], turn: [Term<'f>; 3]) -> Frame<'f> {
        match self.displaced {
            None => Frame { displaced: Some([v, turn]), ..*self },
            Some(_) => {
                Frame { axes: self.axes(), origin: self.origin(), displaced: Some([v, turn]) }
            }
        }
    }

    fn along(&self, components: [Term<'f>; 3]) -> Vector<'f> {
        let [x, y, z] = self.axes;
        x * components[0] + y * components[1] + z * components[2]
    }
}

/// Axes of a frame turned by a quaternion w, x, y, z, which need not be of length 1 (and must not be 0).
#[track_caller]
pub fn quaternion<'f>([w, x, y, z]: [Term<'f>; 4]) -> [[Term<'f>; 3]; 3] {
    let s = 2.0 / (w * w + x * x + y * y + z * z);
    let [sx, sy, sz] = [x, y, z].map(|c| s * c);
    [
        [1.0 - (sy * y + sz * z), sx * y + sz * w, sx * z - sy * w],
        [sx * y - sz * w, 1.0 - (sx * x + sz * z), sy * z + sx * w],
        [sx * z + sy * w, sy * z - sx * w, 1.0 - (sx * x + sy * y)],
    ]
}

/// Axes of a frame turned by roll, pitch and yaw as in a URDF: about the fixed x, then y, then z, rad.
pub fn roll_pitch_yaw<'f>(angles: [Term<'f>; 3]) -> [[Term<'f>; 3]; 3] {
    let [(sr, cr), (sp, cp), (sy, cy)] = angles.map(|angle| (angle.sin(), angle.cos()));
    [
        [cy * cp, sy * cp, -sp],
        [cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr],
        [cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr],
    ]
}
