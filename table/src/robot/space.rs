//! Vectors and frames in space, as little as a chain of axes needs.

/// Components, or a point by its coordinates.
pub type Vector = [f64; 3];

pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

pub fn times(a: Vector, by: f64) -> Vector {
    a.map(|x| x * by)
}

/// `a + by·b`.
pub fn plus(a: Vector, by: f64, b: Vector) -> Vector {
    core::array::from_fn(|k| a[k] + by * b[k])
}

/// A frame in another: its axes and its origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// x, y and z as unit vectors: the columns of the rotation matrix.
    pub axes: [Vector; 3],
    /// m.
    pub origin: Vector,
}

impl Frame {
    /// The other frame itself.
    pub const IDENTITY: Frame =
        Frame { axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], origin: [0.0; 3] };

    /// Turned about an axis (a unit vector) by an angle, rad: Rodrigues' formula.
    pub fn turned(axis: Vector, angle: f64) -> Frame {
        let (s, c) = angle.sin_cos();
        let image = |e: Vector| {
            let along = times(axis, (1.0 - c) * dot(axis, e));
            plus(plus(along, c, e), s, cross(axis, e))
        };
        Frame { axes: Frame::IDENTITY.axes.map(image), origin: [0.0; 3] }
    }

    /// Turned by a rotation vector.
    pub fn by_rotation(vector: Vector) -> Frame {
        let angle = norm(vector);
        if angle == 0.0 {
            return Frame::IDENTITY;
        }
        Frame::turned(times(vector, 1.0 / angle), angle)
    }

    /// Moved.
    pub fn moved(by: Vector) -> Frame {
        Frame { origin: by, ..Frame::IDENTITY }
    }

    /// A direction of this frame, in the other.
    pub fn direction(&self, v: Vector) -> Vector {
        core::array::from_fn(|k| (0..3).map(|c| self.axes[c][k] * v[c]).sum())
    }

    /// A point of this frame, in the other.
    pub fn point(&self, p: Vector) -> Vector {
        plus(self.origin, 1.0, self.direction(p))
    }

    /// A frame in this one, in the other.
    pub fn then(&self, next: &Frame) -> Frame {
        Frame { axes: next.axes.map(|x| self.direction(x)), origin: self.point(next.origin) }
    }

    /// The other frame in this one.
    pub fn inverse(&self) -> Frame {
        let axes = core::array::from_fn(|c| core::array::from_fn(|r| self.axes[r][c]));
        let turn = Frame { axes, origin: [0.0; 3] };
        Frame { origin: times(turn.direction(self.origin), -1.0), ..turn }
    }

    /// The rotation vector of the axes, by the largest component of their quaternion.
    pub fn rotation_vector(&self) -> Vector {
        let r = |row: usize, column: usize| self.axes[column][row];
        let odd = [r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)];
        // Four times the squares of the quaternion's components.
        let scalar = 1.0 + r(0, 0) + r(1, 1) + r(2, 2);
        let vector = |k: usize| 1.0 - r(0, 0) - r(1, 1) - r(2, 2) + 2.0 * r(k, k);
        let largest = (0..3).max_by(|a, b| vector(*a).total_cmp(&vector(*b))).unwrap_or(0);
        let (w, v) = if scalar >= vector(largest) {
            (scalar, odd)
        } else {
            let v = |k: usize| {
                if k == largest { vector(k) } else { r(k, largest) + r(largest, k) }
            };
            (odd[largest], core::array::from_fn(v))
        };
        // The quaternion and its opposite turn alike: the one that turns by half a circle at most.
        let (w, v) = if w < 0.0 { (-w, times(v, -1.0)) } else { (w, v) };
        let sine = norm(v);
        if sine == 0.0 { [0.0; 3] } else { times(v, 2.0 * sine.atan2(w) / sine) }
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::PI;

    use super::*;

    #[test]
    fn a_rotation_vector_is_its_rotations() {
        let axis = times([2.0, -1.0, 2.0], 1.0 / 3.0);
        for angle in [0.0, 1e-9, 0.3, 1.7, 2.8, PI - 1e-7, PI] {
            let found = Frame::turned(axis, angle).rotation_vector();
            let off = norm(plus(found, -angle, axis));
            // Half a turn about an axis is half a turn about its opposite.
            let opposite = norm(plus(found, angle, axis));
            assert!(off < 1e-15 || (angle > PI - 1e-6 && opposite < 1e-15), "{angle}: {found:?}");
        }
    }

    #[test]
    fn an_inverse_undoes() {
        let frame = Frame::turned([0.6, 0.0, 0.8], 1.1).then(&Frame::moved([0.1, -0.2, 0.3]));
        let none = frame.then(&frame.inverse());
        assert!(norm(none.origin) < 1e-15 && norm(none.rotation_vector()) < 1e-15);
    }
}
