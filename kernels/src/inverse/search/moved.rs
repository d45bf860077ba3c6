//! Vectors and displacements.

use crate::{Pose, Scalar};

/// A vector.
pub(super) type V3 = [f64; 3];

/// A displacement: axes as columns, and the origin.
#[derive(Clone, Copy)]
pub(super) struct Moved(pub(super) [V3; 3], pub(super) V3);

pub(super) fn dot(a: V3, b: V3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: V3, b: V3) -> V3 {
    core::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}

/// `a + f b`.
pub(super) fn plus(a: V3, f: f64, b: V3) -> V3 {
    core::array::from_fn(|k| a[k] + f * b[k])
}

/// `v` turned about a unit vector by an angle of this cosine and sine.
pub(super) fn turned(v: V3, z: V3, [c, s]: [f64; 2]) -> V3 {
    let along = dot(z, v) * (1.0 - c);
    let across = cross(z, v);
    core::array::from_fn(|k| c * v[k] + s * across[k] + along * z[k])
}

/// Cosine and sine, by the kernels' own polynomial as all of the search: C has the same bits.
pub(super) fn circle(angle: f64) -> [f64; 2] {
    let ([sine], [cosine]) = f64::sin_cos_all([angle]);
    [cosine, sine]
}

impl Moved {
    pub(super) const NOT: Moved =
        Moved([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [0.0; 3]);

    pub(super) fn vector(&self, v: V3) -> V3 {
        let [x, y, z] = self.0;
        core::array::from_fn(|k| x[k] * v[0] + y[k] * v[1] + z[k] * v[2])
    }

    pub(super) fn vector_back(&self, v: V3) -> V3 {
        self.0.map(|axis| dot(axis, v))
    }

    pub(super) fn line(&self, [z, p]: [V3; 2]) -> [V3; 2] {
        [self.vector(z), plus(self.vector(p), 1.0, self.1)]
    }

    pub(super) fn line_back(&self, [z, p]: [V3; 2]) -> [V3; 2] {
        [self.vector_back(z), self.vector_back(plus(p, -1.0, self.1))]
    }

    /// Behind it a turn about a line.
    pub(super) fn then(&self, [z, p]: [V3; 2], by: [f64; 2]) -> Moved {
        let back = plus(p, -1.0, turned(p, z, by));
        let axes = Moved::NOT.0.map(|axis| self.vector(turned(axis, z, by)));
        Moved(axes, plus(self.vector(back), 1.0, self.1))
    }

    pub(super) fn pose(&self, home: &Pose<f64>) -> Pose<f64> {
        let position = plus(self.vector(home.position), 1.0, self.1);
        Pose { rotation: home.rotation.map(|axis| self.vector(axis)), position }
    }
}
